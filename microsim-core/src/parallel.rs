//! Work that falls into independent parts. With feature `parallel` they run on the threads of rayon's current pool,
//! otherwise one after the other; the parts are the same either way and never depend on the number of threads, so neither
//! do results.

/// Does work with parts. If there is `much` of it, it goes to the pool as a whole, unless it is on one of its threads
/// already: going there and back with each part would cost more than some parts do.
pub(crate) fn enter(much: bool, work: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    if much && !is_inside() {
        return rayon::scope(|_| work());
    }
    let _ = much;
    work();
}

/// Does each part.
pub(crate) fn for_each<T: Send>(parts: Vec<T>, work: impl Fn(T) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if parts.len() > 1 && is_inside() {
        use rayon::prelude::*;
        return parts.into_par_iter().for_each(work);
    }
    parts.into_iter().for_each(work);
}

/// What each part gives, in their order.
pub(crate) fn map<T: Send, R: Send>(parts: Vec<T>, work: impl Fn(T) -> R + Send + Sync) -> Vec<R> {
    #[cfg(feature = "parallel")]
    if parts.len() > 1 && is_inside() {
        use rayon::prelude::*;
        return parts.into_par_iter().map(work).collect();
    }
    parts.into_iter().map(work).collect()
}

/// Whether this is a thread of a pool.
#[cfg(feature = "parallel")]
fn is_inside() -> bool {
    rayon::current_thread_index().is_some()
}
