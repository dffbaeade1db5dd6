//! The player's own cell has a rim that no other has, in every way of looking. Cells of several players have numbers.

use super::marks::Style;
use crate::draw::palette::{ALERT, HALO, INK, PLAYERS, fade};
use crate::rules::lunge::Lunge;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use macroquad::color::Color;
use microsim_core::OrganismView;
use microsim_core::glam::Vec2;

/// Width of the rims of others.
pub const OTHERS: f32 = 0.6;
/// Width of the rim of a cell that is bitten, lines of text.
pub const BITTEN: f32 = 0.24;
/// Width of the rim of who has eaten the player's cell.
pub const EATER: f32 = 0.4;

/// Draws the rim in the colour of the player; of several players also a tint of it all over the cell, and the number. The rim
/// is `width` times as wide as that of the own cell usually is.
pub fn draw_own(pen: &mut Pen, style: &Style<'_>, cell: OrganismView<'_>, number: Option<usize>, width: f32) {
    let rim = PLAYERS[number.unwrap_or(1).saturating_sub(1) % PLAYERS.len()].1;
    let at = style.camera.to_screen(cell.centroid());
    if number.is_some() {
        let outline: Vec<Vec2> = cell.surface().into_iter().map(|at| style.camera.to_screen(at)).collect();
        (0..outline.len()).for_each(|k| {
            pen.canvas().corner([at, outline[k], outline[(k + 1) % outline.len()]], fade(rim, 0.38));
        });
    }
    draw_rim(pen, style, cell, fade(rim, 0.85), 0.12 * width);
    if let Some(number) = number {
        pen.label(at, TextSize::Body, Align::Centre, rim, &number.to_string());
    }
}

/// Draws a rim along the outline of a cell, this wide, lines of text.
pub fn draw_rim(pen: &mut Pen, style: &Style<'_>, cell: OrganismView<'_>, colour: Color, width: f32) {
    let outline: Vec<Vec2> = cell.surface().into_iter().map(|at| style.camera.to_screen(at)).collect();
    let width = width * pen.line(TextSize::Body);
    for (width, colour) in [(2.0 * width, fade(INK, 0.4)), (width, colour)] {
        for k in 0..outline.len() {
            pen.canvas().segment(outline[k], outline[(k + 1) % outline.len()], width, colour);
        }
    }
}

/// Draws streaks behind a cell that lunges, and a ring around one that recovers, which closes until it can lunge again.
pub fn draw_lunge(pen: &mut Pen, style: &Style<'_>, cell: OrganismView<'_>, lunge: Lunge) {
    let Some(share) = lunge.recovered() else { return };
    let unit = pen.line(TextSize::Body);
    let at = style.camera.to_screen(cell.centroid());
    let radius = 0.7 * cell.cytoplasm_area().sqrt() * style.camera.scale();
    let front = cell.front().filter(|_| lunge.is_on()).map(|front| style.camera.to_screen(front));
    let Some(ahead) = front.map(|front| (front - at).normalize_or_zero()) else {
        pen.canvas().arc(at, radius + 0.4 * unit, 0.24 * unit, 1.0, fade(INK, 0.4));
        pen.canvas().arc(at, radius + 0.4 * unit, 0.12 * unit, share, HALO);
        return;
    };
    // What it costs.
    pen.label(at - Vec2::new(0.0, radius + 1.4 * unit), TextSize::Large, Align::Centre, ALERT, "-");
    for side in [-0.5, 0.0, 0.5] {
        let from = at - radius * (1.2 * ahead - side * ahead.perp());
        let to = from - radius * (1.0 - side.abs()) * ahead;
        for (width, colour) in [(0.24, fade(INK, 0.4)), (0.12, HALO)] {
            pen.canvas().segment(from, to, width * unit, colour);
        }
    }
}

/// Draws the outline of a ghost: every other segment, pale.
pub fn draw_ghost(pen: &mut Pen, style: &Style<'_>, cell: OrganismView<'_>) {
    let outline: Vec<Vec2> = cell.surface().into_iter().map(|at| style.camera.to_screen(at)).collect();
    let width = 0.06 * pen.line(TextSize::Body);
    for (width, colour) in [(2.2 * width, fade(INK, 0.5)), (width, fade(HALO, 0.8))] {
        for ends in outline.windows(2).step_by(2) {
            pen.canvas().segment(ends[0], ends[1], width, colour);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::rules::round::Round;
    use microsim_core::scenario::Scenario;
    use microsim_core::{AmoeboidCellSpec, Intent, Placement, World, WorldConfig};
    use std::collections::BTreeSet;

    #[test]
    fn the_players_own_cell_has_a_rim_on_its_outline() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        let mut pen = Pen::bare();
        let cell = world.view().organism(cell).unwrap();
        draw_own(&mut pen, &style, cell, None, 1.0);
        let (low, high) = cell.bounds();
        let (a, b) = (camera.to_screen(low), camera.to_screen(high));
        let is_near = |at: Vec2| at.cmpgt(a.min(b) - 6.0).all() && at.cmplt(a.max(b) + 6.0).all();
        let corners: Vec<Vec2> = pen.canvas().corners().map(|(at, ..)| at).collect();
        assert!(corners.len() >= 8 * cell.outline().len() && corners.iter().copied().all(is_near));
        let mut pen = Pen::bare();
        draw_ghost(&mut pen, &style, cell);
        let dashes: Vec<Vec2> = pen.canvas().corners().map(|(at, ..)| at).collect();
        assert!(dashes.len() > corners.len() / 3 && dashes.len() < 2 * corners.len() / 3, "{}", dashes.len());
        assert!(dashes.into_iter().all(is_near));
    }

    #[test]
    fn a_cell_that_lunges_has_streaks_behind_it_and_one_that_recovers_a_ring_that_closes() {
        let text = "schema = 1\nname = \"room\"\n[world]\nsize = [160.0, 90.0]\n[amoeboid_cell.cell]\nradii = [7.0, 7.0]\n\
                    [[spawn]]\nof = \"cell\"\nplayer = true\nat = [40.0, 45.0]\n[game]\ntime = 60.0\n";
        let mut round = Round::new(&Scenario::parse(text, &[]).unwrap()).unwrap();
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        let mut drawn = |steps: u32, begins: bool| {
            assert!(!begins || round.lunge(0).is_ok());
            (0..steps).for_each(|_| round.step(Intent::toward(Vec2::new(150.0, 45.0)).unwrap()));
            let cell = round.world().view().organism(round.player()).unwrap();
            let mut pen = Pen::bare();
            draw_lunge(&mut pen, &style, cell, round.lunge_of(0));
            let from = camera.to_screen(cell.centroid());
            pen.canvas().corners().map(|(at, ..)| at - from).collect::<Vec<Vec2>>()
        };
        assert!(drawn(60, false).is_empty());
        let radius = 7.0 * camera.scale();
        let (price, streaks): (Vec<Vec2>, Vec<Vec2>) = drawn(20, true).into_iter().partition(|at| at.y < -0.8 * radius);
        assert!(!streaks.is_empty() && streaks.iter().all(|at| at.x < 0.0), "behind: {streaks:?}");
        assert!(!price.is_empty() && price.iter().all(|at| at.x.abs() < radius), "above: {price:?}");
        let [early, late] = [60, 90].map(|steps| drawn(steps, false).len());
        assert!(0 < early && early < late, "{early} {late}");
        assert!(drawn(60, false).is_empty(), "it can lunge again");
    }

    #[test]
    fn cells_of_players_have_four_colours() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        let colours = |number| {
            let mut pen = Pen::bare();
            draw_own(&mut pen, &style, world.view().organism(cell).unwrap(), Some(number), 1.0);
            pen.canvas().corners().map(|(_, _, colour)| colour).collect::<BTreeSet<_>>()
        };
        let all: BTreeSet<_> = (1..=4).map(colours).collect();
        assert_eq!(all.len(), 4);
    }
}
