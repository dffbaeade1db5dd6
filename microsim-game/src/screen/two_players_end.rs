//! The end of a round of two cells: who was better, by what, and who has won more rounds; or what both earned.

use super::context::AppContext;
use super::end_menu::{EndMenu, doubted, rank, signature};
use super::scores::draw_table;
use super::{MainScreen, Next, Paused, Screen};
use crate::draw::palette::{HALO, PLAYERS, READY};
use crate::input::Input;
use crate::rules::round::RoundResult;
use crate::rules::two_players::{TwoPlayers, together, winner};
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuLayout};
use crate::ui::pen::{Align, Pen};
use crate::words::Key;
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the text, and above the menu.
const TOP: f32 = 0.12;
const MENU_TOP: f32 = 0.62;

#[derive(Debug)]
pub(super) struct TwoPlayersEnd {
    heading: String,
    /// What is said below it: a place among the best, or how many rounds each has won.
    note: Option<String>,
    /// Of each player.
    table: Vec<Score>,
    winner: Option<usize>,
    way: TwoPlayers,
    menu: EndMenu,
}

impl TwoPlayersEnd {
    /// The end of a round that was played, or replayed. The sum of both is kept among the best if they played together.
    pub(super) fn new(result: RoundResult, way: TwoPlayers, played: Paused, context: &mut AppContext) -> Self {
        // A replay does not know how they played.
        let parts = || TwoPlayers::Versus.summary(&result.scores).into_iter().map(|(_, told)| told);
        let told = if played == Paused::Replay {
            parts().collect::<Vec<_>>().join("   ")
        } else {
            way.verdict(&result.scores, &[])
        };
        let heading = doubted(told, result.is_mismatch);
        let time = result.time;
        let score = |points, [small, rigid]: [u32; 2]| Score {
            game: together(),
            time,
            points,
            small,
            rigid,
            name: String::new(),
            day: 0,
        };
        let table: Vec<Score> =
            result.scores.iter().zip(&result.counts).map(|(points, of)| score(*points, *of)).collect();
        let winner = winner(&result.scores).filter(|_| way != TwoPlayers::Together);
        let note = result.record.and_then(|record| {
            let (note, kept) = if way == TwoPlayers::Together {
                let sum = |of: fn(&Score) -> u32| table.iter().map(of).sum();
                let (name, day) = signature(context);
                let counts = [sum(|score| score.small), sum(|score| score.rigid)];
                let all = Score { name, day, ..score(sum(|score| score.points), counts) };
                let (place, kept) = context.scores.add(all, &context.store);
                (place.map(rank), kept)
            } else {
                (Some(context.rounds_won.count(way, winner)), Ok(()))
            };
            context.keep_game(record, kept);
            note
        });
        let menu = EndMenu::new(&[Key::EndAgain, Key::EndWatch, Key::Title]);
        Self { heading, note, table, winner, way, menu }
    }
}

fn colour_of(player: usize) -> Color {
    PLAYERS[player % PLAYERS.len()].1
}

/// Draws the heading, the note, and the table where it has room above `bottom`.
fn draw_text(pen: &mut Pen, end: &TwoPlayersEnd, bottom: f32) {
    let (mut at, line) = (Vec2::new(0.5, TOP) * pen.screen(), pen.line(TextSize::Body));
    let large = pen.line(TextSize::Large);
    let heading = pen.wrap(TextSize::Large, &end.heading, 0.94 * pen.screen().x);
    let table = at.y + large * heading.len() as f32 + if end.note.is_some() { 1.4 * line } else { 0.0 };
    let below = table + line * (end.table.len() as f32 + 0.6);
    let has_table = below <= bottom;
    let width = heading.iter().map(|text| pen.width(TextSize::Large, text)).fold(12.5 * line, f32::max);
    EndMenu::draw_panel(pen, width, [at.y - 0.5 * large, if has_table { below } else { table - 0.6 * line }]);
    for text in heading {
        pen.write(at, TextSize::Large, Align::Centre, end.winner.map_or(HALO, colour_of), &text);
        at.y += large;
    }
    if let Some(note) = &end.note {
        pen.write(at, TextSize::Body, Align::Centre, READY, note);
    }
    if !has_table {
        return;
    }
    draw_table(pen, [at.x, table], bottom, &end.table, (Key::ScoresPoints, end.winner));
    for player in 0..end.table.len() {
        // Each row begins in the colour of the cell.
        let mark = Vec2::new(at.x - 6.2 * line, table + line * (1.0 + player as f32));
        pen.canvas().circle(mark, 0.2 * line, 0.4 * line, colour_of(player));
    }
}

impl Screen for TwoPlayersEnd {
    fn menu(&self) -> Option<&Menu> {
        Some(&self.menu.menu)
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let again = || Next::Show(MainScreen::TwoPlayers(self.way));
        self.menu.lead(input, context, MENU_TOP, again, &[|_| Next::Show(MainScreen::Replay)])
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        self.menu.draw_shade(pen);
        let layout = MenuLayout::middle(pen, MENU_TOP);
        draw_text(pen, self, layout.corner.y);
        self.menu.menu.draw(pen, &layout);
    }

    fn name(&self) -> String {
        format!("two-players-end-{}", self.table.iter().map(|score| score.points).sum::<u32>())
    }
}
