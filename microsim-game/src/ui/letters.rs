//! The letters that can be written. The build leaves the others out of the font.

/// Those of Basic Latin and Latin-1 that are seen, and the space.
pub(crate) fn letters() -> impl Iterator<Item = char> {
    (' '..='~').chain('\u{a1}'..='\u{ff}')
}
