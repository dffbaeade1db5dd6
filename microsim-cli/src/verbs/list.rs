//! `list`: the built-in scenarios.

use crate::failure::Failure;
use crate::summary::Table;
use microsim_core::scenario::builtins;

/// Prints the built-in scenarios.
pub(crate) fn list() -> Result<(), Failure> {
    let mut table = Table::default();
    for known in builtins() {
        table.row(known.name, known.summary);
    }
    Ok(table.print()?)
}
