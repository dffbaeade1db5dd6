//! The hollow of a red cell. Shares and spreads are those of stained smears.

use super::pose::Pose;
use crate::microscope::maths::{larger, mix};
use crate::microscope::noise::HashRng;
use glam::{Mat2, Vec2};

/// Shares of red cells without a hollow, with a hollow that is a slit, and with a knob in it (targets).
const FLAT: f32 = 0.13;
const SLIT: f32 = 0.05;
const TARGET: f32 = 0.05;
/// Inverse square of the radius of that knob, in radii of the hollow.
pub(super) const KNOB: f32 = 6.0;

/// The hollow of a red cell. In the living cell it is part of the biconcave disc; when the cell dries on the glass, its
/// edge spreads and its middle sinks in, each in its own way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hollow {
    /// From the body's frame, in radii, to that of the hollow, in which it has the radius 1; where the centre goes.
    to_hollow: Mat2,
    pub centre: Vec2,
    /// Square of its radius, in the body's.
    pub area: f32,
    /// How a dried cell looks: how sharp and how steep its edge is, how deep and how flat its hollow, 0 to 1; the depth is
    /// negative where there is a knob in it.
    pub dried: [f32; 4],
}

impl Hollow {
    /// None.
    pub(super) const NONE: Self = Self { to_hollow: Mat2::IDENTITY, centre: Vec2::ZERO, area: 1.0, dried: [0.0; 4] };

    pub(super) fn of(pose: Pose, pale: f32, rng: &mut HashRng) -> Self {
        let kind = rng.unit();
        let (is_flat, is_slit) = (kind < FLAT, kind > 1.0 - SLIT);
        let is_target = (FLAT..FLAT + TARGET).contains(&kind);
        let radius = if is_slit { rng.range([0.24, 0.34]) } else { rng.range([0.30, 0.56]) + 0.24 * pale };
        let stretch = if is_slit { rng.range([1.35, 1.75]) } else { libm::expf(0.13 * rng.normal().abs()) };
        let direction = rng.direction();
        let turn = Mat2::from_cols(Vec2::new(direction.x, -direction.y), Vec2::new(direction.y, direction.x));
        let to_hollow = Mat2::from_diagonal(Vec2::new(1.0 / stretch, stretch) / radius) * turn;
        let at = rng.direction() * (0.13 * rng.normal()) + pose.hollow();
        let to_hollow = to_hollow * pose.to_face();
        let share = rng.unit();
        let depth = if is_flat {
            0.25 * share
        } else if is_slit {
            0.7 + 0.3 * share
        } else if is_target {
            -0.6 - 0.4 * share
        } else {
            // Of a pale slide most are deep.
            1.0 - (1.0 - share) * mix(1.0, (1.0 - share) * (1.0 - share), pale)
        };
        let dried = [rng.unit(), 0.8 * rng.unit(), depth * (1.0 - pose.steepness()), rng.range([0.4, 1.0])];
        Self { to_hollow, centre: to_hollow * at, area: radius * radius, dried }
    }

    /// A direction of the body's frame, in radii, in the hollow's.
    pub(super) fn turned(&self, own: Vec2) -> Vec2 {
        self.to_hollow * own
    }

    /// Thickness of the dried cell at a distance from its centre, in radii, and from that of the hollow; 1 without one.
    pub(super) fn dried(&self, rho: f32, from_hollow: Vec2) -> f32 {
        let [sharp, steep, depth, flat] = self.dried;
        let square = rho * rho;
        if square >= 1.0 {
            return 0.0;
        }
        let fourth = square * square;
        let inside = 1.0 - (fourth + sharp * (fourth * fourth - fourth));
        let edge = inside.sqrt();
        let apart = from_hollow.length_squared();
        let knob = if depth < 0.0 { libm::expf(-KNOB * apart) } else { 0.0 };
        let depth = depth.abs();
        let sunk = depth * (libm::expf(-(apart + flat * (apart * apart - apart))) - knob);
        let from_rim = (rho - 0.80) / 0.24;
        let bulge = larger(1.0 - from_rim * from_rim, 0.0);
        (edge + steep * (inside - edge)) * (1.0 - sunk) * (1.0 + 0.22 * depth * bulge * bulge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dried_cells_end_at_their_rim_and_differ_in_their_middle() {
        let flat = |rng: &mut HashRng| Hollow::of(Pose::of(None, rng), 1.0, rng);
        let hollows: Vec<Hollow> = (0..200).map(|seed| flat(&mut HashRng::new(seed))).collect();

        let middle = |hollow: &Hollow| hollow.dried(0.0, Vec2::ZERO);
        assert!(hollows.iter().all(|hollow| hollow.dried(1.0, Vec2::ONE) == 0.0));
        assert!(hollows.iter().all(|hollow| (0.0..=1.0).contains(&middle(hollow))));
        let pale = hollows.iter().filter(|hollow| middle(hollow) < 0.3).count();
        let full = hollows.iter().filter(|hollow| middle(hollow) > 0.75).count();
        assert!((40..160).contains(&pale) && (20..100).contains(&full), "{pale} {full}");
    }
}
