//! Reasons why the program fails, and their exit codes.

use crate::console::Console;
use crate::diagnostics::{self, ScenarioText};
use microsim_core::scenario::Diagnostics;
use std::io::ErrorKind;
use std::path::Path;
use std::process::ExitCode;

const BROKEN: u8 = 1;
const REFUSED: u8 = 2;
const INTERRUPTED: u8 = 130;

/// A reason to stop without success.
#[derive(Debug)]
pub(crate) enum Failure {
    /// An error message.
    Message(String),
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
    /// Ctrl-C; all outputs so far have been written.
    Interrupted,
    /// Ctrl-C, with the command that resumes the run.
    Stopped(String),
}

impl Failure {
    /// A file or folder that cannot be read or written.
    pub(crate) fn file(verb: &str, path: &Path, error: &std::io::Error) -> Self {
        Self::Message(format!("cannot {verb} {}: {error}{}", path.display(), remedy(error.kind())))
    }

    /// Tells the user, and says which code to exit with.
    pub(crate) fn report(self, console: &Console) -> ExitCode {
        match self {
            Self::Message(text) => console.complain(&format!("error: {text}")),
            Self::Scenario(source, problems) => {
                console.complain(&diagnostics::render(&source, &problems, console.is_coloured()));
            }
            Self::Broken(lines) => {
                for line in &lines {
                    console.complain(line);
                }
                return ExitCode::from(BROKEN);
            }
            Self::Reported => {}
            Self::Negative => return ExitCode::from(BROKEN),
            Self::PipeClosed => return ExitCode::SUCCESS,
            Self::Stopped(text) => {
                console.note(&text);
                return ExitCode::from(INTERRUPTED);
            }
            Self::Interrupted => {
                console.note("interrupted");
                return ExitCode::from(INTERRUPTED);
            }
        }
        ExitCode::from(REFUSED)
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
