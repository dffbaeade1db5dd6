//! Ctrl-C (SIGINT), on Unix SIGTERM and SIGHUP too: the first asks to stop at the next step, the second ends the process.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

static IS_ASKED: AtomicBool = AtomicBool::new(false);
#[cfg(unix)]
static IS_TOO_LONG: AtomicBool = AtomicBool::new(false);
static SIGNAL: AtomicUsize = AtomicUsize::new(0);

/// Begins to listen. Without a handler the system's own applies, which is no reason to fail.
#[cfg(unix)]
pub(crate) fn listen() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    for signal in [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal)) {
        // In this order: what asks to stop must not end the process at once.
        let _ = signal_hook::flag::register_conditional_shutdown(signal, 128 + signal, &IS_ASKED);
        let _ = signal_hook::flag::register_usize(signal, &SIGNAL, signal as usize);
        let _ = signal_hook::flag::register(signal, &IS_ASKED);
    }
    // A file at the limit of its length (`ulimit -f`) is an error of a write, which has words; nobody asks the flag.
    let _ = signal_hook::flag::register(SIGXFSZ, &IS_TOO_LONG);
}

/// Begins to listen: to Ctrl-C and Ctrl-Break, which count as SIGINT. When its console is closed, Windows ends the process at once:
/// the run can be resumed from its last checkpoint.
#[cfg(windows)]
pub(crate) fn listen() {
    const SIGINT: usize = 2;
    let _ = ctrlc::set_handler(|| {
        SIGNAL.store(SIGINT, Ordering::Relaxed);
        if IS_ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(exit_code()));
        }
    });
}

/// Whether the user asked to stop.
pub(crate) fn is_asked() -> bool {
    IS_ASKED.load(Ordering::Relaxed)
}

/// 128 and the number of the signal, as shells count.
pub(crate) fn exit_code() -> u8 {
    128 + SIGNAL.load(Ordering::Relaxed) as u8
}

/// Whether the process was started with the signal ignored, as by `nohup`; known on Linux.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}
