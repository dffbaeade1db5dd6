//! What a round of the food chain shows, alone or in a match.

use super::steer::first_advice;
use crate::draw::palette::ALERT;
use crate::hud::marks::Style;
use crate::hud::{food_chain, own};
use crate::rules::food_chain::change::line_of;
use crate::rules::food_chain::{Fate, FoodChain, others};
use crate::rules::lesson::FirstDeed;
use crate::rules::round::Round;
use crate::rules::threat::{Other, engulfers};
use crate::ui::pen::Pen;
use crate::words::{self, Key};
use microsim_core::glam::Vec2;
use microsim_core::{OrganismId, OrganismView, View};

/// Time until the cell starves that fills the bar, s.
const FULL_RESERVE: f32 = 60.0;

/// Distance within which somebody who can bite is near, units.
const HUNTED: f32 = 35.0;

/// Area from which an amoeba is a giant, square units: rivals begin with half of it.
const GIANT_AREA: f32 = 400.0;

/// When the first rival and the first giant come, as the scene says, and how long before the player is warned of them, s.
const RIVALS: f64 = 65.0;
const GIANTS: f64 = 100.0;
const WARNING: f64 = 5.0;

/// What a newcomer has to do first is explained until it is done; else what is new when it is there first, and what is dangerous before.
/// `divide` is what is written on the key that divides.
pub(super) fn advice(time: f64, first: Option<FirstDeed>, divide: &str, has_buttons: bool) -> Option<String> {
    let divide = if has_buttons { words::text(Key::HintChainButton) } else { divide };
    let of = |key| words::text(key).to_owned();
    let parts = [
        (6.0, of(Key::HintChainClock)),
        (25.0, words::text_with(Key::HintChainDivide, &[("key", divide.into())])),
        (RIVALS - WARNING, of(Key::HintChainRivals)),
        (GIANTS - WARNING, of(Key::HintChainGiant)),
    ];
    let of_time = parts.into_iter().find(|(from, _)| (*from..from + 6.0).contains(&time)).map(|(_, text)| text);
    first.map(|deed| first_advice(deed, has_buttons)).or(of_time)
}

/// What a ghost is, after what the game is.
pub(super) fn ghost_advice(time: f64) -> Option<String> {
    (12.0..18.0).contains(&time).then(|| words::text(Key::HintChainGhost).to_owned())
}

/// What the status says of a cell: how long its line has lived, and time until it starves.
pub(super) fn status(round: &Round, cell: OrganismId) -> Option<(String, [f32; 2])> {
    let (chain, world) = (round.chain()?, round.world());
    let cell = world.view().organism(cell)?;
    // Before the first step nobody is of a line.
    let is_of_line = |other: &OrganismView<'_>| line_of(cell).is_some() && line_of(*other) == line_of(cell);
    let line = world.view().organisms().filter(is_of_line).count();
    let time = world.time() as f32;
    let reserve = chain.reserve(cell, time).min(FULL_RESERVE);
    let sizes = [chain.size(cell), FoodChain::next_size(cell)];
    Some((food_chain::summary(time, sizes, line.saturating_sub(1)), [reserve, FULL_RESERVE]))
}

/// The cell that is looked at: that of a player, or of the first one who lives.
pub(super) fn seen(round: &Round, player: Option<usize>) -> Option<OrganismId> {
    let is_there = |cell: &OrganismId| round.world().view().organism(*cell).is_some();
    let own = player.and_then(|player| round.players().nth(player));
    own.filter(is_there).or_else(|| round.players().find(is_there))
}

/// Whether somebody is near who can bite a cell.
pub(super) fn is_hunted(round: &Round, view: View<'_>, cell: OrganismId) -> bool {
    round.chain().is_some() && others(view, cell)[0].iter().any(|threat| threat.distance < HUNTED)
}

/// Marks who ate the own cell, or says at the place of its end that it starved.
pub(super) fn draw_end(pen: &mut Pen, style: &Style<'_>, round: &Round, view: View<'_>, place: Vec2) {
    let starved = round.chain().is_some_and(|chain| chain.fate(0) == Some(Fate::Starved));
    if let Some(eater) = round.eater().and_then(|eater| view.organism(eater)) {
        let is_giant = eater.spawn_area() > GIANT_AREA;
        let name = match round.chain() {
            None => Key::SlideEndTaken,
            Some(_) if is_giant => Key::HudEatenByGiant,
            Some(_) => Key::HudEatenByRival,
        };
        own::draw_rim(pen, style, eater, ALERT, own::EATER);
        food_chain::draw_fate(pen, style, eater.centroid(), name);
    } else if starved && round.is_over() {
        food_chain::draw_fate(pen, style, place, Key::HudStarved);
    }
}

/// Marks how the bodies of all players have changed, and for one cell who can bite it and whom it can bite. Who plays it is told when
/// it is bitten. Of other rounds it marks who can take the cell in.
pub(super) fn draw(
    pen: &mut Pen,
    style: &Style<'_>,
    round: &Round,
    view: View<'_>,
    (cell, is_played): (OrganismId, bool),
) {
    let Some(chain) = round.chain() else {
        // Who has it inside is still seen.
        let own = view.organism(cell);
        let holder = own.and_then(|own| Some(Other::seen(view.organism(own.held_by()?)?, own)));
        let threats = holder.map_or_else(|| engulfers(view, cell), |holder| vec![holder]);
        food_chain::draw_others(pen, style, view, &[threats, Vec::new()]);
        return;
    };
    let [threats, victims, equals] = others(view, cell);
    food_chain::draw_others(pen, style, view, &[threats, victims]);
    food_chain::draw_equals(pen, style, view, &equals);
    let cells = round.players().filter_map(|cell| view.organism(cell));
    cells.for_each(|cell| food_chain::draw_changes(pen, style, cell));
    if is_played && chain.is_bitten(cell) {
        food_chain::draw_bitten(pen);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::food_chain;
    use microsim_core::Intent;
    use microsim_core::scenario::Scenario;

    /// Two cells, of which the first starves sooner.
    const TEXT: &str = r#"
        schema = 1
        name = "food-chain"
        [game]
        [world]
        size = [90.0, 60.0]
        [amoeboid_cell.small]
        radii = [4.0, 4.0]
        [amoeboid_cell.large]
        radii = [9.0, 9.0]
        [[spawn]]
        of = "small"
        player = true
        at = [20.0, 30.0]
        [[spawn]]
        of = "large"
        name = "player-2"
        at = [70.0, 30.0]
    "#;

    #[test]
    fn of_rivals_and_giants_one_is_warned_before_the_first_of_them_comes() {
        let first = |of: &str| {
            let spawns = food_chain::TEXT.split("[[spawn]]").filter(|spawn| spawn.contains(of));
            let from = spawns.filter_map(|spawn| spawn.split("from = ").nth(1)?.lines().next()?.parse::<f64>().ok());
            from.fold(f64::MAX, f64::min)
        };
        for (of, hint) in [("of = \"rival\"", Key::HintChainRivals), ("of = \"giant\"", Key::HintChainGiant)] {
            let told = |before: f64| advice(first(of) - before, None, "X", false);
            assert_eq!(told(3.0).as_deref(), Some(words::text(hint)), "{of}");
            assert_eq!(told(8.0), None);
        }
    }

    #[test]
    fn a_ghost_is_explained_while_nothing_else_is() {
        let times: Vec<f64> = (0..600).map(f64::from).filter(|time| ghost_advice(*time).is_some()).collect();
        assert!(times.len() == 6 && times.iter().all(|time| advice(*time, None, "X", false).is_none()), "{times:?}");
    }

    #[test]
    fn the_status_tells_from_which_size_on_the_body_changes() {
        let round = Round::new(&Scenario::parse(TEXT, &[]).unwrap()).unwrap();
        let (told, _) = status(&round, round.player()).unwrap();
        assert_eq!(told, "Lived 0 s   Size 1.0, new body at 1.3");
    }

    #[test]
    fn the_own_cell_is_looked_at_and_when_it_is_gone_that_of_the_first_who_lives() {
        let mut round = Round::new(&Scenario::parse(TEXT, &[]).unwrap()).unwrap();
        let cells: Vec<OrganismId> = round.players().collect();
        let looked_at = |round: &Round| [Some(0), Some(1), None].map(|player| seen(round, player));
        assert_eq!(looked_at(&round), [cells[0], cells[1], cells[0]].map(Some));
        while round.world().view().organism(cells[0]).is_some() {
            round.step_all(&[Intent::REST; 2]);
        }
        assert_eq!(looked_at(&round), [Some(cells[1]); 3]);
        while !round.is_over() {
            round.step_all(&[Intent::REST; 2]);
        }
        assert_eq!(looked_at(&round), [None; 3]);
    }
}
