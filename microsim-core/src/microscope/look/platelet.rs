//! Platelet: a thin irregular plate with granules in the middle, which take basic dyes.

use super::{Inclusion, Profile, RoundLook, SpotShape, Texture};
use crate::microscope::matter::Matter;

pub(super) const LOOK: RoundLook = RoundLook {
    profile: Profile::Dome(0.3),
    matter: Matter { phase: 0.30, haemoglobin: 0.0, cytoplasm: 0.55, nucleus: 0.08 },
    variation: 0.15,
    texture: Texture { amount: 0.25, size: 0.4 },
    unevenness: 0.15,
    inclusions: &[Inclusion {
        count: [5, 9],
        radius: [0.14, 0.30],
        place: [0.0, 0.5],
        matter: Matter { phase: 0.16, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.55 },
        shape: SpotShape::Bump,
    }],
    ..RoundLook::PLAIN
};
