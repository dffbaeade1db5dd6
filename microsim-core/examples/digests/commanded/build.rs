//! How the scene is built.

use super::Commanded;
use microsim_core::geometry::unit_vector;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AccelerationGrid, AgarSpec, AmoeboidCellSpec, Area, CoccusSpec, ContactReporting, Distance, Drain, Emitter,
    EmitterId, Error, FieldId, FieldKind, FluidBlockSpec, FluidMode, FluidParams, ForceField, Half, Inputs, JointEnd,
    JointId, JointKind, JointSpec, Node, Obstacle, ObstacleId, ObstacleMotion, OrganismId, OrganismSpec, Placement,
    PlateletSpec, Recipe, Region, RigidCellSpec, Side, Sides, Template, World, WorldConfig, YieldingDistance,
};
use std::f32::consts::TAU;

/// Columns and rows of slimes, and of platelets.
const SLIMES: [u8; 2] = [14, 8];
const PLATELETS: [u8; 2] = [30, 2];

impl Commanded {
    /// The scene at its beginning.
    ///
    /// # Errors
    /// When a call is refused.
    pub(crate) fn build() -> Result<Self, Error> {
        let mut world = World::new(WorldConfig {
            size: Vec2::new(240.0, 120.0),
            gravity: Vec2::new(0.0, -10.0),
            max_speed: 60.0,
            sides: Sides { right: Side::Open, ..Sides::default() },
            seed: 24,
            ..WorldConfig::default()
        })?;
        world.set_contact_reporting(Some(ContactReporting { hit_speed: Some(2.0) }))?;
        let [lift, piston, door] = add_obstacles(&mut world)?;
        pour(&mut world)?;
        let slimes = spawn_slimes(&mut world)?;
        grid(PLATELETS, Vec2::new(8.0, 100.0), Vec2::new(7.5, 8.0))
            .try_for_each(|at| world.spawn(&PlateletSpec::default().into(), at).map(drop))?;
        let balls = spawn_balls(&mut world)?;
        let joints = join(&mut world, &balls, &slimes, lift)?;
        let [cell, swimmer] = spawn_cells(&mut world)?;
        let rod = spawn_rod(&mut world)?;
        let (wind, inlet) = blow_and_emit(&mut world)?;
        let inputs = Inputs::new();
        Ok(Self { world, inputs, slimes, balls, joints, cell, swimmer, rod, lift, piston, door, wind, inlet })
    }
}

fn grid([columns, rows]: [u8; 2], corner: Vec2, pitch: Vec2) -> impl Iterator<Item = Placement> {
    let place = move |column: u8, row: u8| corner + pitch * Vec2::new(column.into(), row.into());
    let places = (0..rows).flat_map(move |row| (0..columns).map(move |column| place(column, row)));
    places.map(|at| Placement::at(at.x, at.y))
}

/// A lift, a piston and a door, which are moved; a platform, a zone and a partition, which stay.
fn add_obstacles(world: &mut World) -> Result<[ObstacleId; 3], Error> {
    let bar = |half: [f32; 2], x, y| Obstacle::new(SharedShape::cuboid(half[0], half[1]), Pose::translation(x, y));
    let lift = Obstacle { motion: ObstacleMotion::Push, ..bar([5.0, 1.0], 125.0, 4.0) };
    let piston = Obstacle { motion: ObstacleMotion::Stop, ..bar([2.0, 1.0], 140.0, 4.0) };
    let ids =
        [world.add_obstacle(lift)?, world.add_obstacle(piston)?, world.add_obstacle(bar([1.0, 6.0], 170.0, 8.0))?];
    world.add_obstacle(bar([1.0, 25.0], 70.0, 25.0))?;
    world.add_obstacle(Obstacle { one_way: Some(Vec2::Y), ..bar([6.0, 0.5], 155.0, 12.0) })?;
    world.add_obstacle(Obstacle { is_sensor: true, ..bar([4.0, 4.0], 155.0, 18.0) })?;
    Ok(ids)
}

/// Fluid and grains.
fn pour(world: &mut World) -> Result<(), Error> {
    let water = FluidParams { spacing: 0.8, ..FluidParams::default() };
    let sand = FluidParams { spacing: 1.0, mode: FluidMode::Granular, ..FluidParams::default() };
    for (fluid, size, at) in [(water, [64.0, 44.0], [36.0, 26.0]), (sand, [24.0, 20.0], [84.0, 12.0])] {
        let block = FluidBlockSpec { size: size.into(), fluid };
        world.spawn(&block.into(), Placement::at(at[0], at[1]))?;
    }
    Ok(())
}

/// A ring that keeps its length and area, with a muscle across and a link that flows and tears.
fn slime() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let corner = |k: u8| 3.0 * unit_vector(f32::from(k) * TAU / 16.0);
    let ring: Vec<u32> = (0..16).map(|k| builder.node(Node::disc(corner(k), 0.25, 0.6))).collect();
    builder.ring(&ring, 0.0).outline(&ring);
    builder.constraint(Area { ring, rest_area: 27.0, compliance: 1e-4, is_upper_bound: false });
    let channel = builder.name("slime").channel([1.0, 0.6]);
    builder.muscle(channel, Distance { a: 0, b: 8, rest_length: 6.0, compliance: 1e-4, damping: 0.0 });
    builder.constraint(YieldingDistance {
        yield_strain: 0.02,
        flow_rate: 2.0,
        max_plastic_strain: 0.1,
        breaking_strain: 0.15,
        ..Distance { a: 4, b: 12, rest_length: 6.0, compliance: 1e-3, damping: 0.02 }.into()
    });
    builder.build()
}

fn spawn_slimes(world: &mut World) -> Result<Vec<OrganismId>, Error> {
    let template = world.add_template(slime()?);
    let places = grid(SLIMES, Vec2::new(120.0, 30.0), Vec2::splat(8.0));
    places.map(|at| world.spawn_template(template, at.damped(0.2, 0.1))).collect()
}

/// Eight pairs, one on the lift, one below the platform, one that hangs on a thread, one above the drain.
fn spawn_balls(world: &mut World) -> Result<Vec<OrganismId>, Error> {
    let pairs = (0..8u8).flat_map(|k| [0.0, 3.0].map(|x| Vec2::new(6.0 + 8.0 * f32::from(k) + x, 58.0)));
    let places = pairs.chain([[125.0, 6.1], [155.0, 8.0], [70.0, 70.0], [105.0, 26.5]].map(Vec2::from));
    let ball = OrganismSpec::from(AgarSpec::default());
    places.map(|at| world.spawn(&ball, Placement::at(at.x, at.y))).collect()
}

/// A joint of each kind in a pair, each pair on a rope; one of them breaks.
fn join(
    world: &mut World,
    balls: &[OrganismId],
    slimes: &[OrganismId],
    lift: ObstacleId,
) -> Result<Vec<JointId>, Error> {
    let (length, max_force, frequency, damping_ratio) = (3.5, 200.0, 5.0, 0.2);
    let kinds = [
        JointKind::Distance { length },
        JointKind::Weld,
        JointKind::Rope { max_length: length },
        JointKind::Spring { length, frequency, damping_ratio },
        JointKind::Mouse { frequency, damping_ratio, max_force },
        JointKind::LengthMotor { length: 2.5, max_force },
        JointKind::SpeedMotor { speed: 2.0, max_force },
        JointKind::Pin,
    ];
    world.set_exempt(balls[14], balls[15], true)?;
    let mut specs = Vec::new();
    for (pair, kind) in balls.chunks_exact(2).zip(kinds) {
        let [a, b] = [pair[0], pair[1]].map(JointEnd::Centre);
        let above = world.centroid(pair[0]).unwrap_or_default() + Vec2::new(0.0, 8.0);
        specs.push(JointSpec::new(a, b, kind));
        specs.push(JointSpec::new(JointEnd::Point(above), a, JointKind::Rope { max_length: 8.5 }));
    }
    let load = JointEnd::Obstacle { obstacle: lift, at: Vec2::Y };
    specs.push(JointSpec::new(load, JointEnd::Centre(balls[16]), JointKind::Rope { max_length: 3.0 }));
    let nail = JointEnd::Point(Vec2::new(70.0, 74.0));
    specs
        .push(JointSpec::new(nail, JointEnd::Centre(balls[18]), JointKind::Rope { max_length: 4.2 }).breaking_at(10.0));
    let nodes = [(slimes[0], 0), (slimes[1], 8)].map(|(organism, node)| JointEnd::Node { organism, node });
    specs.push(JointSpec::new(nodes[0], nodes[1], JointKind::Rope { max_length: 2.5 }));
    specs.into_iter().map(|spec| world.add_joint(spec)).collect()
}

/// A cell with a membrane beside a meal, and a rigid one.
fn spawn_cells(world: &mut World) -> Result<[OrganismId; 2], Error> {
    let cell = AmoeboidCellSpec { radii: Vec2::splat(8.0), ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&cell.into(), Placement::at(96.0, 60.0))?;
    world.spawn(&AgarSpec::default().into(), Placement::at(106.5, 60.0))?;
    let swimmer = RigidCellSpec { radii: Vec2::new(6.0, 4.0), ..RigidCellSpec::default() };
    Ok([cell, world.spawn(&swimmer.into(), Placement::at(98.0, 38.0))?])
}

/// A rod that can divide into two of its kind.
fn spawn_rod(world: &mut World) -> Result<OrganismId, Error> {
    let mut builder = Template::builder();
    let node = |k: u8| Node::disc(Vec2::new(1.25 * f32::from(k), 0.0), 0.25, 0.5);
    let discs: Vec<u32> = (0..4).map(|k| builder.node(node(k))).collect();
    for apart in [1, 3] {
        discs.windows(apart + 1).for_each(|part| _ = builder.link(part[0], part[apart], 0.0));
    }
    builder.name("rod").cut([0..2, 2..4].map(|slots| Half::of(slots).scaled(0.5)));
    let rod = world.add_template(builder.build()?);
    world.spawn_template(rod, Placement::at(190.0, 8.0).turned(0.5))
}

/// A field of each kind, an emitter and a drain.
fn blow_and_emit(world: &mut World) -> Result<(FieldId, EmitterId), Error> {
    let circle = |x, y, radius| Region::Circle { centre: Vec2::new(x, y), radius };
    let within = |low: [f32; 2], high: [f32; 2]| Region::Box { low: low.into(), high: high.into() };
    let (low, high) = (Vec2::new(180.0, 80.0), Vec2::new(240.0, 116.0));
    let (sink, eddy) = (Vec2::new(150.0, 60.0), Vec2::new(200.0, 60.0));
    let wind = FieldKind::Uniform { acceleration: Vec2::new(0.0, 25.0) };
    let wind = world.add_field(ForceField { region: within([10.0, 0.0], [30.0, 50.0]), kind: wind })?;
    for (region, kind) in [
        (circle(sink.x, sink.y, 20.0), FieldKind::Radial { centre: sink, acceleration: -8.0 }),
        (circle(eddy.x, eddy.y, 20.0), FieldKind::Vortex { centre: eddy, acceleration: 12.0 }),
        (circle(60.0, 103.0, 30.0), FieldKind::Thermal { mobility: 5.0 }),
        (Region::All, FieldKind::Grid(AccelerationGrid::sampled(low, high, [9, 5], |at| 0.25 * (at - low).perp())?)),
    ] {
        world.add_field(ForceField { region, kind })?;
    }
    let cocci = Recipe::Organism(CoccusSpec::default().into());
    let inlet =
        Emitter { velocity: Vec2::new(0.0, -5.0), ..Emitter::new(within([76.0, 76.0], [112.0, 92.0]), cocci, 40.0) };
    world.add_drain(Drain { region: within([100.0, 0.0], [110.0, 25.0]), kind: None })?;
    Ok((wind, world.add_emitter(inlet)?))
}
