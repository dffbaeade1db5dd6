//! What an optics mode consists of.

use super::sampler::Sampler;
use crate::microscope::glsl::Glsl;
use crate::microscope::surround_wave::Surround;
use std::fmt;
use std::hash::{Hash, Hasher};

/// A way to make an image.
#[derive(Clone, Copy)]
pub struct Optics(pub(super) &'static Mode);

impl Optics {
    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.0.name
    }

    /// Whether a field without a specimen is lighter than middle grey.
    #[must_use]
    pub fn is_bright(self) -> bool {
        self.0.is_bright
    }

    /// How it makes its image.
    pub(in crate::microscope) fn mode(self) -> &'static Mode {
        self.0
    }
}

impl fmt::Debug for Optics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Names identify modes.
impl PartialEq for Optics {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Optics {}

impl Hash for Optics {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name().hash(state);
    }
}

/// How light becomes an image.
#[derive(Debug)]
pub(in crate::microscope) struct Mode {
    pub name: &'static str,
    /// See [`Optics::is_bright`].
    pub is_bright: bool,
    /// 1 for grey, 3 for colour.
    pub channels: usize,
    /// What of the specimen its image needs without details, if anything.
    pub surround: Option<Surround>,
    /// Blur of the image by diffraction and what else is less than perfect, standard deviation, micrometres.
    pub blur: f32,
    /// Light of a field without a specimen, or its mean where that is dark; grey is the first.
    pub ground: [f32; 3],
    /// Strength of the film's grain in this light, relative to phase contrast.
    pub grain: f32,
    pub shader: Shader,
}

/// Light at a pixel, 0 to about 1 as the eye sees it; one channel or three.
pub(in crate::microscope) type PixelShader = fn(&Sampler<'_>, usize, usize) -> [f32; 3];

/// How the pixels of an image are computed.
#[derive(Debug)]
pub(in crate::microscope) enum Shader {
    /// Light at each pixel, and the same formula for a graphics card.
    Light(PixelShader, &'static Glsl),
    /// Painted, without light.
    Painted,
}

/// A grey value in the first channel.
pub(super) fn grey(value: f32) -> [f32; 3] {
    [value, 0.0, 0.0]
}
