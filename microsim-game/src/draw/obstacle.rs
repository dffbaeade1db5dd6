//! Obstacles of any shape, and the walls of the room.

use super::canvas::Canvas;
use super::palette::{HALO, INK, OBSTACLE, OUTSIDE, fade, mix};
use crate::camera::Camera;
use microsim_core::World;
use microsim_core::geometry::triangulate;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::math::Pose;
use microsim_core::parry2d::shape::{Shape, TypedShape};
use std::f32::consts::{PI, TAU};

/// Sides of what is round.
const ROUND: usize = 64;

/// The parts of an obstacle, in picture pixels.
#[derive(Debug, Default)]
struct Parts {
    /// Closed outlines, counter-clockwise in the room.
    solids: Vec<Vec<Vec2>>,
    lines: Vec<Vec<Vec2>>,
}

pub(super) fn draw_all(canvas: &mut Canvas, camera: &Camera, world: &World) {
    for obstacle in world.obstacles() {
        let mut parts = Parts::default();
        parts.add(obstacle.shape.as_ref(), &obstacle.pose, camera);
        parts.draw(canvas);
    }
}

impl Parts {
    fn add(&mut self, shape: &dyn Shape, pose: &Pose, camera: &Camera) {
        match shape.as_typed_shape() {
            TypedShape::Compound(compound) => {
                for (place, part) in compound.shapes() {
                    self.add(part.as_ref(), &(*pose * *place), camera);
                }
            }
            TypedShape::Polyline(polyline) => {
                for segment in polyline.segments() {
                    self.lines.push(placed(&[segment.a, segment.b], pose, camera));
                }
            }
            TypedShape::Segment(segment) => self.lines.push(placed(&[segment.a, segment.b], pose, camera)),
            TypedShape::TriMesh(mesh) => {
                let triangles = mesh.triangles().map(|t| placed(&[t.a, t.b, t.c], pose, camera));
                self.solids.extend(triangles);
            }
            _ => self.solids.extend(outline(shape).map(|points| placed(&points, pose, camera))),
        }
    }

    /// All edges below all fills, so that parts that touch look like one.
    fn draw(&self, canvas: &mut Canvas) {
        let clear = fade(HALO, 0.0);
        for solid in &self.solids {
            canvas.band(solid, &[(-1.0, fade(HALO, 0.8)), (3.0, fade(HALO, 0.5)), (11.0, clear)]);
        }
        for solid in &self.solids {
            canvas.band(solid, &[(-1.0, fade(INK, 0.8)), (1.2, fade(INK, 0.8)), (2.2, fade(INK, 0.0))]);
        }
        for solid in &self.solids {
            canvas.fill(solid, &triangulate(solid), OBSTACLE);
        }
        if let [solid] = self.solids.as_slice() {
            let shade = mix(OBSTACLE, INK, 0.45);
            canvas.band(solid, &[(-14.0, fade(shade, 0.0)), (-5.0, fade(shade, 0.25)), (0.0, fade(shade, 0.75))]);
        }
        let glow = fade(HALO, 0.7);
        for line in &self.lines {
            canvas.line(line, &[(-9.0, clear), (-2.0, glow), (2.0, glow), (9.0, clear)]);
        }
        let (ink, none) = (fade(INK, 0.85), fade(INK, 0.0));
        for line in &self.lines {
            canvas.line(line, &[(-2.6, none), (-1.6, ink), (1.6, ink), (2.6, none)]);
        }
    }
}

/// Outline of a shape in one piece, in its own frame; none for what has no bounds.
fn outline(shape: &dyn Shape) -> Option<Vec<Vec2>> {
    Some(match shape.as_typed_shape() {
        TypedShape::Ball(ball) => arc(Vec2::ZERO, ball.radius, 0.0, TAU),
        TypedShape::Cuboid(cuboid) => rectangle(-cuboid.half_extents, cuboid.half_extents),
        TypedShape::Capsule(capsule) => {
            let along = (capsule.segment.b - capsule.segment.a).to_angle();
            let mut points = arc(capsule.segment.b, capsule.radius, along - 0.5 * PI, along + 0.5 * PI);
            points.extend(arc(capsule.segment.a, capsule.radius, along + 0.5 * PI, along + 1.5 * PI));
            points
        }
        TypedShape::ConvexPolygon(polygon) => polygon.points().to_vec(),
        TypedShape::Triangle(triangle) => vec![triangle.a, triangle.b, triangle.c],
        TypedShape::HalfSpace(_) => return None,
        _ => {
            let bounds = shape.compute_local_aabb();
            rectangle(bounds.mins, bounds.maxs)
        }
    })
}

fn rectangle(low: Vec2, high: Vec2) -> Vec<Vec2> {
    vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)]
}

/// Points from one angle to the next, without the last one.
fn arc(centre: Vec2, radius: f32, from: f32, to: f32) -> Vec<Vec2> {
    let count = ((to - from) / TAU * ROUND as f32).ceil().max(1.0) as usize;
    let angles = (0..=count).map(|k| from + (to - from) * k as f32 / count as f32);
    let points = angles.map(|angle| centre + Vec2::from_angle(angle) * radius);
    points.take(if to - from < TAU { count + 1 } else { count }).collect()
}

fn placed(points: &[Vec2], pose: &Pose, camera: &Camera) -> Vec<Vec2> {
    points.iter().map(|&point| camera.to_screen(pose.transform_point(point))).collect()
}

/// Dims what lies outside the room and marks its edge.
pub(super) fn draw_walls(canvas: &mut Canvas, camera: &Camera) {
    let (low, high) = (camera.to_screen(Vec2::ZERO), camera.to_screen(camera.room()));
    let (left, bottom, right, top) = (low.x, low.y, high.x, high.y);
    let screen = camera.screen();
    let sheets = [
        (Vec2::ZERO, Vec2::new(screen.x, top)),
        (Vec2::new(0.0, bottom), screen),
        (Vec2::new(0.0, top), Vec2::new(left, bottom)),
        (Vec2::new(right, top), Vec2::new(screen.x, bottom)),
    ];
    for (from, to) in sheets.into_iter().filter(|(from, to)| from.cmplt(*to).all()) {
        canvas.rectangle(from, to, OUTSIDE);
    }
    let room = [Vec2::new(left, bottom), Vec2::new(right, bottom), Vec2::new(right, top), Vec2::new(left, top)];
    // Normals at corners are diagonal, so a side is as far out as `offset / sqrt(2)`.
    canvas.band(
        &room,
        &[
            (-14.0, fade(INK, 0.0)),
            (-2.0, fade(INK, 0.22)),
            (0.0, fade(INK, 0.75)),
            (2.5, fade(INK, 0.75)),
            (4.0, fade(INK, 0.0)),
        ],
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::geometry::signed_area;
    use microsim_core::parry2d::shape::SharedShape;

    fn parts(shape: &SharedShape) -> Parts {
        let camera = Camera::whole(Vec2::new(40.0, 20.0), Vec2::new(400.0, 200.0));
        let mut parts = Parts::default();
        parts.add(shape.as_ref(), &Pose::translation(20.0, 10.0), &camera);
        parts
    }

    #[test]
    fn outlines_have_the_area_of_their_shape() {
        let points = [Vec2::new(-2.0, -1.0), Vec2::new(2.0, -1.0), Vec2::new(0.0, 2.0)];
        let cases = [
            (SharedShape::ball(2.0), PI * 4.0),
            (SharedShape::cuboid(2.0, 1.0), 8.0),
            (SharedShape::capsule(Vec2::new(-1.0, 0.0), Vec2::new(2.0, 4.0), 1.0), PI + 10.0),
            (SharedShape::convex_hull(&points).unwrap(), 6.0),
        ];
        for (shape, area) in cases {
            let found = signed_area(&outline(shape.as_ref()).unwrap());
            assert!((found - area).abs() < 0.02 * area, "{:?}: {found} for {area}", shape.shape_type());
        }
    }

    #[test]
    fn compounds_and_lines_come_apart() {
        let ball = SharedShape::ball(1.0);
        let compound = SharedShape::compound(vec![
            (Pose::translation(-3.0, 0.0), ball.clone()),
            (Pose::translation(3.0, 0.0), ball),
        ]);
        assert_eq!(parts(&compound).solids.len(), 2);
        let line = SharedShape::polyline(vec![Vec2::ZERO, Vec2::X, Vec2::ONE], None);
        assert_eq!((parts(&line).solids.len(), parts(&line).lines.len()), (0, 2));
    }
}
