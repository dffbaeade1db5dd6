//! Constraints between the nodes of a body: a file per kind. To add one, see docs/add-a-constraint.md.

mod anchor;
mod area;
mod distance;
mod min_distance;
mod rope;

pub use anchor::Anchor;
pub use area::Area;
pub(super) use area::{MeasuredRing, enforce};
pub use distance::Distance;
pub use min_distance::MinDistance;
pub use rope::Rope;

use super::lanes::Span;
use crate::error::Error;
use crate::particle::Columns;
use serde::{Deserialize, Serialize};

/// Largest length or area that a constraint may ask for.
const MAX_LENGTH: f32 = 1e6;

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
}

/// What every kind of constraint does in its own way.
pub(crate) trait Constrain {
    /// Checks its nodes, of which there are so many, and the range of each number. Errors name the field.
    fn validate(&self, nodes: usize) -> Result<(), Error>;

    /// Projects it once in each lane of a span, in a substep of `h` seconds.
    fn project<const L: usize>(&self, span: Span<L>, particles: &mut Columns<'_>, h: f32);
}

impl Constraint {
    /// Pairs of nodes that it acts between: the two of a distance, the neighbours in a ring.
    #[must_use]
    pub fn links(&self) -> Vec<[u32; 2]> {
        match self {
            Self::Distance(Distance { a, b, .. })
            | Self::MinDistance(MinDistance { a, b, .. })
            | Self::Rope(Rope { a, b, .. })
            | Self::Anchor(Anchor { node: a, anchor: b, .. }) => vec![[*a, *b]],
            Self::Area(Area { ring, .. }) => {
                ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b]).collect()
            }
        }
    }

    /// Checks its nodes and numbers; errors name the field.
    pub(crate) fn validate(&self, nodes: usize) -> Result<(), Error> {
        match self {
            Self::Distance(c) => c.validate(nodes),
            Self::MinDistance(c) => c.validate(nodes),
            Self::Area(c) => c.validate(nodes),
            Self::Anchor(c) => c.validate(nodes),
            Self::Rope(c) => c.validate(nodes),
        }
    }

    /// Place of its kind in the order of projection. Kinds that limit something come last, because the last projection wins.
    fn order(&self) -> u8 {
        match self {
            Self::Distance(_) => 0,
            Self::Area(_) => 1,
            Self::Anchor(_) => 2,
            Self::MinDistance(_) => 3,
            Self::Rope(_) => 4,
        }
    }
}

/// Projects every constraint once in each span.
///
/// Each constraint is projected in all spans before the next one: those of one body share nodes and have to wait for
/// each other, those of different bodies do not, so the processor can overlap them.
#[inline(always)]
pub(crate) fn project<const L: usize>(list: &[Constraint], spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
    for constraint in list {
        match constraint {
            Constraint::Distance(c) => project_one(c, spans, particles, h),
            Constraint::MinDistance(c) => project_one(c, spans, particles, h),
            Constraint::Area(c) => project_one(c, spans, particles, h),
            Constraint::Anchor(c) => project_one(c, spans, particles, h),
            Constraint::Rope(c) => project_one(c, spans, particles, h),
        }
    }
}

#[inline(always)]
fn project_one<const L: usize>(constraint: &impl Constrain, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
    for &span in spans {
        constraint.project(span, particles, h);
    }
}

/// Sorts constraints by kind, in the order of projection; those of one kind stay in their order.
pub(crate) fn sort(list: &mut [Constraint]) {
    list.sort_by_key(Constraint::order);
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
    use super::*;

    #[test]
    fn each_kind_has_its_own_place_in_the_order_of_projection() {
        let (a, b, rest_length, compliance) = (0, 1, 1.0, 0.0);
        let kinds = [
            Constraint::from(Distance { a, b, rest_length, compliance, damping: 0.0 }),
            MinDistance { a, b, min_length: 1.0 }.into(),
            Area { ring: vec![0, 1, 2], rest_area: 1.0, compliance, is_upper_bound: false }.into(),
            Anchor { node: a, anchor: b, rest_length, max_length: 1.0, compliance }.into(),
            Rope { a, b, max_length: 1.0 }.into(),
        ];
        let orders = std::collections::BTreeSet::from(kinds.each_ref().map(Constraint::order));
        assert_eq!(orders.len(), kinds.len());
    }
}
