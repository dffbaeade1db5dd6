//! Force fields over a grid: motion against exact solutions, and what a field over a grid shares with the others.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

use microsim_core::glam::Vec2;
use microsim_core::{
    AccelerationGrid, AgarSpec, AmoeboidCellSpec, FieldKind, FluidBlockSpec, ForceField, Inputs, OrganismId, Placement,
    PlateletSpec, Region, World, WorldConfig,
};

const CENTRE: Vec2 = Vec2::splat(100.0);

/// A room without drag.
fn room() -> World {
    let size = 2.0 * CENTRE;
    World::new(WorldConfig { size, damping: 0.0, max_speed: 100.0, ..WorldConfig::default() }).unwrap()
}

/// A field over the whole room, with nodes where it says.
fn field(size: [u32; 2], at: impl FnMut(Vec2) -> Vec2) -> ForceField {
    let grid = AccelerationGrid::sampled(Vec2::ZERO, 2.0 * CENTRE, size, at).unwrap();
    ForceField { region: Region::All, kind: FieldKind::Grid(grid) }
}

fn ball(world: &mut World, at: Vec2) -> OrganismId {
    world.spawn(&AgarSpec { radius: 0.5, ..AgarSpec::default() }.into(), Placement::at(at.x, at.y)).unwrap()
}

/// Where a ball is relative to the centre after some seconds in a field.
fn moved(field: ForceField, from: Vec2, seconds: u32) -> Vec2 {
    let mut world = room();
    let ball = ball(&mut world, CENTRE + from);
    world.add_field(field).unwrap();
    (0..60 * seconds).for_each(|_| world.step(&Inputs::new()));
    world.centroid(ball).unwrap() - CENTRE
}

#[test]
fn a_ball_in_a_saddle_follows_its_exact_solution() {
    // x'' = x and y'' = -y, from rest: x cosh t and y cos t.
    let saddle = |at: Vec2| (at - CENTRE) * Vec2::new(1.0, -1.0);
    let (from, time) = (Vec2::new(2.0, 3.0), 2.0_f32);
    let exact = from * Vec2::new(time.cosh(), time.cos());
    for size in [[2, 2], [31, 17]] {
        let found = moved(field(size, saddle), from, 2);
        assert!((found - exact).length() < 0.02, "{found} instead of {exact} on {size:?} nodes");
    }
}

#[test]
fn a_ball_in_a_shear_field_follows_its_exact_solution() {
    let shear = |at: Vec2| Vec2::new(0.5 * (at.y - CENTRE.y), 0.0);
    for y in [-20.0, 0.0, 8.0] {
        let found = moved(field([2, 3], shear), Vec2::new(0.0, y), 2);
        let exact = Vec2::new(0.5 * (0.5 * y) * 4.0, y);
        assert!((found - exact).length() <= 0.005 * exact.length(), "{found} instead of {exact}");
    }
}

/// A room with bodies, a cell and fluid in it.
fn crowd() -> World {
    let mut world = room();
    let fluid = FluidBlockSpec { size: Vec2::splat(8.0), ..FluidBlockSpec::default() };
    world.spawn(&fluid.into(), Placement::at(60.0, 60.0)).unwrap();
    world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(100.0, 60.0)).unwrap();
    for k in 0..6u8 {
        let at = Placement::at(40.0 + 12.0 * f32::from(k), 120.0);
        world.spawn(&PlateletSpec::default().into(), at).unwrap();
    }
    world
}

#[test]
fn equal_nodes_are_a_uniform_field_to_the_bit() {
    let acceleration = Vec2::new(3.3, -7.7);
    let fields = [
        ForceField { region: Region::All, kind: FieldKind::Uniform { acceleration } },
        field([5, 7], |_| acceleration),
    ];
    let digests = fields.map(|field| {
        let mut world = crowd();
        let id = world.add_field(field).unwrap();
        (0..60).for_each(|_| world.step(&Inputs::new()));
        world.remove_field(id).unwrap();
        world.digest()
    });
    assert_eq!(digests[0], digests[1]);
}

#[test]
fn a_grid_acts_within_its_rectangle_and_the_region_only() {
    let mut world = room();
    let places = [CENTRE, CENTRE + Vec2::new(30.0, 0.0), CENTRE - Vec2::new(30.0, 0.0)];
    let balls = places.map(|at| ball(&mut world, at));
    let (low, high) = (CENTRE - Vec2::splat(40.0), CENTRE + Vec2::splat(20.0));
    let grid = AccelerationGrid::sampled(low, high, [4, 4], |_| Vec2::Y).unwrap();
    let region = Region::Circle { centre: CENTRE, radius: 25.0 };
    world.add_field(ForceField { region, kind: FieldKind::Grid(grid) }).unwrap();
    (0..120).for_each(|_| world.step(&Inputs::new()));
    let [inside, beyond, outside] = balls.map(|ball| world.view().organism(ball).unwrap().velocity());
    assert!((inside - Vec2::new(0.0, 2.0)).length() < 0.01, "{inside}");
    assert_eq!([beyond, outside], [Vec2::ZERO; 2], "beyond the grid, and outside of the region");
}

#[test]
fn clones_of_a_world_share_the_nodes() {
    let mut world = room();
    world.add_field(field([64, 64], |at| 0.01 * at)).unwrap();
    let nodes = |world: &World| match &world.fields().next().unwrap().1.kind {
        FieldKind::Grid(grid) => grid.nodes().as_ptr(),
        other => panic!("{other:?}"),
    };
    let mut other = room();
    other.clone_from(&world);
    assert!(nodes(&world) == nodes(&world.clone()) && nodes(&world) == nodes(&other));
}

#[test]
fn every_node_is_part_of_the_digest() {
    let digest = |odd: usize| {
        let nodes = (0..12).map(|k| if k == odd { Vec2::X } else { Vec2::Y }).collect();
        let grid = AccelerationGrid::new(Vec2::ZERO, CENTRE, [4, 3], nodes).unwrap();
        let mut world = room();
        world.add_field(ForceField { region: Region::All, kind: FieldKind::Grid(grid) }).unwrap();
        world.digest()
    };
    let digests: std::collections::BTreeSet<u64> = (0..=12).map(digest).collect();
    assert_eq!(digests.len(), 13);
}

#[cfg(feature = "snapshot")]
#[test]
fn a_world_with_a_grid_is_written_and_read() {
    let mut world = crowd();
    world.add_field(field([9, 9], |at| 0.2 * (CENTRE - at).perp())).unwrap();
    (0..10).for_each(|_| world.step(&Inputs::new()));
    let mut read = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
    assert!(read.digest() == world.digest() && read.fields().eq(world.fields()));
    [&mut read, &mut world].into_iter().for_each(|world| (0..30).for_each(|_| world.step(&Inputs::new())));
    assert_eq!(read.digest(), world.digest());
}
