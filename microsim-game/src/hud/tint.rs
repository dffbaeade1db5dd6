//! Chemicals as tints.

use crate::camera::Camera;
use crate::draw::canvas::Canvas;
use crate::draw::palette::fade;
use macroquad::color::Color;
use microsim_core::Chemical;
use microsim_core::glam::Vec2;

/// How much of a chemical there is where it is fullest.
pub(crate) fn fullest(chemical: &Chemical) -> f32 {
    chemical.values().iter().fold(0.0_f32, |most, value| most.max(*value))
}

/// The cells of a chemical's grid, the fuller the more of it is there, at most this strong.
pub(crate) fn draw_chemical(canvas: &mut Canvas, camera: &Camera, chemical: &Chemical, colour: Color, strength: f32) {
    let most = fullest(chemical);
    let (cell, columns) = (chemical.cell_size(), chemical.cells()[0]);
    for (k, value) in chemical.values().iter().enumerate().filter(|_| most > 0.0) {
        let low = cell * Vec2::new((k % columns) as f32, (k / columns) as f32);
        let corners = [Vec2::new(0.0, cell.y), Vec2::new(cell.x, 0.0)];
        let [upper_left, lower_right] = corners.map(|corner| camera.to_screen(low + corner));
        let is_seen = lower_right.cmpge(Vec2::ZERO).all() && upper_left.cmple(camera.screen()).all();
        let share = (value / most).max(0.0).sqrt();
        if is_seen && share > 0.02 {
            canvas.rectangle(upper_left, lower_right, fade(colour, strength * share));
        }
    }
}
