//! Areas that overlap queries ask about: discs and polygons.

use super::entry::Disc;
use crate::collision::obstacle::Obstacle;
use crate::geometry::polygon::contains_point;
use crate::geometry::segment::{nearest_on_segment, segments_touch};
use crate::geometry::triangulate::triangulate;
use glam::Vec2;
use parry2d::bounding_volume::Aabb;
use parry2d::math::Pose;
use parry2d::query::intersection_test;
use parry2d::shape::Triangle;

/// Where something is looked for.
#[derive(Clone, Debug)]
pub(super) enum QueryArea<'a> {
    Disc(Vec2, f32),
    /// The corners of a simple polygon.
    Polygon(&'a [Vec2]),
}

impl QueryArea<'_> {
    /// The box around it; `None` if there is no such area.
    pub(super) fn aabb(&self) -> Option<Aabb> {
        match *self {
            Self::Disc(centre, radius) => {
                let is_sound = centre.is_finite() && (0.0..f32::INFINITY).contains(&radius);
                is_sound.then(|| Aabb::new(centre - radius, centre + radius))
            }
            Self::Polygon(corners) => {
                let is_sound = corners.len() >= 3 && corners.iter().all(|corner| corner.is_finite());
                is_sound.then(|| Aabb::from_points(corners.iter().copied()))
            }
        }
    }

    pub(super) fn touches_disc(&self, disc: &Disc) -> bool {
        match *self {
            Self::Disc(centre, radius) => {
                let extent = radius + disc.radius;
                (disc.at - centre).length_squared() <= extent * extent
            }
            Self::Polygon(corners) => reaches_into(corners, disc.at, disc.radius),
        }
    }

    /// Whether it overlaps the area of another polygon.
    pub(super) fn touches_outline(&self, outline: &[Vec2]) -> bool {
        match *self {
            Self::Disc(centre, radius) => reaches_into(outline, centre, radius),
            Self::Polygon(corners) => {
                let crosses = |(a, b)| edges(outline).any(|(c, d)| segments_touch(a, b, c, d));
                contains_point(outline, corners[0])
                    || contains_point(corners, outline[0])
                    || edges(corners).any(crosses)
            }
        }
    }

    pub(super) fn touches_obstacle(&self, obstacle: &Obstacle) -> bool {
        let reaches = |point: Vec2, radius: f32| {
            let (surface, is_inside) = obstacle.nearest(point);
            is_inside || (point - surface).length() <= radius
        };
        match *self {
            Self::Disc(centre, radius) => reaches(centre, radius),
            Self::Polygon(corners) => {
                let touches = |[a, b, c]: [u32; 3]| {
                    let [a, b, c] = [a, b, c].map(|k| corners[k as usize]);
                    let shape = obstacle.shape.0.as_ref();
                    intersection_test(&Pose::IDENTITY, &Triangle::new(a, b, c), &obstacle.pose, shape)
                        .is_ok_and(|found| found.intersecting)
                };
                reaches(corners[0], 0.0) || triangulate(corners).into_iter().any(touches)
            }
        }
    }
}

/// Whether a circle reaches into the area of a polygon.
pub(super) fn reaches_into(outline: &[Vec2], centre: Vec2, radius: f32) -> bool {
    contains_point(outline, centre)
        || edges(outline).any(|(a, b)| (nearest_on_segment(a, b, centre) - centre).length() <= radius)
}

fn edges(polygon: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}
