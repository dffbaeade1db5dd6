//! The look of the thesis, painted rather than lit: see [`crate::microscope::painting`].

use super::mode::{Mode, Optics, Shader};

impl Optics {
    /// The illustrated look of the thesis (3.2): textured meshes, blurred particles, drifting things in the background.
    pub const CLASSIC: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "classic",
    is_bright: true,
    channels: 3,
    surround: None,
    blur: 0.0,
    ground: [0.66, 0.76, 0.74],
    grain: 0.5,
    shader: Shader::Painted,
};
