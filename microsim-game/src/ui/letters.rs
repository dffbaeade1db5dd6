//! The letters that can be written. The build leaves the others out of the font.

/// Czech letters beyond Latin-1.
const CZECH: &str = "ČčĎďĚěŇňŘřŠšŤťŮůŽž";

/// Signs beyond Basic Latin that texts have.
const SIGNS: &str = "§«°±²³µ·»";

/// Those of Basic Latin that are seen, the space, signs, the letters of Latin-1, and those of the other languages.
pub(crate) fn letters() -> impl Iterator<Item = char> {
    (' '..='~').chain(SIGNS.chars()).chain('À'..='ÿ').chain(CZECH.chars())
}
