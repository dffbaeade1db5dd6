//! The line of text on top, and help at the start.

use super::canvas::Canvas;
use super::palette::{HALO, INK, fade};
use macroquad::color::Color;
use macroquad::text::{draw_text, measure_text};
use microsim_core::glam::Vec2;

/// The one size of text: every size costs an atlas of glyphs.
const TEXT: u16 = 16;
const LINE: f32 = 20.0;
const INSET: f32 = 10.0;
const HELP: &str =
    "hold mouse: move   A/D/wheel: zoom   Space: pause   N: step   1-9: scenario   F12: picture   Esc: quit";

/// What the text says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hud {
    /// Name of the scene.
    pub scenario: String,
    /// Simulated time, s.
    pub time: f64,
    /// Time that a step takes, ms; left out of pictures that must come out the same every time.
    pub step_ms: Option<f32>,
    /// Dynamic bodies.
    pub bodies: usize,
    /// All particles, fluid too.
    pub particles: usize,
    /// Whether the scene stands still.
    pub is_paused: bool,
    /// Whether to explain the controls.
    pub shows_help: bool,
    /// Something that has just happened.
    pub message: Option<String>,
}

/// Prepares the glyphs: made in the middle of a frame they would come out as black boxes.
pub(super) fn warm_up() {
    let all: String = (' '..='~').collect();
    measure_text(&all, None, TEXT, 1.0);
}

impl Hud {
    fn status(&self) -> String {
        let step = self.step_ms.map_or(String::new(), |ms| format!("   step {ms:.2} ms"));
        let pause = if self.is_paused { "   PAUSED" } else { "" };
        let Self { scenario, time, bodies, particles, .. } = self;
        format!("{scenario}   {time:.2} s{step}   {bodies} bodies   {particles} particles{pause}")
    }

    /// Lines of text with where they start.
    fn lines(&self, screen: Vec2) -> Vec<(String, Vec2)> {
        let mut lines = vec![(self.status(), Vec2::splat(INSET))];
        let message = self.message.iter().flat_map(|message| message.lines()).take(8);
        for line in message {
            lines.push((line.to_owned(), Vec2::new(INSET, INSET + LINE * 1.3 * lines.len() as f32)));
        }
        if self.shows_help {
            lines.push((HELP.to_owned(), Vec2::new(INSET, screen.y - INSET - LINE)));
        }
        lines
    }

    pub(super) fn draw_panels(&self, canvas: &mut Canvas, screen: Vec2) {
        for (text, at) in self.lines(screen) {
            let width = measure_text(&text, None, TEXT, 1.0).width;
            canvas.rectangle(at, at + Vec2::new(width + 16.0, LINE + 2.0), fade(INK, 0.62));
        }
    }

    pub(super) fn draw_text(&self, screen: Vec2) {
        for (text, at) in self.lines(screen) {
            let colour = Color { a: 1.0, ..HALO };
            draw_text(&text, at.x + 8.0, at.y + 15.0, f32::from(TEXT), colour);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_status_says_what_is_shown() {
        let hud = Hud {
            scenario: "demo".to_owned(),
            time: 12.3456,
            bodies: 42,
            particles: 50,
            is_paused: true,
            ..Hud::default()
        };
        assert_eq!(hud.status(), "demo   12.35 s   42 bodies   50 particles   PAUSED");
        let timed = Hud { step_ms: Some(1.234), ..hud };
        assert!(timed.status().contains("step 1.23 ms"));
    }

    #[test]
    fn long_messages_do_not_fill_the_picture() {
        let hud = Hud { message: Some("line\n".repeat(50)), ..Hud::default() };
        assert_eq!(hud.lines(Vec2::splat(500.0)).len(), 9);
    }
}
