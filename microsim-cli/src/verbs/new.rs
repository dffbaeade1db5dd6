//! `new`: a scenario to start from.

use super::schema;
use crate::console::{Console, print};
use crate::failure::Failure;
use crate::output::Outputs;
use microsim_core::scenario::{builtin, builtins};
use std::path::{Path, PathBuf};

/// The file, each table explained.
const STARTER: &str = include_str!("starter.toml");
/// File name of the schema.
const SCHEMA: &str = "scenario.schema.json";

#[derive(Debug, clap::Args)]
#[command(after_help = "Also writes scenario.schema.json beside it, with which editors check the file.")]
pub(crate) struct NewArgs {
    /// The file to write, or `-` for stdout
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Begin with a built-in scenario in place of the starter
    #[arg(long, value_name = "NAME")]
    pub from: Option<String>,
    /// Replace a file that exists
    #[arg(long)]
    pub force: bool,
}

/// Writes the file.
pub(crate) fn new(args: &NewArgs, console: &Console) -> Result<(), Failure> {
    let text = match &args.from {
        None => STARTER.to_owned(),
        Some(name) => format!("#:schema ./{SCHEMA}\n{}", text_of(name)?),
    };
    if args.file == Path::new("-") {
        return Ok(print(text)?);
    }
    if args.file.exists() && !args.force {
        let message = format!("{} exists, accepted: a new file, or any with --force", args.file.display());
        return Err(Failure::Message(message));
    }
    let (outputs, name) = Outputs::beside(&args.file)?;
    outputs.write(&name, text.as_bytes())?;
    outputs.write(SCHEMA, schema::text().as_bytes())?;
    console.note(&format!("wrote {0}; check it with: microsim check {0}", args.file.display()));
    Ok(())
}

fn text_of(name: &str) -> Result<&'static str, Failure> {
    let known = || builtins().iter().map(|known| known.name).collect::<Vec<_>>().join(", ");
    let found = builtin(name).map(|known| known.text);
    found.ok_or_else(|| Failure::Message(format!("there is no built-in scenario {name:?}, accepted: {}", known())))
}
