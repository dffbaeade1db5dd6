//! Paramecium: a thick body packed with food, an oral groove, two contractile vacuoles and a coat of cilia.

use super::{Cilia, Inclusion, Pellicle, Profile, RoundLook, SpotShape, Texture};
use crate::microscope::matter::Matter;

pub(super) const LOOK: RoundLook = RoundLook {
    profile: Profile::Dome(0.45),
    matter: Matter { phase: 2.5, haemoglobin: 0.0, cytoplasm: 0.9, nucleus: 0.0 },
    variation: 0.05,
    texture: Texture { amount: 0.05, size: 0.5 },
    unevenness: 0.006,
    inclusions: &[GRANULES, FOOD, MACRONUCLEUS],
    cilia: Some(&Cilia { count: 260, length: 0.13, width: 0.09, phase: 0.22, waves: 10.0, rate: 4.0 }),
    pellicle: Some(&Pellicle {
        furrows: 60.0,
        furrow_depth: 0.025,
        groove: 0.28,
        vacuole: 0.15,
        vacuole_period: 12.0,
        vacuole_phase: -1.2,
    }),
};

const GRANULES: Inclusion = Inclusion {
    count: [150, 240],
    radius: [0.012, 0.045],
    place: [0.0, 0.9],
    matter: Matter { phase: 0.30, haemoglobin: 0.0, cytoplasm: 0.25, nucleus: 0.0 },
    shape: SpotShape::Ball,
};

const FOOD: Inclusion = Inclusion {
    count: [6, 10],
    radius: [0.06, 0.10],
    place: [0.15, 0.72],
    matter: Matter { phase: 0.7, haemoglobin: 0.0, cytoplasm: 0.7, nucleus: 0.1 },
    shape: SpotShape::Ball,
};

const MACRONUCLEUS: Inclusion = Inclusion {
    count: [1, 1],
    radius: [0.24, 0.28],
    place: [0.0, 0.15],
    matter: Matter { phase: 0.35, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.9 },
    shape: SpotShape::Ball,
};
