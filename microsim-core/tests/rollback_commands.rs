//! Rollback of a world that players command: what they do to it is input, as what they tell organisms is. Each step is taken back
//! and repeated from a snapshot or a clone, and has to end in the same digest.
#![cfg(feature = "snapshot")]

use ggrs::{Config, GgrsRequest, PredictRepeatLast, SessionBuilder};
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Actuation, AgarSpec, AmoeboidCellSpec, CoccusSpec, CollisionGroups, Distance, Emitter, Error, FieldKind,
    ForceField, Inputs, Intent, JointEnd, JointKind, JointSpec, Node, Obstacle, ObstacleMotion, OrganismId,
    OrganismSpec, Placement, Region, Rng, Template, World, WorldConfig, glam::Vec2,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Steps that are taken back and repeated after each step.
const DISTANCE: usize = 6;
const PLAYERS: usize = 2;

/// What a player does in a step: which of [`ORDERS`], to which two organisms, where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Told {
    order: u8,
    who: [u8; 2],
    at: [f32; 2],
    goal: [f32; 2],
}

#[derive(Clone)]
enum Saved {
    Snapshot(Vec<u8>),
    Clone(Box<World>),
}

#[derive(Debug)]
struct Game;

impl Config for Game {
    type InputPredictor = PredictRepeatLast;
    type Input = Told;
    type State = Saved;
    type Address = u8;
}

type Order = fn(&mut World, [OrganismId; 2], Vec2) -> Result<(), Error>;

/// All that players can do to the world.
const ORDERS: [(&str, Order); 24] = [
    ("spawn", |world, _, at| world.spawn(&AgarSpec::default().into(), Placement::at(at.x, at.y)).map(drop)),
    ("spawn_template", |world, _, at| {
        let Some(fibre) = world.template_named("fibre") else { return Ok(()) };
        world.spawn_template(fibre, Placement::at(at.x, at.y).turned(at.x).damped(0.5, 0.5)).map(drop)
    }),
    ("remove", |world, [id, _], _| if world.organisms().count() > 6 { world.remove(id) } else { Ok(()) }),
    ("replace", |world, [id, _], at| {
        let coccus = OrganismSpec::from(CoccusSpec::default());
        world.replace(id, &coccus.into(), Placement::at(at.x, at.y)).map(drop)
    }),
    ("push", |world, [id, _], at| world.push(id, at - 20.0)),
    ("add_joint", |world, [a, b], _| {
        let rope = JointKind::Rope { max_length: 12.0 };
        world.add_joint(JointSpec::new(JointEnd::Centre(a), JointEnd::Centre(b), rope).breaking_at(400.0)).map(drop)
    }),
    ("set_joint", |world, _, at| {
        let Some(joint) = world.joints().next() else { return Ok(()) };
        let kind = JointKind::SpeedMotor { speed: 0.2 * (at.x - 30.0), max_force: 100.0 };
        world.set_joint(joint.id, JointSpec { kind, ..joint.spec })
    }),
    ("remove_joint", |world, _, _| {
        let first = world.joints().next();
        first.map_or(Ok(()), |joint| world.remove_joint(joint.id))
    }),
    ("add_obstacle", |world, _, at| {
        let ball = Obstacle::new(SharedShape::ball(0.8), Pose::translation(at.x, at.y));
        world.add_obstacle(ball).map(drop)
    }),
    ("remove_obstacle", |world, _, _| {
        let third = world.obstacles().nth(2);
        third.map_or(Ok(()), |id| world.remove_obstacle(id))
    }),
    ("move_obstacle", |world, _, at| {
        let Some(lift) = world.obstacles().next() else { return Ok(()) };
        world.move_obstacle(lift, Pose::translation(at.x, 3.0 + 0.2 * at.y))
    }),
    ("set_obstacle_pose", |world, _, at| {
        let Some(door) = world.obstacles().nth(1) else { return Ok(()) };
        world.set_obstacle_pose(door, Pose::translation(at.x, at.y))
    }),
    ("add_field", |world, _, at| {
        let kind = FieldKind::Radial { centre: at, acceleration: 20.0 };
        world.add_field(ForceField { region: Region::Circle { centre: at, radius: 15.0 }, kind }).map(drop)
    }),
    ("remove_field", |world, _, _| {
        let first = world.fields().map(|(id, _)| id).next();
        first.map_or(Ok(()), |id| world.remove_field(id))
    }),
    ("add_emitter", |world, _, at| {
        let spot = Region::Circle { centre: at, radius: 2.0 };
        world.add_emitter(Emitter::new(spot, OrganismSpec::from(CoccusSpec::default()).into(), 3.0)).map(drop)
    }),
    ("remove_emitter", |world, _, _| {
        let first = world.emitters().map(|(id, _)| id).next();
        first.map_or(Ok(()), |id| world.remove_emitter(id))
    }),
    ("set_gravity", |world, _, at| world.set_gravity(at - 30.0)),
    ("set_damping", |world, _, at| world.set_damping(0.05 * at.x)),
    ("set_max_speed", |world, _, at| world.set_max_speed(20.0 + at.x)),
    ("set_size", |world, _, at| world.set_size(Vec2::new(60.0, 40.0) + 0.1 * at)),
    ("set_own_damping", |world, [a, b], at| {
        world.set_linear_damping(a, 0.1 * at.x)?;
        world.set_angular_damping(b, 0.1 * at.y)
    }),
    ("set_scale", |world, [id, _], at| world.set_scale(id, 0.8 + 0.008 * at.x)),
    ("set_groups", |world, [a, b], _| {
        world.set_exempt(a, b, true)?;
        world.set_collision_groups(a, CollisionGroups { memberships: 1, filter: !2 })
    }),
    ("divide", |world, [id, _], _| world.divide(id)),
];

/// A lift, a door, fibres with a muscle, a cell and balls.
fn build() -> Result<World, Error> {
    let (size, gravity) = (Vec2::new(60.0, 40.0), Vec2::new(0.0, -5.0));
    let mut world =
        World::new(WorldConfig { size, gravity, max_speed: 40.0, max_particles: 1500, ..WorldConfig::default() })?;
    let bar = |half: [f32; 2], x| Obstacle::new(SharedShape::cuboid(half[0], half[1]), Pose::translation(x, 3.0));
    world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..bar([4.0, 0.6], 30.0) })?;
    world.add_obstacle(bar([0.6, 2.0], 55.0))?;
    let mut builder = Template::builder();
    let [a, b] = [0.0, 3.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    let beat = builder.name("fibre").channel([1.0, 0.5]);
    builder.muscle(beat, Distance { a, b, rest_length: 3.0, compliance: 0.0, damping: 0.0 });
    let fibre = world.add_template(builder.build()?);
    for x in [10.0, 20.0, 40.0] {
        world.spawn_template(fibre, Placement::at(x, 32.0))?;
        world.spawn(&AgarSpec::default().into(), Placement::at(x, 26.0))?;
    }
    let cell = AmoeboidCellSpec { radii: Vec2::splat(6.0), ..AmoeboidCellSpec::default() };
    world.spawn(&cell.into(), Placement::at(16.0, 12.0))?;
    Ok(world)
}

/// Takes a step after what players do; notes which orders the world has accepted.
fn advance(world: &mut World, told: &[Told], accepted: &mut BTreeMap<&'static str, u32>) {
    for told in told {
        let ids: Vec<OrganismId> = world.organisms().collect();
        let who = told.who.map(|k| ids[usize::from(k) % ids.len()]);
        let Some((name, order)) = ORDERS.get(usize::from(told.order)) else { continue };
        if order(world, who, told.at.into()).is_ok() {
            *accepted.entry(name).or_default() += 1;
        }
    }
    let mut inputs = Inputs::new();
    let fibre = world.template_named("fibre");
    let ids: Vec<OrganismId> = world.organisms().collect();
    for (k, &id) in ids.iter().enumerate() {
        let told = told[k % told.len()];
        inputs.set(id, Intent::toward(told.goal.into()).unwrap().digesting(told.order > 12));
        if world.view().organism(id).unwrap().template() == fibre {
            inputs.activate(id, 0, told.goal[0] / 60.0).unwrap();
            inputs.actuate(id, Actuation::force(Vec2::from(told.goal) - 20.0)).unwrap();
        }
    }
    world.step(&inputs);
}

fn decide(before: Told, rng: &mut Rng) -> Told {
    let mut place = || [rng.range(0.0, 60.0), rng.range(0.0, 40.0)];
    let (at, there) = (place(), place());
    let order = (rng.next_u32() % 48) as u8;
    let goal = if rng.next_u32().is_multiple_of(10) { there } else { before.goal };
    Told { order, who: [(); 2].map(|()| rng.next_u32() as u8), at, goal }
}

/// Plays so many steps; the session compares the digest of every step with those of its repetitions.
fn synchronise(steps: u32, seed: u64) -> (World, BTreeMap<&'static str, u32>) {
    let mut world = build().unwrap();
    let builder = SessionBuilder::<Game>::new().with_num_players(PLAYERS).unwrap().with_input_delay(0);
    let builder = builder.with_max_prediction_window(DISTANCE + 1).with_check_distance(DISTANCE);
    let mut session = builder.start_synctest_session().unwrap();
    let (mut rng, mut told, mut accepted) = (Rng::new(seed, 0), [Told::default(); PLAYERS], BTreeMap::new());
    for step in 0..steps {
        for (player, told) in told.iter_mut().enumerate() {
            *told = decide(*told, &mut rng);
            session.add_local_input(player, *told).unwrap();
        }
        for request in session.advance_frame().unwrap_or_else(|mismatch| panic!("step {step}: {mismatch}")) {
            match request {
                GgrsRequest::SaveGameState { cell, frame } => {
                    let clone = || Saved::Clone(Box::new(world.clone()));
                    let saved = if frame % 2 == 0 { clone() } else { Saved::Snapshot(world.to_snapshot().unwrap()) };
                    cell.save(frame, Some(saved), Some(world.digest().into()));
                }
                GgrsRequest::LoadGameState { cell, .. } => match cell.load().unwrap() {
                    Saved::Snapshot(bytes) => world = World::from_snapshot(&bytes).unwrap(),
                    Saved::Clone(saved) => world.clone_from(&saved),
                },
                GgrsRequest::AdvanceFrame { inputs } => {
                    let told: Vec<Told> = inputs.into_iter().map(|(told, _)| told).collect();
                    advance(&mut world, &told, &mut accepted);
                }
            }
        }
        world.validate().unwrap();
    }
    (world, accepted)
}

#[test]
fn what_players_do_to_the_world_can_be_taken_back() {
    let (world, accepted) = synchronise(240, 1);
    assert_eq!(world.step_index(), 240);
    let missing: Vec<&str> = ORDERS.iter().map(|order| order.0).filter(|name| !accepted.contains_key(name)).collect();
    assert!(missing.is_empty(), "no player has done {missing:?}, but {accepted:?}");
}

#[test]
#[ignore = "takes minutes; run it in release"]
fn three_thousand_steps_of_commands_can_be_taken_back() {
    assert_eq!(synchronise(3000, 2).0.step_index(), 3000);
}
