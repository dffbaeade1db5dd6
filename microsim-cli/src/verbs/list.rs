//! `list`: the built-in scenarios.

use crate::console::stdout;
use crate::failure::Failure;
use microsim_core::scenario::builtins;
use std::io::Write;

/// Prints the built-in scenarios.
pub(crate) fn list() -> Result<(), Failure> {
    let width = builtins().iter().map(|known| known.name.len()).max();
    let mut out = stdout();
    for known in builtins() {
        let (name, width) = (known.name, width.unwrap_or_default());
        writeln!(out, "{name:width$}  {}", known.summary)?;
    }
    Ok(out.flush()?)
}
