//! Crops of ours: any scenario, at any time, seen anywhere inside the room.

use crate::{Crop, Outcome, SIDE, pick};
use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_core::organisms::Kind;
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Rng, World};

const SCENARIOS: [&str; 7] = ["hunt", "demo", "pond", "divide", "squeeze", "absorb-rigid", "absorb-agar"];
const OPTICS: [Optics; 5] =
    [Optics::STAINED, Optics::PHASE_CONTRAST, Optics::BRIGHT_FIELD, Optics::DIC, Optics::FLUORESCENCE];
/// Scenarios with blood: smears are of it. Fewest red cells of a view of a smear: references of it are taken where cells lie.
const BLOOD: [&str; 2] = ["hunt", "game"];
const LEAST_RED: usize = 8;
/// Sides of a pixel, micrometres, that references of each kind of optics have, in the order of `OPTICS`; a field is no wider than
/// the room.
const PIXELS: [[f32; 2]; 5] = [[0.074, 0.085], [0.12, 0.60], [0.05, 0.12], [0.06, 0.20], [0.10, 0.40]];
/// Longest that a scenario runs before it is seen, s.
const LATEST: f64 = 8.0;
/// Side of the field that a camera takes, of which a crop is one part as of the references, pixels.
const FIELD: usize = 384;
/// Share of the views that are aimed at one of the largest things; in smears most show red cells alone.
const LARGEST: [f32; 2] = [0.7, 0.3];
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

/// A scenario, its world, and the middle and the width of a view of it.
fn viewed(kind: usize, rng: &mut Rng) -> Outcome<(&'static str, World, Vec2, f32)> {
    let is_smear = OPTICS[kind] == Optics::STAINED;
    let scenarios = if is_smear { &BLOOD[..] } else { &SCENARIOS };
    let name = scenarios[pick(rng, scenarios.len())];
    let world = world_of(name, rng)?;
    let size = world.config().size;
    let [finest, coarsest] = PIXELS[kind];
    let width = (finest * (coarsest / finest).powf(rng.unit()) * FIELD as f32).min(size.min_element());
    let margin = Vec2::splat(0.5 * width).min(0.5 * size);
    let largest = LARGEST[usize::from(is_smear)];
    let centre = aim(&world, width, largest, rng).clamp(margin, size - margin);
    Ok((name, world, centre, width))
}

/// Red cells whose middles lie in a view.
fn red_cells(world: &World, centre: Vec2, width: f32) -> usize {
    let middle = |(low, high): (Vec2, Vec2)| 0.5 * (low + high) - centre;
    let is_seen = |at: Vec2| at.abs().max_element() < 0.5 * width;
    let view = world.view();
    view.organisms().filter(|organism| organism.kind() == Kind::RedCell && is_seen(middle(organism.bounds()))).count()
}

/// A crop in these optics, or in any.
pub(crate) fn ours(optics: Option<Optics>, rng: &mut Rng) -> Outcome<Crop> {
    let kind = OPTICS.iter().position(|known| Some(*known) == optics).unwrap_or_else(|| pick(rng, OPTICS.len()));
    let optics = OPTICS[kind];
    let (name, world, centre, width) = loop {
        let (name, world, centre, width) = viewed(kind, rng)?;
        if optics != Optics::STAINED || red_cells(&world, centre, width) >= LEAST_RED {
            break (name, world, centre, width);
        }
    };
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

/// Where a camera is pointed: at something, in this share of the cases at one of the largest things.
fn aim(world: &World, width: f32, share: f32, rng: &mut Rng) -> Vec2 {
    let view = world.view();
    let mut things: Vec<(f32, Vec2)> = view
        .organisms()
        .map(|organism| {
            let (low, high) = organism.bounds();
            ((high - low).max_element(), 0.5 * (low + high))
        })
        .collect();
    let largest = things.iter().map(|thing| thing.0).fold(0.0, f32::max);
    if rng.unit() < share {
        things.retain(|thing| thing.0 > 0.5 * largest);
    }
    let aside = Vec2::new(rng.unit(), rng.unit()) - 0.5;
    things.get(pick(rng, things.len())).map_or(0.5 * world.config().size, |thing| thing.1 + aside * width * 0.45)
}

/// A camera without colours sees one dye: nucleic acid or cytoplasm.
fn one_dye(bytes: &mut [u8], rng: &mut Rng) {
    let channel = if pick(rng, 3) == 0 { 1 } else { 2 };
    for pixel in bytes.chunks_exact_mut(3) {
        pixel.fill(pixel[channel]);
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
