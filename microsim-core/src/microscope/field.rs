//! The field of view: which part of the world a picture shows, and with how many pixels.

use crate::error::{Error, count_in_range, in_range, out_of_range};
use glam::Vec2;

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// What is in its middle, micrometres, components within ±100 000.
    pub centre: Vec2,
    /// Width of what it shows, micrometres, 0.001 to 100 000. The height follows from the pixels, which are square.
    pub width: f32,
    /// Width and height of the picture, pixels, 1 to 16 384 each and at most [`Field::MOST_PIXELS`] together.
    pub pixels: [u32; 2],
}

impl Field {
    /// Most pixels of a picture.
    pub const MOST_PIXELS: u64 = 1 << 26;

    /// Checks every number.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        in_range("centre.x", self.centre.x, -1e5, 1e5)?;
        in_range("centre.y", self.centre.y, -1e5, 1e5)?;
        in_range("width", self.width, 1e-3, 1e5)?;
        let [width, height] = self.pixels;
        count_in_range("pixels[0]", width, 1, 16_384)?;
        count_in_range("pixels[1]", height, 1, 16_384)?;
        let pixels = u64::from(width) * u64::from(height);
        if pixels > Self::MOST_PIXELS {
            let accepted = format!("at most {} pixels in all", Self::MOST_PIXELS);
            return Err(out_of_range("pixels", pixels as f64, accepted));
        }
        Ok(())
    }

    /// Side of a pixel, micrometres.
    #[must_use]
    pub fn pixel(&self) -> f32 {
        self.width / self.pixels[0] as f32
    }

    /// Upper left corner, micrometres.
    pub(super) fn corner(&self) -> Vec2 {
        let height = self.pixel() * self.pixels[1] as f32;
        self.centre + Vec2::new(-0.5 * self.width, 0.5 * height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absurd_fields_are_refused_by_name() {
        let field = Field { centre: Vec2::ZERO, width: 100.0, pixels: [1280, 720] };
        assert!(field.validate().is_ok());
        let refuse = |field: Field, name: &str| assert_eq!(field.validate().unwrap_err().field(), name);
        refuse(Field { centre: Vec2::new(f32::NAN, 0.0), ..field }, "centre.x");
        refuse(Field { width: 0.0, ..field }, "width");
        refuse(Field { width: f32::INFINITY, ..field }, "width");
        refuse(Field { pixels: [0, 720], ..field }, "pixels[0]");
        refuse(Field { pixels: [1280, 1 << 30], ..field }, "pixels[1]");
        refuse(Field { pixels: [16_384, 16_384], ..field }, "pixels");
    }
}
