//! The way of a kinematic obstacle through a step: a straight line, and a turn at a nearly constant rate.

use super::obstacle::Obstacle;
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};
use parry2d::math::{Pose, Rot2};

/// Of a quarter turn by interpolation and normalisation, the largest angular speed over the chord.
const TURN_SPEED: f32 = 1.5;
/// A share of the way this near to its end is all of it.
const ROUNDING: f32 = 1e-6;

/// An obstacle that moves in this step, and how far it has come.
#[derive(Clone, Debug)]
pub(crate) struct ObstaclePath {
    /// Its index among all obstacles.
    pub obstacle: u32,
    /// Whether it had to move back.
    pub is_blocked: bool,
    /// Whether it stops as soon as it has to move back.
    stops: bool,
    from: Pose,
    to: Pose,
    /// Longest way of a point of it in the step, units.
    margin: f32,
    /// Share of the way in a substep.
    rate: f32,
    /// Share of the way done when the substep began, and at its end.
    start: f32,
    end: f32,
    /// How far it has to move back as a share of the way.
    back: f32,
}

impl ObstaclePath {
    /// The way to a pose, or as much of it as no point of the obstacle exceeds `longest` units on.
    pub(crate) fn new(index: u32, obstacle: &Obstacle, to: Pose, longest: f32, substeps: u32) -> Self {
        let from = obstacle.pose;
        let whole = farthest(obstacle, &from, &to);
        let share = if whole > longest { longest / whole } else { 1.0 };
        Self {
            obstacle: index,
            is_blocked: false,
            stops: obstacle.motion == super::obstacle::ObstacleMotion::Stop,
            from,
            to,
            margin: whole * share,
            rate: share / substeps as f32,
            start: 0.0,
            end: 0.0,
            back: 0.0,
        }
    }

    /// Box around all places that the obstacle can get to in the step, if it has not moved yet.
    pub(crate) fn aabb(&self, obstacle: &Obstacle) -> Aabb {
        obstacle.shape.compute_aabb(&self.from).loosened(self.margin)
    }

    /// Where the obstacle is at the end of the substep.
    pub(crate) fn pose(&self) -> Pose {
        if self.is_done() {
            return self.to;
        }
        Pose::from_parts(
            self.from.translation + (self.to.translation - self.from.translation) * self.end,
            self.turn(self.end),
        )
    }

    /// Whether it is at its target.
    pub(crate) fn is_done(&self) -> bool {
        self.end >= 1.0 - ROUNDING
    }

    /// Begins a substep.
    pub(crate) fn advance(&mut self) {
        self.end -= self.back;
        self.start = self.end;
        self.back = 0.0;
        if !(self.stops && self.is_blocked) {
            self.end += self.rate;
        }
    }

    /// Ends the step.
    pub(crate) fn finish(&mut self) {
        self.end -= self.back;
        self.back = 0.0;
    }

    /// How far the surface at a point has come in the substep.
    pub(crate) fn displacement(&self, point: Vec2) -> Vec2 {
        let way = (self.to.translation - self.from.translation) * (self.end - self.start);
        let (now, before) = (self.turn(self.end), self.turn(self.start));
        if now.re == before.re && now.im == before.im {
            return way;
        }
        let (local, re, im) = (self.pose().inverse_transform_point(point), now.re - before.re, now.im - before.im);
        way + Vec2::new(re * local.x - im * local.y, im * local.x + re * local.y)
    }

    /// Notes that it has to move back from something by `depth`, where its surface came as far as `displacement` along the way
    /// out, `away`. It does not move back farther than it came in the substep.
    pub(crate) fn give_way(&mut self, depth: f32, displacement: Vec2, away: Vec2) {
        let pushed = displacement.dot(away);
        if depth > 0.0 && pushed > 0.0 {
            let share = if depth < pushed { depth / pushed } else { 1.0 };
            let back = share * (self.end - self.start);
            self.back = if back > self.back { back } else { self.back };
            self.is_blocked = true;
        }
    }

    /// Rotation after a share of the way: interpolated and normalised, which needs no trigonometry.
    fn turn(&self, share: f32) -> Rot2 {
        let (a, b) = (self.from.rotation, self.to.rotation);
        if a.re == b.re && a.im == b.im {
            return a;
        }
        let (re, im) = (a.re + (b.re - a.re) * share, a.im + (b.im - a.im) * share);
        let length = (re * re + im * im).sqrt();
        Rot2::from_cos_sin_unchecked(re / length, im / length)
    }
}

/// The path of an obstacle, if it moves in this step; paths are in the order of their obstacles.
pub(crate) fn path_of(paths: &mut [ObstaclePath], obstacle: u32) -> Option<&mut ObstaclePath> {
    let at = paths.binary_search_by_key(&obstacle, |path| path.obstacle).ok()?;
    Some(&mut paths[at])
}

/// At least how far a point of the obstacle is from its origin.
pub(crate) fn extent(obstacle: &Obstacle) -> f32 {
    let bounds = obstacle.shape.compute_local_aabb();
    bounds.mins.abs().max(bounds.maxs.abs()).length()
}

/// At least the longest way of a point of the obstacle between two poses, if its speed were constant.
fn farthest(obstacle: &Obstacle, from: &Pose, to: &Pose) -> f32 {
    let (a, b) = (from.rotation, to.rotation);
    let chord = Vec2::new(b.re - a.re, b.im - a.im).length();
    let way = (to.translation - from.translation).length();
    // A shape without an end is moved but not turned.
    if chord == 0.0 { way } else { way + TURN_SPEED * chord * extent(obstacle) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use parry2d::shape::SharedShape;

    fn bar() -> Obstacle {
        Obstacle::new(SharedShape::cuboid(2.0, 0.5), Pose::translation(10.0, 5.0))
    }

    #[test]
    fn a_path_is_linear_and_ends_at_the_target_to_the_bit() {
        let to = Pose::new(Vec2::new(10.3, 5.1), 0.05);
        let mut path = ObstaclePath::new(0, &bar(), to, 1.0, 6);
        for k in 1..=6 {
            path.advance();
            let expected = Vec2::new(10.0, 5.0) + Vec2::new(0.3, 0.1) * k as f32 / 6.0;
            assert!((path.pose().translation - expected).length() < 1e-5);
            let tip = path.pose().transform_point(Vec2::new(2.0, 0.0));
            assert!((path.displacement(tip) - Vec2::new(0.05, 0.0333)).length() < 1e-3, "{}", path.displacement(tip));
        }
        assert!(path.is_done());
        assert_eq!((path.pose().translation, path.pose().rotation.im), (to.translation, to.rotation.im));
    }

    #[test]
    fn no_point_goes_farther_than_the_limit() {
        for to in
            [Pose::translation(14.0, 5.0), Pose::new(Vec2::new(10.0, 5.0), 1.5), Pose::new(Vec2::new(7.0, 4.0), -1.0)]
        {
            let mut path = ObstaclePath::new(0, &bar(), to, 0.5, 8);
            let corner = |pose: Pose| pose.transform_point(Vec2::new(2.0, 0.5));
            let start = corner(path.pose());
            let mut longest: f32 = 0.0;
            for _ in 0..8 {
                let before = corner(path.pose());
                path.advance();
                longest = longest.max((corner(path.pose()) - before).length());
            }
            let way = (corner(path.pose()) - start).length();
            assert!(!path.is_done() && longest <= 0.5 / 8.0 && way > 0.2, "{longest} {way}");
            assert!(path.aabb(&bar()).contains_local_point(corner(path.pose())));
        }
    }

    #[test]
    fn it_moves_back_by_what_is_in_the_way_and_no_farther_than_it_came() {
        let mut path = ObstaclePath::new(0, &bar(), Pose::translation(10.8, 5.0), 1.0, 8);
        path.advance();
        let way = path.displacement(Vec2::new(12.0, 5.0));
        path.give_way(0.04, way, Vec2::X);
        path.give_way(0.02, way, Vec2::X);
        path.advance();
        assert!((path.pose().translation.x - 10.16).abs() < 1e-5, "{}", path.pose().translation);
        path.give_way(5.0, way, Vec2::X);
        path.give_way(5.0, way, Vec2::NEG_X);
        path.finish();
        assert!((path.pose().translation.x - 10.06).abs() < 1e-5 && path.is_blocked);
    }

    #[test]
    fn a_point_of_a_surface_that_turns_comes_as_far_as_its_poses_say() {
        let mut path = ObstaclePath::new(0, &bar(), Pose::new(Vec2::new(10.5, 5.2), 1.4), 100.0, 4);
        let local = Vec2::new(1.5, -0.4);
        for _ in 0..4 {
            let before = path.pose();
            path.advance();
            let (now, point) = (path.pose(), path.pose().transform_point(local));
            let way = point - before.transform_point(local);
            assert!((path.displacement(point) - way).length() < 1e-5, "{way}, not {}", path.displacement(point));
            assert!((Vec2::new(now.rotation.re, now.rotation.im).length() - 1.0).abs() < 1e-6, "{now:?}");
        }
    }
}
