//! What queries find in what was sorted for them is what they would find by looking at everything.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;
#[path = "common/crowd.rs"]
mod crowd;

use common::run;
use crowd::{SIZE, all_colliders, crowd, discs, place};
use microsim_core::geometry::polygon::contains_point;
use microsim_core::geometry::segment::nearest_on_segment;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Collider, Inputs, Obstacle, ObstacleMotion, OrganismId, QueryFilter, Rng, Wall, World, WorldConfig,
};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]

    #[test]
    fn organisms_at_places_are_those_of_brute_force(
        seed in 0u64..6, steps in 0u32..12, at in place(), radius in -1.0f32..12.0, extent in place(),
    ) {
        let world = crowd(seed, steps);
        let (low, high) = (at, at + extent * 0.2);
        let reaches = |centre: Vec2, radius: f32, id: OrganismId| {
            let outline: Vec<Vec2> = world.view().organism(id).unwrap().outline().collect();
            let sides = outline.iter().zip(outline.iter().cycle().skip(1));
            let mut gaps = sides.map(|(&a, &b)| (nearest_on_segment(a, b, centre) - centre).length());
            let touches = |disc: &(OrganismId, Vec2, f32)| disc.0 == id && (disc.1 - centre).length() <= disc.2 + radius;
            discs(&world).iter().any(touches) || contains_point(&outline, centre) || gaps.any(|gap| gap <= radius)
        };
        let in_box = |id: OrganismId| {
            let reaches = |at: Vec2, radius: f32| (at - at.clamp(low, high)).length() <= radius;
            discs(&world).iter().any(|disc| disc.0 == id && reaches(disc.1, disc.2))
        };
        let all = |is_met: &dyn Fn(OrganismId) -> bool| world.organisms().filter(|&id| is_met(id)).collect::<Vec<_>>();
        prop_assert_eq!(world.organisms_at(at).collect::<Vec<_>>(), all(&|id| reaches(at, 0.0, id)));
        prop_assert_eq!(world.organisms_in_circle(at, radius).collect::<Vec<_>>(), all(&|id| reaches(at, radius, id)));
        prop_assert_eq!(world.organisms_in_box(low, high).collect::<Vec<_>>(), all(&in_box));
    }

    #[test]
    fn among_many_obstacles_the_first_and_the_nearest_are_those_of_each_alone(seed in 0u64..4, k in 0u32..9) {
        let mut world = crowd(seed, 1);
        let mut rng = Rng::new(seed, u64::from(k));
        let obstacles = scatter(&mut world, &mut rng, 80);
        prop_assert!(obstacles > 40);
        let (queries, all) = (world.queries(), QueryFilter { sensors: true, ..QueryFilter::default() });
        let colliders: Vec<Collider> = all_colliders(&world).into_iter().chain(world.obstacles().map(Collider::Obstacle)).collect();
        for _ in 0..8 {
            let [origin, goal] = [(); 2].map(|()| Vec2::new(rng.range(-9.0, 109.0), rng.range(-9.0, 69.0)));
            let (way, radius) = (goal - origin, rng.range(0.0, 1.0));
            let mut alone = [const { Vec::new() }; 3];
            for &collider in &colliders {
                let only = |other: Collider| other == collider;
                let filter = QueryFilter { predicate: Some(&only), ..all };
                alone[0].extend(queries.cast_ray(origin, way, 200.0, &filter).map(|hit| hit.distance));
                alone[1].extend(queries.cast_disc(origin, way, 200.0, radius, &filter).map(|hit| hit.distance));
                alone[2].extend(queries.nearest(origin, 30.0, &filter).map(|found| found.distance));
            }
            let least = alone.map(|distances| distances.into_iter().reduce(|a: f32, b| if b < a { b } else { a }));
            prop_assert_eq!(queries.cast_ray(origin, way, 200.0, &all).map(|hit| hit.distance), least[0]);
            prop_assert_eq!(queries.cast_disc(origin, way, 200.0, radius, &all).map(|hit| hit.distance), least[1]);
            prop_assert_eq!(queries.nearest(origin, 30.0, &all).map(|found| found.distance), least[2]);
        }
    }
}

/// Adds obstacles of many sizes where no organism is; returns how many.
fn scatter(world: &mut World, rng: &mut Rng, count: u32) -> usize {
    let add = |k: u32| {
        let size = rng.range(0.05, 1.0) * if k.is_multiple_of(20) { 6.0 } else { 1.0 };
        let at = Vec2::new(rng.range(0.0, SIZE.x), rng.range(0.0, SIZE.y));
        let segment = SharedShape::segment(Vec2::ZERO, Vec2::new(4.0 * size, 0.0));
        let shape = [SharedShape::ball(size), SharedShape::cuboid(size, 0.2 * size), segment][k as usize % 3].clone();
        world.add_obstacle(Obstacle::new(shape, Pose::new(at, (k % 4) as f32))).ok()
    };
    (0..count).filter_map(add).count()
}

#[test]
fn obstacles_are_found_where_they_are_now() {
    let mut world = World::new(WorldConfig { size: SIZE, ..WorldConfig::default() }).unwrap();
    let first = |world: &World| {
        let hit = world.queries().cast_ray(Vec2::new(1.0, 30.0), Vec2::X, 1e3, &QueryFilter::default()).unwrap();
        (hit.collider, hit.distance.round())
    };
    let wall = (Collider::Wall(Wall::Right), 99.0);
    assert_eq!(first(&world), wall);
    let ball = Obstacle::new(SharedShape::ball(1.0), Pose::translation(41.0, 30.0));
    let id = world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..ball.clone() }).unwrap();
    let obstacle = Collider::Obstacle(id);
    assert_eq!(first(&world), (obstacle, 39.0));
    let other = world.clone();
    world.set_obstacle_pose(id, Pose::translation(51.0, 30.0)).unwrap();
    assert_eq!((first(&world), first(&other)), ((obstacle, 49.0), (obstacle, 39.0)));
    world.set_obstacle_shape(id, SharedShape::ball(5.0)).unwrap();
    assert_eq!(first(&world), (obstacle, 45.0));
    world.move_obstacle(id, Pose::translation(61.0, 30.0)).unwrap();
    run(&mut world, &Inputs::new(), 60);
    assert_eq!(first(&world), (obstacle, 55.0));
    world.set_obstacle_enabled(id, false).unwrap();
    assert_eq!(first(&world), wall);
    world.set_obstacle_enabled(id, true).unwrap();
    assert_eq!(first(&world), (obstacle, 55.0));
    world.remove_obstacle(id).unwrap();
    assert_eq!(first(&world), wall);
    world.clone_from(&other);
    assert_eq!(first(&world), (obstacle, 39.0));
}
