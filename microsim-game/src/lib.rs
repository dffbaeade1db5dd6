//! A window into microsim: shows a scenario as if under a microscope and lets the player steer a cell.
//!
//! Everything that can be wrong with what the user asked for is found before a window opens. What is drawn goes
//! [`picture`] (what there is, in core units) -> [`camera`] (units to pixels) -> `draw` (pixels to triangles), and only
//! [`convert`] knows both the core's vectors and macroquad's.

pub mod app;
pub mod args;
pub mod camera;
pub mod clock;
pub mod convert;
pub mod draw;
pub mod input;
pub mod microscope;
pub mod picture;
pub mod script;
pub mod shot;
pub mod stage;
mod window;

use app::{App, Plan};
use args::{Command, Options};
use script::Script;
use stage::Stage;
use std::process::ExitCode;

/// Exit code when there is no display, or a file cannot be written.
const NO_DISPLAY: u8 = 1;
/// Exit code when what was asked for makes no sense.
const BAD_REQUEST: u8 = 2;

/// Runs the program with these arguments (without its name).
pub fn launch(arguments: impl IntoIterator<Item = String>) -> ExitCode {
    match args::parse(arguments) {
        Ok(Command::Say(text)) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Ok(Command::Play(options)) => play(options),
        Err(problem) => fail(&problem, BAD_REQUEST),
    }
}

fn play(options: Options) -> ExitCode {
    let prepared = Stage::open(&options.scene).and_then(|stage| Ok((stage, read_script(&options)?)));
    let (stage, script) = match prepared {
        Ok(prepared) => prepared,
        Err(problem) => return fail(&problem, BAD_REQUEST),
    };
    let plan = Plan { script, frames: options.frames, screenshot: options.screenshot, size: options.size };
    match show(stage, plan) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => fail(&problem, NO_DISPLAY),
    }
}

/// Opens a window on a scene and runs it as planned.
///
/// # Errors
/// When there is no display, or a planned picture cannot be written.
pub fn show(stage: Stage, plan: Plan) -> Result<(), String> {
    let title = format!("microsim - {}", stage.name());
    window::open(&title, plan.size, move || App::new(stage, plan).run())
}

fn read_script(options: &Options) -> Result<Option<Script>, String> {
    let Some(path) = &options.script else {
        return Ok(None);
    };
    let text = std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    Script::parse(&text).map(Some).map_err(|problem| format!("{}: {problem}", path.display()))
}

fn fail(problem: &str, code: u8) -> ExitCode {
    eprintln!("microsim-game: {problem}");
    ExitCode::from(code)
}
