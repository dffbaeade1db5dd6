//! The programs: which formulas each is made of, and what it is fed.

use super::{LIGHT_RANGE, LONGEST, WAVE_RANGE};
use crate::microscope::formula::Formula;
use crate::microscope::optics::{Optics, SIGHT, Shade};
use crate::microscope::specimen::{amoeboid, chamber, ground, outline, round, spot};
use crate::microscope::{film, maths, matter, noise, painting, wave};
use std::fmt::Write as _;

/// Something that a graphics card runs for each pixel of some triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Program {
    /// Uneven glass, on all of the slide.
    Ground,
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
    /// Its blur along rows.
    SpreadAcross,
    /// Its blur along columns.
    SpreadAlong,
    /// An image; not for [`Optics::Classic`].
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
pub struct Source {
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

type Uniforms = &'static [(&'static str, usize, usize)];

const CORNER: &[(&str, usize)] = &[("corner", 2)];
const PLACE: &[(&str, usize)] = &[("place", 2)];
const ROUND: &[(&str, usize)] =
    &[("centre", 2), ("rim", 3), ("facing", 2), ("matter", 4), ("profile", 4), ("grains", 4)];
const SPOT: &[(&str, usize)] = &[("at", 2), ("corner", 2), ("size", 2), ("matter", 4)];
const THREAD: &[(&str, usize)] = &[("from", 2), ("to", 2), ("corner", 2), ("form", 2), ("matter", 4)];
const PAINTED: &[(&str, usize)] = &[("place", 2), ("texture_place", 2), ("colour", 4), ("rim", 4), ("noise", 3)];

const MATTER: Uniforms = &[("view", 4, 1), ("pixel", 2, 1), ("scale", 4, 1)];
const VIEW: Uniforms = &[("view", 4, 1)];
const MAP: Uniforms = &[("map_place", 4, 1), ("map_size", 3, 1)];
const ROOM: Uniforms = &[("room", 4, 1)];
const CODING: Uniforms = &[("matter_scale", 4, 1), ("matter_bias", 4, 1)];
const AMOEBOID: Uniforms = &[
    ("middle", 4, 1),
    ("own_frame", 4, 1),
    ("front", 4, 1),
    ("lamella", 4, 1),
    ("relief", 4, 1),
    ("matter", 4, 1),
    ("nucleus_matter", 4, 1),
    ("nucleus_texture", 2, 1),
    ("edge", 2, 1),
    ("lobes", 3, amoeboid::LOBES),
    ("shifts", 2, 5),
];
const FILM: Uniforms =
    &[("exposure", 4, 1), ("stock", 4, 1), ("parts", 2, 5), ("image", 4, 1), ("reach", 1, 1), ("weights", 1, LONGEST)];

const SCREEN: Formula = Formula { source: include_str!("../screen.glsl"), constants: &[] };
const BOX: Formula = Formula { source: include_str!("../box.glsl"), constants: &[] };
const SOFTEN: Formula = Formula { source: include_str!("../soften.glsl"), constants: &[] };

impl Program {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        use Program::*;
        let lit = Optics::ALL.into_iter().filter(|optics| matches!(optics.mode().shade, Shade::Light(..)));
        [Ground, Walls, Obstacle, Amoeboid, Round, Ciliate, Spot, Thread, Wave, SpreadAcross, SpreadAlong]
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
    fn attributes(self) -> &'static [(&'static str, usize)] {
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

    fn uniforms(self) -> Vec<(&'static str, usize, usize)> {
        use Program::*;
        let has_surround = matches!(self, Image(optics) if optics.mode().has_surround);
        let parts: &[Uniforms] = match self {
            Ground => &[MATTER, &[("bias", 4, 1), ("shifts", 4, 1)]],
            Walls => &[MATTER, ROOM],
            Obstacle => &[MATTER, MAP, ROOM],
            Amoeboid => &[MATTER, MAP, AMOEBOID],
            Round | Spot | Thread => &[MATTER],
            Ciliate => &[MATTER, &[("frame", 4, 1), ("pellicle", 3, 1)]],
            Wave => &[CODING],
            SpreadAcross | SpreadAlong => &[&[("side", 3, 1), ("weights", 2, LONGEST)]],
            Image(_) if has_surround => &[CODING, &[("area", 4, 1), ("to_surround", 4, 1)]],
            Image(_) => &[CODING, &[("area", 4, 1)]],
            Soften => &[&[("side", 3, 1), ("weights", 1, LONGEST)]],
            Film => &[FILM],
            Page => &[VIEW, ROOM],
            PageObstacle => &[VIEW, MAP, ROOM],
            Painted => &[VIEW],
        };
        parts.concat()
    }

    fn textures(self) -> Vec<&'static str> {
        use Program::*;
        match self {
            Obstacle | Amoeboid | PageObstacle => vec!["noise_table", "map"],
            Wave => vec!["matter_target"],
            SpreadAcross | SpreadAlong => vec!["waves"],
            Image(optics) if optics.mode().has_surround => vec!["matter_target", "noise_table", "surround_target"],
            Image(_) => vec!["matter_target", "noise_table"],
            Soften => vec!["light"],
            Film => vec!["light", "noise_table"],
            _ => vec!["noise_table"],
        }
    }

    /// Words that the formulas look for.
    fn switches(self) -> &'static [&'static str] {
        use Program::*;
        match self {
            Obstacle => &["OBSTACLE"],
            Ciliate => &["PELLICLE"],
            SpreadAcross => &["SPREAD"],
            SpreadAlong => &["SPREAD", "LAST"],
            Image(optics) if optics.mode().has_surround => &["SURROUND"],
            Page => &["PAGE"],
            PageObstacle => &["PAGE", "OBSTACLE"],
            _ => &[],
        }
    }

    /// Its formulas, each after those that it uses.
    fn formulas(self) -> Vec<&'static Formula> {
        use Program::*;
        let drawn = |own: &[&'static Formula]| [&[&maths::FORMULA, &noise::FORMULA, &matter::FORMULA], own].concat();
        match self {
            Ground => drawn(&[&ground::FORMULA]),
            Walls => drawn(&[&BOX, &chamber::FORMULA]),
            Obstacle => drawn(&[&BOX, &outline::FORMULA, &chamber::FORMULA]),
            Amoeboid => drawn(&[&BOX, &outline::FORMULA, &amoeboid::FORMULA]),
            Round | Ciliate => drawn(&[&round::FORMULA]),
            Spot => drawn(&[&spot::SPOT]),
            Thread => drawn(&[&spot::THREAD]),
            Wave | SpreadAcross | SpreadAlong => vec![&wave::FORMULA, &wave::SURROUND],
            Image(optics) => match &optics.mode().shade {
                Shade::Light(_, formula) => vec![&noise::FORMULA, &wave::FORMULA, &SIGHT, formula],
                Shade::Painted => Vec::new(),
            },
            Soften => vec![&SOFTEN],
            Film => vec![&noise::FORMULA, &film::FORMULA],
            Page | Painted => vec![&maths::FORMULA, &noise::FORMULA, &painting::FORMULA],
            PageObstacle => vec![&maths::FORMULA, &noise::FORMULA, &outline::FORMULA, &painting::FORMULA],
        }
    }

    /// Whether its vertices are those of one big square, and its formulas are for pixels only.
    fn is_on_screen(self) -> bool {
        use Program::*;
        matches!(self, Wave | SpreadAcross | SpreadAlong | Image(_) | Soften | Film)
    }

    /// Its text, and what it wants.
    #[must_use]
    pub fn source(self) -> Source {
        let mut head = "#version 100\nprecision highp float;\nprecision highp int;\n".to_owned();
        self.switches().iter().for_each(|word| _ = writeln!(head, "#define {word}"));
        _ = writeln!(head, "#define LONGEST {LONGEST}\n#define LOBES {}", amoeboid::LOBES);
        _ = writeln!(head, "const float WAVE_RANGE = {WAVE_RANGE:?};\nconst float LIGHT_RANGE = {LIGHT_RANGE:?};");
        let (mut vertex, mut fragment) = (format!("{head}#define VERTEX\n"), head);
        self.formulas().into_iter().for_each(|formula| formula.write(&mut fragment));
        if self.is_on_screen() {
            SCREEN.write(&mut vertex);
        } else {
            self.formulas().into_iter().for_each(|formula| formula.write(&mut vertex));
        }
        if let Self::Image(_) = self {
            fragment.push_str("\nvoid main() {\n    gl_FragColor = vec4(shade() / LIGHT_RANGE, 1.0);\n}\n");
        }
        let (attributes, uniforms, textures) = (self.attributes(), self.uniforms(), self.textures());
        Source { vertex, fragment, attributes, uniforms, textures }
    }
}
