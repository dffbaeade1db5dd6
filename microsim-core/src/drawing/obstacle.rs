//! Obstacles: any shape of the geometry library, as an area or as lines.

use super::palette::STONE;
use super::shape::{Item, Paint, Part, Shape, Stroke};
use crate::Obstacle;
use crate::geometry::signed_area;
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::{Shape as Solid, TypedShape};

/// Corners of a quarter of a rounded outline.
const CORNERS: u32 = 24;

/// An obstacle: its line first and its area above, so that the seams of its parts are hidden.
pub(super) fn draw(obstacle: &Obstacle) -> impl Iterator<Item = Item> {
    let mut parts = Pieces::default();
    parts.add(&*obstacle.shape, obstacle.pose);
    let size = obstacle.shape.compute_local_aabb().half_extents().min_element();
    let rim = Stroke { colour: STONE.line, width: (size * 0.16).clamp(0.1, 0.8) };
    let line = Stroke { colour: STONE.line, width: 0.5 };
    let (discs, polygons) = (Shape::Discs(parts.discs), Shape::Polygons(parts.polygons));
    let items = [
        Item::stroked(Part::ObstacleRim, discs.clone(), rim),
        Item::stroked(Part::ObstacleRim, polygons.clone(), rim),
        Item::filled(Part::Obstacle, discs, Paint::Flat(STONE.inner)),
        Item::filled(Part::Obstacle, polygons, Paint::Flat(STONE.inner)),
        Item::stroked(Part::ObstacleLine, Shape::Lines(parts.lines), line),
    ];
    items.into_iter().filter(|item| !item.shape.is_empty())
}

/// The parts of an obstacle, in the world.
#[derive(Debug, Default)]
struct Pieces {
    discs: Vec<(Vec2, f32)>,
    /// Counter-clockwise, so that areas that overlap add up.
    polygons: Vec<Vec<Vec2>>,
    lines: Vec<Vec<Vec2>>,
}

impl Pieces {
    fn add(&mut self, shape: &dyn Solid, pose: Pose) {
        match shape.as_typed_shape() {
            TypedShape::Compound(compound) => {
                compound.shapes().iter().for_each(|(place, part)| self.add(&**part, pose * *place));
            }
            TypedShape::Ball(ball) => {
                self.discs.push((pose.transform_point(Vec2::ZERO), ball.radius));
            }
            TypedShape::Cuboid(cuboid) => self.add_area(&cuboid.to_polyline(), pose),
            TypedShape::Capsule(capsule) => self.add_area(&capsule.to_polyline(CORNERS), pose),
            TypedShape::Triangle(triangle) => self.add_area(triangle.vertices(), pose),
            TypedShape::ConvexPolygon(polygon) => self.add_area(polygon.points(), pose),
            TypedShape::RoundCuboid(round) => self.add_area(&round.to_polyline(CORNERS), pose),
            TypedShape::RoundConvexPolygon(round) => self.add_area(&round.to_polyline(CORNERS), pose),
            TypedShape::TriMesh(mesh) => mesh.triangles().for_each(|t| self.add_area(t.vertices(), pose)),
            TypedShape::Segment(segment) => self.add_line(&[segment.a, segment.b], pose),
            TypedShape::Polyline(line) => line.segments().for_each(|s| self.add_line(&[s.a, s.b], pose)),
            // The few others are shown by their boxes.
            _ => self.add_line(&closed(&shape.compute_local_aabb().vertices()), pose),
        }
    }

    fn add_area(&mut self, points: &[Vec2], pose: Pose) {
        let mut points = placed(points, pose);
        if signed_area(&points) < 0.0 {
            points.reverse();
        }
        self.polygons.push(points);
    }

    fn add_line(&mut self, points: &[Vec2], pose: Pose) {
        self.lines.push(placed(points, pose));
    }
}

fn placed(points: &[Vec2], pose: Pose) -> Vec<Vec2> {
    points.iter().map(|&point| pose.transform_point(point)).collect()
}

fn closed(points: &[Vec2]) -> Vec<Vec2> {
    points.iter().chain(points.first()).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use parry2d::shape::SharedShape;

    #[test]
    fn outlines_have_the_area_of_their_shape() {
        let points = [Vec2::new(-2.0, -1.0), Vec2::new(2.0, -1.0), Vec2::new(0.0, 2.0)];
        let cases = [
            (SharedShape::cuboid(2.0, 1.0), 8.0),
            (SharedShape::capsule(Vec2::new(-1.0, 0.0), Vec2::new(2.0, 4.0), 1.0), std::f32::consts::PI + 10.0),
            (SharedShape::convex_hull(&points).unwrap(), 6.0),
        ];
        for (shape, area) in cases {
            let mut pieces = Pieces::default();
            pieces.add(shape.as_ref(), Pose::translation(3.0, 4.0));
            let found = signed_area(&pieces.polygons[0]);
            assert!((found - area).abs() < 0.02 * area, "{:?}: {found} for {area}", shape.shape_type());
        }
    }

    #[test]
    fn every_common_shape_is_drawn() {
        let square = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let ball = SharedShape::ball(1.0);
        let shapes = [
            SharedShape::cuboid(1.0, 2.0),
            SharedShape::capsule(Vec2::ZERO, Vec2::X, 1.0),
            SharedShape::convex_hull(&square).unwrap(),
            SharedShape::polyline(square.clone(), None),
            SharedShape::segment(Vec2::ZERO, Vec2::X),
            SharedShape::round_cuboid(1.0, 1.0, 0.2),
            SharedShape::halfspace(Vec2::Y),
            ball.clone(),
        ];
        for shape in shapes {
            assert!(draw(&Obstacle::new(shape, Pose::translation(1.0, 1.0))).count() > 0);
        }
        let pair = SharedShape::compound(vec![
            (Pose::translation(0.0, 0.0), ball.clone()),
            (Pose::translation(3.0, 0.0), ball),
        ]);
        let items: Vec<Item> = draw(&Obstacle::new(pair, Pose::translation(0.0, 0.0))).collect();
        assert!(items.len() == 2 && matches!(&items[0].shape, Shape::Discs(discs) if discs.len() == 2));
    }
}
