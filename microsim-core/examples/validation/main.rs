//! The core against published results: writes docs/validation.md, and its plots to a folder.
//!
//! ```text
//! cargo run --release -p microsim-core --features scenario --example validation -- docs/validation > docs/validation.md
//! cargo run --release -p microsim-core --features scenario --example validation -- FOLDER pendulum refinement
//! ```
//!
//! Plots go to the folder, the page to standard output: everything, or the experiments that are named.
#![allow(clippy::disallowed_methods, reason = "measures; only stepping has to be bit-exact")]

mod experiments;
mod page;

use experiments::{ALL, refinement};
use std::error::Error;
use std::path::Path;

/// Name of the table that compares steps.
const REFINEMENT: &str = "refinement";

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [folder, names @ ..] = args.as_slice() else {
        return Err("usage: validation FOLDER [NAME ...]".into());
    };
    let is_known = |name: &String| name == REFINEMENT || ALL.iter().any(|experiment| experiment.name == name);
    if let Some(unknown) = names.iter().find(|name| !is_known(name)) {
        return Err(format!("no experiment `{unknown}`").into());
    }
    std::fs::create_dir_all(folder)?;
    let is_asked = |name: &str| names.is_empty() || names.iter().any(|asked| asked == name);
    let mut sections = Vec::new();
    for experiment in ALL.iter().filter(|experiment| is_asked(experiment.name)) {
        let outcome = (experiment.run)()?;
        if let Some(plot) = &outcome.plot {
            std::fs::write(Path::new(folder).join(experiment.name).with_extension("svg"), plot.svg())?;
        }
        sections.push((experiment, outcome));
    }
    if names.is_empty() {
        println!("{}\n{}", page::INTRODUCTION, page::summary(&sections));
    }
    for (experiment, outcome) in &sections {
        println!("{}", page::section(experiment, outcome, &experiment.order.words()?));
    }
    if is_asked(REFINEMENT) {
        println!("{}{}", page::REFINEMENT, refinement::table(2).join("\n"));
    }
    Ok(())
}
