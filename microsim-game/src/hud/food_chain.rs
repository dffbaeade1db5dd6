//! What the food chain shows: who can bite and who can be bitten, and how the player's body has changed.

use super::marks::{Style, draw_at_edge};
use super::own::draw_rim;
use crate::draw::palette::{ALERT, HALO, INK, READY, WAIT, fade};
use crate::rules::food_chain::change::Change;
use crate::rules::threat::Other;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;
use microsim_core::{OrganismView, View};

/// Distance within which threats outside the picture are pointed at, units.
const WARNED: f32 = 90.0;
/// Nodes of the outline between two marks of a change.
const SPACING: usize = 4;

/// Draws a rim and a warning over each amoeba that can bite, an arrow at the edge of the picture to a near one outside, and a ring
/// around each that can be bitten.
pub fn draw_others(pen: &mut Pen, style: &Style<'_>, view: View<'_>, [threats, victims]: &[Vec<Other>; 2]) {
    let unit = pen.line(TextSize::Body);
    for threat in threats {
        if let Some(cell) = view.organism(threat.cell) {
            draw_rim(pen, style, cell, fade(ALERT, 0.9), 0.16);
        }
        let (at, radius) = place(style, threat);
        if is_seen(pen, at, radius) {
            let top = Vec2::new(at.x, (at.y - radius - 0.9 * unit).max(2.6 * unit));
            draw_warning(pen, top, 0.7 * unit);
        } else if threat.distance < WARNED {
            draw_at_edge(pen, at, unit, ALERT);
        }
    }
    for victim in victims {
        let (at, radius) = place(style, victim);
        if is_seen(pen, at, radius) {
            pen.canvas().arc(at, radius + 0.4 * unit, 0.2 * unit, 1.0, fade(INK, 0.5));
            pen.canvas().arc(at, radius + 0.4 * unit, 0.1 * unit, 1.0, READY);
        }
    }
}

/// Draws a thin rim and a sign of equality over each amoeba that can neither bite nor be bitten.
pub fn draw_equals(pen: &mut Pen, style: &Style<'_>, view: View<'_>, equals: &[Other]) {
    let unit = pen.line(TextSize::Body);
    for equal in equals {
        if let Some(cell) = view.organism(equal.cell) {
            draw_rim(pen, style, cell, fade(HALO, 0.7), 0.07);
        }
        let (at, radius) = place(style, equal);
        if is_seen(pen, at, radius) {
            let top = Vec2::new(at.x, (at.y - radius - 0.7 * unit).max(2.6 * unit));
            pen.label(top, TextSize::Body, Align::Centre, HALO, "=");
        }
    }
}

fn place(style: &Style<'_>, other: &Other) -> (Vec2, f32) {
    (style.camera.to_screen(other.at), other.half_extent * style.camera.scale())
}

fn is_seen(pen: &Pen, at: Vec2, radius: f32) -> bool {
    (at + radius).cmpgt(Vec2::ZERO).all() && (at - radius).cmplt(pen.screen()).all()
}

/// A triangle with an exclamation mark: told by its shape too.
fn draw_warning(pen: &mut Pen, at: Vec2, size: f32) {
    for (size, colour) in [(1.25 * size, INK), (size, ALERT)] {
        let corners = [Vec2::new(0.0, -1.0), Vec2::new(0.95, 0.75), Vec2::new(-0.95, 0.75)];
        pen.canvas().corner(corners.map(|corner| at + size * corner), colour);
    }
    pen.canvas().segment(at + Vec2::new(0.0, -0.45 * size), at + Vec2::new(0.0, 0.15 * size), 0.26 * size, INK);
    pen.canvas().circle(at + Vec2::new(0.0, 0.48 * size), 0.07 * size, 0.14 * size, INK);
}

/// Draws each change on the body of the player's cell: a quick body has bristles, a sticky front dots along it, a second
/// stomach a ring inside, a thrifty body grains, a thick coat a second rim, a wide mouth an arc ahead; more of each for more.
pub fn draw_changes(pen: &mut Pen, style: &Style<'_>, cell: OrganismView<'_>) {
    let unit = 0.2 * pen.line(TextSize::Body);
    let outline: Vec<Vec2> = cell.outline().map(|at| style.camera.to_screen(at)).collect();
    let middle = style.camera.to_screen(cell.centroid());
    let front = cell.front().map(|front| style.camera.to_screen(front));
    let radius = outline.iter().map(|at| at.distance(middle)).sum::<f32>() / outline.len().max(1) as f32;
    for change in Change::ALL {
        for k in 0..change.count(cell).min(4) {
            let more = k as f32;
            match change {
                Change::Speed => draw_bristles(pen, &outline, middle, k as usize, 3.0 * unit),
                Change::StickyFront => {
                    draw_dots(pen, &outline, front.unwrap_or(middle), radius, (0.8 + 0.3 * more) * unit);
                }
                Change::Stomach => {
                    let at = middle + Vec2::new(0.32 * radius * (2.0 * (more % 2.0) - 1.0), 0.2 * radius * more);
                    pen.canvas().arc(at, 0.22 * radius, 0.8 * unit, 1.0, fade(READY, 0.8));
                }
                Change::Thrift => draw_grains(pen, middle, radius, k, unit),
                Change::Coat => draw_coat(pen, &outline, middle, (2.0 + 1.6 * more) * unit, unit),
                Change::WideMouth => {
                    let to = front.map_or(Vec2::X, |front| (front - middle).normalize_or(Vec2::X));
                    let (at, side) = (middle + to * (radius + (2.0 + 2.0 * more) * unit), to.perp() * 0.5 * radius);
                    pen.canvas().segment(at - side - to * 0.2 * radius, at, unit, fade(WAIT, 0.9));
                    pen.canvas().segment(at + side - to * 0.2 * radius, at, unit, fade(WAIT, 0.9));
                }
            }
        }
    }
}

fn draw_bristles(pen: &mut Pen, outline: &[Vec2], middle: Vec2, first: usize, length: f32) {
    for at in outline.iter().skip(first).step_by(SPACING) {
        let out = (*at - middle).normalize_or_zero();
        pen.canvas().segment(*at + 0.2 * length * out, *at + length * out, 0.25 * length, fade(HALO, 0.9));
    }
}

fn draw_dots(pen: &mut Pen, outline: &[Vec2], front: Vec2, radius: f32, size: f32) {
    for at in outline.iter().filter(|at| at.distance(front) < radius) {
        pen.canvas().circle(*at, 0.5 * size, size, fade(WAIT, 0.9));
    }
}

fn draw_grains(pen: &mut Pen, middle: Vec2, radius: f32, turn: u32, size: f32) {
    for k in 0..6 {
        let angle = (k as f32 + 0.4 * turn as f32) * std::f32::consts::TAU / 6.0;
        let at = middle + Vec2::from_angle(angle) * radius * (0.45 + 0.1 * turn as f32);
        pen.canvas().circle(at, 0.5 * size, size, fade(HALO, 0.8));
    }
}

fn draw_coat(pen: &mut Pen, outline: &[Vec2], middle: Vec2, out: f32, width: f32) {
    let rim: Vec<Vec2> = outline.iter().map(|at| *at + (*at - middle).normalize_or_zero() * out).collect();
    for (width, colour) in [(2.0 * width, fade(INK, 0.5)), (width, fade(HALO, 0.9))] {
        for k in 0..rim.len() {
            pen.canvas().segment(rim[k], rim[(k + 1) % rim.len()], width, colour);
        }
    }
}

/// What the status line says: time that the line has lived; size, and from which on the body can be changed; and whether a sister
/// waits.
#[must_use]
pub fn summary(time: f32, [size, next]: [f32; 2], sisters: usize) -> String {
    // What is shown is reached: sizes are cut off.
    let (size, next) =
        (words::number((10.0 * size).floor() / 10.0, 1), words::number(next, usize::from(next.fract() > 0.0)));
    let args = [("time", (time as u32).into()), ("size", (&size).into()), ("next", (&next).into())];
    let lived = words::text_with(Key::HudLived, &args);
    if sisters == 0 {
        return lived;
    }
    format!("{lived}  {}", words::text_with(Key::HudSecondLife, &[("sisters", (sisters as u32).into())]))
}

/// Writes that the player is being bitten, below the status.
pub fn draw_bitten(pen: &mut Pen) {
    let height = (0.2 * pen.screen().y).max(2.8 * pen.line(TextSize::Large));
    pen.label(
        Vec2::new(0.5 * pen.screen().x, height),
        TextSize::Large,
        Align::Centre,
        ALERT,
        words::text(Key::HudBitten),
    );
}

/// Writes at a place of the room what became of the player's cell.
pub fn draw_fate(pen: &mut Pen, style: &Style<'_>, place: Vec2, text: Key) {
    let (text, line, screen) = (words::text(text), pen.line(TextSize::Large), pen.screen());
    let half = (0.5 * pen.width(TextSize::Large, text) + 0.5 * line).min(0.5 * screen.x);
    let at = style.camera.to_screen(place).clamp(Vec2::new(half, 2.2 * line), screen - Vec2::new(half, 1.6 * line));
    pen.label(at, TextSize::Large, Align::Centre, ALERT, text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::hud::{Status, draw_status};
    use microsim_core::{AmoeboidCellSpec, Placement, World, WorldConfig};

    #[test]
    fn who_is_bitten_is_told_below_the_status_in_a_small_window_with_the_largest_text() {
        let heights = |draw: fn(&mut Pen)| {
            let (mut pen, _) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
            draw(&mut pen);
            pen.canvas().corners().fold([f32::MAX, 0.0], |[low, high], (at, ..)| [low.min(at.y), high.max(at.y)])
        };
        let status = heights(|pen| {
            draw_status(
                pen,
                &Status { score: &[(None, "1".to_owned())], time: [9.0, 60.0], starves: true, is_calm: true, note: "" },
            );
        });
        let bitten = heights(draw_bitten);
        assert!(status[1] <= bitten[0] && bitten[1] < 180.0, "{status:?} {bitten:?}");
    }

    #[test]
    fn what_became_of_the_cell_is_written_inside_the_picture_in_all_languages() {
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(640.0, 360.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            for key in [Key::HudEatenByRival, Key::HudEatenByGiant, Key::HudStarved, Key::SlideEndTaken] {
                let (mut pen, measure) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
                assert!(measure(TextSize::Large, words::text(key)) < 600.0, "{}", words::text(key));
                draw_fate(&mut pen, &style, Vec2::new(200.0, 0.0), key);
                let corners: Vec<Vec2> = pen.canvas().corners().map(|(at, ..)| at).collect();
                let inside = |at: Vec2| at.cmpge(Vec2::ZERO).all() && at.cmple(pen.screen()).all();
                assert!(!corners.is_empty() && corners.into_iter().all(inside));
            }
        }
    }

    fn drawn(draw: impl Fn(&mut Pen, &Style<'_>)) -> Pen {
        let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
        let style = Style { camera: &camera, time: None, is_classic: false, key: None };
        let mut pen = Pen::bare();
        draw(&mut pen, &style);
        pen
    }

    #[test]
    fn threats_are_warned_of_and_victims_ringed_by_shape_and_colour() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(30.0, 45.0)).unwrap();
        let other = |x: f32, distance: f32| Other { cell, at: Vec2::new(x, 45.0), half_extent: 8.0, distance };
        let drawn_of = |others: [Vec<Other>; 2], colour| {
            drawn(|pen, style| draw_others(pen, style, world.view(), &others)).canvas().count(colour)
        };
        let (seen, rim) = (drawn_of([vec![other(80.0, 20.0)], vec![]], ALERT), fade(ALERT, 0.9));
        assert!(seen > 0 && drawn_of([vec![other(80.0, 20.0)], vec![]], READY) == 0);
        assert!(drawn_of([vec![other(80.0, 20.0)], vec![]], rim) > 100, "a rim");
        assert!(drawn_of([vec![other(400.0, 80.0)], vec![]], ALERT) > 0, "an arrow");
        assert_eq!(drawn_of([vec![other(400.0, 100.0)], vec![]], ALERT), 0, "far away");
        let victim = || [vec![], vec![other(80.0, 20.0)]];
        assert!(drawn_of(victim(), READY) > 0 && drawn_of(victim(), ALERT) + drawn_of(victim(), rim) == 0);
    }

    #[test]
    fn a_size_that_is_shown_is_reached() {
        let told = |size| summary(9.0, [size, 2.0], 0);
        assert_eq!([1.99, 2.0].map(told), ["1.9", "2.0"].map(|size| format!("Lived 9 s   Size {size}, new body at 2")));
    }

    #[test]
    fn an_amoeba_of_the_same_size_has_a_thin_rim_and_a_sign_where_it_is_seen() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(30.0, 45.0)).unwrap();
        let other = |x: f32| Other { cell, at: Vec2::new(x, 45.0), half_extent: 8.0, distance: 20.0 };
        let drawn_of = |x: f32| drawn(|pen, style| draw_equals(pen, style, world.view(), &[other(x)]));
        assert!(drawn_of(80.0).canvas().corners().count() > drawn_of(400.0).canvas().corners().count(), "a sign");
        assert!(drawn_of(80.0).canvas().count(fade(HALO, 0.7)) > 100, "a rim");
    }

    #[test]
    fn every_change_is_seen_on_the_body() {
        for change in Change::ALL {
            let mut world = World::new(WorldConfig::default()).unwrap();
            let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
            let corners = |world: &World| {
                let cell = world.view().organism(cell).unwrap();
                drawn(|pen, style| draw_changes(pen, style, cell)).canvas().corners().count()
            };
            let plain = corners(&world);
            change.make(&mut world, cell).unwrap();
            let once = corners(&world);
            change.make(&mut world, cell).unwrap();
            assert!(plain == 0 && once > 0 && corners(&world) > once, "{change:?}: {plain}, {once}");
        }
    }
}
