//! A line of output: on stdout, or for WebAssembly, which has none, through a function of the host's.

#[cfg(not(target_family = "wasm"))]
pub(crate) fn print(line: &str) {
    println!("{line}");
}

#[cfg(target_family = "wasm")]
pub(crate) fn print(line: &str) {
    #[link(wasm_import_module = "host")]
    unsafe extern "C" {
        /// Prints `length` bytes of UTF-8 at `text`.
        fn print(text: *const u8, length: usize);
    }
    // SAFETY: `line` lives until the host has read it, and the host only reads.
    unsafe { print(line.as_ptr(), line.len()) }
}
