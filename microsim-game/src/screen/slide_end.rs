//! The end of a slide: stars, the fact that it shows, and what comes next.

use super::context::AppContext;
use super::end_menu::{EndChoice, EndMenu, doubted};
use super::{MainScreen, Next, Overlay, Paused, Screen};
use crate::draw::palette::{HALO, READY, fade};
use crate::input::Input;
use crate::rules::attempt::Attempt;
use crate::rules::round::RoundResult;
use crate::slides::{self, SLIDES};
use crate::ui::font::TextSize;
use crate::ui::menu::{Menu, MenuLayout};
use crate::ui::pen::{Align, Pen};
use crate::ui::stars::draw_stars;
use crate::words::{self, Key};
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu, if the text leaves it.
const MENU_TOP: f32 = 0.6;

/// A line of text: where its middle is, and how it is written.
type Line = (Vec2, TextSize, Color, String);
/// How a part of the text is written, and what it says.
type Paragraph = (TextSize, Color, String);
/// An item of the menu, and where it leads.
type Item = (Key, fn(Paused) -> Next);

#[derive(Debug)]
pub(super) struct SlideEnd {
    played: Paused,
    stars: u32,
    told: Vec<Paragraph>,
    items: Vec<Item>,
    menu: EndMenu,
}

impl SlideEnd {
    /// The end of a slide that was played, of which the time is kept, or replayed.
    pub(super) fn new(result: RoundResult, played: Paused, context: &mut AppContext) -> Self {
        let RoundResult { attempt, record, is_mismatch, .. } = result;
        let mut is_best = false;
        if let Some(record) = record {
            let name = slide_of(played).map(|index| SLIDES[index].name);
            let (best, kept) = match name.zip(attempt.as_ref().and_then(Attempt::time)) {
                Some((name, time)) => context.best_times.add(name, time, &context.store),
                None => (false, Ok(())),
            };
            is_best = best;
            context.keep_game(record, kept);
        }
        let stars = attempt.as_ref().map_or(0, Attempt::stars);
        let told = attempt.as_ref().map(|attempt| told(attempt, is_best, is_mismatch)).unwrap_or_default();
        let items = items(played, stars > 0);
        let menu = EndMenu::new(&items.iter().map(|(label, _)| *label).collect::<Vec<_>>());
        Self { played, stars, told, items, menu }
    }

    /// The text in lines that fit into the picture, each with its place: smaller, and then less of it, where there is no room.
    /// The list of slides has the rest.
    fn lines(&self, pen: &Pen) -> Vec<Line> {
        let room = MenuLayout::middle(pen, 1.0).corner.y;
        let fits = |lines: &Vec<Line>| end_of(pen, lines) <= room;
        let parts =
            (1..=self.told.len()).rev().flat_map(|count| [TextSize::Body, TextSize::Small].map(|size| (count, size)));
        parts.map(|(count, size)| lines_of(pen, &self.told[..count], size)).find(fits).unwrap_or_default()
    }

    fn layout(&self, pen: &Pen) -> MenuLayout {
        MenuLayout::middle(pen, MENU_TOP.max(end_of(pen, &self.lines(pen)) / pen.screen().y))
    }
}

/// Text in lines, with the fact in this size.
fn lines_of(pen: &Pen, told: &[Paragraph], fact: TextSize) -> Vec<Line> {
    let screen = pen.screen();
    let width = (0.92 * screen.x).min(30.0 * pen.line(TextSize::Body));
    let mut y = 0.09 * screen.y + 0.9 * pen.line(TextSize::Large);
    let mut lines = Vec::new();
    for (size, colour, text) in told {
        let size = if *size == TextSize::Body { fact } else { *size };
        for line in pen.wrap_evenly(size, text, width) {
            y += 0.5 * pen.line(size);
            lines.push((Vec2::new(0.5 * screen.x, y), size, *colour, line));
            y += 0.5 * pen.line(size);
        }
        y += 0.3 * pen.line(TextSize::Small);
    }
    lines
}

/// Where lines end, drawing units from the upper edge.
fn end_of(pen: &Pen, lines: &[Line]) -> f32 {
    lines.last().map_or(0.0, |(at, size, ..)| at.y + 0.6 * pen.line(*size))
}

/// The slide of the list that was played, if it was one.
fn slide_of(played: Paused) -> Option<usize> {
    if let Paused::Slide(index) = played { Some(index).filter(|&index| index < SLIDES.len()) } else { None }
}

/// Where one comes who leaves the end: to the slides, if it was one of the list.
fn left(played: Paused) -> Next {
    slide_of(played).map_or(Next::Show(MainScreen::Title), |index| Next::Leave(Overlay::Slides(Some(index))))
}

/// What the menu offers after a slide.
fn items(played: Paused, is_won: bool) -> Vec<Item> {
    let mut items: Vec<Item> = Vec::new();
    if is_won && slide_of(played).is_some_and(|index| index + 1 < SLIDES.len()) {
        items.push((Key::SlideEndNext, |played| {
            Next::Show(MainScreen::Slide(slide_of(played).unwrap_or_default() + 1))
        }));
    }
    if played != Paused::Replay {
        items.push((Key::SlideEndAgain, Paused::restart));
    }
    items.push((Key::EndWatch, |_| Next::Show(MainScreen::Replay)));
    items.push((Key::TitleSlides, |played| Next::Open(Overlay::Slides(slide_of(played)))));
    items.push((Key::Title, |_| Next::Show(MainScreen::Title)));
    items
}

fn told(attempt: &Attempt, is_best: bool, is_mismatch: bool) -> Vec<Paragraph> {
    let slide = slides::told(attempt.slide());
    let heading = |text| (TextSize::Large, HALO, doubted(text, is_mismatch));
    let Some(time) = attempt.time() else {
        let done = attempt.summary();
        let left = [("task", (&slide.task).into()), ("done", (&done).into())];
        let left = (TextSize::Body, HALO, words::text_with(Key::SlideEndLeft, &left));
        let why = if attempt.is_lost() { Key::SlideEndTaken } else { Key::SlideEndLate };
        return vec![heading(words::text(why).to_owned()), left];
    };
    let mut told = vec![heading(words::text_with(Key::SlideEndDone, &[("time", (&words::time_taken(time)).into())]))];
    let next = slide.stars.iter().rev().find(|longest| time > **longest);
    if let Some(longest) = next {
        told.push((
            TextSize::Body,
            HALO,
            words::text_with(Key::SlideEndMore, &[("time", (&words::number(*longest, 0)).into())]),
        ));
    } else if is_best {
        told.push((TextSize::Body, READY, words::text(Key::EndBest).to_owned()));
    }
    told.push((TextSize::Body, READY, slide.fact.clone()));
    told.push((TextSize::Small, fade(HALO, 0.85), slide.source.clone()));
    told
}

impl Screen for SlideEnd {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let layout = self.layout(&context.pen);
        let Some(choice) = self.menu.update(input, context, &layout) else { return Next::Stay };
        match choice {
            EndChoice::Again => self.played.restart(),
            EndChoice::Leave => left(self.played),
            EndChoice::Pick(item) => self.items[item].1(self.played),
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        self.menu.draw_shade(pen);
        let (radius, lines) = (0.45 * pen.line(TextSize::Large), self.lines(pen));
        let width = lines.iter().map(|(_, size, _, line)| pen.width(*size, line)).fold(0.0, f32::max);
        let bottom = end_of(pen, &lines);
        EndMenu::draw_panel(pen, width, [0.09 * pen.screen().y - radius, bottom]);
        let colour = if self.stars > 0 { READY } else { HALO };
        draw_stars(pen, Vec2::new(0.5, 0.09) * pen.screen(), radius, self.stars, colour);
        for (at, size, colour, line) in lines {
            pen.write(at, size, Align::Centre, colour, &line);
        }
        let layout = self.layout(pen);
        self.menu.menu.draw(pen, &layout);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.menu.menu)
    }

    fn name(&self) -> String {
        format!("slide-end-{}", self.stars)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_leaves_the_end_of_a_slide_comes_to_the_slides_and_from_a_replay_to_the_title() {
        assert!(matches!(left(Paused::Slide(2)), Next::Leave(Overlay::Slides(Some(2)))));
        assert!(matches!(left(Paused::Replay), Next::Show(MainScreen::Title)));
    }
}
