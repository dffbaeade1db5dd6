//! Short forms of the experiments of docs/validation.md.
#![cfg(feature = "scenario")]
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

#[allow(dead_code, reason = "the page uses the rest")]
#[path = "../examples/validation/experiments/mod.rs"]
mod experiments;

use experiments::crawl::{self, Figures};
use experiments::order::Order;
use experiments::scene::{Stepping, particles};
use experiments::{
    ALL, angle_of_repose, cell_area, chemotactic_index, constriction, diffusion, division, engulfment, free_fall,
    granular_column, granular_energy, hydrostatic_rest, packing, refinement, relaxation, restitution, scene,
};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, BacillusSpec, BrownianParams, CoccusSpec, Controller, Crawl, Emitter, FluidBlockSpec,
    FluidMode, FluidParams, Inputs, OrganismSpec, PersistentWalkParams, Placement, PlateletSpec, Recipe, Region,
    RunAndTumbleParams, World, WorldConfig,
};

/// Steps and substeps in which results are to be the same.
const STEPPINGS: [Stepping; 4] = [
    Stepping::DEFAULT,
    Stepping { dt: 1.0 / 60.0, substeps: 32 },
    Stepping { dt: 1.0 / 240.0, substeps: 8 },
    Stepping { dt: 0.001, substeps: 5 },
];

#[test]
fn what_takes_little_time_agrees_with_what_is_published() {
    let names = [
        "pendulum",
        "spring",
        "oscillations",
        "catenary",
        "coulomb",
        "drag",
        "convergence",
        "point_source",
        "dam_break",
    ];
    for name in names {
        let experiment = ALL.iter().find(|experiment| experiment.name == name).unwrap();
        for row in (experiment.run)().unwrap().rows {
            assert!(row.agrees(), "{name}, {}: {} is not in {:?}", row.what, row.ours, row.accepted);
        }
    }
}

#[test]
fn what_has_no_order_says_why() {
    for experiment in &ALL {
        assert!(!matches!(experiment.order, Order::None(why) if why.is_empty()), "{}", experiment.name);
    }
}

#[test]
fn brownian_bodies_diffuse_by_what_they_are_told_or_by_their_radius() {
    let brownian = Controller::brownian(BrownianParams::default());
    let tracks = diffusion::tracks(&CoccusSpec::default().into(), &brownian, 10.0, 12).unwrap();
    let ours = diffusion::mean_squared_displacement(&tracks, 1.0, 1.0) / 4.0;
    assert!((ours / 0.46 - 1.0).abs() < 0.1, "{ours}");
    for radius in [0.25, 1.0] {
        let mobility = diffusion::mobility(25.0, 0.89);
        let ours = diffusion::diffusion_of_beads(radius, mobility, 15.1, 12).unwrap();
        let expected = mobility / f64::from(radius);
        assert!((ours / expected - 1.0).abs() < 0.12, "radius {radius}: {ours} instead of {expected}");
    }
}

#[test]
fn bacilli_walk_as_fuerth_and_tumble_as_berg_say() {
    let bacillus = OrganismSpec::from(BacillusSpec { speed: 10.0, ..BacillusSpec::default() });
    let walk = Controller::persistent_walk(PersistentWalkParams { persistence: 0.3 });
    let tracks = diffusion::tracks(&bacillus, &walk, 14.0, 10).unwrap();
    let ours = diffusion::mean_squared_displacement(&tracks, 2.0, 0.3);
    let fuerth = 2.0 * 100.0 * 0.09 * (-1.0f64).exp();
    assert!((ours / fuerth - 1.0).abs() < 0.06, "{ours} instead of {fuerth}");
    let berg = Controller::run_and_tumble(RunAndTumbleParams::default());
    let tracks = diffusion::tracks(&BacillusSpec::default().into(), &berg, 62.5, 10).unwrap();
    let [short, long] = [5.0, 10.0].map(|time| diffusion::mean_squared_displacement(&tracks, 2.0, time));
    let ours = (long - short) / 20.0;
    assert!((ours / 104.7 - 1.0).abs() < 0.3, "{ours}");
}

#[test]
fn a_cell_finds_its_way_near_k_and_neither_far_above_nor_far_below() {
    let world = chemotactic_index::gradient(172.0).unwrap();
    let index = |relative: f32| chemotactic_index::index(&world, relative, 1).unwrap();
    let (near, above, below) = (index(1.0), index(1e4), index(1e-4));
    assert!(near > 0.7 && above < 0.6 && below < 0.6, "{near} at K, {above} above, {below} below");
}

#[test]
fn still_water_is_level() {
    let (world, column) = hydrostatic_rest::settle(20.0, 20.0).unwrap();
    let particles = scene::particles(&world, column);
    let speed = hydrostatic_rest::speed(&particles);
    assert!(speed < 0.15, "{speed} units/s");
    let compression = world.quality().fluid_compression_mean;
    assert!(compression < 0.03, "{compression}");
}

#[test]
fn discs_on_a_lattice_stay_as_dense_as_it_is() {
    let [covered, overlap] = packing::hexagonal(12, 2.0).unwrap();
    assert!((covered / 0.9069 - 1.0).abs() < 0.01 && overlap < 0.05, "{covered}, overlap {overlap}");
}

#[test]
fn a_column_of_grains_runs_out_as_far_as_published() {
    let run_out = granular_column::run_out(20.0, &granular_column::collapse([20.0, 3.0], 0.5, 6.0, 1).unwrap());
    assert!((2.0..7.9).contains(&run_out), "{run_out}");
}

#[test]
fn a_narrow_gap_slows_a_cell_down() {
    let [open, half] = [2.0, 0.5].map(|gap| constriction::speed(gap).unwrap());
    assert!(half > 0.0 && half < 0.99 * open, "{half} after {open}");
}

#[test]
fn a_deformed_cell_rounds_up_without_oscillation() {
    let aspects = relaxation::relaxation(8.0, Stepping::DEFAULT).unwrap();
    let (overshoot, left) = (relaxation::overshoot(&aspects), aspects[aspects.len() - 1][1]);
    assert!(overshoot < 0.03 && left < 1.1, "rises by {overshoot}, ends at {left}");
}

#[test]
fn large_prey_takes_longer_and_daughters_are_equal() {
    let time =
        |radius| engulfment::time(&AgarSpec { radius, ..AgarSpec::default() }.into(), Vec2::X, Stepping::DEFAULT);
    let [small, large] = [1.0, 3.0].map(|radius| time(radius).unwrap());
    assert!(small < large && large < 15.0, "{small} s, {large} s");
    let (before, [a, b]) = division::divide(9.0).unwrap();
    assert!((a / (a + b) - 0.5).abs() < 0.05 && ((a + b) / before - 1.0).abs() < 1e-5, "{a} and {b} of {before}");
}

#[test]
fn momentum_is_kept_by_an_impact() {
    for masses in [[1.0, 1.0], [10.0, 1.0], [1.0, 10.0]] {
        for e in [0.0, 0.5] {
            let kept = restitution::momentum_kept(masses, e).unwrap();
            assert!((kept - 1.0).abs() < 1e-3, "{masses:?}, e {e}: {kept}");
        }
    }
}

#[test]
fn free_fall_is_right_in_any_step() {
    for stepping in STEPPINGS.into_iter().chain([(1.0 / 30.0, 2), (1.0 / 60.0, 64), (0.1, 64)].map(stepping)) {
        let [speed, way] = free_fall::fall(stepping).unwrap();
        assert!((speed / 10.0 - 1.0).abs() < 1e-4, "{speed}");
        let euler = 5.0 * (1.0 + stepping.substep());
        assert!((way / euler - 1.0).abs() < 1e-3, "{way} instead of {euler}");
    }
}

fn stepping((dt, substeps): (f32, u32)) -> Stepping {
    Stepping { dt, substeps }
}

#[test]
fn a_cell_that_nobody_drives_stays_where_it_is_and_as_large_as_its_radii_say() {
    for stepping in STEPPINGS {
        let refinement::Rest { way, area: [low, high] } = refinement::rest(stepping, 2.0).unwrap();
        assert!(way < 0.2, "{way} units in substeps of {} s", stepping.substep());
        assert!(low > -0.02 && high < 0.02, "{low} to {high} in substeps of {} s", stepping.substep());
    }
}

#[test]
fn a_small_cell_does_not_burst_in_short_substeps() {
    for stepping in [Stepping::DEFAULT, Stepping::of_substeps(64), Stepping { dt: 0.001, substeps: 5 }] {
        let [low, high] = cell_area::extremes(Vec2::splat(8.0), stepping, 1.0).unwrap();
        assert!(low > -0.02 && high < 0.02, "{low} to {high} in substeps of {} s", stepping.substep());
    }
}

#[test]
fn substeps_that_are_too_short_or_too_long_are_refused_with_field_and_range() {
    for (dt, least, most) in [(0.001, 1, 5), (1.0 / 60.0, 1, 64), (1.0 / 30.0, 2, 64), (0.1, 6, 64)] {
        for (substeps, is_accepted) in [(least - 1, false), (least, true), (most, true), (most + 1, false)] {
            let config = WorldConfig { dt, substeps, ..WorldConfig::default() };
            let refused = config.validate().err().map(|refusal| (refusal.field().to_owned(), refusal.to_string()));
            assert_eq!(refused.is_none(), is_accepted, "{substeps} of {dt} s: {refused:?}");
            let names_range = |message: &str| message.contains(" 1 to ") || message.contains("0.0002 to 0.017 s");
            assert!(refused.is_none_or(|(field, message)| field == "substeps" && names_range(&message)));
        }
    }
}

#[test]
fn substeps_that_are_too_long_for_a_membrane_refuse_cells_and_nothing_else() {
    for (dt, substeps, is_accepted) in
        [(1.0 / 60.0, 2, false), (1.0 / 60.0, 3, true), (1.0 / 30.0, 5, false), (0.006, 1, true)]
    {
        let mut world = World::new(WorldConfig { dt, substeps, ..WorldConfig::default() }).unwrap();
        world.spawn(&PlateletSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0));
        assert_eq!(cell.is_ok(), is_accepted, "{substeps} of {dt} s");
        let Err(refusal) = cell else { continue };
        assert_eq!(refusal.field(), "substeps");
        assert!(refusal.to_string().contains("0.0002 to 0.006 s"), "{refusal}");
    }
}

#[test]
fn substeps_that_are_too_long_for_grains_refuse_them_and_no_other_fluid() {
    for (substeps, is_accepted) in [(6, false), (7, true)] {
        let mut world = World::new(WorldConfig { substeps, ..WorldConfig::default() }).unwrap();
        let block = |mode| {
            let fluid = FluidParams { mode, ..FluidParams::default() };
            OrganismSpec::from(FluidBlockSpec { size: Vec2::splat(10.0), fluid })
        };
        world.spawn(&block(FluidMode::Density), Placement::at(40.0, 45.0)).unwrap();
        let grains = world.spawn(&block(FluidMode::Granular), Placement::at(80.0, 45.0));
        let recipe = Recipe::Organism(block(FluidMode::Granular));
        let emitted = world.add_emitter(Emitter::new(Region::All, recipe, 1.0));
        assert_eq!((grains.is_ok(), emitted.is_ok()), (is_accepted, is_accepted), "{substeps}");
        let Err(refusal) = grains else { continue };
        assert_eq!(refusal.field(), "substeps");
        assert!(refusal.to_string().contains("7 to 64 of a step of 0.016666668 s, with grains"), "{refusal}");
    }
}

#[test]
fn viscosity_that_is_too_high_for_the_substep_is_refused_with_field_and_range() {
    for (substeps, viscosity, is_accepted) in [(2, 60.0, true), (2, 61.0, false), (8, 240.0, true), (8, 241.0, false)] {
        let mut world = World::new(WorldConfig { substeps, ..WorldConfig::default() }).unwrap();
        let block = FluidBlockSpec { fluid: FluidParams { viscosity, ..FluidParams::default() }, ..Default::default() };
        let fluid = world.spawn(&block.clone().into(), Placement::at(80.0, 45.0));
        let emitted = world.add_emitter(Emitter::new(Region::All, Recipe::Organism(block.into()), 1.0));
        assert_eq!((fluid.is_ok(), emitted.is_ok()), (is_accepted, is_accepted), "{viscosity}, {substeps} substeps");
        let Err(refusal) = fluid else { continue };
        assert_eq!(refusal.field(), "viscosity");
        assert!(refusal.to_string().contains(&format!("0 to {}.0 with {substeps}", 30 * substeps)), "{refusal}");
    }
}

#[test]
fn viscosity_is_a_rate() {
    // Two particles half a support radius apart: of their weights, 1 and 1/8, each counts over the rest density, 1.764.
    for (viscosity, Stepping { dt, substeps }) in [
        (10.0, Stepping { dt: 1.0 / 60.0, substeps: 1 }),
        (29.0, Stepping { dt: 1.0 / 60.0, substeps: 1 }),
        (240.0, Stepping::DEFAULT),
        (500.0, Stepping { dt: 0.001, substeps: 1 }),
        (1000.0, Stepping { dt: 0.001, substeps: 5 }),
    ] {
        let config = WorldConfig { dt, substeps, damping: 0.0, ..WorldConfig::default() };
        let mut world = World::new(config).unwrap();
        let fluid = FluidParams { viscosity, ..FluidParams::default() };
        let drop = OrganismSpec::from(FluidBlockSpec { size: Vec2::ONE, fluid });
        let [low, high] = [45.0, 46.0].map(|y| world.spawn(&drop, Placement::at(80.0, y)).unwrap());
        world.push(low, Vec2::new(0.1, 0.0)).unwrap();
        let steps = (4.0 / viscosity / dt).ceil();
        (0..steps as u32).for_each(|_| world.step(&Inputs::new()));
        let [low, high] = [low, high].map(|id| f64::from(particles(&world, id)[0].velocity.x));
        let rate = -((low - high) / 0.1).ln() / f64::from(steps * dt);
        let law = f64::from(viscosity) * 2.0 * 0.125 / 1.764;
        assert!((rate / law - 1.0).abs() < 0.05, "{viscosity} 1/s, {substeps} substeps of {dt} s: {rate}, law {law}");
    }
}

#[test]
fn still_water_comes_to_rest_whatever_the_step() {
    // Walls whose push was no gradient kept it boiling at 0.10, 0.14, 0.43 and 0.43 units/s.
    for substeps in [4, 8, 12, 16] {
        let speed = hydrostatic_rest::speed_of_pool(Stepping::of_substeps(substeps), 20.0).unwrap();
        assert!(speed < 0.03, "{speed} units/s with {substeps} substeps");
    }
}

#[test]
fn agar_is_taken_in_whatever_the_step() {
    for stepping in &STEPPINGS[..3] {
        let absorption = refinement::absorb("absorb-agar", 1, *stepping);
        assert!(absorption.ingested.is_some() && absorption.flaws.is_empty(), "{}: {absorption}", stepping.substep());
    }
}

#[test]
fn prey_is_not_released_in_long_substeps() {
    // Cups released both.
    let cases = [("absorb-rigid", 1, 1.0 / 60.0, 4), ("absorb-agar", 123, 1.0 / 240.0, 1)];
    for (name, seed, dt, substeps) in cases {
        let absorption = refinement::absorb(name, seed, Stepping { dt, substeps });
        assert!(absorption.ingested.is_some() && absorption.flaws.is_empty(), "{name}: {absorption}");
    }
}

#[test]
fn grains_make_no_energy() {
    for friction in [0.0, 0.5] {
        let energies = granular_energy::energy(Vec2::new(40.0, 60.0), friction, 6.0).unwrap();
        let most = energies.iter().fold(0.0, |most: f64, [_, energy]| most.max(*energy));
        assert!(most <= 1.0, "friction {friction}: {most}");
        // Grains that overlap under a blow give back what they took.
        let rise = granular_energy::largest_rise(&energies);
        assert!(rise < 0.02, "friction {friction}: rises by {rise}");
    }
}

#[test]
fn a_heap_stands_by_friction_and_spreads_without_it() {
    let angle = |friction: f32| angle_of_repose::heap(20.0, friction, 10.0, 1).unwrap().1;
    let (rough, smooth) = (angle(0.5), angle(0.0));
    assert!(rough > 15.0 && rough < 29.0, "{rough} degrees");
    assert!(smooth < 3.0, "{smooth} degrees");
    let poured = angle_of_repose::poured(20.0, 0.5, 200.0, 1).unwrap().1;
    assert!(poured > 26.0 && poured < 57.0, "{poured} degrees");
}

#[test]
fn a_cell_that_crawls_by_pseudopods_changes_its_shape_as_cells_do_and_obeys() {
    let spec = crawl::cell(Crawl::Neutrophil);
    let seeds = 1..=4;
    let (mut numbers, mut angles) = (0.0, 0.0);
    for seed in seeds.clone() {
        let Figures {
            solidity,
            overlaps: [_, second, _, nine_seconds],
            one_to_three,
            split_angle,
            speed,
            voids,
            leaks,
            ..
        } = crawl::figures(&spec, seed).unwrap();
        (numbers, angles) = (numbers + one_to_three, angles + split_angle);
        assert!((0.85..0.95).contains(&solidity), "seed {seed}: solidity {solidity}");
        assert!(second < 0.85 && nine_seconds < 0.75, "seed {seed}: overlaps {second} and {nine_seconds}");
        assert!((0.9..1.25).contains(&speed), "seed {seed}: {speed} of its speed");
        assert!(leaks == 0 && voids < 0.15, "seed {seed}: {leaks} leaks, voids {voids}");
        let [first, back] = crawl::delays(&spec, seed).unwrap();
        assert!(first <= 0.1 && back <= 0.2, "seed {seed}: moves after {first} s, turns within {back} s");
    }
    let [number, angle] = [numbers, angles].map(|sum| sum / seeds.clone().count() as f64);
    assert!(number > 0.8, "one to three pseudopods for {number} of the time");
    assert!((46.0..70.0).contains(&angle), "splits at {angle} degrees");
}
