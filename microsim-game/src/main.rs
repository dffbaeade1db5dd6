//! The window. All of it is in the library, so that it can be tested.

use std::process::ExitCode;

fn main() -> ExitCode {
    microsim_game::launch()
}
