//! What a player of a match believes of what others send.

use super::*;
use crate::network::plan::{Way, round_of};
use microsim_core::Intent;
use microsim_core::glam::Vec2;

/// A match of three, as one of them takes part.
fn session(own: usize) -> Session {
    Session::new(round_of(Way::Versus, 3, 1).unwrap(), own, Pacing::USUAL)
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

/// A packet of one who watches.
fn watching(number: u32, frame: u32) -> Vec<u8> {
    let told = Packet::read(&packet(Vec::new(), Vec::new()), 3).unwrap();
    Packet { number, frame, known: vec![1000; 3], wants: true, ..told }.write()
}

/// The first of three players, alone since the others left, after 40 frames.
fn alone() -> Session {
    let mut session = session(0);
    [1, 2].into_iter().for_each(|player| session.leave(player));
    (0..40).for_each(|_| assert!(session.advance(Told::default())));
    session
}

#[test]
fn one_who_watches_and_knows_more_is_heard_and_one_who_is_far_behind_gets_no_cell() {
    let mut session = alone();
    session.receive_guest(3, &watching(1, 0), 0);
    assert_eq!((session.tally().refused, session.is_watched_by(3)), (0, true));
    assert!(session.wanting().is_empty());
    session.receive_guest(3, &watching(2, 39), 0);
    assert_eq!(session.wanting(), [3]);
}

#[test]
fn packets_to_one_who_watched_are_counted_on_when_it_plays_and_after_a_silence() {
    let mut session = alone();
    session.receive_guest(3, &watching(1, 39), 0);
    assert_eq!(session.guest_packets(0).len(), 1);
    assert!(session.guest_packets(SILENT).is_empty());
    session.receive_guest(3, &watching(2, 39), SILENT);
    let number = |bytes: &[u8]| Packet::read(bytes, 3).unwrap().number;
    assert_eq!(number(&session.guest_packets(SILENT)[0].1), 1);
    session.seat(1, 3);
    let packets = session.packets(SILENT);
    assert_eq!((packets[0].0, number(&packets[0].1)), (1, 2));
}

/// Longer than one who watches may be silent, ms.
const SILENT: u32 = 6000;

#[test]
fn frames_of_which_no_round_is_kept_are_not_taken_again() {
    let mut session = session(2);
    session.leave(1);
    session.receive(0, &packet(vec![(1, 2)], Vec::new()), 0);
    for frame in 0..100 {
        session.receive(
            0,
            &packet(vec![(1, 2)], vec![Run { player: 0, first: 2 + frame, told: vec![Told::default()] }]),
            0,
        );
        assert!(session.advance(Told::default()));
    }
    // The first player says that the bot's cell has been somebody's for long, and that one steers otherwise.
    let told = Packet::read(&packet(vec![(1, 2)], Vec::new()), 3).unwrap();
    let takeovers = vec![Takeover { player: 1, member: 3, end: 2, since: 3 }];
    session.receive(0, &Packet { number: 2, ends: Vec::new(), takeovers, ..told.clone() }.write(), 0);
    let goal = Intent::toward(Vec2::new(9.0, 9.0)).unwrap();
    let size = session.round().world().config().size;
    let runs = vec![Run { player: 1, first: 3, told: vec![Told::new(goal, size); 9] }];
    session.receive(1, &Packet { number: 1, ends: Vec::new(), runs, ..told }.write(), 0);
    session.advance(Told::default());
    assert!(session.desync().is_some());
    assert!(session.tally().repeated <= Pacing::USUAL.kept(), "{}", session.tally().repeated);
}

#[test]
fn a_takeover_from_a_far_frame_on_is_refused() {
    let mut session = session(2);
    let told = Packet::read(&packet(Vec::new(), Vec::new()), 3).unwrap();
    let last = 2 * Pacing::USUAL.horizon();
    for (since, expected) in [(last + 1, (1, None)), (last, (1, Some(3)))] {
        let takeovers = vec![Takeover { player: 1, member: 3, end: 2, since }];
        session.receive(0, &Packet { takeovers, ..told.clone() }.write(), 0);
        assert_eq!((session.tally().refused, session.successor(1)), expected);
    }
}

#[test]
fn who_takes_over_before_it_knows_what_its_cell_was_told_is_told_that() {
    let mut session = session(0);
    session.receive(1, &packet(Vec::new(), run(1, 4)), 0);
    session.leave(1);
    let mut guest = Session::watch(round_of(Way::Versus, 3, 1).unwrap(), 3, Pacing::USUAL);
    let told = Packet::read(&packet(Vec::new(), Vec::new()), 3).unwrap();
    session.receive_guest(3, &Packet { wants: true, ..told }.write(), 0);
    session.seat(1, 3);
    assert_eq!((session.successor(1), guest.own()), (Some(3), None));
    for now in 0..2 {
        let packets = session.packets(now);
        let (_, bytes) = packets.into_iter().find(|(to, _)| *to == 1).unwrap();
        guest.receive(0, &bytes, now);
    }
    assert_eq!((guest.own(), guest.told(1).0.len()), (Some(1), session.told(1).0.len()));
}

#[test]
fn a_second_is_a_second_at_any_number_of_frames() {
    for (pacing, frames) in [(Pacing::USUAL, 30), (Pacing::QUICK, 60)] {
        let session = Session::watch(round_of(Way::Versus, 2, 1).unwrap(), 3, pacing);
        assert!((session.seconds(frames) - 1.0).abs() < 1e-5, "{pacing:?}");
    }
}
