//! Photo mode: the scene that is stopped, without anything above it but a scale bar, to choose what a picture shows.

use super::context::AppContext;
use super::photo_view::PhotoView;
use super::{Next, Screen};
use crate::draw::palette::{HALO, INK, fade};
use crate::input::{Action, Input, Move};
use crate::scenery::Sight;
use crate::ui::font::TextSize;
use crate::ui::pen::{Align, Pen};
use crate::viewer::zoom_factor;
use crate::words::{self, Arg, Key};
use microsim_core::glam::Vec2;

/// Width of the scale bar, at most, share of the picture's.
const WIDEST: f32 = 0.22;
/// How fast the stick or the arrow keys move the picture, heights/s.
const SHIFT: f32 = 0.6;

#[derive(Debug)]
pub(super) struct Photo {
    /// The point of the room that follows the cursor while it is dragged.
    grip: Option<Vec2>,
    /// The way of looking before, and the one asked for by the command line.
    sight: (String, Option<Sight>),
}

impl Photo {
    pub(super) fn new(context: &mut AppContext) -> Self {
        context.photo = Some(PhotoView::default());
        let label = |action| context.settings.keys.label(action);
        let keys = [Action::ZoomOut, Action::ZoomIn, Action::Optics, Action::Screenshot].map(label);
        let [out, into, optics, picture] = keys.each_ref().map(Arg::from);
        let named = [("out", out), ("in", into), ("optics", optics), ("picture", picture)];
        context.tell(words::text_with(Key::PhotoHow, &named));
        Self { grip: None, sight: (context.settings.sight.clone(), context.asked.sight) }
    }
}

impl Screen for Photo {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) || input.presses(Action::Pause) {
            let (sight, asked) = std::mem::take(&mut self.sight);
            context.put_back_sight(sight, asked);
            return Next::Back;
        }
        let elapsed = context.pace.elapsed;
        let Some(camera) = context.photo.as_mut().and_then(PhotoView::camera) else { return Next::Stay };
        let factor = zoom_factor(input.zoom(), input.wheel, elapsed);
        camera.zoom(factor, if input.wheel == 0.0 { 0.5 * camera.screen() } else { input.cursor });
        let height = camera.screen().y / camera.scale();
        camera.shift(SHIFT * height * elapsed * Vec2::new(input.steer.x, -input.steer.y));
        let hand = camera.to_room(input.cursor);
        if input.is_clicked {
            self.grip = Some(hand);
        }
        self.grip = self.grip.filter(|_| input.is_held);
        if let Some(grip) = self.grip {
            camera.shift(grip - hand);
        }
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        let scale = context.photo.as_mut().and_then(PhotoView::camera).map(|camera| camera.scale());
        if let Some(scale) = scale {
            draw_scale(&mut context.pen, scale);
        }
    }

    fn is_scene(&self) -> bool {
        true
    }

    fn name(&self) -> String {
        "photo".to_owned()
    }
}

/// Draws a bar in the lower right corner, with its length.
fn draw_scale(pen: &mut Pen, scale: f32) {
    let (screen, line) = (pen.screen(), pen.line(TextSize::Body));
    let length = round_length(WIDEST * screen.x / scale);
    let right = screen - Vec2::new(1.0, 1.0) * line;
    let left = right - Vec2::new(length * scale, 0.0);
    let (edge, thick) = (Vec2::splat(1.5), Vec2::new(0.0, 0.22 * line));
    pen.canvas().rectangle(left - edge, right + thick + edge, fade(INK, 0.8));
    pen.canvas().rectangle(left, right + thick, HALO);
    // A unit is a micrometre.
    let middle = 0.5 * (left + right) - Vec2::new(0.0, 0.6 * line);
    pen.label(middle, TextSize::Small, Align::Centre, HALO, &format!("{} µm", words::shortest(length)));
}

/// The longest one of 1, 2, 5, 10, 20, ... that is no longer than this.
fn round_length(most: f32) -> f32 {
    let lengths = (-2..6).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10.0_f32.powi(power)));
    lengths.filter(|length| *length <= most).fold(0.01, f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_have_round_lengths_that_fit() {
        assert_eq!([26.0, 19.9, 5.0, 0.9, 1234.0].map(round_length), [20.0, 10.0, 5.0, 0.5, 1000.0]);
        for most in [0.3, 7.7, 64.0, 480.0] {
            assert!((0.39..=1.0).contains(&(round_length(most) / most)), "{most}");
        }
        assert_eq!([20.0, 0.5].map(|length: f32| length.to_string()), ["20", "0.5"]);
    }
}
