//! What makes the outline of one body differ from that of another of its kind: size, waves, tails, bites, spikes. All of it hangs on
//! the body's seed. Shares and spreads are those of red cells in stained smears.

use super::polar_outline::PolarOutline;
use crate::geometry::{rotate, unit_vector};
use crate::look::OutlineLook;
use crate::microscope::maths::{bell, larger};
use crate::microscope::noise::HashRng;
use glam::Vec2;
use std::f32::consts::TAU;

/// Highest order of the waves around an outline.
const ORDERS: usize = 12;
/// Most tails, bites and spikes of a body together.
const MOST_BUMPS: usize = 12;

/// A bump of an outline: direction, height in radii, width in radians.
type Bump = (Vec2, f32, f32);

/// Gives an outline its own size, waves, tail, bites and spikes, which turn with the body.
pub(super) fn reshape(polar: &mut PolarOutline, facing: Vec2, look: &OutlineLook, rng: &mut HashRng) {
    if look.waves[0] <= 0.0 {
        return;
    }
    let size = look.median * libm::expf(look.size * rng.normal());
    let is_oval = rng.unit() < look.ovals;
    let mut wave = |k: usize| {
        let order = (k + 2) as f32;
        let decay = if k == 0 { look.waves[0] } else { look.waves[1] * libm::powf(3.0 / order, look.decay) };
        let oval = if k == 0 && is_oval { rng.range([0.10, 0.20]) } else { 0.0 };
        unit_vector(TAU * rng.unit()) * larger(oval, decay * libm::expf(look.spread * rng.normal()))
    };
    let waves: [Vec2; ORDERS - 1] = std::array::from_fn(&mut wave);
    let bumps = bumps(look, rng);
    let back = Vec2::new(facing.x, -facing.y);
    polar.reshape(|direction| {
        let own = rotate(direction, back);
        let mut turned = own;
        let mut factor = 1.0;
        for wave in waves {
            turned = rotate(turned, own);
            factor += wave.dot(turned);
        }
        for &(at, height, width) in &bumps {
            factor += height * bell((own - at).length() / width);
        }
        size * larger(factor, 0.3)
    });
}

fn bumps(look: &OutlineLook, rng: &mut HashRng) -> Vec<Bump> {
    let mut bumps = Vec::new();
    if rng.unit() < look.tails {
        bumps.push((rng.direction(), rng.range([0.35, 0.85]), rng.range([0.18, 0.34])));
    }
    if rng.unit() < look.bites {
        let width = rng.range([0.12, 0.30]);
        bumps.push((rng.direction(), -0.6 * width, width));
    }
    let [fewest, most] = look.spikes;
    let count = (fewest + rng.bits() % (most - fewest + 1)) as usize;
    bumps.extend(
        (0..count.min(MOST_BUMPS)).map(|_| (rng.direction(), rng.range([0.05, 0.22]), rng.range([0.10, 0.25]))),
    );
    bumps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_of_individuals_differ_and_keep_a_radius() {
        let look = OutlineLook { size: 0.1, spikes: [2, 6], tails: 0.5, bites: 0.5, ..OutlineLook::uneven(0.1) };
        let radii = |seed| {
            let mut polar = PolarOutline::disc(Vec2::ZERO, 1.0).unwrap();
            reshape(&mut polar, Vec2::X, &look, &mut HashRng::new(seed));
            (0..32).map(|k| polar.radius(unit_vector(TAU * k as f32 / 32.0))).collect::<Vec<_>>()
        };
        assert!((0..50).all(|seed| radii(seed).iter().all(|radius| (0.2..4.0).contains(radius))));
        assert!((0..50).all(|seed| radii(seed) == radii(seed) && radii(seed) != radii(seed + 1)));
    }
}
