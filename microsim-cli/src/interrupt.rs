//! Ctrl-C (SIGINT), SIGTERM and SIGHUP: the first asks to stop at the next step, the second ends the process.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

static IS_ASKED: AtomicBool = AtomicBool::new(false);
#[cfg(unix)]
static IS_TOO_LONG: AtomicBool = AtomicBool::new(false);
static SIGNAL: AtomicUsize = AtomicUsize::new(0);

#[cfg(unix)]
const SIGNALS: [i32; 3] = [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM];

/// Begins to listen. Without a handler the system's own applies, which is no reason to fail.
pub(crate) fn listen() {
    for signal in SIGNALS.into_iter().filter(|signal| !is_ignored(*signal)) {
        // In this order: what asks to stop must not end the process at once.
        let _ = signal_hook::flag::register_conditional_shutdown(signal, 128 + signal, &IS_ASKED);
        let _ = signal_hook::flag::register_usize(signal, &SIGNAL, signal as usize);
        let _ = signal_hook::flag::register(signal, &IS_ASKED);
    }
    // A file at the limit of its length (`ulimit -f`) is an error of a write, which has words; nobody asks the flag.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, &IS_TOO_LONG);
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
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}
