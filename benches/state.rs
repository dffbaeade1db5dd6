//! What is done with a whole world between steps: snapshot, digest, census, quality, queries.

use criterion::{Criterion, criterion_group, criterion_main};
use microsim_benches::{platelets, scene, time_of_saved_steps, time_of_steps};
use microsim_core::{QueryFilter, glam::Vec2};

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

/// A ray, and the nearest point, in a world that is sorted for queries already, and after a change, which sorts it again.
fn queries(criterion: &mut Criterion) {
    for count in [300, 833] {
        let mut world = platelets(count);
        let first = world.organisms().next().expect("there are platelets");
        let (centre, filter) = (world.config().size * 0.5, QueryFilter::default());
        let mut group = criterion.benchmark_group(format!("queries/platelets-{count}"));
        let turned = |k: u32| Vec2::from_angle(k as f32);
        let mut k = 0;
        group.bench_function("ray", |bencher| {
            bencher.iter(|| {
                k += 1;
                world.queries().cast_ray(centre, turned(k), 1e3, &filter)
            });
        });
        group.bench_function("nearest", |bencher| {
            bencher.iter(|| {
                k += 1;
                world.queries().nearest(centre + 5.0 * turned(k), 10.0, &filter)
            });
        });
        group.bench_function("ray after a change", |bencher| {
            bencher.iter(|| {
                k += 1;
                world.push(first, Vec2::ZERO).expect("it lives");
                world.queries().cast_ray(centre, turned(k), 1e3, &filter)
            });
        });
    }
}

criterion_group!(benches, state, rollback, queries);
criterion_main!(benches);
