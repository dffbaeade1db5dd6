//! Marks in the scene: arrows over cells that can be taken in, rings around what is touched, the key that digests.

use crate::camera::Camera;
use crate::draw::palette::{ALERT, HALO, INK, READY, WAIT, fade};
use crate::rules::hint::{HeldPrey, MealState, PreyTarget, Readiness};
use crate::rules::referee::Gain;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Height that is kept free for the status line and a mark's own label below it, lines of text.
const BELOW_STATUS: f32 = 4.6;
/// Distance of an arrow at the upper edge from it, lines of text: below the score and the clock.
const UNDER_CLOCK: f32 = 3.2;
/// How many of the cells that are too large, the nearest first, have a number at their box.
const NUMBERS: usize = 1;
/// Points that are written large.
const MANY_POINTS: u32 = 100;
/// Time for which points are shown, s.
const GAIN_TIME: f32 = 1.6;

/// How marks are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Style<'a> {
    /// Where things are.
    pub camera: &'a Camera,
    /// Time for what moves, s; `None` if nothing may move that does not have to.
    pub time: Option<f32>,
    /// The green arrow also where there is no room, as in the thesis (T75).
    pub is_classic: bool,
    /// What is written on the key that digests, if the player has to hold one.
    pub key: Option<&'a str>,
}

/// The marks that are drawn so far: the middle of each, and half its size.
#[derive(Clone, Debug, Default)]
pub struct MarkLayout(Vec<[Vec2; 2]>);

impl MarkLayout {
    /// A place for a mark: the wanted one, or below the marks that overlap it.
    fn place(&mut self, mut middle: Vec2, half: Vec2) -> Vec2 {
        // A little less than the sum of both, because of rounding.
        let overlap = |middle: Vec2, [other, size]: [Vec2; 2]| (middle - other).abs().cmplt(0.99 * (half + size)).all();
        while let Some(&[other, size]) = self.0.iter().find(|&&other| overlap(middle, other)) {
            middle.y = other.y + half.y + size.y;
        }
        self.0.push([middle, half]);
        middle
    }
}

/// Arrows over rigid cells (T69, T75), the nearest first: a full one where the cell can be taken in now, a hollow one with the share
/// of the size that the player has, a barred one where there is no room.
pub fn draw_targets(pen: &mut Pen, style: &Style<'_>, taken: &mut MarkLayout, targets: &[PreyTarget]) {
    let unit = pen.line(TextSize::Body);
    let half = Vec2::new(1.2, 1.25) * unit;
    let mut numbers = 0;
    for target in targets {
        let readiness = match target.readiness {
            Readiness::NoRoom if style.is_classic => Readiness::Ready,
            other => other,
        };
        let bob = style.time.map_or(0.0, |time| 0.12 * unit * (5.0 * time).sin());
        let (at, half_extent) = (style.camera.to_screen(target.at), target.half_extent * style.camera.scale());
        let tip = Vec2::new(at.x, (at.y - half_extent - 0.25 * unit).max(BELOW_STATUS * unit));
        let is_seen = tip.cmpge(Vec2::ZERO).all() && tip.cmple(pen.screen()).all() && tip.y < at.y + half_extent;
        let down = Vec2::new(0.0, half.y);
        let tip = if is_seen { taken.place(tip - down, half) + down } else { tip };
        match readiness {
            Readiness::Ready if is_seen => arrow(pen, tip + Vec2::new(0.0, bob), Vec2::Y, unit, READY),
            Readiness::Ready => draw_at_edge(pen, at, unit, READY),
            _ if !is_seen => {}
            Readiness::TooLarge(share) => {
                numbers += 1;
                draw_too_large(pen, tip, unit, (share, numbers <= NUMBERS));
            }
            Readiness::NoRoom => draw_no_room(pen, tip, unit),
        }
    }
}

/// A hollow arrow that is filled as far as the player has grown.
fn draw_too_large(pen: &mut Pen, tip: Vec2, unit: f32, (share, has_number): (f32, bool)) {
    let (low, high) = (tip - Vec2::new(0.32 * unit, 1.0 * unit), tip + Vec2::new(0.32 * unit, -0.2 * unit));
    let (outer, inner) = (Vec2::splat(0.12 * unit), Vec2::splat(0.02 * unit));
    pen.canvas().rectangle(low - outer, high + outer, fade(INK, 0.75));
    pen.canvas().rectangle(low - inner, high + inner, fade(HALO, 0.35));
    let filled = Vec2::new(low.x, high.y - (high.y - low.y) * share);
    pen.canvas().rectangle(filled, high, WAIT);
    if !has_number {
        return;
    }
    let percent = format!("{:.0} %", (100.0 * share).floor());
    pen.label(tip - Vec2::new(0.0, 1.75 * unit), TextSize::Small, Align::Centre, HALO, &percent);
}

/// An arrow with a bar across.
fn draw_no_room(pen: &mut Pen, tip: Vec2, unit: f32) {
    arrow(pen, tip, Vec2::Y, 0.8 * unit, WAIT);
    let half = Vec2::new(0.55 * unit, 0.0);
    let bar = tip - Vec2::new(0.0, 0.45 * unit);
    pen.canvas().segment(bar - half, bar + half, 0.3 * unit, INK);
    pen.canvas().segment(bar - 0.9 * half, bar + 0.9 * half, 0.16 * unit, HALO);
    pen.label(tip - Vec2::new(0.0, 1.7 * unit), TextSize::Small, Align::Centre, HALO, words::text(Key::HudFull));
}

/// An arrow at the edge of the picture that points to something outside.
pub(super) fn draw_at_edge(pen: &mut Pen, at: Vec2, unit: f32, colour: Color) {
    let middle = 0.5 * pen.screen();
    let offset = at - middle;
    // Below the status line, and not quite at the edge.
    let room = middle - Vec2::new(1.2, if offset.y < 0.0 { UNDER_CLOCK } else { 2.4 }) * unit;
    let share = (room / offset.abs().max(Vec2::splat(1.0))).min_element();
    arrow(pen, middle + offset * share.min(1.0), offset.normalize_or_zero(), 0.8 * unit, colour);
}

/// An arrow with its tip at a point, in a dark rim that shows it on any ground.
fn arrow(pen: &mut Pen, tip: Vec2, direction: Vec2, unit: f32, colour: Color) {
    let side = direction.perp();
    for (grown, colour) in [(0.14 * unit, INK), (0.0, colour)] {
        let tip = tip + direction * (1.6 * grown);
        let neck = tip - direction * (0.62 * unit + 2.4 * grown);
        let wing = side * (0.5 * unit + 1.3 * grown);
        let stem = side * (0.19 * unit + grown);
        let tail = neck - direction * (0.5 * unit - 0.2 * grown);
        pen.canvas().quad([neck - stem, neck + stem, tail + stem, tail - stem], [colour; 4]);
        pen.canvas().corner([tip, neck + wing, neck - wing], colour);
    }
}

/// Rings around what is touched (T29), marks at what is inside with the key that digests it (T71).
pub fn draw_held(pen: &mut Pen, style: &Style<'_>, taken: &mut MarkLayout, held: &[HeldPrey]) {
    let unit = pen.line(TextSize::Body);
    let mut highest: Option<(Vec2, bool)> = None;
    for held in held {
        let at = style.camera.to_screen(held.at);
        let radius = held.half_extent * style.camera.scale() + 0.3 * unit;
        match held.state {
            MealState::Touching(share) => {
                ring(pen, at, radius, 0.2 * unit, 1.0, fade(HALO, 0.45));
                ring(pen, at, radius, 0.2 * unit, share, READY);
            }
            MealState::Entering => ring(pen, at, radius, 0.2 * unit, 1.0, READY),
            MealState::Inside(share) => {
                let radius = radius.max(0.45 * unit);
                ring(pen, at, radius, 0.11 * unit, 1.0, fade(HALO, 0.8));
                ring(pen, at, radius, 0.22 * unit, share, ALERT);
                let tip = at - Vec2::new(0.0, radius + 0.1 * unit);
                if highest.is_none_or(|(known, _)| tip.y < known.y) {
                    highest = Some((tip, share > 0.0));
                }
            }
        }
    }
    // One key digests all of it.
    if let Some(((tip, is_down), key)) = highest.zip(style.key) {
        taken.place(tip - Vec2::new(0.0, 0.8 * unit), Vec2::splat(0.8 * unit));
        draw_key(pen, tip, key, is_down);
    }
}

fn ring(pen: &mut Pen, at: Vec2, radius: f32, width: f32, share: f32, colour: Color) {
    if share <= 0.0 {
        return;
    }
    pen.canvas().arc(at, radius, 1.9 * width, share, fade(INK, 0.5 * colour.a));
    pen.canvas().arc(at, radius, width, share, colour);
}

/// The key as a key cap, pointing down.
fn draw_key(pen: &mut Pen, tip: Vec2, key: &str, is_down: bool) {
    let unit = pen.line(TextSize::Body);
    let half = Vec2::new(0.5 * pen.width(TextSize::Body, key).max(0.6 * unit) + 0.3 * unit, 0.55 * unit);
    let middle = tip - Vec2::new(0.0, half.y + 0.35 * unit);
    let (face, ink) = (if is_down { ALERT } else { HALO }, INK);
    let wing = Vec2::new(0.35 * unit, 0.0);
    let base = Vec2::new(tip.x, middle.y + half.y - 0.5);
    let rim = Vec2::splat(0.1 * unit);
    pen.canvas().corner([tip + Vec2::new(0.0, rim.y), base - 1.4 * wing, base + 1.4 * wing], INK);
    pen.canvas().rectangle(middle - half - rim, middle + half + rim, INK);
    pen.canvas().corner([tip, base - wing, base + wing], face);
    pen.canvas().rectangle(middle - half, middle + half, face);
    // Twice, for a bolder stroke.
    for by in [0.0, 1.0] {
        pen.write(middle + Vec2::new(by, 0.0), TextSize::Body, Align::Centre, ink, key);
    }
}

/// Points that were gained lately (T70).
#[derive(Clone, Debug, Default)]
pub struct Gains(Vec<(Gain, f32)>);

impl Gains {
    /// Adds what a step has earned.
    pub fn add(&mut self, gains: impl Iterator<Item = Gain>) {
        self.0.extend(gains.map(|gain| (gain, 0.0)));
    }

    /// Lets time pass, s.
    pub fn pass(&mut self, elapsed: f32) {
        self.0.iter_mut().for_each(|(_, age)| *age += elapsed);
        self.0.retain(|(_, age)| *age < GAIN_TIME);
    }

    /// Draws them where they were gained; they rise unless nothing may move.
    pub fn draw(&self, pen: &mut Pen, style: &Style<'_>, taken: &mut MarkLayout) {
        let unit = pen.line(TextSize::Body);
        for (gain, age) in &self.0 {
            // None rises out of the picture.
            let mut place = style.camera.to_screen(gain.at) - Vec2::new(0.0, unit);
            place.y = place.y.max(3.0 * unit);
            let size = if gain.points >= MANY_POINTS { TextSize::Large } else { TextSize::Body };
            let place = taken.place(place, Vec2::new(1.4, 0.63) * pen.line(size));
            let rise = style.time.map_or(0.0, |_| 2.0 * unit * age / GAIN_TIME);
            let at = place - Vec2::new(0.0, rise);
            pen.label(at, size, Align::Centre, READY, &format!("+{}", gain.points));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{Kind, OrganismId, Placement, RigidCellSpec, World, WorldConfig};

    fn prey() -> OrganismId {
        let mut world = World::new(WorldConfig::default()).unwrap();
        world.spawn(&RigidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap()
    }

    fn target(y: f32, readiness: Readiness) -> PreyTarget {
        PreyTarget { prey: prey(), at: Vec2::new(80.0, y), half_extent: 5.0, readiness }
    }

    fn drawn(draw: impl Fn(&mut Pen, &Style<'_>, &mut MarkLayout), is_classic: bool) -> Pen {
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let mut pen = Pen::bare();
        let style = Style { camera: &camera, time: None, is_classic, key: Some("Q") };
        draw(&mut pen, &style, &mut MarkLayout::default());
        pen
    }

    fn drawn_targets(targets: &[PreyTarget], is_classic: bool) -> Pen {
        drawn(|pen, style, taken| draw_targets(pen, style, taken, targets), is_classic)
    }

    #[test]
    fn t69_t75_the_green_arrow_is_for_what_can_be_taken_in() {
        let arrows = |readiness, at, is_classic| {
            drawn_targets(&[PreyTarget { at, ..target(0.0, readiness) }], is_classic).canvas().count(READY)
        };
        let (seen, outside) = (Vec2::new(80.0, 45.0), Vec2::new(400.0, 45.0));
        let arrow = arrows(Readiness::Ready, seen, false);
        assert!(arrow > 0);
        assert_eq!(arrows(Readiness::Ready, outside, false), arrow, "at the edge of the picture");
        assert_eq!(arrows(Readiness::TooLarge(0.5), seen, false), 0);
        assert_eq!(arrows(Readiness::NoRoom, seen, false), 0);
        assert_eq!(arrows(Readiness::NoRoom, seen, true), arrow, "as in the thesis");
    }

    #[test]
    fn an_arrow_to_what_is_above_the_picture_stays_below_the_clock() {
        for x in [0.0, 40.0, 80.0, 150.0, 400.0] {
            let target = PreyTarget { at: Vec2::new(x, 300.0), ..target(0.0, Readiness::Ready) };
            let mut pen = drawn_targets(&[target], false);
            // Its middle, and half its height.
            let line = pen.line(TextSize::Large);
            let end = (0.16 + 0.75 + 0.56) * line;
            let highest = pen.canvas().corners().map(|(at, ..)| at.y).fold(f32::MAX, f32::min);
            assert!(highest > end, "{highest} of {end}, at {x}");
        }
    }

    #[test]
    fn only_the_nearest_cell_that_is_too_large_has_a_number() {
        let corners = |count| {
            let targets: Vec<PreyTarget> = (0..count)
                .map(|k| PreyTarget {
                    at: Vec2::new(20.0 + 25.0 * k as f32, 45.0),
                    ..target(0.0, Readiness::TooLarge(0.5))
                })
                .collect();
            drawn_targets(&targets, false).canvas().corners().count()
        };
        let [one, two, three] = [1, 2, 3].map(corners);
        assert!(two - one < one && three - two == two - one, "{one} {two} {three}");
    }

    #[test]
    fn marks_at_one_place_stand_apart() {
        let lowest = |count| {
            let mut pen = drawn_targets(&vec![target(45.0, Readiness::Ready); count], false);
            pen.canvas().corners().map(|(at, ..)| at.y).fold(0.0, f32::max)
        };
        assert!(lowest(3) > lowest(1) + 4.0 * Pen::bare().line(TextSize::Body));
    }

    #[test]
    fn marks_leave_the_status_line_free() {
        for height in 60..90 {
            let mut pen = drawn_targets(&[target(height as f32, Readiness::TooLarge(0.5))], false);
            let free = 2.0 * pen.line(TextSize::Body);
            assert!(pen.canvas().corners().all(|(at, ..)| at.y > free), "{height}");
            assert!(height > 75 || pen.canvas().corners().count() > 0, "{height}");
        }
    }

    #[test]
    fn t71_the_key_cap_stands_at_what_is_inside_and_lights_up_while_it_is_digested() {
        let held = |state| {
            let held = HeldPrey { prey: prey(), at: Vec2::new(80.0, 45.0), half_extent: 2.0, state };
            drawn(|pen, style, taken| draw_held(pen, style, taken, &[held]), false)
        };
        let cap = |state, face| held(state).canvas().count(face);
        assert_eq!(cap(MealState::Entering, INK), 0, "no key yet");
        assert!(cap(MealState::Inside(0.0), INK) > 0 && cap(MealState::Inside(0.0), HALO) > 0);
        assert_eq!(cap(MealState::Inside(0.0), ALERT), 0);
        assert!(cap(MealState::Inside(0.5), ALERT) > 0);
    }

    #[test]
    fn t70_gains_are_shown_apart_from_each_other_and_for_a_while() {
        let mut gains = Gains::default();
        let gain = Gain { kind: Kind::Agar, points: 10, at: Vec2::new(80.0, 45.0) };
        gains.add([gain; 4].into_iter());
        let pen = |gains: &Gains| drawn(|pen, style, taken| gains.draw(pen, style, taken), false);
        let heights = |gains: &Gains| pen(gains).canvas().corners().map(|(at, ..)| at.y).collect::<Vec<f32>>();
        let panels: Vec<[f32; 2]> = heights(&gains)
            .chunks(heights(&gains).len() / 4)
            .map(|panel| panel.iter().fold([f32::MAX, 0.0], |[low, high], y| [low.min(*y), high.max(*y)]))
            .collect();
        let apart = |[a, b]: [[f32; 2]; 2]| a[1] <= b[0] + 0.5 || b[1] <= a[0] + 0.5;
        assert!((0..4).all(|k| (0..k).all(|j| apart([panels[j], panels[k]]))), "{panels:?}");
        gains.pass(GAIN_TIME + 0.1);
        assert!(heights(&gains).is_empty());
    }
}
