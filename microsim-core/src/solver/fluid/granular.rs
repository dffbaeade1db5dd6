//! Grains: particles that only keep from overlapping. Averaged contacts, over-relaxed (Macklin et al. 2014, "Unified
//! Particle Physics", section 4.1). Lengths are in units of the spacing.

use super::neighbours::{Group, Lanes, Neighbour, distance, positive};
use crate::solver::lanes::{LANES, each};

/// Share by which averaged contacts are over-relaxed.
const OVER_RELAXATION: f32 = 1.5;

/// How far a group's members are moved: out of each other, and by viscosity towards the mean way of those they touch.
#[inline(always)]
pub(super) fn shifts(group: &Group, neighbours: &[Neighbour], viscosity: f32) -> [Lanes; 2] {
    let (x, y) = (group.load(neighbours, |s| s.x), group.load(neighbours, |s| s.y));
    let [mut shift_x, mut shift_y, mut drift_x, mut drift_y, mut count] = [[0.0; LANES]; 5];
    for window in group.windows(neighbours) {
        for other in window {
            for l in 0..LANES {
                let (dx, dy) = (x[l] - other.x, y[l] - other.y);
                let r = distance(dx, dy);
                let along = 0.5 * positive(1.0 - r) / r;
                let touches = if r < 1.0 { 1.0 } else { 0.0 };
                shift_x[l] += dx * along;
                shift_y[l] += dy * along;
                drift_x[l] += touches * other.moved_x;
                drift_y[l] += touches * other.moved_y;
                count[l] += touches;
            }
        }
    }
    let (moved_x, moved_y) = (group.load(neighbours, |s| s.moved_x), group.load(neighbours, |s| s.moved_y));
    // Each one counts itself, too.
    let share = |l: usize| if count[l] > 2.0 { OVER_RELAXATION / (count[l] - 1.0) } else { 1.0 };
    let toward = |drift: Lanes, moved: Lanes, l: usize| viscosity * (drift[l] / count[l] - moved[l]);
    [
        each(|l| shift_x[l] * share(l) + toward(drift_x, moved_x, l)),
        each(|l| shift_y[l] * share(l) + toward(drift_y, moved_y, l)),
    ]
}
