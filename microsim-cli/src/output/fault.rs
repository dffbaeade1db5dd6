//! Faults of the disk, for tests: the n-th call of a thread that changes a file fails.

use std::cell::{Cell, RefCell};
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// How a call fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    /// This call only.
    Once(ErrorKind),
    /// This call and all that follow, so that nothing is cleaned up.
    Crash,
    /// The same, and files lose what no sync has put on the disk; what was removed or renamed is there again.
    PowerCut,
    /// The same, and so do folders: every change of a name since the last sync of its folder is taken back.
    LostNames,
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
    /// What had the names whose changes are not on the disk, the oldest change first.
    static RENAMED: RefCell<Vec<(PathBuf, Option<Vec<u8>>)>> = const { RefCell::new(Vec::new()) };
}

/// Does some work while the call of this number, from 0, fails. Returns what it returned, and the number of calls.
pub(crate) fn with<T>(planned: Option<(u64, Fault)>, work: impl FnOnce() -> T) -> (T, u64) {
    CALLS.set(0);
    PLANNED.set(planned);
    OPENED.take();
    RENAMED.take();
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
        Some((at, fault @ (Fault::PowerCut | Fault::LostNames))) if number == at => {
            cut_power(fault);
            Err(ErrorKind::NotConnected.into())
        }
        Some((at, Fault::Crash | Fault::PowerCut | Fault::LostNames)) if number > at => {
            Err(ErrorKind::NotConnected.into())
        }
        _ => Ok(()),
    }
}

/// A call will make, change or remove the files or folders of these names.
pub(super) fn renames(paths: &[&Path]) {
    let before = paths.iter().map(|path| (path.to_path_buf(), fs::read(path).ok()));
    RENAMED.with_borrow_mut(|renamed| renamed.extend(before));
}

/// The names in a folder are on the disk.
pub(super) fn synced(folder: &Path) {
    RENAMED.with_borrow_mut(|renamed| renamed.retain(|(path, _)| path.parent() != Some(folder)));
}

/// Leaves what a power cut would.
pub(crate) fn cut_power(fault: Fault) {
    OPENED.with_borrow(|opened| opened.iter().for_each(|(file, survivor)| cut(file, survivor)));
    for (path, content) in RENAMED.take().into_iter().rev() {
        match content {
            Some(content) if fault == Fault::LostNames || !path.exists() => fs::write(path, content),
            None if fault == Fault::LostNames && path.is_dir() => fs::remove_dir_all(path),
            None if fault == Fault::LostNames && path.exists() => fs::remove_file(path),
            _ => Ok(()),
        }
        .expect("a name of a test can be taken back");
    }
}

fn cut(file: &File, Survivor(length): &Survivor) {
    let length = length.load(Ordering::Relaxed);
    if file.metadata().is_ok_and(|data| data.len() > length) {
        file.set_len(length).expect("a file of a test can be cut");
    }
}
