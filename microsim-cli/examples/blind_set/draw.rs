//! Crops of ours: any scenario, at any time, seen anywhere.

use crate::{Crop, Outcome, SIDE, pick};
use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_core::scenario::{Scenario, builtin};
use microsim_core::{Rng, World};

const SCENARIOS: [&str; 7] = ["hunt", "demo", "pond", "divide", "squeeze", "absorb-rigid", "absorb-agar"];
const OPTICS: [Optics; 5] =
    [Optics::STAINED, Optics::PHASE_CONTRAST, Optics::BRIGHT_FIELD, Optics::DIC, Optics::FLUORESCENCE];
/// Longest that a scenario runs before it is seen, s.
const LATEST: f64 = 8.0;
/// Sides of a pixel that objectives of different power give, micrometres; a smear is always seen with the strongest.
const PIXELS: [f32; 3] = [1.0 / 12.6, 0.12, 0.2];

/// The world of a built-in scenario at this time, s.
fn world_at(name: &str, seed: u64, time: f64) -> Outcome<World> {
    let mut scenario = Scenario::parse(builtin(name).ok_or(name)?.text, &[])?;
    scenario.set_seed(seed);
    let built = scenario.build()?;
    let (mut world, mut script) = (built.world, built.script);
    while world.time() < time {
        let inputs = script.before_step(&mut world);
        world.step(inputs);
    }
    Ok(world)
}

pub(crate) fn ours(rng: &mut Rng) -> Outcome<Crop> {
    let name = SCENARIOS[pick(rng, SCENARIOS.len())];
    let optics = OPTICS[pick(rng, OPTICS.len())];
    let pixel = if optics == Optics::STAINED { PIXELS[0] } else { PIXELS[pick(rng, PIXELS.len())] };
    let (seed, time) = (u64::from(rng.next_u32() % 1000), LATEST * pick(rng, 1000) as f64 / 1000.0);
    let world = world_at(name, seed, time)?;
    // Near something, as whoever takes pictures would look for it.
    let view = world.view();
    let organisms: Vec<Vec2> = view
        .organisms()
        .map(|organism| {
            let (low, high) = organism.bounds();
            0.5 * (low + high)
        })
        .collect();
    let width = pixel * SIDE as f32;
    let aside = Vec2::new(pick(rng, 100) as f32, pick(rng, 100) as f32) / 100.0 - 0.5;
    let centre =
        organisms.get(pick(rng, organisms.len())).map_or(0.5 * world.config().size, |at| *at + aside * width * 0.8);
    let field = Field { centre, width, pixels: [SIDE as u32; 2] };
    let exposure = Microscope { optics, film: Film::DIGITAL }.expose(&world, field)?;
    let origin = format!(
        "ours {name} --seed {seed} --at {time} --view {},{},{width} --optics {}",
        centre.x,
        centre.y,
        optics.name()
    );
    Ok(Crop { bytes: exposure.rows(0..SIDE), origin })
}
