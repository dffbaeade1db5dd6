//! The end of a food chain: how long the cell lived, what it has done, what ended it and the next goal. Of a match that is played again:
//! whose line lived longest.

use super::context::AppContext;
use super::end_menu::{EndMenu, doubted, rank, signature};
use super::food_chain::{LONGEST, WATERS, todays_seed};
use super::{MainScreen, Next, Paused, Screen, new_seed};
use crate::draw::palette::{HALO, READY, fade};
use crate::input::{Action, Input};
use crate::platform;
use crate::rules::food_chain::feats::Feats;
use crate::rules::food_chain::{Fate, Life, NAME};
use crate::rules::round::RoundResult;
use crate::rules::verdict::chain_verdict;
use crate::store::scores::Score;
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuLayout};
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu.
const MENU_TOP: f32 = 0.62;

/// Share of the picture's height above the text.
const TEXT_TOP: f32 = 0.1;

/// A part of the text: how it is written, what it says, and how easily it is left out where there is no room.
type Paragraph = (TextSize, Color, String, u8);

#[derive(Debug)]
pub(super) struct FoodChainEnd {
    life: Life,
    played: Paused,
    told: Vec<Paragraph>,
    menu: EndMenu,
    is_of_match: bool,
}

impl FoodChainEnd {
    /// The end of one that was played, which is kept among the best, or replayed.
    pub(super) fn new(result: RoundResult, life: Life, played: Paused, context: &mut AppContext) -> Self {
        platform::offer_again(NAME, life.seed);
        let feats = life.feats;
        let game = if let Paused::FoodChain(_) = played { NAME.to_owned() } else { context.game_of(played).label() };
        let is_plain = matches!(played, Paused::FoodChain(_)) || context.game_of(played).is_plain();
        let (name, day) = signature(context);
        let score =
            Score { game, time: LONGEST, points: feats.time, small: feats.small, rigid: feats.cells, name, day };
        let before = context.best_before;
        let place = result.record.map(|record| {
            let (place, kept) = context.scores.add(score, &context.store);
            let today = todays_seed(context);
            let day = Some(life.seed).filter(|seed| *seed == today);
            let kept = kept.and(context.chain_records.add(feats, day, &context.store));
            let ghost = if is_plain { context.best_life.add(&record, today, &context.store) } else { Ok(()) };
            context.keep_game(record, kept.and(ghost));
            place
        });
        let heading = |told| (TextSize::Large, HALO, doubted(told, result.is_mismatch), 0);
        if result.scores.len() > 1 {
            let told = vec![heading(chain_verdict(&result.scores, &[]))];
            return Self { life, played, told, menu: EndMenu::new(&[Key::EndWatch, Key::Title]), is_of_match: true };
        }
        let mut told = vec![heading(words::text_with(Key::ChainLived, &[("time", feats.time.into())]))];
        if let Some(place) = place {
            told.extend(place.map(|place| (TextSize::Body, if place == 0 { READY } else { HALO }, rank(place), 4)));
            let divide = context.settings.keys.label(Action::Divide);
            told.extend(told_of(&life, [before, context.chain_records.best], &divide));
        }
        let water = words::text_with(Key::ChainWater, &[("seed", (&life.seed.to_string()).into())]);
        told.push((TextSize::Small, fade(HALO, 0.85), water, 5));
        let menu = EndMenu::new(&[Key::ChainSame, Key::ChainOther, Key::EndWatch, Key::Title]);
        Self { life, played, told, menu, is_of_match: false }
    }
}

/// What was done, what ended it and how that is helped, and the next goal; `[before, now]` are the most of all lives, `divide` is what
/// is written on the key that divides.
fn told_of(life: &Life, [before, now]: [Feats; 2], divide: &str) -> Vec<Paragraph> {
    let Feats { small, cells, changes, bites, .. } = life.feats;
    let done = [("small", small.into()), ("cells", cells.into()), ("changes", changes.into()), ("bites", bites.into())];
    let mut told = vec![(TextSize::Body, HALO, words::text_with(Key::ChainDone, &done), 3)];
    if let Some(fate) = life.fate {
        let (missed, fact) = match fate {
            Fate::Starved => (Key::ChainStarved, Key::ChainStarvedFact),
            Fate::Eaten if life.feats.divisions == 0 => (Key::ChainEatenAlone, Key::ChainEatenFact),
            Fate::Eaten => (Key::ChainEaten, Key::ChainEatenFact),
        };
        told.push((TextSize::Body, HALO, words::text_with(missed, &[("key", divide.into())]), 1));
        told.push((TextSize::Small, fade(HALO, 0.85), words::text(fact).to_owned(), 6));
    }
    let [done, all] = now.goals();
    let new = done - before.goals()[0];
    let counts = [("new", (new as u32).into()), ("done", (done as u32).into()), ("all", (all as u32).into())];
    let (key, colour) = if new > 0 { (Key::ChainGoalsNew, READY) } else { (Key::ChainGoals, HALO) };
    told.push((TextSize::Body, colour, words::text_with(key, &counts), 2));
    told.extend(now.next_goal(Key::ChainNext).map(|goal| (TextSize::Body, HALO, goal, 0)));
    told
}

/// The text in lines, each with the height of its middle, and where they end, drawing units: without what has no room above `bottom`.
fn lines_of(pen: &Pen, told: &[Paragraph], bottom: f32) -> (Vec<(f32, TextSize, Color, String)>, f32) {
    for least in (1..=7).rev() {
        let (mut y, mut lines) = (TEXT_TOP * pen.screen().y, Vec::new());
        for (size, colour, text, _) in told.iter().filter(|(.., rank)| *rank < least) {
            for line in pen.wrap_evenly(*size, text, 0.92 * pen.screen().x) {
                lines.push((y + 0.5 * pen.line(*size), *size, *colour, line));
                y += pen.line(*size);
            }
            y += 0.3 * pen.line(TextSize::Small);
        }
        if y <= bottom || least == 1 {
            return (lines, y);
        }
    }
    (Vec::new(), 0.0)
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
        let other: fn(&AppContext) -> Next = |context| Next::Show(MainScreen::FoodChain(new_seed(context) % WATERS));
        let others: &[fn(&AppContext) -> Next] = &[other, |_| Next::Show(MainScreen::Replay)];
        self.menu.lead(input, context, MENU_TOP, again, if self.is_of_match { &[] } else { others })
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        self.menu.draw_shade(pen);
        let layout = MenuLayout::middle(pen, MENU_TOP);
        let (lines, end) = lines_of(pen, &self.told, layout.corner.y);
        let down = 0.4 * (layout.corner.y - end).max(0.0);
        let width = lines.iter().map(|(_, size, _, line)| pen.width(*size, line)).fold(0.0, f32::max);
        EndMenu::draw_panel(pen, width, [TEXT_TOP * pen.screen().y + down, end + down]);
        for (y, size, colour, line) in lines {
            pen.write(Vec2::new(0.5 * pen.screen().x, y + down), size, Align::Centre, colour, &line);
        }
        self.menu.menu.draw(pen, &layout);
    }

    fn name(&self) -> String {
        format!("food-chain-end-{:.0}", self.life.time.floor())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_says_what_was_done_and_missed_and_the_next_goal_and_leaves_room_for_the_menu() {
        let feats = Feats { time: 1234, changes: 12, small: 999, cells: 99, bites: 9999, divisions: 0 };
        let best = Feats { time: 1234, ..Feats::default() };
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            for fate in [Fate::Starved, Fate::Eaten] {
                let life = Life { time: 1234.5, fate: Some(fate), feats, seed: u64::MAX };
                let lived = words::text_with(Key::ChainLived, &[("time", 1234.into())]);
                let mut told = vec![(TextSize::Large, HALO, lived, 0), (TextSize::Body, READY, rank(9), 4)];
                told.extend(told_of(&life, [Feats::default(), best], "Caps Lock"));
                assert!(told.iter().any(|part| part.2 == best.next_goal(Key::ChainNext).unwrap()));
                assert!(told.iter().all(|part| !part.2.contains("--")), "no command");
                assert_eq!(fate == Fate::Eaten, told.iter().any(|part| part.2.contains("(Caps Lock)")));
                for (screen, factor) in [((640.0, 360.0), 1.5), ((1280.0, 720.0), 1.0)] {
                    let (pen, _) = Pen::measured(screen.into(), factor);
                    let bottom = MenuLayout::middle(&pen, MENU_TOP).corner.y;
                    let (lines, end) = lines_of(&pen, &told, bottom);
                    assert!(end <= bottom, "{}: {end} of {bottom}", language.code);
                    let all = lines.into_iter().map(|line| line.3).collect::<Vec<_>>().join(" ");
                    assert!(all.contains(told.last().unwrap().2.split(' ').next_back().unwrap()), "the goal: {all}");
                    assert!(
                        factor > 1.0 || told.iter().all(|part| all.contains(part.2.split(", ").next().unwrap())),
                        "all of it: {all}"
                    );
                }
            }
        }
    }
}
