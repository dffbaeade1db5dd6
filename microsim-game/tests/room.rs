//! Rooms of the real server, as the window meets them: `.ci/serve` builds the server and runs this.
#![cfg(unix)]

use microsim_game::network::contest::Match;
use microsim_game::network::room::Room;
use microsim_game::network::transport::{LONGEST_MESSAGE, Notice, Transport};
use microsim_game::platform::open_room;
use microsim_game::rules::bot::{Bot, Policy};
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Longest time that anything takes here.
const TIMEOUT: Duration = Duration::from_secs(30);
/// Longest time that a match takes, of which all players share a processor here.
const LONGEST_MATCH: Duration = Duration::from_secs(600);
const COUNT: u32 = 10_000;

struct Server(Child, String);

impl Server {
    /// Starts the program that MICROSIM_SERVE names.
    fn start() -> Self {
        let program = std::env::var("MICROSIM_SERVE").expect("MICROSIM_SERVE is a microsim with the feature `serve`");
        let mut command = Command::new("env");
        command.args(["--default-signal=INT", &program, "--quiet", "serve", "--port", "0", "--listen", "127.0.0.1"]);
        // Members are told of a server that they do not need.
        command.args(["--stun", "127.0.0.1"]);
        let mut process = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut address = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut address).unwrap();
        Self(process, address)
    }

    /// Goes into a room, and returns the notices up to the first one as well.
    fn enter(&self, code: &str) -> (Box<dyn Transport>, Vec<Notice>) {
        let mut room = open_room(&self.1, code, "").unwrap();
        let notices = next(&mut room);
        (room, notices)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// What happens next; at least one notice.
fn next(room: &mut Box<dyn Transport>) -> Vec<Notice> {
    let begin = Instant::now();
    loop {
        let notices = room.poll();
        if !notices.is_empty() {
            return notices;
        }
        assert!(begin.elapsed() < TIMEOUT, "nothing happens");
        std::thread::yield_now();
    }
}

fn number(notice: &Notice) -> u32 {
    let Notice::Message { bytes, .. } = notice else { panic!("{notice:?}") };
    u32::from_be_bytes(bytes[..4].try_into().unwrap())
}

#[test]
#[ignore = "needs the server"]
fn messages_arrive_in_order() {
    let server = Server::start();
    let (mut one, welcome) = server.enter("ORDER");
    assert_eq!(welcome, [Notice::Welcome { member: 0, others: vec![] }]);
    let (mut two, welcome) = server.enter("order");
    assert_eq!(welcome, [Notice::Welcome { member: 1, others: vec![0] }]);
    assert_eq!(next(&mut one), [Notice::Joined(1)]);
    let (mut sent, mut from_one, mut from_two) = (0, 0, 0);
    let begin = Instant::now();
    while from_one < COUNT || from_two < COUNT {
        assert!(begin.elapsed() < TIMEOUT, "{from_one} and {from_two} of {COUNT}");
        // The server reads a thousand a second of each; what is sent too fast waits, and is lost in the end.
        let due = (begin.elapsed().as_secs_f64() * 1000.0) as u32 + 1000;
        while sent < due.min(COUNT) {
            let message = [&sent.to_be_bytes()[..], &[0; 56]].concat();
            one.send(1, &message);
            two.send(0, &message);
            sent += 1;
        }
        for notice in two.poll() {
            assert_eq!(number(&notice), from_one);
            from_one += 1;
        }
        for notice in one.poll() {
            assert_eq!(number(&notice), from_two);
            from_two += 1;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
#[ignore = "needs the server"]
fn members_leave_and_come_back_and_the_server_stops() {
    let server = Server::start();
    let (mut one, _) = server.enter("LEAVE");
    let (two, _) = server.enter("LEAVE");
    assert_eq!(next(&mut one), [Notice::Joined(1)]);
    let (mut three, welcome) = server.enter("LEAVE");
    assert_eq!(welcome, [Notice::Welcome { member: 2, others: vec![0, 1] }]);
    assert_eq!(next(&mut one), [Notice::Joined(2)]);
    drop(two);
    assert_eq!(next(&mut one), [Notice::Left(1)]);
    assert_eq!(next(&mut three), [Notice::Left(1)]);
    one.send(1, b"nobody is there");
    one.send(2, &vec![7; LONGEST_MESSAGE]);
    one.send(2, &vec![7; LONGEST_MESSAGE + 1]);
    assert_eq!(next(&mut three), [Notice::Message { from: 0, bytes: vec![7; LONGEST_MESSAGE] }]);
    let (mut two, welcome) = server.enter("LEAVE");
    assert_eq!(welcome, [Notice::Welcome { member: 1, others: vec![0, 2] }]);
    assert_eq!(next(&mut one), [Notice::Joined(1)]);
    assert_eq!(next(&mut three), [Notice::Joined(1)]);
    one.send(0, b"to oneself");
    let closed = Notice::Closed("a message to a receiver who cannot be there".to_owned());
    assert_eq!(next(&mut one), [closed]);
    assert_eq!(next(&mut two), [Notice::Left(0)]);
    let stopped = Command::new("kill").args(["-INT", &server.0.id().to_string()]).status().unwrap();
    assert!(stopped.success());
    // Another one may be gone a moment before.
    let mut last = next(&mut two);
    last.retain(|notice| !matches!(notice, Notice::Left(_)));
    let last = if last.is_empty() { next(&mut two) } else { last };
    assert_eq!(last, [Notice::Closed("the server stops".to_owned())]);
    assert!(two.poll().is_empty());
}

/// A player that a bot steers.
struct Player {
    room: Room,
    bot: Bot,
    game: Option<Match>,
}

impl Player {
    fn enter(server: &Server, name: &str, seed: u64) -> Self {
        let room = Room::new(open_room(&server.1, "MATCH", "").unwrap(), "MATCH", name);
        Self { room, bot: Bot::new(Policy::Greedy, seed), game: None }
    }

    /// One frame of the match, if it has begun.
    fn play(&mut self, now: u32) {
        let begun = self.room.update(now, 7, self.game.as_mut());
        self.game = self.game.take().or(begun);
        let Some(game) = &mut self.game else { return };
        let round = game.session().round();
        let cell = round.players().nth(game.own().unwrap()).unwrap();
        let intent = self.bot.intent(round.world(), cell);
        self.room.advance(game, intent, now);
    }

    fn is_over(&self) -> bool {
        self.game.as_ref().is_some_and(|game| game.session().is_over())
    }
}

/// Lets all play until something is so for each of them.
fn play_until(players: &mut [Player; 2], is_done: fn(&Player) -> bool) {
    let begin = Instant::now();
    players.iter_mut().for_each(|player| player.room.set_ready(true));
    while !players.iter().all(is_done) {
        assert!(begin.elapsed() < LONGEST_MATCH, "{:?}", players.each_ref().map(is_done));
        players.iter_mut().for_each(|player| player.play(begin.elapsed().as_millis() as u32));
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
#[ignore = "needs the server"]
fn two_play_a_match_to_its_end_and_begin_another_one() {
    let server = Server::start();
    let mut players = [Player::enter(&server, "Ada", 1), Player::enter(&server, "Ben", 2)];
    play_until(&mut players, Player::is_over);
    let ends = players.each_ref().map(|player| {
        let session = player.game.as_ref().unwrap().session();
        (session.round().world().digest(), session.round().scores(), session.desync(), session.tally().refused)
    });
    assert_eq!(ends[0], ends[1]);
    let (_, scores, desync, refused) = &ends[0];
    assert!(scores.iter().all(|&points| points > 100), "{scores:?}");
    assert_eq!((*desync, *refused), (None, 0));
    for player in &mut players {
        player.game = None;
        player.room.finish();
    }
    play_until(&mut players, |player| player.game.as_ref().is_some_and(|game| game.session().frame() > 30));
}

/// How long a message of 60 bytes takes there and back, while nothing else is sent.
#[test]
#[ignore = "measures: prints the times"]
fn round_trips() {
    let server = Server::start();
    let (mut one, _) = server.enter("TIME");
    let (mut two, _) = server.enter("TIME");
    next(&mut one);
    let mut times: Vec<Duration> = (0..COUNT)
        .map(|_| {
            // 600 a second, as in play: the allowance lasts.
            std::thread::sleep(Duration::from_micros(1600));
            let begin = Instant::now();
            one.send(1, &[1; 60]);
            assert_eq!(next(&mut two).len(), 1);
            two.send(0, &[1; 60]);
            assert_eq!(next(&mut one).len(), 1);
            begin.elapsed()
        })
        .collect();
    times.sort_unstable();
    let at = |share: usize| times[times.len() * share / 1000].as_secs_f64() * 1e3;
    println!("there and back, ms: p50 {:.3}, p99 {:.3}, p99.9 {:.3}", at(500), at(990), at(999));
}
