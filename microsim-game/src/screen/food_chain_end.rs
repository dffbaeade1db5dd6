//! The end of a food chain: how long the cell lived, what ended it, and the way to the same water again. Of a match that is played
//! again: whose line lived longest.

use super::context::AppContext;
use super::end_menu::{EndMenu, doubted, rank};
use super::food_chain::LONGEST;
use super::page::draw_shade;
use super::{MainScreen, Next, Paused, Screen, new_seed};
use crate::draw::palette::{HALO, READY, fade};
use crate::input::Input;
use crate::platform;
use crate::rules::food_chain::{Fate, NAME};
use crate::rules::prey_class;
use crate::rules::round::{Life, RoundResult};
use crate::rules::verdict::chain_verdict;
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuLayout};
use crate::ui::pen::Align;
use crate::words::{self, Key};
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu.
const MENU_TOP: f32 = 0.62;

#[derive(Debug)]
pub(super) struct FoodChainEnd {
    life: Life,
    played: Paused,
    lines: Vec<(TextSize, Color, String)>,
    menu: EndMenu,
    is_of_match: bool,
}

impl FoodChainEnd {
    /// The end of one that was played, which is kept among the best, or replayed.
    pub(super) fn new(result: RoundResult, life: Life, played: Paused, context: &mut AppContext) -> Self {
        let count = |is_rigid: bool| {
            let of_sort = result.kinds.iter().filter(|(kind, _)| prey_class::is_rigid(*kind) == is_rigid);
            of_sort.map(|(_, entry)| entry.count).sum()
        };
        let points = life.time as u32;
        let game = if let Paused::FoodChain(_) = played { NAME.to_owned() } else { context.game_of(played).label() };
        let score = Score { game, time: LONGEST, points, small: count(false), rigid: count(true) };
        let place = result.record.and_then(|record| {
            let (place, kept) = context.scores.add(score, &context.store);
            context.keep_game(record, kept);
            place
        });
        if result.scores.len() > 1 {
            let told = doubted(chain_verdict(&result.scores, &[]), result.is_mismatch);
            let (lines, menu) = (vec![(TextSize::Large, HALO, told)], EndMenu::new(&[Key::EndWatch, Key::Title]));
            return Self { life, played, lines, menu, is_of_match: true };
        }
        let lived = words::text_with(Key::ChainLived, &[("time", (life.time as u32).into())]);
        let mut lines = vec![(TextSize::Large, HALO, doubted(lived, result.is_mismatch))];
        lines.extend(place.map(|place| (TextSize::Body, READY, rank(place))));
        let told = life.fate.map(|fate| if fate == Fate::Starved { Key::ChainStarved } else { Key::ChainEaten });
        lines.extend(told.map(|told| (TextSize::Body, HALO, words::text(told).to_owned())));
        let water = words::text_with(Key::ChainWater, &[("seed", (&life.seed.to_string()).into())]);
        let again = platform::offer_again(NAME, life.seed).map_or_else(
            || words::text(Key::ChainLink).to_owned(),
            |command| words::text_with(Key::ChainCommand, &[("command", (&command).into())]),
        );
        let share = format!("{water} {again}");
        lines.push((TextSize::Small, fade(HALO, 0.85), share));
        let menu = EndMenu::new(&[Key::ChainSame, Key::ChainOther, Key::EndWatch, Key::Title]);
        Self { life, played, lines, menu, is_of_match: false }
    }
}

impl Screen for FoodChainEnd {
    fn menu(&self) -> Option<&Menu> {
        Some(&self.menu.menu)
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let again = || match self.played {
            Paused::Replay if !self.is_of_match => Next::Show(MainScreen::FoodChain(self.life.seed)),
            played => played.restart(),
        };
        let other: fn(&AppContext) -> Next = |context| Next::Show(MainScreen::FoodChain(new_seed(context)));
        let others: &[fn(&AppContext) -> Next] = &[other, |_| Next::Show(MainScreen::Replay)];
        self.menu.lead(input, context, MENU_TOP, again, if self.is_of_match { &[] } else { others })
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        draw_shade(pen);
        let mut y = 0.14 * pen.screen().y;
        for (size, colour, text) in &self.lines {
            for line in pen.wrap_evenly(*size, text, 0.92 * pen.screen().x) {
                let at = Vec2::new(0.5 * pen.screen().x, y);
                pen.write(at, *size, Align::Centre, *colour, &line);
                y += pen.line(*size);
            }
            y += 0.3 * pen.line(TextSize::Small);
        }
        self.menu.menu.draw(pen, &MenuLayout::middle(pen, MENU_TOP));
    }

    fn name(&self) -> String {
        format!("food-chain-end-{:.0}", self.life.time.floor())
    }
}
