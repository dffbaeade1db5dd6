//! `list` and `check`.

use crate::args::ScenarioArgs;
use crate::console::stdout;
use crate::failure::Failure;
use crate::source::prepare;
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

/// Says whether a scenario can be run, and what would be in it.
pub(crate) fn check(args: &ScenarioArgs) -> Result<(), Failure> {
    let prepared = prepare(args)?;
    let census = prepared.built.world.census();
    let mut out = stdout();
    writeln!(
        out,
        "ok: {}, {} organisms, {} bodies, {} particles, {} constraints",
        prepared.scenario.name(),
        census.organisms,
        census.bodies,
        census.particles,
        census.constraints
    )?;
    Ok(out.flush()?)
}
