//! Bright field of a Romanowsky stain: each dye takes its colours out of white light (Beer and Lambert).
//!
//! `I_rgb = background exp(-(haemoglobin eps_1 + cytoplasm eps_2 + nucleus eps_3)) (1 - z_rgb Lap phi)`. The colours are
//! measured ones of stained smears. `z_rgb` is the defocus that remains: a simple objective does not focus all colours in
//! one plane, nor in one place, which makes edges violet on one side of everything and pale yellow on the other.

use super::mode::{Mode, Optics, Shader};
use super::sampler::Sampler;
use crate::bare_text::bare_text;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{larger, smaller};
use crate::microscope::matter::Matter;
use crate::microscope::noise::{octaves, shift_of};
use glam::Vec2;

/// A field without a specimen: 204, 208, 204 of 255.
const BACKGROUND: [f32; 3] = [0.799, 0.815, 0.800];
/// Optical densities in red, green and blue: red cells, eosin and its like in cytoplasm, azure and methylene blue, which leave
/// more blue than there is around them, as cameras that enhance colours show them.
const HAEMOGLOBIN: [f32; 3] = [0.100, 0.275, 0.215];
const CYTOPLASM: [f32; 3] = [0.115, 0.290, 0.045];
const NUCLEUS: [f32; 3] = [0.40, 0.80, -0.06];
/// What dries on the glass between the cells: plasma with a little of each dye, drawn out along the smear.
const PLASMA: [f32; 3] = [0.021, 0.012, 0.017];
/// A tone curve: density `d` counts as `d / (1 + TONE d)`, so that what lies over each other is less dark than their sum.
const TONE: f32 = 0.22;
/// Defocus over the wave number in red, green and blue, square micrometres per radian.
const DEFOCUS: [f32; 3] = [-0.0034, -0.0028, -0.0014];
/// Distance over which the curvature of the delay is taken, micrometres.
const STEP: f32 = 0.24;
/// By how much of that the defocus differs from place to place, because a smear is not level, over which distance,
/// micrometres, and by how much the dyes take up more blue light here than there.
const UNLEVEL: [f32; 3] = [1.3, 40.0, 0.3];
/// Where the blue image lies from the others, and half the distance of two images of which it is the mean: the objective
/// is not corrected for blue.
const BLUE_SHIFT: Vec2 = Vec2::new(-0.04, -0.21);
const BLUE_BLUR: Vec2 = Vec2::new(0.10, 0.07);

/// Length and width of the streaks of plasma, micrometres, their direction, and the noise that they are.
const PLASMA_SIZE: Vec2 = Vec2::new(11.0, 3.4);
const PLASMA_WAY: Vec2 = Vec2::new(0.8, 0.6);
const PLASMA_SEED: u32 = 0x57a1;
/// A dry smear is not thicker where a living cell is: cytoplasm counts as `c / (DRY[0] + DRY[1] c)`.
const DRY: [f32; 2] = [0.7, 0.3];
/// Haemoglobin below nothing is a drop or a bubble that was caught as the smear dried. It bends light: a lack `l` of it, at
/// most `DEEPEST`, lets through `1 - DARK l + BRIGHT l^2` of each colour, so that there is a bright middle in a dark ring.
const DEEPEST: f32 = 1.0;
const DARK: f32 = 2.2;
const BRIGHT: [f32; 3] = [2.75, 2.5, 2.7];
/// Red cells that dry over each other sink into each other: of haemoglobin beyond that of one, which comes first, the share
/// that follows does not count.
const PRESSED: [f32; 2] = [1.05, 0.84];

const GLSL: Glsl = Glsl {
    source: bare_text!("stained.glsl", "//"),
    constants: &[
        ("BACKGROUND", &BACKGROUND),
        ("HAEMOGLOBIN", &HAEMOGLOBIN),
        ("CYTOPLASM", &CYTOPLASM),
        ("NUCLEUS", &NUCLEUS),
        ("PLASMA", &PLASMA),
        ("DEFOCUS", &DEFOCUS),
        ("STEP", &[STEP]),
        ("UNLEVEL", &UNLEVEL),
        ("DRY", &DRY),
        ("DEEPEST", &[DEEPEST]),
        ("DARK", &[DARK]),
        ("BRIGHT", &BRIGHT),
        ("PRESSED", &PRESSED),
        ("TONE", &[TONE]),
        ("BLUE_SHIFT", &[BLUE_SHIFT.x, BLUE_SHIFT.y]),
        ("BLUE_BLUR", &[BLUE_BLUR.x, BLUE_BLUR.y]),
        ("PLASMA_SIZE", &[PLASMA_SIZE.x, PLASMA_SIZE.y]),
        ("PLASMA_WAY", &[PLASMA_WAY.x, PLASMA_WAY.y]),
        ("PLASMA_SHIFT", &shift_of(PLASMA_SEED)),
    ],
};

impl Optics {
    /// Bright field of a smear in a Romanowsky stain, such as Wright's.
    pub const STAINED: Self = Self(&MODE);
}

const MODE: Mode = Mode {
    name: "stained",
    is_bright: true,
    channels: 3,
    surround: None,
    blur: 0.15,
    ground: BACKGROUND,
    grain: 0.78,
    shader: Shader::Light(shade, &GLSL),
};

fn shade(sampler: &Sampler<'_>, x: usize, y: usize) -> [f32; 3] {
    let mut blue = sampler.matter_beside(x, y, BLUE_SHIFT + BLUE_BLUR);
    blue += sampler.matter_beside(x, y, BLUE_SHIFT - BLUE_BLUR);
    let (here, blue) = (sampler.matter(x, y), blue * 0.5);
    let lack = [here, here, blue].map(|matter| smaller(larger(-matter.haemoglobin, 0.0), DEEPEST));
    let (here, blue) = (dyes(here), dyes(blue));
    let place = sampler.raster.grid.place(x, y);
    let plasma = octaves(PLASMA_WAY.rotate(place) / PLASMA_SIZE, 2, PLASMA_SEED);
    let uneven = octaves(place / UNLEVEL[1], 1, PLASMA_SEED);
    let curvature = (1.0 + UNLEVEL[0] * uneven) * sampler.curvature(x, y, STEP).clamp(-20.0, 20.0);
    let density = [here[0], here[1], blue[2] * (1.0 + UNLEVEL[2] * uneven)];
    std::array::from_fn(|k| {
        let density = density[k] + PLASMA[k] * plasma;
        let density = density / (1.0 + TONE * density.abs());
        let bent = 1.0 - lack[k] * (DARK - BRIGHT[k] * lack[k]);
        BACKGROUND[k] * libm::expf(-density) * (1.0 - DEFOCUS[k] * curvature) * bent
    })
}

/// Optical densities of matter in red, green and blue.
fn dyes(matter: Matter) -> [f32; 3] {
    let cytoplasm = larger(matter.cytoplasm, 0.0);
    let cytoplasm = cytoplasm / (DRY[0] + DRY[1] * cytoplasm);
    let haemoglobin = larger(matter.haemoglobin, 0.0);
    let haemoglobin = haemoglobin - PRESSED[1] * larger(haemoglobin - PRESSED[0], 0.0);
    std::array::from_fn(|k| HAEMOGLOBIN[k] * haemoglobin + CYTOPLASM[k] * cytoplasm + NUCLEUS[k] * matter.nucleus)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::microscope::matter::MatterRaster;
    use crate::microscope::raster::PixelGrid;

    /// Light behind an even layer that lacks this much haemoglobin.
    fn behind(lack: f32) -> [f32; 3] {
        let grid = PixelGrid { corner: Vec2::ZERO, pixel: 0.1, columns: 21, top: 0, rows: 21 };
        let matter = Matter { haemoglobin: -lack, ..Matter::NONE };
        let raster = MatterRaster { grid, matter: vec![matter; grid.len()] };
        shade(&Sampler { raster: &raster, surround: None }, 10, 10)
    }

    #[test]
    fn a_drop_is_bright_and_pink_in_its_middle_and_dark_around_it() {
        let [ground, ring, middle] = [0.0, 0.4, 1.0].map(behind);
        assert!(
            (0..3).all(|k| ring[k] < 0.7 * ground[k] && middle[k] > 1.2 * ground[k]),
            "{ground:?} {ring:?} {middle:?}"
        );
        assert!(middle[0] / ground[0] > middle[1] / ground[1] + 0.1);
    }
}
