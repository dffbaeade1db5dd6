//! Division and fusion of amoeboid cells (conformance T84) in whole worlds.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::chase::{WAYS, agar_of, begins, by, chase, digesting, ingests, small_rigid};
use common::{assert_sound, distances_from_centre, happens, outline, room_with, run, toward};
use microsim_core::geometry::polygon::{contains_point, is_simple, signed_area};
use microsim_core::geometry::ring::unit_vector;
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, DivisionParams, Event, IngestionWay, Inputs, Intent, MealPhase, OrganismId,
    OrganismSpec, Placement, PlateletSpec, Refusal, Rng, Role, World, WorldConfig,
};

const CENTRE: Vec2 = Vec2::new(80.0, 45.0);
/// Steps, s, and their numbers of substeps.
const STEPPINGS: [(f32, u32); 5] =
    [(1.0 / 30.0, 8), (1.0 / 60.0, 4), (1.0 / 60.0, 8), (1.0 / 60.0, 16), (1.0 / 120.0, 8)];

fn cell_in_room(spec: AmoeboidCellSpec) -> (World, OrganismId) {
    let (mut world, cell) = room_with(spec, CENTRE.x, CENTRE.y);
    run(&mut world, &Inputs::new(), 30);
    (world, cell)
}

fn count(world: &World, cell: OrganismId, role: Role) -> usize {
    world.view().organism(cell).unwrap().particles().filter(|p| p.role == role).count()
}

/// What must hold in every step: every membrane simple and counter-clockwise, nothing lost, no link too long.
fn check(world: &World, what: &str) {
    assert_sound(world, what);
    assert!(world.quality().edge_stretch_max < 0.5, "{what}: {:?}", world.quality());
    for organism in world.view().organisms().filter(|organism| organism.kind() == microsim_core::Kind::AmoeboidCell) {
        let ring: Vec<Vec2> = organism.outline().collect();
        assert!(is_simple(&ring) && signed_area(&ring) > 0.0, "{what}: {ring:?}");
    }
}

/// Takes `steps` steps and checks the world after each.
fn run_checked(world: &mut World, inputs: &Inputs, steps: u32, what: &str) {
    for step in 0..steps {
        run(world, inputs, 1);
        check(world, &format!("{what}, step {step}"));
    }
}

/// Steps until an event says how the division of a cell ended.
fn finish(world: &mut World, what: &str) -> Option<Event> {
    for step in 0..2000 {
        run(world, &Inputs::new(), 1);
        check(world, &format!("{what}, step {step}"));
        let ends = |event: &&Event| {
            matches!(event, Event::Divided { .. } | Event::DivisionRefused { .. } | Event::DivisionAbandoned { .. })
        };
        if let Some(event) = world.events().iter().find(ends) {
            return Some(*event);
        }
    }
    None
}

fn divide(world: &mut World, cell: OrganismId, what: &str) -> OrganismId {
    world.divide(cell).unwrap();
    match finish(world, what) {
        Some(Event::Divided { parent, daughter }) if parent == cell => daughter,
        other => panic!("{what}: {other:?}"),
    }
}

/// Why a cell refuses to divide; the refusal leaves the counts as they are.
fn refusal(world: &mut World, cell: OrganismId) -> Refusal {
    let before = world.census();
    let reason = reason_not_to_divide(world, cell);
    assert_eq!(world.census(), before);
    reason
}

fn reason_not_to_divide(world: &mut World, cell: OrganismId) -> Refusal {
    world.divide(cell).unwrap();
    run(world, &Inputs::new(), 1);
    let reason = world.events().iter().find_map(|event| match event {
        Event::DivisionRefused { organism, reason } if *organism == cell => Some(*reason),
        _ => None,
    });
    reason.expect("refused")
}

/// Lets two cells crawl towards each other until they are one, which it returns.
fn fuse(world: &mut World, a: OrganismId, b: OrganismId, what: &str) -> OrganismId {
    for step in 0..900 {
        let mut inputs = toward(a, world.centroid(b).unwrap());
        inputs.set(b, Intent::toward(world.centroid(a).unwrap()).unwrap());
        world.fuse(a, b).unwrap();
        world.step(&inputs);
        check(world, &format!("{what}, fusing, step {step}"));
        if happens(world, |event| matches!(event, Event::Fused { .. })) {
            let (has_a, has_b) = (world.kind(a).is_some(), world.kind(b).is_some());
            assert!(has_a != has_b, "one handle is stale");
            return if has_a { a } else { b };
        }
    }
    panic!("{what}: not fused");
}

/// A cell of random size among platelets, divided and fused again.
fn divide_and_fuse(seed: u64) {
    let what = format!("seed {seed}");
    let mut rng = Rng::new(seed, 77);
    let radii = Vec2::new(rng.range(8.0, 15.0), rng.range(8.0, 13.0));
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec { radii, ..AmoeboidCellSpec::default() });
    for _ in 0..40 {
        // Where there is no room there is no platelet.
        let _ =
            world.spawn(&PlateletSpec::default().into(), Placement::at(rng.range(40.0, 120.0), rng.range(5.0, 85.0)));
    }
    let goal = CENTRE + unit_vector(rng.range(0.0, std::f32::consts::TAU)) * 60.0;
    run(&mut world, &toward(cell, goal), seed as u32 % 40);
    let (nodes, fluid) = (count(&world, cell, Role::Membrane), count(&world, cell, Role::Cytoplasm));
    let others = world.census().particles - nodes - fluid;

    let daughter = divide(&mut world, cell, &what);
    let halves = [cell, daughter].map(|id| count(&world, id, Role::Cytoplasm));
    assert_eq!(halves.iter().sum::<usize>(), fluid, "{what}");
    assert!(*halves.iter().min().unwrap() * 3 > fluid, "{what}: {halves:?} is not about even");
    run_checked(&mut world, &Inputs::new(), 120, &format!("{what}, divided"));
    for id in [cell, daughter] {
        let ring = outline(&world, id);
        let held = world.view().organism(id).unwrap();
        assert!(held.particles().filter(|p| p.role == Role::Cytoplasm).all(|p| contains_point(&ring, p.position)));
        // Two circles of half the area: each has about 0.71 times the nodes of the whole.
        let share = (count(&world, id, Role::Cytoplasm) as f32 / fluid as f32).sqrt();
        assert!((ring.len() as f32 - share * nodes as f32).abs() <= 1.0, "{what}: {} of {nodes}", ring.len());
    }

    let left = fuse(&mut world, cell, daughter, &what);
    run_checked(&mut world, &Inputs::new(), 300, &format!("{what}, fused"));
    assert_eq!((count(&world, left, Role::Membrane), count(&world, left, Role::Cytoplasm)), (nodes, fluid), "{what}");
    assert_eq!(world.census().particles, others + nodes + fluid, "{what}: nothing left over");
}

#[test]
fn t84_division_and_fusion_conserve_what_there_is() {
    (0..6).for_each(divide_and_fuse);
}

#[test]
#[ignore = "a soak: minutes in release"]
fn t84_division_and_fusion_of_100_seeds() {
    (0..100).for_each(divide_and_fuse);
}

#[test]
fn dividing_before_a_fusion_has_rounded_off_leaves_no_nodes_behind() {
    let (mut world, mut cell) = cell_in_room(AmoeboidCellSpec::default());
    let nodes = outline(&world, cell).len();
    for turn in 0..3 {
        let daughter = divide(&mut world, cell, &format!("turn {turn}"));
        cell = fuse(&mut world, cell, daughter, &format!("turn {turn}"));
        assert!(outline(&world, cell).len() > nodes + 5, "the next turn begins while the membrane is too long");
    }
    run(&mut world, &Inputs::new(), 600);
    assert_eq!(outline(&world, cell).len(), nodes);
}

/// Divides a cell of this radius, fuses the halves, and tells the whole to divide at once.
fn divide_right_after_a_fusion(radius: f32, dt: f32, substeps: u32) {
    let what = format!("radius {radius}, {substeps} substeps of {dt} s");
    let mut world = World::new(WorldConfig { dt, substeps, ..WorldConfig::default() }).unwrap();
    let spec = AmoeboidCellSpec { radii: Vec2::splat(radius), ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(CENTRE.x, CENTRE.y)).unwrap();
    run(&mut world, &Inputs::new(), 30);
    let daughter = divide(&mut world, cell, &what);
    let whole = fuse(&mut world, cell, daughter, &what);
    divide(&mut world, whole, &what);
}

#[test]
fn the_first_order_right_after_a_fusion_is_carried_out() {
    for (k, (dt, substeps)) in STEPPINGS.into_iter().enumerate() {
        (0..3).for_each(|j| divide_right_after_a_fusion(8.0 + 0.375 * (8 * j + k) as f32, dt, substeps));
    }
}

#[test]
#[ignore = "a soak: 120 cells"]
fn the_first_order_right_after_a_fusion_is_carried_out_for_24_radii() {
    for (dt, substeps) in STEPPINGS {
        (0..24).for_each(|k| divide_right_after_a_fusion(8.0 + 0.375 * k as f32, dt, substeps));
    }
}

#[test]
fn both_lobes_live_on_with_random_numbers_of_their_own() {
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
    let daughter = divide(&mut world, cell, "live on");
    assert_eq!(world.kind(daughter), world.kind(cell));
    let start = [cell, daughter].map(|id| world.centroid(id).unwrap());
    let mut inputs = toward(cell, Vec2::new(20.0, 45.0));
    inputs.set(daughter, Intent::toward(Vec2::new(140.0, 45.0)).unwrap());
    run_checked(&mut world, &inputs, 180, "apart");
    let moved = |k: usize, id| world.centroid(id).unwrap().x - start[k].x;
    assert!(moved(0, cell) < -10.0 && moved(1, daughter) > 10.0, "{} {}", moved(0, cell), moved(1, daughter));
    let again = divide(&mut world, daughter, "again");
    assert_eq!(world.census().organisms, 3);
    for id in [again, daughter, cell] {
        world.remove(id).unwrap();
    }
    assert_eq!(world.census().particles, 0);
}

#[test]
fn a_default_cell_is_never_refused() {
    let (mut world, cell) = room_with(AmoeboidCellSpec::default(), CENTRE.x, CENTRE.y);
    for turn in 0..10 {
        let mut other = world.clone();
        other.divide_along(cell, unit_vector(turn as f32)).unwrap();
        run(&mut other, &Inputs::new(), 1);
        assert!(other.events().contains(&Event::DivisionBegan { organism: cell }), "turn {turn}: {:?}", other.events());
        run(&mut world, &toward(cell, CENTRE + 30.0 * unit_vector(2.4 * turn as f32)), 25);
    }
    world.divide(cell).unwrap();
    assert!(matches!(finish(&mut world, "while it crawls"), Some(Event::Divided { .. })));
}

#[test]
fn a_given_axis_is_obeyed() {
    for angle in [0.0, 0.9, 2.0] {
        let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
        let axis = unit_vector(angle);
        world.divide_along(cell, axis * 3.0).unwrap();
        let Some(Event::Divided { daughter, .. }) = finish(&mut world, "axis") else { panic!("divides") };
        let between = (world.centroid(daughter).unwrap() - world.centroid(cell).unwrap()).normalize();
        assert!(between.dot(axis).abs() > 0.9, "axis {axis}, lobes along {between}");
    }
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
    assert_eq!(world.divide_along(cell, Vec2::ZERO).unwrap_err().field(), "axis");
    assert_eq!(world.divide_along(cell, Vec2::NAN).unwrap_err().field(), "axis");
}

#[test]
fn division_is_the_same_from_a_snapshot_in_the_middle() {
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
    world.divide(cell).unwrap();
    let asked = world.digest();
    let mut unasked = world.clone();
    run(&mut unasked, &Inputs::new(), 1);
    run(&mut world, &Inputs::new(), 100);
    assert_ne!(asked, unasked.digest());
    let mut twin = world.clone();
    for _ in 0..400 {
        run(&mut world, &Inputs::new(), 1);
        run(&mut twin, &Inputs::new(), 1);
        assert_eq!(world.digest(), twin.digest());
    }
    assert_eq!(world.census().organisms, 2);
}

#[test]
fn who_cannot_divide_says_why() {
    let small = AmoeboidCellSpec { radii: Vec2::splat(4.5), ..AmoeboidCellSpec::default() };
    let (mut world, cell) = cell_in_room(small);
    assert_eq!(refusal(&mut world, cell), Refusal::TooSmall);

    let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
    world.divide(cell).unwrap();
    run(&mut world, &Inputs::new(), 1);
    assert_eq!(refusal(&mut world, cell), Refusal::Dividing);

    let agar = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
    assert_eq!(world.divide(agar).unwrap_err().field(), "organism");
    world.remove(cell).unwrap();
    assert_eq!(world.divide(cell).unwrap_err().field(), "organism");

    let config = WorldConfig { max_particles: 245, ..WorldConfig::default() };
    let mut world = World::new(config).unwrap();
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
    assert_eq!(refusal(&mut world, cell), Refusal::WorldFull);
}

#[test]
fn a_cell_does_not_grow_while_it_divides() {
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
    world.divide(cell).unwrap();
    run(&mut world, &Inputs::new(), 1);
    assert_eq!(world.events(), [Event::DivisionBegan { organism: cell }]);
    let before = world.digest();
    assert_eq!(world.grow(cell, 1, 1).unwrap_err().field(), "organism");
    assert_eq!(world.digest(), before);
    assert!(matches!(finish(&mut world, "no growth"), Some(Event::Divided { .. })));
    world.grow(cell, 1, 1).unwrap();
}

#[test]
fn a_furrow_that_cannot_close_in_time_is_abandoned() {
    let division = DivisionParams { time_limit: 1.0, ..DivisionParams::default() };
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec { division, ..AmoeboidCellSpec::default() });
    let before = world.census().particles;
    world.divide(cell).unwrap();
    let event = finish(&mut world, "abandon");
    assert_eq!(event, Some(Event::DivisionAbandoned { organism: cell, reason: Refusal::FurrowOpen }));
    run_checked(&mut world, &Inputs::new(), 300, "abandoned");
    assert_eq!(world.census().particles, before, "the slack nodes are gone again");
    let distances = distances_from_centre(&world, cell).into_iter();
    let (near, far) = distances.fold((f32::MAX, 0.0f32), |(near, far), d| (near.min(d), far.max(d)));
    assert!(far / near < 1.15, "round again, {near} to {far}");
}

/// A cell of this radius with prey inside, taken in by one way.
fn fed(way: IngestionWay, radius: f32, prey: &[OrganismSpec]) -> (World, OrganismId, Vec<OrganismId>) {
    let (phagocytosis, radii) = (by(way), Vec2::splat(radius));
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec { phagocytosis, radii, ..AmoeboidCellSpec::default() });
    let mut all = Vec::new();
    for (k, spec) in prey.iter().enumerate() {
        let way = unit_vector(0.9 * k as f32);
        let at = world.centroid(cell).unwrap() + way * (radius + 6.5);
        let id = world.spawn(spec, Placement::at(at.x, at.y)).unwrap();
        all.push(id);
        chase(&mut world, cell, id, 600, ingests);
        assert_eq!(world.view().organism(id).unwrap().held_by(), Some(cell), "prey {k} inside");
    }
    run(&mut world, &Inputs::new(), 60);
    (world, cell, all)
}

/// Every prey is held by one of these cells, and inside it.
fn check_held(world: &World, cells: &[OrganismId], prey: &[OrganismId], way: IngestionWay) {
    let mut held = 0;
    for &id in cells {
        let ring = outline(world, id);
        let view = world.view().organism(id).unwrap();
        for (prey, phase) in view.meals() {
            assert_eq!((phase, world.view().organism(prey).unwrap().held_by()), (MealPhase::Ingested, Some(id)));
            assert!(contains_point(&ring, world.centroid(prey).unwrap()));
            let phagosomes: Vec<_> = view.phagosomes().filter(|(inner, _)| *inner == prey).collect();
            assert_eq!(phagosomes.len(), usize::from(way == IngestionWay::Cup));
            assert!(phagosomes.iter().flat_map(|(_, nodes)| nodes).all(|&at| contains_point(&ring, at)));
            held += 1;
        }
    }
    assert_eq!(held, prey.len());
}

#[test]
fn prey_goes_to_the_lobe_that_holds_it() {
    for way in WAYS {
        let (mut world, cell, prey) = fed(way, 11.0, &[agar_of(0.8), agar_of(0.8), agar_of(0.8)]);
        let daughter = divide(&mut world, cell, "fed");
        check_held(&world, &[cell, daughter], &prey, way);
        let left = fuse(&mut world, cell, daughter, "fed");
        check_held(&world, &[left], &prey, way);
        run(&mut world, &digesting(left), 300);
        assert_eq!(world.census().organisms, 1, "all digested");
        world.remove(left).unwrap();
        assert_eq!(world.census().particles, 0);
    }
}

#[test]
fn soft_prey_in_the_furrow_forbids_division_and_beside_it_goes_along() {
    for way in WAYS {
        let (mut world, cell, prey) = fed(way, 16.0, &[small_rigid()]);
        let at = (world.centroid(prey[0]).unwrap() - world.centroid(cell).unwrap()).normalize();
        world.divide_along(cell, at.perp()).unwrap();
        run(&mut world, &Inputs::new(), 1);
        let refused = Event::DivisionRefused { organism: cell, reason: Refusal::PreyInFurrow };
        assert!(world.events().contains(&refused), "{way:?}: {:?}", world.events());
        world.divide_along(cell, at).unwrap();
        match finish(&mut world, "beside") {
            Some(Event::Divided { daughter, .. }) => check_held(&world, &[cell, daughter], &prey, way),
            Some(Event::DivisionRefused { reason: Refusal::PreyInFurrow, .. }) => {}
            other => panic!("{way:?}: {other:?}"),
        }
    }
}

#[test]
fn cells_do_not_divide_or_fuse_while_they_take_in() {
    for way in WAYS {
        let (mut world, cell) = cell_in_room(AmoeboidCellSpec { phagocytosis: by(way), ..AmoeboidCellSpec::default() });
        let prey = world.spawn(&agar_of(1.8), Placement::at(95.0, 45.0)).unwrap();
        assert!(chase(&mut world, cell, prey, 300, begins).is_some());
        assert_eq!(world.view().organism(prey).unwrap().held_by(), Some(cell));
        // A cup's fold may get a node in the same step.
        let reason = if way == IngestionWay::Gate { refusal } else { reason_not_to_divide };
        assert_eq!(reason(&mut world, cell), Refusal::Ingesting);
    }
}

#[test]
fn who_cannot_fuse_says_why() {
    let (mut world, cell) = cell_in_room(AmoeboidCellSpec::default());
    let far = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(120.0, 45.0)).unwrap();
    let other = AmoeboidCellSpec { node_radius: 0.6, ..AmoeboidCellSpec::default() };
    let other = world.spawn(&other.into(), Placement::at(30.0, 45.0)).unwrap();
    let agar = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
    let reason = |world: &mut World, with| {
        world.fuse(cell, with).unwrap();
        run(world, &Inputs::new(), 1);
        world.events().iter().find_map(|event| match event {
            Event::FusionRefused { organism, with: w, reason } if (*organism, *w) == (cell, with) => Some(*reason),
            _ => None,
        })
    };
    assert_eq!(reason(&mut world, far), Some(Refusal::NotTouching));
    for with in [other, agar, cell] {
        assert_eq!(reason(&mut world, with), Some(Refusal::NoPartner));
    }
    world.divide(far).unwrap();
    run(&mut world, &Inputs::new(), 1);
    assert_eq!(reason(&mut world, far), Some(Refusal::Dividing));
}
