//! Rooms of the real server, as the window meets them: `.ci/serve` builds the server and runs this.
#![cfg(unix)]

use microsim_game::network::transport::{LONGEST_MESSAGE, Notice, Transport};
use microsim_game::platform::open_room;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Longest time that anything takes here.
const PATIENCE: Duration = Duration::from_secs(30);
const COUNT: u32 = 10_000;

struct Server(Child, String);

impl Server {
    /// Starts the program that MICROSIM_SERVE names.
    fn start() -> Self {
        let program = std::env::var("MICROSIM_SERVE").expect("MICROSIM_SERVE is a microsim with the feature `serve`");
        let mut command = Command::new("env");
        command.args(["--default-signal=INT", &program, "--quiet", "serve", "--port", "0", "--listen", "127.0.0.1"]);
        let mut process = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut address = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut address).unwrap();
        Self(process, address)
    }

    /// Goes into a room, and returns the notices up to the first one as well.
    fn enter(&self, code: &str) -> (Box<dyn Transport>, Vec<Notice>) {
        let mut room = open_room(&self.1, code).unwrap();
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
        assert!(begin.elapsed() < PATIENCE, "nothing happens");
        std::thread::yield_now();
    }
}

fn number(notice: &Notice) -> u32 {
    let Notice::Message { bytes, .. } = notice else { panic!("{notice:?}") };
    u32::from_le_bytes(bytes[..4].try_into().unwrap())
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
        assert!(begin.elapsed() < PATIENCE, "{from_one} and {from_two} of {COUNT}");
        // The server reads a thousand a second of each; what is sent too fast waits, and is lost in the end.
        let due = (begin.elapsed().as_secs_f64() * 1000.0) as u32 + 1000;
        while sent < due.min(COUNT) {
            let message = [&sent.to_le_bytes()[..], &[0; 56]].concat();
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
    assert_eq!(next(&mut two), [Notice::Closed("the server stops".to_owned())]);
    assert!(two.poll().is_empty());
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
