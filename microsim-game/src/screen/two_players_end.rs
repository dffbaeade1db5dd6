//! The end of a round of two cells: who was better, or what both earned.

use super::context::AppContext;
use super::end_menu::{EndMenu, doubted, rank, signature};
use super::{MainScreen, Next, Paused, Screen};
use crate::draw::palette::{HALO, READY};
use crate::input::Input;
use crate::rules::round::RoundResult;
use crate::rules::two_players::{NAME, TwoPlayers};
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuLayout};
use crate::ui::pen::Align;
use crate::words::Key;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu.
const MENU_TOP: f32 = 0.5;

#[derive(Debug)]
pub(super) struct TwoPlayersEnd {
    heading: String,
    place: Option<usize>,
    points: u32,
    way: TwoPlayers,
    menu: EndMenu,
}

impl TwoPlayersEnd {
    /// The end of a round that was played, or replayed. The sum of both is kept among the best if they played together.
    pub(super) fn new(result: RoundResult, way: TwoPlayers, played: Paused, context: &mut AppContext) -> Self {
        let scores = &result.scores;
        let points = scores.iter().sum();
        // A replay does not know how they played.
        let told = if played == Paused::Replay { TwoPlayers::Versus.summary(scores) } else { way.verdict(scores, &[]) };
        let place = result.record.and_then(|record| {
            let game = format!("{NAME}, together");
            let (name, day) = signature(context);
            let score = Score { game, time: result.time, points, small: 0, rigid: 0, name, day };
            let is_kept = way == TwoPlayers::Together;
            let (place, kept) = if is_kept { context.scores.add(score, &context.store) } else { (None, Ok(())) };
            context.keep_game(record, kept);
            place
        });
        let menu = EndMenu::new(&[Key::EndAgain, Key::EndWatch, Key::Title]);
        Self { heading: doubted(told, result.is_mismatch), place, points, way, menu }
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
        let mut at = Vec2::new(0.5, 0.24) * pen.screen();
        for line in pen.wrap(TextSize::Large, &self.heading, 0.94 * pen.screen().x) {
            pen.write(at, TextSize::Large, Align::Centre, HALO, &line);
            at.y += pen.line(TextSize::Large);
        }
        if let Some(place) = self.place {
            pen.write(at, TextSize::Body, Align::Centre, READY, &rank(place));
        }
        self.menu.menu.draw(pen, &MenuLayout::middle(pen, MENU_TOP));
    }

    fn name(&self) -> String {
        format!("two-players-end-{}", self.points)
    }
}
