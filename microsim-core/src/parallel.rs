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
const LARGE: usize = 8192;
/// Contacts from which on waking threads for them is.
const MANY: usize = 40_000;

/// Whether a world with so many particles is stepped in parts.
pub(crate) fn is_large(particles: usize) -> bool {
    particles > LARGE
}

/// Whether there are threads, and so many contacts are worth more than waking them.
pub(crate) fn are_many(contacts: usize) -> bool {
    cfg!(feature = "parallel") && contacts > MANY
}

/// Does work with parts. If it is on many particles, it runs as a whole in the pool, unless it is on one of its threads
/// already: entering the pool with each part would cost more than some parts do.
pub(crate) fn in_pool(particles: usize, work: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if is_large(particles) && !is_inside() {
        return rayon::scope(|_| with_default_float_environment(work));
    }
    let _ = particles;
    work();
}

/// Does each part.
pub(crate) fn for_each<T: Send>(parts: Vec<T>, work: impl Fn(T) + Send + Sync) {
    map(parts, work);
}

/// Does each strip of the room, of which each may touch what is in the next one: in a large world every second one at the same time,
/// then those between them. `contacts` is how many all strips have: with few, the order is the same, on one thread.
pub(crate) fn for_each_strip<T: Send>(
    strips: impl Iterator<Item = T>,
    [particles, contacts]: [usize; 2],
    work: impl Fn(T) + Send + Sync,
) {
    if !is_large(particles) {
        return strips.for_each(work);
    }
    let (mut even, mut odd) = (Vec::new(), Vec::new());
    for (k, strip) in strips.enumerate() {
        if k % 2 == 0 { even.push(strip) } else { odd.push(strip) }
    }
    for strips in [even, odd] {
        if are_many(contacts) { for_each(strips, &work) } else { strips.into_iter().for_each(&work) }
    }
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

/// Does two things that share nothing.
pub(crate) fn join(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if is_inside() {
        let one = || with_default_float_environment(one);
        let other = || with_default_float_environment(other);
        with_default_float_environment(|| rayon::join(one, other));
        return;
    }
    one();
    other();
}

/// Does work that has no parts. If it is on many particles, another thread spins meanwhile, because to wake it up takes longer
/// than many parts take. The work must not use the pool.
pub(crate) fn serial(particles: usize, work: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if is_large(particles) && is_inside() {
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
    fn work_that_panics_keeps_no_thread_waiting() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let panicking = AssertUnwindSafe(|| serial(LARGE + 1, || panic!("on purpose")));
        assert!(pool.install(|| catch_unwind(panicking)).is_err());
    }
}
