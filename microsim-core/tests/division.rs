//! Division of amoeboid cells in whole worlds.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::chase::{WAYS, agar_of, begins, by, chase, digesting, ingests, small_rigid};
use common::lobes::{CENTRE, cell_in_room, count, divide, finish, fuse, run_checked};
use common::{distances_from_centre, outline, room_with, run, toward};
use microsim_core::geometry::polygon::contains_point;
use microsim_core::geometry::ring::unit_vector;
use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Crawl, DivisionParams, Event, IngestionWay, Inputs, Intent, MealPhase, OrganismId,
    OrganismSpec, Placement, Refusal, Role, World, WorldConfig,
};

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

#[test]
fn the_smallest_cells_that_may_divide_do_so_in_any_substep() {
    let mut divided = 0;
    for (radius, substeps) in
        [6.0f32, 6.3, 6.6, 7.0].into_iter().flat_map(|radius| [4, 8, 32].map(|substeps| (radius, substeps)))
    {
        let mut world = World::new(WorldConfig { substeps, ..WorldConfig::default() }).unwrap();
        let spec = AmoeboidCellSpec { radii: Vec2::splat(radius), ..AmoeboidCellSpec::default() };
        let cell = world.spawn(&spec.into(), Placement::at(CENTRE.x, CENTRE.y)).unwrap();
        run(&mut world, &Inputs::new(), 10);
        world.divide(cell).unwrap();
        let event = finish(&mut world, "small");
        let is_refused = matches!(event, Some(Event::DivisionRefused { reason: Refusal::TooSmall, .. }));
        let is_divided = matches!(event, Some(Event::Divided { .. }));
        assert!(is_refused || is_divided, "radius {radius}, {substeps} substeps: {event:?}");
        divided += u32::from(is_divided);
    }
    assert!((3..12).contains(&divided), "both are tried: {divided}");
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

/// The larger share of the cytoplasm after the division of a cell that is told to crawl throughout.
fn larger_share(spec: AmoeboidCellSpec, seed: u64) -> f32 {
    let config = WorldConfig { size: Vec2::splat(300.0), seed, ..WorldConfig::default() };
    let (mut world, middle) = (World::new(config).unwrap(), Vec2::splat(150.0));
    let cell = world.spawn(&spec.into(), Placement::at(middle.x, middle.y)).unwrap();
    let inputs = toward(cell, middle + 130.0 * unit_vector(2.1 * seed as f32));
    run(&mut world, &inputs, 100 + 40 * seed as u32);
    world.divide(cell).unwrap();
    run(&mut world, &inputs, 60);
    assert_eq!(world.view().organism(cell).unwrap().dividing_for(), Some(0.0), "it rounds up first");
    let particles = |world: &World, cell| count(world, cell, Role::Cytoplasm) as f32;
    let all = particles(&world, cell);
    for _ in 0..900 {
        run_checked(&mut world, &inputs, 1, "crawling");
        if let Some(Event::Divided { daughter, .. }) = world.events().first() {
            let daughter = particles(&world, *daughter);
            return daughter.max(all - daughter) / all;
        }
    }
    panic!("it does not divide");
}

#[test]
fn a_cell_that_crawls_rounds_up_and_divides_into_halves() {
    for (crawl, radius) in [
        (Crawl::FrontAndRear, 7.0),
        (Crawl::Neutrophil, 8.0),
        (Crawl::Neutrophil, 12.0),
        (Crawl::Dictyostelium, 8.0),
        (Crawl::Dictyostelium, 11.0),
    ] {
        for seed in 0..3 {
            let spec = AmoeboidCellSpec { crawl, radii: Vec2::splat(radius), ..AmoeboidCellSpec::default() };
            let share = larger_share(spec, seed);
            assert!(share <= 0.55, "{crawl:?} of radius {radius}, seed {seed}: {share} of the cytoplasm");
        }
    }
}
