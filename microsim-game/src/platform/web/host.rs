//! The page's functions, which `web/host.js` gives to the loader.
#![expect(unsafe_code, reason = "functions of the page are called by address and length")]

#[link(wasm_import_module = "env")]
unsafe extern "C" {
    /// Milliseconds since the page began.
    safe fn microsim_now() -> f64;
    /// Has the page find bytes; their number, or -1 if there are none.
    fn microsim_ask(what: *const u8, what_length: usize, name: *const u8, name_length: usize) -> i32;
    /// Copies the bytes that were found last.
    fn microsim_take(to: *mut u8);
    /// Hands bytes to the page; 1 if it has taken them.
    fn microsim_tell(
        what: *const u8,
        what_length: usize,
        name: *const u8,
        name_length: usize,
        bytes: *const u8,
        length: usize,
    ) -> i32;
}

/// Version of these functions, which the loader compares with that of `web/host.js`.
#[unsafe(no_mangle)]
extern "C" fn microsim_crate_version() -> u32 {
    1
}

/// Milliseconds since the page began.
pub(super) fn now() -> f64 {
    microsim_now()
}

/// Asks the page for bytes; `None` if it has none of this name.
pub(super) fn ask(what: &str, name: &str) -> Option<Vec<u8>> {
    // SAFETY: the page only reads the two texts, within their lengths.
    let length = unsafe { microsim_ask(what.as_ptr(), what.len(), name.as_ptr(), name.len()) };
    let mut bytes = vec![0; usize::try_from(length).ok()?];
    // SAFETY: the page writes as many bytes as it has just named, and `bytes` has room for them.
    unsafe { microsim_take(bytes.as_mut_ptr()) };
    Some(bytes)
}

/// Hands bytes to the page; whether it has taken them.
pub(super) fn tell(what: &str, name: &str, bytes: &[u8]) -> bool {
    // SAFETY: the page only reads the two texts and the bytes, within their lengths.
    let taken =
        unsafe { microsim_tell(what.as_ptr(), what.len(), name.as_ptr(), name.len(), bytes.as_ptr(), bytes.len()) };
    taken == 1
}
