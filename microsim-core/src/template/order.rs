//! Constraints of a template in the order in which they are projected, and those among them that are solved in a way of their own.

use crate::solver::constraint::Constraint;
use crate::solver::muscle::{Muscle, Scaled};

/// Constraints by kind, in the order of projection, those of one kind in their order; and the muscles among them.
pub(super) fn in_order(mut constraints: Vec<Constraint>, muscles: &[Muscle]) -> (Vec<Constraint>, Vec<Muscle>) {
    if muscles.is_empty() {
        constraints.sort_by_key(Constraint::order);
        return (constraints, Vec::new());
    }
    let mut numbered: Vec<(u32, Constraint)> = (0..).zip(constraints).collect();
    numbered.sort_by_key(|(_, constraint)| constraint.order());
    let muscle = |(constraint, &(before, _)): (u32, &(u32, Constraint))| {
        let k = muscles.binary_search_by_key(&before, |muscle| muscle.constraint).ok()?;
        Some(Muscle { constraint, channel: muscles[k].channel })
    };
    let muscles = (0..).zip(&numbered).filter_map(muscle).collect();
    (numbered.into_iter().map(|(_, constraint)| constraint).collect(), muscles)
}

/// The constraints that are muscles or yielding links, in their order; the rows of the latter follow those of the channels.
pub(super) fn scaled(constraints: &[Constraint], muscles: &[Muscle], channels: u32) -> Vec<Scaled> {
    let mut row = channels..;
    let of = |(constraint, k): (&Constraint, u32)| {
        let muscle = muscles.binary_search_by_key(&k, |muscle| muscle.constraint).ok();
        let channel = muscle.map(|at| muscles[at].channel);
        let link = if matches!(constraint, Constraint::YieldingDistance(_)) { row.next() } else { None };
        (channel.is_some() || link.is_some()).then_some(Scaled { constraint: k, channel, link })
    };
    constraints.iter().zip(0..).filter_map(of).collect()
}
