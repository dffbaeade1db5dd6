//! What a player of a match believes of what others send.

use super::*;
use crate::network::message::round_of;

/// A match of three, as one of them takes part.
fn session(own: usize) -> Session {
    Session::new(round_of(3, 1).unwrap(), own, Pacing::USUAL)
}

fn packet(ends: Vec<(u8, u32)>, runs: Vec<Run>) -> Vec<u8> {
    Packet {
        number: 1,
        frame: 0,
        advantage: 0,
        sent: 0,
        heard: None,
        known: vec![2; 3],
        ends,
        takeovers: Vec::new(),
        wants: false,
        runs,
        digest: None,
    }
    .write()
}

fn run(player: u8, count: usize) -> Vec<Run> {
    vec![Run { player, first: 2, told: vec![Told::default(); count] }]
}

#[test]
fn a_bot_that_steers_from_two_frames_on_is_a_draw() {
    let mut session = session(2);
    session.leave(0);
    session.receive(1, &packet(vec![(0, 2)], Vec::new()), 0);
    session.receive(1, &packet(vec![(0, 2)], Vec::new()), 0);
    assert_eq!(session.desync(), None);
    session.receive(1, &packet(vec![(0, 1)], Vec::new()), 0);
    assert!(session.desync().is_some());
}

#[test]
fn inputs_of_ones_own_are_of_the_near_future_and_what_is_passed_on_may_be_of_a_later_one() {
    let near = Pacing::USUAL.horizon() as usize - 2;
    let mut session = session(0);
    session.leave(2);
    session.receive(1, &packet(Vec::new(), run(1, near)), 0);
    session.receive(1, &packet(Vec::new(), run(2, 2 * near)), 0);
    assert_eq!(session.tally().refused, 0);
    session.receive(1, &packet(Vec::new(), run(1, near + 1)), 0);
    assert_eq!(session.tally().refused, 1);
}
