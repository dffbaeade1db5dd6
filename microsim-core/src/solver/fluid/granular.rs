//! Grains: particles that keep from overlapping, with Coulomb friction. Contacts are averaged, friction moves both along the
//! contact by at most `mu` times the overlap (Macklin et al. 2014, "Unified Particle Physics", sections 4.1 and 6.1). Averages
//! are not over-relaxed: where velocities follow from positions, that makes energy. Lengths are in units of the spacing.

use super::neighbours::{Group, Lanes, Neighbour, distance, positive};
use crate::instruction_set::each;
use crate::solver::lanes::LANES;

/// Keeps a slip of 0 from having no direction.
const LEAST_SLIP: f32 = 1e-12;

/// How far a group's members are moved: out of each other, by friction, and by viscosity towards the mean displacement of those
/// they touch.
#[inline(always)]
pub(super) fn shifts(group: &Group, neighbours: &[Neighbour], [viscosity, mu]: [f32; 2]) -> [Lanes; 2] {
    let (x, y) = (group.load(neighbours, |s| s.x), group.load(neighbours, |s| s.y));
    let (moved_x, moved_y) = (group.load(neighbours, |s| s.moved_x), group.load(neighbours, |s| s.moved_y));
    let [mut shift_x, mut shift_y, mut drift_x, mut drift_y, mut count] = [[0.0; LANES]; 5];
    for window in group.windows(neighbours) {
        for other in window {
            for l in 0..LANES {
                let (dx, dy) = (x[l] - other.x, y[l] - other.y);
                let r = distance(dx, dy);
                let overlap = positive(1.0 - r);
                let (normal_x, normal_y) = (dx / r, dy / r);
                let (slip_x, slip_y) = (moved_x[l] - other.moved_x, moved_y[l] - other.moved_y);
                let along = slip_y * normal_x - slip_x * normal_y;
                let size = if along > 0.0 { along } else { -along };
                let most = mu * overlap;
                let rub = 0.5 * along * if size > most { most / (size + LEAST_SLIP) } else { 1.0 };
                let touches = if r < 1.0 { 1.0 } else { 0.0 };
                shift_x[l] += 0.5 * overlap * normal_x + touches * rub * normal_y;
                shift_y[l] += 0.5 * overlap * normal_y - touches * rub * normal_x;
                drift_x[l] += touches * other.moved_x;
                drift_y[l] += touches * other.moved_y;
                count[l] += touches;
            }
        }
    }
    // Each one counts itself, too.
    let share = |l: usize| if count[l] > 2.0 { 1.0 / (count[l] - 1.0) } else { 1.0 };
    let toward = |drift: Lanes, moved: Lanes, l: usize| viscosity * (drift[l] / count[l] - moved[l]);
    [
        each(|l| shift_x[l] * share(l) + toward(drift_x, moved_x, l)),
        each(|l| shift_y[l] * share(l) + toward(drift_y, moved_y, l)),
    ]
}
