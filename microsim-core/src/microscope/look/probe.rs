//! Probe: the round tip of a glass needle, much denser than anything alive.

use super::{Profile, RoundLook};
use crate::microscope::matter::Matter;

pub(super) const LOOK: RoundLook =
    RoundLook { profile: Profile::Dome(0.5), matter: Matter::phase(5.0), ..RoundLook::PLAIN };
