//! The goals of the food chain, each to be reached in one life, and those of the other ways to play; and which are reached.

use super::context::AppContext;
use super::page::draw_sheet;
use super::{Next, Screen};
use crate::draw::palette::{HALO, INK, READY, fade};
use crate::input::{Input, Move};
use crate::rules::food_chain::feats::Feats;
use crate::rules::two_players::together;
use crate::slides::SLIDES;
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// Share of the picture's height above the first line.
const TOP: f32 = 0.26;
/// Distance of lines at most, and of the numbers in one, lines of text.
const LINE: f32 = 1.5;
const COLUMN: f32 = 2.15;

/// What goals ask for: what players call it, the most of it so far, and how much each goal asks for.
type Measure = (Key, u32, &'static [u32]);
/// What marks a measure that counts in the food chain only.
const OF_CHAIN: &str = " *";

#[derive(Debug)]
pub(super) struct Goals {
    /// Those of the food chain, of which there are so many, come first.
    measures: Vec<Measure>,
    of_chain: usize,
}

impl Goals {
    pub(super) fn new(context: &AppContext) -> Self {
        Self::of(context.chain_records.best, others(context))
    }

    fn of(best: Feats, others: [Measure; 4]) -> Self {
        let of_chain = best.measures().count();
        Self { measures: best.measures().chain(others).collect(), of_chain }
    }

    /// What a measure is called, with a mark if it counts in the food chain only.
    fn name_of(&self, k: usize) -> String {
        format!("{}{}", words::text(self.measures[k].0), if k < self.of_chain { OF_CHAIN } else { "" })
    }

    /// How many are reached, and how many there are.
    fn count(&self) -> [usize; 2] {
        let reached = |(_, most, wanted): &Measure| wanted.iter().filter(|least| most >= least).count();
        [self.measures.iter().map(reached).sum(), self.measures.iter().map(|(.., wanted)| wanted.len()).sum()]
    }
}

/// The goals of the game, of slides and of two who play together, from what is kept of them.
fn others(context: &AppContext) -> [Measure; 4] {
    let most = |game: &str, of: fn(&Score) -> u32| context.scores.of_game(game).map(of).max().unwrap_or_default();
    let game = context.game.label();
    let stars = SLIDES.iter().filter_map(|slide| Some(context.best_times.stars(slide.name, &slide.told()?))).sum();
    [
        (Key::GoalPoints, most(&game, |score| score.points), &[500, 1500, 3000, 5000]),
        (Key::GoalCiliates, most(&game, |score| score.rigid), &[1, 4, 8, 12]),
        (Key::GoalStars, stars, &[3, 13, 26, 39]),
        (Key::GoalTogether, most(&together(), |score| score.points), &[500, 2000, 4000]),
    ]
}

impl Screen for Goals {
    fn update(&mut self, input: &Input, _: &mut AppContext) -> Next {
        let leaves = matches!(input.step, Some(Move::Back | Move::Confirm)) || input.is_clicked;
        if leaves { Next::Back } else { Next::Stay }
    }

    fn draw(&mut self, context: &mut AppContext) {
        draw_goals(&mut context.pen, self);
    }

    fn name(&self) -> String {
        format!("goals-{}", self.count()[0])
    }
}

/// Where the text of a line begins, and the numbers, and what is behind them, in a line of this height: shares of the picture's width.
struct Columns {
    middle: f32,
    step: f32,
}

impl Columns {
    fn of(pen: &Pen, size: TextSize) -> Self {
        Self { middle: 0.4 * pen.screen().x, step: COLUMN * pen.line(size) }
    }

    fn of_number(&self, k: usize) -> f32 {
        self.middle + self.step * (0.5 + k as f32)
    }
}

/// The size of the text, and the distance of lines, with which all of them have room.
fn size_of(pen: &Pen, lines: usize) -> (TextSize, f32) {
    let room = (1.0 - TOP) * pen.screen().y - 1.6 * pen.line(TextSize::Small);
    let step = (room / lines.max(1) as f32).min(LINE * pen.line(TextSize::Body));
    (if step < 1.2 * pen.line(TextSize::Body) { TextSize::Small } else { TextSize::Body }, step)
}

/// Writes a line for each measure, with the numbers that its goals ask for: those that are reached have a light ground, and the most so
/// far is at the end.
fn draw_goals(pen: &mut Pen, goals: &Goals) {
    let [done, all] = goals.count();
    let counts = [("done", (done as u32).into()), ("all", (all as u32).into())];
    draw_sheet(pen, &words::text_with(Key::GoalsHeading, &counts));
    let (size, step) = size_of(pen, goals.measures.len());
    let (screen, line, columns) = (pen.screen(), pen.line(size), Columns::of(pen, size));
    for (k, (_, most, wanted)) in goals.measures.iter().enumerate() {
        let y = TOP * screen.y + step * (k as f32 + 0.5);
        pen.write(Vec2::new(columns.middle - 0.3 * line, y), size, Align::Right, HALO, &goals.name_of(k));
        for (k, least) in wanted.iter().enumerate() {
            let (at, text) = (Vec2::new(columns.of_number(k), y), least.to_string());
            let is_reached = most >= least;
            if is_reached {
                let half = Vec2::new(0.5 * pen.width(size, &text) + 0.2 * line, 0.46 * step.min(line));
                let radius = pen.rounding();
                pen.canvas().rounded(at - half, at + half, radius, READY);
            }
            pen.write(at, size, Align::Centre, if is_reached { INK } else { fade(HALO, 0.8) }, &text);
        }
        let (end, told) =
            (columns.of_number(5) - 0.4 * columns.step, words::text_with(Key::GoalsMost, &[("most", (*most).into())]));
        pen.write(Vec2::new(end, y), TextSize::Small, Align::Left, fade(HALO, 0.85), &told);
    }
    let at = Vec2::new(0.5 * screen.x, screen.y - 0.7 * pen.line(TextSize::Small));
    pen.write(at, TextSize::Small, Align::Centre, HALO, &legend());
}

/// What the mark means, and how to leave.
fn legend() -> String {
    words::text_with(Key::GoalsChain, &[("leave", words::text(Key::ScoresLeave).into())])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn goals(best: Feats, points: u32) -> Goals {
        let others: [Measure; 4] = [Key::GoalPoints, Key::GoalCiliates, Key::GoalStars, Key::GoalTogether]
            .map(|key| (key, points, [500].as_slice()));
        Goals::of(best, others)
    }

    #[test]
    fn goals_of_the_food_chain_are_marked_and_no_others() {
        let goals = goals(Feats::default(), 0);
        let marked = (0..goals.measures.len()).filter(|&k| goals.name_of(k).ends_with(OF_CHAIN));
        assert!(marked.eq(0..6));
    }

    #[test]
    fn goals_that_are_reached_have_a_ground_and_all_is_in_a_small_picture_with_the_largest_text() {
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            let screen = Vec2::new(640.0, 360.0);
            let grounds = |best, points| {
                let (mut pen, measure) = Pen::measured(screen, 1.5);
                let goals = goals(best, points);
                draw_goals(&mut pen, &goals);
                assert!(pen.canvas().corners().all(|(at, ..)| at.x >= 0.0 && at.x <= 640.0 && at.y <= 360.0));
                let (size, step) = size_of(&pen, goals.measures.len());
                assert!(step >= 0.85 * pen.line(size), "{step}");
                let columns = Columns::of(&pen, size);
                for name in (0..goals.measures.len()).map(|k| goals.name_of(k)) {
                    assert!(measure(size, &name) + 0.3 * pen.line(size) <= columns.middle, "{name}");
                }
                assert!(measure(TextSize::Small, &legend()) <= screen.x, "{}", legend());
                assert!(measure(size, "5000") < columns.step);
                let most = words::text_with(Key::GoalsMost, &[("most", 5854.into())]);
                assert!(columns.of_number(5) - 0.4 * columns.step + measure(TextSize::Small, &most) <= screen.x);
                pen.canvas().count(READY)
            };
            let some = Feats { time: 130, small: 20, ..Feats::default() };
            let more = Feats { time: 190, ..some };
            assert!(grounds(Feats::default(), 0) == 0 && grounds(some, 0) > 0 && grounds(more, 0) > grounds(some, 0));
            assert!(grounds(more, 500) > grounds(more, 499));
        }
    }
}
