//! Drains: what 10,000 particles cost that lie in one and are not for it, and what taking all of them at once costs.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use microsim_benches::{on_one_thread, time_of_phase};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, Drain, FluidBlockSpec, FluidParams, Inputs, Kind, Phase, Placement, Region, World, WorldConfig,
};

/// Discs, or particles of fluid, along each side.
const SIDE: u16 = 100;

fn tank() -> World {
    let size = Vec2::new(2.2 * f32::from(SIDE), 2.2 * f32::from(SIDE));
    World::new(WorldConfig { size, ..WorldConfig::default() }).expect("the settings are valid")
}

/// Particles of one fluid.
fn fluid() -> World {
    let mut world = tank();
    let block = Vec2::new(f32::from(SIDE) + 0.5, f32::from(SIDE) * 0.866 + 0.2);
    let spec = FluidBlockSpec { size: block, fluid: FluidParams::default() };
    world.spawn(&spec.into(), Placement::at(block.x, block.y)).expect("the block fits");
    world.step(&Inputs::new());
    world
}

/// As many organisms of one disc each.
fn discs() -> World {
    let mut world = tank();
    for k in 0..SIDE * SIDE {
        let at = 2.1 * Vec2::new(f32::from(k % SIDE), f32::from(k / SIDE)) + 2.0;
        world.spawn(&AgarSpec::default().into(), Placement::at(at.x, at.y)).expect("there is room");
    }
    world.step(&Inputs::new());
    world
}

fn drains(criterion: &mut Criterion) {
    for (name, world) in [("fluid", fluid()), ("discs", discs())] {
        let mut group = criterion.benchmark_group(format!("drains/{name}"));
        group.sample_size(20);
        for count in [0, 1, 100] {
            let mut world = world.clone();
            for _ in 0..count {
                let drain = Drain { region: Region::All, kind: Some(Kind::Coccus) };
                world.add_drain(drain).expect("the drain is valid");
            }
            let name = format!("conclude/{count}");
            group.bench_function(name, |bencher| {
                bencher.iter_custom(|steps| time_of_phase(&world, steps, Phase::Conclude));
            });
        }
        let with_drain = || {
            let mut world = world.clone();
            world.add_drain(Drain { region: Region::All, kind: None }).expect("the drain is valid");
            world
        };
        let step = |world: &mut World| on_one_thread(|| world.step(&Inputs::new()));
        group.bench_function("step", |bencher| bencher.iter_batched_ref(|| world.clone(), step, BatchSize::LargeInput));
        group.bench_function("step that takes all", |bencher| {
            bencher.iter_batched_ref(with_drain, step, BatchSize::LargeInput);
        });
    }
}

criterion_group!(benches, drains);
criterion_main!(benches);
