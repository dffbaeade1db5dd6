//! Continuous collision detection: where a disc that moves farther than its own size in a substep meets something first.
//!
//! Such a disc may be beyond what it met when contacts are projected. The contact is that of the time of impact on a straight way, as of
//! a bullet in Box2D; the disc is moved back to the tangent there, with the other's share by mass.

use crate::collision::obstacle::Obstacle;
use crate::geometry::ring::direction_or;
use glam::Vec2;

/// A gap of this share of a disc's size is none.
const TOUCH: f32 = 0.002;
/// Share of its size by which a disc goes on along a surface that does not stop it: it stays outside.
const SLIDE: f32 = 0.5;
/// Smallest size of a disc in a search, units: a point's.
const SMALLEST: f32 = 0.02;
/// Most places that are looked at on the way of a disc.
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
    let approach = start.dot(way);
    if start.length_squared() <= radius_sum * radius_sum {
        let has_crossed = start.dot(between) < 0.0;
        return has_crossed.then(|| direction_or(start, -direction_or(way, Vec2::X)));
    }
    // |start + t way| = radius_sum, its first root; the miss distance times the way keeps its digits on any way.
    let (way_squared, miss) = (way.length_squared(), start.perp_dot(way));
    let root = radius_sum * radius_sum * way_squared - miss * miss;
    if approach >= 0.0 || root < 0.0 {
        return None;
    }
    let t = -(approach + root.sqrt()) / way_squared;
    (t <= 1.0).then(|| direction_or(start + way * t, -direction_or(way, Vec2::X)))
}

/// The first surface of an obstacle that stops a disc on a straight way, if it is outside at first. `holds` says by a direction out
/// of the surface whether the surface is solid there. A disc that comes past too many surfaces is stopped where it got to.
pub(crate) fn first_stop(
    obstacle: &Obstacle,
    [from, to]: [Vec2; 2],
    radius: f32,
    holds: impl Fn(Vec2) -> bool,
) -> Option<Stop> {
    let size = if radius > SMALLEST { radius } else { SMALLEST };
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
        let (away, gap) = ((at - surface) / distance, distance - radius);
        let depth = radius - (to - surface).dot(away);
        let stops = depth > 0.0 && along.dot(away) < 0.0 && holds(away);
        if stops && gap < TOUCH * size {
            return Some(Stop { away, depth, has_passed: true });
        }
        // No surface is nearer than the nearest one: it is safe to go on almost as far.
        gone += if stops { gap - 0.5 * TOUCH * size } else { slide(gap, distance, size) };
        if gone >= length {
            return None;
        }
    }
    Some(Stop { away: -along, depth: length - gone, has_passed: true })
}

/// How far a disc goes on where nothing stops it.
fn slide(gap: f32, distance: f32, size: f32) -> f32 {
    let longest = SLIDE * size;
    let half = 0.5 * distance;
    if gap > longest {
        gap
    } else if half > longest {
        longest
    } else if half > 0.1 * size {
        half
    } else {
        0.1 * size
    }
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

    #[test]
    fn a_long_way_and_a_point_lose_no_digits() {
        for (aside, meets) in [(0.009, true), (0.011, false)] {
            let way = Vec2::new(-1000.0, 0.0);
            let normal = first_touch(Vec2::new(400.0, aside) + way, way, 0.01);
            assert_eq!(normal.is_some(), meets, "{aside}");
            assert!(normal.is_none_or(|normal| (normal.y - 0.9).abs() < 0.01 && normal.is_normalized()), "{normal:?}");
        }
        assert_eq!(first_touch(Vec2::splat(-2.0), Vec2::splat(-5.0), 0.0), Some(Vec2::splat(0.5f32.sqrt())));
        assert_eq!(first_touch(Vec2::ZERO, Vec2::ZERO, 0.0), None);
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
            for ([from, to], radius) in [([-20.0, 30.0], 0.5), ([9.0, -7.0], 0.5), ([-20.0, 30.0], 0.0)] {
                let obstacle = Obstacle::new(shape.clone(), Pose::IDENTITY);
                let stop = first_stop(&obstacle, [from, to].map(|x| Vec2::new(x, 0.0)), radius, |_| true);
                let Stop { away, depth, .. } = stop.unwrap_or_else(|| panic!("{:?}", shape.shape_type()));
                let end = to + away.x * depth;
                assert!(away.x * from > 0.99 * from.abs(), "{:?}: {away}", shape.shape_type());
                assert!(end * from >= 0.0 && end.abs() < radius + 0.06, "{:?}: {end}", shape.shape_type());
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
        assert!(stop_at(SharedShape::ball(1.0), Vec2::new(-9.0, 1.51), Vec2::new(9.0, 1.51)).is_none());
        assert!(stop_at(SharedShape::ball(1.0), Vec2::new(-9.0, 1.49), Vec2::new(9.0, 1.49)).is_some());
        assert!(stop_at(SharedShape::ball(1.0), Vec2::ZERO, Vec2::new(9.0, 0.0)).is_none());
        assert!(stop_at(SharedShape::ball(1.0), Vec2::new(-9.0, 1.6), Vec2::new(9.0, 1.6)).is_none());
        assert!(stop_at(SharedShape::ball(1.0), Vec2::new(-9.0, 0.0), Vec2::new(-2.0, 0.0)).is_none());
    }

    #[test]
    fn where_nothing_stops_it_a_disc_goes_on_by_the_gap_or_by_a_share_of_its_size() {
        for (gap, distance, way) in [(0.7, 1.7, 0.7), (0.4, 1.4, 0.5), (0.2, 0.6, 0.3), (0.0, 0.1, 0.1)] {
            for size in [1.0, 2.0] {
                assert_eq!(slide(size * gap, size * distance, size), size * way, "a gap of {gap} at {distance}");
            }
        }
    }

    #[test]
    fn a_disc_that_comes_past_too_many_surfaces_is_stopped_where_it_got_to() {
        let obstacle = Obstacle::new(SharedShape::cuboid(500.0, 1.0), Pose::translation(0.0, -1.0));
        let way = [Vec2::new(-100.0, 0.5), Vec2::new(100.0, 0.5)];
        let Stop { away, depth, has_passed } = first_stop(&obstacle, way, 0.5, |_| false).unwrap();
        assert!(away.x < -0.99 && depth > 100.0 && depth < 180.0 && has_passed, "{away}, {depth}");
    }
}
