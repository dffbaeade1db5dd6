//! What a slide's goals ask for: places, and food to be told from dust.

use super::marks::{Style, draw_at_edge};
use crate::draw::palette::{HALO, INK, READY, fade};
use crate::rules::prey;
use crate::ui::font::TextSize;
use crate::ui::pen::Pen;
use microsim_core::View;
use microsim_core::glam::Vec2;
use microsim_core::scenario::Goal;

/// Draws a frame around each place, a thick one that is filled until the player was there; an arrow at the edge of the picture
/// points to such a place outside.
pub fn draw_places<'a>(pen: &mut Pen, style: &Style<'_>, goals: impl Iterator<Item = (&'a Goal, u32)>) {
    let unit = pen.line(TextSize::Body);
    for (goal, done) in goals {
        let Goal::Reach { low, high } = *goal else { continue };
        let [a, b] = [low, high].map(|corner| style.camera.to_screen(corner));
        let (low, high) = (a.min(b), a.max(b));
        if done == 0 {
            pen.canvas().rectangle(low, high, fade(READY, 0.2));
            draw_frame(pen, low, high, 0.16 * unit, 1.0);
        } else {
            draw_frame(pen, low, high, 0.06 * unit, 0.6);
        }
        let is_seen = low.cmplt(pen.screen()).all() && high.cmpgt(Vec2::ZERO).all();
        if done == 0 && !is_seen {
            draw_at_edge(pen, 0.5 * (low + high), unit, READY);
        }
    }
}

/// Draws a thin ring around everything small that can be digested.
pub fn draw_food(pen: &mut Pen, style: &Style<'_>, view: View<'_>) {
    let unit = pen.line(TextSize::Body);
    for food in view.organisms().filter(|organism| prey::is_small(*organism) && organism.held_by().is_none()) {
        let (low, high) = food.bounds();
        let radius = 0.5 * (high - low).max_element() * style.camera.scale() + 0.35 * unit;
        let at = style.camera.to_screen(food.centroid());
        pen.canvas().arc(at, radius, 0.2 * unit, 1.0, fade(INK, 0.5));
        pen.canvas().arc(at, radius, 0.1 * unit, 1.0, READY);
    }
}

fn draw_frame(pen: &mut Pen, low: Vec2, high: Vec2, width: f32, alpha: f32) {
    let corners = [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
    for (width, colour) in [(2.2 * width, INK), (width, if alpha < 1.0 { HALO } else { READY })] {
        for k in 0..corners.len() {
            pen.canvas().segment(corners[k], corners[(k + 1) % corners.len()], width, fade(colour, alpha));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;

    #[test]
    fn t87_a_place_is_marked_until_the_player_was_there() {
        let drawn = |at: f32, done| {
            let camera = Camera::whole(Vec2::new(160.0, 90.0), Vec2::new(1280.0, 720.0));
            let style = Style { camera: &camera, time: None, is_classic: false, key: None };
            let mut pen = Pen::bare();
            let goal = Goal::Reach { low: Vec2::splat(at), high: Vec2::splat(at + 10.0) };
            draw_places(&mut pen, &style, [(&goal, done)].into_iter());
            pen.canvas().count(READY)
        };
        assert!(drawn(20.0, 0) > 0, "a frame");
        assert_eq!(drawn(20.0, 1), 0);
        let arrow = drawn(400.0, 0) - drawn(20.0, 0);
        assert!(arrow > 0, "and an arrow to what is outside");
    }
}
