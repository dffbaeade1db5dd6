//! Crops of ours: a preparation that is usual for the optics, at any time, seen anywhere.

use crate::{Crop, Outcome, SIDE, culture, pick};
use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Rng, World};

/// What is put under a microscope of some kind.
struct Practice {
    optics: Optics,
    preparations: &'static [&'static str],
}

/// Smears are of blood; what shines is what has a nucleus.
const PRACTICES: [Practice; 5] = [
    Practice { optics: Optics::STAINED, preparations: &["hunt"] },
    Practice {
        optics: Optics::PHASE_CONTRAST,
        preparations: &["bacteria", "bacteria", "cells", "cells", "hunt", "divide"],
    },
    Practice { optics: Optics::BRIGHT_FIELD, preparations: &["hunt", "pond", "cells"] },
    Practice { optics: Optics::DIC, preparations: &["hunt", "pond", "cells"] },
    Practice { optics: Optics::FLUORESCENCE, preparations: &["bacteria", "cells", "cells", "hunt", "divide"] },
];
/// Sides of a pixel that the objectives used for a preparation give, micrometres; a smear is always seen with one.
const PIXELS: [(&str, [f32; 2]); 5] = [
    ("bacteria", [0.05, 0.13]),
    ("cells", [0.1, 0.39]),
    ("hunt", [0.08, 0.19]),
    ("divide", [0.1, 0.22]),
    ("pond", [0.15, 0.52]),
];
const SMEAR: f32 = 1.0 / 12.6;
/// Longest that a scenario runs before it is seen, s.
const LATEST: f64 = 8.0;
/// Side of the field that a camera takes, of which a crop is one part as of the references, pixels.
const FIELD: usize = 384;
/// Shares of a grey picture's pixels that are black and white: so the references were made, except fluorescence, whose white
/// is rarer.
const BLACK: f32 = 0.002;
const WHITE: [f32; 2] = [0.998, 0.9995];

/// The optics that a file of references is named after, if any.
pub(crate) fn optics_of(name: &str) -> Option<Optics> {
    let named = |practice: &&Practice| name.starts_with(&practice.optics.name().replace('-', "_"));
    PRACTICES.iter().find(named).map(|practice| practice.optics)
}

/// The world of a preparation, at any time if it is a scenario.
fn world_of(name: &str, rng: &mut Rng) -> Outcome<World> {
    let time = LATEST * f64::from(rng.unit());
    match name {
        "bacteria" => return Ok(culture::bacteria(rng)?),
        "cells" => return Ok(culture::cells(rng)?),
        _ => {}
    }
    let mut scenario = Scenario::parse(builtin(name).ok_or(name)?.text, &[])?;
    scenario.set_seed(u64::from(rng.next_u32()));
    let built = scenario.build()?;
    let (mut world, mut script) = (built.world, built.script);
    while world.time() < time {
        let inputs = script.before_step(&mut world);
        world.step(inputs);
    }
    Ok(world)
}

/// A crop in these optics, or in any.
pub(crate) fn ours(optics: Option<Optics>, rng: &mut Rng) -> Outcome<Crop> {
    let any = &PRACTICES[pick(rng, PRACTICES.len())];
    let practice = PRACTICES.iter().find(|practice| Some(practice.optics) == optics).unwrap_or(any);
    let name = practice.preparations[pick(rng, practice.preparations.len())];
    let world = world_of(name, rng)?;
    let size = world.config().size;
    let [finest, coarsest] = PIXELS.iter().find(|pixels| pixels.0 == name).ok_or(name)?.1;
    let any = finest * (coarsest / finest).powf(rng.unit());
    let pixel = if practice.optics == Optics::STAINED { SMEAR } else { any };
    let width = pixel * FIELD as f32;
    let centre = aim(&world, width, rng).clamp(Vec2::splat(0.5 * width), size - 0.5 * width);
    let film = Film::DIGITAL;
    let field = Field { centre, width, pixels: [FIELD as u32; 2] };
    let exposure = Microscope { optics: practice.optics, film }.expose(&world, field)?;
    let mut bytes = exposure.rows(0..FIELD);
    if practice.optics == Optics::FLUORESCENCE {
        one_dye(&mut bytes, rng);
    }
    if practice.optics != Optics::STAINED {
        stretch(&mut bytes, WHITE[usize::from(practice.optics == Optics::FLUORESCENCE)]);
    }
    let [left, top] = [(); 2].map(|()| pick(rng, FIELD - SIDE + 1));
    let row = |y: usize| ((top + y) * FIELD + left) * 3..((top + y) * FIELD + left + SIDE) * 3;
    let origin = format!(
        "ours {name} --at {} --view {},{},{width} --optics {} {left} {top}",
        world.time(),
        centre.x,
        centre.y,
        practice.optics.name()
    );
    Ok(Crop { bytes: (0..SIDE).flat_map(|y| bytes[row(y)].to_vec()).collect(), origin })
}

/// Where a camera is pointed: at something, mostly at one of the largest things.
fn aim(world: &World, width: f32, rng: &mut Rng) -> Vec2 {
    let view = world.view();
    let mut things: Vec<(f32, Vec2)> = view
        .organisms()
        .map(|organism| {
            let (low, high) = organism.bounds();
            ((high - low).max_element(), 0.5 * (low + high))
        })
        .collect();
    let largest = things.iter().map(|thing| thing.0).fold(0.0, f32::max);
    if rng.unit() < 0.7 {
        things.retain(|thing| thing.0 > 0.5 * largest);
    }
    let aside = Vec2::new(rng.unit(), rng.unit()) - 0.5;
    things.get(pick(rng, things.len())).map_or(0.5 * world.config().size, |thing| thing.1 + aside * width * 0.45)
}

/// A camera without colours sees one dye: nucleic acid, cytoplasm, or, laid over each other as colours, both.
fn one_dye(bytes: &mut [u8], rng: &mut Rng) {
    let kind = pick(rng, 10);
    for pixel in bytes.chunks_exact_mut(3) {
        match kind {
            0 => pixel[0] = 0,
            1..=3 => pixel.fill(pixel[1]),
            _ => pixel.fill(pixel[2]),
        }
    }
}

/// Gives the darkest and the brightest pixels of each colour black and white.
fn stretch(bytes: &mut [u8], white: f32) {
    for channel in 0..3 {
        let mut sorted: Vec<u8> = bytes.iter().skip(channel).step_by(3).copied().collect();
        sorted.sort_unstable();
        let [low, high] = [BLACK, white].map(|share| f32::from(sorted[(share * (sorted.len() - 1) as f32) as usize]));
        for byte in bytes.iter_mut().skip(channel).step_by(3) {
            *byte = (255.0 * (f32::from(*byte) - low) / (high - low).max(1.0)).clamp(0.0, 255.0) as u8;
        }
    }
}
