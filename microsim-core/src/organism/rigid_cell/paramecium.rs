//! Paramecium: a thick body packed with food, an oral groove, two contractile vacuoles and a coat of cilia.

use crate::look::{Cilia, Inclusion, Matter, OutlineLook, Pellicle, Profile, RoundLook, SpotShape, Texture};

pub(super) const LOOK: RoundLook = RoundLook {
    profile: Profile::Dome(0.45),
    matter: Matter { phase: 1.8, haemoglobin: 0.0, cytoplasm: 0.9, nucleus: 0.0 },
    variation: 0.05,
    texture: Texture { amount: 0.07, size: 1.3 },
    outline: OutlineLook::uneven(0.012),
    inclusions: &[GRANULES, CRYSTALS, FOOD, MACRONUCLEUS],
    cilia: Some(&Cilia { most: 380.0, apart: 0.35, length: 0.16, width: 0.14, phase: 0.26, waves: 9.0, rate: 4.0 }),
    pellicle: Some(&Pellicle {
        furrows: 22.0,
        furrow_depth: 0.012,
        groove: 0.26,
        gullet_phase: 1.0,
        slipper: 0.10,
        vacuole: 0.15,
        vacuole_period: 12.0,
        vacuole_phase: -1.2,
    }),
    filopodia: 0,
};

const GRANULES: Inclusion = Inclusion {
    count: [320, 400],
    radius: [0.010, 0.060],
    place: [0.0, 0.93],
    matter: Matter { phase: 0.22, haemoglobin: 0.02, cytoplasm: 0.25, nucleus: 0.0 },
    shape: SpotShape::Ball,
    grains: [0, 0],
};

const CRYSTALS: Inclusion = Inclusion {
    count: [60, 90],
    radius: [0.010, 0.030],
    place: [0.0, 0.9],
    matter: Matter { phase: -0.6, haemoglobin: 0.0, cytoplasm: -0.1, nucleus: 0.0 },
    shape: SpotShape::Bump,
    grains: [0, 0],
};

const FOOD: Inclusion = Inclusion {
    count: [6, 10],
    radius: [0.035, 0.10],
    place: [0.15, 0.72],
    matter: Matter { phase: 0.45, haemoglobin: 0.10, cytoplasm: 0.6, nucleus: 0.1 },
    shape: SpotShape::Ball,
    grains: [0, 2],
};

const MACRONUCLEUS: Inclusion = Inclusion {
    count: [1, 1],
    radius: [0.21, 0.25],
    place: [0.0, 0.15],
    matter: Matter { phase: 0.35, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.9 },
    shape: SpotShape::Ball,
    grains: [24, 36],
};
