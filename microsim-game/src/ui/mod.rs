//! Menus and text, above everything else that is drawn.

pub mod font;
mod glyphs;
pub(crate) mod letters;
pub mod menu;
pub mod pen;
pub mod stars;
