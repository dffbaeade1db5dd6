//! Curves of the last seconds: the time of a step, and the area of the cell that is followed.

use crate::draw::palette::{ALERT, HALO, READY, fade};
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::words::{self, Key};
use macroquad::color::Color;
use microsim_core::glam::Vec2;
use std::collections::VecDeque;

/// Frames that are shown.
const LENGTH: usize = 300;

/// The curves.
#[derive(Clone, Debug, Default)]
pub(super) struct Plots {
    step_ms: VecDeque<f32>,
    area: VecDeque<f32>,
}

impl Plots {
    /// Adds the values of a frame.
    pub(super) fn push(&mut self, step_ms: f32, area: Option<f32>) {
        push(&mut self.step_ms, step_ms);
        match area {
            Some(area) => push(&mut self.area, area),
            None => self.area.clear(),
        }
    }

    /// Draws them in the lower right corner.
    pub(super) fn draw(&self, pen: &mut Pen) {
        let line = pen.line(TextSize::Small);
        let size = Vec2::new(13.0, 4.0) * line;
        let corner = pen.screen() - size - 0.5 * line;
        draw_curve(pen, corner, size, &self.step_ms, (Key::SandboxStep, "time"), ALERT);
        let above = corner - Vec2::new(0.0, size.y + 0.4 * line);
        // Square micrometres: a unit is one.
        draw_curve(pen, above, size, &self.area, (Key::SandboxArea, "area"), READY);
    }
}

fn push(values: &mut VecDeque<f32>, value: f32) {
    if values.len() == LENGTH {
        values.pop_front();
    }
    values.push_back(value);
}

fn draw_curve(pen: &mut Pen, low: Vec2, size: Vec2, values: &VecDeque<f32>, name: (Key, &str), colour: Color) {
    let Some(last) = values.back() else { return };
    let line = pen.line(TextSize::Small);
    pen.panel(low, low + size);
    let top = values.iter().fold(0.0_f32, |top, value| top.max(*value)).max(1e-6) * 1.1;
    let (base, height) = (low.y + size.y - 0.2 * line, size.y - 1.4 * line);
    let at = |k: usize, value: f32| {
        Vec2::new(low.x + size.x * k as f32 / (LENGTH - 1) as f32, base - height * (value / top).max(0.0))
    };
    let canvas = pen.canvas();
    canvas.segment(Vec2::new(low.x, base), Vec2::new(low.x + size.x, base), 1.0, fade(HALO, 0.4));
    for k in 1..values.len() {
        canvas.segment(at(k - 1, values[k - 1]), at(k, values[k]), 1.6, colour);
    }
    let heading = low + Vec2::new(0.3 * line, 0.6 * line);
    pen.write(heading, TextSize::Small, Align::Left, HALO, &told(name, *last));
    let end = low + Vec2::new(size.x - 0.3 * line, 0.6 * line);
    pen.write(end, TextSize::Small, Align::Right, fade(HALO, 0.7), &told((Key::SandboxTop, "value"), top / 1.1));
}

/// A text with a value in the place of its variable.
fn told((key, variable): (Key, &str), value: f32) -> String {
    words::text_with(key, &[(variable, (&words::number(value, 1)).into())])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_seconds_are_kept() {
        let mut plots = Plots::default();
        (0..1000).for_each(|k| plots.push(k as f32, Some(1.0)));
        assert_eq!((plots.step_ms.len(), plots.step_ms[0]), (LENGTH, 700.0));
        plots.push(1.0, None);
        assert!(plots.area.is_empty(), "another cell's curve would begin in the middle");
    }
}
