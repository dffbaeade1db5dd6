//! Textures that a card draws into and reads from.

/// A texture that is drawn into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RenderTarget {
    /// The specimen.
    Matter,
    /// The specimen and some of what is around it, coarsely.
    CoarseMatter,
    /// The wave behind that.
    Wave,
    /// That, blurred along its rows.
    Spread,
    /// The surround wave.
    Surround,
    /// Light.
    Image,
    /// Light, blurred along its rows.
    Softened,
    /// The result: bytes, red, green, blue and full opacity.
    Picture,
}

impl RenderTarget {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Matter,
        Self::CoarseMatter,
        Self::Wave,
        Self::Spread,
        Self::Surround,
        Self::Image,
        Self::Softened,
        Self::Picture,
    ];

    /// Whether it holds floats where targets can.
    #[must_use]
    pub fn is_float(self) -> bool {
        self != Self::Picture
    }
}

/// What a program reads from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureInput {
    /// [`noise_table`](super::noise_table).
    Noise,
    /// What an earlier pass has drawn; between pixels it is interpolated.
    Target(RenderTarget),
    /// One of [`RenderRecipe::maps`](super::RenderRecipe::maps), not interpolated.
    Map(usize),
}

/// A small texture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Map {
    /// Columns and rows.
    pub size: [u16; 2],
    /// Four bytes each, the first row at the lowest coordinate.
    pub texels: Vec<u8>,
}
