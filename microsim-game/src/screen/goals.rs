//! The goals of the food chain: what each asks for in one life, and which are reached.

use super::context::AppContext;
use super::page::draw_heading;
use super::{Next, Screen};
use crate::draw::palette::{HALO, READY, fade};
use crate::input::{Input, Move};
use crate::rules::food_chain::feats::Feats;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// Share of the picture's height above the first line.
const TOP: f32 = 0.3;
/// Distance of lines, and of the numbers in one, lines of text.
const LINE: f32 = 1.5;
const COLUMN: f32 = 2.2;

#[derive(Debug)]
pub(super) struct Goals {
    best: Feats,
}

impl Goals {
    pub(super) fn new(context: &AppContext) -> Self {
        Self { best: context.chain_records.best }
    }
}

impl Screen for Goals {
    fn update(&mut self, input: &Input, _: &mut AppContext) -> Next {
        let leaves = matches!(input.step, Some(Move::Back | Move::Confirm)) || input.is_clicked;
        if leaves { Next::Back } else { Next::Stay }
    }

    fn draw(&mut self, context: &mut AppContext) {
        draw_goals(&mut context.pen, self.best);
    }

    fn name(&self) -> String {
        format!("goals-{}", self.best.goals()[0])
    }
}

/// Writes a line for each measure, with the numbers that its goals ask for: those that are reached have a ring, and the most of all
/// lives is at the end.
fn draw_goals(pen: &mut Pen, best: Feats) {
    let [done, all] = best.goals();
    let counts = [("done", (done as u32).into()), ("all", (all as u32).into())];
    draw_heading(pen, &words::text_with(Key::ChainGoals, &counts));
    let (screen, line) = (pen.screen(), pen.line(TextSize::Body));
    let middle = 0.47 * screen.x;
    for (k, (what, most, wanted)) in best.measures().enumerate() {
        let y = TOP * screen.y + LINE * line * k as f32;
        pen.write(Vec2::new(middle - 0.5 * line, y), TextSize::Body, Align::Right, HALO, words::text(what));
        for (k, least) in wanted.iter().enumerate() {
            let at = Vec2::new(middle + (1.0 + COLUMN * k as f32) * line, y);
            let is_reached = most >= *least;
            let colour = if is_reached { READY } else { fade(HALO, 0.7) };
            if is_reached {
                pen.canvas().arc(at, 0.85 * line, 0.1 * line, 1.0, READY);
            }
            pen.write(at, TextSize::Body, Align::Centre, colour, &least.to_string());
        }
        let end = Vec2::new(middle + (1.0 + COLUMN * 5.0) * line, y);
        pen.write(
            end,
            TextSize::Small,
            Align::Left,
            fade(HALO, 0.85),
            &words::text_with(Key::GoalsMost, &[("most", most.into())]),
        );
    }
    let at = Vec2::new(0.5 * screen.x, screen.y - line);
    pen.write(at, TextSize::Small, Align::Centre, HALO, words::text(Key::ScoresLeave));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_that_are_reached_have_rings_and_all_is_in_a_small_picture_with_the_largest_text() {
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            let rings = |best| {
                let (mut pen, _) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
                draw_goals(&mut pen, best);
                assert!(pen.canvas().corners().all(|(at, ..)| at.x >= 0.0 && at.x <= 640.0 && at.y <= 360.0));
                pen.canvas().count(READY)
            };
            let some = Feats { time: 130, small: 20, ..Feats::default() };
            let more = Feats { time: 190, ..some };
            assert!(rings(Feats::default()) == 0 && rings(some) > 0 && rings(more) > rings(some));
        }
    }
}
