//! The colours of all roles: pale, as through a microscope.

use crate::{Colour, Tint};

/// Around the room.
pub const PAGE: Colour = Colour::hex(0xD8DED8);
/// The middle of the room.
pub const ROOM: Colour = Colour::hex(0xF1F4EE);
/// The corners of the room.
pub const ROOM_EDGE: Colour = Colour::hex(0xE1E6DE);
/// The line around the room.
pub const WALL: Colour = Colour::hex(0x8C9691);
/// Letters and scale bars.
pub const INK: Colour = Colour::hex(0x55605B);
/// The bright seam around what is thick, as in phase contrast.
pub const HALO: Colour = Colour::hex(0xFFFFFF).faded(0.75);

/// Cytoplasm that an amoeboid cell has grown.
pub const GROWN: Colour = Colour::hex(0xD1A36B);
/// Obstacles.
pub const STONE: Tint = Tint::hex([0xD2D3CC, 0xB6B8B0, 0x7E827B, 0x7E827B]);
/// Whatever is frozen because its state was no longer finite.
pub const QUARANTINED: Tint = Tint::hex([0xE2E2E2, 0xBEBEBE, 0x6E6E6E, 0x6E6E6E]);
