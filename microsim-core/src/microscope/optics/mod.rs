//! Ways to make an image of a specimen. A new one is a file here, with its GLSL beside it, and a place in
//! [`Optics::ALL`].

mod bright_field;
mod classic;
mod dark_field;
mod dic;
mod fluorescence;
mod mode;
mod phase_contrast;
pub(super) mod sampler;
mod stained;

pub use mode::Optics;
pub(super) use mode::{Mode, PixelShader, Shader};

impl Optics {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::PHASE_CONTRAST,
        Self::NEGATIVE_PHASE_CONTRAST,
        Self::DIC,
        Self::DARK_FIELD,
        Self::BRIGHT_FIELD,
        Self::STAINED,
        Self::FLUORESCENCE,
        Self::CLASSIC,
    ];

    /// The one of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|optics| optics.name() == name)
    }
}
