//! Red blood cell: a biconcave disc full of haemoglobin.

use super::{Profile, RoundLook, Texture, WAVE};
use crate::microscope::matter::Matter;

pub(super) const LOOK: RoundLook = RoundLook {
    profile: Profile::Biconcave { c0: [0.81, 1.75], c2: 7.83, c4: 4.39 },
    matter: Matter { phase: 0.033 * WAVE * 2.56, haemoglobin: 1.0, cytoplasm: 0.0, nucleus: 0.0 },
    variation: 0.10,
    texture: Texture { amount: 0.03, size: 0.6 },
    unevenness: 0.045,
    ..RoundLook::PLAIN
};
