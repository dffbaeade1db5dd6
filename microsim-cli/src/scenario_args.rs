//! The arguments that name a scenario and change it: `NAME|FILE`, `--seed` and `--set`.

use crate::value_parser::{key_value, whole};

/// A scenario and the changes to it.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct ScenarioArgs {
    /// A built-in scenario, a TOML file, or `-` for stdin
    #[arg(value_name = "NAME|FILE")]
    pub scenario: String,
    #[command(flatten)]
    pub changes: Changes,
}

/// Changes to a scenario.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct Changes {
    /// Seed of all random numbers, in place of the scenario's own
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole)]
    pub seed: Option<u64>,
    /// Replace one value of the scenario, for example `step.substeps=12`; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_value)]
    pub set: Vec<(String, String)>,
}
