//! Menus and text, above everything else that is drawn.

pub mod font;
mod glyphs;
mod letters;
pub mod menu;
pub mod pen;
pub mod stars;
