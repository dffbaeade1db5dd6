//! Links that flow and tear: their laws, and that each body of a block does so by itself.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::{
    Actuation, Distance, Event, Inputs, Node, OrganismId, Placement, Role, Template, TemplateId, World, WorldConfig,
    YieldingDistance,
};

/// Steps and substeps: substeps of 2.1 to 8.3 ms.
const TIMES: [(f32, u32); 4] = [(1.0 / 60.0, 8), (1.0 / 60.0, 2), (1.0 / 120.0, 4), (1.0 / 240.0, 1)];
/// So heavy that a link does not move it.
const HEAVY: f32 = 1e6;

/// A link of length 1 of the first two nodes that neither flows nor tears.
fn link(compliance: f32, damping: f32) -> YieldingDistance {
    Distance { a: 0, b: 1, rest_length: 1.0, compliance, damping }.into()
}

fn world((dt, substeps): (f32, u32)) -> World {
    World::new(WorldConfig { dt, substeps, damping: 0.0, ..WorldConfig::default() }).unwrap()
}

/// Two nodes side by side; one without a mass is fixed.
fn pair(link: YieldingDistance, masses: [Option<f32>; 2], length: f32) -> Template {
    let mut builder = Template::builder();
    for (mass, x) in masses.into_iter().zip([0.0, length]) {
        let at = Vec2::new(x, 0.0);
        builder.node(mass.map_or(Node::fixed(at), |mass| Node::disc(at, mass, 0.2)));
    }
    builder.constraint(link);
    builder.build().unwrap()
}

fn spawn(world: &mut World, template: Template) -> OrganismId {
    let template = world.add_template(template);
    world.spawn_template(template, Placement::at(40.0, 40.0)).unwrap()
}

fn nodes(world: &World, id: OrganismId) -> Vec<Vec2> {
    world.view().organism(id).unwrap().particles().map(|particle| particle.position).collect()
}

fn length(world: &World, id: OrganismId) -> f32 {
    nodes(world, id)[0].distance(nodes(world, id)[1])
}

/// Plastic strain of the first link; `None` once it tore.
fn plastic(world: &World, id: OrganismId) -> Option<f32> {
    world.view().organism(id).unwrap().yielding_links().next().unwrap().plastic_strain
}

/// Takes steps for so many seconds; returns the nodes of links that tore.
fn run(world: &mut World, inputs: &Inputs, seconds: f32) -> Vec<(OrganismId, [u32; 2])> {
    let mut torn = Vec::new();
    for _ in 0..(seconds / world.config().dt).round() as u32 {
        world.step(inputs);
        torn.extend(world.events().iter().filter_map(|event| match *event {
            Event::LinkTorn { organism, nodes } => Some((organism, nodes)),
            _ => None,
        }));
        world.validate().unwrap();
    }
    torn
}

#[test]
fn at_a_length_that_is_held_the_excess_decays_exponentially() {
    for time in TIMES {
        for rate in [0.5, 5.0, 20.0] {
            for length in [1.3, 0.7] {
                let mut world = world(time);
                let yielding =
                    YieldingDistance { yield_strain: 0.1, flow_rate: rate, max_plastic_strain: 0.5, ..link(1.0, 0.0) };
                let id = spawn(&mut world, pair(yielding, [Some(HEAVY); 2], length));
                let steps = (1.0 / rate / time.0).round();
                run(&mut world, &Inputs::new(), steps * time.0);
                let expected = 0.2 * (1.0 - (-rate * steps * time.0).exp()) * (length - 1.0).signum();
                let flowed = plastic(&world, id).unwrap();
                assert!((flowed / expected - 1.0).abs() < 0.01, "{time:?} {rate} {length}: {flowed}, not {expected}");
            }
        }
    }
}

/// A disc that hangs on a link with a strain of 0.3, of which 0.2 are in excess, and a damping time of 0.2 s.
fn hanging(world: &mut World, rate: f32, max_plastic_strain: f32) -> OrganismId {
    let yielding = YieldingDistance { yield_strain: 0.1, flow_rate: rate, max_plastic_strain, ..link(0.03, 0.2) };
    let id = spawn(world, pair(yielding, [None, Some(1.0)], 1.3));
    run(world, &Inputs::new(), 0.5);
    id
}

/// Along the link of [`hanging`].
fn pulled(time: (f32, u32)) -> World {
    let config = world(time).config().clone();
    World::new(WorldConfig { gravity: Vec2::new(10.0, 0.0), ..config }).unwrap()
}

#[test]
fn under_a_constant_force_it_creeps_at_a_constant_rate_up_to_its_largest_strain() {
    for time in TIMES {
        for rate in [0.5, 4.0] {
            let mut world = pulled(time);
            let id = hanging(&mut world, rate, 2.0);
            let before = plastic(&world, id).unwrap();
            run(&mut world, &Inputs::new(), 1.0);
            let speed = plastic(&world, id).unwrap() - before;
            // Slower by half of rate times substep, and by the damping, as the fields say.
            let rate = rate * (1.0 - 0.5 * rate * time.0 / time.1 as f32);
            let expected = rate * 0.2 / (1.0 + 0.2 * rate);
            assert!((speed / expected - 1.0).abs() < 0.02, "{time:?} {rate}: {speed} in a second, not {expected}");
        }
        let mut world = pulled(time);
        let id = hanging(&mut world, 4.0, 0.5);
        run(&mut world, &Inputs::new(), 2.0);
        assert_eq!(plastic(&world, id), Some(0.5));
        world.set_gravity_scale(id, 0.0).unwrap();
        run(&mut world, &Inputs::new(), 8.0);
        assert!(
            (length(&world, id) - 1.5).abs() < 0.01,
            "it springs back to what has flowed, not {}",
            length(&world, id)
        );
    }
}

#[test]
fn below_its_yield_strain_it_is_elastic() {
    let mut world = pulled(TIMES[0]);
    let yielding = YieldingDistance { yield_strain: 0.31, flow_rate: 50.0, max_plastic_strain: 1.0, ..link(0.03, 0.2) };
    let id = spawn(&mut world, pair(yielding, [None, Some(1.0)], 1.3));
    run(&mut world, &Inputs::new(), 5.0);
    assert_eq!(plastic(&world, id), Some(0.0));
    assert!((length(&world, id) - 1.3).abs() < 1e-3);
}

#[test]
fn it_tears_at_its_breaking_strain() {
    const BREAKING: f32 = 0.25;
    for time in TIMES {
        let mut world = world(time);
        let breaking = YieldingDistance { breaking_strain: BREAKING, ..link(1e-3, 0.05) };
        let id = spawn(&mut world, pair(breaking, [None, Some(1.0)], 1.0));
        let (mut inputs, mut last, mut torn) = (Inputs::new(), 0.0, Vec::new());
        while torn.is_empty() {
            last = length(&world, id) - 1.0;
            // A strain of 0.1 more in a second.
            inputs.actuate_node(id, 1, Actuation::force(Vec2::new(100.0 * world.time() as f32, 0.0))).unwrap();
            torn = run(&mut world, &inputs, time.0);
        }
        assert!(last > 0.98 * BREAKING && last < 1.001 * BREAKING, "{time:?}: it bore {last}");
        assert_eq!((torn, plastic(&world, id)), (vec![(id, [0, 1])], None));
        assert!(run(&mut world, &Inputs::new(), 1.0).is_empty(), "it is reported once");
        assert!(length(&world, id) > 1.05 + BREAKING, "nothing holds it");
    }
}

/// Two free discs that are pushed apart.
fn parted(world: &mut World, template: TemplateId, at: Placement, impulse: f32, inputs: &mut Inputs) -> OrganismId {
    let id = world.spawn_template(template, at).unwrap();
    for (node, sign) in [(0, -1.0), (1, 1.0)] {
        inputs.actuate_node(id, node, Actuation::impulse(Vec2::new(sign * impulse, 0.3 * sign * impulse))).unwrap();
    }
    id
}

fn ductile() -> YieldingDistance {
    YieldingDistance {
        yield_strain: 0.1,
        flow_rate: 5.0,
        max_plastic_strain: 0.3,
        breaking_strain: 0.5,
        ..link(0.01, 0.0)
    }
}

#[test]
fn momentum_is_kept_while_it_flows_and_when_it_tears() {
    for (impulse, tears) in [(1.5, false), (6.0, true)] {
        let mut world = world(TIMES[0]);
        let template = world.add_template(pair(ductile(), [Some(1.0), Some(3.0)], 1.0));
        let mut inputs = Inputs::new();
        let id = parted(&mut world, template, Placement::at(40.0, 40.0), impulse, &mut inputs);
        inputs.actuate(id, Actuation::impulse(Vec2::new(2.0, 1.0))).unwrap();
        world.step(&inputs);
        let momentum = |world: &World| world.view().organism(id).unwrap().velocity() * 4.0;
        let before = momentum(&world);
        assert_eq!(run(&mut world, &Inputs::new(), 1.0).len(), usize::from(tears));
        assert!(plastic(&world, id).is_none_or(|plastic| plastic > 0.01), "it has flowed or torn");
        assert!((momentum(&world) - before).length() < 2e-5 && before.x > 1.9, "{before}, then {}", momentum(&world));
    }
}

/// Eight bodies of one block that are pushed apart more and more.
fn eight(world: &mut World) -> (Vec<OrganismId>, Inputs) {
    let template = world.add_template(pair(ductile(), [Some(1.0); 2], 1.0));
    let mut inputs = Inputs::new();
    let at = |k: u8| Placement::at(20.0 + 15.0 * f32::from(k), 40.0).scaled(1.0 + 0.1 * f32::from(k));
    let spawn = |k: u8| parted(world, template, at(k), 1.2 * f32::from(k), &mut inputs);
    ((0..8).map(spawn).collect(), inputs)
}

#[test]
fn eight_bodies_of_a_block_meet_their_fates_alone() {
    let mut world = world(TIMES[0]);
    let (ids, inputs) = eight(&mut world);
    let mut alone: Vec<World> = (0..8).map(|_| world.clone()).collect();
    world.step(&inputs);
    run(&mut world, &Inputs::new(), 1.0);
    let fates: Vec<_> = ids.iter().map(|&id| plastic(&world, id)).collect();
    assert!(fates[0] == Some(0.0) && fates[3] > Some(0.01) && fates[7].is_none(), "{fates:?}");
    for (k, world_of_one) in alone.iter_mut().enumerate() {
        let others = ids.iter().enumerate().filter(|(other, _)| *other != k);
        others.for_each(|(_, &id)| world_of_one.remove(id).unwrap());
        world_of_one.step(&inputs);
        run(world_of_one, &Inputs::new(), 1.0);
        assert_eq!(nodes(world_of_one, ids[k]), nodes(&world, ids[k]), "{k}");
        assert_eq!(plastic(world_of_one, ids[k]), fates[k]);
    }
}

#[test]
fn who_takes_the_place_of_a_torn_body_is_whole() {
    let mut world = world(TIMES[0]);
    let (ids, inputs) = eight(&mut world);
    world.step(&inputs);
    run(&mut world, &Inputs::new(), 1.0);
    assert_eq!(plastic(&world, ids[7]), None);
    world.remove(ids[7]).unwrap();
    let template = world.view().organism(ids[0]).unwrap().template().unwrap();
    let new = world.spawn_template(template, Placement::at(40.0, 70.0)).unwrap();
    let at = Placement::at(60.0, 70.0);
    let replaced = world.replace(ids[6], &microsim_core::Recipe::Template(template), at).unwrap();
    assert_eq!([new, replaced].map(|id| plastic(&world, id)), [Some(0.0); 2]);
    let fate = plastic(&world, ids[3]);
    run(&mut world, &Inputs::new(), 1.0);
    assert!(fate.is_some() && plastic(&world, ids[3]) >= fate);
}

#[test]
fn clones_and_snapshots_flow_and_tear_alike() {
    let mut world = world(TIMES[0]);
    let (_, inputs) = eight(&mut world);
    world.step(&inputs);
    for _ in 0..5 {
        let mut others = vec![world.clone()];
        #[cfg(feature = "snapshot")]
        others.push(World::from_snapshot(&world.to_snapshot().unwrap()).unwrap());
        let torn = run(&mut world, &Inputs::new(), 0.1);
        for mut other in others {
            assert_eq!(run(&mut other, &Inputs::new(), 0.1), torn);
            assert_eq!((other.first_difference(&world), other.digest()), (None, world.digest()));
        }
    }
}

#[test]
fn what_tore_is_neither_drawn_nor_counted_nor_measured() {
    let mut builder = Template::builder();
    let corner = |k: u8| 3.0 * microsim_core::geometry::unit_vector(f32::from(k) * std::f32::consts::TAU / 8.0);
    let node = |k: u8| Node { role: Role::Membrane, ..Node::disc(corner(k), 1.0, 0.3) };
    let ring: Vec<u32> = (0..8).map(|k| builder.node(node(k))).collect();
    let rest_length = corner(0).distance(corner(1));
    for (&a, k) in ring.iter().zip(1..) {
        let spring = Distance { a, b: ring[k % 8], rest_length, compliance: 1e-3, damping: 0.1 };
        builder.constraint(YieldingDistance { breaking_strain: 0.3, ..spring.into() });
    }
    builder.outline(&ring);
    let mut world = World::new(WorldConfig { damping: 2.0, ..WorldConfig::default() }).unwrap();
    let id = spawn(&mut world, builder.build().unwrap());
    assert_eq!((world.view().bonds().count(), world.census().constraints), (8, 8));
    let mut inputs = Inputs::new();
    inputs.actuate_node(id, 0, Actuation::force(Vec2::new(600.0, -600.0))).unwrap();
    inputs.actuate_node(id, 1, Actuation::force(Vec2::new(-600.0, 600.0))).unwrap();
    let torn = run(&mut world, &inputs, 0.3);
    assert!(torn.contains(&(id, [0, 1])), "{torn:?}");
    run(&mut world, &Inputs::new(), 5.0);
    let left = 8 - torn.len();
    assert_eq!((world.view().bonds().count(), world.census().constraints), (left, left));
    let quality = world.quality();
    assert!(length(&world, id) > 1.5 * rest_length && quality.edge_stretch_max < 0.05, "{quality:?}");
}

#[test]
fn a_body_that_flows_slowly_stays_awake_until_it_has_flowed() {
    let mut world = pulled(TIMES[0]);
    let id = hanging(&mut world, 0.1, 0.2);
    let is_at_rest = |world: &World| world.view().organism(id).unwrap().is_at_rest();
    run(&mut world, &Inputs::new(), 7.0);
    assert!(plastic(&world, id).unwrap() > 0.14 && !is_at_rest(&world), "{:?}", plastic(&world, id));
    run(&mut world, &Inputs::new(), 6.0);
    assert!(plastic(&world, id) == Some(0.2) && is_at_rest(&world), "{:?}", plastic(&world, id));
}

#[test]
fn halves_of_a_torn_body_meet_if_it_collides_with_itself() {
    let mut builder = Template::builder();
    [0.0, 1.0].into_iter().for_each(|x| _ = builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.4)));
    builder.constraint(YieldingDistance { breaking_strain: 0.2, ..link(0.01, 0.0) }).self_contacts(&[0, 1]);
    let mut world = world(TIMES[0]);
    let id = spawn(&mut world, builder.build().unwrap());
    let mut inputs = Inputs::new();
    for (force, seconds) in [(30.0, 0.5), (-30.0, 3.0)] {
        inputs.actuate_node(id, 0, Actuation::force(Vec2::new(-force, 0.0))).unwrap();
        inputs.actuate_node(id, 1, Actuation::force(Vec2::new(force, 0.0))).unwrap();
        run(&mut world, &inputs, seconds);
        assert_eq!(plastic(&world, id), None);
    }
    let nodes = nodes(&world, id);
    assert!(nodes[1].x - nodes[0].x > 0.79 && length(&world, id) < 0.82, "pressed together: {nodes:?}");
}

#[test]
fn growth_and_activation_are_no_strain_but_what_resists_them_is() {
    let mut world = world(TIMES[0]);
    let yielding = YieldingDistance {
        yield_strain: 0.05,
        flow_rate: 50.0,
        max_plastic_strain: 1.0,
        breaking_strain: 0.2,
        ..link(1e-3, 0.05)
    };
    let id = spawn(&mut world, pair(yielding, [Some(1.0); 2], 1.0));
    for k in 1..=100u8 {
        world.set_scale(id, 1.0 + 0.005 * f32::from(k)).unwrap();
        world.step(&Inputs::new());
    }
    run(&mut world, &Inputs::new(), 2.0);
    assert!(plastic(&world, id) == Some(0.0) && (length(&world, id) - 1.5).abs() < 0.01);
    for (mass, tears) in [(1.0, false), (HEAVY, true)] {
        let mut builder = Template::builder();
        [0.0, 1.0].into_iter().for_each(|x| _ = builder.node(Node::disc(Vec2::new(x, 0.0), mass, 0.1)));
        let channel = builder.channel([1.0, 0.6]);
        builder.muscle(channel, YieldingDistance { breaking_strain: 0.5, ..link(1e-4, 0.01) });
        let muscle = world.add_template(builder.build().unwrap());
        let muscle = world.spawn_template(muscle, Placement::at(40.0, 60.0)).unwrap();
        let mut inputs = Inputs::new();
        for step in 0..=60u8 {
            inputs.activate(muscle, channel, f32::from(step) / 60.0).unwrap();
            world.step(&inputs);
        }
        assert_eq!(plastic(&world, muscle).is_none(), tears, "a mass of {mass}");
        world.remove(muscle).unwrap();
    }
}

#[test]
fn in_a_chain_strains_exceed_those_of_the_load_by_the_share_that_the_field_says() {
    const LINKS: u32 = 5;
    for time in TIMES {
        let mut builder = Template::builder();
        builder.node(Node::fixed(Vec2::ZERO));
        (1..=LINKS).for_each(|k| _ = builder.node(Node::disc(Vec2::new(k as f32, 0.0), 1.0, 0.2)));
        let (compliance, damping) = (5e-3, 0.02);
        (0..LINKS).for_each(|a| _ = builder.constraint(YieldingDistance { a, b: a + 1, ..link(compliance, damping) }));
        let config = pulled(time).config().clone();
        let mut world = World::new(WorldConfig { damping: 1.0, sleeps: false, ..config }).unwrap();
        let id = spawn(&mut world, builder.build().unwrap());
        run(&mut world, &Inputs::new(), 20.0);
        let (h, load) = (time.0 / time.1 as f32, 10.0 * LINKS as f32 * compliance);
        let excess = (length(&world, id) - 1.0) / load - 1.0;
        // But for the last node, whose link is projected last.
        let expected = h * (h + damping) / compliance * (LINKS - 1) as f32 / LINKS as f32;
        assert!((excess / expected - 1.0).abs() < 0.05, "{time:?}: {excess} of the strain, not {expected}");
    }
}
