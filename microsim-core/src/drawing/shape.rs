//! What drawings are made of.

pub use crate::Colour;
use crate::OrganismId;
use glam::Vec2;

/// How an area is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// Evenly.
    Flat(Colour),
    /// From the centre outwards.
    Radial {
        /// Where the inner colour is.
        centre: Vec2,
        /// Distance at which the outer colour is, units.
        radius: f32,
        /// Colour in the centre.
        inner: Colour,
        /// Colour at the radius and beyond.
        outer: Colour,
    },
}

/// A line along a shape, with round caps and joins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width, units.
    pub width: f32,
}

/// Where something is, units.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// Discs as one area: centres and radii.
    Discs(Vec<(Vec2, f32)>),
    /// A closed smooth line through all points.
    Outline(Vec<Vec2>),
    /// An open smooth line through all points.
    Curve(Vec<Vec2>),
    /// Closed lines with corners, as one area.
    Polygons(Vec<Vec<Vec2>>),
    /// Open lines with corners.
    Lines(Vec<Vec<Vec2>>),
}

/// One piece of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Begins a line.
    Move(Vec2),
    /// Straight on to a point.
    Line(Vec2),
    /// A cubic Bézier curve: two control points and the end.
    Cubic(Vec2, Vec2, Vec2),
    /// A whole circle: centre and radius.
    Circle(Vec2, f32),
    /// Back to where the line began.
    Close,
}

impl Geometry {
    /// A single disc.
    #[must_use]
    pub fn disc(centre: Vec2, radius: f32) -> Self {
        Self::Discs(vec![(centre, radius)])
    }

    /// Whether there is nothing to draw.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Discs(discs) => discs.is_empty(),
            Self::Outline(points) | Self::Curve(points) => points.is_empty(),
            Self::Polygons(lines) | Self::Lines(lines) => lines.iter().all(Vec::is_empty),
        }
    }

    /// Whether all of it has a place.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Discs(discs) => discs.iter().all(|(centre, radius)| centre.is_finite() && radius.is_finite()),
            Self::Outline(points) | Self::Curve(points) => points.iter().all(|point| point.is_finite()),
            Self::Polygons(lines) | Self::Lines(lines) => lines.iter().flatten().all(|point| point.is_finite()),
        }
    }

    /// The same elsewhere.
    pub(super) fn moved(mut self, by: Vec2) -> Self {
        match &mut self {
            Self::Discs(discs) => discs.iter_mut().for_each(|(centre, _)| *centre += by),
            Self::Outline(points) | Self::Curve(points) => points.iter_mut().for_each(|point| *point += by),
            Self::Polygons(lines) | Self::Lines(lines) => lines.iter_mut().flatten().for_each(|point| *point += by),
        }
        self
    }

    /// The shape as circles, straight lines and cubic curves.
    #[must_use]
    pub fn segments(&self) -> Vec<Segment> {
        match self {
            Self::Discs(discs) => discs.iter().map(|&(centre, radius)| Segment::Circle(centre, radius)).collect(),
            Self::Outline(points) => outline(points),
            Self::Curve(points) => curve(points),
            Self::Polygons(lines) => lines.iter().flat_map(|line| straight(line).chain([Segment::Close])).collect(),
            Self::Lines(lines) => lines.iter().flat_map(|line| straight(line)).collect(),
        }
    }
}

fn straight(points: &[Vec2]) -> impl Iterator<Item = Segment> {
    let first = points.first().map(|&point| Segment::Move(point));
    first.into_iter().chain(points.iter().skip(1).map(|&point| Segment::Line(point)))
}

/// Catmull-Rom: each tangent is a sixth of the chord around the point.
fn outline(points: &[Vec2]) -> Vec<Segment> {
    let count = points.len();
    if count < 3 {
        return straight(points).chain([Segment::Close]).collect();
    }
    let at = |k: usize| points[k % count];
    let cubics = (0..count).map(|k| cubic([at(k + count - 1), at(k), at(k + 1), at(k + 2)]));
    [Segment::Move(points[0])].into_iter().chain(cubics).chain([Segment::Close]).collect()
}

fn curve(points: &[Vec2]) -> Vec<Segment> {
    let last = points.len().saturating_sub(1);
    let at = |k: usize| points[k.min(last)];
    let cubics = (0..last).map(|k| cubic([at(k.saturating_sub(1)), at(k), at(k + 1), at(k + 2)]));
    points.first().map(|&point| Segment::Move(point)).into_iter().chain(cubics).collect()
}

fn cubic([before, from, to, after]: [Vec2; 4]) -> Segment {
    Segment::Cubic(from + (to - before) / 6.0, to - (after - from) / 6.0, to)
}

/// What an item is a part of; painters may have a way of their own for some parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnPart {
    /// The floor of the room.
    Room,
    /// Where there is at least so much of a chemical.
    Chemical,
    /// The bright seam around a thick cell.
    Halo,
    /// The edge of an obstacle.
    ObstacleRim,
    /// An obstacle.
    Obstacle,
    /// An obstacle that is a line.
    ObstacleLine,
    /// The area within the surface of a cell.
    Body,
    /// Particles of cytoplasm.
    Cytoplasm,
    /// Particles of cytoplasm that the cell has grown.
    GrownCytoplasm,
    /// Membrane and fluid around prey.
    Phagosome,
    /// The line around a cell.
    Membrane,
    /// The front of a crawling membrane.
    LeadingEdge,
    /// The inner line of a cell.
    Cortex,
    /// The front of a rigid cell.
    Cap,
    /// A nucleus.
    Nucleus,
    /// A disc that is a body or part of one.
    Bead,
    /// The edge of such discs.
    BeadRim,
    /// A bright or dark spot on a disc.
    Spot,
    /// Fluid.
    Fluid,
    /// The surroundings of the room.
    Border,
    /// The line around the room.
    Wall,
    /// What explains the drawing.
    Caption,
}

/// One thing to draw: its area first, then its line.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// What it is.
    pub part: DrawnPart,
    /// Where it is.
    pub geometry: Geometry,
    /// How its area is filled.
    pub fill: Option<Paint>,
    /// The line along it.
    pub stroke: Option<Stroke>,
    /// The organism that it belongs to.
    pub owner: Option<OrganismId>,
}

impl Item {
    /// An area.
    #[must_use]
    pub fn filled(part: DrawnPart, geometry: Geometry, paint: Paint) -> Self {
        Self { part, geometry, fill: Some(paint), stroke: None, owner: None }
    }

    /// A line.
    #[must_use]
    pub fn stroked(part: DrawnPart, geometry: Geometry, stroke: Stroke) -> Self {
        Self { part, geometry, fill: None, stroke: Some(stroke), owner: None }
    }

    /// The same elsewhere.
    pub(super) fn moved(mut self, by: Vec2) -> Self {
        self.geometry = self.geometry.moved(by);
        if let Some(Paint::Radial { centre, .. }) = &mut self.fill {
            *centre += by;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_line_passes_through_its_points() {
        let points = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let ends = |geometry: Geometry| {
            let end = |segment| if let Segment::Cubic(_, _, end) = segment { Some(end) } else { None };
            geometry.segments().into_iter().filter_map(end).collect::<Vec<_>>()
        };
        assert_eq!(ends(Geometry::Outline(points.clone())), [Vec2::X, Vec2::ONE, Vec2::Y, Vec2::ZERO]);
        assert_eq!(ends(Geometry::Curve(points)), [Vec2::X, Vec2::ONE, Vec2::Y]);
    }

    #[test]
    fn what_is_not_finite_is_known() {
        assert!(Geometry::disc(Vec2::ONE, 1.0).is_finite());
        assert!(!Geometry::disc(Vec2::NAN, 1.0).is_finite() && !Geometry::Outline(vec![Vec2::INFINITY]).is_finite());
    }

    #[test]
    fn short_lines_have_segments() {
        for count in 0..3 {
            let points = vec![Vec2::ONE; count];
            assert!(Geometry::Outline(points.clone()).segments().len() <= count + 1);
            assert_eq!(Geometry::Curve(points).segments().len(), count);
        }
    }
}
