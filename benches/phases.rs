//! Where the time of a step goes: each phase on its own, in one step of every scene.

use criterion::{Criterion, criterion_group, criterion_main};
use microsim_benches::{platelets, scene, time_of_phase};
use microsim_core::Phase;

fn phases(criterion: &mut Criterion) {
    let scenes =
        [("platelets-200", platelets(200)), ("demo", scene("demo", &[])), ("dam-break", scene("dam-break", &[]))];
    for (name, world) in scenes {
        let mut group = criterion.benchmark_group(format!("phase/{name}"));
        for phase in Phase::ALL {
            group.bench_function(phase.name(), |bencher| {
                bencher.iter_custom(|steps| time_of_phase(&world, steps, phase));
            });
        }
    }
}

criterion_group!(benches, phases);
criterion_main!(benches);
