//! What is done with a whole world between steps: snapshot, digest, census, quality, queries.

use criterion::{Criterion, criterion_group, criterion_main};
use microsim_benches::{platelets, scene, time_of_saved_steps, time_of_steps};
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{Obstacle, QueryFilter, Rng, World};

fn state(criterion: &mut Criterion) {
    for (name, world) in [("platelets-800", platelets(800)), ("demo", scene("demo", &[]))] {
        let mut group = criterion.benchmark_group(format!("state/{name}"));
        group.bench_function("snapshot", |bencher| bencher.iter(|| world.clone()));
        group.bench_function("digest", |bencher| bencher.iter(|| world.digest()));
        group.bench_function("census", |bencher| bencher.iter(|| world.census()));
        group.bench_function("quality", |bencher| bencher.iter(|| world.quality()));
    }
}

/// Saving and going back, beside the step, with 10,000 bodies. `cargo run --release -p microsim-core --features scenario
/// --example rollback_cost` has them take turns, and counts bytes.
fn rollback(criterion: &mut Criterion) {
    let world = platelets(333);
    let mut group = criterion.benchmark_group("rollback/platelets-333");
    group.bench_function("clone", |bencher| bencher.iter(|| world.clone()));
    let mut other = world.clone();
    group.bench_function("clone_from", |bencher| bencher.iter(|| other.clone_from(&world)));
    group.bench_function("step", |bencher| bencher.iter_custom(|steps| time_of_steps(&world, steps)));
    group.bench_function("save and step", |bencher| bencher.iter_custom(|steps| time_of_saved_steps(&world, steps)));
}

/// Queries in a world that is sorted for them already, and after a change, which sorts it again. With platelets only, and among
/// 1000 obstacles.
fn queries(criterion: &mut Criterion) {
    for (count, obstacles) in [(300, 0), (833, 0), (300, 1000), (833, 1000)] {
        let mut world = platelets(count);
        scatter_obstacles(&mut world, obstacles);
        let mut group = criterion.benchmark_group(format!("queries/platelets-{count} obstacles-{obstacles}"));
        let (first, size) = (world.organisms().next().expect("there are platelets"), world.config().size);
        let (filter, surfaces) = (QueryFilter::default(), QueryFilter::surfaces());
        let turned = |k: u32| Vec2::from_angle(k as f32);
        let place = |k: u32| size * (0.5 + 0.4 * turned(k));
        let mut query = |name: &str, ask: &dyn Fn(&World, u32) -> bool| {
            let mut k = 0;
            group.bench_function(name, |bencher| {
                bencher.iter(|| {
                    k += 1;
                    ask(&world, k)
                });
            });
        };
        query("ray", &|world, k| world.queries().cast_ray(place(k), turned(k), 1e3, &filter).is_some());
        query("ray, surfaces", &|world, k| world.queries().cast_ray(place(k), turned(k), 1e3, &surfaces).is_some());
        query("all along a ray", &|world, k| {
            world.queries().cast_ray_all(place(k), turned(k), 1e3, &filter).is_empty()
        });
        query("nearest", &|world, k| world.queries().nearest(place(k), 10.0, &filter).is_some());
        query("nearest surface", &|world, k| world.queries().nearest(place(k), 1e3, &surfaces).is_some());
        query("overlap", &|world, k| world.queries().overlap_disc(place(k), 2.0, &filter).is_empty());
        query("organisms_at", &|world, k| world.organisms_at(place(k)).next().is_some());
        query("organisms_in_circle", &|world, k| world.organisms_in_circle(place(k), 2.0).next().is_some());
        query("organisms_in_box", &|world, k| world.organisms_in_box(place(k), place(k) + 4.0).next().is_some());
        let mut after_change = |name: &str, ask: &dyn Fn(&World, u32) -> bool| {
            let mut k = 0;
            group.bench_function(format!("{name} after a change"), |bencher| {
                bencher.iter(|| {
                    k += 1;
                    world.push(first, Vec2::ZERO).expect("it lives");
                    ask(&world, k)
                });
            });
        };
        after_change("ray", &|world, k| world.queries().cast_ray(place(k), turned(k), 1e3, &filter).is_some());
        after_change("organisms_at", &|world, k| world.organisms_at(place(k)).next().is_some());
    }
}

/// Adds small obstacles of three shapes in places that are free.
fn scatter_obstacles(world: &mut World, count: u32) {
    let mut rng = Rng::new(1, 1);
    let size = world.config().size;
    let shapes = [
        SharedShape::ball(0.2),
        SharedShape::cuboid(0.4, 0.1),
        SharedShape::capsule(Vec2::new(-0.3, 0.0), Vec2::new(0.3, 0.1), 0.1),
    ];
    let mut added = 0;
    while added < count {
        let at = Vec2::new(rng.range(0.0, size.x), rng.range(0.0, size.y));
        let obstacle = Obstacle::new(shapes[added as usize % 3].clone(), Pose::new(at, added as f32));
        added += u32::from(world.add_obstacle(obstacle).is_ok());
    }
}

criterion_group!(benches, state, rollback, queries);
criterion_main!(benches);
