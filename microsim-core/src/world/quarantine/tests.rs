//! Whatever number of whatever organism breaks, in whatever situation: it is frozen and reported once, validation agrees,
//! and the others go on.

use crate::capability::phagocytosis::MealPhase;
use crate::particle::Particles;
use crate::{
    AgarSpec, AmoeboidCellSpec, BacillusSpec, CoccusSpec, Controller, Event, FieldKind, FluidBlockSpec, ForceField,
    IngestionWay, Inputs, Intent, Node, OrganismId, OrganismSpec, PhagocytosisParams, Placement, PlateletSpec,
    ProbeSpec, RedCellSpec, Region, RigidCellSpec, Template, World, WorldConfig, glam::Vec2,
};

type Poison = fn(&mut Particles, usize);

/// What can break in a particle, how, and whether the step writes it. What it only reads can break from outside alone, and
/// may then take along what it touches.
const POISONS: [(&str, Poison, bool); 11] = [
    ("x NaN", |p, i| p.x[i] = f32::NAN, true),
    ("y infinite", |p, i| p.y[i] = f32::NEG_INFINITY, true),
    ("x far away", |p, i| p.x[i] = 1e30, true),
    ("y two rooms away", |p, i| p.y[i] += 300.0, true),
    ("vx NaN", |p, i| p.vx[i] = f32::NAN, true),
    ("all NaN", |p, i| (p.x[i], p.y[i], p.vx[i], p.vy[i]) = (f32::NAN, f32::NAN, f32::NAN, f32::NAN), true),
    ("origin NaN", |p, i| p.origin_x[i] = f32::NAN, true),
    ("inverse mass NaN", |p, i| p.inv_mass[i] = f32::NAN, false),
    ("inverse mass infinite", |p, i| p.inv_mass[i] = f32::INFINITY, false),
    ("radius NaN", |p, i| p.radius[i] = f32::NAN, false),
    ("radius negative", |p, i| p.radius[i] = -1.0, false),
];

/// Looked at where a step ends, also what the next one would set again or push back.
const AT_THE_END: [Poison; 7] = [
    |p, i| p.vx[i] = f32::NAN,
    |p, i| p.x[i] -= 400.0,
    |p, i| p.y[i] -= 300.0,
    |p, i| p.vy[i] = f32::INFINITY,
    |p, i| p.prev_x[i] = f32::NAN,
    |p, i| p.prev_y[i] = f32::NEG_INFINITY,
    |p, i| p.origin_y[i] = f32::NAN,
];

/// Two linked discs, of a template that the library does not know.
fn spawn_custom(world: &mut World, x: f32, y: f32) {
    let mut builder = Template::builder();
    let [a, b] = [-1.0, 1.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.6)));
    builder.link(a, b, 0.0);
    let template = world.add_template(builder.build().unwrap());
    world.spawn_template(template, Placement::at(x, y)).unwrap();
}

/// One of each kind, near enough to touch each other soon, all on the move.
fn crowd() -> World {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let mut spawn = |spec: OrganismSpec, x: f32, y: f32| {
        let steered = Placement::at(x, y).steered_by(Controller::thrash(0.4, 0.5));
        // What cannot move takes no controller.
        world.spawn(&spec, steered).or_else(|_| world.spawn(&spec, Placement::at(x, y))).unwrap()
    };
    spawn(AmoeboidCellSpec::default().into(), 60.0, 45.0);
    spawn(RigidCellSpec::default().into(), 83.0, 45.0);
    spawn(PlateletSpec::default().into(), 60.0, 60.0);
    spawn(AgarSpec::default().into(), 74.0, 52.0);
    spawn(ProbeSpec::default().into(), 60.0, 28.0);
    spawn(RedCellSpec::default().into(), 76.0, 31.0);
    spawn(CoccusSpec::default().into(), 74.0, 38.0);
    spawn(BacillusSpec::default().into(), 46.5, 45.0);
    spawn(FluidBlockSpec { size: Vec2::splat(8.0), ..FluidBlockSpec::default() }.into(), 100.0, 45.0);
    spawn_custom(&mut world, 49.0, 54.0);
    (0..30).for_each(|_| world.step(&Inputs::new()));
    world
}

/// Breaks particle `k` (counted around) of an organism and takes some steps with everything checked.
fn break_and_step(
    world: &mut World,
    victim: OrganismId,
    k: usize,
    (name, poison, is_written): (&str, Poison, bool),
    what: &str,
) {
    let what = &format!("{what}, {name}");
    let particles: Vec<u32> = world.organisms.get(victim).unwrap().particles().collect();
    poison(&mut world.particles, particles[k % particles.len()] as usize);
    let mut reports = Vec::new();
    let mut frozen_at: Option<Vec<Vec2>> = None;
    for step in 0..6 {
        world.step(&Inputs::new());
        world.validate().unwrap_or_else(|violation| panic!("{what}, step {step}: {violation}"));
        reports.extend(world.events().iter().filter(|event| event.name() == "quarantined").copied());
        let at: Vec<Vec2> = world.view().organism(victim).unwrap().particles().map(|p| p.position).collect();
        assert!(frozen_at.is_none_or(|before| before == at), "{what}, step {step}: what is frozen moved");
        frozen_at = Some(at);
    }
    let of_victim = reports.iter().filter(|event| **event == Event::Quarantined { organism: victim }).count();
    assert_eq!(of_victim, 1, "{what}: {reports:?}");
    assert_eq!(world.census().quarantined, reports.len(), "{what}: each one is reported");
    assert!(reports.len() == 1 || !is_written, "{what}: others went with it: {reports:?}");
}

#[test]
fn every_kind_with_every_number_broken() {
    let sound = crowd();
    for id in sound.organisms() {
        for poison in POISONS {
            for k in [0, 40] {
                let what = format!("{:?}, particle {k}", sound.kind(id).unwrap());
                break_and_step(&mut sound.clone(), id, k, poison, &what);
            }
        }
    }
}

/// One of each kind that can sleep, and a second platelet in the block of the first, all asleep.
fn dormitory() -> World {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let sleepers: [OrganismSpec; 8] = [
        PlateletSpec::default().into(),
        PlateletSpec::default().into(),
        RigidCellSpec::default().into(),
        AgarSpec::default().into(),
        ProbeSpec::default().into(),
        RedCellSpec::default().into(),
        CoccusSpec::default().into(),
        BacillusSpec::default().into(),
    ];
    for (k, spec) in sleepers.iter().enumerate() {
        world.spawn(spec, Placement::at(20.0 + 15.0 * k as f32, 45.0)).unwrap();
    }
    spawn_custom(&mut world, 140.0, 45.0);
    (0..300).for_each(|_| world.step(&Inputs::new()));
    world
}

#[test]
fn every_sleeper_with_every_number_broken() {
    let sound = dormitory();
    for id in sound.organisms() {
        let kind = sound.kind(id).unwrap();
        let lane = sound.organisms.get(id).unwrap().body.lane(&sound.blocks);
        assert!(lane.is_some_and(|(block, _)| sound.sleep.is_asleep(block)), "{kind:?} is awake");
        for poison in POISONS {
            for k in [0, 40] {
                break_and_step(&mut sound.clone(), id, k, poison, &format!("{kind:?} asleep, particle {k}"));
            }
        }
    }
}

/// An engulfer with prey in front of it.
fn meal(prey: &OrganismSpec, way: IngestionWay) -> (World, [OrganismId; 2]) {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let phagocytosis = PhagocytosisParams { way, ..PhagocytosisParams::default() };
    let spec = AmoeboidCellSpec { radii: Vec2::splat(14.0), phagocytosis, ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(50.0, 45.0)).unwrap();
    let prey = world.spawn(prey, Placement::at(71.0, 45.0)).unwrap();
    (world, [cell, prey])
}

fn phase(world: &World, cell: OrganismId) -> Option<MealPhase> {
    world.organisms.get(cell)?.engulfer.as_ref()?.meals.first().map(|meal| meal.phase)
}

/// Leads the cell through its prey until the meal is in this phase.
fn eat_until(world: &mut World, [cell, prey]: [OrganismId; 2], is_wanted: fn(MealPhase) -> bool, digests: bool) {
    let is_there = |world: &World| phase(world, cell).is_some_and(is_wanted);
    let mut inputs = Inputs::new();
    for _ in 0..1200 {
        if is_there(world) {
            break;
        }
        let goal = world.centroid(prey).unwrap() + Vec2::new(20.0, 0.0);
        inputs.set(cell, Intent::toward(goal).unwrap().digesting(digests));
        world.step(&inputs);
    }
    assert!(is_there(world), "{:?}", phase(world, cell));
}

#[test]
fn engulfers_and_prey_in_every_phase_of_a_meal() {
    let phases: [fn(MealPhase) -> bool; 4] = [
        |phase| matches!(phase, MealPhase::Touching(_)),
        |phase| matches!(phase, MealPhase::Ingesting(elapsed) if elapsed > 0.05),
        |phase| matches!(phase, MealPhase::Ingested),
        |phase| matches!(phase, MealPhase::Digesting(part) if part > 0.2),
    ];
    let soft = RigidCellSpec { radii: Vec2::new(4.0, 2.5), ..RigidCellSpec::default() };
    let meals = [AgarSpec::default().into(), soft.into()];
    for (prey, way) in meals.iter().flat_map(|prey| [(prey, IngestionWay::Cup), (prey, IngestionWay::Gate)]) {
        let (mut world, both) = meal(prey, way);
        for (k, is_wanted) in phases.into_iter().enumerate() {
            eat_until(&mut world, both, is_wanted, k == 3);
            let what = format!("{way:?}, {:?}", phase(&world, both[0]));
            for victim in both {
                // Radii are computed again while prey is scaled.
                for poison in POISONS.into_iter().filter(|(_, _, is_written)| *is_written) {
                    break_and_step(&mut world.clone(), victim, 3, poison, &format!("{what}, {victim:?}"));
                }
            }
        }
    }
}

#[test]
fn cells_that_divide_or_are_told_to_fuse() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let spec = AmoeboidCellSpec { radii: Vec2::splat(12.0), ..AmoeboidCellSpec::default() };
    let cells = [50.0, 75.5].map(|x| world.spawn(&spec.clone().into(), Placement::at(x, 45.0)).unwrap());
    world.divide(cells[0]).unwrap();
    for _ in 0..40 {
        world.step(&Inputs::new());
        assert!(world.view().organism(cells[0]).unwrap().dividing_for().is_some());
        world.fuse(cells[1], cells[0]).unwrap();
        if world.step_index().is_multiple_of(13) {
            for poison in POISONS {
                break_and_step(&mut world.clone(), cells[0], 5, poison, "dividing");
                break_and_step(&mut world.clone(), cells[1], 5, poison, "fusing");
            }
        }
    }
}

#[test]
fn what_is_frozen_can_be_asked_anything() {
    for (name, poison, _) in POISONS {
        let mut world = crowd();
        let all: Vec<OrganismId> = world.organisms().collect();
        for &id in &all {
            let first = world.organisms.get(id).unwrap().particles().next().unwrap();
            poison(&mut world.particles, first as usize);
        }
        world.step(&Inputs::new());
        assert_eq!(world.census().quarantined, all.len(), "{name}");
        for &id in &all {
            let _ =
                (world.divide(id), world.fuse(id, all[0]), world.grow(id, 2, 2), world.set_exempt(id, all[0], true));
            let _ = (world.membrane_quality(id), world.centroid(id), world.quality());
        }
        world.step(&Inputs::new());
        world.validate().unwrap_or_else(|violation| panic!("{name}: {violation}"));
        all.iter().for_each(|&id| world.remove(id).unwrap());
        world.step(&Inputs::new());
        world.validate().unwrap_or_else(|violation| panic!("{name}, removed: {violation}"));
        assert_eq!(world.census().particles, 0);
    }
}

#[test]
fn every_number_is_looked_at_where_a_step_ends() {
    let crowd = crowd();
    for (k, poison) in AT_THE_END.into_iter().enumerate() {
        for id in crowd.organisms() {
            let mut world = crowd.clone();
            let last = world.organisms.get(id).unwrap().particles().last().unwrap();
            poison(&mut world.particles, last as usize);
            world.events.clear();
            world.quarantine();
            assert_eq!(world.events(), [Event::Quarantined { organism: id }], "{k}");
        }
    }
}

#[test]
fn every_chunk_is_looked_at() {
    let mut field = World::new(WorldConfig { size: Vec2::new(400.0, 200.0), ..WorldConfig::default() }).unwrap();
    let places = (0..200).map(|k| Placement::at(10.0 + 15.0 * (k % 25) as f32, 10.0 + 15.0 * (k / 25) as f32));
    let ids: Vec<_> = places.map(|at| field.spawn(&PlateletSpec::default().into(), at).unwrap()).collect();
    assert!(field.particles.len() > 2 * super::CHUNK);
    let edges = [0, super::CHUNK - 1, super::CHUNK, field.particles.len() - 1];
    for id in ids {
        let mut found = field.organisms.get(id).unwrap().particles();
        let Some(i) = found.find(|i| edges.contains(&(*i as usize))) else { continue };
        let mut world = field.clone();
        world.particles.x[i as usize] = f32::NAN;
        world.quarantine();
        assert_eq!(world.events(), [Event::Quarantined { organism: id }], "particle {i}");
    }
}

/// A cell whose membrane is changed node by node, from where it is relative to the first one.
fn bent(protects_membranes: bool, bend: fn(Vec2) -> Vec2) -> (World, OrganismId) {
    let mut world = World::new(WorldConfig { protects_membranes, ..WorldConfig::default() }).unwrap();
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
    let ring = world.organisms.get(cell).unwrap().outline.clone();
    let first = world.particles.position(ring[0] as usize);
    for node in ring.into_iter().map(|node| node as usize) {
        let p = &mut world.particles;
        let at = first + bend(p.position(node) - first);
        (p.origin_x[node], p.x[node]) = (at.x.round(), at.x - at.x.round());
        (p.origin_y[node], p.y[node]) = (at.y.round(), at.y - at.y.round());
    }
    (world, cell)
}

#[test]
fn a_membrane_that_encloses_no_area_is_frozen_where_membranes_are_protected() {
    let bends: [fn(Vec2) -> Vec2; 3] = [|at| Vec2::new(at.x, 0.0), |_| Vec2::ZERO, |at| Vec2::new(-at.x, at.y)];
    for (k, bend) in bends.into_iter().enumerate() {
        for is_protected in [true, false] {
            let (mut world, cell) = bent(is_protected, bend);
            world.quarantine();
            world.quarantine();
            let expected = [Event::Quarantined { organism: cell }];
            assert_eq!(world.events(), &expected[..usize::from(is_protected)], "bend {k}, protected {is_protected}");
            world.validate().unwrap_or_else(|violation| panic!("bend {k}: {violation}"));
        }
    }
    let (mut world, _) = bent(true, |at| at);
    world.quarantine();
    assert_eq!(world.events(), []);
}

#[test]
fn a_cell_that_a_load_presses_flat_is_frozen() {
    let size = Vec2::new(60.0, 30.0);
    let config = WorldConfig { size, substeps: 3, max_speed: 500.0, ..WorldConfig::default() };
    let mut world = World::new(config).unwrap();
    let small = AmoeboidCellSpec { radii: Vec2::splat(4.0), ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&small.into(), Placement::at(30.0, 15.0)).unwrap();
    let fall = FieldKind::Uniform { acceleration: Vec2::new(0.0, -1e6) };
    world.add_field(ForceField { region: Region::All, kind: fall }).unwrap();
    let mut reports = Vec::new();
    for step in 0..10 {
        world.step(&Inputs::new());
        world.validate().unwrap_or_else(|violation| panic!("step {step}: {violation}"));
        reports.extend(world.events().iter().filter(|event| event.name() == "quarantined").copied());
    }
    assert_eq!(reports, [Event::Quarantined { organism: cell }]);
}
