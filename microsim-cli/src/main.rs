//! `microsim`: everything is in the library, so that it compiles beside the core.

use std::process::ExitCode;

fn main() -> ExitCode {
    microsim_cli::main()
}
