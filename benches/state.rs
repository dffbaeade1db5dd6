//! What is done with a whole world between steps: snapshot, digest, census, quality.

use criterion::{Criterion, criterion_group, criterion_main};
use microsim_benches::{platelets, scene};

fn state(criterion: &mut Criterion) {
    for (name, world) in [("platelets-800", platelets(800)), ("demo", scene("demo", &[]))] {
        let mut group = criterion.benchmark_group(format!("state/{name}"));
        group.bench_function("snapshot", |bencher| bencher.iter(|| world.clone()));
        group.bench_function("digest", |bencher| bencher.iter(|| world.digest()));
        group.bench_function("census", |bencher| bencher.iter(|| world.census()));
        group.bench_function("quality", |bencher| bencher.iter(|| world.quality()));
    }
}

criterion_group!(benches, state);
criterion_main!(benches);
