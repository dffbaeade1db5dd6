//! The list of slides, with the stars that the player has got and the facts that were found.

use super::context::AppContext;
use super::page::MenuPage;
use super::{MainScreen, Next, Screen};
use crate::input::{Input, Move};
use crate::slides::SLIDES;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key};
use microsim_core::scenario::Slide;

#[derive(Debug)]
pub(super) struct SlideList {
    page: MenuPage,
    notes: Vec<String>,
}

impl SlideList {
    /// The list, with the focus on one slide, or on the first that has no star yet.
    pub(super) fn new(focus: Option<usize>, context: &AppContext) -> Self {
        let slides = SLIDES.iter().filter_map(|builtin| Some((builtin.name, builtin.told()?)));
        let (items, notes): (Vec<MenuItem>, Vec<String>) = slides
            .map(|(name, slide)| {
                let best = context.best_times.of(name);
                let note = best.map_or_else(|| slide.task.clone(), |time| note_of(&slide, time));
                (MenuItem::rated(slide.title.clone(), context.best_times.stars(name, &slide)), note)
            })
            .unzip();
        let focus = focus.unwrap_or_else(|| first_left(&items));
        let mut page = MenuPage::new(Key::TitleSlides, items);
        page.menu.set_focus(focus);
        Self { page, notes }
    }
}

impl Screen for SlideList {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        match self.page.update(input, &context.pen) {
            Some(MenuChoice::Pick(item)) => Next::Show(MainScreen::Slide(item)),
            _ => Next::Stay,
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        let note = self.notes.get(self.page.menu.focus()).map_or("", String::as_str);
        self.page.draw_note(&mut context.pen, note);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "slides".to_owned()
    }
}

/// What is said of a slide that was done in this time, s: the task, and the time of the next star; if there is none, its fact.
fn note_of(slide: &Slide, time: f32) -> String {
    let best = words::time_taken(time);
    let Some(longest) = slide.stars.iter().rev().find(|longest| time > **longest) else {
        let args = [("time", (&best).into()), ("fact", (&slide.fact).into()), ("source", (&slide.source).into())];
        return words::text_with(Key::SlidesBest, &args);
    };
    let next = words::number(*longest, 0);
    let args = [("time", (&best).into()), ("next", (&next).into()), ("task", (&slide.task).into())];
    words::text_with(Key::SlidesNext, &args)
}

/// The first slide without a star, or the first one when all have some.
fn first_left(items: &[MenuItem]) -> usize {
    items.iter().position(|item| item.stars == Some(0)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slide_that_is_done_tells_its_task_and_the_next_star_and_with_all_stars_its_fact() {
        let slide = crate::slides::find("first-steps").unwrap().read().unwrap();
        let [three, two] = slide.stars;
        let late = note_of(&slide, two + 1.0);
        assert!(late.contains(&slide.task) && late.contains(&format!("{two:.0} s")), "{late}");
        let next = note_of(&slide, three + 0.5);
        assert!(next.contains(&slide.task) && next.contains(&format!("{three:.0} s")), "{next}");
        let all = note_of(&slide, three);
        assert!(all.contains(&slide.fact) && !all.contains(&slide.task), "{all}");
    }

    #[test]
    fn the_list_opens_where_the_player_is() {
        let list = |stars: [u32; 3]| stars.map(|stars| MenuItem::rated("slide", stars));
        assert_eq!([[0, 0, 0], [1, 0, 3], [3, 2, 0], [1, 1, 1]].map(|stars| first_left(&list(stars))), [0, 1, 2, 0]);
    }
}
