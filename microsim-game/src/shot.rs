//! Pictures: drawn into a target of their own, because reading the window back gives black pictures on some systems.

use crate::convert;
use crate::platform;
use macroquad::camera::{Camera2D, set_camera, set_default_camera};
use macroquad::color::WHITE;
use macroquad::texture::{DrawTextureParams, RenderTarget, draw_texture_ex, render_target};
use microsim_core::glam::Vec2;
use std::io;
use std::path::Path;

/// A target to draw a picture into, kept as long as its size is right.
#[derive(Debug, Default)]
pub struct Shot {
    target: Option<((u32, u32), RenderTarget)>,
}

impl Shot {
    /// From now on everything is drawn into a picture of `size` pixels that shows `view` drawing units.
    pub fn begin(&mut self, size: (u32, u32), view: Vec2) {
        self.target.take_if(|(known, _)| *known != size);
        let (_, target) = self.target.get_or_insert_with(|| (size, render_target(size.0, size.1)));
        draw_into(target, view);
    }

    /// Writes the picture as a PNG, and shows it in the window.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn finish(&mut self, path: &Path, view: Vec2) -> io::Result<()> {
        // Ends the target's pass, so that it can be read.
        set_default_camera();
        let Some((size, target)) = &self.target else { return Ok(()) };
        let image = target.texture.get_texture_data();
        let params = DrawTextureParams { dest_size: Some(convert::pair(view)), flip_y: true, ..Default::default() };
        draw_texture_ex(&target.texture, 0.0, 0.0, WHITE, params);
        platform::write_picture(path, *size, &upright(&image.bytes, *size))
    }
}

/// From now on everything is drawn into a target that shows `view` drawing units, from its upper left corner, y down, like the window.
pub fn draw_into(target: &RenderTarget, view: Vec2) {
    set_camera(&Camera2D {
        zoom: convert::pair(Vec2::new(2.0, -2.0) / view),
        target: convert::pair(view * 0.5),
        render_target: Some(target.clone()),
        ..Camera2D::default()
    });
}

/// Rows as they come from the graphics card, lowest first, turned round; no longer transparent.
fn upright(bytes: &[u8], (width, _): (u32, u32)) -> Vec<u8> {
    let rows = bytes.chunks_exact(width as usize * 4).rev();
    let pixels = rows.flat_map(|row| row.chunks_exact(4));
    pixels.flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_upright_and_opaque() {
        let bytes = [1, 2, 3, 0, 4, 5, 6, 9];
        assert_eq!(upright(&bytes, (1, 2)), [4, 5, 6, 255, 1, 2, 3, 255]);
    }
}
