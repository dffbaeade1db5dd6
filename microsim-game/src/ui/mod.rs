//! Menus and text, above everything else that is drawn.

pub mod glyphs;
pub mod menu;
pub mod pen;
