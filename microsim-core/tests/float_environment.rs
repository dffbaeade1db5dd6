//! A host's floating-point environment changes no state: with subnormals flushed or another rounding, all digests are equal,
//! and the host gets its environment back.
#![cfg(all(feature = "scenario", feature = "snapshot", any(target_arch = "x86_64", target_arch = "aarch64")))]
#![allow(unsafe_code, reason = "no safe function writes the control register; what the tests compute in it is checked")]

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::scenario::{Built, Scenario, builtin, builtins};
use microsim_core::{
    AmoeboidCellSpec, ChemicalSpec, ChemotaxisParams, Controller, Exchange, Inputs, Intent, Node, Obstacle, OrganismId,
    OrganismSpec, Placement, PlateletSpec, Template, World, WorldConfig,
};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a host may have set, beyond the default.
#[cfg(target_arch = "x86_64")]
const ENVIRONMENTS: [(&str, u64); 7] = [
    ("flush to zero", 1 << 15),
    ("denormals are zero", 1 << 6),
    ("both", 1 << 15 | 1 << 6),
    ("down", 1 << 13),
    ("up", 1 << 14),
    ("toward zero", 3 << 13),
    ("both, up", 1 << 15 | 1 << 6 | 1 << 14),
];
#[cfg(target_arch = "aarch64")]
const ENVIRONMENTS: [(&str, u64); 5] = [
    ("flush to zero", 1 << 24),
    ("up", 1 << 22),
    ("down", 1 << 23),
    ("toward zero", 3 << 22),
    ("flush to zero, up", 1 << 24 | 1 << 22),
];

/// Steps of each scenario: a difference shows in the first ones.
const STEPS: u32 = 6;

/// The control bits of this thread, without those that say what has happened.
#[cfg(target_arch = "x86_64")]
fn control() -> u64 {
    let mut value = 0_u32;
    // SAFETY: stores four bytes, in `value`.
    unsafe { std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut value) };
    u64::from(value & !0x3f) ^ 0x1f80
}

/// Sets bits on top of the default.
#[cfg(target_arch = "x86_64")]
fn set_control(bits: u64) {
    let value = 0x1f80 | bits as u32;
    // SAFETY: loads four bytes, of `value`, which has no reserved bits.
    unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const value) };
}

#[cfg(target_arch = "aarch64")]
fn control() -> u64 {
    let value;
    // SAFETY: reads a register that every program may read.
    unsafe { std::arch::asm!("mrs {}, fpcr", out(reg) value) };
    value
}

/// Sets bits on top of the default.
#[cfg(target_arch = "aarch64")]
fn set_control(bits: u64) {
    // SAFETY: writes a register that every program may write.
    unsafe { std::arch::asm!("msr fpcr, {}", in(reg) bits) };
}

/// What `work` gives in an environment, which must be there still afterwards.
fn within<R>(bits: u64, work: impl FnOnce() -> R) -> R {
    set_control(bits);
    let result = work();
    let after = control();
    set_control(0);
    assert_eq!(after, bits, "the host's environment was not restored");
    result
}

fn build(name: &str) -> Built {
    Scenario::parse(builtin(name).unwrap().text, &[]).unwrap().build().unwrap()
}

/// Digests of a built-in scenario when it is built and after some steps.
fn history(name: &str) -> [u64; 2] {
    let mut run = build(name);
    let first = run.world.digest();
    (0..STEPS).for_each(|_| run.step(&Inputs::new()));
    [first, run.world.digest()]
}

#[test]
fn built_in_scenarios_have_the_same_digests_in_every_environment() {
    #[cfg(feature = "parallel")]
    spoil_global_pool();
    for scenario in builtins() {
        let expected = history(scenario.name);
        for (environment, bits) in ENVIRONMENTS {
            let found = within(bits, || history(scenario.name));
            assert_eq!(found, expected, "{} with {environment}", scenario.name);
        }
    }
}

/// Large worlds are stepped in the global pool, if they are not in another: its threads are in another environment here.
#[cfg(feature = "parallel")]
fn spoil_global_pool() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    let [.., (_, bits)] = ENVIRONMENTS;
    let pool = || rayon::ThreadPoolBuilder::new().num_threads(2).start_handler(move |_| set_control(bits));
    ONCE.call_once(|| pool().build_global().unwrap());
}

#[cfg(feature = "parallel")]
#[test]
fn threads_of_a_pool_give_the_same_digests_in_every_environment() {
    spoil_global_pool();
    let crowded = [("count".to_owned(), "80".to_owned())];
    let crowded = Scenario::parse(builtin("crowd").unwrap().text, &crowded).unwrap().build().unwrap().world;
    let mut worlds: Vec<World> = builtins().iter().map(|scenario| build(scenario.name).world).collect();
    worlds.push(crowded);
    let digests = || -> Vec<u64> {
        let digest = |mut world: World| {
            (0..STEPS).for_each(|_| world.step(&Inputs::new()));
            world.digest()
        };
        worlds.iter().cloned().map(digest).collect()
    };
    let pool = |threads, bits| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.start_handler(move |_| set_control(bits)).build().unwrap()
    };
    let expected = pool(1, 0).install(digests);
    for (threads, (environment, bits)) in [1, 2].into_iter().flat_map(|threads| ENVIRONMENTS.map(|it| (threads, it))) {
        let pool = pool(threads, bits);
        assert!(pool.install(digests) == expected, "{threads} threads with {environment}");
        assert_eq!(pool.broadcast(|_| control()), vec![bits; threads], "{environment} was not restored");
    }
    assert!(digests() == expected, "from outside of a pool");
}

/// Digests after each call that computes state, with numbers that every rounding changes.
fn digests_of_calls() -> Vec<u64> {
    let mut digests = Vec::new();
    let (world, organisms) = furnish(&mut digests);
    step_and_change(world, organisms, &mut digests);
    digests
}

fn triangle() -> Template {
    let mut builder = Template::builder();
    let ring = [(0.1, 0.2), (1.3, 0.1), (0.7, 1.7)];
    let ring = ring.map(|(x, y)| builder.node(Node::disc(Vec2::new(x, y), 1.0, 0.3)));
    builder.ring(&ring, 1e-4).outline(&ring);
    builder.build().unwrap()
}

/// A world with an amoeboid cell, a platelet, a custom body, an obstacle and a chemical.
fn furnish(digests: &mut Vec<u64>) -> (World, [OrganismId; 2]) {
    let mut world = World::new(WorldConfig { gravity: Vec2::new(1e-39, -0.1), ..WorldConfig::default() }).unwrap();
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(30.1, 40.7).turned(0.7)).unwrap();
    digests.push(world.digest());
    let platelet = world.spawn(&PlateletSpec::default().into(), Placement::at(70.3, 40.7).scaled(1.1)).unwrap();
    world.push(platelet, Vec2::new(0.1, -0.0)).unwrap();
    world.push(platelet, Vec2::new(0.7, 1e-40)).unwrap();
    digests.push(world.digest());
    let template = world.add_template(triangle());
    world.spawn_template(template, Placement::at(100.1, 20.3).turned(0.3)).unwrap();
    digests.push(world.digest());
    world.add_obstacle(Obstacle::new(SharedShape::ball(1.7), Pose::translation(120.1, 60.7))).unwrap();
    let chemical = world.add_chemical(ChemicalSpec { initial: 0.1, ..ChemicalSpec::default() }).unwrap();
    world.set_exchange(cell, Exchange { chemical, secretion: 0.3, uptake: 0.1 }).unwrap();
    world.set_controller(cell, Controller::chemotaxis(ChemotaxisParams::towards(chemical))).unwrap();
    digests.push(world.digest());
    (world, [cell, platelet])
}

fn step_and_change(mut world: World, [cell, platelet]: [OrganismId; 2], digests: &mut Vec<u64>) {
    world.grow(cell, 3, 20).unwrap();
    digests.push(world.digest());
    let (mut world, mut inputs) = (world.clone(), Inputs::new());
    for goal in [Vec2::new(-0.0, 1e-40), Vec2::new(50.1, 30.3)] {
        inputs.set(cell, Intent::toward(goal).unwrap());
        (0..STEPS).for_each(|_| world.step(&inputs));
        digests.push(world.digest());
    }
    world.divide_along(cell, Vec2::new(0.3, 0.7)).unwrap();
    (0..STEPS).for_each(|_| world.step(&inputs));
    digests.push(world.digest());
    let mut world = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
    world.remove(platelet).unwrap();
    let (spec, scale) = OrganismSpec::from(AmoeboidCellSpec::default()).scaled(0.7);
    world.spawn(&spec, Placement::at(90.1, 70.3).scaled(scale)).unwrap();
    world.step(&inputs);
    digests.push(world.digest());
}

#[test]
fn every_call_gives_the_same_state_in_every_environment() {
    let expected = digests_of_calls();
    for (environment, bits) in ENVIRONMENTS {
        assert_eq!(within(bits, digests_of_calls), expected, "{environment}");
    }
}

#[test]
fn without_the_default_environment_digests_would_differ() {
    // The observer is called within the step, and so can take the default away again.
    let digest = |bits: u64| {
        let mut world = build("dam-break").world;
        (0..2).for_each(|_| world.step_observed(&Inputs::new(), |_| set_control(bits)));
        world.digest()
    };
    let expected = digest(0);
    for (environment, bits) in ENVIRONMENTS {
        assert_ne!(digest(bits), expected, "{environment} makes no difference, so the other tests prove nothing");
    }
}

#[test]
fn the_hosts_environment_is_restored_after_a_panic() {
    for (environment, bits) in ENVIRONMENTS {
        let mut world = build("empty").world;
        set_control(bits);
        let step = AssertUnwindSafe(|| world.step_observed(&Inputs::new(), |_| panic!("on purpose")));
        let (outcome, after) = (catch_unwind(step), control());
        set_control(0);
        assert!(outcome.is_err() && after == bits, "{environment}");
    }
}
