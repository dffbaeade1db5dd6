//! How a red cell lies on the slide: flat, tilted, or nearly on edge. What lies over others is never quite flat.

use crate::microscope::maths::{larger, smoothstep};
use crate::microscope::noise::HashRng;
use glam::{Mat2, Vec2};

/// Shares of the cells that touch the glass which are tilted and which stand nearly on edge.
const TILTED: f32 = 0.18;
const STEEP: f32 = 0.025;
/// Standard deviation of the tilt of the others, radians.
const UNEVEN: f32 = 0.12;
/// Tilt of tilted cells, and of steep ones, radians: a disc that stands up is as wide as it is thick.
const TILT: [f32; 2] = [0.35, 0.80];
const STAND: [f32; 2] = [0.95, 1.12];

/// The tilt of a disc, in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    /// Unit vector across the axis about which it is tilted.
    across: Vec2,
    cosine: f32,
    sine: f32,
}

impl Pose {
    /// Of a cell that lies in a tier of the slide.
    pub(super) fn of(tier: Option<u32>, rng: &mut HashRng) -> Self {
        let kind = rng.unit() * if tier.unwrap_or(0) > 0 { 2.0 * TILTED } else { 1.0 };
        let angle = if kind < STEEP {
            rng.range(STAND)
        } else if kind < STEEP + TILTED {
            rng.range(TILT)
        } else {
            UNEVEN * rng.normal().abs()
        };
        Self { across: rng.direction(), cosine: libm::cosf(angle), sine: libm::sinf(angle) }
    }

    /// By how much its outline reaches less far in a direction of its own frame. One that stands up has straight sides.
    pub(super) fn foreshortening(&self, own: Vec2) -> f32 {
        let across = own.dot(self.across) / self.cosine;
        let (along, across) = (1.0 - own.dot(self.across) * own.dot(self.across), across * across);
        let round = 1.0 / (along + across).sqrt();
        let straight = 1.0 / (along * along + across * across).sqrt().sqrt();
        round + (straight - round) * (0.45 * self.steepness())
    }

    /// From its frame to that of its face, in which it is as wide as long.
    pub(super) fn to_face(self) -> Mat2 {
        let Vec2 { x, y } = self.across;
        let more = 1.0 / self.cosine - 1.0;
        Mat2::from_cols(Vec2::new(1.0 + more * x * x, more * x * y), Vec2::new(more * x * y, 1.0 + more * y * y))
    }

    /// Where the middle of its hollow appears to be: the near wall hides a part.
    pub(super) fn hollow(self) -> Vec2 {
        self.across * (0.30 * self.sine)
    }

    /// How much more there is in the light's way.
    pub(super) fn thickness(&self) -> f32 {
        1.0 / larger(self.cosine, 0.75)
    }

    /// How much it stands up, 0 to 1: then its hollow is not seen.
    pub(super) fn steepness(&self) -> f32 {
        smoothstep(0.75, 0.45, self.cosine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::unit_vector;
    use std::f32::consts::TAU;

    /// Length over width of the outlines of many cells, ascending.
    fn aspects(tier: Option<u32>) -> Vec<f32> {
        let aspect = |seed| {
            let pose = Pose::of(tier, &mut HashRng::new(seed));
            let reach = (0..64).map(|k| pose.foreshortening(unit_vector(TAU * k as f32 / 64.0)));
            let (least, most) = reach.fold((9.0_f32, 0.0_f32), |(low, high), r| (low.min(r), high.max(r)));
            most / least
        };
        let mut aspects: Vec<f32> = (0..1000).map(aspect).collect();
        aspects.sort_by(f32::total_cmp);
        aspects
    }

    #[test]
    fn most_cells_lie_flat_and_those_over_others_do_not() {
        let (glass, above) = (aspects(Some(0)), aspects(Some(1)));
        assert!(glass[500] < 1.03 && (1.1..1.6).contains(&glass[900]), "{} {}", glass[500], glass[900]);
        assert!(above[500] > 1.07 && *above.last().unwrap() < 2.5, "{}", above[500]);
        assert_eq!(aspects(None), glass);
    }

    #[test]
    fn a_face_is_a_disc_again() {
        let pose = Pose { across: Vec2::new(0.6, 0.8), cosine: 0.8, sine: 0.6 };
        for k in 0..16 {
            let own = unit_vector(TAU * k as f32 / 16.0);
            assert!(((pose.to_face() * (own * pose.foreshortening(own))).length() - 1.0).abs() < 1e-5);
        }
    }
}
