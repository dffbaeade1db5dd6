//! What kinds of organisms there are, as a name for events and output.

use serde::{Deserialize, Serialize};

/// What an organism is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[non_exhaustive]
#[repr(u8)]
pub enum Kind {
    /// A soft body that keeps its shape, like a paramecium.
    RigidCell,
    /// A membrane filled with cytoplasm, like a neutrophil.
    AmoeboidCell,
    /// A soft obstacle that returns to its anchor.
    Platelet,
    /// A small disc to be eaten.
    Agar,
    /// A heavy disc that an experimenter drives.
    Probe,
    /// Fluid on its own.
    FluidBlock,
    /// Spawned from a template that the library does not know.
    Custom,
    /// A red blood cell: soft, in everybody's way.
    RedCell,
    /// A small round bacterium.
    Coccus,
    /// A small rod-shaped bacterium.
    Bacillus,
}

impl Kind {
    /// Name in scenario files and output.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::RigidCell => "rigid_cell",
            Self::AmoeboidCell => "amoeboid_cell",
            Self::Platelet => "platelet",
            Self::Agar => "agar",
            Self::Probe => "probe",
            Self::FluidBlock => "fluid_block",
            Self::Custom => "custom",
            Self::RedCell => "red_cell",
            Self::Coccus => "coccus",
            Self::Bacillus => "bacillus",
        }
    }
}
