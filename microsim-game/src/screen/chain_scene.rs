//! What a round of the food chain shows, alone or in a match.

use super::steer::held_to_crawl;
use crate::hud::food_chain;
use crate::hud::marks::Style;
use crate::rules::food_chain::change::line_of;
use crate::rules::food_chain::threats_and_victims;
use crate::rules::round::Round;
use crate::ui::pen::Pen;
use crate::words::{self, Key};
use microsim_core::{OrganismId, View};

/// Time until the cell starves that fills the bar, s.
const FULL_RESERVE: f32 = 60.0;

/// What is new is explained when it is there first. `divide` is what is written on the key that divides.
pub(super) fn advice(time: f64, divide: &str, has_buttons: bool) -> Option<String> {
    let divide = if has_buttons { words::text(Key::HintChainButton) } else { divide };
    let what = held_to_crawl(has_buttons);
    let of = |key| words::text(key).to_owned();
    let parts = [
        (0.0, words::text_with(Key::HintChainCrawl, &[("what", what.into())])),
        (6.0, of(Key::HintChainClock)),
        (22.0, of(Key::HintChainRivals)),
        (30.0, of(Key::HintChainGiant)),
        (38.0, words::text_with(Key::HintChainDivide, &[("key", divide.into())])),
    ];
    parts.into_iter().find(|(from, _)| (*from..from + 6.0).contains(&time)).map(|(_, text)| text)
}

/// What the status says of a cell: how long its line has lived, and time until it starves.
pub(super) fn status(round: &Round, cell: OrganismId) -> Option<(String, [f32; 2])> {
    let (chain, world) = (round.chain()?, round.world());
    let cell = world.view().organism(cell)?;
    let line = world.view().organisms().filter(|other| line_of(*other) == line_of(cell)).count();
    let time = world.time() as f32;
    let reserve = chain.reserve(cell, time).min(FULL_RESERVE);
    Some((food_chain::summary(time, chain.size(cell), line.saturating_sub(1)), [reserve, FULL_RESERVE]))
}

/// Marks how the bodies of all players have changed, and for one cell who can bite it and whom it can bite.
pub(super) fn draw(pen: &mut Pen, style: &Style<'_>, round: &Round, view: View<'_>, cell: OrganismId) {
    let Some(chain) = round.chain() else { return };
    food_chain::draw_others(pen, style, &threats_and_victims(view, cell));
    let cells = round.players().filter_map(|cell| view.organism(cell));
    cells.for_each(|cell| food_chain::draw_changes(pen, style, cell));
    if chain.is_bitten(cell) {
        food_chain::draw_bitten(pen);
    }
}
