//! Which particles may touch during a step: broad phase and filters. Knows no constraints.

pub(crate) mod broad_phase;
pub(crate) mod filter;
pub(crate) mod grid;
