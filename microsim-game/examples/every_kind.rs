//! Shows one of every kind of thing that can be drawn, in a world built in code:
//! `cargo run -p microsim-game --example every_kind [FILE.png]`.

use microsim_core::glam::Vec2;
use microsim_core::parry2d::math::Pose;
use microsim_core::parry2d::shape::SharedShape;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Error, FluidBlockSpec, Node, Obstacle, OrganismSpec, Placement, PlateletSpec,
    ProbeSpec, RigidCellSpec, Template, World, WorldConfig,
};
use microsim_game::app::RunOptions;
use microsim_game::stage::Stage;

fn main() -> Result<(), String> {
    let world = world().map_err(|error| error.to_string())?;
    let options = RunOptions {
        screenshot: std::env::args().nth(1).map(Into::into),
        frames: std::env::args().nth(1).map(|_| 30),
        size: (1280, 720),
        ..RunOptions::default()
    };
    microsim_game::show(Stage::new("every kind".to_owned(), world, None), options)
}

fn world() -> Result<World, Error> {
    let size = Vec2::new(110.0, 60.0);
    let mut world = World::new(WorldConfig { size, ..WorldConfig::default() })?;
    let specs: [(OrganismSpec, f32, f32); 7] = [
        (AmoeboidCellSpec::default().into(), 50.0, 32.0),
        (RigidCellSpec::default().into(), 72.0, 46.0),
        (PlateletSpec::default().into(), 32.0, 46.0),
        (AgarSpec::default().into(), 66.0, 36.0),
        (ProbeSpec::default().into(), 30.0, 36.0),
        (FluidBlockSpec::default().into(), 90.0, 40.0),
        (PlateletSpec::default().into(), 37.5, 46.0),
    ];
    for (spec, x, y) in specs {
        world.spawn(&spec, Placement::at(x, y))?;
    }
    let rod = world.add_template(rod()?);
    world.spawn_template(rod, Placement::at(24.0, 52.0).turned(0.4))?;
    for (shape, x) in shapes() {
        world.add_obstacle(Obstacle::new(shape, Pose::translation(x, 10.0)))?;
    }
    Ok(world)
}

/// A body that the library does not know.
fn rod() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let nodes: Vec<u32> = (0..6).map(|k| builder.node(Node::disc(Vec2::new(k as f32 * 1.8, 0.0), 1.0, 1.2))).collect();
    for pair in nodes.windows(2) {
        builder.link(pair[0], pair[1], 0.0);
    }
    builder.build()
}

/// Obstacles, with their places.
fn shapes() -> Vec<(SharedShape, f32)> {
    let at = Vec2::new;
    let cross = vec![(Pose::IDENTITY, SharedShape::cuboid(5.0, 1.5)), (Pose::IDENTITY, SharedShape::cuboid(1.5, 5.0))];
    let hull = SharedShape::convex_hull(&[at(-4.0, -4.0), at(4.0, -3.0), at(5.0, 2.0), at(0.0, 5.0), at(-4.0, 2.0)]);
    let zigzag = (0..7).map(|k| at(k as f32 * 2.5 - 7.5, if k % 2 == 0 { -3.0 } else { 3.0 }));
    let mut shapes = vec![
        (SharedShape::ball(4.0), 10.0),
        (SharedShape::cuboid(4.0, 3.0), 24.0),
        (SharedShape::capsule(at(-3.0, -2.0), at(3.0, 2.0), 2.0), 38.0),
        (SharedShape::compound(cross), 68.0),
        (SharedShape::polyline(zigzag.collect(), None), 90.0),
    ];
    shapes.extend(hull.map(|hull| (hull, 53.0)));
    shapes
}
