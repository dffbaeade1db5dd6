//! A large free amoeba: thicker, with coarser granules and one round nucleus.

use super::{AmoeboidLook, GranuleLook, Lamella, NucleusLook, SpotShape, Texture, WAVE};
use crate::microscope::matter::Matter;

pub(super) const LOOK: AmoeboidLook = AmoeboidLook {
    matter: Matter { phase: 2.4, haemoglobin: 0.0, cytoplasm: 1.0, nucleus: 0.0 },
    rim: 8.0,
    texture: Texture { amount: 0.06, size: 1.2 },
    lamella: Lamella { length: 0.15, thickness: 0.5, ruffle: 0.1, ruffle_inset: 1.0, pulse: 8.0 },
    nucleus: NucleusLook {
        lobes: [1, 1],
        radius: [0.22, 0.25],
        spread: 0.05,
        matter: Matter { phase: 0.4, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.8 },
        texture: Texture { amount: 0.2, size: 1.5 },
    },
    granules: &[GRANULES, VACUOLES],
    fibres: 0,
    blebs: [0.0, 0.0],
};

const GRANULES: GranuleLook = GranuleLook {
    density: 0.35,
    radius: 0.5,
    spread: 0.3,
    limits: [0.3, 0.9],
    matter: Matter { phase: 0.03 * WAVE, haemoglobin: 0.0, cytoplasm: 0.15, nucleus: 0.0 },
    shape: SpotShape::Ball,
};

const VACUOLES: GranuleLook = GranuleLook {
    density: 0.006,
    radius: 1.4,
    spread: 0.3,
    limits: [0.8, 2.4],
    matter: Matter { phase: -0.03 * WAVE, haemoglobin: 0.0, cytoplasm: -0.3, nucleus: 0.0 },
    shape: SpotShape::Ball,
};
