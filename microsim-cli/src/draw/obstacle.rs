//! Obstacles: any shape of the geometry library, as an area or as lines.

use super::palette::STONE;
use super::shape::{Item, Paint, Path, Segment, Stroke};
use microsim_core::Obstacle;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::math::Pose;
use microsim_core::parry2d::shape::{Shape, TypedShape};

/// Corners of a quarter of a rounded outline.
const CORNERS: u32 = 24;

/// What is seen of an obstacle: its line first and its area above, so that the seams of its parts are hidden.
pub(crate) fn draw(obstacle: &Obstacle) -> Vec<Item> {
    let mut parts = Parts::default();
    parts.add(&*obstacle.shape, obstacle.pose);
    let size = obstacle.shape.compute_local_aabb().half_extents().min_element();
    let rim = Stroke::new(STONE.line, (size * 0.16).clamp(0.1, 0.8));
    let items = [
        Item::stroked(parts.area.clone(), rim),
        Item::filled(parts.area, Paint::Flat(STONE.inner)),
        Item::stroked(parts.lines, Stroke::new(STONE.line, 0.5)),
    ];
    let items = items.into_iter().filter(|item| !item.path.segments.is_empty());
    items.collect()
}

/// The parts of an obstacle, in the world.
#[derive(Debug, Default)]
struct Parts {
    area: Path,
    lines: Path,
}

impl Parts {
    fn add(&mut self, shape: &dyn Shape, pose: Pose) {
        match shape.as_typed_shape() {
            TypedShape::Compound(compound) => {
                compound.shapes().iter().for_each(|(place, part)| self.add(&**part, pose * *place));
            }
            TypedShape::Ball(ball) => {
                let centre = pose.transform_point(Vec2::ZERO);
                self.area.segments.push(Segment::Circle(centre, ball.radius));
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

    /// Turned the same way as all others, so that areas that overlap add up.
    fn add_area(&mut self, points: &[Vec2], pose: Pose) {
        let mut points = placed(points, pose);
        let turn: f32 = points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| a.perp_dot(*b)).sum();
        if turn < 0.0 {
            points.reverse();
        }
        self.area.add_polygon(&points);
    }

    fn add_line(&mut self, points: &[Vec2], pose: Pose) {
        self.lines.add_line(&placed(points, pose));
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
    use microsim_core::parry2d::shape::SharedShape;

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
            let items = draw(&Obstacle::new(shape, Pose::translation(1.0, 1.0)));
            assert!(!items.is_empty());
        }
        let pair = SharedShape::compound(vec![
            (Pose::translation(0.0, 0.0), ball.clone()),
            (Pose::translation(3.0, 0.0), ball),
        ]);
        let items = draw(&Obstacle::new(pair, Pose::translation(0.0, 0.0)));
        assert_eq!(items[0].path.segments.len(), 2);
    }
}
