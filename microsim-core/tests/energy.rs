//! Bodies and joints make no energy, whatever is linked and in whatever order: without gravity and drag nothing ever moves with more
//! kinetic energy than it was given.

#![allow(clippy::disallowed_methods, reason = "tests may use all of the standard library's numbers")]

use microsim_core::geometry::polygon::signed_area;
use microsim_core::glam::Vec2;

use microsim_core::{
    Actuation, Anchor, Area, CollisionGroups, Distance, Inputs, JointEnd, JointKind, JointSpec, Node, OrganismId,
    Placement, Rng, Template, World, WorldConfig, YieldingDistance,
};
use std::f32::consts::TAU;

/// Most kinetic energy relative to what was given.
const MOST: f64 = 1.001;

fn room(substeps: u32) -> World {
    let (gravity, size) = (Vec2::ZERO, Vec2::splat(400.0));
    World::new(WorldConfig { gravity, damping: 0.0, substeps, size, ..WorldConfig::default() }).unwrap()
}

fn one_of<T: Copy>(choices: &[T], rng: &mut Rng) -> T {
    choices[rng.next_u32() as usize % choices.len()]
}

/// Pairs of some nodes in random order: all, a wheel and a star with the hub at 0, a tree, some.
fn pairs(shape: usize, nodes: u32, rng: &mut Rng) -> Vec<[u32; 2]> {
    let all = || (0..nodes).flat_map(move |a| (a + 1..nodes).map(move |b| [a, b]));
    let mut pairs: Vec<[u32; 2]> = match shape % 5 {
        0 => all().collect(),
        1 => (1..nodes).flat_map(|k| [[0, k], [k, 1 + k % (nodes - 1)]]).collect(),
        2 => (1..nodes).map(|k| [0, k]).collect(),
        3 => (1..nodes).map(|k| [rng.next_u32() % k, k]).collect(),
        _ => all().filter(|_| rng.unit() < 0.6).collect(),
    };
    for k in (1..pairs.len()).rev() {
        pairs.swap(k, rng.next_u32() as usize % (k + 1));
    }
    pairs
}

/// Places on a circle and masses of 4 to 12 nodes, the first in the middle.
fn nodes(rng: &mut Rng) -> Vec<(Vec2, f32)> {
    let (count, spread) = (4 + rng.next_u32() % 9, one_of(&[1.0f32, 100.0], rng));
    let node = |k| {
        let around = Vec2::from_angle(TAU * k as f32 / (count - 1) as f32);
        let place = if k == 0 { Vec2::ZERO } else { rng.range(1.0, 2.0) * around };
        (place, spread.powf(rng.unit()))
    };
    (0..count).map(node).collect()
}

/// A body of links between some pairs of nodes of these masses.
fn body(shape: usize, rng: &mut Rng) -> (Template, Vec<f32>) {
    let (nodes, compliance) = (nodes(rng), one_of(&[0.0, 0.0, 1e-8, 1e-6, 1e-4], rng));
    let mut builder = Template::builder();
    for &(place, mass) in &nodes {
        builder.node(Node { groups: CollisionGroups::NONE, ..Node::disc(place, mass, 0.01) });
    }
    pairs(shape, nodes.len() as u32, rng).iter().for_each(|&[a, b]| _ = builder.link(a, b, compliance));
    (builder.build().unwrap(), nodes.into_iter().map(|(_, mass)| mass).collect())
}

/// A body of links of all kinds, and the area of a ring. No bends: a corner that folds over by more than half a turn makes energy.
fn body_of_kinds(shape: usize, rng: &mut Rng) -> (Template, Vec<f32>) {
    let nodes = nodes(rng);
    let count = nodes.len() as u32;
    let mut builder = Template::builder();
    for &(place, mass) in &nodes {
        builder.node(Node { groups: CollisionGroups::NONE, ..Node::disc(place, mass, 0.01) });
    }
    for [a, b] in pairs(shape, count, rng) {
        let rest_length = nodes[a as usize].0.distance(nodes[b as usize].0);
        let link = Distance { a, b, rest_length, compliance: one_of(&[0.0, 1e-8, 1e-6, 1e-4], rng), damping: 0.0 };
        match rng.next_u32() % 4 {
            0 => builder.constraint(YieldingDistance::from(Distance { compliance: 1e-7, ..link })),
            1 => builder.constraint(Anchor {
                node: a,
                anchor: b,
                rest_length,
                max_length: 2.0 * rest_length,
                compliance: link.compliance,
            }),
            _ => builder.constraint(link),
        };
    }
    let ring: Vec<u32> = (1..count).collect();
    let outline: Vec<Vec2> = nodes[1..].iter().map(|node| node.0).collect();
    let compliance = one_of(&[0.0, 1e-6, 1e-4], rng);
    builder.constraint(Area { rest_area: signed_area(&outline), ring, compliance, is_upper_bound: false });
    (builder.build().unwrap(), nodes.into_iter().map(|(_, mass)| mass).collect())
}

/// Gives all nodes random velocities, and returns the largest share of their energy that they have in five seconds.
fn most_energy(world: &mut World, bodies: &[(OrganismId, Vec<f32>)], rng: &mut Rng) -> f64 {
    let (mut kick, mut given) = (Inputs::new(), 0.0);
    for (body, masses) in bodies {
        for (node, &mass) in (0..).zip(masses) {
            let velocity = Vec2::new(rng.range(-2.0, 2.0), rng.range(-2.0, 2.0));
            given += f64::from(0.5 * mass * velocity.length_squared());
            kick.actuate_node(*body, node, Actuation::impulse(mass * velocity)).unwrap();
        }
    }
    world.step(&kick);
    let mut most: f64 = 0.0;
    for _ in 0..300 {
        world.step(&Inputs::new());
        let view = world.view();
        let nodes = bodies.iter().flat_map(|(id, masses)| view.organism(*id).unwrap().particles().zip(masses));
        let energy: f64 = nodes.map(|(node, &mass)| f64::from(0.5 * mass * node.velocity.length_squared())).sum();
        most = most.max(energy / given);
    }
    most
}

#[test]
fn a_body_of_any_links_makes_no_energy() {
    let mut rng = Rng::new(5, 5);
    for case in 0..300 {
        let mut world = room(one_of(&[1, 4, 8, 16], &mut rng));
        let (template, masses) = body(case, &mut rng);
        let template = world.add_template(template);
        let id = world.spawn_template(template, Placement::at(200.0, 200.0)).unwrap();
        let most = most_energy(&mut world, &[(id, masses)], &mut rng);
        assert!(most < MOST, "case {case}: {most}");
    }
}

#[test]
fn a_body_of_any_kinds_and_mass_makes_no_energy() {
    let mut rng = Rng::new(8, 8);
    for case in 0..200 {
        let mut world = room(one_of(&[1, 4, 8, 16], &mut rng));
        let (template, masses) = body_of_kinds(case, &mut rng);
        let template = world.add_template(template);
        let id = world.spawn_template(template, Placement::at(200.0, 200.0)).unwrap();
        let lighter = one_of(&[1e-4, 1e-2, 1.0, 100.0], &mut rng);
        world.set_mass(id, lighter * masses.iter().sum::<f32>()).unwrap();
        let masses = masses.iter().map(|mass| lighter * mass).collect();
        let most = most_energy(&mut world, &[(id, masses)], &mut rng);
        assert!(most < MOST, "case {case}: {most}");
    }
}

#[test]
fn a_body_that_is_lighter_than_its_template_makes_no_energy() {
    let mut builder = Template::builder();
    for k in 0..6u8 {
        let place = Vec2::from_angle(TAU * f32::from(k) / 6.0);
        builder.node(Node { groups: CollisionGroups::NONE, ..Node::disc(place, 0.5, 0.01) });
    }
    (0..6).flat_map(|a| (a + 1..6).map(move |b| [a, b])).for_each(|[a, b]| _ = builder.link(a, b, 1e-3));
    let mut world = room(8);
    let template = world.add_template(builder.build().unwrap());
    let id = world.spawn_template(template, Placement::at(200.0, 200.0)).unwrap();
    world.set_mass(id, 6e-5).unwrap();
    let most = most_energy(&mut world, &[(id, vec![1e-5; 6])], &mut Rng::new(9, 9));
    assert!(most < MOST, "{most}");
}

#[test]
fn joints_between_any_discs_make_no_energy() {
    let mut rng = Rng::new(6, 6);
    for case in 0..200 {
        let mut world = room(one_of(&[4, 8, 16], &mut rng));
        let nodes = nodes(&mut rng);
        let mut discs = Vec::new();
        for &(place, mass) in &nodes {
            let mut builder = Template::builder();
            builder.node(Node { groups: CollisionGroups::NONE, ..Node::disc(Vec2::ZERO, mass, 0.01) });
            let template = world.add_template(builder.build().unwrap());
            let place = place + Vec2::splat(200.0);
            discs.push((world.spawn_template(template, Placement::at(place.x, place.y)).unwrap(), vec![mass]));
        }
        let is_soft = rng.unit() < 0.3;
        for pair in pairs(case, nodes.len() as u32, &mut rng) {
            let [a, b] = pair.map(|k| JointEnd::Node { organism: discs[k as usize].0, node: 0 });
            let length = nodes[pair[0] as usize].0.distance(nodes[pair[1] as usize].0);
            let spring = JointKind::Spring { length, frequency: 4.0, damping_ratio: 0.0 };
            world.add_joint(JointSpec::new(a, b, if is_soft { spring } else { JointKind::Weld })).unwrap();
        }
        let most = most_energy(&mut world, &discs, &mut rng);
        assert!(most < MOST, "case {case}: {most}");
    }
}

#[test]
fn joints_between_any_bodies_make_no_energy() {
    let mut rng = Rng::new(7, 7);
    for case in 0..100 {
        let mut world = room(one_of(&[4, 8, 16], &mut rng));
        let mut bodies = Vec::new();
        for k in 0..4 {
            let (template, masses) = body(one_of(&[0, 1, 2, 3, 4], &mut rng), &mut rng);
            let template = world.add_template(template);
            let place = Vec2::splat(200.0) + 3.0 * Vec2::from_angle(TAU * k as f32 / 4.0);
            bodies.push((world.spawn_template(template, Placement::at(place.x, place.y)).unwrap(), masses));
        }
        for _ in 0..2 + rng.next_u32() % 10 {
            let first = rng.next_u32() as usize % 4;
            let second = (first + 1 + rng.next_u32() as usize % 3) % 4;
            let [a, b] = [first, second]
                .map(|k| JointEnd::Node { organism: bodies[k].0, node: rng.next_u32() % bodies[k].1.len() as u32 });
            world.add_joint(JointSpec::new(a, b, JointKind::Weld)).unwrap();
        }
        let most = most_energy(&mut world, &bodies, &mut rng);
        assert!(most < MOST, "case {case}: {most}");
    }
}
