//! What is done with a whole world between steps: snapshot, digest, census, quality.

use criterion::{Criterion, criterion_group, criterion_main};
use microsim_benches::{platelets, scene, time_of_saved_steps, time_of_steps};

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

criterion_group!(benches, state, rollback);
criterion_main!(benches);
