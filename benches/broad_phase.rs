//! The search for pairs: a field of platelets of any size, bodies alone; an element is a disc.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use microsim_benches::{platelets, time_of_phase};
use microsim_core::Phase;

fn broad_phase(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("broad_phase");
    for count in [200, 800, 3300] {
        let world = platelets(count);
        group.throughput(Throughput::Elements(world.census().bodies as u64));
        group.bench_function(format!("platelets/{count}"), |bencher| {
            bencher.iter_custom(|steps| time_of_phase(&world, steps, Phase::FindPairs));
        });
    }
}

criterion_group!(benches, broad_phase);
criterion_main!(benches);
