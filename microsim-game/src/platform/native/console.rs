//! The console of Windows: the program opens none, and writes to the one that it was started from.
#![expect(unsafe_code, reason = "Rust's standard library has no name for it")]

/// `ATTACH_PARENT_PROCESS` of the Windows API.
const PARENT: u32 = u32::MAX;

#[link(name = "kernel32")]
unsafe extern "system" {
    fn AttachConsole(process: u32) -> i32;
}

/// Leads standard output and standard error to the console that the program was started from, if there is one.
pub(super) fn attach() {
    // SAFETY: it takes a number and touches no memory of ours. Where it fails there is no console, and nothing to do.
    unsafe { AttachConsole(PARENT) };
}
