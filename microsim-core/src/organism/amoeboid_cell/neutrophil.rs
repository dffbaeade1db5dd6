//! Neutrophil: a dome of about 0.85 radians, a clear lamella in front, lobes of nucleus, hundreds of granules.

use crate::look::{AmoeboidLook, GranuleLook, Lamella, Matter, NucleusLook, SpotShape, Texture, WAVE};

pub(super) const LOOK: AmoeboidLook = AmoeboidLook {
    matter: Matter { phase: 0.0185 * WAVE * 4.0, haemoglobin: 0.0, cytoplasm: 1.0, nucleus: 0.0 },
    rim: 3.6,
    ectoplasm: 0.5,
    texture: Texture { amount: 0.10, size: 0.45 },
    lamella: Lamella { length: 0.33, thickness: 0.30, ruffle: 0.22, ruffle_inset: 0.45, rags: 0.45, pulse: 8.0 },
    nucleus: NucleusLook {
        lobes: [3, 5],
        radius: [0.27, 0.34],
        behind: 0.16,
        spread: 0.42,
        bent: 0.10,
        matter: Matter { phase: 0.30, haemoglobin: 0.0, cytoplasm: -0.4, nucleus: 1.0 },
        texture: Texture { amount: 0.22, size: 1.2 },
        nucleoli: [0, 0],
    },
    granules: &[DENSE, CLEAR, VACUOLES],
    mitochondria: 0.25,
    longest_mitochondrion: 1.2,
    fibres: 3,
    processes: 10,
    longest_process: 1.6,
    blebs: [0.6, 1.1],
};

const DENSE: GranuleLook = GranuleLook {
    density: 3.2,
    radius: 0.19,
    spread: 0.36,
    limits: [0.09, 0.45],
    gathered: 0.75,
    companions: 0,
    matter: Matter { phase: 0.038 * WAVE, haemoglobin: 0.0, cytoplasm: 2.4, nucleus: 0.0 },
    shape: SpotShape::Ball,
};

const CLEAR: GranuleLook = GranuleLook {
    density: 0.5,
    radius: 0.20,
    spread: 0.3,
    limits: [0.1, 0.4],
    gathered: 0.75,
    companions: 0,
    matter: Matter { phase: -0.034 * WAVE, haemoglobin: 0.0, cytoplasm: -0.7, nucleus: 0.0 },
    shape: SpotShape::Ball,
};

const VACUOLES: GranuleLook = GranuleLook {
    density: 0.03,
    radius: 0.5,
    spread: 0.25,
    limits: [0.35, 0.75],
    gathered: 0.4,
    companions: 0,
    matter: Matter { phase: -0.030 * WAVE, haemoglobin: 0.0, cytoplasm: -0.60, nucleus: 0.0 },
    shape: SpotShape::Ball,
};
