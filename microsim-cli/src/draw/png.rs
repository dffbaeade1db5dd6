//! Painting on the processor, and PNG files.

use super::{PicturePage, Viewport};
use crate::failure::Failure;
use microsim_core::drawing::shape::{Colour, Geometry, Item, Paint, Segment, Stroke};
use microsim_core::glam::Vec2;
use tiny_skia::{
    Color, FillRule, GradientStop, LineCap, LineJoin, PathBuilder, Pixmap, Point, RadialGradient, Shader, SpreadMode,
    Transform,
};

/// An opaque picture, three bytes per pixel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Picture {
    width: usize,
    height: usize,
    bytes: Vec<u8>,
}

impl Picture {
    /// Paints a page so that its longer side has `longest` pixels.
    pub(crate) fn of(page: &PicturePage, longest: u32) -> Self {
        let viewport = page.viewport(longest);
        // Only a side of zero has no pixels, and a viewport has none.
        let Some(mut pixmap) = Pixmap::new(viewport.width, viewport.height) else {
            return Self::default();
        };
        pixmap.fill(color(page.background));
        for item in &page.items {
            paint(&mut pixmap, item, &viewport);
        }
        // The background is opaque, so that premultiplied bytes are the plain ones.
        let pixels = pixmap.pixels().iter();
        Self {
            width: viewport.width as usize,
            height: viewport.height as usize,
            bytes: pixels.flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect(),
        }
    }

    /// As bytes that [`Self::from_raw`] reads: quick to write, large.
    pub(crate) fn to_raw(&self) -> Vec<u8> {
        [&(self.width as u32).to_le_bytes()[..], &(self.height as u32).to_le_bytes(), &self.bytes].concat()
    }

    /// From the bytes of [`Self::to_raw`].
    pub(crate) fn from_raw(raw: &[u8]) -> Option<Self> {
        let (width, rest) = raw.split_first_chunk()?;
        let (height, bytes) = rest.split_first_chunk()?;
        let [width, height] = [width, height].map(|side| u32::from_le_bytes(*side) as usize);
        let length = width.checked_mul(height)?.checked_mul(3)?;
        (length > 0 && bytes.len() == length).then(|| Self::new(width, height, bytes.to_vec()))
    }

    /// From three bytes per pixel.
    pub(crate) fn new(width: usize, height: usize, bytes: Vec<u8>) -> Self {
        Self { width, height, bytes }
    }

    pub(crate) fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Three bytes per pixel, rows from the top.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The same with items painted over it, `scale` pixels to a unit; its lower left corner lies at `low`.
    pub(crate) fn painted_over(mut self, items: &[Item], low: Vec2, scale: f32) -> Self {
        let (width, height) = (self.width as u32, self.height as u32);
        let Some(mut pixmap) = Pixmap::new(width, height) else {
            return self;
        };
        let high = low + Vec2::new(width as f32, height as f32) / scale;
        let viewport = Viewport { low, high, scale, width, height };
        for item in items {
            paint(&mut pixmap, item, &viewport);
        }
        for (pixel, below) in pixmap.pixels().iter().zip(self.bytes.chunks_exact_mut(3)) {
            let kept = 255 - u32::from(pixel.alpha());
            for (below, above) in below.iter_mut().zip([pixel.red(), pixel.green(), pixel.blue()]) {
                *below = above + (u32::from(*below) * kept / 255) as u8;
            }
        }
        self
    }

    /// Pictures of equal size side by side, in rows of such a length that the sheet is not too slim.
    pub(crate) fn sheet(pictures: &[Self]) -> Self {
        let columns = pictures.first().map_or(1, |first| columns(first, pictures.len()));
        Self::sheet_in(pictures, columns)
    }

    /// Pictures of equal size in rows of so many.
    pub(crate) fn sheet_in(pictures: &[Self], columns: usize) -> Self {
        let Some(first) = pictures.first() else {
            return Self::default();
        };
        let columns = columns.clamp(1, pictures.len());
        let rows = pictures.len().div_ceil(columns);
        let (width, height) = (first.width * columns, first.height * rows);
        let corner = first.bytes.get(..3).unwrap_or(&[0; 3]);
        let mut bytes = corner.repeat(width * height);
        for (k, picture) in pictures.iter().enumerate() {
            let (left, top) = ((k % columns) * first.width, (k / columns) * first.height);
            let lines = picture.bytes.chunks_exact(picture.width * 3);
            for (y, line) in lines.enumerate() {
                let start = ((top + y) * width + left) * 3;
                bytes[start..start + line.len()].copy_from_slice(line);
            }
        }
        Self { width, height, bytes }
    }

    /// One byte per pixel, if it is nothing but grey.
    pub(crate) fn greys(&self) -> Option<Vec<u8>> {
        let pixels = self.bytes.chunks_exact(3);
        pixels.map(|rgb| (rgb[0] == rgb[1] && rgb[1] == rgb[2]).then_some(rgb[0])).collect()
    }

    /// As a PNG file; fast rather than small.
    pub(crate) fn encoded(&self) -> Result<Vec<u8>, Failure> {
        let greys = self.greys();
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width as u32, self.height as u32);
        encoder.set_color(if greys.is_some() { png::ColorType::Grayscale } else { png::ColorType::Rgb });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(greys.as_ref().unwrap_or(&self.bytes))?;
            writer.finish()
        });
        written.map_err(|error| Failure::Message(format!("cannot encode a picture: {error}")))?;
        Ok(file)
    }
}

fn columns(tile: &Picture, count: usize) -> usize {
    let wanted = if tile.width > tile.height * 2 {
        2
    } else if tile.width * 2 < tile.height {
        6
    } else {
        3
    };
    wanted.min(count)
}

fn paint(pixmap: &mut Pixmap, item: &Item, viewport: &Viewport) {
    let Some(path) = path(&item.geometry, viewport) else {
        return;
    };
    let identity = Transform::identity();
    if let Some(shader) = item.fill.and_then(|fill| shader(fill, viewport)) {
        pixmap.fill_path(&path, &paint_with(shader), FillRule::Winding, identity, None);
    }
    if let Some(Stroke { colour, width }) = item.stroke {
        let stroke = tiny_skia::Stroke {
            width: width * viewport.scale,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..tiny_skia::Stroke::default()
        };
        let shader = Shader::SolidColor(color(colour));
        pixmap.stroke_path(&path, &paint_with(shader), &stroke, identity, None);
    }
}

fn paint_with(shader: Shader<'_>) -> tiny_skia::Paint<'_> {
    tiny_skia::Paint { shader, anti_alias: true, ..tiny_skia::Paint::default() }
}

fn shader(paint: Paint, viewport: &Viewport) -> Option<Shader<'static>> {
    match paint {
        Paint::Flat(colour) => Some(Shader::SolidColor(color(colour))),
        Paint::Radial { centre, radius, inner, outer } => {
            let at = viewport.place(centre);
            let at = Point::from_xy(at.x, at.y);
            let stops = vec![GradientStop::new(0.0, color(inner)), GradientStop::new(1.0, color(outer))];
            let radius = radius * viewport.scale;
            let identity = Transform::identity();
            RadialGradient::new(at, 0.0, at, radius, stops, SpreadMode::Pad, identity)
        }
    }
}

fn path(geometry: &Geometry, viewport: &Viewport) -> Option<tiny_skia::Path> {
    let mut builder = PathBuilder::new();
    for segment in geometry.segments() {
        match segment {
            Segment::Move(p) => {
                let p = viewport.place(p);
                builder.move_to(p.x, p.y);
            }
            Segment::Line(p) => {
                let p = viewport.place(p);
                builder.line_to(p.x, p.y);
            }
            Segment::Cubic(a, b, c) => {
                let [a, b, c] = [a, b, c].map(|p| viewport.place(p));
                builder.cubic_to(a.x, a.y, b.x, b.y, c.x, c.y);
            }
            Segment::Circle(centre, radius) => {
                let centre = viewport.place(centre);
                builder.push_circle(centre.x, centre.y, radius * viewport.scale);
            }
            Segment::Close => builder.close(),
        }
    }
    builder.finish()
}

fn color(colour: Colour) -> Color {
    let Colour { red, green, blue, alpha } = colour;
    Color::from_rgba8(red, green, blue, (alpha * 255.0).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tile(width: usize, height: usize) -> Picture {
        Picture { width, height, bytes: vec![7; width * height * 3] }
    }

    #[test]
    fn a_sheet_holds_all_its_pictures() {
        let sheet = Picture::sheet(&vec![tile(4, 3); 5]);
        assert_eq!((sheet.width, sheet.height), (12, 6));
        assert_eq!(sheet.bytes.len(), 12 * 6 * 3);
        assert_eq!(Picture::sheet(&vec![tile(9, 2); 6]).width, 18);
    }

    #[test]
    fn only_bytes_of_a_picture_are_one() {
        let picture = tile(4, 3);
        assert_eq!(Picture::from_raw(&picture.to_raw()), Some(picture));
        let huge = [[0xff; 8], [7; 8]].concat();
        for raw in [&[0; 8][..], &[1, 0, 0, 0, 0, 0, 0, 0], &[1, 0, 0, 0, 1, 0, 0, 0, 7, 7], &huge, &[7]] {
            assert_eq!(Picture::from_raw(raw), None, "{raw:?}");
        }
    }

    #[test]
    fn a_picture_survives_its_file_in_colour_or_grey() {
        let coloured = Picture::new(2, 2, vec![7, 8, 9, 7, 7, 7, 1, 2, 3, 4, 5, 6]);
        let grey = Picture::new(2, 1, vec![7, 7, 7, 200, 200, 200]);
        for (picture, expected) in [(&coloured, coloured.bytes.clone()), (&grey, vec![7, 200])] {
            let file = picture.encoded().unwrap();
            let decoder = png::Decoder::new(std::io::Cursor::new(file));
            let mut reader = decoder.read_info().unwrap();
            let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut bytes).unwrap();
            assert_eq!(bytes, expected);
        }
    }
}
