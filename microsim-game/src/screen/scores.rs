//! High scores.

use super::context::AppContext;
use super::join::LONGEST;
use super::page::draw_heading;
use super::{Next, Screen};
use crate::draw::palette::{HALO, READY};
use crate::input::{Input, Move};
use crate::slides::SLIDES;
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// Most stars for a slide.
const MOST_STARS: u32 = 3;

/// The list of high scores of the game.
#[derive(Debug)]
pub(super) struct ScoreList {
    /// Name of the game, and its time, s.
    game: [String; 2],
    scores: Vec<Score>,
    /// What was reached beside the game.
    others: String,
}

impl ScoreList {
    pub(super) fn new(context: &AppContext) -> Self {
        let (game, time) = (context.game.label(), context.game.time().unwrap_or_default());
        let named = [context.game.source.to_string(), words::number(time, 0)];
        let slides = SLIDES.iter().filter_map(|slide| Some(context.best_times.stars(slide.name, &slide.told()?)));
        let (longest, stars) = (context.chain_records.best.time, slides.sum::<u32>());
        let args =
            [("time", longest.into()), ("stars", stars.into()), ("all", (MOST_STARS * SLIDES.len() as u32).into())];
        let others = words::text_with(Key::ScoresOthers, &args);
        Self { game: named, scores: context.scores.of(&game, time).cloned().collect(), others }
    }
}

impl Screen for ScoreList {
    fn update(&mut self, input: &Input, _: &mut AppContext) -> Next {
        let leaves = matches!(input.step, Some(Move::Back | Move::Confirm)) || input.is_clicked;
        if leaves { Next::Back } else { Next::Stay }
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        let args = [("game", (&self.game[0]).into()), ("time", (&self.game[1]).into())];
        draw_heading(pen, &words::text_with(Key::ScoresHeading, &args));
        let (screen, line) = (pen.screen(), pen.line(TextSize::Body));
        if self.scores.is_empty() {
            pen.write(0.5 * screen, TextSize::Body, Align::Centre, HALO, words::text(Key::ScoresNone));
        }
        let (middle, top) = (0.5 * screen.x, 0.27 * screen.y);
        let shown = draw_table(pen, [middle, top], 0.85 * screen.y, &self.scores, None);
        for (k, score) in self.scores.iter().take(shown).enumerate() {
            let y = top + line * (k + 1) as f32;
            let name: String = score.name.chars().take(LONGEST).collect();
            pen.write(Vec2::new(middle - 5.8 * line, y), TextSize::Small, Align::Right, HALO, &name);
            pen.write(Vec2::new(middle + 5.3 * line, y), TextSize::Small, Align::Left, HALO, &score.date());
        }
        let at = Vec2::new(0.5 * screen.x, screen.y - 2.2 * line);
        pen.write(at, TextSize::Body, Align::Centre, HALO, &self.others);
        let at = Vec2::new(0.5 * screen.x, screen.y - line);
        pen.write(at, TextSize::Small, Align::Centre, HALO, words::text(Key::ScoresLeave));
    }

    fn name(&self) -> String {
        let best = self.scores.first().map_or(0, |score| score.points);
        format!("scores-{}-{best}", self.scores.len())
    }
}

/// Draws scores as a table from the middle of its upper edge down to `bottom`, one of them marked; returns how many there is room for.
pub(super) fn draw_table(
    pen: &mut Pen,
    [middle, top]: [f32; 2],
    bottom: f32,
    scores: &[Score],
    marked: Option<usize>,
) -> usize {
    let line = pen.line(TextSize::Body);
    let columns = [-4.5, -1.0, 2.0, 4.5].map(|lines| middle + lines * line);
    let room = ((bottom - top) / line) as usize;
    let heads = ["", words::text(Key::ScoresPoints), words::text(Key::ScoresSmall), words::text(Key::ScoresCells)];
    if !scores.is_empty() {
        for (x, head) in columns.into_iter().zip(heads) {
            pen.write(Vec2::new(x, top), TextSize::Small, Align::Right, HALO, head);
        }
    }
    let room = room.saturating_sub(1);
    for (k, score) in scores.iter().take(room).enumerate() {
        let is_marked = marked == Some(k);
        let colour = if is_marked { READY } else { HALO };
        let rank = if is_marked { format!("> {}", k + 1) } else { (k + 1).to_string() };
        let cells = [rank, score.points.to_string(), score.small.to_string(), score.rigid.to_string()];
        for (x, cell) in columns.into_iter().zip(cells) {
            pen.write(Vec2::new(x, top + line * (k + 1) as f32), TextSize::Body, Align::Right, colour, &cell);
        }
    }
    room
}
