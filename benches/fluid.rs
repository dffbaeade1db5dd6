//! Fluid: a block that settles under gravity with the substeps that fluid alone needs, and the membrane and cytoplasm of
//! amoeboid cells; an element is a particle.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use microsim_benches::{time_of_phase, warmed_up};
use microsim_core::glam::Vec2;
use microsim_core::{AmoeboidCellSpec, FluidBlockSpec, FluidParams, Phase, Placement, World, WorldConfig};

/// A block of so many particles in rows and columns, in a tank a quarter wider.
fn block(side: u16) -> World {
    let side = f32::from(side);
    let block = Vec2::new(side + 0.5, side * 0.866 + 0.2);
    let (size, gravity) = (block * Vec2::new(1.25, 1.5), Vec2::new(0.0, -10.0));
    let config = WorldConfig { size, gravity, substeps: 2, max_speed: 90.0, ..WorldConfig::default() };
    let mut world = World::new(config).expect("the settings are valid");
    let fluid = FluidParams { viscosity: 30.0, ..FluidParams::default() };
    let place = Placement::at(block.x * 0.5, block.y * 0.5);
    world.spawn(&FluidBlockSpec { size: block, fluid }.into(), place).expect("the block fits");
    warmed_up(world)
}

/// Four amoeboid cells at rest.
fn cells() -> World {
    let mut world = World::new(WorldConfig::default()).expect("the settings are valid");
    for k in 0..4u8 {
        let place = Placement::at(20.0 + 35.0 * f32::from(k), 45.0);
        world.spawn(&AmoeboidCellSpec::default().into(), place).expect("there is room");
    }
    warmed_up(world)
}

fn fluid(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("fluid");
    let mut measure = |name: &str, world: &World, phase: Phase| {
        group.throughput(Throughput::Elements(world.census().particles as u64));
        group.bench_function(name, |bencher| bencher.iter_custom(|steps| time_of_phase(world, steps, phase)));
    };
    for side in [32, 100, 200] {
        measure(&format!("block/{}", u32::from(side) * u32::from(side)), &block(side), Phase::ProjectFluids);
    }
    let cells = cells();
    measure("cells/cytoplasm", &cells, Phase::ProjectFluids);
    measure("cells/membranes", &cells, Phase::ProjectConstraints);
}

criterion_group!(benches, fluid);
criterion_main!(benches);
