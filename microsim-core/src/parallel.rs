//! Work that falls into independent parts. With feature `parallel` they run on the threads of rayon's current pool,
//! otherwise one after the other; the parts are the same either way and never depend on the number of threads, so neither
//! do results.

#[cfg(feature = "parallel")]
use crate::float_environment::with_default_float_environment;
#[cfg(feature = "parallel")]
use std::sync::atomic::{AtomicBool, Ordering};

/// Particles that are worked on in one go, a fixed number whatever the number of threads.
pub(crate) const CHUNK: usize = 2048;
/// Particles from which on threads are worth their trouble.
#[cfg(feature = "parallel")]
const LARGE: usize = 8192;

/// Does work with parts. If it is on many particles, it runs as a whole in the pool, unless it is on one of its threads
/// already: entering the pool with each part would cost more than some parts do.
pub(crate) fn in_pool(particles: usize, work: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if particles > LARGE && !is_inside() {
        return rayon::scope(|_| with_default_float_environment(work));
    }
    let _ = particles;
    work();
}

/// Does each part.
pub(crate) fn for_each<T: Send>(parts: Vec<T>, work: impl Fn(T) + Send + Sync) {
    map(parts, work);
}

/// What each part gives, in their order. One at a time may be taken over by another thread: fewer would leave it waiting at
/// the end.
pub(crate) fn map<T: Send, R: Send>(parts: Vec<T>, work: impl Fn(T) -> R + Send + Sync) -> Vec<R> {
    #[cfg(feature = "parallel")]
    if parts.len() > 1 && is_inside() {
        use rayon::prelude::*;
        let work = |part| with_default_float_environment(|| work(part));
        // Around all of it too: a thread that waits may do work of others, and that may leave it in another environment.
        return with_default_float_environment(|| parts.into_par_iter().with_max_len(1).map(work).collect());
    }
    parts.into_iter().map(work).collect()
}

/// Does each part, and then finishes it, in their order, by changing what they share. Alone, a thread finishes a part at once, while
/// all that it needs is in the cache: so what is done with a part must not depend on others that are finished.
pub(crate) fn for_each_then<S: Sync, T: Send>(
    shared: &mut S,
    parts: Vec<T>,
    work: impl Fn(&S, &mut T) + Send + Sync,
    mut finish: impl FnMut(&mut S, T),
) {
    #[cfg(feature = "parallel")]
    if parts.len() > 1 && is_inside() {
        let found = &*shared;
        let work = |mut part| {
            work(found, &mut part);
            part
        };
        return map(parts, work).into_iter().for_each(|part| finish(shared, part));
    }
    for mut part in parts {
        work(shared, &mut part);
        finish(shared, part);
    }
}

/// Does work that has no parts. If it is on many particles, another thread spins meanwhile, because to wake it up takes longer
/// than many parts take. The work must not use the pool.
pub(crate) fn serial(particles: usize, work: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if particles > LARGE && is_inside() {
        let is_done = AtomicBool::new(false);
        let worker = || {
            let _end = SetAtEnd(&is_done);
            with_default_float_environment(work);
        };
        // Nobody waits before the work has begun, and the work waits for nobody: whichever thread waits, it ends.
        let waiter = || {
            while !is_done.load(Ordering::Acquire) {
                std::hint::spin_loop();
            }
        };
        with_default_float_environment(|| rayon::join(worker, waiter));
        return;
    }
    let _ = particles;
    work();
}

/// Sets a flag when it goes, in a panic too.
#[cfg(feature = "parallel")]
struct SetAtEnd<'a>(&'a AtomicBool);

#[cfg(feature = "parallel")]
impl Drop for SetAtEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

/// Whether this is a thread of a pool.
#[cfg(feature = "parallel")]
fn is_inside() -> bool {
    rayon::current_thread_index().is_some()
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn parts_are_finished_in_their_order() {
        let finished = || {
            let mut shared = Vec::new();
            let work = |_: &Vec<usize>, part: &mut usize| *part *= *part;
            for_each_then(&mut shared, (0..100).collect(), work, Vec::push);
            shared
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let expected: Vec<usize> = (0..100).map(|k| k * k).collect();
        assert_eq!((finished(), pool.install(finished)), (expected.clone(), expected));
    }

    #[test]
    fn work_that_panics_keeps_no_thread_waiting() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let panicking = AssertUnwindSafe(|| serial(LARGE + 1, || panic!("on purpose")));
        assert!(pool.install(|| catch_unwind(panicking)).is_err());
    }
}
