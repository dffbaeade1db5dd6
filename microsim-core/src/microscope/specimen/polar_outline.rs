//! An outline as a table of radii around a centre.

use crate::geometry::{centroid, signed_area};
use crate::microscope::maths::{larger, smaller};
use glam::Vec2;

/// Directions in a table of radii.
const DIRECTIONS: usize = 128;

/// A body seen from its centre: how far it reaches in every direction.
#[derive(Clone, Debug)]
pub(super) struct PolarOutline {
    pub centre: Vec2,
    /// Radius of the disc of equal area.
    pub mean: f32,
    pub farthest: f32,
    radii: Vec<f32>,
}

impl PolarOutline {
    /// Around the centroid of an outline; nothing if it encloses no area.
    pub(super) fn around(outline: &[Vec2]) -> Option<Self> {
        let centre = centroid(outline)?;
        let mean = (signed_area(outline).abs() / std::f32::consts::PI).sqrt();
        Some(Self::new(centre, mean, reaches(outline, centre))).filter(|polar| mean > 0.0 && polar.farthest.is_finite())
    }

    pub(super) fn disc(centre: Vec2, radius: f32) -> Option<Self> {
        let is_sound = radius > 0.0 && radius.is_finite() && centre.is_finite();
        is_sound.then(|| Self::new(centre, radius, vec![radius; DIRECTIONS]))
    }

    fn new(centre: Vec2, mean: f32, radii: Vec<f32>) -> Self {
        let radii: Vec<f32> = radii.into_iter().map(|radius| larger(radius, 0.05 * mean)).collect();
        let farthest = radii.iter().copied().fold(0.0, larger);
        Self { centre, mean, farthest, radii }
    }

    /// Changes the radius in every direction.
    pub(super) fn reshape(&mut self, factor: impl Fn(Vec2) -> f32) {
        for (k, radius) in self.radii.iter_mut().enumerate() {
            *radius *= factor(direction(k).normalize());
        }
        self.farthest = self.radii.iter().copied().fold(0.0, larger);
    }

    /// Radius in the a direction.
    pub(super) fn radius(&self, direction: Vec2) -> f32 {
        let at = diamond_angle(direction) * (DIRECTIONS as f32 / 4.0);
        let k = at as usize;
        let (a, b) = (self.radii[k % DIRECTIONS], self.radii[(k + 1) % DIRECTIONS]);
        a + (b - a) * (at - k as f32)
    }
}

/// Angle of a vector, 0 to 4 counter-clockwise from +x, growing evenly along a square instead of a circle.
fn diamond_angle(v: Vec2) -> f32 {
    let sum = v.x.abs() + v.y.abs();
    if sum <= 0.0 || !sum.is_finite() {
        return 0.0;
    }
    let share = v / sum;
    match (share.x >= 0.0, share.y >= 0.0) {
        (true, true) => share.y,
        (false, true) => 1.0 - share.x,
        (false, false) => 2.0 - share.y,
        (true, false) => 3.0 + share.x,
    }
}

/// The direction of entry `k` of a table.
fn direction(k: usize) -> Vec2 {
    let at = k as f32 * 4.0 / DIRECTIONS as f32;
    let share = at - at.floor();
    match k * 4 / DIRECTIONS {
        0 => Vec2::new(1.0 - share, share),
        1 => Vec2::new(-share, 1.0 - share),
        2 => Vec2::new(share - 1.0, -share),
        _ => Vec2::new(share, share - 1.0),
    }
}

/// How far an outline reaches from a point in each direction; 0 where it does not.
fn reaches(outline: &[Vec2], from: Vec2) -> Vec<f32> {
    let directions: Vec<Vec2> = (0..DIRECTIONS).map(|k| direction(k).normalize()).collect();
    let mut reaches = vec![0.0; DIRECTIONS];
    for (k, &corner) in outline.iter().enumerate() {
        let (a, b) = (corner - from, outline[(k + 1) % outline.len()] - from);
        for at in between(a, b) {
            reaches[at] = larger(reaches[at], crossing(a, b, directions[at]));
        }
    }
    reaches
}

/// Directions that may cross a side from `a` to `b`, seen from the origin: those between its ends, and one more each.
fn between(a: Vec2, b: Vec2) -> impl Iterator<Item = usize> {
    let [start, end] = [a, b].map(|end| diamond_angle(end) * (DIRECTIONS as f32 / 4.0));
    let turn = DIRECTIONS as f32;
    let turned = end - start;
    // The shorter way round, but where the side passes so near that either may be.
    let turned = if turned > 0.5 * turn {
        turned - turn
    } else if turned < -0.5 * turn {
        turned + turn
    } else {
        turned
    };
    let (low, high) =
        (smaller(start, start + turned).floor() as i32 - 1, larger(start, start + turned).ceil() as i32 + 1);
    let all = turned.abs() > 0.45 * turn || !turned.is_finite();
    let (low, high) = if all { (0, DIRECTIONS as i32 - 1) } else { (low, high) };
    (low..=high).map(|at| at.rem_euclid(DIRECTIONS as i32) as usize)
}

/// How far from the origin a side from `a` to `b` is crossed in a direction; 0 if it is not.
fn crossing(a: Vec2, b: Vec2, direction: Vec2) -> f32 {
    let (side_a, side_b) = (direction.perp_dot(a), direction.perp_dot(b));
    if (side_a < 0.0) == (side_b < 0.0) {
        return 0.0;
    }
    (a + (b - a) * (side_a / (side_a - side_b))).dot(direction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ellipse;
    use crate::microscope::noise::HashRng;

    #[test]
    fn a_table_of_radii_knows_its_outline() {
        let outline: Vec<Vec2> = ellipse(Vec2::new(6.0, 2.0), 200).iter().map(|p| *p + Vec2::new(5.0, -3.0)).collect();
        let polar = PolarOutline::around(&outline).unwrap();
        assert!((polar.centre - Vec2::new(5.0, -3.0)).length() < 1e-3 && (polar.mean - 12_f32.sqrt()).abs() < 0.01);
        for (direction, radius) in [(Vec2::X, 6.0), (Vec2::NEG_X, 6.0), (Vec2::Y, 2.0), (Vec2::NEG_Y, 2.0)] {
            assert!((polar.radius(direction) - radius).abs() < 0.02, "{direction}: {}", polar.radius(direction));
        }
        assert!(
            outline.iter().all(|&p| (polar.radius(p - polar.centre) / (p - polar.centre).length() - 1.0).abs() < 0.02)
        );
        assert!(
            PolarOutline::around(&[Vec2::ZERO, Vec2::ONE, Vec2::X * f32::NAN]).is_none()
                && PolarOutline::around(&[]).is_none()
        );
    }

    #[test]
    fn no_side_is_overlooked() {
        let mut rng = HashRng::new(5);
        for _ in 0..50 {
            // Any shape, with the centre inside, outside and on its edge.
            let outline: Vec<Vec2> =
                (0..9).map(|_| Vec2::new(rng.range([-3.0, 3.0]), rng.range([-3.0, 3.0]))).collect();
            for from in [Vec2::ZERO, outline[0], 0.5 * (outline[0] + outline[1]), Vec2::splat(4.0)] {
                let of_all = |k: usize| {
                    let sides = (0..9).map(|side| (outline[side] - from, outline[(side + 1) % 9] - from));
                    sides.map(|(a, b)| crossing(a, b, direction(k).normalize())).fold(0.0, larger)
                };
                let expected: Vec<f32> = (0..DIRECTIONS).map(of_all).collect();
                assert_eq!(reaches(&outline, from), expected, "{outline:?} from {from}");
            }
        }
    }
}
