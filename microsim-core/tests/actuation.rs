//! Forces, impulses, torques and targets on organisms and their nodes, by the laws of mechanics.

use microsim_core::glam::Vec2;
use microsim_core::{
    Actuation, AmoeboidCellSpec, CoccusSpec, Controller, Error, Inputs, Intent, Node, OrganismId, Placement, ProbeSpec,
    Propulsion, Template, World, WorldConfig,
};

/// A room without drag or gravity.
fn room(substeps: u32) -> World {
    World::new(WorldConfig { substeps, damping: 0.0, max_speed: 200.0, ..WorldConfig::default() }).unwrap()
}

/// Two discs of mass 2, each 3 units from the middle, in the middle of the room.
fn dumbbell(world: &mut World, propulsion: Option<Propulsion>) -> OrganismId {
    let mut builder = Template::builder();
    let [a, b] = [-3.0, 3.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 2.0, 0.5)));
    builder.link(a, b, 0.0);
    propulsion.into_iter().for_each(|propulsion| _ = builder.propulsion(propulsion));
    let template = world.add_template(builder.build().unwrap());
    world.spawn_template(template, Placement::at(80.0, 45.0)).unwrap()
}

fn velocities(world: &World, id: OrganismId) -> Vec<Vec2> {
    world.view().organism(id).unwrap().particles().map(|particle| particle.velocity).collect()
}

fn acting(id: OrganismId, actuation: Actuation) -> Inputs {
    let mut inputs = Inputs::new();
    inputs.actuate(id, actuation).unwrap();
    inputs
}

fn steps(world: &mut World, inputs: &Inputs, count: u32) {
    (0..count).for_each(|_| world.step(inputs));
}

#[test]
fn a_force_gives_force_over_mass_whatever_the_substeps() {
    for substeps in [1, 4, 16, 64] {
        let mut world = room(substeps);
        let body = dumbbell(&mut world, None);
        steps(&mut world, &acting(body, Actuation::force(Vec2::new(8.0, -4.0))), 60);
        let expected = Vec2::new(2.0, -1.0);
        for velocity in velocities(&world, body) {
            assert!((velocity - expected).length() < 0.01 * expected.length(), "{substeps}: {velocity}");
        }
        let moved = world.centroid(body).unwrap() - Vec2::new(80.0, 45.0);
        assert!((moved - 0.5 * expected).length() < 0.02, "{substeps}: {moved}");
    }
}

#[test]
fn a_force_moves_a_cell_with_its_cytoplasm_as_a_whole() {
    let mut world = room(8);
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 45.0)).unwrap();
    let mass: f32 = world.view().organism(cell).unwrap().mass();
    steps(&mut world, &acting(cell, Actuation::force(Vec2::X * 4.0 * mass)), 60);
    let moved = world.centroid(cell).unwrap().x - 60.0;
    assert!((moved - 2.0).abs() < 0.05, "{moved}");
    assert_eq!(world.census().leaks, 0);
}

#[test]
fn an_impulse_gives_its_momentum_once_and_a_node_shares_it_with_its_body() {
    let mut world = room(8);
    let body = dumbbell(&mut world, None);
    let mut inputs = acting(body, Actuation::impulse(Vec2::new(6.0, 0.0)));
    world.step(&inputs);
    inputs.clear();
    inputs.actuate_node(body, 1, Actuation::impulse(Vec2::new(6.0, 0.0))).unwrap();
    world.step(&inputs);
    steps(&mut world, &Inputs::new(), 10);
    let velocity = velocities(&world, body).into_iter().sum::<Vec2>() / 2.0;
    assert!((velocity - Vec2::new(3.0, 0.0)).length() < 0.01, "{velocity}");
}

#[test]
fn a_torque_gives_torque_over_inertia_and_no_momentum() {
    for substeps in [1, 8, 32] {
        let mut world = room(substeps);
        let body = dumbbell(&mut world, None);
        // An inertia of 2 * 2 * 9.
        steps(&mut world, &acting(body, Actuation::torque(36.0)), 30);
        let view = world.view().organism(body).unwrap();
        assert!((view.angular_velocity() - 0.5).abs() < 0.005, "{substeps}: {}", view.angular_velocity());
        assert!((view.angle().unwrap() - 0.125).abs() < 0.01, "{substeps}: {:?}", view.angle());
        assert!(view.velocity().length() < 1e-3, "{}", view.velocity());
    }
}

#[test]
fn a_target_is_reached_in_the_step_whatever_the_mass_and_gravity() {
    let config = WorldConfig { gravity: Vec2::new(0.0, -50.0), max_speed: 100.0, ..WorldConfig::default() };
    let mut world = World::new(config).unwrap();
    let probe = world.spawn(&ProbeSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
    for k in 1u8..=60 {
        let target = Vec2::new(40.0, 40.0) + Vec2::new(0.5, 0.25) * f32::from(k);
        world.step(&acting(probe, Actuation::target(target)));
        let at = world.centroid(probe).unwrap();
        assert!((at - target).length() < 1e-3, "{at} {target}");
    }
    world.step(&acting(probe, Actuation::target(Vec2::ZERO)));
    let speed = velocities(&world, probe)[0].length();
    assert!(speed <= 100.1 && speed > 90.0, "{speed}: at the speed limit");
}

#[test]
fn what_sleeps_is_woken() {
    let mut world = room(8);
    let body = dumbbell(&mut world, None);
    steps(&mut world, &Inputs::new(), 60);
    assert!(world.view().organism(body).unwrap().is_at_rest());
    steps(&mut world, &acting(body, Actuation::force(Vec2::new(8.0, 0.0))), 30);
    assert!(world.centroid(body).unwrap().x > 80.2);
}

#[test]
fn an_own_body_follows_an_intent_if_it_is_propelled_and_is_refused_by_name_if_not() {
    let mut world = room(8);
    let propelled = dumbbell(&mut world, Some(Propulsion { speed: 5.0, max_acceleration: 20.0 }));
    let mut inputs = Inputs::new();
    inputs.set(propelled, Intent::toward(Vec2::new(80.0, 80.0)).unwrap());
    world.check_inputs(&inputs).unwrap();
    steps(&mut world, &inputs, 60);
    assert!((world.centroid(propelled).unwrap().y - (45.0 + 5.0 * 0.875)).abs() < 0.1);
    let mut world = room(8);
    let inert = dumbbell(&mut world, None);
    inputs.clear();
    inputs.set(inert, Intent::toward(Vec2::ZERO).unwrap());
    assert_eq!(world.check_inputs(&inputs).unwrap_err().field(), "intent.goal");
    world.set_controller(inert, Controller::Still).unwrap();
}

#[test]
fn inputs_that_name_what_is_not_there_are_found_and_do_nothing() {
    let mut world = room(8);
    let (body, other) =
        (dumbbell(&mut world, None), world.spawn(&CoccusSpec::default().into(), Placement::at(9.0, 9.0)));
    let other = other.unwrap();
    world.remove(other).unwrap();
    let field = |world: &World, change: &dyn Fn(&mut Inputs) -> Result<(), Error>| {
        let mut inputs = Inputs::new();
        change(&mut inputs).unwrap();
        let mut stepped = world.clone();
        stepped.step(&inputs);
        let mut plain = world.clone();
        plain.step(&Inputs::new());
        assert_eq!(stepped.digest(), plain.digest());
        world.check_inputs(&inputs).unwrap_err().field().to_owned()
    };
    assert_eq!(field(&world, &|inputs| inputs.actuate(other, Actuation::force(Vec2::X))), "actuation.organism");
    assert_eq!(field(&world, &|inputs| inputs.actuate_node(body, 2, Actuation::force(Vec2::X))), "actuation.node");
}
