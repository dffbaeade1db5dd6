//! The window. All of it is in the library, so that it can be tested.

// Windows opens no console beside it.
#![cfg_attr(windows, windows_subsystem = "windows")]

use std::process::ExitCode;

fn main() -> ExitCode {
    microsim_game::launch()
}
