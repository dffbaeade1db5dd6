//! What the game draws above the scene: score, time, and marks at what matters (thesis, 3.3.2). No mark tells anything by its
//! colour alone.

pub mod captions;
pub mod food_chain;
pub mod marks;
pub mod own;
pub mod places;
pub mod pulse;
pub mod tint;

use crate::draw::palette::{ALERT, HALO, INK, PLAYERS, READY, fade};
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// Time at the end in which the clock stands out, s.
const LAST_SECONDS: f32 = 10.0;

/// Time at the end in which seconds are counted in the middle, s.
const COUNTED_SECONDS: f32 = 5.0;

/// What the status line says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status<'a> {
    /// Points so far, or which goals are reached: parts that are each about one of several players, or about all.
    pub score: &'a [(Option<usize>, String)],
    /// Time left and time in all, s.
    pub time: [f32; 2],
    /// Whether time is left until a cell starves.
    pub starves: bool,
    /// Whether nothing may flash.
    pub is_calm: bool,
    /// What else there is to know; empty if nothing.
    pub note: &'a str,
}

/// Draws score and time along the upper edge.
pub fn draw_status(pen: &mut Pen, status: &Status<'_>) {
    let (screen, line) = (pen.screen(), pen.line(TextSize::Large));
    let [left, whole] = status.time;
    let share = (left / whole).clamp(0.0, 1.0);
    let is_late = left <= LAST_SECONDS;
    let bar = Vec2::new(screen.x, 0.16 * line);
    pen.canvas().rectangle(Vec2::ZERO, bar, fade(INK, 0.6));
    let colour = if is_late { ALERT } else { READY };
    pen.canvas().rectangle(Vec2::ZERO, Vec2::new(bar.x * share, bar.y), colour);
    let middle = bar.y + 0.75 * line;
    let step = |pen: &Pen, size, part: &str| pen.width(size, part) + 0.9 * pen.line(size);
    let width = |size| status.score.iter().map(|(_, part)| step(pen, size, part)).sum::<f32>();
    let fits = |size: &TextSize| width(*size) <= 0.75 * screen.x;
    let size = [TextSize::Large, TextSize::Body].into_iter().find(fits).unwrap_or(TextSize::Small);
    let score = width(size);
    let mut left_edge = 0.3 * line;
    for (player, part) in status.score {
        let colour = player.map_or(HALO, |player| PLAYERS[player % PLAYERS.len()].1);
        pen.label(Vec2::new(left_edge, middle), size, Align::Left, colour, part);
        left_edge += step(pen, size, part);
    }
    let blinks = is_late && !status.is_calm && left.fract() < 0.35 && left > 0.0;
    let colour = if blinks { ALERT } else { HALO };
    pen.label(Vec2::new(screen.x - 0.3 * line, middle), TextSize::Large, Align::Right, colour, &clock(left));
    if status.starves {
        let at = Vec2::new(screen.x - 0.3 * line, middle + 0.62 * (line + pen.line(TextSize::Small)));
        pen.label(at, TextSize::Small, Align::Right, colour, words::text(Key::HudStarves));
    }
    if left > 0.0 && left <= COUNTED_SECONDS && whole > COUNTED_SECONDS {
        let at = Vec2::new(0.5 * screen.x, middle + 1.6 * line);
        pen.label(at, TextSize::Large, Align::Centre, ALERT, &(left.ceil() as u32).to_string());
    }
    if !status.note.is_empty() {
        let beside = score.max(pen.width(TextSize::Large, &clock(left))) + line;
        let width = pen.width(TextSize::Body, status.note);
        // Below the score, where it would cover it.
        let y = if width + 2.0 * beside > screen.x { middle + line } else { middle };
        let size = if width > 0.96 * screen.x { TextSize::Small } else { TextSize::Body };
        pen.label(Vec2::new(0.5 * screen.x, y), size, Align::Centre, HALO, status.note);
    }
}

/// Advice above the lower edge, of which some height may be covered.
pub fn draw_advice(pen: &mut Pen, text: &str, covered: f32) {
    let (screen, line) = (pen.screen(), pen.line(TextSize::Body));
    for (k, text) in pen.wrap_evenly(TextSize::Body, text, 0.9 * screen.x).iter().rev().enumerate() {
        let at = Vec2::new(0.5 * screen.x, screen.y - covered - (0.9 + 1.12 * k as f32) * line);
        pen.label(at, TextSize::Body, Align::Centre, HALO, text);
    }
}

/// What was just done, as advice, with a tick before it.
pub fn draw_done(pen: &mut Pen, text: &str, covered: f32) {
    draw_advice(pen, text, covered);
    let (screen, line) = (pen.screen(), pen.line(TextSize::Body));
    let lines = pen.wrap_evenly(TextSize::Body, text, 0.9 * screen.x);
    let height = screen.y - covered - (0.9 + 1.12 * lines.len() as f32) * line;
    let (at, size) = (Vec2::new(0.5 * screen.x, height - 0.2 * line), 0.9 * line);
    let corners = [[-0.55, -0.05], [-0.1, 0.4], [0.6, -0.5]].map(|[x, y]| at + size * Vec2::new(x, y));
    for (width, colour) in [(0.4 * size, INK), (0.22 * size, READY)] {
        corners.windows(2).for_each(|pair| pen.canvas().segment(pair[0], pair[1], width, colour));
    }
}

/// Time as minutes and seconds, a started second counting as a whole one.
fn clock(time: f32) -> String {
    let seconds = time.max(0.0).ceil() as u32;
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_done_has_a_tick_above_its_text_and_inside_the_picture() {
        let (mut pen, _) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
        let lowest = |pen: &mut Pen| pen.canvas().corners().map(|(at, ..)| at.y).fold(f32::MAX, f32::min);
        draw_advice(&mut pen, "Reach the place", 0.0);
        let above = lowest(&mut pen);
        assert_eq!(pen.canvas().count(READY), 0);
        draw_done(&mut pen, "Reach the place", 0.0);
        assert!(pen.canvas().count(READY) > 0 && lowest(&mut pen) < above && lowest(&mut pen) > 0.0);
    }

    #[test]
    fn points_of_players_have_their_colours_side_by_side() {
        let (mut pen, _) = Pen::measured(Vec2::new(1280.0, 720.0), 1.0);
        let score = [30, 50].map(|points| points.to_string());
        let [first, second] = [0, 1].map(|k| (Some(k), score[k].clone()));
        let panels = |pen: &mut Pen, score: &[(Option<usize>, String)]| {
            draw_status(pen, &Status { score, time: [50.0, 60.0], starves: false, is_calm: true, note: "" });
            let left = pen.canvas().corners().map(|(at, ..)| at).filter(|at| at.y > 9.0 && at.x < 640.0);
            left.map(|at| at.x).fold(0.0, f32::max)
        };
        let one = panels(&mut pen, std::slice::from_ref(&first));
        assert!(panels(&mut pen, &[first, second]) > one + 20.0);
    }

    #[test]
    fn the_last_seconds_are_counted_in_the_middle() {
        let middle = |left: f32| {
            let (mut pen, _) = Pen::measured(Vec2::new(640.0, 360.0), 1.0);
            draw_status(
                &mut pen,
                &Status {
                    score: &[(None, "1".to_owned())],
                    time: [left, 60.0],
                    starves: true,
                    is_calm: true,
                    note: "",
                },
            );
            let at: Vec<Vec2> = pen.canvas().corners().map(|(at, ..)| at).collect();
            at.into_iter().filter(|at| at.x > 280.0 && at.x < 360.0 && at.y > 40.0).count()
        };
        assert_eq!([6.0, 5.5, 0.0].map(middle), [0; 3]);
        assert!([5.0, 4.2, 0.1].map(middle).iter().all(|corners| *corners > 0));
    }

    #[test]
    fn a_clock_of_hunger_says_so_below() {
        let lowest = |starves| {
            let (mut pen, _) = Pen::measured(Vec2::new(640.0, 360.0), 1.0);
            draw_status(&mut pen, &Status { score: &[], time: [20.0, 60.0], starves, is_calm: true, note: "" });
            pen.canvas().corners().map(|(at, ..)| at.y).fold(0.0, f32::max)
        };
        assert!(lowest(true) > lowest(false) + 5.0);
    }

    #[test]
    fn t68_the_clock_reads_as_minutes_and_seconds() {
        assert_eq!([90.0, 60.0, 59.2, 0.1, 0.0, -1.0].map(clock), ["1:30", "1:00", "1:00", "0:01", "0:00", "0:00"]);
    }
}
