//! Position-based dynamics over the particle store: constraints, contacts and fluid. Knows no biology.
//!
//! Small substeps, one iteration each, multipliers not stored (Macklin et al. 2019). Each constraint is one file; all of
//! them run over any number of lanes ([`lanes`]).

pub(crate) mod anchor;
pub(crate) mod area;
pub(crate) mod block;
pub(crate) mod contact;
pub(crate) mod contraction;
pub(crate) mod distance;
pub(crate) mod drive;
pub(crate) mod fluid;
pub(crate) mod instruction_set;
pub(crate) mod integrate;
pub(crate) mod lanes;
pub(crate) mod membrane;
pub(crate) mod min_distance;
pub(crate) mod obstacle;
pub(crate) mod ring_contact;
pub(crate) mod rope;
#[cfg(test)]
pub(crate) mod testing;
pub(crate) mod untangle;

use crate::error::{Error, in_range};
use crate::particle::Columns;
pub use anchor::Anchor;
pub use area::Area;
pub use distance::Distance;
use lanes::Span;
pub use min_distance::MinDistance;
pub use rope::Rope;
use serde::{Deserialize, Serialize};

/// Largest length or area that a constraint may ask for.
const MAX_LENGTH: f32 = 1e6;

/// The constraints of one body, one homogeneous list per kind. Nodes are slots of a template, or particle indices.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ConstraintSet {
    /// Springs and rigid links.
    pub distances: Vec<Distance>,
    /// Least distances.
    pub min_distances: Vec<MinDistance>,
    /// Enclosed areas.
    pub areas: Vec<Area>,
    /// Contracting ropes to static nodes.
    pub anchors: Vec<Anchor>,
    /// Greatest distances.
    pub ropes: Vec<Rope>,
}

impl ConstraintSet {
    /// Number of constraints of all kinds.
    #[must_use]
    pub fn len(&self) -> usize {
        let Self { distances, min_distances, areas, anchors, ropes } = self;
        distances.len() + min_distances.len() + areas.len() + anchors.len() + ropes.len()
    }

    /// Whether there is no constraint at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Projects every constraint once in each span. Limits come last, because the last projection wins.
    ///
    /// Each constraint is projected in all spans before the next one: those of one body share nodes and have to wait for
    /// each other, those of different bodies do not, so the processor can overlap them.
    #[inline(always)]
    pub(crate) fn project<const L: usize>(&self, spans: &[Span<L>], particles: &mut Columns<'_>, h: f32) {
        let Self { distances, min_distances, areas, anchors, ropes } = self;
        for c in distances.chunks(1) {
            for &span in spans {
                distance::project(c, span, particles, h);
            }
        }
        for c in areas.chunks(1) {
            for &span in spans {
                area::project(c, span, particles, h);
            }
        }
        for c in anchors.chunks(1) {
            for &span in spans {
                anchor::project(c, span, particles, h);
            }
        }
        for c in min_distances.chunks(1) {
            for &span in spans {
                min_distance::project(c, span, particles);
            }
        }
        for c in ropes.chunks(1) {
            for &span in spans {
                rope::project(c, span, particles);
            }
        }
    }

    /// Checks every reference against the number of nodes and every number against its range.
    pub(crate) fn validate(&self, nodes: usize) -> Result<(), Error> {
        let Self { distances, min_distances, areas, anchors, ropes } = self;
        for (k, c) in distances.iter().enumerate() {
            let field = |name: &str| format!("distances[{k}].{name}");
            check_pair(c.a, c.b, nodes, &field("a"))?;
            in_range(&field("rest_length"), c.rest_length, 0.0, MAX_LENGTH)?;
            in_range(&field("compliance"), c.compliance, 0.0, MAX_LENGTH)?;
            in_range(&field("damping"), c.damping, 0.0, 10.0)?;
        }
        for (k, c) in min_distances.iter().enumerate() {
            check_pair(c.a, c.b, nodes, &format!("min_distances[{k}].a"))?;
            in_range(&format!("min_distances[{k}].min_length"), c.min_length, 0.0, MAX_LENGTH)?;
        }
        for (k, c) in areas.iter().enumerate() {
            check_ring(&c.ring, nodes, &format!("areas[{k}].ring"))?;
            in_range(&format!("areas[{k}].rest_area"), c.rest_area, 1e-6, MAX_LENGTH)?;
            in_range(&format!("areas[{k}].compliance"), c.compliance, 0.0, MAX_LENGTH)?;
        }
        for (k, c) in anchors.iter().enumerate() {
            check_pair(c.node, c.anchor, nodes, &format!("anchors[{k}].node"))?;
            in_range(&format!("anchors[{k}].rest_length"), c.rest_length, 0.0, MAX_LENGTH)?;
            in_range(&format!("anchors[{k}].max_length"), c.max_length, c.rest_length, MAX_LENGTH)?;
            in_range(&format!("anchors[{k}].compliance"), c.compliance, 0.0, MAX_LENGTH)?;
        }
        for (k, c) in ropes.iter().enumerate() {
            check_pair(c.a, c.b, nodes, &format!("ropes[{k}].a"))?;
            in_range(&format!("ropes[{k}].max_length"), c.max_length, 0.0, MAX_LENGTH)?;
        }
        Ok(())
    }
}

fn check_pair(a: u32, b: u32, nodes: usize, field: &str) -> Result<(), Error> {
    let is_known = (a as usize) < nodes && (b as usize) < nodes && a != b;
    is_known.then_some(()).ok_or_else(|| Error::reference(field, format!("two different nodes below {nodes}")))
}

/// Checks that a ring has at least three nodes, all different and known.
pub(crate) fn check_ring(ring: &[u32], nodes: usize, field: &str) -> Result<(), Error> {
    let mut sorted = ring.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let is_known = sorted.len() == ring.len() && ring.len() >= 3 && ring.iter().all(|&n| (n as usize) < nodes);
    is_known
        .then_some(())
        .ok_or_else(|| Error::reference(field, format!("three or more different nodes below {nodes}")))
}

/// The factor that brings a vector of this squared length down to `longest`; 1 if it is not longer.
#[inline(always)]
pub(crate) fn ratio_limit(length_squared: f32, longest: f32) -> f32 {
    if length_squared > longest * longest { longest / length_squared.sqrt() } else { 1.0 }
}
