//! The colours of all roles: pale, as through a microscope.

use super::shape::Colour;

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

/// Colours of one kind of body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// Its middle.
    pub inner: Colour,
    /// Its edge.
    pub outer: Colour,
    /// The line around it.
    pub line: Colour,
    /// Nucleus, granules and the like.
    pub detail: Colour,
}

const fn tint(inner: u32, outer: u32, line: u32, detail: u32) -> Tint {
    Tint { inner: Colour::hex(inner), outer: Colour::hex(outer), line: Colour::hex(line), detail: Colour::hex(detail) }
}

/// Amoeboid cells.
pub const AMOEBOID: Tint = tint(0xC9D3EA, 0x9FB0D8, 0x4C5F96, 0x53669F);
/// Cytoplasm that an amoeboid cell has grown.
pub const GROWN: Colour = Colour::hex(0xD1A36B);
/// Rigid cells.
pub const RIGID: Tint = tint(0xDDE5B8, 0xB4C27C, 0x66763A, 0x59692F);
/// Platelets.
pub const PLATELET: Tint = tint(0xF3D3CD, 0xDE9F98, 0xA65E5C, 0x9C4F52);
/// Agar.
pub const AGAR: Tint = tint(0xF4CE86, 0xDFA44A, 0xA8732A, 0xFFF3D8);
/// Probes.
pub const PROBE: Tint = tint(0x8D98A3, 0x56626E, 0x323B44, 0xC6CED6);
/// Fluid.
pub const FLUID: Tint = tint(0x9CCBE3, 0x6CAFD1, 0x4A91B6, 0x4A91B6);
/// Red cells.
pub const RED: Tint = tint(0xEBB3AC, 0xD07A73, 0x94413F, 0x94413F);
/// Bacteria.
pub const COCCUS: Tint = tint(0x8B7FA8, 0x5E5280, 0x3E3459, 0xD8D2E6);
/// Bodies of no known kind.
pub const CUSTOM: Tint = tint(0xD9C9E6, 0xB094CB, 0x70538F, 0x70538F);
/// Obstacles.
pub const STONE: Tint = tint(0xD2D3CC, 0xB6B8B0, 0x7E827B, 0x7E827B);
/// Whatever is frozen because its state was no longer finite.
pub const QUARANTINED: Tint = tint(0xE2E2E2, 0xBEBEBE, 0x6E6E6E, 0x6E6E6E);
