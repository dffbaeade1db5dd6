//! A member of a room that a bot steers, match after match: `room_bot SERVER CODE NAME [MATCHES [RECORD]]`. It prints when each of the
//! others begins to move, and a line for each match, of which the file RECORD is the last. For the tests of the page, and for `.ci/soak`.

use microsim_core::Intent;
use microsim_game::network::contest::Match;
use microsim_game::network::room::Room;
use microsim_game::network::session::Session;
use microsim_game::platform::{open_room, room_key};
use microsim_game::rules::bot::{Bot, Policy};
use std::time::{Duration, Instant, SystemTime};
use std::{env, fs, thread};

/// Frames between two decisions: about as often as a hand turns.
const DECISION: u32 = 6;
/// Frames that are taken at once by who has come late.
const CATCHING_UP: usize = 20;
/// Time after the end for which others may ask for what they miss.
const LAST_WORD: Duration = Duration::from_secs(2);
/// Time between two looks at what has come.
const PAUSE: Duration = Duration::from_millis(2);
/// Longest time without a frame in a match.
const TIMEOUT: Duration = Duration::from_secs(30);

fn main() -> Result<(), String> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [server, code, name, rest @ ..] = &arguments[..] else {
        return Err("room_bot SERVER CODE NAME [MATCHES [RECORD]]".to_owned());
    };
    let matches = rest.first().map_or(Ok(u64::MAX), |text| text.parse()).map_err(|_| "MATCHES is a number")?;
    let mut room = Room::new(open_room(server, code, &room_key())?, code, name);
    let clock = Instant::now();
    for number in 1..=matches {
        let (line, record) = play(&mut room, number, clock)?;
        println!("{line}");
        if let Some(file) = rest.get(1) {
            fs::write(file, record).map_err(|error| format!("{file}: {error}"))?;
        }
        room.finish();
    }
    Ok(())
}

/// A match from the lobby to its end, as a line and as a record.
fn play(room: &mut Room, number: u64, clock: Instant) -> Result<(String, Vec<u8>), String> {
    room.set_ready(true);
    let (mut current, mut player) = (None::<Match>, (Bot::new(Policy::Greedy, number), Intent::REST));
    let (mut due, mut taken, mut over, mut moved) = (clock.elapsed(), clock.elapsed(), None, Vec::new());
    loop {
        thread::sleep(PAUSE);
        let now = clock.elapsed();
        let begun = room.update(now.as_millis() as u32, number, current.as_mut());
        if let Some(reason) = room.closed() {
            return Err(reason.to_owned());
        }
        if let Some(game) = begun {
            (current, due, taken) = (Some(game), now, now);
        }
        let Some(game) = &mut current else { continue };
        (0..CATCHING_UP).take_while(|_| game.catch_up()).for_each(drop);
        note_moves(game.session(), &mut moved);
        let session = game.session();
        if session.desync().is_some() || over.is_some_and(|since| now > since + LAST_WORD) {
            return Ok((line(game, number, now), session.round().record().unwrap_or_default()));
        }
        if session.is_over() {
            over.get_or_insert(now);
        } else if now > taken + TIMEOUT {
            return Err(format!("nothing happens after {}", line(game, number, now)));
        }
        while due <= now {
            let steps = game.session().steps();
            if room.advance(game, decide(game, &mut player), now.as_millis() as u32) {
                taken = now;
            }
            due += Duration::from_secs(1) * steps / 60;
        }
    }
}

/// What the bot wants in this frame: now and then something else.
fn decide(game: &Match, (bot, intent): &mut (Bot, Intent)) -> Intent {
    let round = game.session().round();
    if game.session().frame().is_multiple_of(DECISION) {
        let cell = game.own().and_then(|own| round.players().nth(own));
        *intent = cell.map_or(Intent::REST, |cell| bot.intent(round.world(), cell));
    }
    *intent
}

/// Prints when the inputs of others first tell their cells to move: by the clock of the system, ms since 1970.
fn note_moves(session: &Session, moved: &mut Vec<usize>) {
    let size = session.round().world().config().size;
    let tells = |player: usize| {
        let (told, _) = session.told(player);
        told.iter().take(session.frame() as usize).any(|told| told.intent(size).goal().is_some())
    };
    for player in session.present().filter(|player| Some(*player) != session.own()) {
        if !moved.contains(&player) && tells(player) {
            moved.push(player);
            let time = SystemTime::UNIX_EPOCH.elapsed().unwrap_or_default();
            println!("player {player} moves at {}", time.as_millis());
        }
    }
}

fn line(game: &Match, number: u64, now: Duration) -> String {
    let (session, tally) = (game.session(), game.session().tally());
    let (ping, loss) = session.way();
    format!(
        "match {number} digest {:016x} frames {} desync {:?} scores {:?} compared {} rollbacks {} repeated {} deepest {} waits {} sent \
         {} received {} refused {} ping {:?} loss {:.1} % memory {} kB after {} s",
        session.round().world().digest(),
        session.frame() - session.frames_over(),
        session.desync(),
        session.round().scores(),
        session.digests().len(),
        tally.rollbacks,
        tally.repeated,
        tally.deepest,
        tally.waits,
        tally.sent,
        tally.received,
        tally.refused,
        ping,
        100.0 * loss,
        memory().unwrap_or(0),
        now.as_secs(),
    )
}

/// Memory that this process holds, kB, where the system says it as Linux does.
fn memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?.split_whitespace().next()?.parse().ok()
}
