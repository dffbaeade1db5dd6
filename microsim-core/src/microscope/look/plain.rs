//! Bodies that the library does not know: plain cells.

use super::{Inclusion, Profile, RoundLook, SpotShape, Texture};
use crate::microscope::matter::Matter;

pub(super) const LOOK: RoundLook = RoundLook {
    profile: Profile::Dome(0.5),
    matter: Matter { phase: 0.9, haemoglobin: 0.0, cytoplasm: 0.8, nucleus: 0.0 },
    variation: 0.1,
    texture: Texture { amount: 0.08, size: 0.5 },
    unevenness: 0.01,
    inclusions: &[Inclusion {
        count: [1, 1],
        radius: [0.30, 0.38],
        place: [0.0, 0.2],
        matter: Matter { phase: 0.25, haemoglobin: 0.0, cytoplasm: 0.0, nucleus: 0.8 },
        shape: SpotShape::Ball,
    }],
    ..RoundLook::PLAIN
};
