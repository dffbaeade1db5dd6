//! Colours: pale, as through a microscope.

use super::shape::Colour;

pub(crate) const PAGE: Colour = Colour::hex(0xE3E7E4);
pub(crate) const ROOM: Colour = Colour::hex(0xF8F9F6);
pub(crate) const ROOM_EDGE: Colour = Colour::hex(0xE9EDE9);
pub(crate) const WALL: Colour = Colour::hex(0x8C9691);
pub(crate) const INK: Colour = Colour::hex(0x55605B);
/// The bright seam around what is thick, as in phase contrast.
pub(crate) const HALO: Colour = Colour::hex(0xFFFFFF).faded(0.75);

/// Colours of one kind of body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tint {
    pub inner: Colour,
    pub outer: Colour,
    pub line: Colour,
    /// Nucleus, granules and the like.
    pub detail: Colour,
}

const fn tint(inner: u32, outer: u32, line: u32, detail: u32) -> Tint {
    Tint { inner: Colour::hex(inner), outer: Colour::hex(outer), line: Colour::hex(line), detail: Colour::hex(detail) }
}

pub(crate) const AMOEBOID: Tint = tint(0xC9D3EA, 0x9FB0D8, 0x4C5F96, 0x53669F);
pub(crate) const RIGID: Tint = tint(0xDDE5B8, 0xB4C27C, 0x66763A, 0x59692F);
pub(crate) const PLATELET: Tint = tint(0xF3D3CD, 0xDE9F98, 0xA65E5C, 0x9C4F52);
pub(crate) const AGAR: Tint = tint(0xF4CE86, 0xDFA44A, 0xA8732A, 0xFFF3D8);
pub(crate) const PROBE: Tint = tint(0x8D98A3, 0x56626E, 0x323B44, 0xC6CED6);
pub(crate) const FLUID: Tint = tint(0x9CCBE3, 0x6CAFD1, 0x4A91B6, 0x4A91B6);
pub(crate) const RED: Tint = tint(0xEBB3AC, 0xD07A73, 0x94413F, 0x94413F);
pub(crate) const COCCUS: Tint = tint(0x8B7FA8, 0x5E5280, 0x3E3459, 0xD8D2E6);
pub(crate) const CUSTOM: Tint = tint(0xD9C9E6, 0xB094CB, 0x70538F, 0x70538F);
pub(crate) const STONE: Tint = tint(0xD2D3CC, 0xB6B8B0, 0x7E827B, 0x7E827B);
/// Whatever is frozen because its state was no longer finite.
pub(crate) const QUARANTINED: Tint = tint(0xE2E2E2, 0xBEBEBE, 0x6E6E6E, 0x6E6E6E);
