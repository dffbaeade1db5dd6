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
    /// The best time in today's water, s, and how many lives there were; and the best times of the days before.
    today: Option<[u32; 2]>,
    before: [u32; 6],
}

impl FoodChainMenu {
    pub(super) fn new(context: &AppContext) -> Self {
        let items = [Key::ChainToday, Key::ChainOther, Key::GoalsTitle, Key::Back].map(MenuItem::new);
        let best = context.scores.of(NAME, LONGEST).next();
        let best = best.map(|score| score.points);
        let records = &context.chain_records;
        // One who has not played yet is told the rules.
        let goal = records.best.next_goal(Key::ChainNext).filter(|_| records.best != Feats::default());
        let day = todays_seed(context);
        let (today, before) = (records.of_day(day), records.before(day));
        Self { page: MenuPage::new(Key::TitleFoodChain, items.into()), best, goal, today, before }
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
        self.page.draw_note(&mut context.pen, &note(self.best, goal, self.today, &self.before));
    }

    fn name(&self) -> String {
        "food-chain".to_owned()
    }
}

/// What is said of the game and the best time, s; at today's water, to one who has played, how it went there, or the next goal, and how
/// it went on the days before.
fn note(best: Option<u32>, goal: Option<&str>, today: Option<[u32; 2]>, before: &[u32]) -> String {
    let about = words::text(Key::ChainAbout);
    let days = week(before);
    match (best, goal, today) {
        (_, Some(_), Some([time, lives])) => {
            let told = [("lives", lives.into()), ("time", time.into()), ("days", (&days).into())];
            words::text_with(Key::ChainTodayBest, &told)
        }
        (_, Some(goal), None) => {
            words::text_with(Key::ChainTodayNew, &[("goal", goal.into()), ("days", (&days).into())])
        }
        (None, None, _) => about.to_owned(),
        (Some(time), None, _) => words::text_with(Key::ChainBest, &[("about", about.into()), ("time", time.into())]),
    }
}

/// The best times of the days before today, the last day first; empty if there are none.
fn week(before: &[u32]) -> String {
    let time = |time: &u32| if *time == 0 { "-".to_owned() } else { time.to_string() };
    let days = before.iter().map(time).collect::<Vec<_>>().join(", ");
    if before.iter().all(|time| *time == 0) {
        String::new()
    } else {
        words::text_with(Key::ChainDays, &[("days", (&days).into())])
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
                note(None, None, None, &[0; 6]),
                note(longest, None, None, &[0; 6]),
                note(longest, goal.as_deref(), None, &[LONGEST as u32; 6]),
                note(longest, goal.as_deref(), Some([LONGEST as u32, 99]), &[LONGEST as u32; 6]),
            ];
            for note in &notes {
                assert!(is_seen_whole(note), "{note}");
            }
            assert!((1..4).all(|k| notes[k] != notes[k - 1]), "{notes:?}");
            let told = note(longest, goal.as_deref(), Some([70, 3]), &[0, 45, 0, 0, 0, 0]);
            assert!(told.contains("70 s") && told.contains('3') && told.contains("-, 45, -"), "{told}");
        }
    }
}
