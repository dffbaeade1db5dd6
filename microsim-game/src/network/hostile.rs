//! What is done with the bytes that a fuzzer makes up (folder `fuzz`). The tests below do the same with the committed corpus.

use super::message::{Message, write};
use super::packet::Packet;
use super::rollback_pacing::Pacing;
use super::session::Session;
use super::told::Told;
use crate::rules::round::Round;
use microsim_core::scenario::Scenario;
use std::sync::LazyLock;

const PLAYERS: usize = 3;
/// The member that watches, or takes over from a bot.
const GUEST: u8 = 3;
/// Pieces that are taken in: each may have frames taken again.
const PIECES: usize = 32;
/// Of the first byte of a piece, the lowest two bits of which are its sender: what the match does before, and to whom.
const ADVANCES: u8 = 4;
const LEAVES: u8 = 8;
const SEATS: u8 = 16;
const WHOM: u32 = 5;
/// Of the first piece: the match is that of one who watches.
const WATCHES: u8 = 128;

/// So small that nothing takes long.
const ROOM: &str = r#"
    schema = 1
    [world]
    size = [30.0, 20.0]
    [step]
    substeps = 3
    [game]
    time = 1.0
    [amoeboid_cell.cell]
    radii = [5.0, 5.0]
    [probe.needle]
    radius = 1.0
    [[spawn]]
    of = "cell"
    at = [8.0, 8.0]
    player = true
    [[spawn]]
    of = "needle"
    at = [20.0, 15.0]
    name = "player-2"
    [[spawn]]
    of = "needle"
    at = [25.0, 5.0]
    name = "player-3"
"#;

static ROUND: LazyLock<Round> = LazyLock::new(|| {
    let scenario = Scenario::parse(ROOM, &[]).expect("a sound scenario");
    Round::new(&scenario).expect("a game")
});

/// What others send in a match of three, in pieces: a byte, the length in two bytes, and a packet.
pub fn packet(bytes: &[u8]) {
    message(bytes);
    let watches = bytes.first().is_some_and(|head| head & WATCHES != 0);
    let (round, pacing) = (ROUND.clone(), Pacing::USUAL);
    let mut session = if watches { Session::watch(round, GUEST, pacing) } else { Session::new(round, 0, pacing) };
    for (head, packet) in pieces(bytes) {
        show(&mut session, head, packet);
    }
}

/// A message of a member of a room; what is accepted can be written and read.
fn message(bytes: &[u8]) {
    if let Ok(message) = postcard::from_bytes::<Message>(bytes) {
        let written = write(&message);
        let again = postcard::from_bytes::<Message>(&written).expect("what was written can be read");
        assert_eq!(write(&again), written);
    }
}

fn pieces(mut rest: &[u8]) -> impl Iterator<Item = (u8, &[u8])> {
    let next = move || {
        let [head, low, high, after @ ..] = rest else { return None };
        let length = usize::from(u16::from_le_bytes([*low, *high])).min(after.len());
        let packet;
        (packet, rest) = after.split_at(length);
        Some((*head, packet))
    };
    std::iter::from_fn(next).take(PIECES)
}

/// One piece: nothing panics, no more is taken again than is kept, and what the match sends is what others accept.
fn show(session: &mut Session, head: u8, packet: &[u8]) {
    let (from, whom) = (head % 4, usize::from(head >> WHOM) % 4);
    if head & ADVANCES != 0 {
        session.advance(Told::default());
    }
    if head & LEAVES != 0 {
        session.leave(whom);
    }
    if head & SEATS != 0 {
        session.seat(whom, GUEST);
    }
    if let Some(accepted) = Packet::read(packet, PLAYERS) {
        assert_eq!(Packet::read(&accepted.write(), PLAYERS), Some(accepted));
    }
    if from == GUEST {
        session.receive_guest(GUEST, packet, 0);
    } else {
        session.receive(from.into(), packet, 0);
    }
    let guests = session.guest_packets(0).into_iter().map(|(_, sent)| sent);
    let sent: Vec<Vec<u8>> = session.packets(0).into_iter().map(|(_, sent)| sent).chain(guests).collect();
    assert!(sent.iter().all(|sent| Packet::read(sent, PLAYERS).is_some()));
    assert!(session.tally().deepest <= Pacing::USUAL.kept());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::message::Start;
    use crate::network::plan::{FrameRate, Plan, Way};
    use microsim_core::{Intent, glam::Vec2};
    use std::fs;
    use std::path::PathBuf;

    fn folder() -> PathBuf {
        [env!("CARGO_MANIFEST_DIR"), "..", "fuzz", "corpus", "packet"].iter().collect()
    }

    #[test]
    fn packets() {
        let files: Vec<PathBuf> = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
        assert!(!files.is_empty(), "no corpus");
        files.iter().for_each(|file| packet(&fs::read(file).unwrap()));
    }

    #[test]
    fn seeds_are_accepted() {
        for name in ["play", "leave", "watch"] {
            let bytes = fs::read(folder().join(name)).unwrap();
            assert!(pieces(&bytes).count() > 10, "{name}");
            let mut session = Session::new(ROUND.clone(), 0, Pacing::USUAL);
            pieces(&bytes).for_each(|(head, packet)| show(&mut session, head, packet));
            assert_eq!((session.tally().refused, session.desync()), (0, None), "{name}");
            assert!(session.frame() > 5, "{name}");
        }
        assert!(postcard::from_bytes::<Message>(&fs::read(folder().join("start")).unwrap()).is_ok());
    }

    /// What the first of three receives, with these first bytes of the pieces.
    fn recorded(head: fn(usize) -> u8) -> Vec<u8> {
        let of = |own| Session::new(ROUND.clone(), own, Pacing::USUAL);
        let mut first = of(0);
        let mut others = [of(1), of(2), Session::watch(ROUND.clone(), GUEST, Pacing::USUAL)];
        let size = ROUND.world().config().size;
        let mut bytes = Vec::new();
        for k in 0..PIECES {
            let head = head(k);
            if head & LEAVES != 0 {
                others.iter_mut().for_each(|other| other.leave(usize::from(head >> WHOM)));
            }
            let sender = &mut others[usize::from(head % 4) - 1];
            sender.advance(Told::new(Intent::toward(Vec2::splat(k as f32)).unwrap(), size));
            let packet = sender.packets(0).into_iter().find(|(to, _)| *to == 0).unwrap().1;
            bytes.extend([&[head][..], &(packet.len() as u16).to_le_bytes(), &packet].concat());
            show(&mut first, head, &packet);
            first.packets(0).into_iter().for_each(|(to, packet)| others[to - 1].receive(0, &packet, 0));
            first.guest_packets(0).into_iter().for_each(|(_, packet)| others[2].receive(0, &packet, 0));
        }
        bytes
    }

    #[test]
    #[ignore = "writes the seeds of the corpus"]
    fn write_seeds() {
        fs::create_dir_all(folder()).unwrap();
        let keep = |name: &str, bytes: Vec<u8>| fs::write(folder().join(name), bytes).unwrap();
        keep("play", recorded(|k| ADVANCES | [1, 2][k % 2]));
        keep("leave", recorded(|k| ADVANCES | if k < 8 { [1, 2][k % 2] } else { 1 } | third(k, 8, PIECES)));
        let seat = |k| ADVANCES | if k < 4 { [1, 2][k % 2] } else { [1, GUEST][k % 2] } | third(k, 4, 15);
        keep("watch", recorded(seat));
        let plan = Plan { way: Way::Together, rate: FrameRate::Quick };
        let start = Start { number: 1, plan, seed: 7, seats: vec![0, 1, 3] };
        keep("start", write(&Message::Start(start)));
    }

    /// The third player leaves, and who watches takes over from its bot.
    fn third(k: usize, leaves: usize, takes_over: usize) -> u8 {
        let happens = if k == leaves { LEAVES } else { 0 } | if k == takes_over { SEATS } else { 0 };
        if happens == 0 { 0 } else { happens | 2 << WHOM }
    }
}
