//! Position-based dynamics over the particle store: constraints, contacts and fluid. Knows no biology.
//!
//! Small substeps, one iteration each, or one there and back, multipliers not stored (Macklin et al. 2019). Each kind of constraint is one file in
//! [`constraint`]; all of them run over any number of lanes ([`lanes`]).

pub(crate) mod block;
pub(crate) mod constraint;
pub(crate) mod contact;
pub(crate) mod contact_record;
pub(crate) mod contraction;
pub(crate) mod disc_contacts;
pub(crate) mod drive;
pub(crate) mod fluid;
pub(crate) mod force;
pub(crate) mod integrate;
pub(crate) mod joint;
pub(crate) mod lanes;
pub(crate) mod membrane;
pub(crate) mod muscle;
pub(crate) mod obstacle;
mod relink;
pub(crate) mod repair;
pub(crate) mod ring_contact;
mod ring_lanes;
mod ring_relation;
pub(crate) mod speed_limit;
mod strays;
pub(crate) mod stretch_damping;
mod sweep;
#[cfg(test)]
pub(crate) mod testing;
mod untangle;
pub(crate) mod yielding;

/// The factor that brings a vector of this squared length down to `longest`; 1 if it is not longer.
#[inline(always)]
pub(crate) fn ratio_limit(length_squared: f32, longest: f32) -> f32 {
    if length_squared > longest * longest { longest / length_squared.sqrt() } else { 1.0 }
}
