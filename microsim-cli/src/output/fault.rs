//! Faults of the disk, for tests: the n-th call of a thread that changes a file fails.

use std::cell::{Cell, RefCell};
use std::fs::File;
use std::io::{self, ErrorKind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// How a call fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    /// This call only.
    Once(ErrorKind),
    /// This call and all that follow, so that nothing is cleaned up.
    Crash,
    /// The same, and files lose what no sync has put on the disk.
    PowerCut,
}

/// How many bytes of a file are on the disk.
#[derive(Clone, Debug, Default)]
pub(super) struct Survivor(Arc<AtomicU64>);

impl Survivor {
    pub(super) fn grow(&self, length: u64) {
        self.0.store(length, Ordering::Relaxed);
    }
}

thread_local! {
    static CALLS: Cell<u64> = const { Cell::new(0) };
    static PLANNED: Cell<Option<(u64, Fault)>> = const { Cell::new(None) };
    static OPENED: RefCell<Vec<(File, Survivor)>> = const { RefCell::new(Vec::new()) };
}

/// Does some work while the call of this number, from 0, fails. Returns what it returned, and the number of calls.
pub(crate) fn with<T>(planned: Option<(u64, Fault)>, work: impl FnOnce() -> T) -> (T, u64) {
    CALLS.set(0);
    PLANNED.set(planned);
    OPENED.take();
    let result = work();
    PLANNED.set(None);
    (result, CALLS.get())
}

/// A file that can be written to from now on; what is in it is on the disk.
pub(super) fn opened(file: &File) -> Survivor {
    let length = file.metadata().map_or(0, |data| data.len());
    let survivor = Survivor(Arc::new(AtomicU64::new(length)));
    if let Ok(file) = file.try_clone() {
        OPENED.with_borrow_mut(|opened| opened.push((file, survivor.clone())));
    }
    survivor
}

/// Counts a call, and fails it if that is planned.
pub(super) fn next_call() -> io::Result<()> {
    let number = CALLS.replace(CALLS.get() + 1);
    match PLANNED.get() {
        Some((at, Fault::Once(kind))) if number == at => Err(kind.into()),
        Some((at, Fault::Crash)) if number == at => Err(ErrorKind::Other.into()),
        Some((at, Fault::PowerCut)) if number == at => {
            OPENED.with_borrow(|opened| opened.iter().for_each(|(file, survivor)| cut(file, survivor)));
            Err(ErrorKind::NotConnected.into())
        }
        Some((at, Fault::Crash | Fault::PowerCut)) if number > at => Err(ErrorKind::NotConnected.into()),
        _ => Ok(()),
    }
}

fn cut(file: &File, Survivor(length): &Survivor) {
    let length = length.load(Ordering::Relaxed);
    if file.metadata().is_ok_and(|data| data.len() > length) {
        file.set_len(length).expect("a file of a test can be cut");
    }
}
