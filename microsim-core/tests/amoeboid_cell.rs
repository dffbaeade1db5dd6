//! Amoeboid cells (thesis, 3.1.2): movement, growth and containment of the cytoplasm.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::{outline, room_with, run};
use microsim_core::geometry::polygon::{contains_point, signed_area};
use microsim_core::glam::Vec2;
use microsim_core::{
    AmoeboidCellSpec, Controller, Crawl, ErrorKind, Inputs, MembraneRegion, OrganismId, Placement, PlateletSpec,
    ProbeSpec, PseudopodParams, Rng, Role, World, WorldConfig,
};

fn a_cell() -> (World, OrganismId) {
    room_with(AmoeboidCellSpec::default(), 80.0, 45.0)
}

fn toward(cell: OrganismId, x: f32, y: f32) -> Inputs {
    common::toward(cell, Vec2::new(x, y))
}

fn links(world: &World, cell: OrganismId) -> Vec<f32> {
    let ring = outline(world, cell);
    (0..ring.len()).map(|k| (ring[(k + 1) % ring.len()] - ring[k]).length()).collect()
}

/// Mean length of the links, which are of about the same length.
fn mean_of_even_links(world: &World, cell: OrganismId) -> f32 {
    let lengths = links(world, cell);
    let mean = lengths.iter().sum::<f32>() / lengths.len() as f32;
    assert!(lengths.iter().all(|l| (l / mean - 1.0).abs() < 0.05), "{lengths:?}");
    mean
}

fn fastest(world: &World, cell: OrganismId) -> f32 {
    let view = world.view().organism(cell).unwrap();
    view.particles().map(|p| p.velocity.length()).fold(0.0, f32::max)
}

#[test]
fn t15_neighbours_stay_joined_at_their_distance() {
    let (mut world, cell) = a_cell();
    run(&mut world, &Inputs::new(), 120);
    assert_eq!(world.census().constraints, links(&world, cell).len(), "one link for each node, ring closed");
    let mean = mean_of_even_links(&world, cell);
    assert!(mean > 0.9 * 1.56 && mean < 1.1 * 1.56, "mean {mean}");
}

#[test]
fn t16_no_gap_opens_that_a_node_radius_would_not_cover() {
    let (mut world, cell) = a_cell();
    for x in [150.0, 10.0, 150.0] {
        for _ in 0..90 {
            run(&mut world, &toward(cell, x, 45.0), 1);
            let widest = links(&world, cell).into_iter().fold(0.0, f32::max) - 2.0 * 0.78;
            assert!(widest < 0.78, "gap {widest}");
        }
    }
}

#[test]
fn t17_cytoplasm_stays_at_rest_density() {
    let (mut world, cell) = a_cell();
    run(&mut world, &Inputs::new(), 360);
    assert!(world.quality().fluid_compression_mean < 0.02, "{:?}", world.quality());
    assert!(fastest(&world, cell) < 0.3, "at rest, fastest {}", fastest(&world, cell));
}

#[test]
fn t18_regions_are_assigned_again_in_every_step() {
    let (mut world, cell) = a_cell();
    let regions = |world: &World| world.view().organism(cell).unwrap().membrane_regions();
    assert_eq!(regions(&world), None, "no regions without a goal");
    run(&mut world, &toward(cell, 150.0, 45.0), 1);
    let right = regions(&world).unwrap();
    run(&mut world, &toward(cell, 10.0, 45.0), 1);
    let left = regions(&world).unwrap();
    let swapped = |(before, after): &(&MembraneRegion, &MembraneRegion)| {
        (**before == MembraneRegion::Front) == (**after == MembraneRegion::Rear)
    };
    let same = right.iter().zip(&left).filter(swapped).count();
    assert!(same + 2 >= right.len(), "front and rear change places, but for the ends of an odd ring: {same}");
    run(&mut world, &Inputs::new(), 1);
    assert_eq!(regions(&world), None);
}

#[test]
fn t19_the_node_nearest_to_the_goal_is_the_centre_of_the_front() {
    let (mut world, cell) = a_cell();
    let mut rng = Rng::new(4, 4);
    for _ in 0..60 {
        let goal = Vec2::new(rng.range(0.0, 160.0), rng.range(0.0, 90.0));
        let before = outline(&world, cell);
        run(&mut world, &toward(cell, goal.x, goal.y), 1);
        let front = world.view().organism(cell).unwrap().front_index().unwrap();
        let nearest = before.iter().map(|at| (*at - goal).length()).fold(f32::INFINITY, f32::min);
        assert!((before[front] - goal).length() <= nearest + 1e-3);
    }
}

#[test]
fn t21_movement_is_smooth_unidirectional_and_reacts_at_once() {
    let (mut world, cell) = a_cell();
    run(&mut world, &toward(cell, 150.0, 45.0), 120);
    let view = world.view().organism(cell).unwrap();
    let forwards = view.particles().filter(|p| p.velocity.x > 0.0).count();
    assert!(forwards * 100 >= 97 * view.particles().count(), "all parts move one way, {forwards}");
    let at = world.centroid(cell).unwrap();
    let goal = Vec2::new(at.x, 200.0);
    run(&mut world, &toward(cell, goal.x, goal.y), 18);
    let before = world.centroid(cell).unwrap();
    run(&mut world, &toward(cell, goal.x, goal.y), 1);
    let heading = (world.centroid(cell).unwrap() - before).normalize();
    let angle = heading.dot((goal - before).normalize()).clamp(-1.0, 1.0).acos().to_degrees();
    assert!(angle < 45.0, "0.3 s after the command the heading is off by {angle} degrees");
}

#[test]
fn t22_growth_of_the_chain_adds_a_body_and_a_link_of_the_same_length() {
    let (mut world, cell) = a_cell();
    run(&mut world, &Inputs::new(), 60);
    let (before, ring) = (world.census(), outline(&world, cell));
    world.grow(cell, 1, 0).unwrap();
    let (after, grown) = (world.census(), outline(&world, cell));
    assert_eq!((after.bodies, after.constraints), (before.bodies + 1, before.constraints + 1));
    let new: Vec<usize> = (0..grown.len()).filter(|&k| !ring.contains(&grown[k])).collect();
    assert_eq!(new.len(), 1);
    let (left, right) = (grown[new[0] - 1], grown[(new[0] + 1) % grown.len()]);
    assert!(ring.contains(&left) && ring.contains(&right), "between two neighbours");
    assert!((grown[new[0]] - (left + right) / 2.0).length() < 1e-4);
    let view = world.view().organism(cell).unwrap();
    let radii: Vec<f32> = view.particles().filter(|p| p.role == Role::Membrane).map(|p| p.radius).collect();
    assert!(radii.iter().all(|r| *r == radii[0]), "identical bodies");
    run(&mut world, &Inputs::new(), 120);
    mean_of_even_links(&world, cell);
}

#[test]
fn t23_growth_of_the_interior_inflates_the_cell_from_its_centroid_without_an_explosion() {
    let (mut world, cell) = a_cell();
    run(&mut world, &Inputs::new(), 60);
    let (before, area) = (world.census(), signed_area(&outline(&world, cell)));
    let centroid = world.centroid(cell).unwrap();
    world.grow(cell, 6, 40).unwrap();
    assert_eq!(world.census().particles, before.particles + 46);
    let view = world.view().organism(cell).unwrap();
    let new: Vec<Vec2> = view.particles().filter(|p| p.role == Role::GrownCytoplasm).map(|p| p.position).collect();
    assert_eq!(new.len(), 40);
    assert!(new.iter().all(|at| (*at - centroid).length() < 4.0), "at the centroid");
    for _ in 0..300 {
        run(&mut world, &Inputs::new(), 1);
        assert_eq!(world.census().leaks, 0);
        assert!(fastest(&world, cell) <= world.config().max_speed * 1.001);
    }
    let grown = signed_area(&outline(&world, cell)) / area;
    assert!(grown > 1.1 && grown < 1.4, "area grew by {grown}");
    assert!(fastest(&world, cell) < 1.0, "calm again, fastest {}", fastest(&world, cell));
}

#[test]
fn t24_t25_no_body_or_particle_exceeds_the_speed_limit_and_no_link_its_length() {
    let mut world = World::new(WorldConfig { max_speed: 15.0, ..WorldConfig::default() }).unwrap();
    let spec = AmoeboidCellSpec { speed: 1000.0, ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(80.0, 45.0)).unwrap();
    let rest = links(&world, cell)[0];
    let mut rng = Rng::new(7, 7);
    for _ in 0..40 {
        let inputs = toward(cell, rng.range(0.0, 160.0), rng.range(0.0, 90.0));
        for _ in 0..15 {
            run(&mut world, &inputs, 1);
            assert!(fastest(&world, cell) <= 15.0 * 1.001, "fastest {}", fastest(&world, cell));
            let longest = links(&world, cell).into_iter().fold(0.0, f32::max);
            assert!(longest < 1.5 * rest, "longest {longest}");
            assert_eq!(world.census().leaks, 0);
        }
    }
}

#[test]
fn cytoplasm_stays_inside_while_the_cell_pushes_through_platelets_and_grows() {
    let (mut world, cell) = room_with(AmoeboidCellSpec::default(), 30.0, 45.0);
    for k in 0..60 {
        let at = Placement::at(60.0 + 6.0 * (k / 10) as f32, 12.0 + 7.0 * (k % 10) as f32);
        world.spawn(&PlateletSpec::default().into(), at).unwrap();
    }
    let mut rng = Rng::new(2, 2);
    for k in 0..40 {
        let inputs = toward(cell, rng.range(40.0, 110.0), rng.range(10.0, 80.0));
        for _ in 0..15 {
            run(&mut world, &inputs, 1);
            assert_eq!(world.census().leaks, 0, "goal {k}");
        }
        world.grow(cell, u32::from(k % 3 == 0), 2).unwrap();
    }
    let ring = outline(&world, cell);
    let view = world.view().organism(cell).unwrap();
    assert!(view.particles().filter(|p| p.role == Role::Cytoplasm).all(|p| contains_point(&ring, p.position)));
}

#[test]
fn growth_refuses_what_cannot_grow_and_what_would_not_fit() {
    let mut world = World::new(WorldConfig { max_particles: 300, ..WorldConfig::default() }).unwrap();
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
    let platelet = world.spawn(&PlateletSpec::default().into(), Placement::at(20.0, 45.0)).unwrap();
    let before = world.digest();
    assert!(matches!(world.grow(platelet, 1, 1).unwrap_err().kind(), ErrorKind::Unsupported { .. }));
    assert!(matches!(world.grow(cell, 1, 1_000_000).unwrap_err().kind(), ErrorKind::TooMany { .. }));
    assert_eq!(world.digest(), before, "nothing changed");
    world.remove(cell).unwrap();
    assert_eq!(world.grow(cell, 1, 1).unwrap_err().kind(), &ErrorKind::Stale);
}

#[test]
fn t25_links_keep_their_limit_when_a_heavy_probe_rams_the_membrane() {
    let (mut world, cell) = room_with(AmoeboidCellSpec::default(), 148.0, 45.0);
    let rest = links(&world, cell)[0];
    let ram = Controller::patrol(vec![Vec2::new(200.0, 45.0)], false);
    let spec = ProbeSpec { radius: 1.5, mass: 120.0, speed: 18.0, max_acceleration: 1200.0 };
    world.spawn(&spec.into(), Placement::at(120.0, 45.0).steered_by(ram)).unwrap();
    let mut longest: f32 = 0.0;
    for step in 0..180 {
        run(&mut world, &Inputs::new(), 1);
        longest = links(&world, cell).into_iter().fold(longest, f32::max);
        assert_eq!(world.census().leaks, 0, "step {step}");
    }
    assert!(longest < 1.35 * rest, "longest link {} rest lengths", longest / rest);
}

#[test]
fn a_crawling_cell_has_no_voids_and_no_wrinkles_and_keeps_its_speed() {
    let (mut world, cell) = a_cell();
    run(&mut world, &toward(cell, 1e4, 45.0), 120);
    let mut crawl = Vec::new();
    for _ in 0..120 {
        run(&mut world, &toward(cell, 1e4, 45.0), 1);
        crawl.push(world.membrane_quality(cell).unwrap());
    }
    let mean = |of: fn(&microsim_core::MembraneQuality) -> f32| crawl.iter().map(of).sum::<f32>() / crawl.len() as f32;
    assert!(mean(|q| q.voids) < 0.015, "voids {}", mean(|q| q.voids));
    assert!(mean(|q| q.excess_turning) < 1.5, "turning {}", mean(|q| q.excess_turning));
    assert!(mean(|q| q.crawl.unwrap().speed_kept) > 0.9, "speed {}", mean(|q| q.crawl.unwrap().speed_kept));
    assert!(mean(|q| q.crawl.unwrap().width_ratio) > 1.1, "width {}", mean(|q| q.crawl.unwrap().width_ratio));
}

/// Long over short axis of an ellipse with the second moments of the outline.
fn aspect(world: &World, cell: OrganismId) -> f32 {
    let ring = outline(world, cell);
    let centre = ring.iter().sum::<Vec2>() / ring.len() as f32;
    let arms = || ring.iter().map(|at| *at - centre);
    let [xx, yy, xy]: [f32; 3] =
        [arms().map(|a| a.x * a.x).sum(), arms().map(|a| a.y * a.y).sum(), arms().map(|a| a.x * a.y).sum()];
    let (mean, spread) = (0.5 * (xx + yy), (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt());
    ((mean + spread) / (mean - spread)).sqrt()
}

/// Lets a cell rest for so long, s; its aspect at the end, and the most by which it rose on the way.
fn relaxed(world: &mut World, cell: OrganismId, seconds: f64) -> [f32; 2] {
    let (end, mut least, mut rise) = (world.time() + seconds, f32::INFINITY, 0.0f32);
    while world.time() < end {
        run(world, &Inputs::new(), 1);
        least = least.min(aspect(world, cell));
        rise = rise.max(aspect(world, cell) - least);
    }
    [aspect(world, cell), rise]
}

#[test]
fn a_deformed_cell_becomes_round_without_overshoot() {
    for radius in [8.0, 11.0, 16.8] {
        let radii = Vec2::new(4.0 / 3.0, 0.75) * radius;
        let (mut long, cell) = room_with(AmoeboidCellSpec { radii, ..AmoeboidCellSpec::default() }, 80.0, 45.0);
        assert!(aspect(&long, cell) > 1.5);
        let [left, rise] = relaxed(&mut long, cell, 4.0);
        assert!(left < 1.2 && rise < 0.03, "radius {radius}: aspect {left}, rose by {rise}");
    }
    let (mut pressed, cell) = a_cell();
    let probes = [-1.0, 1.0].map(|side| {
        let press = Controller::patrol(vec![Vec2::new(80.0, 45.0)], false);
        let spec = ProbeSpec { radius: 11.0, speed: 4.0, mass: 1000.0, max_acceleration: 400.0 };
        pressed.spawn(&spec.into(), Placement::at(80.0 + 23.0 * side, 45.0).steered_by(press)).unwrap()
    });
    while aspect(&pressed, cell) < 1.35 {
        run(&mut pressed, &Inputs::new(), 1);
        assert!(pressed.time() < 5.0, "aspect {}", aspect(&pressed, cell));
    }
    probes.into_iter().for_each(|probe| pressed.remove(probe).unwrap());
    let [left, rise] = relaxed(&mut pressed, cell, 3.0);
    assert!(left < 1.05 && rise < 0.03, "pressed: aspect {left}, rose by {rise}");
}

#[test]
fn a_driven_cell_has_the_area_of_its_radii() {
    for (crawl, radius, speed, substeps) in [
        (Crawl::FrontAndRear, 4.5, 8.0, 8),
        (Crawl::FrontAndRear, 5.0, 8.0, 8),
        (Crawl::FrontAndRear, 6.0, 8.0, 3),
        (Crawl::FrontAndRear, 5.5, 20.0, 3),
        (Crawl::Neutrophil, 6.0, 8.0, 8),
        (Crawl::Dictyostelium, 8.0, 8.0, 4),
    ] {
        let config = WorldConfig { size: Vec2::splat(500.0), substeps, ..WorldConfig::default() };
        let mut world = World::new(config).unwrap();
        // What spreads covers more or less of the plane with its activity: tests/crawl.rs.
        let pseudopods = crawl.pseudopods().map(|params| PseudopodParams { spreading: 0.0, ..params });
        let radii = Vec2::splat(radius);
        let spec = AmoeboidCellSpec { radii, speed, crawl, pseudopods, ..AmoeboidCellSpec::default() };
        let cell = world.spawn(&spec.into(), Placement::at(100.0, 250.0)).unwrap();
        let inputs = toward(cell, 1e4, 250.0);
        run(&mut world, &inputs, 120);
        let area = std::f32::consts::PI * (radius - 0.78).powi(2);
        let share = |world: &World| signed_area(&outline(world, cell)) / area - 1.0;
        let shares: Vec<f32> = (0..300).map(|_| (world.step(&inputs), share(&world)).1).collect();
        let mean = shares.iter().sum::<f32>() / 300.0;
        assert!(mean.abs() < 0.02, "{crawl:?}, radius {radius}, speed {speed}: {mean} in the mean, {shares:?}");
        assert!(shares.iter().all(|share| *share < 0.025), "{crawl:?}, radius {radius}, speed {speed}: {shares:?}");
    }
}
