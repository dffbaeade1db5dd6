//! High scores.

use super::context::AppContext;
use super::join::LONGEST;
use super::page::draw_sheet;
use super::pick::builtin_title;
use super::{Next, Overlay, Screen};
use crate::draw::palette::{HALO, READY};
use crate::input::{Input, Move};
use crate::rules::food_chain::NAME;
use crate::rules::two_players::together;
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// The best of one way to play: the heading, what points are called, and the scores.
type Page = (String, Key, Vec<Score>);

/// The lists of high scores: of the game, and of the other ways to play that have any. The goals follow.
#[derive(Debug)]
pub(super) struct ScoreList {
    pages: Vec<Page>,
    at: usize,
}

impl ScoreList {
    pub(super) fn new(context: &AppContext) -> Self {
        let (game, time) = (context.game.label(), context.game.time().unwrap_or_default());
        let scores = |game: &str| context.scores.of_game(game).cloned().collect::<Vec<Score>>();
        let of_game = context.scores.of(&game, time).cloned().collect();
        let first = (heading(&context.game.source.to_string(), time), Key::ScoresPoints, of_game);
        let others = [
            (NAME.to_owned(), Key::TitleFoodChain, Key::ScoresSeconds),
            (together(), Key::TitleTwoPlayers, Key::ScoresPoints),
        ];
        let others = others.map(|(game, title, points)| (words::text(title).to_owned(), points, scores(&game)));
        let pages = [first].into_iter().chain(others.into_iter().filter(|(.., scores)| !scores.is_empty()));
        Self { pages: pages.collect(), at: 0 }
    }
}

/// What a list of scores of a game of this name and time, s, is called.
fn heading(game: &str, time: f32) -> String {
    let (named, seconds) = (builtin_title(game), words::number(time, 0));
    words::text_with(Key::ScoresHeading, &[("game", named.text().into()), ("time", (&seconds).into())])
}

impl ScoreList {
    /// Shows the next list, and after the last one the goals.
    fn turn(&mut self, input: &Input) -> Next {
        if input.step == Some(Move::Back) || self.at == self.pages.len() {
            return Next::Back;
        }
        if input.step == Some(Move::Confirm) || input.is_clicked {
            self.at += 1;
            if self.at == self.pages.len() {
                return Next::Open(Overlay::Goals);
            }
        }
        Next::Stay
    }
}

impl Screen for ScoreList {
    fn update(&mut self, input: &Input, _: &mut AppContext) -> Next {
        self.turn(input)
    }

    fn draw(&mut self, context: &mut AppContext) {
        if let Some(page) = self.pages.get(self.at) {
            draw_page(&mut context.pen, page);
        }
    }

    fn name(&self) -> String {
        let (count, best) = self
            .pages
            .get(self.at)
            .map_or((0, 0), |(.., scores)| (scores.len(), scores.first().map_or(0, |score| score.points)));
        format!("scores-{count}-{best}")
    }
}

fn draw_page(pen: &mut Pen, (heading, points, scores): &Page) {
    draw_sheet(pen, heading);
    let (screen, line) = (pen.screen(), pen.line(TextSize::Body));
    if scores.is_empty() {
        pen.write(0.5 * screen, TextSize::Body, Align::Centre, HALO, words::text(Key::ScoresNone));
    }
    let (middle, top) = (0.5 * screen.x, 0.27 * screen.y);
    let shown = draw_table(pen, [middle, top], screen.y - 1.4 * line, scores, (*points, None));
    for (k, score) in scores.iter().take(shown).enumerate() {
        let y = top + line * (k + 1) as f32;
        let name: String = score.name.chars().take(LONGEST).collect();
        pen.write(Vec2::new(middle - 5.8 * line, y), TextSize::Small, Align::Right, HALO, &name);
        pen.write(Vec2::new(middle + 5.3 * line, y), TextSize::Small, Align::Left, HALO, &score.date());
    }
    let at = Vec2::new(0.5 * screen.x, screen.y - 0.7 * line);
    pen.write(at, TextSize::Small, Align::Centre, HALO, words::text(Key::ScoresNext));
}

/// Draws scores, or seconds, as a table from the middle of its upper edge down to `bottom`, one of them marked; returns how many there is room for.
pub(super) fn draw_table(
    pen: &mut Pen,
    [middle, top]: [f32; 2],
    bottom: f32,
    scores: &[Score],
    (points, marked): (Key, Option<usize>),
) -> usize {
    let line = pen.line(TextSize::Body);
    let columns = [-4.5, -1.0, 2.0, 4.5].map(|lines| middle + lines * line);
    let room = ((bottom - top) / line) as usize;
    let heads = ["", words::text(points), words::text(Key::ScoresSmall), words::text(Key::ScoresCells)];
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_named_in_the_language_of_the_player() {
        let headings = ["game", "a.toml"].map(|game| heading(game, 90.0));
        assert_eq!(headings, ["The game, 90 s", "a.toml, 90 s"].map(|game| format!("High scores: {game}")));
        words::choose(words::Language::named("cs").unwrap(), || None);
        assert!(heading("game", 90.0).ends_with("Hra, 90 s"));
    }

    #[test]
    fn lists_come_one_after_the_other_and_then_the_goals_which_lead_back() {
        let page = || (String::new(), Key::ScoresPoints, Vec::new());
        let mut list = ScoreList { pages: vec![page(), page()], at: 0 };
        let enter = Input { step: Some(Move::Confirm), ..Input::default() };
        assert!(matches!(list.turn(&enter), Next::Stay) && list.at == 1);
        assert!(matches!(list.turn(&Input::default()), Next::Stay) && list.at == 1);
        assert!(matches!(list.turn(&enter), Next::Open(Overlay::Goals)));
        assert!(matches!(list.turn(&Input::default()), Next::Back));
        let mut list = ScoreList { pages: vec![page()], at: 0 };
        assert!(matches!(list.turn(&Input { step: Some(Move::Back), ..Input::default() }), Next::Back));
    }
}
