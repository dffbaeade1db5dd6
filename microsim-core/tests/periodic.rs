//! Periodic sides: what happens across one is what happens anywhere else.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::{
    AgarSpec, Collider, ContactReporting, Event, FluidBlockSpec, FluidMode, FluidParams, Inputs, JointEnd, JointKind,
    JointSpec, Material, Node, OrganismId, OrganismSpec, Placement, PlateletSpec, QueryFilter, RedCellSpec, Side,
    Sides, Template, TemplateId, World, WorldConfig,
};

const SIZE: Vec2 = Vec2::new(80.0, 60.0);

fn around() -> Sides {
    Sides { left: Side::Periodic, right: Side::Periodic, ..Sides::default() }
}

fn everywhere() -> Sides {
    Sides { bottom: Side::Periodic, top: Side::Periodic, ..around() }
}

fn room(sides: Sides, gravity: f32) -> World {
    let gravity = Vec2::new(0.0, -gravity);
    World::new(WorldConfig { size: SIZE, gravity, damping: 0.0, max_speed: 40.0, sides, ..WorldConfig::default() })
        .unwrap()
}

fn run(world: &mut World, steps: u32) {
    for _ in 0..steps {
        world.step(&Inputs::new());
        world.validate().unwrap();
    }
}

/// The nearest image of a way in a room that is periodic along both axes.
fn nearest(way: Vec2) -> Vec2 {
    way - (way / SIZE).round() * SIZE
}

fn velocity(world: &World, id: OrganismId) -> Vec2 {
    world.view().organism(id).unwrap().velocity()
}

/// A disc of restitution 1 without friction.
fn ball(world: &mut World) -> TemplateId {
    let mut builder = Template::builder();
    let material = Material { friction: 0.0, restitution: 1.0 };
    builder.node(Node { material, ..Node::disc(Vec2::ZERO, 1.0, 1.0) });
    world.add_template(builder.build().unwrap())
}

/// Two discs joined by a rigid link of 4 units.
fn dumbbell(world: &mut World) -> TemplateId {
    let mut builder = Template::builder();
    let nodes = [-2.0, 2.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 1.0)));
    builder.link(nodes[0], nodes[1], 0.0);
    world.add_template(builder.build().unwrap())
}

/// Two worlds of one scene, in the middle of the room and over its corner, run side by side: the largest difference of places and of
/// velocities after so many steps.
fn difference(gravity: f32, steps: u32, build: impl Fn(&mut World, Vec2) -> Vec<OrganismId>) -> [f32; 2] {
    let sides = if gravity == 0.0 { everywhere() } else { around() };
    let aside = if gravity == 0.0 { SIZE / 2.0 } else { Vec2::new(SIZE.x / 2.0, 0.0) };
    let mut worlds = [Vec2::ZERO, aside].map(|shift| {
        let mut world = room(sides, gravity);
        let ids = build(&mut world, shift);
        (world, ids, shift)
    });
    worlds.iter_mut().for_each(|(world, ..)| run(world, steps));
    let [(one, ids, _), (other, others, _)] = &worlds;
    let mut largest = [0.0f32; 2];
    for (&a, &b) in ids.iter().zip(others) {
        let way = other.centroid(b).unwrap() - one.centroid(a).unwrap() - aside;
        largest[0] = largest[0].max(nearest(way).length());
        largest[1] = largest[1].max(velocity(one, a).distance(velocity(other, b)));
    }
    println!("places {}, velocities {}", largest[0], largest[1]);
    largest
}

/// A place of a scene in a room, wrapped into it.
fn wrapped(at: Vec2) -> Placement {
    let at = at - (at / SIZE).floor() * SIZE;
    Placement::at(at.x, at.y)
}

#[test]
fn a_collision_across_a_corner_is_one_in_the_middle() {
    let found = difference(0.0, 90, |world, shift| {
        let ball = ball(world);
        let balls = [Vec2::new(30.0, 22.0), Vec2::new(50.0, 38.0), Vec2::new(40.0, 50.0)];
        let ids = balls.map(|at| world.spawn_template(ball, wrapped(at + shift)).unwrap());
        world.push(ids[0], Vec2::new(15.0, 12.0)).unwrap();
        world.push(ids[1], Vec2::new(-15.0, -11.5)).unwrap();
        world.push(ids[2], Vec2::new(0.0, -14.0)).unwrap();
        ids.to_vec()
    });
    assert!(found[0] < 1e-3 && found[1] < 1e-3, "{found:?}");
}

#[test]
fn linked_bodies_collide_across_a_side_as_elsewhere() {
    let found = difference(0.0, 100, |world, shift| {
        let dumbbell = dumbbell(world);
        let spawn = |world: &mut World, at, angle| world.spawn_template(dumbbell, wrapped(at + shift).turned(angle));
        let one = spawn(world, Vec2::new(32.0, 30.5), 1.2).unwrap();
        let other = spawn(world, Vec2::new(48.0, 29.5), 0.3).unwrap();
        world.push(one, Vec2::new(9.0, 0.0)).unwrap();
        world.push(other, Vec2::new(-9.0, 0.0)).unwrap();
        vec![one, other]
    });
    assert!(found[0] < 2e-3 && found[1] < 5e-3, "{found:?}");
}

#[test]
fn soft_bodies_pushed_across_a_side_move_as_elsewhere() {
    let specs: [(OrganismSpec, f32); 2] = [(PlateletSpec::default().into(), 6.0), (RedCellSpec::default().into(), 8.0)];
    for (spec, apart) in specs {
        let found = difference(10.0, 60, |world, shift| {
            let place = |k: u32| Vec2::new(30.0 + apart * (k % 3) as f32, 4.5 + apart * (k / 3) as f32);
            let ids: Vec<_> = (0..6).map(|k| world.spawn(&spec, wrapped(place(k) + shift)).unwrap()).collect();
            world.push(ids[0], Vec2::new(12.0, 0.0)).unwrap();
            world.push(ids[2], Vec2::new(-12.0, 0.0)).unwrap();
            ids
        });
        assert!(found[0] < 0.05, "{found:?}");
    }
}

#[test]
fn a_gas_keeps_its_momentum_and_energy() {
    let mut world = room(everywhere(), 0.0);
    let ball = ball(&mut world);
    let mut ids = Vec::new();
    for k in 0..60u32 {
        let at = Vec2::new(3.0 + 8.0 * (k % 10) as f32, 5.0 + 10.0 * (k / 10) as f32);
        let id = world.spawn_template(ball, Placement::at(at.x, at.y)).unwrap();
        let angle = k as f32 * 2.4;
        world.push(id, Vec2::new(angle.cos(), angle.sin()) * 10.0).unwrap();
        ids.push(id);
    }
    let sums = |world: &World| {
        let velocities = ids.iter().map(|&id| velocity(world, id));
        let momentum: Vec2 = velocities.clone().sum();
        (momentum, velocities.map(Vec2::length_squared).sum::<f32>())
    };
    let (momentum, energy) = sums(&world);
    let mut crossed = 0;
    for _ in 0..600 {
        let before: Vec<Vec2> = ids.iter().map(|&id| world.centroid(id).unwrap()).collect();
        run(&mut world, 1);
        let places = ids.iter().map(|&id| world.centroid(id).unwrap());
        crossed += places.zip(&before).filter(|(now, before)| now.distance(**before) > 20.0).count();
        for (k, &a) in ids.iter().enumerate() {
            for &b in &ids[..k] {
                let gap = nearest(world.centroid(a).unwrap() - world.centroid(b).unwrap()).length();
                assert!(gap > 1.9, "two overlap: {gap}");
            }
        }
    }
    let (momentum_after, energy_after) = sums(&world);
    assert!(crossed > 80, "{crossed}");
    assert!((momentum_after - momentum).length() < 0.01, "{momentum} -> {momentum_after}");
    assert!((energy_after / energy - 1.0).abs() < 0.03, "{energy} -> {energy_after}");
}

#[test]
fn what_goes_out_comes_in_with_its_digits() {
    let mut world = room(around(), 0.0);
    let id = world.spawn(&RedCellSpec::default().into(), Placement::at(79.0, 30.0)).unwrap();
    world.push(id, Vec2::new(10.0, 0.0)).unwrap();
    let (mut way, mut last) = (0.0, world.centroid(id).unwrap());
    for _ in 0..960 {
        let before = world.moment();
        run(&mut world, 1);
        let at = world.centroid(id).unwrap();
        assert!((0.0..=SIZE.x).contains(&at.x));
        let half = world.view_since(&before, 0.5).organism(id).unwrap();
        assert!(half.particles().all(|disc| (disc.position - at).length() < 8.0), "it is not drawn across the room");
        way += nearest(at - last).x;
        last = at;
    }
    assert!((way - 160.0).abs() < 0.01, "{way}");
    assert!((velocity(&world, id) - Vec2::new(10.0, 0.0)).length() < 1e-4);
}

#[test]
fn a_chain_all_around_rests_and_sleeps() {
    let mut world = room(around(), 10.0);
    let count = 40;
    let spawn = |k: u32| (k, Placement::at(1.0 + 2.0 * k as f32, 1.0));
    let ids: Vec<_> =
        (0..count).map(spawn).map(|(_, at)| world.spawn(&AgarSpec::default().into(), at).unwrap()).collect();
    run(&mut world, 240);
    for (k, &id) in ids.iter().enumerate() {
        let at = world.centroid(id).unwrap();
        assert!((at - Vec2::new(1.0 + 2.0 * k as f32, 1.0)).length() < 0.02, "{k}: {at}");
        assert!(world.view().organism(id).unwrap().is_at_rest(), "{k}");
    }
    assert!(world.spawn(&AgarSpec::default().into(), Placement::at(0.5, 1.5)).is_err(), "no room over the seam");
    // A push at one end wakes what touches across the side.
    let (first, last) = (ids[0], ids[count as usize - 1]);
    world.push(first, Vec2::new(-20.0, 0.0)).unwrap();
    run(&mut world, 2);
    let moved = world.centroid(last).unwrap().x - 79.0;
    assert!(moved < -0.002, "{moved}");
}

#[test]
fn a_fast_body_wakes_and_hits_a_sleeper_across_a_side() {
    let mut world = room(around(), 0.0);
    let sleeper = world.spawn(&RedCellSpec::default().into(), Placement::at(4.0, 30.0)).unwrap();
    run(&mut world, 60);
    assert!(world.view().organism(sleeper).unwrap().is_at_rest());
    let thrown = world.spawn(&RedCellSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
    world.push(thrown, Vec2::new(30.0, 0.0)).unwrap();
    run(&mut world, 60);
    assert!(world.centroid(sleeper).unwrap().x > 4.5, "{}", world.centroid(sleeper).unwrap());
    assert!(world.quality().penetration_max < 0.5);
}

#[test]
fn a_joint_holds_across_a_side() {
    let found = difference(0.0, 120, |world, shift| {
        let ball = ball(world);
        let ids = [36.0, 44.0].map(|x| world.spawn_template(ball, wrapped(Vec2::new(x, 30.0) + shift)).unwrap());
        let kind = JointKind::Spring { length: 6.0, frequency: 1.0, damping_ratio: 0.1 };
        let joint = world.add_joint(JointSpec::new(JointEnd::Centre(ids[0]), JointEnd::Centre(ids[1]), kind)).unwrap();
        let [a, b] = world.joint(joint).unwrap().ends;
        assert!((a.distance(b) - 8.0).abs() < 1e-4);
        world.push(ids[0], Vec2::new(2.0, 5.0)).unwrap();
        ids.to_vec()
    });
    assert!(found[0] < 1e-3 && found[1] < 1e-3, "{found:?}");
}

#[test]
fn queries_and_contacts_see_over_a_side() {
    let mut world = room(around(), 0.0);
    let [a, b] = [79.0, 1.01].map(|x| world.spawn(&AgarSpec::default().into(), Placement::at(x, 30.0)).unwrap());
    let far = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 30.0)).unwrap();
    let (queries, filter) = (world.queries(), QueryFilter::default());
    let hit =
        queries.cast_ray(Vec2::new(60.0, 30.0), Vec2::X, 100.0, &QueryFilter { excluded: Some(a), ..filter }).unwrap();
    assert!(hit.collider == Collider::Organism(b) && (hit.distance - 20.01).abs() < 1e-3, "{hit:?}");
    assert!((hit.point - Vec2::new(0.01, 30.0)).length() < 1e-3);
    let all = queries.cast_ray_all(Vec2::new(60.0, 30.0), Vec2::X, f32::INFINITY, &filter);
    let met: Vec<_> = all.iter().filter_map(|hit| hit.collider.organism()).collect();
    assert_eq!(met, [a, b, far]);
    let over_it = queries.cast_ray(Vec2::new(79.5, 10.0), Vec2::Y, 60.0, &QueryFilter { excluded: Some(a), ..filter });
    assert_eq!(over_it.unwrap().collider, Collider::Wall(microsim_core::Wall::Top), "a thin ray goes past it");
    let disc =
        queries.cast_disc(Vec2::new(79.5, 10.0), Vec2::Y, 50.0, 0.6, &QueryFilter { excluded: Some(a), ..filter });
    assert_eq!(disc.unwrap().collider, Collider::Organism(b));
    let near = queries.nearest(Vec2::new(78.0, 31.5), 5.0, &QueryFilter { excluded: Some(a), ..filter }).unwrap();
    assert!(near.collider == Collider::Organism(b) && (near.distance - (3.01f32.hypot(1.5) - 1.0)).abs() < 1e-3);
    let both = vec![Collider::Organism(a), Collider::Organism(b)];
    assert_eq!(queries.overlap_disc(Vec2::new(80.0, 30.0), 0.5, &filter), both);
    assert_eq!(queries.overlap_box(Vec2::new(79.9, 29.0), Vec2::new(81.0, 31.0), &filter), both);
    assert_eq!(world.organisms_at(Vec2::new(-0.5, 30.0)).collect::<Vec<_>>(), [a]);
    assert_eq!(world.organisms_in_box(Vec2::new(-1.0, 29.0), Vec2::new(1.0, 31.0)).collect::<Vec<_>>(), [a, b]);
    world.set_contact_reporting(Some(ContactReporting { hit_speed: None })).unwrap();
    world.push(a, Vec2::new(2.0, 0.0)).unwrap();
    run(&mut world, 1);
    for id in [a, b] {
        let felt: Vec<_> = world.contacts_of(id).collect();
        assert_eq!(felt.len(), 1);
        assert!((felt[0].point - world.centroid(id).unwrap()).length() < 1.1, "{:?}", felt[0]);
    }
}

#[test]
fn contacts_and_hits_are_told_beside_their_bodies_in_the_step_in_which_those_come_in() {
    let mut world = room(everywhere(), 0.0);
    let ball = ball(&mut world);
    let ids = [70.0, 72.01].map(|x| world.spawn_template(ball, Placement::at(x, 50.0)).unwrap());
    let kind = JointKind::Spring { length: 1.0, frequency: 2.0, damping_ratio: 1.0 };
    world.add_joint(JointSpec::new(JointEnd::Centre(ids[0]), JointEnd::Centre(ids[1]), kind)).unwrap();
    ids.iter().for_each(|&id| world.push(id, Vec2::new(10.0, 9.0)).unwrap());
    world.set_contact_reporting(Some(ContactReporting { hit_speed: Some(0.0) })).unwrap();
    let (mut seen, mut hits) = (0, 0);
    for _ in 0..180 {
        run(&mut world, 1);
        let felt = ids.iter().flat_map(|&id| world.contacts_of(id));
        let hit = world.events().iter().filter_map(|event| match event {
            Event::Hit { contact } => Some(*contact),
            _ => None,
        });
        hits += hit.clone().count();
        for contact in felt.chain(hit) {
            let away = contact.point.distance(world.centroid(contact.organism).unwrap());
            assert!(away < 1.4, "{contact:?} is {away} away");
            seen += 1;
        }
    }
    assert!(seen > 300 && hits > 0, "{seen} {hits}");
}

/// Mean density in strips of the room over that of all, and mean velocity, of free fluid.
fn strips(world: &World, id: OrganismId, count: usize) -> (Vec<f32>, Vec2) {
    let fluid = world.view().organism(id).unwrap();
    let (mut found, mut velocity, mut all) = (vec![0.0; count], Vec2::ZERO, 0.0);
    for particle in fluid.particles() {
        let share = (particle.position.x / SIZE.x).rem_euclid(1.0);
        found[(share * count as f32) as usize % count] += 1.0;
        velocity += particle.velocity;
        all += 1.0;
    }
    (found.into_iter().map(|in_strip| in_strip * count as f32 / all).collect(), velocity / all)
}

fn water(world: &mut World, height: f32, fluid: FluidParams) -> OrganismId {
    let spec = FluidBlockSpec { size: Vec2::new(SIZE.x, height), fluid };
    world.spawn(&spec.into(), Placement::at(SIZE.x / 2.0, height / 2.0)).unwrap()
}

#[test]
fn water_at_rest_is_even_all_around() {
    let mut world = room(around(), 10.0);
    let id = water(&mut world, 12.0, FluidParams::default());
    run(&mut world, 360);
    let (density, drift) = strips(&world, id, 10);
    assert!(density.iter().all(|density| (density - 1.0).abs() < 0.05), "{density:?}");
    assert!(drift.length() < 0.05, "{drift}");
    let compression = world.quality().fluid_compression_mean;
    assert!(compression < 0.03, "{compression}");
    let tops = |strip: f32| {
        let particles = world.view().organism(id).unwrap().particles();
        let near = particles.filter(|p| ((p.position.x - strip + 40.0).rem_euclid(80.0) - 40.0).abs() < 2.0);
        near.map(|p| p.position.y).fold(0.0f32, f32::max)
    };
    assert!((tops(0.0) - tops(40.0)).abs() < 1.0, "{} {}", tops(0.0), tops(40.0));
}

#[test]
fn a_current_around_the_room_stays_steady() {
    for mode in [FluidMode::Density, FluidMode::Granular] {
        let config = WorldConfig { size: SIZE, damping: 0.0, sides: everywhere(), ..WorldConfig::default() };
        let mut world = World::new(config).unwrap();
        let fluid = FluidParams { mode, ..FluidParams::default() };
        let id = world
            .spawn(&FluidBlockSpec { size: Vec2::new(80.0, 20.0), fluid }.into(), Placement::at(40.0, 30.0))
            .unwrap();
        world.push(id, Vec2::new(8.0, 0.0)).unwrap();
        run(&mut world, 300);
        let (density, drift) = strips(&world, id, 8);
        assert!((drift - Vec2::new(8.0, 0.0)).length() < 0.02, "{mode:?}: {drift}");
        assert!(density.iter().all(|density| (density - 1.0).abs() < 0.06), "{mode:?}: {density:?}");
    }
}

#[test]
fn a_body_is_carried_around_by_water_and_keeps_its_place_in_it() {
    let mut world = room(everywhere(), 0.0);
    let ball = world.spawn(&AgarSpec::default().into(), Placement::at(78.0, 30.0)).unwrap();
    let spec = FluidBlockSpec { size: Vec2::new(16.0, 20.0), fluid: FluidParams::default() };
    let id = world.spawn(&spec.into(), Placement::at(68.0, 30.0)).unwrap();
    world.push(id, Vec2::new(10.0, 0.0)).unwrap();
    run(&mut world, 120);
    assert!(velocity(&world, ball).x > 2.0, "{}", velocity(&world, ball));
}

#[test]
fn a_long_ride_around_is_the_same_for_clones_and_snapshots() {
    let build = || {
        let mut world = room(everywhere(), 0.0);
        let ball = ball(&mut world);
        for k in 0..12u32 {
            let at = Placement::at(6.0 * k as f32, 5.0 + 4.0 * k as f32);
            let id = world.spawn_template(ball, at).unwrap();
            world.push(id, Vec2::new(9.0 - k as f32, 2.0 * k as f32 - 11.0)).unwrap();
        }
        let platelet = world.spawn(&PlateletSpec::default().into(), Placement::at(40.0, 2.0)).unwrap();
        world.push(platelet, Vec2::new(0.0, -9.0)).unwrap();
        let fluid = FluidBlockSpec { size: Vec2::new(20.0, 9.0), fluid: FluidParams::default() };
        world.spawn(&fluid.into(), Placement::at(66.0, 12.0)).unwrap();
        world
    };
    let mut world = build();
    run(&mut world, 150);
    let mut clone = world.clone();
    #[cfg(feature = "snapshot")]
    let mut read = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
    run(&mut world, 150);
    run(&mut clone, 150);
    assert_eq!(world.digest(), clone.digest());
    #[cfg(feature = "snapshot")]
    {
        run(&mut read, 150);
        assert_eq!(world.digest(), read.digest());
    }
    let mut again = build();
    run(&mut again, 300);
    assert_eq!(world.digest(), again.digest());
}
