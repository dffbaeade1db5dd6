//! A world for queries.

use crate::common::run;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Collider, Inputs, Obstacle, OrganismId, Placement, RigidCellSpec, Rng, Wall, World,
    WorldConfig,
};
use proptest::prelude::*;

pub(crate) const SIZE: Vec2 = Vec2::new(100.0, 60.0);

/// A crowd of discs of many sizes, some cells, and obstacles of several shapes; some of it moved, spawned late and removed.
pub(crate) fn crowd(seed: u64, steps: u32) -> World {
    let mut world = World::new(WorldConfig { size: SIZE, ..WorldConfig::default() }).unwrap();
    let mut rng = Rng::new(seed, 0);
    let shapes = [
        (SharedShape::ball(2.0), Pose::translation(50.0, 50.0)),
        (SharedShape::cuboid(4.0, 1.0), Pose::new(Vec2::new(20.0, 8.0), 0.5)),
        (SharedShape::capsule(Vec2::ZERO, Vec2::new(4.0, 1.0), 0.7), Pose::translation(80.0, 20.0)),
        (
            SharedShape::polyline(vec![Vec2::ZERO, Vec2::new(6.0, 1.0), Vec2::new(9.0, -3.0)], None),
            Pose::new(Vec2::new(40.0, 8.0), 0.2),
        ),
        (
            SharedShape::compound(vec![
                (Pose::translation(-2.0, 0.0), SharedShape::ball(1.5)),
                (Pose::translation(2.0, 0.0), SharedShape::cuboid(1.0, 2.0)),
            ]),
            Pose::new(Vec2::new(86.0, 48.0), 1.0),
        ),
    ];
    for (shape, pose) in shapes {
        world.add_obstacle(Obstacle::new(shape, pose)).unwrap();
    }
    let zone = Obstacle::new(SharedShape::ball(5.0), Pose::translation(70.0, 40.0));
    world.add_obstacle(Obstacle { is_sensor: true, ..zone.clone() }).unwrap();
    world.add_obstacle(Obstacle { is_enabled: false, ..zone }).unwrap();
    let cell = AmoeboidCellSpec { radii: Vec2::splat(7.0), ..AmoeboidCellSpec::default() };
    world.spawn(&cell.into(), Placement::at(30.0, 30.0)).unwrap();
    world
        .spawn(
            &RigidCellSpec { radii: Vec2::new(5.0, 3.0), ..RigidCellSpec::default() }.into(),
            Placement::at(60.0, 20.0),
        )
        .unwrap();
    let mut discs = fill(&mut world, &mut rng, 60);
    for &id in &discs {
        world.push(id, Vec2::new(rng.range(-15.0, 15.0), rng.range(-15.0, 15.0))).unwrap();
    }
    run(&mut world, &Inputs::new(), steps);
    discs.extend(fill(&mut world, &mut rng, 20));
    for id in discs.into_iter().step_by(5) {
        world.remove(id).unwrap();
    }
    world
}

pub(crate) fn fill(world: &mut World, rng: &mut Rng, count: u32) -> Vec<OrganismId> {
    let spawn = |_| {
        let radius = rng.range(0.1, 1.5);
        let at = Placement::at(rng.range(2.0, SIZE.x - 2.0), rng.range(2.0, SIZE.y - 2.0));
        world.spawn(&AgarSpec { radius, ..AgarSpec::default() }.into(), at).ok()
    };
    (0..count).filter_map(spawn).collect()
}

/// All discs that can be touched.
pub(crate) fn discs(world: &World) -> Vec<(OrganismId, Vec2, f32)> {
    let organisms = world.view().organisms();
    organisms.flat_map(|organism| organism.particles().map(move |p| (organism.id(), p.position, p.radius))).collect()
}

pub(crate) fn all_colliders(world: &World) -> Vec<Collider> {
    let solid = world.obstacles().filter(|&id| world.obstacle(id).unwrap().is_solid());
    let organisms = world.organisms().map(Collider::Organism);
    organisms.chain(solid.map(Collider::Obstacle)).chain(Wall::ALL.map(Collider::Wall)).collect()
}

pub(crate) fn place() -> impl Strategy<Value = Vec2> {
    (1.0f32..SIZE.x - 1.0, 1.0f32..SIZE.y - 1.0).prop_map(Vec2::from)
}
