//! How organisms look in drawings: their form, and the colours of its parts.

/// A colour that covers what is below it by `alpha`, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// Red, sRGB.
    pub red: u8,
    /// Green, sRGB.
    pub green: u8,
    /// Blue, sRGB.
    pub blue: u8,
    /// Share of what is below that it covers.
    pub alpha: f32,
}

impl Colour {
    /// From `0xRRGGBB`, opaque.
    #[must_use]
    pub const fn hex(rgb: u32) -> Self {
        let [_, red, green, blue] = rgb.to_be_bytes();
        Self { red, green, blue, alpha: 1.0 }
    }

    /// The same, covering less.
    #[must_use]
    pub const fn faded(self, alpha: f32) -> Self {
        Self { alpha, ..self }
    }
}

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

impl Tint {
    /// From `0xRRGGBB`: inner, outer, line and detail.
    #[must_use]
    pub const fn hex([inner, outer, line, detail]: [u32; 4]) -> Self {
        Self {
            inner: Colour::hex(inner),
            outer: Colour::hex(outer),
            line: Colour::hex(line),
            detail: Colour::hex(detail),
        }
    }
}

/// What is drawn of an organism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Form {
    /// Its outline, if it has one, and its discs.
    Plain,
    /// A translucent body with granules, and a membrane that is bolder where it leads.
    Amoeboid,
    /// A dense body with a cortex, a nucleus and a cap at its front.
    Ciliate,
    /// The same, pale in its middle.
    RedCell,
    /// A soft disc with a spot.
    Platelet,
    /// Beads: discs that run into each other, each with a bright spot.
    Beads,
    /// A disc of metal: a ring and a hub.
    Metal,
    /// Drops that run into each other.
    Drops,
}

/// How an organism is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnLook {
    /// What is drawn of it.
    pub form: Form,
    /// Its colours.
    pub tint: Tint,
    /// Place among other organisms: what has a lower one is drawn first. Cells lie above what they may take in.
    pub layer: u8,
}
