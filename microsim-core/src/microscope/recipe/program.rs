//! The programs: what each draws, and the numbers of its vertices.

use crate::microscope::optics::{Optics, Shader};

/// Something that a graphics card runs for each pixel of some triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Program {
    /// Uneven glass, on all of the slide.
    Background,
    /// What lies beyond the room.
    Walls,
    /// An obstacle.
    Obstacle,
    /// A crawling cell.
    Amoeboid,
    /// Bodies described from their centre.
    Round,
    /// A ciliate.
    Ciliate,
    /// Small round things.
    Spot,
    /// Thin threads.
    Thread,
    /// The wave behind matter.
    Wave,
    /// What of matter shines.
    Emission,
    /// Its blur along rows.
    SpreadAcross,
    /// Its blur along columns.
    SpreadAlong,
    /// An image; not for [`Optics::CLASSIC`].
    Image(Optics),
    /// Blur of an image along its rows.
    Soften,
    /// Its blur along columns, and the film that records it.
    Film,
    /// A painted page.
    Page,
    /// A painted obstacle.
    PageObstacle,
    /// Painted triangles and discs.
    Painted,
}

/// A program's text and what it wants.
#[derive(Clone, Debug)]
pub struct GlslSource {
    /// GLSL 100.
    pub vertex: String,
    /// GLSL 100.
    pub fragment: String,
    /// Names and numbers of floats of what each vertex has.
    pub attributes: &'static [(&'static str, usize)],
    /// Names, numbers of floats (1 to 4), and lengths of arrays (1 for what is none).
    pub uniforms: Vec<(&'static str, usize, usize)>,
    /// Names of the samplers.
    pub textures: Vec<&'static str>,
}

const CORNER: &[(&str, usize)] = &[("corner", 2)];
const PLACE: &[(&str, usize)] = &[("place", 2)];
const ROUND: &[(&str, usize)] = &[
    ("centre", 2),
    ("rim", 3),
    ("facing", 4),
    ("matter", 4),
    ("profile", 4),
    ("grains", 4),
    ("dried", 4),
    ("hollow", 4),
];
const SPOT: &[(&str, usize)] = &[("at", 2), ("corner", 2), ("size", 3), ("matter", 4)];
const THREAD: &[(&str, usize)] = &[("from", 2), ("to", 2), ("corner", 2), ("form", 2), ("matter", 4)];
const PAINTED: &[(&str, usize)] = &[("place", 2), ("texture_place", 2), ("colour", 4), ("rim", 4), ("noise", 3)];

impl Program {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        use Program::*;
        let lit = Optics::ALL.into_iter().filter(|optics| matches!(optics.mode().shader, Shader::Light(..)));
        [Background, Walls, Obstacle, Amoeboid, Round, Ciliate, Spot, Thread, Wave, Emission, SpreadAcross, SpreadAlong]
            .into_iter()
            .chain(lit.map(Image))
            .chain([Soften, Film, Page, PageObstacle, Painted])
    }

    /// Whether it replaces what a target holds, by as much as its result is opaque. All others add to it.
    #[must_use]
    pub fn covers(self) -> bool {
        use Program::*;
        !matches!(self, Walls | Obstacle | Amoeboid | Round | Ciliate | Spot | Thread)
    }

    /// Whether its results may be less than opaque.
    #[must_use]
    pub fn blends(self) -> bool {
        self == Self::Painted
    }

    /// What each vertex has.
    pub(in crate::microscope) fn attributes(self) -> &'static [(&'static str, usize)] {
        use Program::*;
        match self {
            Walls | Obstacle | Amoeboid => PLACE,
            Round | Ciliate => ROUND,
            Spot => SPOT,
            Thread => THREAD,
            Painted => PAINTED,
            _ => CORNER,
        }
    }

    /// Numbers of each vertex.
    pub(super) fn floats_per_vertex(self) -> usize {
        self.attributes().iter().map(|(_, floats)| floats).sum()
    }
}
