//! A large free amoeba: thicker, with coarser granules and one bent nucleus.

use crate::look::{AmoeboidLook, GranuleLook, Lamella, Matter, NucleusLook, SpotShape, Texture, WAVE};

pub(super) const LOOK: AmoeboidLook = AmoeboidLook {
    matter: Matter { phase: 2.0, haemoglobin: 0.0, cytoplasm: 1.0, nucleus: 0.0 },
    rim: 4.5,
    ectoplasm: 2.4,
    texture: Texture { amount: 0.035, size: 0.9 },
    lamella: Lamella { length: 0.15, thickness: 0.5, ruffle: 0.1, ruffle_inset: 1.0, rags: 1.1, pulse: 8.0 },
    nucleus: NucleusLook {
        lobes: [1, 3],
        radius: [0.21, 0.31],
        behind: 0.0,
        spread: 0.15,
        bent: 0.09,
        matter: Matter { phase: 0.18, haemoglobin: 0.0, cytoplasm: -0.4, nucleus: 0.85 },
        texture: Texture { amount: 0.26, size: 1.15 },
        nucleoli: [1, 4],
    },
    granules: &[DENSER, THINNER, FINE, GRANULES, VACUOLES],
    mitochondria: 0.22,
    longest_mitochondrion: 2.6,
    fibres: 0,
    processes: 7,
    longest_process: 3.5,
    blebs: [0.0, 0.0],
};

/// Unevenness of the cytoplasm, which streams and parts with it.
const DENSER: GranuleLook = GranuleLook {
    density: 0.4,
    radius: 0.7,
    spread: 0.4,
    limits: [0.4, 1.8],
    gathered: 0.0,
    companions: 0,
    matter: Matter { phase: 0.0035 * WAVE, haemoglobin: 0.0, cytoplasm: 0.07, nucleus: 0.0 },
    shape: SpotShape::Bump,
};

const THINNER: GranuleLook = GranuleLook {
    matter: Matter { phase: -0.0035 * WAVE, haemoglobin: 0.0, cytoplasm: -0.07, nucleus: 0.0 },
    ..DENSER
};

const FINE: GranuleLook = GranuleLook {
    density: 2.0,
    radius: 0.17,
    spread: 0.45,
    limits: [0.1, 0.6],
    gathered: 0.95,
    companions: 0,
    matter: Matter { phase: 0.024 * WAVE, haemoglobin: 0.0, cytoplasm: 1.4, nucleus: 0.15 },
    shape: SpotShape::Ball,
};

const GRANULES: GranuleLook = GranuleLook {
    density: 0.40,
    radius: 0.22,
    spread: 0.50,
    limits: [0.12, 0.7],
    gathered: 0.9,
    companions: 2,
    matter: Matter { phase: 0.020 * WAVE, haemoglobin: 0.0, cytoplasm: 0.4, nucleus: 0.09 },
    shape: SpotShape::Ball,
};

const VACUOLES: GranuleLook = GranuleLook {
    density: 0.014,
    radius: 0.75,
    spread: 0.45,
    limits: [0.3, 1.3],
    gathered: 0.8,
    companions: 3,
    matter: Matter { phase: -0.0065 * WAVE, haemoglobin: 0.0, cytoplasm: -0.28, nucleus: 0.0 },
    shape: SpotShape::Bump,
};
