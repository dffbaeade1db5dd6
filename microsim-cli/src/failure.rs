//! Reasons why the program fails, and their exit codes.

use crate::console::Console;
use crate::diagnostics::{self, ScenarioText};
use crate::interrupt;
use microsim_core::scenario::Diagnostics;
use std::io::ErrorKind;
use std::path::Path;
use std::process::ExitCode;

/// A reason to stop without success.
#[derive(Debug)]
pub(crate) enum Failure {
    /// An error message of one line.
    Message(String),
    /// The same, and lines of advice.
    Advised(String, Vec<String>),
    /// The scenario is refused.
    Scenario(ScenarioText, Diagnostics),
    /// The scenario is refused; its problems are on stdout.
    Reported,
    /// The answer on stdout is negative.
    Negative,
    /// The reader of stdout has closed it.
    PipeClosed,
    /// Checks that failed, one a line; all outputs have been written.
    Broken(Vec<String>),
    /// Ctrl-C or a signal like it; all outputs so far have been written.
    Interrupted,
    /// The same, with the command that resumes the run.
    Stopped(String),
}

impl Failure {
    /// A file or folder that cannot be read or written.
    pub(crate) fn file(verb: &str, path: &Path, error: &std::io::Error) -> Self {
        Self::Message(format!("cannot {verb} {}: {error}{}", path.display(), remedy(error.kind())))
    }

    /// Tells the user, and says which code to exit with.
    pub(crate) fn report(self, console: &Console) -> ExitCode {
        let code = match self {
            Self::PipeClosed => ExitCode::SUCCESS,
            Self::Broken(_) | Self::Negative => ExitCode::from(1),
            Self::Message(_) | Self::Advised(..) | Self::Scenario(..) | Self::Reported => ExitCode::from(2),
            Self::Interrupted | Self::Stopped(_) => ExitCode::from(interrupt::exit_code()),
        };
        match self {
            Self::Message(text) => console.complain(&format!("error: {text}")),
            Self::Advised(text, advice) => {
                console.complain(&format!("error: {text}"));
                advice.iter().for_each(|line| console.complain(line));
            }
            Self::Scenario(source, problems) => {
                console.complain_styled(&diagnostics::render(&source, &problems, console.is_coloured));
            }
            Self::Broken(lines) => lines.iter().for_each(|line| console.complain(line)),
            Self::Stopped(text) => console.note(&text),
            Self::Interrupted => console.note("interrupted"),
            Self::Reported | Self::Negative | Self::PipeClosed => {}
        }
        code
    }
}

/// Advice for an I/O error.
fn remedy(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "; free some space or choose another place",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "; choose a place that you may use",
        ErrorKind::NotADirectory => "; a part of the path is a file",
        _ => "",
    }
}

/// Errors of stdout; those of files go through [`Failure::file`].
impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        if error.kind() == ErrorKind::BrokenPipe {
            Self::PipeClosed
        } else {
            Self::file("write to", Path::new("stdout"), &error)
        }
    }
}
