//! The picture that is seen while the microscope is set up.

use crate::draw::palette::{HALO, INK};
use crate::ui::font::{TITLE, TextSize};
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use macroquad::window::{clear_background, next_frame, screen_height, screen_width};
use microsim_core::glam::Vec2;

/// Shows a picture for the time in which the microscope is set up, which takes seconds on slow graphics.
pub(crate) async fn show() {
    let mut pen = Pen::new();
    let screen = Vec2::new(screen_width(), screen_height());
    pen.fit(screen, 1.0);
    clear_background(INK);
    let middle = Vec2::new(0.5, 0.45) * screen;
    pen.write(middle, TextSize::Huge, Align::Centre, HALO, TITLE);
    let below = middle + Vec2::new(0.0, pen.line(TextSize::Huge));
    pen.write(below, TextSize::Body, Align::Centre, HALO, words::text(Key::Waiting));
    pen.flush();
    next_frame().await;
}
