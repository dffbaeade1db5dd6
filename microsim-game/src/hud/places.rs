//! What a slide's goals ask for: places, and food to be told from dust.

use super::marks::{Style, draw_at_edge};
use crate::draw::palette::{HALO, INK, READY, fade};
use crate::rules::attempt::{Attempt, is_held, places, wanted};
use crate::rules::prey_class;
use crate::rules::round::Round;
use crate::ui::font::TextSize;
use crate::ui::pen::Pen;
use microsim_core::glam::Vec2;
use microsim_core::scenario::Goal;
use microsim_core::{OrganismView, View};

/// Distance from whoever eats at which a ring around food is faintest, units, and how faint.
const FAR: f32 = 45.0;
const FAINT: f32 = 0.35;

/// Draws a frame around each place, a thick one that is filled until a player was there; of two places to be held at the same time,
/// which a line joins, while nobody is there. An arrow at the edge of the picture points to such a place outside. Where a cell touches
/// a place, its middle is marked: that has to be inside.
pub fn draw_places(pen: &mut Pen, style: &Style<'_>, round: &Round, view: View<'_>) {
    let unit = pen.line(TextSize::Body);
    let players = places_of_players(round);
    for (goal, done) in round.attempt().into_iter().flat_map(Attempt::goals) {
        let is_open = done < wanted(goal);
        if let (Goal::Together { places }, true) = (goal, is_open) {
            let [a, b] = places.map(|[low, high]| style.camera.to_screen(0.5 * (low + high)));
            pen.canvas().segment(a, b, 0.12 * unit, fade(READY, 0.5));
        }
        for place in places(goal) {
            let is_open = is_open && !is_held(place, &players);
            draw_place(pen, style, place, is_open);
            if is_open {
                let cells = round.players().filter_map(|cell| view.organism(cell));
                cells.for_each(|cell| draw_middle(pen, style, place, cell));
            }
        }
    }
}

fn touches([low, high]: [Vec2; 2], cell: OrganismView<'_>) -> bool {
    let (from, to) = cell.bounds();
    !(from.cmpgt(high).any() || to.cmplt(low).any())
}

/// Whether a cell touches a place that it has still to reach with its middle.
#[must_use]
pub fn is_before_place(attempt: &Attempt, cell: OrganismView<'_>) -> bool {
    let open = attempt.goals().filter(|(goal, done)| *done < wanted(goal)).flat_map(|(goal, _)| places(goal));
    let mut left = open.filter(|place| !is_held(*place, &[cell.centroid()]));
    left.any(|place| touches(place, cell))
}

/// Marks the middle of a cell that touches a place by a cross in a ring.
fn draw_middle(pen: &mut Pen, style: &Style<'_>, place: [Vec2; 2], cell: OrganismView<'_>) {
    if !touches(place, cell) {
        return;
    }
    let (at, unit) = (style.camera.to_screen(cell.centroid()), pen.line(TextSize::Body));
    for (width, colour) in [(0.2 * unit, INK), (0.1 * unit, READY)] {
        pen.canvas().arc(at, 0.32 * unit, width, 1.0, colour);
        for side in [Vec2::X, Vec2::Y].map(|axis| 0.5 * unit * axis) {
            pen.canvas().segment(at - side, at + side, width, colour);
        }
    }
}

fn draw_place(pen: &mut Pen, style: &Style<'_>, place: [Vec2; 2], is_open: bool) {
    let unit = pen.line(TextSize::Body);
    let [a, b] = place.map(|corner| style.camera.to_screen(corner));
    let (low, high) = (a.min(b), a.max(b));
    if !is_open {
        draw_frame(pen, low, high, 0.06 * unit, 0.6);
        return;
    }
    pen.canvas().rectangle(low, high, fade(READY, 0.2));
    draw_frame(pen, low, high, 0.16 * unit, 1.0);
    let is_seen = low.cmplt(pen.screen()).all() && high.cmpgt(Vec2::ZERO).all();
    if !is_seen {
        draw_at_edge(pen, 0.5 * (low + high), unit, READY);
    }
}

/// Draws a thin ring around everything small that can be digested, fainter the farther it is from those who eat.
pub fn draw_food(pen: &mut Pen, style: &Style<'_>, round: &Round, view: View<'_>) {
    let (unit, eaters) = (pen.line(TextSize::Body), places_of_players(round));
    for food in view.organisms().filter(|organism| prey_class::is_small(*organism) && organism.held_by().is_none()) {
        let (low, high) = food.bounds();
        let radius = 0.5 * (high - low).max_element() * style.camera.scale() + 0.28 * unit;
        let at = style.camera.to_screen(food.centroid());
        let distance = eaters.iter().map(|eater| eater.distance(food.centroid())).fold(FAR, f32::min);
        let alpha = 1.0 - (1.0 - FAINT) * distance / FAR;
        pen.canvas().arc(at, radius, 0.14 * unit, 1.0, fade(INK, 0.5 * alpha));
        pen.canvas().arc(at, radius, 0.07 * unit, 1.0, fade(READY, alpha));
    }
}

fn places_of_players(round: &Round) -> Vec<Vec2> {
    round.players().filter_map(|cell| round.world().centroid(cell)).collect()
}

fn draw_frame(pen: &mut Pen, low: Vec2, high: Vec2, width: f32, alpha: f32) {
    for (width, colour) in [(2.2 * width, INK), (width, if alpha < 1.0 { HALO } else { READY })] {
        let (half, colour) = (0.5 * width, fade(colour, alpha));
        let (outer, inner) = ([low - half, high + half], [low + half, high - half]);
        // The sides stand between the upper and the lower edge, so that corners are whole and nothing is painted twice.
        let sides = [
            [outer[0], Vec2::new(outer[1].x, inner[0].y)],
            [Vec2::new(outer[0].x, inner[1].y), outer[1]],
            [Vec2::new(outer[0].x, inner[0].y), Vec2::new(inner[0].x, inner[1].y)],
            [Vec2::new(inner[1].x, inner[0].y), Vec2::new(outer[1].x, inner[1].y)],
        ];
        sides.into_iter().for_each(|[from, to]| pen.canvas().rectangle(from, to, colour));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use microsim_core::{AmoeboidCellSpec, Placement, World, WorldConfig};

    #[test]
    fn t87_a_place_is_marked_until_the_player_was_there() {
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        let drawn = |at: f32, is_open| {
            let mut pen = Pen::bare();
            draw_place(&mut pen, &style, [Vec2::splat(at), Vec2::splat(at + 10.0)], is_open);
            pen.canvas().count(READY)
        };
        assert!(drawn(20.0, true) > 0, "a frame");
        assert_eq!(drawn(20.0, false), 0);
        assert!(drawn(400.0, true) > drawn(20.0, true), "and an arrow to what is outside");
    }

    #[test]
    fn who_touches_a_place_with_the_edge_is_before_it_until_the_middle_is_inside() {
        let slide = crate::slides::find("first-steps").unwrap().read().unwrap();
        let attempt = Attempt::new(slide);
        let [low, high] = attempt.goals().flat_map(|(goal, _)| places(goal)).next().unwrap();
        let is_before = |at: Vec2| {
            let mut world = World::new(WorldConfig { size: Vec2::splat(400.0), ..WorldConfig::default() }).unwrap();
            let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(at.x, at.y)).unwrap();
            is_before_place(&attempt, world.view().organism(cell).unwrap())
        };
        let middle = 0.5 * (low + high);
        assert!(is_before(Vec2::new(high.x + 2.0, middle.y)), "the edge is inside");
        assert!(!is_before(middle) && !is_before(Vec2::splat(350.0)));
    }

    #[test]
    fn the_middle_of_a_cell_is_marked_where_it_touches_a_place() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        let marked = |gap: f32| {
            let (cell, mut pen) = (world.view().organism(cell).unwrap(), Pen::bare());
            let low = Vec2::new(cell.bounds().1.x + gap, 40.0);
            draw_middle(&mut pen, &style, [low, low + 10.0], cell);
            pen.canvas().corners().map(|(at, ..)| at.distance(camera.to_screen(cell.centroid()))).fold(0.0, f32::max)
        };
        assert_eq!(marked(1.0), 0.0, "nothing is marked beside it");
        assert!(marked(-1.0) > 0.0 && marked(-1.0) < Pen::bare().line(TextSize::Body), "a small mark at the middle");
    }
}
