//! Rounds of several players.

use super::bites::cytoplasm;
use super::*;
use crate::rules::bot::{Bot, Policy};
use crate::rules::round::Round;
use microsim_core::Intent;
use microsim_core::glam::Vec2;
use microsim_core::replay::Replay;
use microsim_core::scenario::Scenario;

/// A round of the real scene.
fn round(players: usize) -> Round {
    Round::new(&Scenario::parse(&text(players), &[]).unwrap()).unwrap()
}

/// A small room with cells of these radii and places, of a player each.
fn room(cells: &[(f32, [f32; 2])]) -> Round {
    let mut text = "schema = 1\nname = \"food-chain\"\n[game]\n[world]\nsize = [90.0, 60.0]\n".to_owned();
    for (k, (radius, _)) in cells.iter().enumerate() {
        text += &format!("[amoeboid_cell.cell-{k}]\nradii = [{radius}, {radius}]\n");
        text += &format!("[amoeboid_cell.cell-{k}.division]\nleast_particles = 12\n");
    }
    for (k, (_, at)) in cells.iter().enumerate() {
        let name = if k == 0 { "player = true".to_owned() } else { format!("name = \"player-{}\"", k + 1) };
        text += &format!("[[spawn]]\nof = \"cell-{k}\"\n{name}\nat = {at:?}\n");
    }
    Round::new(&Scenario::parse(&text, &[]).unwrap()).unwrap()
}

/// Four that do not reach each other, the third the largest.
fn four() -> Round {
    room(&[(6.5, [12.0, 12.0]), (5.0, [75.0, 12.0]), (10.0, [72.0, 43.0]), (7.0, [14.0, 46.0])])
}

fn rest(round: &mut Round, steps: u32) {
    (0..steps).for_each(|_| round.step_all(&[Intent::REST; 4]));
}

fn cell(round: &Round, player: usize) -> OrganismView<'_> {
    round.world().view().organism(round.players().nth(player).unwrap()).unwrap()
}

/// Plays a record to its end.
fn again(round: &Round) -> Round {
    let mut again = Round::again(&Replay::read(&round.record().unwrap()).unwrap()).unwrap();
    while !again.is_over() {
        again.step(Intent::REST);
    }
    again
}

#[test]
fn each_line_lives_as_long_as_it_can_and_the_round_as_long_as_the_last() {
    for players in 2..=4 {
        let cells = [(6.5, [12.0, 12.0]), (7.5, [70.0, 15.0]), (5.0, [72.0, 48.0]), (5.75, [12.0, 48.0])];
        let mut round = room(&cells[..players]);
        round.act(1, Deed::Divide);
        let first: Vec<OrganismId> = round.players().collect();
        let here = first.iter().map(|&cell| Intent::toward(round.world().centroid(cell).unwrap()).unwrap());
        let here: Vec<Intent> = here.collect();
        let mut ends = vec![0.0; players];
        while !round.is_over() && round.world().time() < 60.0 {
            round.step_all(&here);
            let now = round.world().time() as f32;
            for player in (0..players).filter(|&player| !round.chain().unwrap().is_gone(player)) {
                assert_eq!(line_of(cell(&round, player)), Some(player), "nobody plays another one's cell");
                ends[player] = now;
            }
        }
        assert!(round.is_over() && first[1] != round.players().nth(1).unwrap(), "the sister was played");
        let lives: Vec<f32> = round.chain().unwrap().lives(99.0).collect();
        let dt = round.world().config().dt;
        assert!(lives.iter().zip(&ends).all(|(life, end)| (life - end - dt).abs() < 1e-3), "{lives:?} {ends:?}");
        assert!((1..players).all(|k| lives[..k].iter().all(|life| (life - lives[k]).abs() > 0.5)), "{lives:?}");
        assert_eq!(round.scores(), lives.iter().map(|life| *life as u32).collect::<Vec<_>>());
        assert!((0..players).all(|player| round.chain().unwrap().fate(player) == Some(Fate::Starved)));
        let again = again(&round);
        assert_eq!((again.mismatch(), again.scores()), (None, round.scores()));
    }
}

#[test]
fn offers_changes_and_divisions_are_of_one_player() {
    let mut round = four();
    rest(&mut round, 1);
    let changes = |round: &Round| [0, 1, 2, 3].map(|player| changes(cell(round, player)));
    assert_eq!([0, 1, 2, 3].map(|player| round.offer(player).is_some()), [false, false, true, false]);
    let offer = round.offer(2).unwrap();
    for player in [0, 1, 3, 4, 9] {
        round.act(player, Deed::Choose(0));
    }
    round.act(2, Deed::Choose(3));
    assert_eq!((changes(&round), round.offer(2)), ([0; 4], Some(offer)), "nothing was offered");
    round.act(2, Deed::Choose(1));
    assert_eq!((changes(&round), offer[1].count(cell(&round, 2)), round.offer(2)), ([0, 0, 1, 0], 1, None));
    round.act(3, Deed::Divide);
    round.act(9, Deed::Divide);
    rest(&mut round, 1);
    let dividing = [0, 1, 2, 3].map(|player| cell(&round, player).dividing_for().is_some());
    assert_eq!(dividing, [false, false, false, true]);
}

#[test]
fn cells_of_different_players_bite_each_other_and_the_eater_grows() {
    let mut round = room(&[(5.0, [15.0, 30.0]), (9.5, [30.5, 30.0])]);
    let goal = Intent::toward(Vec2::new(5.0, 30.0)).unwrap();
    let mut growth = 0;
    while !round.chain().unwrap().is_gone(0) && round.world().time() < 20.0 {
        let before = cytoplasm(cell(&round, 1));
        round.step_all(&[Intent::REST, goal]);
        growth += cytoplasm(cell(&round, 1)).saturating_sub(before);
        assert_eq!(round.world().census().leaks, 0);
    }
    let chain = round.chain().unwrap();
    assert_eq!((chain.fate(0), chain.eater(0), chain.eater(1)), (Some(Fate::Eaten), round.players().nth(1), None));
    assert_eq!(round.eater(), None, "somebody lives on");
    assert!(growth > 0 && !round.is_over(), "the eater lives on, and has grown");
    let [threats, victims, _] = others(four().world().view(), four().players().next().unwrap());
    assert!(threats.is_empty() && victims.is_empty(), "cells of no line, before the first step");
}

#[test]
fn an_amoeba_is_a_threat_a_victim_or_an_equal() {
    for (radius, expected) in [(9.5, [1, 0, 0]), (5.2, [0, 0, 1]), (3.5, [0, 1, 0])] {
        let mut round = room(&[(5.0, [15.0, 30.0]), (radius, [60.0, 30.0])]);
        round.step_all(&[Intent::REST; 2]);
        let (view, own) = (round.world().view(), round.players().next().unwrap());
        let others = others(view, own);
        assert_eq!(others.map(|others| others.len()), expected, "radius {radius}");
    }
}

#[test]
fn up_to_four_play_the_scene_and_their_round_plays_again_as_it_was() {
    for players in 2..=4 {
        let mut round = round(players);
        assert_eq!(round.players().count(), players);
        round.act(players - 1, Deed::Divide);
        let mut bots: Vec<_> = (0..players).map(|k| Bot::new(Policy::Greedy, k as u64)).collect();
        while round.world().time() < 3.0 {
            let cells: Vec<_> = round.players().collect();
            let intents: Vec<_> = (0..players).map(|k| bots[k].intent(round.world(), cells[k])).collect();
            round.step_all(&intents);
        }
        let again = again(&round);
        assert_eq!((again.mismatch(), again.scores()), (None, round.scores()));
        assert_eq!(again.world().digest(), round.world().digest());
    }
}

#[test]
fn a_round_that_was_taken_back_goes_on_as_before() {
    let play = |round: &mut Round| {
        round.act(2, Deed::Choose(2));
        round.act(3, Deed::Divide);
        rest(round, 300);
        let offers = [0, 1, 2, 3].map(|player| round.offer(player));
        (round.world().digest(), round.scores(), offers, round.record())
    };
    let mut played = four();
    rest(&mut played, 60);
    let mut kept = round(2);
    kept.clone_from(&played);
    let first = play(&mut played);
    assert_ne!(first.2, [0, 1, 2, 3].map(|player| kept.offer(player)), "it has gone on");
    played.clone_from(&kept);
    assert_eq!(play(&mut played), first);
}

#[test]
fn a_round_of_one_has_the_scene_the_offers_and_the_mark_that_it_had() {
    assert_eq!(text(1), TEXT);
    let mut line = Line::new(1, 0);
    line.offer_changes();
    assert_eq!(line.offer, Some([Change::Coat, Change::Thrift, Change::Speed]));
    let mut round = round(1);
    round.step(Intent::REST);
    assert_eq!(cell(&round, 0).user_data(), 1);
}
