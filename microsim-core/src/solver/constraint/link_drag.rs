//! Drag of a slender link, which resists motion across it more than motion along it: resistive force theory.
//!
//! Per length, a piece of a filament that moves at `u` is held back by `z_n u` across it and `z_t u` along it (Gray, Hancock 1955,
//! "The propulsion of sea-urchin spermatozoa", J. Exp. Biol. 32, 802). Between two nodes the velocity is linear, so that a link of
//! length `l` takes from each direction the momenta
//!
//! `p_a = z l (2 u_a + u_b) h / 6` and `p_b = z l (u_a + 2 u_b) h / 6`
//!
//! in a substep. `u` is the velocity after that, which makes two equations of two unknowns: stable for every `h`. It is the
//! displacement since the substep began, over `h`; the medium is at rest.

use super::{Constrain, Constraint, MAX_LENGTH, PULL, check_nodes};
use crate::error::{Error, in_range};
use crate::instruction_set::each;
use crate::particle::Columns;
use crate::solver::lanes::{Span, add, load, ratio};
use serde::{Deserialize, Serialize};

/// The drag of a straight, slender piece between two nodes, which holds nothing together. Its length is that which it has.
///
/// What undulates swims, where [`across`](Self::across) exceeds [`along`](Self::along): about twice for a thin filament in a viscous
/// fluid. The damping of the world and of an organism come on top.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinkDrag {
    /// First node.
    pub a: u32,
    /// Second node.
    pub b: u32,
    /// Resistance to motion along it, force per speed and length, 0 to 1 000 000. Over its mass per length it is a rate, 1/s; a rate
    /// of more than a tenth of the substeps per second delays muscles.
    pub along: f32,
    /// Resistance to motion across it, force per speed and length, 0 to 1 000 000.
    pub across: f32,
}

impl Constrain for LinkDrag {
    fn order(&self) -> u8 {
        PULL + 6
    }

    fn links(&self) -> Vec<[u32; 2]> {
        vec![[self.a, self.b]]
    }

    fn validate(&self, nodes: usize) -> Result<(), Error> {
        check_nodes("a", &[self.a, self.b], nodes)?;
        in_range("along", self.along, 0.0, MAX_LENGTH)?;
        in_range("across", self.across, 0.0, MAX_LENGTH)
    }

    fn has_lengths(&self) -> bool {
        false
    }

    #[inline(always)]
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let [along, across] = [self.along, self.across].map(|resistance| resistance * h / 6.0);
        for span in spans {
            let (a, b) = (span.at(self.a), span.at(self.b));
            let [x, y] = particles.between_lanes::<L>(a, b);
            let length = each::<L>(|l| (x[l] * x[l] + y[l] * y[l]).sqrt());
            let tangent = [each::<L>(|l| ratio(x[l], length[l])), each::<L>(|l| ratio(y[l], length[l]))];
            let normal = [each::<L>(|l| -tangent[1][l]), tangent[0]];
            let moved = [moved::<L>(particles, a), moved::<L>(particles, b)];
            let weight = [load::<L>(particles.inv_mass, a), load::<L>(particles.inv_mass, b)];
            for (direction, resistance) in [(tangent, along), (normal, across)] {
                let q = each::<L>(|l| resistance * length[l]);
                let taken = taken(moved.map(|moved| part(moved, direction)), weight, q);
                for ((at, taken), weight) in [a, b].into_iter().zip(taken).zip(weight) {
                    add(particles.x, at, each::<L>(|l| -taken[l] * weight[l] * direction[0][l]));
                    add(particles.y, at, each::<L>(|l| -taken[l] * weight[l] * direction[1][l]));
                }
            }
        }
    }
}

/// How far an entry has moved since the substep began.
#[inline(always)]
fn moved<const L: usize>(particles: &Columns<'_>, at: usize) -> [[f32; L]; 2] {
    let (x, from_x) = (load::<L>(particles.x, at), load::<L>(particles.prev_x, at));
    let (y, from_y) = (load::<L>(particles.y, at), load::<L>(particles.prev_y, at));
    [each(|l| x[l] - from_x[l]), each(|l| y[l] - from_y[l])]
}

/// The part of a vector in a direction.
#[inline(always)]
fn part<const L: usize>(vector: [[f32; L]; 2], direction: [[f32; L]; 2]) -> [f32; L] {
    each(|l| vector[0][l] * direction[0][l] + vector[1][l] * direction[1][l])
}

/// What is taken from two nodes that have moved, mass times length, with `q = z l h / 6`: `p = q M (moved - w p)` with the rows
/// 2, 1 and 1, 2 of `M`, solved for `p`.
#[inline(always)]
fn taken<const L: usize>([a, b]: [[f32; L]; 2], [wa, wb]: [[f32; L]; 2], q: [f32; L]) -> [[f32; L]; 2] {
    let (qa, qb) = (each::<L>(|l| q[l] * wa[l]), each::<L>(|l| q[l] * wb[l]));
    let determinant = each::<L>(|l| 1.0 + 2.0 * (qa[l] + qb[l]) + 3.0 * qa[l] * qb[l]);
    let share = each::<L>(|l| q[l] / determinant[l]);
    [each(|l| share[l] * ((2.0 + 3.0 * qb[l]) * a[l] + b[l])), each(|l| share[l] * (a[l] + (2.0 + 3.0 * qa[l]) * b[l]))]
}

impl From<LinkDrag> for Constraint {
    fn from(constraint: LinkDrag) -> Self {
        Self::LinkDrag(constraint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::Particles;
    use crate::solver::testing::line;
    use glam::Vec2;

    const H: f32 = 0.01;
    const DRAG: LinkDrag = LinkDrag { a: 0, b: 1, along: 3.0, across: 6.0 };

    /// Two nodes, 2 units apart on the x axis, that have moved at these velocities for a substep.
    fn moving(inv_mass: [f32; 2], velocities: [Vec2; 2]) -> Particles {
        let mut p = line(2.0, inv_mass);
        for (i, velocity) in velocities.into_iter().enumerate() {
            (p.prev_x[i], p.prev_y[i]) = (p.x[i] - H * velocity.x, p.y[i] - H * velocity.y);
        }
        p
    }

    fn velocity(p: &Particles, i: usize) -> Vec2 {
        Vec2::new(p.x[i] - p.prev_x[i], p.y[i] - p.prev_y[i]) / H
    }

    fn project(drag: LinkDrag, p: &mut Particles) {
        drag.project(&[Span::LOOSE], &mut p.columns(), H);
    }

    #[test]
    fn a_rod_is_held_back_along_and_across_by_its_length_and_as_it_turns_by_a_third() {
        // Mass 2, so that `z l / m` is 3/s and 6/s.
        for (velocity_of, rate) in [(Vec2::X, 3.0), (Vec2::Y, 6.0)] {
            let mut p = moving([1.0; 2], [velocity_of; 2]);
            project(DRAG, &mut p);
            for i in 0..2 {
                assert!((velocity(&p, i) * (1.0 + rate * H) - velocity_of).length() < 1e-4, "{rate}");
            }
        }
        let mut turning = moving([1.0; 2], [Vec2::NEG_Y, Vec2::Y]);
        project(DRAG, &mut turning);
        assert!((velocity(&turning, 1) * (1.0 + 2.0 * H) - Vec2::Y).length() < 1e-4);
    }

    #[test]
    fn momentum_is_lost_as_the_motion_after_it_says() {
        let mut p = moving([1.0, 0.25], [Vec2::new(1.0, -2.0), Vec2::new(-3.0, 0.5)]);
        project(DRAG, &mut p);
        let [a, b] = [0, 1].map(|i| velocity(&p, i));
        let [before_a, before_b] = [Vec2::new(1.0, -2.0), Vec2::new(-3.0, 0.5)];
        let resisted = |u: Vec2| Vec2::new(DRAG.along * u.x, DRAG.across * u.y) * (2.0 * H / 6.0);
        assert!((before_a - a - resisted(2.0 * a + b)).length() < 1e-4);
        assert!((4.0 * (before_b - b) - resisted(a + 2.0 * b)).length() < 1e-4);
    }

    #[test]
    fn any_resistance_leaves_less_motion_and_turns_none_back() {
        for resistance in [1.0, 1e3, 1e6] {
            let mut p = moving([1.0, 1e-3], [Vec2::new(2.0, -1.0), Vec2::new(2.0, -1.0)]);
            project(LinkDrag { along: resistance, across: resistance, ..DRAG }, &mut p);
            for i in 0..2 {
                let left = velocity(&p, i);
                assert!(left.is_finite() && left.length() < 2.24, "{resistance}: {left}");
            }
            assert!(velocity(&p, 1).dot(Vec2::new(2.0, -1.0)) > -1e-3, "{resistance}");
        }
    }

    #[test]
    fn what_rests_cannot_move_or_has_no_direction_stays() {
        let mut rest = line(2.0, [1.0; 2]);
        project(DRAG, &mut rest);
        assert_eq!((rest.x[0], rest.x[1]), (0.0, 2.0));
        let mut pinned = moving([0.0; 2], [Vec2::X; 2]);
        project(DRAG, &mut pinned);
        assert_eq!((pinned.x[0], pinned.x[1]), (0.0, 2.0));
        let mut coincident = line(0.0, [1.0; 2]);
        coincident.prev_x[1] = -0.1;
        project(DRAG, &mut coincident);
        assert_eq!((coincident.x[0], coincident.x[1]), (0.0, 0.0));
    }
}
