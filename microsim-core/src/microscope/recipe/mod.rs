//! What a graphics card has to draw for a picture, into which targets, with which programs: plain data.
//!
//! ```text
//!   Matter --------------------------+--> Image --> Softened --> Picture
//!   CoarseMatter --> Wave --> Spread --> Surround --^
//! ```
//!
//! [`Microscope::recipe`](super::Microscope::recipe) makes a recipe, and whoever has a graphics card carries it out.
//! [`Program::source`] is GLSL 100, with no extension and nothing but targets of bytes unless [`Precision::Float`] is
//! asked for. The picture is that of [`Microscope::expose`](super::Microscope::expose) up to rounding, except within some
//! pixels of its border.

mod draw;
mod program;
mod texture;

pub use super::noise::noise_table;
pub use draw::Draw;
pub(super) use draw::{DrawList, QUAD, box_corners};
pub use program::{GlslSource, Program};
pub use texture::{Map, RenderTarget, TextureInput};

/// What a card's targets hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Four floats of 16 bits: [`RenderTarget::is_float`] says which targets.
    Float,
    /// Four bytes; every card can do that. Thin things are a little noisy.
    Bytes,
}

/// What a card can do and may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Card {
    /// What its targets hold.
    pub precision: Precision,
    /// Pixels of the image for each pixel of the picture, along each side, 0.1 to 1.
    pub detail: f32,
    /// Whether the image is blurred as an objective does. Without, a pass is saved and edges are too sharp, and halos are
    /// computed on larger pixels.
    pub is_soft: bool,
}

impl Card {
    /// As the picture is meant.
    pub const FULL: Self = Self { precision: Precision::Float, detail: 1.0, is_soft: true };
}

/// Draws into one target.
#[derive(Clone, Debug)]
pub struct Pass {
    /// Where to.
    pub target: RenderTarget,
    /// Its size, pixels.
    pub size: [u32; 2],
    /// What.
    pub content: PassContent,
}

/// What a pass draws.
#[derive(Clone, Debug)]
pub enum PassContent {
    /// [`RenderRecipe::draws`] in their order. The numbers come before each draw's own uniforms.
    Draws(Vec<f32>),
    /// A program on each pixel.
    Screen {
        /// Which.
        program: Program,
        /// In the order of [`GlslSource::uniforms`].
        uniforms: Vec<f32>,
        /// In the order of [`GlslSource::textures`].
        inputs: Vec<TextureInput>,
    },
}

/// The passes of a picture, in their order; the last draws [`RenderTarget::Picture`].
#[derive(Clone, Debug)]
pub struct RenderRecipe {
    /// Things on the slide.
    pub draws: Vec<Draw>,
    /// Textures that only this picture needs.
    pub maps: Vec<Map>,
    /// In their order.
    pub passes: Vec<Pass>,
}
