//! Faults of the disk, for tests: the n-th call of a thread that changes a file fails.

use std::cell::Cell;
use std::io::{self, ErrorKind};

/// How a call fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    /// This call only.
    Once(ErrorKind),
    /// This call and all that follow, so that nothing is cleaned up.
    Crash,
}

thread_local! {
    static CALLS: Cell<u64> = const { Cell::new(0) };
    static PLANNED: Cell<Option<(u64, Fault)>> = const { Cell::new(None) };
}

/// Does some work while the call of this number, from 0, fails. Returns what it returned, and the number of calls.
pub(crate) fn with<T>(planned: Option<(u64, Fault)>, work: impl FnOnce() -> T) -> (T, u64) {
    CALLS.set(0);
    PLANNED.set(planned);
    let result = work();
    PLANNED.set(None);
    (result, CALLS.get())
}

/// Counts a call, and fails it if that is planned.
pub(super) fn next_call() -> io::Result<()> {
    let number = CALLS.replace(CALLS.get() + 1);
    match PLANNED.get() {
        Some((at, Fault::Once(kind))) if number == at => Err(kind.into()),
        Some((at, Fault::Crash)) if number == at => Err(ErrorKind::Other.into()),
        Some((at, Fault::Crash)) if number > at => Err(ErrorKind::NotConnected.into()),
        _ => Ok(()),
    }
}
