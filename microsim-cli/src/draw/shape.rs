//! What drawings are made of.

use microsim_core::glam::Vec2;

/// A colour that covers what is below it by `alpha`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Colour {
    pub red: u8,
    pub green: u8,
    pub blue: u8,
    pub alpha: f32,
}

impl Colour {
    /// From `0xRRGGBB`, opaque.
    pub(crate) const fn hex(rgb: u32) -> Self {
        let [_, red, green, blue] = rgb.to_be_bytes();
        Self { red, green, blue, alpha: 1.0 }
    }

    /// The same, covering less.
    pub(crate) const fn faded(self, alpha: f32) -> Self {
        Self { alpha, ..self }
    }
}

/// How an area is filled.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Paint {
    /// Evenly.
    Flat(Colour),
    /// From the centre outwards.
    Radial { centre: Vec2, radius: f32, inner: Colour, outer: Colour },
}

/// A line along a path, with round caps and joins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    pub colour: Colour,
    /// Units of the world.
    pub width: f32,
}

impl Stroke {
    pub(crate) fn new(colour: Colour, width: f32) -> Self {
        Self { colour, width }
    }
}

/// One piece of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Segment {
    Move(Vec2),
    Line(Vec2),
    Cubic(Vec2, Vec2, Vec2),
    /// A whole circle of its own.
    Circle(Vec2, f32),
    Close,
}

/// Lines, curves and circles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Path {
    pub segments: Vec<Segment>,
}

impl Path {
    pub(crate) fn circle(centre: Vec2, radius: f32) -> Self {
        Self::circles([(centre, radius)])
    }

    /// Many circles as one area.
    pub(crate) fn circles(circles: impl IntoIterator<Item = (Vec2, f32)>) -> Self {
        let circles = circles.into_iter();
        let segments = circles.map(|(centre, radius)| Segment::Circle(centre, radius));
        Self { segments: segments.collect() }
    }

    /// A closed line with corners.
    pub(crate) fn polygon(points: &[Vec2]) -> Self {
        let mut path = Self::default();
        path.add_polygon(points);
        path
    }

    pub(crate) fn add_polygon(&mut self, points: &[Vec2]) {
        self.add_line(points);
        self.segments.push(Segment::Close);
    }

    /// Adds an open line with corners.
    pub(crate) fn add_line(&mut self, points: &[Vec2]) {
        if let Some((&first, rest)) = points.split_first() {
            self.segments.push(Segment::Move(first));
            self.segments.extend(rest.iter().map(|&point| Segment::Line(point)));
        }
    }

    /// A closed smooth line through all points: Catmull-Rom, each tangent being a sixth of the chord around the point.
    pub(crate) fn smooth(points: &[Vec2]) -> Self {
        let count = points.len();
        if count < 3 {
            return Self::polygon(points);
        }
        let at = |k: usize| points[k % count];
        let mut segments = vec![Segment::Move(points[0])];
        segments.extend((0..count).map(|k| {
            let (before, from, to, after) = (at(k + count - 1), at(k), at(k + 1), at(k + 2));
            Segment::Cubic(from + (to - before) / 6.0, to - (after - from) / 6.0, to)
        }));
        segments.push(Segment::Close);
        Self { segments }
    }

    /// An open smooth line through all points.
    pub(crate) fn smooth_open(points: &[Vec2]) -> Self {
        let last = points.len().saturating_sub(1);
        let at = |k: usize| points[k.min(last)];
        let mut path = Self::default();
        path.add_line(&points[..points.len().min(1)]);
        path.segments.extend((0..last).map(|k| {
            let (before, from, to, after) = (at(k.saturating_sub(1)), at(k), at(k + 1), at(k + 2));
            Segment::Cubic(from + (to - before) / 6.0, to - (after - from) / 6.0, to)
        }));
        path
    }
}

/// One thing to draw: its area first, then its line.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    pub path: Path,
    pub fill: Option<Paint>,
    pub stroke: Option<Stroke>,
}

impl Item {
    pub(crate) fn filled(path: Path, paint: Paint) -> Self {
        Self { path, fill: Some(paint), stroke: None }
    }

    pub(crate) fn stroked(path: Path, stroke: Stroke) -> Self {
        Self { path, fill: None, stroke: Some(stroke) }
    }

    pub(crate) fn outlined(mut self, stroke: Stroke) -> Self {
        self.stroke = Some(stroke);
        self
    }

    /// The same, scaled after `origin` was made the origin.
    pub(crate) fn placed(mut self, origin: Vec2, scale: f32) -> Self {
        let place = |p: Vec2| (p - origin) * scale;
        for segment in &mut self.path.segments {
            *segment = match *segment {
                Segment::Move(p) => Segment::Move(place(p)),
                Segment::Line(p) => Segment::Line(place(p)),
                Segment::Cubic(a, b, c) => Segment::Cubic(place(a), place(b), place(c)),
                Segment::Circle(centre, radius) => Segment::Circle(place(centre), radius * scale),
                Segment::Close => Segment::Close,
            };
        }
        self
    }

    /// Whether it can be drawn at all.
    pub(crate) fn is_finite(&self) -> bool {
        let mut segments = self.path.segments.iter();
        segments.all(|segment| match segment {
            Segment::Move(p) | Segment::Line(p) => p.is_finite(),
            Segment::Cubic(a, b, c) => a.is_finite() && b.is_finite() && c.is_finite(),
            Segment::Circle(centre, radius) => centre.is_finite() && radius.is_finite(),
            Segment::Close => true,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_line_passes_through_its_points() {
        let points = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let path = Path::smooth(&points);
        let ends = path.segments.iter().filter_map(|segment| match segment {
            Segment::Cubic(_, _, end) => Some(*end),
            _ => None,
        });
        assert_eq!(ends.collect::<Vec<_>>(), [Vec2::X, Vec2::ONE, Vec2::Y, Vec2::ZERO]);
    }

    #[test]
    fn what_is_not_finite_is_known() {
        let item = |centre| Item::filled(Path::circle(centre, 1.0), Paint::Flat(Colour::hex(0)));
        assert!(item(Vec2::ONE).is_finite());
        assert!(!item(Vec2::NAN).is_finite());
    }

    #[test]
    fn short_paths_do_not_panic() {
        for count in 0..3 {
            let points = vec![Vec2::ONE; count];
            let _ = (Path::smooth(&points), Path::smooth_open(&points));
        }
    }
}
