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

/// The font that the build makes of Ubuntu Light, which looks the same.
const FONT: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/font.ttf"));

/// The font; `None` only if the embedded file is broken.
pub(super) fn load() -> Option<fontdue::Font> {
    fontdue::Font::from_bytes(FONT, fontdue::FontSettings::default()).ok()
}

#[cfg(test)]
mod tests {
    use super::super::letters::letters;
    use super::*;

    #[test]
    fn every_letter_is_that_of_the_whole_font_in_a_tenth_of_its_bytes() {
        let whole_file = epaint_default_fonts::UBUNTU_LIGHT;
        assert!(FONT.len() < whole_file.len() / 10, "{} bytes", FONT.len());
        let whole = fontdue::Font::from_bytes(whole_file, fontdue::FontSettings::default()).unwrap();
        let font = load().unwrap();
        for letter in letters() {
            assert!(
                whole.has_glyph(letter) && font.rasterize(letter, 19.0) == whole.rasterize(letter, 19.0),
                "{letter:?}"
            );
        }
        assert!(letters().count() > 180);
        assert_eq!(font.horizontal_line_metrics(30.0), whole.horizontal_line_metrics(30.0));
    }
}
