//! Stdout for results, stderr for notes, errors and progress, and whether to use colour.

use crate::{json, sanitize};
use clap::ColorChoice;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::io::{self, IsTerminal, Write};

/// How to talk to the user on stderr.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Console {
    pub is_coloured: bool,
    is_quiet: bool,
    is_verbose: bool,
}

impl Console {
    pub(crate) fn new(color: ColorChoice, is_quiet: bool, is_verbose: bool) -> Self {
        let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let is_coloured = match color {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => !refused && io::stderr().is_terminal(),
        };
        Self { is_coloured, is_quiet, is_verbose }
    }

    /// One line for the user. That stderr is closed is no reason to fail.
    pub(crate) fn note(self, text: &str) {
        if !self.is_quiet {
            let _ = writeln!(io::stderr(), "{}", sanitize::line(text));
        }
    }

    /// One line for `--verbose`.
    pub(crate) fn detail(self, text: impl FnOnce() -> String) {
        if self.is_verbose {
            let _ = writeln!(io::stderr(), "{}", sanitize::line(&text()));
        }
    }

    /// One line about what went wrong; also when quiet.
    pub(crate) fn complain(self, text: &str) {
        let _ = writeln!(io::stderr(), "{}", sanitize::line(text.trim_end()));
    }

    /// A report about what went wrong, of several lines and with colours.
    pub(crate) fn complain_styled(self, text: &str) {
        let _ = writeln!(io::stderr(), "{}", sanitize::coloured(text.trim_end()));
    }

    /// A bar on stderr, hidden unless that is a terminal.
    pub(crate) fn progress(self, steps: u64, of: &str) -> ProgressBar {
        let is_shown = !self.is_quiet && io::stderr().is_terminal();
        let target = if is_shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(steps), target);
        let template = format!("{{elapsed:>4}} [{{bar:40}}] {of} {{pos}}/{{len}}, {{per_sec}}, {{eta}} left");
        match ProgressStyle::with_template(&template) {
            Ok(style) => bar.with_style(style.progress_chars("=> ")),
            Err(_) => bar,
        }
    }
}

/// Writes to stdout: the only way to it, so that a closed pipe is an error and no panic.
pub(crate) fn print(content: impl AsRef<[u8]>) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(content.as_ref())?;
    out.flush()
}

/// Writes a value to stdout as one line of JSON.
pub(crate) fn print_json(value: &impl Serialize) -> io::Result<()> {
    print(json::line(value)?)
}
