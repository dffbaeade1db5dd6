//! The GLSL of each program, and the uniforms and textures that it is fed.

use crate::bare_text::bare_text;
use crate::microscope::film::SHADOWS;
use crate::microscope::glsl::Glsl;
use crate::microscope::optics::{Shader, sampler};
use crate::microscope::recipe::{GlslSource, Program};
use crate::microscope::specimen::{amoeboid, background, chamber, distance_field, round, spot, thread};
use crate::microscope::{film, maths, matter, noise, painting, surround_wave, wave};
use std::fmt::Write as _;

/// Longest half of a blur's kernel, its middle included, pixels.
pub(super) const LONGEST: usize = 24;
/// Largest amplitude of a wave, and largest brightness of an image, that targets hold.
const WAVE_RANGE: f32 = 1.2;
const LIGHT_RANGE: f32 = 1.5;

/// Names, numbers of floats, lengths of arrays.
type Uniforms = &'static [(&'static str, usize, usize)];

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
    ("nucleus_texture", 3, 1),
    ("edge", 2, 1),
    ("lobes", 3, amoeboid::LOBES),
    ("shifts", 2, 5),
];
const FILM: Uniforms = &[
    ("exposure", 4, 1),
    ("stock", 4, 1),
    ("parts", 2, 3),
    ("slide", 3, 3),
    ("gradient", 2, 1),
    ("shadows", 4, SHADOWS),
    ("image", 4, 1),
    ("reach", 1, 1),
    ("weights", 1, LONGEST),
];

const SCREEN: Glsl = Glsl { source: bare_text!("screen.glsl", "//"), constants: &[] };
const BOX: Glsl = Glsl { source: bare_text!("box.glsl", "//"), constants: &[] };
const SOFTEN: Glsl = Glsl { source: bare_text!("soften.glsl", "//"), constants: &[] };

impl Program {
    fn uniforms(self) -> Vec<(&'static str, usize, usize)> {
        use Program::*;
        let has_surround = matches!(self, Image(optics) if optics.mode().surround.is_some());
        let parts: &[Uniforms] = match self {
            Background => &[MATTER, &[("bias", 4, 1), ("shifts", 4, 1)]],
            Walls => &[MATTER, ROOM],
            Obstacle => &[MATTER, MAP, ROOM],
            Amoeboid => &[MATTER, MAP, AMOEBOID],
            Round | Spot | Thread => &[MATTER],
            Ciliate => &[MATTER, &[("frame", 4, 1), ("pellicle", 3, 1)]],
            Wave | Emission => &[CODING],
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
            Wave | Emission => vec!["matter_target"],
            SpreadAcross | SpreadAlong => vec!["waves"],
            Image(optics) if optics.mode().surround.is_some() => {
                vec!["matter_target", "noise_table", "surround_target"]
            }
            Image(_) => vec!["matter_target", "noise_table"],
            Soften => vec!["light"],
            Film => vec!["light", "noise_table"],
            _ => vec!["noise_table"],
        }
    }

    /// What the GLSL asks for with `#ifdef`.
    fn switches(self) -> &'static [&'static str] {
        use Program::*;
        match self {
            Obstacle => &["OBSTACLE"],
            Ciliate => &["PELLICLE"],
            Emission => &["EMISSION"],
            SpreadAcross => &["SPREAD"],
            SpreadAlong => &["SPREAD", "LAST"],
            Image(optics) if optics.mode().surround.is_some() => &["SURROUND"],
            Page => &["PAGE"],
            PageObstacle => &["PAGE", "OBSTACLE"],
            _ => &[],
        }
    }

    /// The pieces of its GLSL, each after those that it uses.
    fn pieces(self) -> Vec<&'static Glsl> {
        use Program::*;
        let drawn = |own: &[&'static Glsl]| [&[&maths::GLSL, &noise::GLSL, &matter::GLSL], own].concat();
        match self {
            Background => drawn(&[&background::GLSL]),
            Walls => drawn(&[&BOX, &chamber::GLSL]),
            Obstacle => drawn(&[&BOX, &distance_field::GLSL, &chamber::GLSL]),
            Amoeboid => drawn(&[&BOX, &distance_field::GLSL, &amoeboid::nucleus::GLSL, &amoeboid::GLSL]),
            Round | Ciliate => drawn(&[&round::GLSL]),
            Spot => drawn(&[&spot::GLSL]),
            Thread => drawn(&[&thread::GLSL]),
            Wave | Emission | SpreadAcross | SpreadAlong => vec![&wave::GLSL, &surround_wave::GLSL],
            Image(optics) => match &optics.mode().shader {
                Shader::Light(_, glsl) => vec![&noise::GLSL, &wave::GLSL, &sampler::GLSL, glsl],
                Shader::Painted => Vec::new(),
            },
            Soften => vec![&SOFTEN],
            Film => vec![&noise::GLSL, &film::GLSL],
            Page | Painted => vec![&maths::GLSL, &noise::GLSL, &painting::GLSL],
            PageObstacle => vec![&maths::GLSL, &noise::GLSL, &distance_field::GLSL, &painting::GLSL],
        }
    }

    /// Whether its vertices are the corners of the target, and its GLSL is for pixels only.
    fn covers_target(self) -> bool {
        use Program::*;
        matches!(self, Wave | Emission | SpreadAcross | SpreadAlong | Image(_) | Soften | Film)
    }

    /// Its GLSL, and the names of its inputs.
    #[must_use]
    pub fn source(self) -> GlslSource {
        let mut head = "#version 100\nprecision highp float;\nprecision highp int;\n".to_owned();
        self.switches().iter().for_each(|word| _ = writeln!(head, "#define {word}"));
        _ = writeln!(head, "#define LONGEST {LONGEST}\n#define SHADOWS {SHADOWS}\n#define LOBES {}", amoeboid::LOBES);
        _ = writeln!(head, "const float WAVE_RANGE = {WAVE_RANGE:?};\nconst float LIGHT_RANGE = {LIGHT_RANGE:?};");
        let (mut vertex, mut fragment) = (format!("{head}#define VERTEX\n"), head);
        self.pieces().into_iter().for_each(|piece| piece.write(&mut fragment));
        if self.covers_target() {
            SCREEN.write(&mut vertex);
        } else {
            self.pieces().into_iter().for_each(|piece| piece.write(&mut vertex));
        }
        if let Self::Image(_) = self {
            fragment.push_str("\nvoid main() {\n    gl_FragColor = vec4(shade() / LIGHT_RANGE, 1.0);\n}\n");
        }
        let (attributes, uniforms, textures) = (self.attributes(), self.uniforms(), self.textures());
        GlslSource { vertex, fragment, attributes, uniforms, textures }
    }
}
