//! Queries against marching along rays and brute force: before the first step, after spawning, motion and removal.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;
#[path = "common/crowd.rs"]
mod crowd;

use crowd::{SIZE, all_colliders, crowd, discs, place};
use microsim_core::geometry::polygon::contains_point;
use microsim_core::geometry::segment::nearest_on_segment;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AgarSpec, Collider, CollisionGroups, Kind, Obstacle, Placement, Queries, QueryFilter, RigidCellSpec, Wall, World,
    WorldConfig,
};
use proptest::prelude::*;

/// Distance from the surface of an obstacle or wall, 0 inside.
fn distance_to(world: &World, collider: Collider, at: Vec2) -> f32 {
    match collider {
        Collider::Wall(Wall::Bottom) => at.y.max(0.0),
        Collider::Wall(Wall::Top) => (SIZE.y - at.y).max(0.0),
        Collider::Wall(Wall::Left) => at.x.max(0.0),
        Collider::Wall(Wall::Right) => (SIZE.x - at.x).max(0.0),
        Collider::Obstacle(id) => {
            let obstacle = world.obstacle(id).unwrap();
            obstacle.shape.distance_to_point(&obstacle.pose, at, true)
        }
        Collider::Organism(id) => {
            let own = discs(world).into_iter().filter(|disc| disc.0 == id);
            own.map(|(_, centre, radius)| ((centre - at).length() - radius).max(0.0)).fold(f32::MAX, f32::min)
        }
    }
}

/// Where a disc first touches something, by small steps; the distance to each thing bounds the steps.
fn march(
    world: &World,
    colliders: &[Collider],
    origin: Vec2,
    direction: Vec2,
    length: f32,
    radius: f32,
) -> Option<(Collider, f32)> {
    let first = |&collider: &Collider| {
        let mut at = 0.0;
        while at <= length {
            let gap = distance_to(world, collider, origin + direction * at) - radius;
            if gap < 1e-3 {
                return Some((collider, at));
            }
            at += gap.max(5e-4);
        }
        None
    };
    colliders.iter().filter_map(first).reduce(|a, b| if b.1 < a.1 { b } else { a })
}

fn check_casts(world: &World, origin: Vec2, direction: Vec2, length: f32, radius: f32) -> Result<(), TestCaseError> {
    let (queries, filter) = (world.queries(), QueryFilter::default());
    let found = queries.cast_disc(origin, direction, length, radius, &filter);
    let marched = march(world, &all_colliders(world), origin, direction, length, radius);
    // A graze may be decided either way.
    let is_graze = |at: Vec2| all_colliders(world).iter().any(|&c| (distance_to(world, c, at) - radius).abs() < 5e-3);
    match (found, marched) {
        (Some(found), Some((_, at))) => {
            let centre = origin + direction * found.distance;
            prop_assert!(found.distance - at < 0.02 || is_graze(origin + direction * at), "{found:?} {at}");
            prop_assert!(distance_to(world, found.collider, centre) <= radius + 5e-3, "{found:?}");
            if found.distance > 0.0 {
                prop_assert!(
                    (found.normal.length() - 1.0).abs() < 1e-4 && found.normal.dot(direction) < 0.01,
                    "{found:?}"
                );
                prop_assert!(((found.point - centre).length() - radius).abs() < 0.02, "{found:?}");
            }
        }
        (None, Some((_, at))) => {
            prop_assert!(length - at < 0.02 || is_graze(origin + direction * at), "missed at {at}");
        }
        (Some(found), None) => prop_assert!(is_graze(origin + direction * found.distance), "{found:?}"),
        (None, None) => {}
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(60) })]

    #[test]
    fn rays_and_discs_meet_what_marching_along_them_meets(
        seed in 0u64..6, steps in 0u32..12, origin in place(), angle in 0.0f32..6.2, length in 0.0f32..150.0, radius in 0.0f32..2.0,
    ) {
        let world = crowd(seed, steps);
        let direction = Vec2::new(angle.cos(), angle.sin());
        check_casts(&world, origin, direction, length, 0.0)?;
        check_casts(&world, origin, direction, length, radius)?;
    }

    #[test]
    fn all_hits_are_the_first_hits_of_each_alone(seed in 0u64..6, steps in 0u32..12, origin in place(), goal in place()) {
        let world = crowd(seed, steps);
        let queries = world.queries();
        let all = queries.cast_ray_all(origin, goal - origin, 90.0, &QueryFilter::default());
        let mut alone = Vec::new();
        for collider in all_colliders(&world) {
            let only = |other: Collider| other == collider;
            let filter = QueryFilter { predicate: Some(&only), ..QueryFilter::default() };
            alone.extend(queries.cast_ray(origin, goal - origin, 90.0, &filter));
        }
        alone.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        prop_assert_eq!(all.len(), alone.len());
        for (a, b) in all.iter().zip(&alone) {
            prop_assert_eq!(a.distance, b.distance);
        }
    }

    #[test]
    fn the_nearest_point_is_the_nearest(seed in 0u64..6, steps in 0u32..12, at in place(), within in 0.0f32..9.0) {
        let world = crowd(seed, steps);
        let found = world.queries().nearest(at, within, &QueryFilter::default());
        let distances = all_colliders(&world).into_iter().map(|collider| distance_to(&world, collider, at));
        let least = distances.fold(f32::MAX, f32::min);
        match found {
            Some(found) => {
                prop_assert!((found.distance - least).abs() < 1e-3 && found.distance <= within, "{found:?} {least}");
                prop_assert!(((found.point - at).length() - found.distance).abs() < 1e-3);
                prop_assert!(distance_to(&world, found.collider, found.point) < 1e-3, "{found:?}");
            }
            None => prop_assert!(least > within - 1e-3, "{least} within {within}"),
        }
    }

    #[test]
    fn overlaps_are_those_of_brute_force(
        seed in 0u64..6, steps in 0u32..12, at in place(), radius in 0.0f32..6.0, extent in place(),
    ) {
        let world = crowd(seed, steps);
        let (queries, filter) = (world.queries(), QueryFilter::default());
        let round = queries.overlap_disc(at, radius, &filter);
        let high = at + extent * 0.1;
        let boxed = queries.overlap_box(at, high, &filter);
        let corners = [at, Vec2::new(high.x, at.y), high, Vec2::new(at.x, high.y)];
        prop_assert_eq!(&boxed, &queries.overlap_polygon(&corners, &filter));
        for collider in all_colliders(&world) {
            let outline: Vec<Vec2> = collider.organism().map_or(Vec::new(), |id| world.view().organism(id).unwrap().outline().collect());
            let surrounds = |point: Vec2| outline.len() > 2 && contains_point(&outline, point);
            let gap = if surrounds(at) { 0.0 } else { distance_to(&world, collider, at) };
            prop_assert!((gap - radius).abs() < 1e-3 || round.contains(&collider) == (gap < radius), "{collider:?}: {gap} {radius}");
            let gap = box_gap(&world, collider, &corners).min(if surrounds(at) { 0.0 } else { f32::MAX });
            if gap > 0.02 {
                prop_assert!(!boxed.contains(&collider), "{collider:?} is {gap} away");
            } else if gap == 0.0 {
                prop_assert!(boxed.contains(&collider), "{collider:?}");
            }
        }
    }
}

/// Distance from a box to something: exact for discs, by points of a grid for obstacles.
fn box_gap(world: &World, collider: Collider, corners: &[Vec2; 4]) -> f32 {
    if let Collider::Organism(id) = collider {
        let edge = |at: Vec2| {
            (0..4).map(move |k: usize| (nearest_on_segment(corners[k], corners[(k + 1) % 4], at) - at).length())
        };
        let gap = |at: Vec2| if contains_point(corners, at) { 0.0 } else { edge(at).fold(f32::MAX, f32::min) };
        let own = discs(world).into_iter().filter(|disc| disc.0 == id);
        let nearest = own.map(|(_, at, radius)| (gap(at) - radius).max(0.0)).fold(f32::MAX, f32::min);
        return nearest;
    }
    let (low, high) = (corners[0], corners[2]);
    let share = |k: u32| Vec2::new((k % 41) as f32, (k / 41) as f32) / 40.0;
    let points = (0..41 * 41).map(|k| low + (high - low) * share(k));
    let least = points.map(|at| distance_to(world, collider, at)).fold(f32::MAX, f32::min);
    // Half the diagonal of a cell of the grid.
    if least == 0.0 { 0.0 } else { (least - 0.5 * (high - low).length() / 40.0).max(1e-6) }
}

fn hit(queries: &Queries<'_>, filter: &QueryFilter<'_>) -> Option<Collider> {
    queries.cast_ray(Vec2::new(5.0, 30.0), Vec2::X, 1e4, filter).map(|hit| hit.collider)
}

#[test]
fn filters_let_through_what_they_say() {
    let mut world = World::new(WorldConfig { size: SIZE, ..WorldConfig::default() }).unwrap();
    let [a, b] = [20.0, 40.0].map(|x| world.spawn(&AgarSpec::default().into(), Placement::at(x, 30.0)).unwrap());
    let cell = world.spawn(&RigidCellSpec::default().into(), Placement::at(60.0, 30.0)).unwrap();
    let groups = CollisionGroups { memberships: 4, filter: 4 };
    let ball = |x| Obstacle::new(SharedShape::ball(1.0), Pose::translation(x, 30.0));
    let zone = world.add_obstacle(Obstacle { is_sensor: true, ..ball(12.0) }).unwrap();
    let grouped = world.add_obstacle(Obstacle { groups, ..ball(80.0) }).unwrap();
    let queries = world.queries();
    let all = QueryFilter::default();
    let organism = |id| Some(Collider::Organism(id));
    assert_eq!(hit(&queries, &all), organism(a));
    assert_eq!(hit(&queries, &QueryFilter { sensors: true, ..all }), Some(Collider::Obstacle(zone)));
    assert_eq!(hit(&queries, &QueryFilter { excluded: Some(a), ..all }), organism(b));
    assert_eq!(hit(&queries, &QueryFilter { kind: Some(Kind::RigidCell), ..all }), organism(cell));
    let not_agar = |collider: Collider| collider.organism().is_none_or(|id| id == cell);
    assert_eq!(hit(&queries, &QueryFilter { predicate: Some(&not_agar), ..all }), organism(cell));
    assert_eq!(hit(&queries, &QueryFilter::surfaces()), Some(Collider::Obstacle(grouped)));
    let others = CollisionGroups { memberships: 2, filter: u32::MAX };
    assert_eq!(
        hit(&queries, &QueryFilter { groups: others, ..QueryFilter::surfaces() }),
        Some(Collider::Wall(Wall::Right))
    );
    let none = QueryFilter { walls: false, obstacles: false, organisms: false, ..all };
    assert_eq!(hit(&queries, &none), None);
    assert_eq!(hit(&queries, &QueryFilter { kind: Some(Kind::Platelet), ..QueryFilter::organisms() }), None);
}

#[test]
fn what_lies_wholly_inside_a_cell_overlaps_it() {
    let world = crowd(0, 0);
    let cell = Collider::Organism(world.organisms().next().unwrap());
    let (queries, filter) =
        (world.queries(), QueryFilter { kind: Some(Kind::AmoeboidCell), ..QueryFilter::organisms() });
    let at = Vec2::new(30.0, 30.0);
    assert_eq!(queries.overlap_disc(at, 0.01, &filter), [cell]);
    assert_eq!(queries.overlap_box(at, at + 0.01, &filter), [cell]);
    assert_eq!(queries.overlap_polygon(&[at, at + Vec2::X * 0.01, at + Vec2::Y * 0.01], &filter), [cell]);
}

#[test]
fn numbers_that_make_no_sense_find_nothing() {
    let world = crowd(1, 3);
    let (queries, filter) = (world.queries(), QueryFilter { sensors: true, ..QueryFilter::default() });
    let (at, nan, far) = (Vec2::new(30.0, 30.0), Vec2::NAN, Vec2::splat(f32::INFINITY));
    for (origin, direction, length, radius) in [
        (nan, Vec2::X, 9.0, 0.0),
        (far, Vec2::X, 9.0, 0.0),
        (at, nan, 9.0, 0.0),
        (at, Vec2::ZERO, 9.0, 0.0),
        (at, Vec2::X, -1.0, 0.0),
        (at, Vec2::X, f32::NAN, 0.0),
        (at, Vec2::X, 9.0, -1.0),
        (at, Vec2::X, 9.0, f32::NAN),
        (at, Vec2::X, 9.0, f32::INFINITY),
    ] {
        assert_eq!(queries.cast_disc(origin, direction, length, radius, &filter), None);
        assert!(radius != 0.0 || queries.cast_ray_all(origin, direction, length, &filter).is_empty());
    }
    // So far away that distances overflow.
    for huge in [Vec2::new(-3e38, 30.0), Vec2::splat(3e38), Vec2::splat(-3e38), Vec2::new(1e20, -1e20)] {
        for hit in queries.cast_ray_all(huge, at - huge, f32::INFINITY, &filter) {
            assert!(hit.point.is_finite() && !hit.distance.is_nan(), "{hit:?}");
        }
        let found = queries.nearest(huge, f32::INFINITY, &filter);
        assert!(found.is_none_or(|found| found.point.is_finite() && found.distance.is_finite()), "{found:?}");
    }
    assert!(queries.cast_ray(at, Vec2::X, f32::INFINITY, &filter).is_some());
    assert!(queries.nearest(nan, 9.0, &filter).is_none() && queries.nearest(at, f32::NAN, &filter).is_none());
    assert!(queries.nearest(at, f32::INFINITY, &filter).is_some());
    assert!(
        queries.overlap_disc(nan, 1.0, &filter).is_empty() && queries.overlap_disc(at, f32::NAN, &filter).is_empty()
    );
    assert!(queries.overlap_box(at, far, &filter).is_empty() && queries.overlap_polygon(&[at, at], &filter).is_empty());
    assert!(World::new(WorldConfig::default()).unwrap().queries().nearest(at, 1.0, &filter).is_none());
    assert_eq!(world.organisms_in_circle(nan, 1.0).chain(world.organisms_in_circle(at, f32::NAN)).count(), 0);
    assert_eq!(world.organisms_in_box(nan, far).count(), 0);
    assert!(world.organisms_in_circle(at, f32::INFINITY).eq(world.organisms()));
    assert!(world.organisms_in_box(-far, far).eq(world.organisms()));
}

#[test]
fn the_normal_of_a_wall_is_its_own_however_the_ray_comes() {
    let world = World::new(WorldConfig { size: Vec2::new(50.0, 30.0), ..WorldConfig::default() }).unwrap();
    let queries = world.queries();
    for (from, to) in
        [([40.85083, 22.617188], [13.143311, 28.59375]), ([3.0, 4.0], [31.0, 29.0]), ([9.1, 2.3], [9.2, 8.0])]
    {
        let (from, to) = (Vec2::from(from), Vec2::from(to));
        let hit = queries.cast_ray(from, to - from, 200.0, &QueryFilter::default()).unwrap();
        assert_eq!(hit.collider, Collider::Wall(Wall::Top));
        assert!((hit.normal + Vec2::Y).length() < 1e-5, "{hit:?}");
    }
}

#[test]
fn a_ray_from_the_centre_of_a_ball_meets_it_at_once() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let ball = Obstacle::new(SharedShape::ball(2.0), Pose::translation(30.0, 30.0));
    world.add_obstacle(ball).unwrap();
    let (at, filter) = (Vec2::splat(30.0), QueryFilter::surfaces());
    let ray = world.queries().cast_ray(at, Vec2::X, 5.0, &filter).expect("it begins inside");
    assert_eq!((ray.distance, ray.point, ray.normal), (0.0, at, Vec2::ZERO));
    assert!(world.queries().cast_disc(at, Vec2::X, 5.0, 0.5, &filter).is_some());
}
