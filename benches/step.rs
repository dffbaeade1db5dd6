//! Whole steps. The platelet counts up to 200 are those of the thesis, Table 4.1.

use criterion::{Criterion, criterion_group, criterion_main};
use microsim_benches::{platelets, platelets_at_rest, scene, time_of_steps};
use microsim_core::World;

fn measure(criterion: &mut Criterion, name: &str, world: &World) {
    let mut group = criterion.benchmark_group("step");
    group.bench_function(name, |bencher| {
        bencher.iter_custom(|steps| time_of_steps(world, steps));
    });
}

fn step(criterion: &mut Criterion) {
    for count in [90, 120, 150, 200, 800] {
        measure(criterion, &format!("platelets/{count}"), &platelets(count));
    }
    measure(criterion, "platelets/200 at rest", &platelets_at_rest(200));
    measure(criterion, "demo", &scene("demo", &[]));
    measure(criterion, "dam-break", &scene("dam-break", &[]));
}

criterion_group!(benches, step);
criterion_main!(benches);
