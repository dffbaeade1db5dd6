//! The way into the food chain: today's water, which is the same for everybody, or another one.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Overlay, Screen, new_seed, today};
use crate::input::Input;
use crate::rules::food_chain::NAME;
use crate::rules::food_chain::feats::Feats;
use crate::ui::menu::{Menu, MenuItem};
use crate::words::{self, Key};

/// How many other waters there are: numbers that people can say.
pub(super) const WATERS: u64 = 1_000_000;
/// Time that the rules allow, s: scores of the food chain are kept under it.
pub(super) const LONGEST: f32 = 3600.0;

#[derive(Debug)]
pub(super) struct FoodChainMenu {
    page: MenuPage,
    best: Option<u32>,
    /// The next goal of one who has played.
    goal: Option<String>,
    /// The best time in today's water, s.
    today: Option<u32>,
}

impl FoodChainMenu {
    pub(super) fn new(context: &AppContext) -> Self {
        let items = [Key::ChainToday, Key::ChainOther, Key::GoalsTitle, Key::Back].map(MenuItem::new);
        let best = context.scores.of(NAME, LONGEST).next();
        let best = best.map(|score| score.points);
        let records = &context.chain_records;
        // One who has not played yet is told the rules.
        let goal = records.best.next_goal(Key::ChainNext).filter(|_| records.best != Feats::default());
        let today = records.of_day(todays_seed(context));
        Self { page: MenuPage::new(Key::TitleFoodChain, items.into()), best, goal, today }
    }
}

impl Screen for FoodChainMenu {
    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        self.page.choose(input, &context.pen, |item| match item {
            0 => Next::Show(MainScreen::FoodChain(todays_seed(context))),
            1 => Next::Show(MainScreen::FoodChain(new_seed(context) % WATERS)),
            _ => Next::Open(Overlay::Goals),
        })
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        let goal = self.goal.as_deref().filter(|_| self.page.menu.focus() == 0);
        self.page.draw_note(&mut context.pen, &note(self.best, goal, self.today));
    }

    fn name(&self) -> String {
        "food-chain".to_owned()
    }
}

/// What is said of the game and the best time, s; at today's water, to one who has played, how it went there and the next goal.
fn note(best: Option<u32>, goal: Option<&str>, today: Option<u32>) -> String {
    let about = words::text(Key::ChainAbout);
    match (best, goal, today) {
        (_, Some(goal), Some(time)) => {
            words::text_with(Key::ChainTodayBest, &[("time", time.into()), ("goal", goal.into())])
        }
        (_, Some(goal), None) => words::text_with(Key::ChainTodayNew, &[("goal", goal.into())]),
        (None, None, _) => about.to_owned(),
        (Some(time), None, _) => words::text_with(Key::ChainBest, &[("about", about.into()), ("time", time.into())]),
    }
}

/// The number of the day, but for pictures that must come out the same.
pub(super) fn todays_seed(context: &AppContext) -> u64 {
    today(context).map_or(1, u64::from)
}

#[cfg(test)]
mod tests {
    use super::super::page::is_seen_whole;
    use super::*;

    #[test]
    fn the_rules_are_seen_whole_in_a_small_window() {
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            let (longest, goal) = (Some(LONGEST as u32), Feats::default().next_goal(Key::ChainNext));
            let notes = [
                note(None, None, None),
                note(longest, None, None),
                note(longest, goal.as_deref(), None),
                note(longest, goal.as_deref(), longest),
            ];
            for note in &notes {
                assert!(is_seen_whole(note), "{note}");
            }
            assert!((1..4).all(|k| notes[k] != notes[k - 1]), "{notes:?}");
        }
    }
}
