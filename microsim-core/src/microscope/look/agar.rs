//! Agar: a soft bead of gel, hardly denser than water.

use super::{Profile, RoundLook, Texture};
use crate::microscope::matter::Matter;

pub(super) const LOOK: RoundLook = RoundLook {
    profile: Profile::Dome(0.8),
    matter: Matter { phase: 0.45, haemoglobin: 0.0, cytoplasm: 0.35, nucleus: 0.0 },
    variation: 0.3,
    texture: Texture { amount: 0.2, size: 0.35 },
    unevenness: 0.03,
    ..RoundLook::PLAIN
};
