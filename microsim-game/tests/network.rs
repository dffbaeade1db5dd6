//! Matches over a network inside one process: all get the world that one process computes from the same inputs.

#[path = "common/virtual_match.rs"]
#[allow(dead_code, reason = "the example uses the rest")]
mod virtual_match;

use microsim_core::Rng;
use microsim_core::scenario::Scenario;
use microsim_game::network::pacing::Pacing;
use microsim_game::network::session::Session;
use microsim_game::rules::round::Round;
use microsim_game::rules::two_players;
use proptest::prelude::*;
use virtual_match::{Match, Weather, round};

const WILD: Weather = Weather { latency: 80.0, jitter: 60.0, loss: 0.1, doubled: 0.1, bursts: 0.1, cut: [0, 0] };

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
fn a_cut_stops_the_others_and_no_longer_than_it_lasts() {
    let game = play(2, Pacing::USUAL, Weather { latency: 30.0, cut: [500, 1700], ..Weather::default() });
    assert!(game.sessions[1].tally().waits >= 15 && game.now < 8000.0, "{:?}, {}", game.sessions[1].tally(), game.now);
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
