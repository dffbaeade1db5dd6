//! A picture being taken: from matter to bytes, in rows.

use super::coding::{BLOCK, code};
use super::field::Field;
use super::film::{Film, FilmFrame, MASK};
use super::maths::{larger, mix};
use super::noise::scramble;
use super::optics::sampler::{REACH, Sampler};
use super::optics::{Mode, Optics, PixelShader, Shader};
use super::painting::Painting;
use super::raster::{PixelGrid, bilinear, blur};
use super::sensor::{interpolate, smooth_colours, smooth_fields};
use super::specimen::Specimen;
use super::surround_wave::{self, SurroundWave};
use crate::error::Error;
use crate::world::World;
use crate::world::view::View;
use glam::{IVec2, Vec2};
use std::ops::Range;

/// Smallest pixel that an image is computed on, micrometres. No lens shows more: a picture of more pixels enlarges it.
const FINEST: f32 = 1.0 / 64.0;

/// How pictures are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microscope {
    /// What makes the image.
    pub optics: Optics,
    /// What records it.
    pub film: Film,
}

/// What is in front of the lens.
#[derive(Clone, Debug)]
enum ImageSource {
    Lit { specimen: Specimen, surround: Option<SurroundWave>, shader: PixelShader },
    Painted(Painting),
}

/// One picture, ready to be computed.
#[derive(Clone, Debug)]
pub struct Exposure {
    source: ImageSource,
    mode: &'static Mode,
    film: Film,
    frame: FilmFrame,
    pixels: [usize; 2],
    /// Grid of the image: the picture's, or a coarser one that the picture enlarges, and a margin around it.
    image: PixelGrid,
    margin: usize,
    /// Grid of the picture.
    picture: PixelGrid,
}

impl Microscope {
    /// Looks at the present state of a world.
    ///
    /// # Errors
    /// Names the number of the field or of the film that is out of range.
    pub fn expose(&self, world: &World, field: Field) -> Result<Exposure, Error> {
        let view = world.view();
        let frame = self.frame(view, field)?;
        let mode = self.optics.mode();
        let [columns, rows] = field.pixels.map(|count| count as usize);
        let pixel = field.pixel();
        let corner = field.corner() + frame.weave * pixel;
        let picture = PixelGrid { corner, pixel, columns, top: 0, rows };
        let (image, margin) = image_grid(&picture, frame.blur(mode));
        let source = match mode.shader {
            Shader::Painted => ImageSource::Painted(Painting::of(view)),
            Shader::Light(shader, _) => {
                let around = mode.surround.map(|_| surround_wave::grid_around(&image, image.pixel));
                let specimen = Specimen::of(view, field.centre, &around.unwrap_or(image));
                let surround = around.zip(mode.surround);
                let surround = surround.map(|(grid, kind)| SurroundWave::of(specimen.rasterize(grid), kind));
                ImageSource::Lit { specimen, surround, shader }
            }
        };
        Ok(Exposure { source, mode, film: self.film, frame, pixels: [columns, rows], image, margin, picture })
    }

    /// The frame of film at the time of a view; checks every number.
    pub(super) fn frame(&self, view: View<'_>, field: Field) -> Result<FilmFrame, Error> {
        field.validate()?;
        self.film.validate().map_err(|error| error.within("film"))?;
        Ok(self.film.frame(view.time(), scramble(view.world().config().seed as u32 ^ 0xf11e)))
    }
}

/// Grid of the image behind a picture, and its margin in pixels.
fn image_grid(picture: &PixelGrid, lens: f32) -> (PixelGrid, usize) {
    let pixel = larger(picture.pixel, FINEST);
    let margin = (REACH + 3.0 * lens) / pixel + 3.0 * MASK * picture.pixel / pixel;
    let margin = margin.ceil() as usize + 2;
    let scale = picture.pixel / pixel;
    let count = |count: usize| (count as f32 * scale).ceil() as usize + 2 * margin;
    let corner = picture.corner + Vec2::new(-1.0, 1.0) * (margin as f32 * pixel);
    (PixelGrid { corner, pixel, columns: count(picture.columns), top: 0, rows: count(picture.rows) }, margin)
}

impl Exposure {
    /// Width and height, pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.pixels
    }

    /// Some rows of the picture, counted from the top: three bytes per pixel, red, green, blue. Rows beyond the last one
    /// are left out. The bytes do not depend on how the picture is divided.
    #[must_use]
    pub fn rows(&self, rows: Range<usize>) -> Vec<u8> {
        let rows = rows.start.min(self.pixels[1])..rows.end.min(self.pixels[1]);
        if rows.is_empty() {
            return Vec::new();
        }
        let [columns, height] = self.pixels;
        // Whole blocks are coded, and colours interpolated between rows.
        let whole = match self.film.coding_quality {
            0 => rows.clone(),
            _ => rows.start / BLOCK * BLOCK..rows.end.next_multiple_of(BLOCK).min(height),
        };
        let mut bytes = self.sensed(whole.clone());
        if self.film.coding_quality > 0 {
            code(&mut bytes, columns, self.film.coding_quality);
        }
        let row = |row: usize| 3 * columns * (row - whole.start);
        bytes.truncate(row(rows.end));
        bytes.split_off(row(rows.start))
    }

    /// Some rows as the sensor gives them.
    fn sensed(&self, rows: Range<usize>) -> Vec<u8> {
        let [columns, height] = self.pixels;
        if self.mode.channels == 1 {
            return self.record::<1>(rows);
        }
        if !self.film.has_mosaic {
            return self.record::<3>(rows);
        }
        let around = rows.start.saturating_sub(2)..height.min(rows.end + 2);
        let mut bytes = interpolate(&self.record::<3>(around.clone()), columns, around.start);
        bytes = smooth_colours(&smooth_fields(&bytes, columns), columns);
        let row = |row: usize| 3 * columns * (row - around.start);
        bytes.truncate(row(rows.end));
        bytes.split_off(row(rows.start))
    }

    fn record<const N: usize>(&self, rows: Range<usize>) -> Vec<u8> {
        let image = self.image::<N>(&rows);
        let half = Vec2::new(self.pixels[0] as f32, self.pixels[1] as f32) * 0.5;
        let mut bytes = Vec::with_capacity(rows.len() * self.pixels[0] * 3);
        for y in rows {
            for x in 0..self.pixels[0] {
                let light = image.at(self.image_place(x, y));
                let recorded = self.frame.record(light, x, y, self.mode, half);
                bytes.extend((0..3).map(|k| recorded[k.min(N - 1)]));
            }
        }
        bytes
    }

    /// Where a pixel of the picture lies in the image, in the image's pixels.
    fn image_place(&self, x: usize, y: usize) -> Vec2 {
        let at = Vec2::new(x as f32, y as f32);
        if self.picture.pixel == self.image.pixel {
            return at + self.margin as f32;
        }
        (at + 0.5) * (self.picture.pixel / self.image.pixel) - 0.5 + self.margin as f32
    }

    /// The image behind some rows of the picture.
    fn image<const N: usize>(&self, rows: &Range<usize>) -> Image<N> {
        let first = (self.image_place(0, rows.start).y as usize).saturating_sub(self.margin);
        let last = self.image_place(0, rows.end - 1).y as usize + 2 + self.margin;
        let grid = PixelGrid { top: first, rows: last.min(self.image.rows) - first, ..self.image };
        let mut light = self.source.light(grid);
        blur(
            &mut light,
            grid.columns,
            &self.frame.kernel(self.frame.blur(self.mode) / grid.pixel, grid.pixel / self.picture.pixel),
        );
        Image { grid, light }
    }
}

impl ImageSource {
    /// Light at each pixel of a grid.
    fn light<const N: usize>(&self, grid: PixelGrid) -> Vec<[f32; N]> {
        match self {
            Self::Painted(painting) => {
                painting.light(grid).into_iter().map(|colour| std::array::from_fn(|k| colour[k])).collect()
            }
            Self::Lit { specimen, surround, shader } => {
                let raster = specimen.rasterize(grid);
                let sampler = Sampler { raster: &raster, surround: surround.as_ref() };
                let at = |k: usize| shader(&sampler, k % grid.columns, k / grid.columns);
                (0..grid.len()).map(at).map(|light| std::array::from_fn(|k| light[k])).collect()
            }
        }
    }
}

/// Light on a part of the image's grid.
struct Image<const N: usize> {
    grid: PixelGrid,
    light: Vec<[f32; N]>,
}

impl<const N: usize> Image<N> {
    /// Light at a place in pixels of the whole image, from the nearest four.
    fn at(&self, place: Vec2) -> [f32; N] {
        let (whole, share) = (place.floor(), place - place.floor());
        let pixel = whole.as_ivec2() - IVec2::new(0, self.grid.top as i32);
        if share == Vec2::ZERO {
            return self.light[pixel.y as usize * self.grid.columns + pixel.x as usize];
        }
        let mix = |a: [f32; N], b: [f32; N], share| std::array::from_fn(|k| mix(a[k], b[k], share));
        bilinear([self.grid.columns, self.grid.rows], pixel, share, |k| self.light[k], mix)
    }
}
