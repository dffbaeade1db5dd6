//! Continuous collision detection: where a disc that moves farther than its own size in a substep meets something first.
//!
//! Such a disc may be beyond what it met when contacts are projected. The contact is that of the time of impact on a straight way, as of
//! a bullet in Box2D; the disc is moved back to the tangent there, with the other's share by mass.

use crate::collision::obstacle::Obstacle;
use glam::Vec2;

/// A gap of this share of a disc's radius is none.
const TOUCH: f32 = 0.05;
/// Share of the radius by which a disc goes on along a surface that does not stop it: it stays outside.
const SLIDE: f32 = 0.5;
/// Most surfaces that are looked at on the way of a disc.
const MOST_LOOKS: usize = 256;

/// How a surface stops a disc.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    /// Unit vector out of the surface.
    pub away: Vec2,
    /// How far the disc is beyond the tangent at the end of its way, units.
    pub depth: f32,
    /// Whether it was on its way, and need not be at its end, that the disc was inside.
    pub has_passed: bool,
}

/// Unit vector from a disc to another one when they touch first, if the other comes from `between - way` to `between` beside it and is
/// outside at first.
pub(crate) fn first_touch(between: Vec2, way: Vec2, radius_sum: f32) -> Option<Vec2> {
    let start = between - way;
    let (squared, approach) = (start.length_squared(), start.dot(way));
    if squared <= radius_sum * radius_sum {
        let has_crossed = squared > 0.0 && start.dot(between) < 0.0;
        return has_crossed.then(|| start / squared.sqrt());
    }
    // |start + t way| = radius_sum, its first root.
    let way_squared = way.length_squared();
    let root = approach * approach - way_squared * (squared - radius_sum * radius_sum);
    if approach >= 0.0 || root < 0.0 {
        return None;
    }
    let t = -(approach + root.sqrt()) / way_squared;
    (t <= 1.0).then(|| (start + way * t) / radius_sum)
}

/// The first surface of an obstacle that stops a disc on a straight way, if it is outside at first. `holds` says by a direction out
/// of the surface whether the surface is solid there.
pub(crate) fn first_stop(
    obstacle: &Obstacle,
    [from, to]: [Vec2; 2],
    radius: f32,
    holds: impl Fn(Vec2) -> bool,
) -> Option<Stop> {
    let length = (to - from).length();
    let along = (to - from) / length;
    let mut gone = 0.0;
    for _ in 0..MOST_LOOKS {
        let at = from + along * gone;
        let (surface, is_inside) = obstacle.nearest(at);
        let distance = (at - surface).length();
        if is_inside || distance <= 1e-6 {
            return None;
        }
        let gap = distance - radius;
        if gap < TOUCH * radius {
            let away = (at - surface) / distance;
            let depth = radius - (to - surface).dot(away);
            if depth > 0.0 && along.dot(away) < 0.0 && holds(away) {
                return Some(Stop { away, depth, has_passed: true });
            }
        }
        // No surface is nearer than the nearest one: it is safe to go on as far.
        gone += if gap > SLIDE * radius { gap } else { SLIDE * radius };
        if gone >= length {
            return None;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use parry2d::math::Pose;
    use parry2d::shape::SharedShape;

    #[test]
    fn discs_touch_first_where_their_distance_is_the_sum_of_their_radii() {
        let touch = |from: Vec2, to: Vec2| first_touch(to, to - from, 2.0);
        assert_eq!(touch(Vec2::new(10.0, 0.0), Vec2::new(-30.0, 0.0)), Some(Vec2::X));
        assert_eq!(touch(Vec2::new(10.0, 0.0), Vec2::new(3.0, 0.0)), None, "not yet");
        assert_eq!(touch(Vec2::new(10.0, 3.0), Vec2::new(-10.0, 3.0)), None, "past it");
        assert_eq!(touch(Vec2::new(3.0, 0.0), Vec2::new(30.0, 0.0)), None, "away from it");
        let grazing = touch(Vec2::new(8.0, 1.0), Vec2::new(-8.0, 1.0)).unwrap();
        assert!((grazing - Vec2::new(3f32.sqrt() / 2.0, 0.5)).length() < 1e-5, "{grazing}");
        assert_eq!(touch(Vec2::new(1.9, 0.0), Vec2::new(-5.0, 0.0)), Some(Vec2::X), "it overlaps, and crosses");
        assert_eq!(touch(Vec2::new(1.9, 0.0), Vec2::new(1.2, 0.0)), None, "it overlaps, and stays on its side");
    }

    fn stop_at(shape: SharedShape, from: Vec2, to: Vec2) -> Option<Stop> {
        first_stop(&Obstacle::new(shape, Pose::IDENTITY), [from, to], 0.5, |_| true)
    }

    #[test]
    fn a_disc_stops_at_every_kind_of_shape_however_thin() {
        let thin = Vec2::new(0.01, 4.0);
        let shapes = [
            SharedShape::cuboid(thin.x, thin.y),
            SharedShape::segment(Vec2::new(0.0, -4.0), Vec2::new(0.0, 4.0)),
            SharedShape::ball(0.05),
            SharedShape::capsule(Vec2::new(0.0, -4.0), Vec2::new(0.0, 4.0), 0.01),
            SharedShape::convex_hull(&[-thin, thin, Vec2::new(thin.x, -thin.y), Vec2::new(-thin.x, thin.y)]).unwrap(),
            SharedShape::polyline(vec![Vec2::new(0.0, -4.0), Vec2::new(0.0, 1.0), Vec2::new(0.0, 4.0)], None),
        ];
        for shape in shapes {
            for [from, to] in [[-20.0, 30.0], [9.0, -7.0]] {
                let stop = stop_at(shape.clone(), Vec2::new(from, 0.0), Vec2::new(to, 0.0));
                let Stop { away, depth, .. } = stop.unwrap_or_else(|| panic!("{:?}", shape.shape_type()));
                let end = to + away.x * depth;
                assert!(away.x * from > 0.99 * from.abs(), "{:?}: {away}", shape.shape_type());
                assert!(end * from > 0.0 && end.abs() < 0.56, "{:?}: {end}", shape.shape_type());
            }
        }
    }

    #[test]
    fn a_disc_on_the_floor_slides_until_something_stands_in_its_way() {
        let parts = [(Vec2::new(0.0, -1.0), 20.0, 1.0), (Vec2::new(5.0, 1.0), 0.01, 1.0)];
        let part = |(at, x, y): (Vec2, f32, f32)| (Pose::translation(at.x, at.y), SharedShape::cuboid(x, y));
        let shape = SharedShape::compound(parts.map(part).to_vec());
        let (from, to) = (Vec2::new(-5.0, 0.5), Vec2::new(15.0, 0.4));
        let floor = stop_at(shape.clone(), from, to).unwrap();
        assert!(floor.away.y > 0.99 && (floor.depth - 0.1).abs() < 1e-5, "{floor:?}");
        let post = stop_at(shape, from, to + floor.away * floor.depth).unwrap();
        assert!(post.away.x < -0.99 && (post.depth - 10.51).abs() < 1e-3, "{post:?}");
    }

    #[test]
    fn what_begins_inside_and_what_passes_by_is_not_stopped() {
        assert!(stop_at(SharedShape::ball(1.0), Vec2::ZERO, Vec2::new(9.0, 0.0)).is_none());
        assert!(stop_at(SharedShape::ball(1.0), Vec2::new(-9.0, 1.6), Vec2::new(9.0, 1.6)).is_none());
        assert!(stop_at(SharedShape::ball(1.0), Vec2::new(-9.0, 0.0), Vec2::new(-2.0, 0.0)).is_none());
    }
}
