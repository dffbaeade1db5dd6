//! The end of a slide: stars, the fact that it shows, and what comes next.

use super::context::AppContext;
use super::end_menu::{EndChoice, EndMenu};
use super::page::draw_shade;
use super::{MainScreen, Next, Overlay, Paused, Screen};
use crate::draw::palette::{HALO, READY, fade};
use crate::input::Input;
use crate::rules::round::RoundResult;
use crate::rules::slide::Attempt;
use crate::slides::SLIDES;
use crate::ui::font::TextSize;
use crate::ui::menu::MenuLayout;
use crate::ui::pen::{Align, Pen};
use crate::ui::stars::draw_stars;
use macroquad::color::Color;
use microsim_core::glam::Vec2;

/// Share of the picture's height above the menu, if the text leaves it.
const MENU_TOP: f32 = 0.6;

/// A line of text: where its middle is, and how it is written.
type Line = (Vec2, TextSize, Color, String);

#[derive(Debug)]
pub(super) struct SlideEnd {
    played: Paused,
    stars: u32,
    told: Vec<(TextSize, Color, String)>,
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
        Self { played, stars, told, menu: EndMenu::new(&labels(played, stars > 0)) }
    }

    /// The text in lines that fit into the picture, each with its place.
    fn lines(&self, pen: &Pen) -> Vec<Line> {
        let lines = self.lines_of(pen, TextSize::Body);
        if end_of(pen, &lines) <= MenuLayout::middle(pen, 1.0).corner.y {
            return lines;
        }
        let mut lines = self.lines_of(pen, TextSize::Small);
        lines.retain(|line| end_of(pen, std::slice::from_ref(line)) <= MenuLayout::middle(pen, 1.0).corner.y);
        lines
    }

    /// The same with the fact in this size.
    fn lines_of(&self, pen: &Pen, fact: TextSize) -> Vec<Line> {
        let screen = pen.screen();
        let width = (0.92 * screen.x).min(30.0 * pen.line(TextSize::Body));
        let mut y = 0.09 * screen.y + 0.9 * pen.line(TextSize::Large);
        let mut lines = Vec::new();
        for (size, colour, text) in &self.told {
            let size = if *size == TextSize::Body { fact } else { *size };
            for line in pen.wrap(size, text, width) {
                y += 0.5 * pen.line(size);
                lines.push((Vec2::new(0.5 * screen.x, y), size, *colour, line));
                y += 0.5 * pen.line(size);
            }
            y += 0.3 * pen.line(TextSize::Small);
        }
        lines
    }

    fn layout(&self, pen: &Pen) -> MenuLayout {
        MenuLayout::middle(pen, MENU_TOP.max(end_of(pen, &self.lines(pen)) / pen.screen().y))
    }
}

/// Where lines end, drawing units from the upper edge.
fn end_of(pen: &Pen, lines: &[Line]) -> f32 {
    lines.last().map_or(0.0, |(at, size, ..)| at.y + 0.6 * pen.line(*size))
}

/// The slide of the list that was played, if it was one.
fn slide_of(played: Paused) -> Option<usize> {
    if let Paused::Slide(index) = played { Some(index).filter(|&index| index < SLIDES.len()) } else { None }
}

fn labels(played: Paused, is_won: bool) -> Vec<&'static str> {
    let has_next = is_won && slide_of(played).is_some_and(|index| index + 1 < SLIDES.len());
    let next = has_next.then_some("Next slide");
    let again = (played != Paused::Replay).then_some("Again");
    next.into_iter().chain(again).chain(["Watch it again", "Slides", "Title"]).collect()
}

fn told(attempt: &Attempt, is_best: bool, is_mismatch: bool) -> Vec<(TextSize, Color, String)> {
    let slide = attempt.slide();
    let doubt = if is_mismatch { ", not as it was played" } else { "" };
    let Some(time) = attempt.time() else {
        let left = format!("{} {}", slide.task, attempt.summary());
        return vec![(TextSize::Large, HALO, format!("Time is up{doubt}")), (TextSize::Body, HALO, left)];
    };
    let mut told = vec![(TextSize::Large, HALO, format!("Done in {time:.1} s{doubt}"))];
    let next = slide.stars.iter().rev().find(|longest| time > **longest);
    if let Some(longest) = next {
        told.push((TextSize::Body, HALO, format!("One more star within {longest:.0} s")));
    } else if is_best {
        told.push((TextSize::Body, READY, "The best so far!".to_owned()));
    }
    told.push((TextSize::Body, READY, slide.fact.clone()));
    told.push((TextSize::Small, fade(HALO, 0.85), slide.source.clone()));
    told
}

impl Screen for SlideEnd {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        let layout = self.layout(&context.pen);
        let Some(choice) = self.menu.update(input, context, &layout) else { return Next::Stay };
        let index = slide_of(self.played).unwrap_or_default();
        let label = match choice {
            EndChoice::Again => "Again",
            EndChoice::Leave => "Title",
            EndChoice::Pick(item) => self.menu.menu.items[item].label.as_str(),
        };
        match label {
            "Next slide" => Next::Show(MainScreen::Slide(index + 1)),
            "Again" => self.played.restart(),
            "Watch it again" => Next::Show(MainScreen::Replay),
            "Slides" => Next::Open(Overlay::Slides(index)),
            _ => Next::Show(MainScreen::Title),
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        let pen = &mut context.pen;
        draw_shade(pen);
        let radius = 0.45 * pen.line(TextSize::Large);
        draw_stars(pen, Vec2::new(0.5, 0.09) * pen.screen(), radius, self.stars, READY);
        for (at, size, colour, line) in self.lines(pen) {
            pen.write(at, size, Align::Centre, colour, &line);
        }
        let layout = self.layout(pen);
        self.menu.menu.draw(pen, &layout);
    }

    fn name(&self) -> String {
        format!("slide-end-{}", self.stars)
    }
}
