//! Captions: what is heard, in words, for those who do not hear it.

use crate::draw::palette::HALO;
use crate::sound::Cue;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use microsim_core::glam::Vec2;

/// Time for which one is shown, s.
const TIME: f32 = 2.0;
/// Most that are shown at a time.
const MOST: usize = 3;

/// The captions that are shown now, the oldest first.
#[derive(Clone, Debug, Default)]
pub struct Captions(Vec<(Key, f32)>);

impl Captions {
    /// Adds what is heard. What is shown already stays in its place, for longer.
    pub fn add(&mut self, heard: &[Cue]) {
        for key in heard.iter().map(|cue| told(*cue)) {
            match self.0.iter_mut().find(|(shown, _)| *shown == key) {
                Some((_, age)) => *age = 0.0,
                None => self.0.push((key, 0.0)),
            }
        }
        self.0.drain(..self.0.len().saturating_sub(MOST));
    }

    /// Lets time pass, s.
    pub fn pass(&mut self, elapsed: f32) {
        self.0.iter_mut().for_each(|(_, age)| *age += elapsed);
        self.0.retain(|(_, age)| *age < TIME);
    }

    /// Draws them along the right edge, one below the other, above the height of messages and advice.
    pub fn draw(&self, pen: &mut Pen) {
        let (screen, line) = (pen.screen(), pen.line(TextSize::Small));
        for (k, (key, _)) in self.0.iter().enumerate() {
            let at = Vec2::new(screen.x - 0.5 * line, 0.42 * screen.y + 1.3 * k as f32 * line);
            pen.label(at, TextSize::Small, Align::Right, HALO, &format!("[{}]", words::text(*key)));
        }
    }
}

/// What is written of a cue.
fn told(cue: Cue) -> Key {
    match cue {
        Cue::Engulf => Key::CaptionEngulf,
        Cue::Ingest => Key::CaptionIngest,
        Cue::Release => Key::CaptionRelease,
        Cue::Digest => Key::CaptionDigest,
        Cue::Lunge => Key::CaptionLunge,
        Cue::Danger => Key::CaptionDanger,
        Cue::Divide => Key::CaptionDivide,
        Cue::Fuse => Key::CaptionFuse,
        Cue::Second => Key::CaptionSecond,
        Cue::End => Key::CaptionEnd,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::{LANGUAGES, choose};
    use std::collections::BTreeSet;

    fn shown(captions: &Captions) -> Vec<Key> {
        captions.0.iter().map(|(key, _)| *key).collect()
    }

    #[test]
    fn what_is_heard_is_written_for_a_while_and_once() {
        let mut captions = Captions::default();
        captions.add(&[Cue::Lunge, Cue::Digest]);
        captions.pass(0.6 * TIME);
        captions.add(&[Cue::Lunge]);
        assert_eq!(shown(&captions), [Key::CaptionLunge, Key::CaptionDigest]);
        captions.pass(0.6 * TIME);
        assert_eq!(shown(&captions), [Key::CaptionLunge], "it was heard again");
        captions.pass(0.6 * TIME);
        assert!(shown(&captions).is_empty());
        captions.add(&Cue::ALL);
        assert_eq!(shown(&captions), [Cue::Fuse, Cue::Second, Cue::End].map(told), "the last ones");
    }

    #[test]
    fn each_cue_has_its_own_caption_in_each_language_which_fits_a_small_window() {
        let (mut pen, measure) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
        for language in &LANGUAGES {
            choose(language, || None);
            let told: BTreeSet<&str> = Cue::ALL.into_iter().map(|cue| words::text(told(cue))).collect();
            assert_eq!(told.len(), Cue::ALL.len());
            for text in told {
                let width = measure(TextSize::Small, &format!("[{text}]"));
                assert!(width <= 0.5 * pen.screen().x, "{}: {text}", language.code);
            }
        }
        let captions = Captions([Key::CaptionEnd; MOST].map(|key| (key, 0.0)).into());
        captions.draw(&mut pen);
        let (left, right) = (0.5 * pen.screen().x, pen.screen().x);
        let (top, bottom) = (0.3 * pen.screen().y, 0.75 * pen.screen().y);
        let is_beside = |at: Vec2| (left..=right).contains(&at.x) && (top..bottom).contains(&at.y);
        assert!(pen.canvas().corners().count() > 0 && pen.canvas().corners().all(|(at, ..)| is_beside(at)));
    }
}
