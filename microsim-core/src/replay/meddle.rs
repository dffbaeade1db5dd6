//! Changes for tests of replays: all that a program can do to a world, one thing in each step; then nothing.

use crate::id::OrganismId;
use crate::{
    AccelerationGrid, AgarSpec, AmoeboidCellSpec, ChemicalSpec, CoccusSpec, CollisionGroups, ContactReporting,
    Controller, DivisionParams, Drain, Emitter, Error, Exchange, FieldKind, ForceField, Half, JointEnd, JointKind,
    JointSpec, Kind, Node, Obstacle, ObstacleMotion, OrganismSpec, PhagocytosisParams, Placement, Recipe, Region,
    Template, World,
};
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;

fn first_two(world: &World) -> [OrganismId; 2] {
    [0, 1].map(|k| world.organisms().nth(k).unwrap())
}

/// What is done before this step.
pub(super) fn meddle(step: u32, world: &mut World) -> Result<(), Error> {
    change_obstacles(step, world)?;
    change_joints_and_fields(step, world)?;
    change_organisms(step, world)?;
    change_conditions(step, world)?;
    change_cell(step, world)?;
    divide_body(step, world)?;
    resupply(step, world)
}

fn change_obstacles(step: u32, world: &mut World) -> Result<(), Error> {
    let bar = Obstacle::new(SharedShape::cuboid(3.0, 0.5), Pose::translation(20.0, 26.0));
    let obstacle = world.obstacles().next();
    match step {
        0 => drop(world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..bar })?),
        1 => world.move_obstacle(obstacle.unwrap(), Pose::new(Vec2::new(20.0, 25.9), 0.01))?,
        2 => world.set_obstacle_pose(obstacle.unwrap(), Pose::translation(20.0, 24.0))?,
        3 => world.set_obstacle_shape(obstacle.unwrap(), SharedShape::ball(1.0))?,
        4 => world.set_obstacle_enabled(obstacle.unwrap(), false)?,
        5 => world.remove_obstacle(obstacle.unwrap())?,
        _ => {}
    }
    Ok(())
}

fn change_joints_and_fields(step: u32, world: &mut World) -> Result<(), Error> {
    let [one, two] = first_two(world);
    let wind = ForceField { region: Region::All, kind: FieldKind::Uniform { acceleration: Vec2::new(3.0, 0.0) } };
    let rope = JointSpec::new(JointEnd::Centre(one), JointEnd::Centre(two), JointKind::Rope { max_length: 15.0 });
    let (joint, field) = (world.joints().next(), world.fields().next().map(|(id, _)| id));
    match step {
        6 => drop(world.add_joint(rope)?),
        7 => world.set_joint(joint.unwrap().id, JointSpec { kind: JointKind::Rope { max_length: 12.0 }, ..rope })?,
        8 => world.remove_joint(joint.unwrap().id)?,
        9 => drop(world.add_field(wind)?),
        10 => {
            let saddle = |at: Vec2| 0.1 * (at - 20.0) * Vec2::new(1.0, -1.0);
            let grid = AccelerationGrid::sampled(Vec2::ZERO, Vec2::splat(40.0), [4, 4], saddle)?;
            world.set_field(field.unwrap(), ForceField { kind: FieldKind::Grid(grid), ..wind })?;
        }
        11 => world.remove_field(field.unwrap())?,
        _ => {}
    }
    Ok(())
}

fn change_organisms(step: u32, world: &mut World) -> Result<(), Error> {
    let ([one, two], last) = (first_two(world), world.organisms().last().unwrap());
    match step {
        12 => drop(world.spawn(&AgarSpec::default().into(), Placement::at(35.0, 25.0))?),
        13 => {
            let mut builder = Template::builder();
            builder.node(Node::disc(Vec2::ZERO, 1.0, 0.5));
            builder.name("dot");
            let template = world.add_template(builder.build()?);
            world.spawn_template(template, Placement::at(5.0, 25.0).damped(1.0, 0.0))?;
        }
        14 => world.set_gravity_scale(last, 0.5)?,
        15 => world.set_user_data(last, u128::MAX - 5)?,
        16 => world.push(last, Vec2::new(2.0, -1.0))?,
        17 => world.set_collision_groups(last, CollisionGroups { memberships: 2, filter: 1 << 31 })?,
        18 => world.remove(last)?,
        19 => world.set_exempt(one, two, true)?,
        20 => world.set_controller(one, Controller::wander([0.1, 0.2], 0.0))?,
        _ => {}
    }
    Ok(())
}

fn change_conditions(step: u32, world: &mut World) -> Result<(), Error> {
    match step {
        21 => world.set_gravity(Vec2::new(0.0, -2.0))?,
        22 => world.set_damping(0.5)?,
        23 => world.set_max_speed(200.0)?,
        24 => world.set_contact_reporting(Some(ContactReporting { hit_speed: Some(1.0) }))?,
        25 => {
            let chemical = world.add_chemical(ChemicalSpec::default())?;
            world.set_exchange(first_two(world)[0], Exchange { chemical, secretion: 1.0, uptake: 0.0 })?;
        }
        36 => world.set_size(Vec2::new(44.0, 32.0))?,
        37 => world.set_linear_damping(first_two(world)[0], 1.5)?,
        38 => world.set_angular_damping(first_two(world)[0], 2.5)?,
        _ => {}
    }
    Ok(())
}

fn change_cell(step: u32, world: &mut World) -> Result<(), Error> {
    let cell = world.organisms().last().unwrap();
    match step {
        26 => {
            let division = DivisionParams { least_particles: 10, ..DivisionParams::default() };
            let spec = AmoeboidCellSpec { radii: Vec2::splat(4.0), division, ..AmoeboidCellSpec::default() };
            world.spawn(&spec.into(), Placement::at(20.0, 6.0))?;
        }
        27 => world.grow(cell, 2, 3)?,
        28 => world.shrink(cell, 2)?,
        29 => world.set_speed(cell, 5.0)?,
        30 => world.set_phagocytosis(cell, PhagocytosisParams { hold_time: 0.1, ..PhagocytosisParams::default() })?,
        31 => world.divide(cell)?,
        _ => {}
    }
    Ok(())
}

/// A body that becomes heavier and divides.
fn divide_body(step: u32, world: &mut World) -> Result<(), Error> {
    let pair = world.organisms().find(|&id| world.kind(id) == world.template_named("pair").map(Kind::Custom));
    match step {
        50 => {
            let mut builder = Template::builder();
            [0.0, 0.9].into_iter().for_each(|x| _ = builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.4)));
            builder.name("pair").cut([Half::of([0]).scaled(0.5), Half::of([1]).scaled(0.5)]);
            let template = world.add_template(builder.build()?);
            world.spawn_template(template, Placement::at(40.0, 3.0))?;
        }
        51 => world.set_mass(pair.unwrap(), 3.0)?,
        52 => world.divide(pair.unwrap())?,
        _ => {}
    }
    Ok(())
}

/// Emitters and drains, another size, another organism.
fn resupply(step: u32, world: &mut World) -> Result<(), Error> {
    let two = first_two(world)[1];
    let at = world.centroid(two).unwrap();
    let (emitter, drain) = (world.emitters().next().map(|it| it.0), world.drains().next().map(|it| it.0));
    let inlet = Emitter::new(Region::All, Recipe::Organism(CoccusSpec::default().into()), 10.0);
    let outlet = Drain { region: Region::Circle { centre: Vec2::splat(8.0), radius: 5.0 }, kind: Some(Kind::Coccus) };
    match step {
        32 => drop(world.add_emitter(inlet)?),
        33 => world.set_emitter(emitter.unwrap(), Emitter { rate: 30.0, ..inlet })?,
        34 => world.set_scale(two, 1.05)?,
        35 => drop(world.replace(two, &OrganismSpec::from(CoccusSpec::default()).into(), Placement::at(at.x, at.y))?),
        45 => world.remove_emitter(emitter.unwrap())?,
        46 => drop(world.add_drain(outlet)?),
        47 => world.set_drain(drain.unwrap(), Drain { region: Region::All, ..outlet })?,
        48 => world.remove_drain(drain.unwrap())?,
        _ => {}
    }
    Ok(())
}
