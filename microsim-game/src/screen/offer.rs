//! Three changes that are offered while a match goes on: a box for each, which is taken by its number, a click, or the cross of a
//! gamepad.

use crate::draw::palette::{HALO, READY};
use crate::input::Input;
use crate::platform;
use crate::rules::food_chain::change::Change;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words;
use macroquad::input::KeyCode;
use microsim_core::glam::Vec2;

/// Keys of each place.
const KEYS: [[KeyCode; 2]; 3] =
    [[KeyCode::Key1, KeyCode::Kp1], [KeyCode::Key2, KeyCode::Kp2], [KeyCode::Key3, KeyCode::Kp3]];
/// Width of a box, share of the picture's, and of what is written in it, share of the box's.
const WIDTH: f32 = 0.32;
const FILLED: f32 = 0.92;

/// The hand that takes a change.
#[derive(Debug, Default)]
pub(super) struct Taking {
    /// Whether it holds what it has clicked at.
    is_held: bool,
}

impl Taking {
    /// The place of the change that is taken in a frame. A click in a box steers nothing until it is let go.
    pub(super) fn take(&mut self, input: &mut Input, pen: &Pen, offer: Option<[Change; 3]>) -> Option<usize> {
        let is_in = |[low, high]: &[Vec2; 2]| input.cursor.cmpge(*low).all() && input.cursor.cmple(*high).all();
        let boxes = offer.map(|offer| boxes(pen, &texts(pen, offer)));
        let clicked = boxes.filter(|_| input.is_clicked).and_then(|boxes| boxes.iter().position(is_in));
        let typed = KEYS.iter().position(|keys| input.key.is_some_and(|key| keys.contains(&key)));
        self.is_held = clicked.is_some() || self.is_held && input.is_held;
        input.is_held &= !self.is_held;
        input.is_clicked &= clicked.is_none();
        clicked.or(typed.or(input.place).filter(|_| offer.is_some()))
    }
}

/// Draws the boxes along the lower edge.
pub(super) fn draw(pen: &mut Pen, offer: [Change; 3]) {
    let texts = texts(pen, offer);
    for ([low, high], (name, about)) in boxes(pen, &texts).into_iter().zip(texts) {
        pen.panel(low, high);
        let mut at = Vec2::new(0.5 * (low.x + high.x), low.y + 0.7 * pen.line(TextSize::Body));
        let size = if pen.width(TextSize::Body, &name) <= FILLED * (high.x - low.x) {
            TextSize::Body
        } else {
            TextSize::Small
        };
        pen.write(at, size, Align::Centre, READY, &name);
        at.y += 0.3 * pen.line(TextSize::Body);
        for line in about {
            at.y += pen.line(TextSize::Small);
            pen.write(at, TextSize::Small, Align::Centre, HALO, &line);
        }
    }
}

/// What each box says: its number and the name of the change, and lines about it.
fn texts(pen: &Pen, offer: [Change; 3]) -> Vec<(String, Vec<String>)> {
    let width = FILLED * WIDTH * pen.screen().x;
    let of = |(number, change): (usize, Change)| {
        let [name, about] = change.words().map(words::text);
        (format!("{number}  {name}"), pen.wrap(TextSize::Small, about, width))
    };
    (1..).zip(offer).map(of).collect()
}

/// Upper left and lower right corner of each box; all are as high as the highest needs to be.
fn boxes(pen: &Pen, texts: &[(String, Vec<String>)]) -> [[Vec2; 2]; 3] {
    let (screen, lines) = (pen.screen(), texts.iter().map(|(_, about)| about.len()).max().unwrap_or(0));
    let height = 1.5 * pen.line(TextSize::Body) + lines as f32 * pen.line(TextSize::Small);
    let low = screen.y - platform::covered_height() - height - 0.3 * pen.line(TextSize::Body);
    let left = |k: usize| ((k as f32 + 0.5) / 3.0 - 0.5 * WIDTH) * screen.x;
    [0, 1, 2].map(|k| [Vec2::new(left(k), low), Vec2::new(left(k) + WIDTH * screen.x, low + height)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::pen::wrap;

    const OFFER: [Change; 3] = [Change::Speed, Change::Coat, Change::WideMouth];

    #[test]
    fn a_number_or_a_click_in_a_box_takes_a_change_and_steers_nothing() {
        let (pen, mut taking) = (Pen::bare(), Taking::default());
        let middle = |k: usize| {
            let [low, high] = boxes(&pen, &texts(&pen, OFFER))[k];
            0.5 * (low + high)
        };
        let click = |k| Input { cursor: middle(k), is_clicked: true, is_held: true, ..Input::default() };
        for (k, keys) in KEYS.iter().enumerate() {
            let mut input = click(k);
            assert_eq!(taking.take(&mut input, &pen, Some(OFFER)), Some(k));
            assert!(!input.is_held && !input.is_clicked);
            let mut held = Input { is_clicked: false, ..click(k) };
            assert_eq!(taking.take(&mut held, &pen, None), None);
            assert!(!held.is_held, "the hand has not let go");
            assert_eq!(taking.take(&mut Input::default(), &pen, None), None);
            let key = |key| Input { key: Some(key), ..Input::default() };
            assert_eq!(taking.take(&mut key(keys[0]), &pen, Some(OFFER)), Some(k));
            assert_eq!(taking.take(&mut key(keys[1]), &pen, None), None, "nothing is offered");
            let cross = || Input { place: Some(k), ..Input::default() };
            assert_eq!(taking.take(&mut cross(), &pen, Some(OFFER)), Some(k));
            assert_eq!(taking.take(&mut cross(), &pen, None), None, "nothing is offered");
        }
        let mut beside = Input { cursor: Vec2::ZERO, ..click(0) };
        assert_eq!(taking.take(&mut beside, &pen, Some(OFFER)), None);
        assert!(beside.is_held && beside.is_clicked);
        assert!(taking.take(&mut click(1), &pen, None).is_none(), "no box is there");
    }

    #[test]
    fn boxes_do_not_cover_each_other_and_have_room_for_all_texts_in_a_small_window() {
        let (pen, measure) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
        let width = FILLED * WIDTH * pen.screen().x;
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            for change in Change::ALL {
                let [name, about] = change.words().map(words::text);
                assert!(measure(TextSize::Small, &format!("3  {name}")) <= width, "{name}");
                let lines = wrap(about, |line| measure(TextSize::Small, line) <= width);
                let boxes = boxes(&pen, &[(name.to_owned(), lines)]);
                assert!(boxes.windows(2).all(|pair| pair[0][1].x < pair[1][0].x));
                assert!(boxes[0][0].x > 0.0 && boxes[2][1].x < pen.screen().x);
                assert!(
                    boxes.iter().all(|[low, high]| low.y > 0.5 * pen.screen().y && high.y < pen.screen().y),
                    "{about}"
                );
            }
        }
    }
}
