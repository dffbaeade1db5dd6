//! Obstacles as the numbers that their shapes are made from: what digests and snapshots know of them.

use super::obstacle::{Obstacle, ObstacleMotion};
use crate::particle::{CollisionGroups, Material};
use glam::Vec2;
use parry2d::math::{Pose, Rot2};
#[cfg(feature = "snapshot")]
use parry2d::shape::{Polyline, RoundShape};
use parry2d::shape::{PolylineFlags, SharedShape, Triangle, TypedShape};
use serde::{Deserialize, Serialize};

/// An obstacle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ObstacleRecord {
    shape: ShapeRecords,
    pose: PoseRecord,
    surface: Surface,
}

/// All of an obstacle but its shape and its place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Surface {
    material: Material,
    groups: CollisionGroups,
    motion: ObstacleMotion,
    one_way: Option<Vec2>,
    is_sensor: bool,
    is_enabled: bool,
}

/// A place and the cosine and sine of an angle.
pub(crate) type PoseRecord = (Vec2, [f32; 2]);

/// A shape, or the shapes that it consists of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum ShapeRecords {
    One(ShapeRecord),
    Several(Vec<(PoseRecord, ShapeRecord)>),
}

/// A shape that is no collection.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum ShapeRecord {
    Ball(f32),
    /// Half extents and the radius of the border.
    Cuboid(Vec2, f32),
    /// Ends and radius.
    Capsule(Vec2, Vec2, f32),
    Segment(Vec2, Vec2),
    /// Corners and the radius of the border.
    Triangle([Vec2; 3], f32),
    /// Corners and the radius of the border.
    ConvexPolygon(Vec<Vec2>, f32),
    Polyline(Vec<Vec2>, Vec<[u32; 2]>),
}

impl ObstacleRecord {
    /// `None` for a shape of a kind that has no record.
    pub(crate) fn of(obstacle: &Obstacle) -> Option<Self> {
        let shape = match obstacle.shape.as_typed_shape() {
            TypedShape::Compound(compound) if compound.flags().is_empty() => {
                let part = |(pose, shape): &(Pose, SharedShape)| Some((record(pose), ShapeRecord::of(shape)?));
                ShapeRecords::Several(compound.shapes().iter().map(part).collect::<Option<_>>()?)
            }
            _ => ShapeRecords::One(ShapeRecord::of(&obstacle.shape)?),
        };
        Some(Self { shape, pose: record(&obstacle.pose), surface: Surface::of(obstacle) })
    }

    /// The obstacle, if its numbers make one.
    #[cfg(feature = "snapshot")]
    pub(crate) fn restore(self) -> Option<Obstacle> {
        let Self { shape, pose, surface } = self;
        let Surface { material, groups, motion, one_way, is_sensor, is_enabled } = surface;
        let shape = match shape {
            ShapeRecords::One(shape) => shape.restore()?,
            ShapeRecords::Several(parts) if !parts.is_empty() => {
                let is_simple = |(_, shape): &(_, ShapeRecord)| !matches!(shape, ShapeRecord::Polyline(..));
                let part = |(place, shape): (PoseRecord, ShapeRecord)| Some((pose_of(place)?, shape.restore()?));
                let is_sound = parts.iter().all(is_simple);
                SharedShape::compound(parts.into_iter().map(part).collect::<Option<_>>().filter(|_| is_sound)?)
            }
            ShapeRecords::Several(_) => return None,
        };
        Some(Obstacle { shape, pose: pose_of(pose)?, material, groups, motion, one_way, is_sensor, is_enabled })
    }
}

impl Surface {
    pub(crate) fn of(obstacle: &Obstacle) -> Self {
        let &Obstacle { material, groups, motion, one_way, is_sensor, is_enabled, .. } = obstacle;
        Self { material, groups, motion, one_way, is_sensor, is_enabled }
    }
}

impl ShapeRecord {
    fn of(shape: &SharedShape) -> Option<Self> {
        let corners = |Triangle { a, b, c }: &Triangle| [*a, *b, *c];
        Some(match shape.as_typed_shape() {
            TypedShape::Ball(ball) => Self::Ball(ball.radius),
            TypedShape::Cuboid(cuboid) => Self::Cuboid(cuboid.half_extents, 0.0),
            TypedShape::RoundCuboid(round) => Self::Cuboid(round.inner_shape.half_extents, round.border_radius),
            TypedShape::Capsule(capsule) => Self::Capsule(capsule.segment.a, capsule.segment.b, capsule.radius),
            TypedShape::Segment(segment) => Self::Segment(segment.a, segment.b),
            TypedShape::Triangle(triangle) => Self::Triangle(corners(triangle), 0.0),
            TypedShape::RoundTriangle(round) => Self::Triangle(corners(&round.inner_shape), round.border_radius),
            TypedShape::ConvexPolygon(polygon) => Self::ConvexPolygon(polygon.points().to_vec(), 0.0),
            TypedShape::RoundConvexPolygon(round) => {
                Self::ConvexPolygon(round.inner_shape.points().to_vec(), round.border_radius)
            }
            TypedShape::Polyline(line) if line.flags() == PolylineFlags::empty() => {
                Self::Polyline(line.vertices().to_vec(), line.indices().to_vec())
            }
            _ => return None,
        })
    }

    #[cfg(feature = "snapshot")]
    fn restore(self) -> Option<SharedShape> {
        let are_finite = |points: &[Vec2]| points.iter().all(|at| at.is_finite());
        let is_sound = match &self {
            Self::Ball(radius) => is_length(*radius),
            Self::Cuboid(half, border) => is_length(half.x) && is_length(half.y) && is_length(*border),
            Self::Capsule(a, b, radius) => are_finite(&[*a, *b]) && is_length(*radius),
            Self::Segment(a, b) => are_finite(&[*a, *b]),
            Self::Triangle(corners, border) => are_finite(corners) && is_length(*border),
            Self::ConvexPolygon(corners, border) => are_finite(corners) && is_length(*border),
            Self::Polyline(corners, links) => {
                let is_known = |&k: &u32| (k as usize) < corners.len();
                are_finite(corners) && !links.is_empty() && links.iter().flatten().all(is_known)
            }
        };
        let shape = match self {
            _ if !is_sound => return None,
            Self::Ball(radius) => SharedShape::ball(radius),
            Self::Cuboid(half, 0.0) => SharedShape::cuboid(half.x, half.y),
            Self::Cuboid(half, border) => SharedShape::round_cuboid(half.x, half.y, border),
            Self::Capsule(a, b, radius) => SharedShape::capsule(a, b, radius),
            Self::Segment(a, b) => SharedShape::segment(a, b),
            Self::Triangle([a, b, c], 0.0) => SharedShape::triangle(a, b, c),
            Self::Triangle([a, b, c], border) => SharedShape::round_triangle(a, b, c, border),
            Self::ConvexPolygon(corners, border) => {
                let polygon = parry2d::shape::ConvexPolygon::from_convex_polyline_unmodified(corners)?;
                match border {
                    0.0 => SharedShape::new(polygon),
                    _ => SharedShape::new(RoundShape { inner_shape: polygon, border_radius: border }),
                }
            }
            Self::Polyline(corners, links) => SharedShape::new(Polyline::new(corners, Some(links))),
        };
        Some(shape)
    }
}

/// A pose as its numbers.
pub(crate) fn record(pose: &Pose) -> PoseRecord {
    (pose.translation, [pose.rotation.re, pose.rotation.im])
}

/// The pose of these numbers, if they are one.
pub(crate) fn pose_of((at, [cosine, sine]): PoseRecord) -> Option<Pose> {
    let is_sound = at.is_finite() && (cosine * cosine + sine * sine - 1.0).abs() < 1e-3;
    is_sound.then(|| Pose::from_parts(at, Rot2::from_cos_sin_unchecked(cosine, sine)))
}

#[cfg(feature = "snapshot")]
fn is_length(value: f32) -> bool {
    value.is_finite() && value >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_what_its_numbers_say_and_other_numbers_are_none() {
        let pose = Pose::from_parts(Vec2::new(3.0, -4.0), Rot2::from_cos_sin_unchecked(0.6, -0.8));
        assert_eq!(pose_of(record(&pose)), Some(pose));
        for broken in [(Vec2::ZERO, [0.0, 0.0]), (Vec2::ZERO, [1.0, 0.1]), (Vec2::new(0.0, f32::NAN), [1.0, 0.0])] {
            assert_eq!(pose_of(broken), None, "{broken:?}");
        }
    }

    #[cfg(feature = "snapshot")]
    #[test]
    fn a_shape_is_the_same_after_its_record_and_a_broken_record_is_none() {
        let [a, b, c] = [Vec2::ZERO, Vec2::new(2.0, 0.0), Vec2::new(0.5, 1.5)];
        let polygon = || parry2d::shape::ConvexPolygon::from_convex_polyline_unmodified(vec![a, b, c]).unwrap();
        for shape in [
            SharedShape::ball(0.7),
            SharedShape::cuboid(2.0, 1.0),
            SharedShape::round_cuboid(2.0, 1.0, 0.2),
            SharedShape::capsule(a, b, 0.3),
            SharedShape::segment(a, b),
            SharedShape::triangle(a, b, c),
            SharedShape::round_triangle(a, b, c, 0.2),
            SharedShape::new(polygon()),
            SharedShape::new(RoundShape { inner_shape: polygon(), border_radius: 0.2 }),
            SharedShape::polyline(vec![a, b, c], None),
        ] {
            let record = ShapeRecord::of(&shape).unwrap_or_else(|| panic!("{:?}", shape.shape_type()));
            let back = record.clone().restore().unwrap();
            assert_eq!((back.shape_type(), ShapeRecord::of(&back)), (shape.shape_type(), Some(record)));
        }
        let oriented = Polyline::with_flags(vec![a, b, c], None, PolylineFlags::all());
        assert_eq!(ShapeRecord::of(&SharedShape::new(oriented)), None);
        let nowhere = Vec2::new(0.0, f32::NAN);
        for broken in [
            ShapeRecord::Ball(-1.0),
            ShapeRecord::Cuboid(Vec2::new(1.0, f32::INFINITY), 0.0),
            ShapeRecord::Capsule(a, nowhere, 1.0),
            ShapeRecord::Segment(a, nowhere),
            ShapeRecord::Triangle([a, b, nowhere], 0.0),
            ShapeRecord::ConvexPolygon(vec![a, b, c], f32::NAN),
            ShapeRecord::Polyline(vec![a, b], Vec::new()),
            ShapeRecord::Polyline(vec![a, b], vec![[0, 2]]),
            ShapeRecord::Polyline(vec![a, nowhere], vec![[0, 1]]),
        ] {
            assert!(broken.clone().restore().is_none(), "{broken:?}");
        }
    }
}
