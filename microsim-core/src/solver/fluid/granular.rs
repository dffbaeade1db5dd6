//! Grains: particles that keep from overlapping, with Coulomb friction. Contacts are averaged, friction moves both along the
//! contact by at most `mu` times the overlap (Macklin et al. 2014, "Unified Particle Physics", sections 4.1 and 6.1). Averages
//! are not over-relaxed: where velocities follow from positions, that makes energy. Both sides of a contact take the share of
//! the one that touches more, so that what one gains the other loses. Lengths are in units of the spacing.

use super::neighbours::{Group, Lanes, Neighbour, distance, positive};
use crate::instruction_set::each;
use crate::solver::lanes::LANES;

/// Keeps a slip of 0 from having no direction.
const LEAST_SLIP: f32 = 1e-12;

/// First pass: the share of each contact that is corrected, one over the number of contacts.
#[inline(always)]
pub(super) fn shares(group: &Group, neighbours: &[Neighbour]) -> Lanes {
    let (x, y) = (group.load(neighbours, |s| s.x), group.load(neighbours, |s| s.y));
    let mut count = [0.0; LANES];
    for window in group.windows(neighbours) {
        for other in window {
            for l in 0..LANES {
                count[l] += if distance(x[l] - other.x, y[l] - other.y) < 1.0 { 1.0 } else { 0.0 };
            }
        }
    }
    // Each one counts itself, too.
    each(|l| if count[l] > 2.0 { 1.0 / (count[l] - 1.0) } else { 1.0 })
}

/// Second pass: how far a group's members are moved: out of each other, by friction, and by viscosity towards the displacements
/// of those they touch. Where nothing needs to conserve momentum, `keeps_momentum` is false, and grains settle sooner.
#[inline(always)]
pub(super) fn shifts(
    group: &Group,
    neighbours: &[Neighbour],
    [viscosity, mu]: [f32; 2],
    keeps_momentum: bool,
) -> [Lanes; 2] {
    let own = group.load(neighbours, |s| s.multiplier);
    let (x, y) = (group.load(neighbours, |s| s.x), group.load(neighbours, |s| s.y));
    let (moved_x, moved_y) = (group.load(neighbours, |s| s.moved_x), group.load(neighbours, |s| s.moved_y));
    let [mut shift_x, mut shift_y] = [[0.0; LANES]; 2];
    for window in group.windows(neighbours) {
        for other in window {
            for l in 0..LANES {
                let (dx, dy) = (x[l] - other.x, y[l] - other.y);
                let r = distance(dx, dy);
                let overlap = positive(1.0 - r);
                let (normal_x, normal_y) = (dx / r, dy / r);
                let (slip_x, slip_y) = (moved_x[l] - other.moved_x, moved_y[l] - other.moved_y);
                let slip = slip_y * normal_x - slip_x * normal_y;
                let size = if slip > 0.0 { slip } else { -slip };
                let most = mu * overlap;
                let rub = 0.5 * slip * if size > most { most / (size + LEAST_SLIP) } else { 1.0 };
                let share = if keeps_momentum && other.multiplier < own[l] { other.multiplier } else { own[l] };
                let share = if r < 1.0 { share } else { 0.0 };
                let drag = viscosity * share / (1.0 + share);
                shift_x[l] += share * (0.5 * overlap * normal_x + rub * normal_y) - drag * slip_x;
                shift_y[l] += share * (0.5 * overlap * normal_y - rub * normal_x) - drag * slip_y;
            }
        }
    }
    [shift_x, shift_y]
}
