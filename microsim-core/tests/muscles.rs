//! Muscles: templates whose constraints contract by command, lane by lane.

use microsim_core::glam::Vec2;
use microsim_core::{
    Area, Distance, Inputs, Material, Node, OrganismId, Placement, Template, TemplateBuilder, TemplateId, World,
    WorldConfig,
};

fn distance(a: u32, b: u32, rest_length: f32) -> Distance {
    Distance { a, b, rest_length, compliance: 0.0, damping: 0.0 }
}

/// Nodes side by side, 2 units apart.
fn chain(count: u8, material: Material) -> TemplateBuilder {
    let mut builder = Template::builder();
    for k in 0..count {
        builder.node(Node { material, ..Node::disc(Vec2::new(2.0 * f32::from(k), 0.0), 1.0, 0.5) });
    }
    builder
}

fn fibre(world: &mut World) -> TemplateId {
    let mut builder = chain(2, Material::default());
    let channel = builder.channel([1.0, 0.6]);
    builder.muscle(channel, distance(0, 1, 2.0));
    world.add_template(builder.build().unwrap())
}

fn nodes(world: &World, id: OrganismId) -> Vec<Vec2> {
    world.view().organism(id).unwrap().particles().map(|particle| particle.position).collect()
}

#[test]
fn eight_bodies_of_a_block_contract_each_by_its_own_activation() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let fibre = fibre(&mut world);
    let at = |k: u8| Placement::at(20.0 + 10.0 * f32::from(k), 40.0);
    let fibres: Vec<_> = (0..8).map(|k| world.spawn_template(fibre, at(k)).unwrap()).collect();
    let mut inputs = Inputs::new();
    for (&id, k) in fibres.iter().zip(0u8..) {
        inputs.activate(id, 0, f32::from(k) / 7.0).unwrap();
    }
    world.check_inputs(&inputs).unwrap();
    (0..60).for_each(|_| world.step(&inputs));
    for (&id, k) in fibres.iter().zip(0u8..) {
        let nodes = nodes(&world, id);
        let expected = 2.0 * (1.0 - 0.4 * f32::from(k) / 7.0);
        assert!((nodes[0].distance(nodes[1]) - expected).abs() < 1e-3, "{k}: {nodes:?}");
        assert!((world.centroid(id).unwrap() - Vec2::new(21.0 + 10.0 * f32::from(k), 40.0)).length() < 1e-3);
    }
    world.validate().unwrap();
    inputs.activate(fibres[0], 1, 1.0).unwrap();
    assert_eq!(world.check_inputs(&inputs).unwrap_err().field(), "activation.channel");
}

#[test]
fn a_change_of_activation_wakes_and_a_constant_one_lets_sleep() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let template = fibre(&mut world);
    let id = world.spawn_template(template, Placement::at(40.0, 40.0)).unwrap();
    let mut inputs = Inputs::new();
    let length = |world: &World| nodes(world, id)[0].distance(nodes(world, id)[1]);
    for (activation, expected) in [(0.0, 2.0), (1.0, 1.2), (0.25, 1.8)] {
        inputs.activate(id, 0, activation).unwrap();
        (0..240).for_each(|_| world.step(&inputs));
        assert!((length(&world) - expected).abs() < 1e-3 && world.view().organism(id).unwrap().is_at_rest());
    }
}

#[test]
fn an_area_is_scaled_by_the_square_and_clones_and_snapshots_contract_alike() {
    let mut builder = Template::builder();
    let corners = [Vec2::ZERO, Vec2::new(4.0, 0.0), Vec2::new(4.0, 4.0), Vec2::new(0.0, 4.0)];
    let ring = corners.map(|at| builder.node(Node::disc(at, 1.0, 0.5)));
    let channel = builder.channel([1.0, 0.5]);
    let area = Area { ring: ring.to_vec(), rest_area: 16.0, compliance: 0.0, is_upper_bound: false };
    builder.outline(&ring).muscle(channel, area);
    let mut world = World::new(WorldConfig::default()).unwrap();
    let template = world.add_template(builder.build().unwrap());
    let id = world.spawn_template(template, Placement::at(40.0, 40.0)).unwrap();
    let mut inputs = Inputs::new();
    inputs.activate(id, channel, 1.0).unwrap();
    (0..30).for_each(|_| world.step(&inputs));
    let mut others = vec![world.clone()];
    #[cfg(feature = "snapshot")]
    others.push(World::from_snapshot(&world.to_snapshot().unwrap()).unwrap());
    (0..90).for_each(|_| world.step(&inputs));
    let area = microsim_core::geometry::signed_area(&nodes(&world, id));
    assert!((area - 4.0).abs() < 0.01, "{area}");
    for mut other in others {
        (0..90).for_each(|_| other.step(&inputs));
        assert_eq!(other.first_difference(&world), None);
    }
}

/// Three discs on the floor with a muscle between each two. One disc slides at a time, while the other two together have more
/// friction: the head forward, the middle after it, then the tail.
#[test]
fn a_worm_crawls_by_friction() {
    let gravity = Vec2::new(0.0, -40.0);
    let mut world = World::new(WorldConfig { gravity, damping: 0.0, ..WorldConfig::default() }).unwrap();
    let mut builder = chain(3, Material { friction: 0.8, restitution: 0.0 });
    let muscles = [0, 1].map(|k| {
        let channel = builder.channel([1.0, 1.5]);
        builder.muscle(channel, distance(k, k + 1, 2.0));
        channel
    });
    let worm = world.add_template(builder.build().unwrap());
    let worm = world.spawn_template(worm, Placement::at(40.0, 0.5)).unwrap();
    let mut inputs = Inputs::new();
    let mut go = |world: &mut World, from: [f32; 2], to: [f32; 2]| {
        for step in 1u8..=60 {
            let share = f32::from(step) / 60.0;
            for k in 0..2 {
                inputs.activate(worm, muscles[k], from[k] + (to[k] - from[k]) * share).unwrap();
            }
            world.step(&inputs);
        }
    };
    let start = world.centroid(worm).unwrap().x;
    for _ in 0..4 {
        for (from, to) in [([0.0, 0.0], [0.0, 1.0]), ([0.0, 1.0], [1.0, 0.0]), ([1.0, 0.0], [0.0, 0.0])] {
            go(&mut world, from, to);
        }
    }
    let crawled = world.centroid(worm).unwrap().x - start;
    assert!(crawled > 3.0 && crawled < 4.1, "{crawled} of 4 strides of a unit");
    world.validate().unwrap();
}
