//! Crops of ours: any scenario, at any time, seen anywhere inside the room.

use crate::{Crop, Outcome, SIDE, pick};
use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Rng, World};

const SCENARIOS: [&str; 7] = ["hunt", "demo", "pond", "divide", "squeeze", "absorb-rigid", "absorb-agar"];
const OPTICS: [Optics; 5] =
    [Optics::STAINED, Optics::PHASE_CONTRAST, Optics::BRIGHT_FIELD, Optics::DIC, Optics::FLUORESCENCE];
/// Sides of a pixel that objectives give, micrometres; a smear is always seen with one.
const PIXELS: [f32; 2] = [0.08, 0.22];
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
    OPTICS.into_iter().find(|optics| name.starts_with(&optics.name().replace('-', "_")))
}

/// The world of a scenario, with any seed at any time.
fn world_of(name: &str, rng: &mut Rng) -> Outcome<World> {
    let time = LATEST * f64::from(rng.unit());
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
    let optics = optics.unwrap_or(OPTICS[pick(rng, OPTICS.len())]);
    let name = SCENARIOS[pick(rng, SCENARIOS.len())];
    let world = world_of(name, rng)?;
    let size = world.config().size;
    let [finest, coarsest] = PIXELS;
    let any = finest * (coarsest / finest).powf(rng.unit());
    let pixel = if optics == Optics::STAINED { SMEAR } else { any };
    let width = pixel * FIELD as f32;
    let margin = Vec2::splat(0.5 * width).min(0.5 * size);
    let centre = aim(&world, width, rng).clamp(margin, size - margin);
    let film = if optics == Optics::STAINED { Film::PHOTO } else { Film::DIGITAL };
    let field = Field { centre, width, pixels: [FIELD as u32; 2] };
    let exposure = Microscope { optics, film }.expose(&world, field)?;
    let mut bytes = exposure.rows(0..FIELD);
    if optics == Optics::FLUORESCENCE {
        one_dye(&mut bytes, rng);
    }
    if optics != Optics::STAINED {
        stretch(&mut bytes, WHITE[usize::from(optics == Optics::FLUORESCENCE)]);
    }
    let [left, top] = [(); 2].map(|()| pick(rng, FIELD - SIDE + 1));
    let row = |y: usize| ((top + y) * FIELD + left) * 3..((top + y) * FIELD + left + SIDE) * 3;
    let origin = format!(
        "ours {name} --seed {} --at {} --view {},{},{width} --optics {} {left} {top}",
        world.config().seed,
        world.time(),
        centre.x,
        centre.y,
        optics.name()
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
