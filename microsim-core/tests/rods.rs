//! Rods of links and bends against the theory of elastic rods.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::{
    Actuation, Bend, CollisionGroups, Distance, Inputs, Node, OrganismId, Placement, Template, World, WorldConfig,
};

/// Links of a rod.
const LINKS: u32 = 10;

/// A rod of links of length 1 whose first two nodes are fixed; each of its bends turns by `angle` at rest.
fn cantilever(angle: f32, compliance: f32) -> Template {
    let mut builder = Template::builder();
    let nodes: Vec<u32> = (0..=LINKS)
        .map(|k| {
            let at = Vec2::new(k as f32, 0.0);
            let node = if k < 2 { Node::fixed(at) } else { Node::disc(at, 0.1, 0.2) };
            builder.node(Node { groups: CollisionGroups::NONE, ..node })
        })
        .collect();
    for pair in nodes.windows(2).skip(1) {
        let (a, b) = (pair[0], pair[1]);
        builder.constraint(Distance { a, b, rest_length: 1.0, compliance: 0.0, damping: 0.0 });
    }
    for part in nodes.windows(3) {
        builder.constraint(Bend::new([part[0], part[1], part[2]], angle, compliance));
    }
    builder.build().unwrap()
}

/// Lets the tip of a rod come to rest under a force.
fn at_rest(template: Template, force: Vec2, scale: f32) -> Vec<Vec2> {
    let config = WorldConfig { damping: 2.0, substeps: 16, ..WorldConfig::default() };
    let mut world = World::new(config).unwrap();
    let template = world.add_template(template);
    let rod: OrganismId = world.spawn_template(template, Placement::at(60.0, 40.0).scaled(scale)).unwrap();
    let mut inputs = Inputs::new();
    inputs.actuate_node(rod, LINKS, Actuation::force(force)).unwrap();
    (0..1800).for_each(|_| world.step(&inputs));
    let places: Vec<Vec2> = world.view().organism(rod).unwrap().particles().map(|particle| particle.position).collect();
    places.iter().map(|&at| at - places[0]).collect()
}

#[test]
fn a_cantilever_gives_way_as_beam_theory_says() {
    for (compliance, force) in [(1e-3, 0.5), (4e-3, 0.2)] {
        let tip = at_rest(cantilever(0.0, compliance), Vec2::new(0.0, force), 1.0)[LINKS as usize].y;
        // Each hinge turns by its compliance times the torque: the sum over hinges that becomes F L^3 / (3 E I) as links get
        // shorter (Timoshenko, Strength of Materials, 1930).
        let arms: f32 = (1..LINKS).map(|k| (k * k) as f32).sum();
        let expected = compliance * force * arms;
        assert!((tip / expected - 1.0).abs() < 0.03, "{tip} instead of {expected}");
    }
}

#[test]
fn a_rod_that_is_bent_at_rest_is_an_arc_of_any_size() {
    let turn = 0.2_f32;
    for scale in [1.0, 2.0] {
        let places = at_rest(cantilever(turn, 1e-4), Vec2::ZERO, scale);
        for (k, parts) in places.windows(3).enumerate() {
            let angle = (parts[1] - parts[0]).angle_to(parts[2] - parts[1]);
            assert!((angle - turn).abs() < 0.01, "hinge {k} of the rod of size {scale} turns by {angle}");
        }
    }
}
