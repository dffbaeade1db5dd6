//! `run.json`: the results of a run, and what is needed to repeat it.

use super::folder::{Outputs, sha256};
use crate::failure::Failure;
use crate::json;
use crate::prepared::Prepared;
use crate::summary::RunReport;
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
struct RunDescription<'a> {
    #[serde(flatten)]
    report: &'a RunReport,
    target: String,
    features: Vec<&'static str>,
    /// Digest of the world before its first step.
    digest_at_start: &'a str,
    source: &'a str,
    overrides: &'a [(String, String)],
    scenario_text: &'a str,
    /// The scenario with everything put in.
    effective_scenario: String,
    /// SHA-256 of every other file.
    files: BTreeMap<String, String>,
}

/// Writes the file, after all others.
pub(crate) fn write_description(
    outputs: &Outputs,
    prepared: &Prepared,
    report: &RunReport,
    digest_at_start: &str,
) -> Result<(), Failure> {
    let description = RunDescription {
        report,
        target: format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
        features: if cfg!(feature = "parquet") { vec!["parquet"] } else { Vec::new() },
        digest_at_start,
        source: &prepared.source.origin,
        overrides: &prepared.overrides,
        scenario_text: &prepared.source.text,
        effective_scenario: prepared.scenario.effective(),
        files: outputs.written(sha256)?.into_iter().collect(),
    };
    outputs.write("run.json", json::pretty(&description)?.as_bytes())
}
