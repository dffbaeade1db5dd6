//! A match that comes apart: what its players keep of it says where.

use microsim_core::replay::{Player, Replay};
use microsim_core::scenario::Scenario;
use microsim_core::{Intent, World, glam::Vec2};
use microsim_game::network::rollback_pacing::Pacing;
use microsim_game::network::session::Session;
use microsim_game::network::told::Told;
use microsim_game::rules::round::Round;
use microsim_game::rules::two_players;
use std::fs;
use std::process::Command;

/// What one of the two programs does otherwise than the other one.
const ERROR: &str = "\n[[command]]\nof = \"player-2\"\nat = 1.0\ngrow = { nodes = 1, particles = 3 }\n";
/// The first step whose world has it, and the first one with a digest that shows it.
const FIRST: u64 = 61;
const SHOWN: u64 = 120;

/// Two who play the same match, but for the error in the program of the second one.
fn parted() -> [Session; 2] {
    let program = |own: usize, text: &str| {
        let round = Round::new(&Scenario::parse(text, &[]).unwrap()).unwrap();
        Session::new(round, own, Pacing::USUAL)
    };
    let text = two_players::text(2);
    let mut sessions = [program(0, &text), program(1, &(text.clone() + ERROR))];
    let size = sessions[0].round().world().config().size;
    for tick in 0..120 {
        let mut packets = Vec::new();
        for (from, session) in sessions.iter_mut().enumerate() {
            let goal = Vec2::new(20.0 + 3.0 * tick as f32, 40.0 - 20.0 * from as f32);
            session.advance(Told::new(Intent::toward(goal).unwrap(), size));
            packets.extend(session.packets(tick).into_iter().map(|(to, bytes)| (from, to, bytes)));
        }
        packets.into_iter().for_each(|(from, to, bytes)| sessions[to].receive(from, &bytes, tick));
    }
    sessions
}

fn player(record: &[u8]) -> Player {
    Player::new(&Replay::read(record).unwrap()).unwrap()
}

#[test]
fn both_keep_the_step_of_the_digest_that_differs_and_a_record_up_to_it() {
    let sessions = parted();
    assert_eq!(sessions.each_ref().map(Session::desync), [Some(SHOWN); 2]);
    let rounds = sessions.each_ref().map(|session| session.parted().unwrap());
    let worlds = rounds.map(|round| World::from_snapshot(&round.world().to_snapshot().unwrap()).unwrap());
    assert_eq!(worlds.each_ref().map(World::step_index), [SHOWN; 2]);
    assert!(worlds[0].first_difference(&worlds[1]).is_some());
    let mut players = rounds.map(|round| player(&round.record().unwrap()));
    let differ = |step: u64, [one, other]: &[Player; 2]| (step, one.world().digest() != other.world().digest());
    let steps = (1..=SHOWN).map(|step| {
        assert!(players.iter_mut().all(|player| player.next().unwrap().is_ok()));
        differ(step, &players)
    });
    assert_eq!(steps.collect::<Vec<_>>(), (1..=SHOWN).map(|step| (step, step >= FIRST)).collect::<Vec<_>>());
    assert!(
        players
            .iter_mut()
            .zip(&worlds)
            .all(|(player, world)| { player.next().is_none() && player.world().digest() == world.digest() })
    );
}

#[test]
fn a_match_that_has_come_apart_stands_still_and_tells_the_others() {
    let mut sessions = parted();
    let frames = sessions.each_ref().map(Session::frame);
    assert!(sessions.iter_mut().all(|session| !session.advance(Told::default()) && session.packets(9).len() == 1));
    assert_eq!(sessions.each_ref().map(Session::frame), frames);
}

#[test]
#[ignore = "needs the command line"]
fn the_command_line_tells_the_files_apart() {
    let program = std::env::var("MICROSIM_SERVE").expect("MICROSIM_SERVE is a microsim");
    let folder = std::env::temp_dir().join(format!("microsim-desync-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    for (session, name) in parted().iter().zip(["a", "b"]) {
        let round = session.parted().unwrap();
        fs::write(folder.join(format!("{name}.replay")), round.record().unwrap()).unwrap();
        fs::write(folder.join(format!("{name}.snapshot")), round.world().to_snapshot().unwrap()).unwrap();
    }
    let diff = |one: &str, other: &str| {
        let output = Command::new(&program).current_dir(&folder).args(["diff", one, other]).output().unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    for (one, other, step) in [("a.replay", "b.replay", FIRST), ("a.snapshot", "b.snapshot", SHOWN)] {
        let (code, told) = diff(one, other);
        println!("{told}");
        assert!(code == Some(1) && told.starts_with(&format!("step {step}: ")), "{code:?} {told}");
    }
    // The inputs of the first one in the program of the second one.
    assert_eq!(diff("a.replay", "a.snapshot"), (Some(0), "no difference in the world\n".to_owned()));
    assert_eq!(diff("a.replay", "b.snapshot").0, Some(1));
    fs::remove_dir_all(&folder).unwrap();
}
