//! Coccus: a small dense ball, such as *Staphylococcus aureus*.

use super::{Profile, RoundLook};
use crate::microscope::matter::Matter;

pub(super) const LOOK: RoundLook = RoundLook {
    profile: Profile::Dome(0.5),
    matter: Matter { phase: 1.05, haemoglobin: 0.0, cytoplasm: 0.3, nucleus: 1.2 },
    variation: 0.1,
    ..RoundLook::PLAIN
};
