//! The letters that can be written. The build leaves the others out of the font.

/// Czech letters beyond Latin-1.
const CZECH: &str = "ČčĎďĚěŇňŘřŠšŤťŮůŽž";

/// Those of Basic Latin and Latin-1 that are seen, the space, and those of the other languages.
pub(crate) fn letters() -> impl Iterator<Item = char> {
    (' '..='~').chain('\u{a1}'..='\u{ff}').chain(CZECH.chars())
}
