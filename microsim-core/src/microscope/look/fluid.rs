//! Fluid on its own: a little denser than the medium, each particle a soft drop that runs into its neighbours.

use crate::microscope::matter::Matter;

pub(super) const LOOK: Matter = Matter { phase: 0.5, haemoglobin: 0.0, cytoplasm: 0.4, nucleus: 0.0 };
