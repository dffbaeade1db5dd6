//! The window. All of it is in the library, so that it can be tested.

use std::process::ExitCode;

fn main() -> ExitCode {
    // What is no text names no file that there is, and is answered as one.
    microsim_game::launch(std::env::args_os().skip(1).map(|argument| argument.to_string_lossy().into_owned()))
}
