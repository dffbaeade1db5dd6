//! Roles of particles.

use serde::{Deserialize, Serialize};

/// What a particle is to its organism; for drawing and for rules, not for the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[non_exhaustive]
#[repr(u8)]
pub enum Role {
    /// Anything without a more special role.
    Plain,
    /// On the outline: a satellite of the outermost ring or a node of a membrane.
    Membrane,
    /// A satellite of an inner ring.
    InnerRing,
    /// The heavy centre of a soft body.
    Nucleus,
    /// The disc that holds a platelet's ring out.
    Interlayer,
    /// A static point that a rope leads to.
    Anchor,
    /// Fluid inside a membrane.
    Cytoplasm,
    /// Fluid inside a membrane that was not there when its organism was spawned.
    GrownCytoplasm,
    /// Fluid on its own.
    Fluid,
}

impl Role {
    pub(crate) const ALL: [Self; 9] = [
        Self::Plain,
        Self::Membrane,
        Self::InnerRing,
        Self::Nucleus,
        Self::Interlayer,
        Self::Anchor,
        Self::Cytoplasm,
        Self::GrownCytoplasm,
        Self::Fluid,
    ];

    pub(crate) fn from_u8(role: u8) -> Self {
        Self::ALL.get(role as usize).copied().unwrap_or(Self::Plain)
    }
}
