//! Bodies that divide by the cut of their template: what is conserved, what is handed on, what is refused.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Actuation, AgarSpec, ChemicalSpec, CollisionGroups, Controller, Distance, Event, Exchange, Half, Inputs, JointEnd,
    JointKind, JointSpec, Kind, Node, Obstacle, OrganismId, Placement, Propulsion, Refusal, Template, TemplateBuilder,
    TemplateId, World, WorldConfig, YieldingDistance,
};

fn room() -> World {
    World::new(WorldConfig { size: Vec2::splat(100.0), damping: 0.0, ..WorldConfig::default() }).unwrap()
}

/// Discs in a line, a unit apart, that grow heavier to the right.
fn rod(discs: u8, name: &str) -> TemplateBuilder {
    let mut builder = Template::builder();
    let node = |k: u8| Node::disc(Vec2::new(f32::from(k), 0.0), 0.1 + 0.01 * f32::from(k), 0.5);
    let discs: Vec<u32> = (0..discs).map(|k| builder.node(node(k))).collect();
    for apart in [1, 2] {
        discs.windows(apart + 1).for_each(|part| _ = builder.link(part[0], part[apart], 0.0));
    }
    builder.name(name);
    builder
}

fn add(world: &mut World, builder: TemplateBuilder) -> TemplateId {
    world.add_template(builder.build().unwrap())
}

/// A rod of eight that becomes two of this name, smaller ones if they are of eight again.
fn dividing(halves: &str) -> TemplateBuilder {
    let mut builder = rod(8, "long");
    let scale = if halves.starts_with("short") { 1.0 } else { 0.4 };
    builder.cut([0..4, 4..8].map(|slots| Half::of(slots).named(halves).scaled(scale)));
    builder
}

/// A rod that flies, turns and bends.
fn thrown(halves: &str) -> (World, OrganismId) {
    let mut world = room();
    add(&mut world, rod(4, "short"));
    add(&mut world, rod(3, "shorter"));
    let long = add(&mut world, dividing(halves));
    let id = world.spawn_template(long, Placement::at(50.0, 50.0).turned(0.7)).unwrap();
    let mut inputs = Inputs::new();
    inputs.actuate_node(id, 1, Actuation::impulse(Vec2::new(3.0, 2.0))).unwrap();
    (0..20).for_each(|_| {
        world.step(&inputs);
        inputs.clear();
    });
    (world, id)
}

/// Takes a step in which a body divides, and the same step of a world in which it does not.
fn divided(world: &World, id: OrganismId) -> (World, World, [OrganismId; 2]) {
    let (mut divided, mut whole) = (world.clone(), world.clone());
    divided.divide(id).unwrap();
    [&mut divided, &mut whole].into_iter().for_each(|world| world.step(&Inputs::new()));
    divided.validate().unwrap();
    let Some(&Event::Divided { parent, daughter }) = divided.events().first() else { panic!("{:?}", divided.events()) };
    assert_eq!(parent, id);
    (divided, whole, [parent, daughter])
}

/// Mass, momentum, centre of mass and angular momentum about a corner, of some organisms together.
fn motion(world: &World, ids: &[OrganismId]) -> [f32; 6] {
    let (mut mass, mut momentum, mut first, mut spin) = (0.0, Vec2::ZERO, Vec2::ZERO, 0.0);
    for &id in ids {
        let body = world.view().organism(id).unwrap();
        let nodes: Vec<Node> = world.template(body.template().unwrap()).unwrap().nodes().to_vec();
        let total: f32 = nodes.iter().map(|node| node.mass).sum();
        for (node, particle) in nodes.iter().zip(body.particles()) {
            let share = node.mass / total * body.mass();
            let (r, v) = (particle.position - Vec2::splat(50.0), particle.velocity);
            (mass, momentum, first) = (mass + share, momentum + share * v, first + share * r);
            spin += share * r.perp_dot(v);
        }
    }
    let centre = first / mass;
    [mass, momentum.x, momentum.y, centre.x, centre.y, spin]
}

#[test]
fn nodes_of_two_halves_are_where_those_of_the_whole_would_be_to_the_bit() {
    let (world, id) = thrown("short");
    let (divided, whole, halves) = divided(&world, id);
    let nodes = |world: &World, ids: &[OrganismId]| -> Vec<(Vec2, Vec2)> {
        let bodies = ids.iter().map(|&id| world.view().organism(id).unwrap());
        bodies
            .flat_map(|body| body.particles().map(|node| (node.position, node.velocity)).collect::<Vec<_>>())
            .collect()
    };
    assert_eq!(nodes(&divided, &halves), nodes(&whole, &[id]));
    let mass = |world: &World, id| world.view().organism(id).unwrap().mass();
    let masses = halves.map(|id| mass(&divided, id));
    assert!((masses[0] - 0.46).abs() < 1e-5 && (masses[1] - 0.62).abs() < 1e-5, "{masses:?}");
    assert_eq!(divided.kind(halves[0]), Some(Kind::Custom(divided.template_named("short").unwrap())));
}

#[test]
fn halves_with_other_nodes_keep_mass_momentum_centre_and_angular_momentum() {
    for halves in ["shorter", "long", ""] {
        let (world, id) = thrown(halves);
        let (divided, whole, both) = divided(&world, id);
        let (found, expected) = (motion(&divided, &both), motion(&whole, &[id]));
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-4 * (1.0 + expected.abs()),
                "{found} instead of {expected}: {halves}"
            );
        }
        let angle = |world: &World, id| world.view().organism(id).unwrap().angle().unwrap();
        assert!(both.iter().all(|&half| (angle(&divided, half) - angle(&whole, id)).abs() < 0.05));
    }
}

#[test]
fn a_half_takes_the_size_that_it_is_given() {
    let mut world = room();
    let mut pair = Template::builder();
    let [a, b] = [-1.0, 1.0].map(|x| pair.node(Node::disc(Vec2::new(x, 0.0), 1.0, 1.0)));
    pair.link(a, b, 0.0).cut([Half::of([a]).scaled(0.5), Half::of([b]).scaled(0.5)]);
    let pair = add(&mut world, pair);
    let id = world.spawn_template(pair, Placement::at(50.0, 50.0)).unwrap();
    world.set_scale(id, 1.4).unwrap();
    (0..60).for_each(|_| world.step(&Inputs::new()));
    let (divided, _, halves) = divided(&world, id);
    for half in halves.map(|half| divided.view().organism(half).unwrap()) {
        let radii: Vec<f32> = half.particles().map(|node| node.radius).collect();
        assert!(
            radii.iter().all(|radius| (radius - 0.7).abs() < 1e-6) && (half.mass() - 1.0).abs() < 1e-6,
            "{radii:?}"
        );
        assert_eq!(half.scale(), 1.0, "relative to its size at birth");
        assert!((half.centroid().x - 50.0).abs() > 1.3 && (half.centroid().y - 50.0).abs() < 1e-4);
    }
}

#[test]
fn what_a_body_was_given_is_handed_on() {
    let mut world = room();
    let chemical = world.add_chemical(ChemicalSpec::default()).unwrap();
    let mut swimmer = dividing("");
    swimmer.propulsion(Propulsion { speed: 5.0, max_acceleration: 20.0 });
    let swimmer = add(&mut world, swimmer);
    let groups = CollisionGroups::in_tier(2).unwrap();
    let at =
        Placement::at(50.0, 50.0).damped(1.0, 2.0).steered_by(Controller::wander([0.1, 0.2], 0.0)).in_groups(groups);
    let id = world.spawn_template(swimmer, at).unwrap();
    let other = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
    world.set_exempt(id, other, true).unwrap();
    world.set_user_data(id, 77 << 64 | 5).unwrap();
    world.set_gravity_scale(id, 0.25).unwrap();
    world.set_speed(id, 3.0).unwrap();
    world.set_exchange(id, Exchange { chemical, secretion: 1.0, uptake: 0.0 }).unwrap();
    let (divided, _, halves) = divided(&world, id);
    for half in halves {
        let half = divided.view().organism(half).unwrap();
        assert_eq!((half.user_data(), half.gravity_scale(), half.linear_damping()), (77 << 64 | 5, 0.25, 1.0));
        assert_eq!((half.angular_damping(), half.kind()), (2.0, Kind::Custom(swimmer)));
        assert!(half.tier() == groups.tier() && matches!(half.controller(), Controller::Wander(_)));
    }
    let mut again = divided;
    again.divide(halves[1]).unwrap();
    again.step(&Inputs::new());
    assert_eq!(again.organisms().count(), 4, "halves of one template divide again");
}

#[test]
fn joints_of_nodes_end_and_those_of_the_centre_stay() {
    let (mut world, id) = thrown("short");
    let nail = |at| JointEnd::Point(Vec2::splat(at));
    let rope = JointKind::Rope { max_length: 60.0 };
    let of_node = world.add_joint(JointSpec::new(JointEnd::Node { organism: id, node: 6 }, nail(60.0), rope)).unwrap();
    let of_centre = world.add_joint(JointSpec::new(JointEnd::Centre(id), nail(40.0), rope)).unwrap();
    let (divided, _, [parent, _]) = divided(&world, id);
    let ended = |event: &Event| matches!(event, Event::JointEnded { joint, .. } if *joint == of_node);
    assert!(divided.events().iter().any(ended) && divided.joint(of_node).is_none());
    assert_eq!(divided.joint(of_centre).unwrap().spec.a, JointEnd::Centre(parent));
}

fn refused(world: &mut World, id: OrganismId) -> String {
    let before = world.digest();
    let error = world.divide(id).unwrap_err();
    assert_eq!(world.digest(), before);
    error.to_string()
}

#[test]
fn a_division_that_cannot_be_is_refused_by_name() {
    let mut world = room();
    let plain = add(&mut world, rod(4, "short"));
    let plain = world.spawn_template(plain, Placement::at(20.0, 80.0)).unwrap();
    assert!(refused(&mut world, plain).contains("a body whose template has a cut"));
    let unknown = add(&mut world, dividing("nobody"));
    let unknown = world.spawn_template(unknown, Placement::at(20.0, 70.0)).unwrap();
    assert!(refused(&mut world, unknown).starts_with("`cut[0].template`"));
    let mut large = dividing("");
    large.cut([Half::of(0..4).named("short"), Half::of(4..8).named("short").scaled(4.0)]);
    let large = add(&mut world, large);
    let large = world.spawn_template(large, Placement::at(20.0, 60.0)).unwrap();
    assert!(refused(&mut world, large).contains("the other half"));
    let axis = world.divide_along(large, Vec2::X).unwrap_err();
    assert_eq!((axis.field(), world.fuse(large, unknown).unwrap_err().field()), ("organism", "organism"));
}

/// A pair that becomes two of twice its size: the second one reaches far to the right.
fn bud(world: &mut World) -> TemplateId {
    let mut bud = Template::builder();
    bud.name("bud").node(Node::disc(Vec2::ZERO, 1.0, 3.0));
    add(world, bud);
    let mut stem = Template::builder();
    let [a, b] = [0.0, 4.0].map(|x| stem.node(Node::disc(Vec2::new(x, 0.0), 1.0, 1.0)));
    // The first half is a small stem.
    stem.link(a, b, 0.0).cut([Half::of([a]).scaled(0.2), Half::of([b]).named("bud")]);
    add(world, stem)
}

#[test]
fn halves_need_room_and_the_reason_is_named() {
    let mut world = room();
    let stem = bud(&mut world);
    let at_wall = world.spawn_template(stem, Placement::at(94.5, 50.0)).unwrap();
    assert!(refused(&mut world, at_wall).starts_with("`cut[1].at` lies outside the walls"));
    let beside = world.spawn_template(stem, Placement::at(30.0, 50.0)).unwrap();
    let mut free = world.clone();
    world.add_obstacle(Obstacle::new(SharedShape::ball(1.0), Pose::translation(37.0, 51.0))).unwrap();
    assert!(refused(&mut world, beside).contains("overlaps an obstacle"));
    free.spawn(&AgarSpec { radius: 0.5, ..AgarSpec::default() }.into(), Placement::at(35.6, 50.0)).unwrap();
    assert!(refused(&mut free, beside).contains("overlaps the agar"));
    let config = WorldConfig { max_particles: 3, ..WorldConfig::default() };
    let mut full = World::new(config).unwrap();
    let stem = add(&mut full, dividing_pair());
    let pair = full.spawn_template(stem, Placement::at(30.0, 30.0)).unwrap();
    assert_eq!(refused(&mut full, pair), "`particles` asks for 4 particles, accepted: at most 3 in one world");
}

fn dividing_pair() -> TemplateBuilder {
    let mut pair = rod(2, "pair");
    pair.cut([Half::of([1]).scaled(0.3), Half::of([0]).scaled(0.3)]);
    pair
}

#[test]
fn who_has_lost_the_room_in_the_step_is_told() {
    let mut world = room();
    let stem = bud(&mut world);
    // Each has room, but not both: buds of radius 3 face each other.
    let [left, right] = [(Vec2::new(40.0, 50.0), 0.0), (Vec2::new(50.2, 50.0), std::f32::consts::PI)]
        .map(|(at, angle)| world.spawn_template(stem, Placement::at(at.x, at.y).turned(angle)).unwrap());
    [left, right].into_iter().for_each(|id| world.divide(id).unwrap());
    world.step(&Inputs::new());
    world.validate().unwrap();
    assert!(matches!(world.events()[0], Event::Divided { parent, .. } if parent == left), "{:?}", world.events());
    assert!(world.events().contains(&Event::DivisionRefused { organism: right, reason: Refusal::NoRoom }));
    assert_eq!(world.organisms().count(), 3);
}

#[test]
fn contacts_of_the_step_are_those_of_the_whole_body() {
    let mut world = room();
    let rod = add(&mut world, dividing("long"));
    // The first lane is free when a body in the second one divides: its first half moves there, and the other one takes its lane.
    let gone = world.spawn_template(rod, Placement::at(20.0, 20.0)).unwrap();
    let parent = world.spawn_template(rod, Placement::at(50.0, 50.0)).unwrap();
    let [left, right] = [48.98, 58.02].map(|x| {
        let ball = world.spawn(&AgarSpec { radius: 0.5, ..AgarSpec::default() }.into(), Placement::at(x, 50.0));
        ball.unwrap()
    });
    world.push(left, Vec2::new(2.0, 0.0)).unwrap();
    world.push(right, Vec2::new(-2.0, 0.0)).unwrap();
    world.remove(gone).unwrap();
    world.divide(parent).unwrap();
    world.step(&Inputs::new());
    let named: Vec<[OrganismId; 2]> = world
        .events()
        .iter()
        .filter_map(|event| match *event {
            Event::ContactBegan { a, b } => Some([a, b]),
            _ => None,
        })
        .collect();
    assert!(!named.is_empty() && named.iter().all(|pair| pair.contains(&parent)), "{:?}", world.events());
    assert!(world.events().iter().any(|event| matches!(event, Event::Divided { .. })));
}

#[test]
fn links_of_a_half_have_flowed_and_torn_as_those_of_the_whole() {
    let chain = |discs: u8, name: &str| {
        let mut builder = Template::builder();
        let node = |k: u8| Node::disc(Vec2::new(2.0 * f32::from(k), 0.0), 1.0, 0.5);
        let discs: Vec<u32> = (0..discs).map(|k| builder.node(node(k))).collect();
        for pair in discs.windows(2) {
            let spring = Distance { a: pair[0], b: pair[1], rest_length: 2.0, compliance: 1e-2, damping: 0.0 };
            let (yield_strain, flow_rate, max_plastic_strain, breaking_strain) = (0.05, 20.0, 1.0, 0.5);
            let yields =
                YieldingDistance { yield_strain, flow_rate, max_plastic_strain, breaking_strain, ..spring.into() };
            builder.constraint(yields);
        }
        builder.name(name);
        builder
    };
    let mut world = room();
    add(&mut world, chain(3, "half"));
    let mut whole = chain(6, "whole");
    whole.cut([0..3, 3..6].map(|slots| Half::of(slots).named("half")));
    let whole = add(&mut world, whole);
    let id = world.spawn_template(whole, Placement::at(50.0, 50.0)).unwrap();
    let mut inputs = Inputs::new();
    inputs.actuate_node(id, 0, Actuation::impulse(Vec2::new(-4.0, 0.0))).unwrap();
    inputs.actuate_node(id, 5, Actuation::impulse(Vec2::new(40.0, 0.0))).unwrap();
    (0..20).for_each(|_| {
        world.step(&inputs);
        inputs.clear();
    });
    let strains = |world: &World, id| -> Vec<Option<f32>> {
        world.view().organism(id).unwrap().yielding_links().map(|link| link.plastic_strain).collect()
    };
    let before = strains(&world, id);
    assert!(before[0].is_some_and(|plastic| plastic > 0.02) && before[4].is_none(), "{before:?}");
    let (divided, whole, halves) = divided(&world, id);
    let expected = strains(&whole, id);
    assert_eq!(halves.map(|half| strains(&divided, half)), [expected[..2].to_vec(), expected[3..].to_vec()]);
}

#[cfg(feature = "snapshot")]
#[test]
fn an_order_to_divide_is_written_and_read() {
    let (mut world, id) = thrown("shorter");
    world.divide(id).unwrap();
    let mut read = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
    [&mut read, &mut world].into_iter().for_each(|world| (0..30).for_each(|_| world.step(&Inputs::new())));
    assert_eq!((read.digest(), read.organisms().count()), (world.digest(), 2));
}
