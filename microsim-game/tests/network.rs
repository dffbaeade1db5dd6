//! Matches over a network inside one process: all get the world that one process computes from the same inputs.

#[path = "common/virtual_match.rs"]
#[allow(dead_code, reason = "the example uses the rest")]
mod virtual_match;

use microsim_core::Rng;
use microsim_core::scenario::Scenario;
use microsim_game::network::rollback_pacing::Pacing;
use microsim_game::network::session::Session;
use microsim_game::network::told::Told;
use microsim_game::rules::food_chain::change::{self, changes};
use microsim_game::rules::food_chain::{self, Deed};
use microsim_game::rules::round::Round;
use microsim_game::rules::two_players;
use proptest::prelude::*;
use virtual_match::{Cut, Match, Weather, round};

const WILD: Weather = Weather { latency: 80.0, jitter: 60.0, loss: 0.1, doubled: 0.1, bursts: 0.1 };

fn play(players: usize, pacing: Pacing, weather: Weather) -> Match {
    let mut game = Match::new(players, 3.0, pacing, weather, 1);
    game.play();
    game.check();
    game
}

#[test]
fn a_good_network_costs_little() {
    let game = play(2, Pacing::USUAL, Weather { latency: 20.0, ..Weather::default() });
    let tally = game.sessions[0].tally();
    assert_eq!((tally.rollbacks, tally.refused), (0, 0), "the delay of the input is longer than the way: {tally:?}");
}

#[test]
fn messages_that_are_late_lost_doubled_and_out_of_order_make_the_same_world() {
    for (players, pacing) in [(2, Pacing::USUAL), (3, Pacing::USUAL), (2, Pacing::QUICK)] {
        let game = play(players, pacing, WILD);
        let tally = game.sessions[0].tally();
        assert!(tally.rollbacks > 0 && tally.deepest <= pacing.window && tally.refused == 0, "{tally:?}");
    }
}

#[test]
fn a_slow_machine_predicts_fewer_frames_in_the_same_world() {
    for (pacing, cost, expected) in [(Pacing::USUAL, 9.0, 5), (Pacing::QUICK, 9.0, 5), (Pacing::USUAL, 500.0, 3)] {
        let weather = Weather { latency: 250.0, jitter: 60.0, ..Weather::default() };
        let mut game = Match::new(2, 8.0, pacing, weather, 1);
        game.cost[1] = cost;
        let mut most = [0; 2];
        while !game.is_over() {
            game.tick();
            assert!(game.now < 60_000.0, "nobody waits for ever");
            let predicted = |session: &Session| session.frame().saturating_sub(session.final_frame());
            let is_on = game.now > 4000.0 && game.sessions.iter().all(|session| session.frames_over() == 0);
            for (most, session) in most.iter_mut().zip(&game.sessions).filter(|_| is_on) {
                *most = predicted(session).max(*most);
            }
        }
        game.check();
        assert_eq!(game.sessions.iter().map(Session::window).collect::<Vec<_>>(), [pacing.window, expected]);
        assert!(most[1] == expected && most[0] > expected, "{most:?}");
    }
}

#[test]
fn a_cut_stops_the_others_and_no_longer_than_it_lasts() {
    let mut game = Match::new(2, 3.0, Pacing::USUAL, Weather { latency: 30.0, ..Weather::default() }, 1);
    game.cuts = vec![Cut { from: 0, to: 1, time: 500..1700 }];
    game.play();
    game.check();
    assert!(game.sessions[1].tally().waits >= 15 && game.now < 8000.0, "{:?}, {}", game.sessions[1].tally(), game.now);
}

/// By member: frames that were left out to wait for others, of those that were taken, and the most in a row.
fn waits(game: &Match) -> Vec<(f32, u32)> {
    let share = |session: &Session| session.tally().waits as f32 / session.frame() as f32;
    game.sessions.iter().map(share).zip(game.longest_wait.iter().copied()).collect()
}

#[test]
fn clocks_that_differ_by_three_in_a_hundred_cost_single_frames() {
    let slow = |member, _| if member == 0 { 0.97 } else { 1.0 };
    let fast = |member, _| if member == 0 { 1.03 } else { 1.0 };
    for (players, speed) in [(2, slow as fn(usize, f32) -> f32), (2, fast), (3, slow)] {
        let mut game = Match::new(players, 12.0, Pacing::USUAL, Weather { latency: 40.0, ..Weather::default() }, 6);
        game.speed = speed;
        game.play();
        game.check();
        let waits = waits(&game);
        assert!(waits.iter().all(|&(share, longest)| share < 0.05 && longest <= 1), "{waits:?}");
        assert!(waits.iter().any(|&(share, _)| share > 0.02), "the faster one waits: {waits:?}");
        assert!(game.sessions.iter().all(|session| session.tally().deepest < 4), "nobody is far ahead");
    }
}

#[test]
fn one_who_makes_every_second_frame_for_a_while_halves_the_pace_and_stops_nobody() {
    let mut game = Match::new(3, 9.0, Pacing::USUAL, Weather { latency: 40.0, jitter: 10.0, ..Weather::default() }, 6);
    game.speed = |member, now| if member == 2 && (2000.0..5000.0).contains(&now) { 0.5 } else { 1.0 };
    game.play();
    game.check();
    let waits = waits(&game);
    assert!(waits[2] == (0.0, 0) && waits.iter().all(|&(_, longest)| longest <= 3), "{waits:?}");
    assert!(game.now < 11_000.0, "the match takes as much longer as the half of 3 s: {} ms", game.now);
}

#[test]
fn a_bot_takes_over_from_those_who_leave_in_the_same_frame_for_all() {
    for leaving in [vec![(1, 900)], vec![(0, 700), (2, 1500)]] {
        let weather = Weather { latency: 60.0, jitter: 50.0, loss: 0.05, ..Weather::default() };
        let mut game = Match::new(3, 3.0, Pacing::USUAL, weather, 2);
        game.leaving = leaving;
        game.play();
        game.check();
    }
}

const ROUGH: Weather = Weather { latency: 60.0, jitter: 50.0, loss: 0.05, doubled: 0.05, bursts: 0.05 };

/// Frames in which a player's own hand steered.
fn steered(session: &Session, player: usize, frames: std::ops::Range<usize>) -> usize {
    session.told(player).0[frames].iter().filter(|told| **told != Told::BOT).count()
}

#[test]
fn who_was_cut_comes_back_and_takes_its_cell_from_the_bot_in_the_same_frame_for_all() {
    for (players, cut) in [(2, 1), (2, 0), (3, 0)] {
        let mut game = Match::new(players, 8.0, Pacing::USUAL, ROUGH, 3);
        (game.leaving, game.coming) = (vec![(cut, 1000)], vec![(cut, 3000)]);
        game.play();
        game.check();
        for session in &game.sessions {
            assert_eq!((session.own().is_some(), session.successor(cut)), (true, Some(cut as u8)));
            assert!(steered(session, cut, 40..90) == 0, "a bot steers while it is away");
            assert!(steered(session, cut, 180..240) > 55, "it steers again");
        }
    }
}

#[test]
fn one_can_be_cut_again_and_another_one_after_it() {
    let mut game = Match::new(2, 12.0, Pacing::USUAL, ROUGH, 4);
    game.leaving = vec![(0, 700), (0, 5000), (1, 8000)];
    game.coming = vec![(0, 1500), (0, 6000), (1, 8600)];
    game.play();
    game.check();
    assert!(game.sessions.iter().all(|session| session.own().is_some()));
}

#[test]
fn who_comes_late_takes_a_bots_cell_and_else_watches_without_slowing_anybody() {
    let mut game = Match::new(2, 8.0, Pacing::USUAL, Weather { latency: 40.0, ..Weather::default() }, 5);
    game.coming = vec![(2, 1000)];
    game.play();
    game.check();
    assert_eq!(game.sessions[2].own(), None);
    assert!(game.sessions[..2].iter().all(|session| session.tally().waits < 5), "{:?}", game.sessions[0].tally());
    let mut game = Match::new(2, 8.0, Pacing::USUAL, ROUGH, 5);
    (game.coming, game.leaving) = (vec![(2, 500), (3, 900)], vec![(0, 2000)]);
    game.play();
    game.check();
    let seats: Vec<Option<usize>> = game.sessions[1..].iter().map(Session::own).collect();
    assert!(seats == [Some(1), Some(0), None] || seats == [Some(1), None, Some(0)], "{seats:?}");
}

/// A food chain of three in a small room: the second cell is large enough for a change, and the third is small and starves within seconds.
const CHAIN: &str = r#"
    schema = 1
    name = "food-chain"
    [game]
    time = 6.0
    [world]
    size = [90.0, 60.0]
    [amoeboid_cell.cell]
    radii = [7.5, 7.5]
    division = { least_particles = 12, least_nodes = 8 }
    [amoeboid_cell.large]
    radii = [11.0, 11.0]
    division = { least_particles = 12, least_nodes = 8 }
    [amoeboid_cell.small]
    radii = [4.0, 4.0]
    division = { least_particles = 12, least_nodes = 8 }
    [agar.pellet]
    radius = 1.1
    [[spawn]]
    of = "cell"
    player = true
    at = [12.0, 12.0]
    [[spawn]]
    of = "large"
    name = "player-2"
    at = [72.0, 45.0]
    [[spawn]]
    of = "small"
    name = "player-3"
    at = [12.0, 48.0]
    [[spawn]]
    of = "pellet"
    count = 20
    gap = 0.5
"#;

/// A match of it in which the second player takes the third change, and both divide, as soon as they do not take something in.
fn chain(weather: Weather) -> Match {
    let start = Round::new(&Scenario::parse(CHAIN, &[]).unwrap()).unwrap();
    let mut game = Match::of(start, 6.0, Pacing::USUAL, weather, 7);
    game.deed = |member, frame| match (member, frame) {
        (1, 20) => Some(Deed::Choose(2)),
        (0 | 1, 30..120) if frame % 10 == 0 => Some(Deed::Divide),
        _ => None,
    };
    game
}

/// Changes of the cell of each player that has one, and cells of each line; one that divides counts twice.
fn bodies(round: &Round) -> Vec<(Option<u32>, usize)> {
    let cells = || round.world().view().organisms();
    let of = |(player, cell)| {
        let own = cells().find(|other| other.id() == cell).map(changes);
        let line = cells().filter(|other| change::line_of(*other) == Some(player));
        (own, line.map(|cell| 1 + usize::from(cell.dividing_for().is_some())).sum())
    };
    round.players().enumerate().map(of).collect()
}

#[test]
fn a_choice_and_a_division_count_in_the_same_frame_for_all() {
    let mut game = chain(WILD);
    game.play();
    game.check();
    for session in &game.sessions {
        let bodies = bodies(session.round());
        assert_eq!([0, 1, 2].map(|player| bodies[player].0), [Some(0), Some(1), None]);
        assert!(bodies[0].1 > 1 && bodies[1].1 > 1 && bodies[2].1 == 0, "{bodies:?}");
        assert!(session.round().chain().unwrap().is_gone(2) && session.tally().rollbacks > 0);
        let scores = session.round().scores();
        assert!(scores[2] < scores[0] && scores[0] == scores[1], "{scores:?}");
    }
}

#[test]
fn a_bot_goes_on_with_the_line_of_one_who_left_and_takes_a_change() {
    let mut game = chain(ROUGH);
    game.deed = |_, _| None;
    game.leaving = vec![(1, 1000)];
    game.play();
    game.check();
    let left = game.sessions[0].round();
    let changes = bodies(left)[1].0;
    assert!(changes.is_some_and(|changes| changes > 0) && left.offer(1).is_none(), "{changes:?}");
}

#[test]
fn a_match_of_the_whole_scene_of_the_food_chain_is_the_same_for_all() {
    let time = ("game.time".to_owned(), "2".to_owned());
    let start = Round::new(&Scenario::parse(&food_chain::text(4), &[time]).unwrap()).unwrap();
    let mut game = Match::of(start, 2.0, Pacing::USUAL, ROUGH, 8);
    game.deed = |member, frame| match frame.checked_sub(member as u32) {
        Some(4) => Some(Deed::Lunge),
        Some(10) => Some(Deed::Divide),
        _ => None,
    };
    game.play();
    game.check();
    let recovers = |session: &Session| (0..4).all(|player| session.round().lunge_of(player).recovered().is_some());
    assert!(game.sessions.iter().all(recovers), "each has lunged");
}

#[test]
fn worlds_that_differ_are_found_within_two_seconds() {
    let mut other = Scenario::parse(&two_players::text(2), &[]).unwrap();
    other.set_seed(6);
    let rounds = [round(2, 90.0), Round::new(&other).unwrap()];
    let mut sessions: Vec<Session> =
        rounds.into_iter().enumerate().map(|(own, round)| Session::new(round, own, Pacing::USUAL)).collect();
    for tick in 0..70 {
        for k in 0..2 {
            sessions[k].advance(Default::default());
            for (to, bytes) in sessions[k].packets(tick) {
                sessions[to].receive(k, &bytes, tick);
            }
        }
    }
    assert_eq!(sessions.iter().map(Session::desync).collect::<Vec<_>>(), [Some(60), Some(60)]);
}

prop_compose! {
    fn weather()(
        latency in 0.0f32..150.0,
        jitter in 0.0f32..120.0,
        loss in 0.0f32..0.3,
        doubled in 0.0f32..0.5,
        bursts in 0.0f32..0.3,
    ) -> Weather {
        Weather { latency, jitter, loss, doubled, bursts }
    }
}

/// One-way cuts between any two of so many players.
fn cuts(players: usize) -> impl Strategy<Value = Vec<Cut>> {
    let cut = (0..players, 0..players, 0..3000u32, 0..2500u32);
    prop::collection::vec(cut.prop_map(|(from, to, at, length)| Cut { from, to, time: at..at + length }), 0..5)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, failure_persistence: None, ..ProptestConfig::default() })]

    /// Packets that are late, lost, doubled, out of order, in bursts, or cut off one way; one may leave and come back.
    #[test]
    fn any_schedule_of_packets_makes_the_world_of_one_process(
        (players, cuts) in (2usize..=4).prop_flat_map(|players| (Just(players), cuts(players))),
        is_quick in any::<bool>(),
        weather in weather(),
        seed in any::<u64>(),
        leaves in prop::option::of((0u32..4000, 500u32..3000)),
        cost in prop::array::uniform4(0.0f32..60.0),
    ) {
        let pacing = if is_quick { Pacing::QUICK } else { Pacing::USUAL };
        let mut game = Match::new(players, 4.0, pacing, weather, seed);
        (game.cuts, game.cost) = (cuts, cost);
        if let Some((left, away)) = leaves {
            let who = seed as usize % players;
            (game.leaving, game.coming) = (vec![(who, left)], vec![(who, left + away)]);
        }
        game.play();
        game.check();
        let tallies: Vec<_> = game.sessions.iter().map(Session::tally).collect();
        prop_assert!(leaves.is_some() || tallies.iter().all(|tally| tally.refused == 0 && tally.deepest <= pacing.window), "{tallies:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Bytes of strangers, and packets with some bytes changed.
    #[test]
    fn no_bytes_stop_a_match(seed in any::<u64>(), garbage in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut rng = Rng::new(seed, 1);
        let mut sessions: Vec<Session> = (0..3).map(|own| Session::new(round(3, 1.0), own, Pacing::USUAL)).collect();
        for tick in 0..4 {
            let mut packets = Vec::new();
            for (k, session) in sessions.iter_mut().enumerate() {
                session.advance(Default::default());
                packets.extend(session.packets(tick).into_iter().map(|(to, bytes)| (k, to, bytes)));
            }
            for (from, to, mut bytes) in packets {
                sessions[to].receive(from, &garbage, tick);
                for _ in 0..rng.next_u32() % 4 {
                    let at = rng.next_u32() as usize % bytes.len();
                    bytes[at] = rng.next_u32() as u8;
                }
                if rng.unit() < 0.1 {
                    sessions[to].leave(from);
                }
                sessions[to].receive(from, &bytes, tick);
            }
        }
    }
}
