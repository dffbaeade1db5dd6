//! The font and the sizes in which it is used.

/// The only word that is written in the largest size.
pub const TITLE: &str = "microsim";

/// Sizes of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TextSize {
    /// What may be overlooked.
    Small,
    /// What is to be read.
    Body,
    /// What is to be seen.
    Large,
    /// [`TITLE`].
    Huge,
}

impl TextSize {
    pub(super) const ALL: [Self; 4] = [Self::Small, Self::Body, Self::Large, Self::Huge];

    /// Height of letters in a picture of the usual size, pixels.
    pub(super) fn usual(self) -> f32 {
        match self {
            Self::Small => 15.0,
            Self::Body => 19.0,
            Self::Large => 30.0,
            Self::Huge => 64.0,
        }
    }
}

/// The font; `None` only if the embedded file is broken.
pub(super) fn load() -> Option<fontdue::Font> {
    fontdue::Font::from_bytes(epaint_default_fonts::UBUNTU_LIGHT, fontdue::FontSettings::default()).ok()
}
