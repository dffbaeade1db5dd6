//! Amoeboid cells that take in smaller amoeboid cells through a wide gate: whole, alive, and without a leak.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::chase::{begins, by, cell_of, digesting, ends, ingests, is_released, phase};
use common::{happens, outline, run, step_soundly, tell, toward};
use microsim_core::geometry::polygon::{contains_point, signed_area};
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, Event, IngestionWay, Inputs, Intent, Kind, MealPhase, OrganismId, PhagocytosisParams, Placement, Refusal,
    Rng, World, WorldConfig,
};

const START: Vec2 = Vec2::new(60.0, 45.0);

fn wide() -> PhagocytosisParams {
    by(IngestionWay::WideGate)
}

/// A room with an engulfer with these parameters, and a cell to its right, of these radii.
fn scene_of(phagocytosis: PhagocytosisParams, [large, small]: [f32; 2]) -> (World, OrganismId, OrganismId) {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let cell = world.spawn(&cell_of(large, phagocytosis).into(), Placement::at(START.x, START.y)).unwrap();
    let at = START + Vec2::new(1.0 + large + small, 0.0);
    let prey = world.spawn(&cell_of(small, by(IngestionWay::Cup)).into(), Placement::at(at.x, at.y)).unwrap();
    (world, cell, prey)
}

/// The same with an engulfer of radius 11.
fn scene(phagocytosis: PhagocytosisParams, radius: f32) -> (World, OrganismId, OrganismId) {
    scene_of(phagocytosis, [11.0, radius])
}

/// Steps towards the prey until `done`, which has to be within `limit` steps; every step leaves a sound world.
fn hunt(world: &mut World, [cell, prey]: [OrganismId; 2], limit: u32, done: fn(&World) -> bool) -> bool {
    (0..limit).any(|step| {
        let inputs = world.centroid(prey).map_or_else(Inputs::new, |at| toward(cell, at));
        step_soundly(world, &inputs, &format!("step {step}"));
        done(world)
    })
}

/// A cell of radius 4 to 6.5 inside an engulfer that has room for it.
fn swallowed(radius: f32) -> (World, OrganismId, OrganismId) {
    let (mut world, cell, prey) = scene(PhagocytosisParams { size_ratio: 1.0, ..wide() }, radius);
    assert!(hunt(&mut world, [cell, prey], 600, ingests), "a cell of radius {radius}");
    (world, cell, prey)
}

fn area(world: &World, cell: OrganismId) -> f32 {
    signed_area(&outline(world, cell))
}

fn cytoplasm(world: &World, cell: OrganismId) -> f32 {
    world.view().organism(cell).unwrap().cytoplasm_area()
}

#[test]
fn a_smaller_cell_is_taken_in_whole_through_a_wide_gate_only() {
    for way in [IngestionWay::Gate, IngestionWay::Cup] {
        let (mut world, cell, prey) = scene(by(way), 5.0);
        assert!(!hunt(&mut world, [cell, prey], 400, begins), "{way:?}");
        assert_eq!(world.view().organism(prey).unwrap().prey_class(), None);
    }
    for radius in [3.5, 5.0, 6.5] {
        let (world, cell, prey) = swallowed(radius);
        let (ring, view) = (outline(&world, cell), world.view());
        let inside = view.organism(prey).unwrap();
        assert_eq!((inside.held_by(), phase(&world, cell, prey)), (Some(cell), Some(MealPhase::Ingested)));
        assert!(inside.particles().all(|particle| contains_point(&ring, particle.position)), "all of {radius}");
        let own = outline(&world, prey);
        let is_foreign = |particle: Vec2| contains_point(&own, particle);
        assert!(!view.organism(cell).unwrap().particles().any(|particle| is_foreign(particle.position)));
    }
}

#[test]
fn it_stays_inside_whatever_its_engulfer_does() {
    let (mut world, cell, _) = swallowed(5.0);
    let mut rng = Rng::new(3, 3);
    for goal in 0..12 {
        let inputs = toward(cell, Vec2::new(rng.range(0.0, 160.0), rng.range(0.0, 90.0)));
        (0..30).for_each(|_| step_soundly(&mut world, &inputs, &format!("goal {goal}")));
    }
    world.grow(cell, 6, 60).unwrap();
    (0..60).for_each(|_| step_soundly(&mut world, &Inputs::new(), "after growth"));
}

#[test]
fn new_cytoplasm_of_an_engulfer_does_not_appear_in_the_cell_that_it_holds() {
    let (mut world, cell, prey) = swallowed(6.5);
    let is_in_the_middle = |world: &World| contains_point(&outline(world, prey), world.centroid(cell).unwrap());
    assert!((0..600).any(|_| (world.step(&Inputs::new()), is_in_the_middle(&world)).1));
    world.grow(cell, 4, 40).unwrap();
    assert_eq!((world.census().leaks, world.validate()), (0, Ok(())));
    (0..60).for_each(|_| step_soundly(&mut world, &Inputs::new(), "after growth"));
}

#[test]
fn it_is_in_one_daughter_of_an_engulfer_that_divides() {
    let (mut world, cell, prey) = scene_of(wide(), [15.0, 4.0]);
    assert!(hunt(&mut world, [cell, prey], 600, ingests));
    // It may lie where the furrow would be.
    let divided = (0..12).any(|k| {
        let inputs = toward(cell, Vec2::new(if k % 2 == 0 { 20.0 } else { 140.0 }, 45.0));
        (0..40).for_each(|_| step_soundly(&mut world, &inputs, "between divisions"));
        world.divide(cell).unwrap();
        (0..600).any(|_| {
            step_soundly(&mut world, &Inputs::new(), "in division");
            happens(&world, |event| matches!(event, Event::Divided { .. }))
        })
    });
    let holder = world.view().organism(prey).unwrap().held_by().unwrap();
    assert!(divided);
    assert_eq!(phase(&world, holder, prey), Some(MealPhase::Ingested));
}

#[test]
fn a_cell_that_is_held_neither_moves_nor_eats_nor_divides_nor_fuses_nor_grows() {
    let (mut world, cell, prey) = swallowed(6.0);
    let at = world.centroid(prey).unwrap() - world.centroid(cell).unwrap();
    let refused = |world: &mut World| {
        world.step(&toward(prey, Vec2::new(150.0, 45.0)));
        let is_held = |event: &Event| {
            matches!(
                event,
                Event::DivisionRefused { reason: Refusal::Held, .. }
                    | Event::FusionRefused { reason: Refusal::Held, .. }
            )
        };
        assert!(happens(world, is_held), "{:?}", world.events());
    };
    world.divide(prey).unwrap();
    refused(&mut world);
    world.fuse(cell, prey).unwrap();
    refused(&mut world);
    world.fuse(prey, cell).unwrap();
    refused(&mut world);
    assert_eq!(world.grow(prey, 1, 1).unwrap_err().field(), "organism");
    assert_eq!(world.set_exempt(cell, prey, true).unwrap_err().field(), "b");
    run(&mut world, &toward(prey, Vec2::new(150.0, 45.0)), 120);
    assert!(world.view().organism(prey).unwrap().membrane_regions().is_none(), "it does not crawl");
    let moved = world.centroid(prey).unwrap() - world.centroid(cell).unwrap() - at;
    assert!(moved.length() < 6.0, "{moved}");
    assert_eq!(world.view().organism(prey).unwrap().meals().count(), 0);
}

#[test]
fn what_is_released_from_inside_is_whole_and_crawls_on() {
    for radius in [4.0, 6.0] {
        let (world, _, prey) = scene(wide(), radius);
        let (mut before, at_first) = (world, cytoplasm(&swallowed(radius).0, prey));
        run(&mut before, &Inputs::new(), 60);
        let (mut world, cell, prey) = swallowed(radius);
        run(&mut world, &toward(cell, Vec2::new(20.0, 20.0)), 60);
        world.remove(cell).unwrap();
        let released = world.view().organism(prey).unwrap();
        assert_eq!((released.held_by(), released.prey_class()), (None, None));
        (0..180).for_each(|step| step_soundly(&mut world, &Inputs::new(), &format!("step {step} after")));
        let change = area(&world, prey) / area(&before, prey) - 1.0;
        assert!(change.abs() < 0.02 && cytoplasm(&world, prey) == at_first, "{change} of {radius}");
        let from = world.centroid(prey).unwrap();
        run(&mut world, &toward(prey, from + Vec2::new(60.0, 0.0)), 180);
        assert!(world.centroid(prey).unwrap().x > from.x + 8.0);
        world.divide(prey).unwrap();
        world.step(&Inputs::new());
        assert!(!happens(&world, |event| matches!(event, Event::DivisionRefused { reason: Refusal::Held, .. })));
    }
}

#[test]
fn what_does_not_get_in_within_the_time_limit_is_let_go_outside_and_whole() {
    let hasty = PhagocytosisParams { time_limit: 0.1, pull_speed: 10.0, ..wide() };
    let (mut world, cell, prey) = scene(hasty, 5.0);
    let at_first = cytoplasm(&world, prey);
    assert!(hunt(&mut world, [cell, prey], 300, begins) && hunt(&mut world, [cell, prey], 300, ends));
    assert!(happens(&world, is_released), "{:?}", world.events());
    let (ring, view) = (outline(&world, cell), world.view());
    let released = view.organism(prey).unwrap();
    assert!(released.held_by().is_none() && !released.particles().any(|it| contains_point(&ring, it.position)));
    let apart = tell(cell, Intent::toward(Vec2::new(5.0, 45.0)).unwrap());
    (0..240).for_each(|step| step_soundly(&mut world, &apart, &format!("step {step} after")));
    let (mut alone, other) = common::room_with(cell_of(5.0, PhagocytosisParams::default()), 60.0, 45.0);
    run(&mut alone, &Inputs::new(), 240);
    let change = area(&world, prey) / area(&alone, other) - 1.0;
    assert!(change.abs() < 0.02 && cytoplasm(&world, prey) == at_first, "{change}");
}

#[test]
fn digestion_shrinks_and_removes_it_and_the_engulfer_grows_by_it() {
    for radius in [4.0, 6.5] {
        let (mut world, cell, prey) = swallowed(radius);
        let (before, whole) = (cytoplasm(&world, cell), cytoplasm(&world, prey));
        let taken = world.view().organism(prey).unwrap().spawn_area();
        let mut last = whole;
        let eaten = (0..240).any(|step| {
            step_soundly(&mut world, &digesting(cell), &format!("step {step} of digestion"));
            if world.kind(prey).is_some() {
                assert!(cytoplasm(&world, prey) <= last && cytoplasm(&world, cell) == before, "step {step}");
                last = cytoplasm(&world, prey);
            }
            happens(&world, |event| matches!(event, Event::Consumed { kind: Kind::AmoeboidCell, .. }))
        });
        // A membrane needs some particles.
        let least = if radius > 5.0 { 0.3 * whole } else { 10.0 };
        assert!(eaten && world.kind(prey).is_none() && last < least, "{last} of {whole} were left");
        (0..600).for_each(|step| step_soundly(&mut world, &Inputs::new(), &format!("step {step} of growth")));
        let grown = cytoplasm(&world, cell) - before;
        // Growth is by whole particles, of the area of their lattice; their discs fill 0.907 of it.
        assert!((grown / (0.907 * taken) - 1.0).abs() < 0.05, "{grown} of {taken}");
        let ring = area(&world, cell);
        assert!((ring / (before / 0.907 + taken) - 1.1).abs() < 0.2, "no void stays: {ring}");
    }
}

#[test]
fn what_is_too_large_divides_or_holds_prey_itself_is_not_taken_in() {
    let (mut world, cell, prey) = scene(wide(), 7.5);
    assert!(!hunt(&mut world, [cell, prey], 600, begins), "its area is more than half");

    let (mut world, cell, prey) = scene(wide(), 6.5);
    world.divide(prey).unwrap();
    world.step(&Inputs::new());
    assert!(happens(&world, |event| matches!(event, Event::DivisionBegan { .. })));
    while !happens(&world, |event| matches!(event, Event::Divided { .. })) {
        let at = world.centroid(prey).unwrap();
        step_soundly(&mut world, &toward(cell, at), "while it divides");
        assert!(!begins(&world) && world.step_index() < 3000);
    }

    let (mut world, cell, prey) = scene(PhagocytosisParams { size_ratio: 1.0, ..wide() }, 6.5);
    let beside = world.centroid(prey).unwrap() + Vec2::new(8.5, 0.0);
    let agar = AgarSpec { radius: 1.0, ..AgarSpec::default() };
    let agar = world.spawn(&agar.into(), Placement::at(beside.x, beside.y)).unwrap();
    assert!(hunt(&mut world, [prey, agar], 600, ingests));
    assert!(!hunt(&mut world, [cell, prey], 400, begins));
    (0..300).for_each(|_| world.step(&digesting(prey)));
    assert!(hunt(&mut world, [cell, prey], 900, ingests), "when it has eaten it");
}

#[cfg(feature = "snapshot")]
#[test]
fn worlds_go_on_alike_from_bytes_in_the_middle_of_it() {
    let (mut world, cell, prey) = scene(wide(), 5.0);
    assert!(hunt(&mut world, [cell, prey], 600, begins));
    let check = |world: &mut World, steps: u32| {
        let mut restored = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
        assert_eq!(restored.digest(), world.digest());
        for _ in 0..steps {
            [&mut restored, world].into_iter().for_each(|world| world.step(&digesting(cell)));
            assert_eq!((restored.digest(), restored.events()), (world.digest(), world.events()));
        }
    };
    check(&mut world, 20);
    assert!(matches!(phase(&world, cell, prey), Some(MealPhase::Ingesting(_))));
    check(&mut world, 130);
    assert!(matches!(phase(&world, cell, prey), Some(MealPhase::Digesting(_))), "{:?}", phase(&world, cell, prey));
    check(&mut world, 200);
    assert!(world.kind(prey).is_none());
}
