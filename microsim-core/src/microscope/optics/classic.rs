//! The seed's look, painted rather than lit: see [`crate::microscope::painting`].

use super::{Mode, Shade};

pub(super) const MODE: Mode = Mode { channels: 3, has_surround: false, blur: 0.0, grain: 0.5, shade: Shade::Painted };
