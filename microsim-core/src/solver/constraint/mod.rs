//! Constraints between the nodes of a body: a file per kind. To add one, see docs/add-a-constraint.md.

mod anchor;
mod area;
mod bend;
mod conservative_distance;
mod distance;
mod jacobian_row;
mod link_drag;
mod min_distance;
mod rope;
mod yielding_distance;

pub use anchor::Anchor;
pub use area::Area;
pub(super) use area::MeasuredRing;
pub use bend::Bend;
pub use conservative_distance::ConservativeDistance;
pub use distance::Distance;
pub(crate) use jacobian_row::JacobianRow;
pub use link_drag::LinkDrag;
pub use min_distance::MinDistance;
pub use rope::Rope;
pub(crate) use yielding_distance::TORN;
pub use yielding_distance::YieldingDistance;

use super::lanes::Span;
use crate::error::Error;
use crate::particle::Columns;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Largest length or area that a constraint may ask for.
const MAX_LENGTH: f32 = 1e6;
/// The first place in the order of projection for kinds that pull towards something.
const PULL: u8 = 0;
/// The first place for kinds that limit something. They come last, because the last projection wins.
const LIMIT: u8 = 128;

/// A rule for the places of some nodes of a body. Nodes are slots of a template.
///
/// Digests and snapshots write a kind as its place in this list, so a new kind goes to the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each kind is documented in its file")]
pub enum Constraint {
    Distance(Distance),
    MinDistance(MinDistance),
    Area(Area),
    Anchor(Anchor),
    Rope(Rope),
    Bend(Bend),
    ConservativeDistance(ConservativeDistance),
    YieldingDistance(YieldingDistance),
    LinkDrag(LinkDrag),
}

/// What every kind of constraint says of itself.
pub(crate) trait Constrain {
    /// Place in the order of projection, counted from [`PULL`] or [`LIMIT`]; a different one for each kind.
    fn order(&self) -> u8;

    /// What takes half of it, so that two do what it does: with twice the compliance; for what pulls. `None` for what limits, which
    /// is projected once, after all that pulls.
    fn half(&self) -> Option<Constraint> {
        None
    }

    /// For what pulls: its gradients near a state in which nodes are at these places, by which one tells whether it makes energy.
    fn rows(&self, _places: &[Vec2]) -> Vec<JacobianRow> {
        Vec::new()
    }

    /// Pairs of nodes that it acts between, for drawing.
    fn links(&self) -> Vec<[u32; 2]>;

    /// Checks its nodes, of which there are so many, and the range of each number. Errors name the field.
    fn validate(&self, nodes: usize) -> Result<(), Error>;

    /// Whether it has lengths or areas, which grow with the body and by which it can be a muscle.
    fn has_lengths(&self) -> bool {
        true
    }

    /// Projects it once in each lane of some spans, in a substep of `h` seconds.
    fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32)
    where
        Self: Sized;
}

/// Something that is done to a constraint of any kind. Like a generic closure, so that kernels are inlined.
trait Task<'a> {
    type Output;
    fn run(self, constraint: &'a impl Constrain) -> Self::Output;
}

impl Constraint {
    /// Runs a task on what is inside: the one place that tells the kinds apart.
    #[inline(always)]
    fn run<'a, T: Task<'a>>(&'a self, task: T) -> T::Output {
        match self {
            Self::Distance(c) => task.run(c),
            Self::MinDistance(c) => task.run(c),
            Self::Area(c) => task.run(c),
            Self::Anchor(c) => task.run(c),
            Self::Rope(c) => task.run(c),
            Self::Bend(c) => task.run(c),
            Self::ConservativeDistance(c) => task.run(c),
            Self::YieldingDistance(c) => task.run(c),
            Self::LinkDrag(c) => task.run(c),
        }
    }

    /// Pairs of nodes that it acts between: the two of a distance, the neighbours in a ring.
    #[must_use]
    pub fn links(&self) -> Vec<[u32; 2]> {
        self.run(Borrow).links()
    }

    /// Whether it can be a muscle.
    pub(crate) fn has_lengths(&self) -> bool {
        self.run(Borrow).has_lengths()
    }

    /// What takes half of it, if it pulls.
    pub(crate) fn half(&self) -> Option<Self> {
        self.run(Borrow).half()
    }

    /// Its rows near a state in which nodes are at these places, if it pulls.
    pub(crate) fn rows(&self, places: &[Vec2]) -> Vec<JacobianRow> {
        self.run(Borrow).rows(places)
    }

    /// Place of its kind in the order of projection.
    pub(crate) fn order(&self) -> u8 {
        self.run(Borrow).order()
    }

    /// Checks its nodes and numbers; errors name the field.
    pub(crate) fn validate(&self, nodes: usize) -> Result<(), Error> {
        self.run(Borrow).validate(nodes)
    }
}

/// Borrows a constraint where speed does not matter.
struct Borrow;

impl<'a> Task<'a> for Borrow {
    type Output = &'a dyn Constrain;

    fn run(self, constraint: &'a impl Constrain) -> Self::Output {
        constraint
    }
}

/// Projects a constraint in some spans.
struct Project<'s, 'p, const L: usize> {
    spans: &'s [Span<L>],
    particles: &'s mut Columns<'p>,
    h: f32,
}

impl<const L: usize> Task<'_> for Project<'_, '_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self, constraint: &impl Constrain) {
        constraint.project(self.spans, self.particles, self.h);
    }
}

/// Projects every constraint once in each span.
///
/// Each constraint is projected in all spans before the next one: those of one body share nodes and have to wait for
/// each other, those of different bodies do not, so the processor can overlap them.
#[inline(always)]
pub(crate) fn project<const L: usize>(list: &[Constraint], spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
    let mut particles = particles.even();
    for constraint in list {
        constraint.run(Project { spans, particles: &mut particles, h });
    }
}

/// Checks that nodes are different and below a number.
pub(crate) fn check_nodes(field: &str, list: &[u32], nodes: usize) -> Result<(), Error> {
    let mut sorted = list.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let is_known = sorted.len() == list.len() && list.iter().all(|&n| (n as usize) < nodes);
    is_known.then_some(()).ok_or_else(|| Error::reference(field, format!("different nodes below {nodes}")))
}

/// Checks that a ring has at least three nodes, all different and below a number.
pub(crate) fn check_ring(field: &str, ring: &[u32], nodes: usize) -> Result<(), Error> {
    if ring.len() < 3 {
        return Err(Error::reference(field, "at least three nodes"));
    }
    check_nodes(field, ring, nodes)
}

#[cfg(test)]
mod tests {
    use super::super::testing::disc;
    use super::*;
    use crate::particle::Particles;

    /// One of each kind, between nodes 0, 1 and 2.
    fn kinds() -> [Constraint; 9] {
        let (a, b, rest_length, compliance) = (0, 1, 1.0, 0.0);
        [
            Constraint::from(Distance { a, b, rest_length, compliance, damping: 0.0 }),
            MinDistance { a, b, min_length: 1.0 }.into(),
            Area { ring: vec![0, 1, 2], rest_area: 1.0, compliance, is_upper_bound: false }.into(),
            Anchor { node: a, anchor: b, rest_length, max_length: 1.0, compliance }.into(),
            Rope { a, b, max_length: 1.0 }.into(),
            Bend::new([0, 1, 2], 0.0, compliance).into(),
            ConservativeDistance { a, b, rest_length, compliance, damping: 0.0 }.into(),
            YieldingDistance::from(Distance { a, b, rest_length, compliance, damping: 0.0 }).into(),
            LinkDrag { a, b, along: 1.0, across: 2.0 }.into(),
        ]
    }

    #[test]
    fn each_kind_has_its_own_place_in_the_order_of_projection() {
        let kinds = kinds();
        let orders = std::collections::BTreeSet::from(kinds.each_ref().map(|kind| kind.run(Borrow).order()));
        assert_eq!(orders.len(), kinds.len());
    }

    #[test]
    fn what_has_a_half_has_rows_and_comes_first() {
        let places = [Vec2::ZERO, Vec2::X, Vec2::new(0.3, 1.1)];
        let mut kinds = kinds();
        kinds.sort_by_key(Constraint::order);
        for kind in &kinds {
            assert_eq!(kind.half().is_some(), !kind.rows(&places).is_empty(), "{kind:?}");
        }
        assert!(kinds.is_sorted_by_key(|kind| kind.half().is_none()), "{kinds:?}");
    }

    #[test]
    fn a_ring_has_three_different_nodes_that_exist() {
        let check = |ring: &[u32]| check_ring("ring", ring, 4).map_err(|error| error.field().to_owned());
        assert_eq!((check(&[0, 1, 2]), check(&[3, 0, 1, 2])), (Ok(()), Ok(())));
        for broken in [&[][..], &[0, 1], &[0, 1, 1], &[0, 1, 4]] {
            assert_eq!(check(broken), Err("ring".to_owned()), "{broken:?}");
        }
    }

    #[test]
    fn each_kind_is_drawn_between_its_nodes_and_what_has_no_lengths_is_no_muscle() {
        for kind in kinds() {
            let (links, is_muscle) = match kind {
                Constraint::Area(_) => (vec![[0, 1], [1, 2], [2, 0]], true),
                Constraint::Bend(_) => (vec![[0, 1], [1, 2]], false),
                Constraint::LinkDrag(_) => (vec![[0, 1]], false),
                _ => (vec![[0, 1]], true),
            };
            assert_eq!((kind.links(), kind.has_lengths()), (links, is_muscle), "{kind:?}");
        }
    }

    #[test]
    fn rows_are_what_a_projection_does_to_small_errors() {
        let places = [Vec2::ZERO, Vec2::new(1.0, 0.2), Vec2::new(0.3, 1.1)];
        let area = 0.5 * (places[1] - places[0]).perp_dot(places[2] - places[0]);
        let [out, on] = [places[1] - places[0], places[2] - places[1]];
        let turn = libm::atan2f(out.perp_dot(on), out.dot(on));
        let (a, b, rest_length, compliance) = (0, 1, places[0].distance(places[1]), 1e-5);
        let kinds: [Constraint; 6] = [
            Distance { a, b, rest_length, compliance, damping: 0.0 }.into(),
            YieldingDistance::from(Distance { a, b, rest_length, compliance, damping: 0.0 }).into(),
            Area { ring: vec![0, 1, 2], rest_area: area, compliance, is_upper_bound: false }.into(),
            Bend::new([0, 1, 2], turn, compliance).into(),
            Distance { a, b, rest_length, compliance: 0.0, damping: 0.0 }.into(),
            ConservativeDistance { a, b, rest_length, compliance: 0.0, damping: 0.0 }.into(),
        ];
        let errors = [Vec2::new(0.7, -0.2), Vec2::new(-0.4, 0.5), Vec2::new(0.1, 0.9)].map(|error| 1e-3 * error);
        let (masses, h) = ([1.0, 0.5, 2.0], 0.01);
        for kind in kinds {
            let mut particles = Particles::default();
            for k in 0..3 {
                particles.insert(&disc(places[k] + errors[k], masses[k]));
            }
            kind.run(Project { spans: &[Span::LOOSE], particles: &mut particles.columns(), h });
            let JacobianRow { gradient, compliance } = &kind.rows(&places)[0];
            let error: f32 = gradient.iter().map(|&(k, of)| of.dot(errors[k as usize])).sum();
            let weight: f32 = gradient.iter().map(|&(k, of)| masses[k as usize] * of.length_squared()).sum();
            for &(k, of) in gradient {
                let moved = particles.position(k as usize) - places[k as usize] - errors[k as usize];
                let expected = -of * masses[k as usize] * error / (weight + compliance / (h * h));
                assert!((moved - expected).length() < 2e-6, "{kind:?}, node {k}: {moved} instead of {expected}");
            }
        }
    }
}
