//! A window into microsim: a game, and a microscope to watch and meddle with cells.
//!
//! Everything that can be wrong with what the user asked for is found before a window opens.
//!
//! ```text
//!   input --> screen --> rules, stage --> core            (what is played; `rules` knows no window)
//!               |
//!               +--> viewer --> scenery --> draw, microscope   (the scene: a moment of the world, on the screen)
//!               +--> hud, ui                                   (what lies above it)
//! ```
//!
//! Only [`convert`] knows both the core's vectors and macroquad's.

pub mod app;
pub mod args;
pub mod camera;
pub mod clock;
pub mod convert;
pub mod draw;
pub mod hud;
pub mod input;
pub mod microscope;
pub mod rules;
pub mod scenery;
pub mod screen;
pub mod shot;
pub mod stage;
pub mod store;
pub mod timings;
pub mod ui;
pub mod viewer;
mod window;

use app::{App, Opening, Plan};
use args::{Command, Options, Scene};
use input::script::Script;
use screen::{Asked, Context, GameChoice};
use stage::Stage;
use std::process::ExitCode;
use store::files::Store;

/// Exit code when there is no display, or a file cannot be written.
const NO_DISPLAY: u8 = 1;
/// Exit code when what was asked for makes no sense.
const BAD_REQUEST: u8 = 2;
/// Size of the window if none is asked for.
const SIZE: (u32, u32) = (1280, 720);
/// The scenario of the game.
const GAME: &str = "game";

/// Runs the program with these arguments (without its name).
pub fn launch(arguments: impl IntoIterator<Item = String>) -> ExitCode {
    match args::parse(arguments) {
        Ok(Command::Say(text)) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Ok(Command::Show(options)) => {
            let prepared = prepare(options).map_err(|problem| (problem, BAD_REQUEST));
            let ended = prepared.and_then(|start| start.run().map_err(|problem| (problem, NO_DISPLAY)));
            ended.map_or_else(|(problem, code)| fail(&problem, code), |()| ExitCode::SUCCESS)
        }
        Err(problem) => fail(&problem, BAD_REQUEST),
    }
}

/// Opens a window on a scene and runs it as planned.
///
/// # Errors
/// When there is no display, or a planned picture cannot be written.
pub fn show(stage: Stage, plan: Plan) -> Result<(), String> {
    let game = GameChoice { scene: Scene::Builtin(GAME.to_owned()), overrides: Vec::new(), seed: None };
    Start { opening: Opening::Sandbox(Box::new(stage)), game, files: Vec::new(), plan }.run()
}

/// Everything that is needed to open the window.
struct Start {
    opening: Opening,
    game: GameChoice,
    files: Vec<Scene>,
    plan: Plan,
}

impl Start {
    fn run(self) -> Result<(), String> {
        let Self { opening, game, files, plan } = self;
        let store = if plan.is_exact() { Store::nowhere() } else { Store::of_the_platform() };
        let title = match &opening {
            Opening::Sandbox(stage) => format!("microsim - {}", stage.name()),
            _ => "microsim".to_owned(),
        };
        window::open(&title, plan.size, move || App::new(opening, Context::new(store, game, files), plan).run())
    }
}

fn prepare(options: Options) -> Result<Start, String> {
    let script = read_script(&options)?;
    let Options { scenes, plays, overrides, seed, screenshot, frames, size, timings, sight, effort, .. } = options;
    let builtin = Scene::Builtin(GAME.to_owned());
    let named = scenes.first().filter(|_| plays).cloned();
    let files = scenes.iter().filter(|scene| matches!(scene, Scene::File(_))).cloned().collect();
    let is_for_game = plays || scenes.is_empty();
    let game_overrides = if is_for_game { overrides.clone() } else { Vec::new() };
    let game =
        GameChoice { scene: named.unwrap_or(builtin), overrides: game_overrides, seed: seed.filter(|_| is_for_game) };
    let opening = match scenes.first() {
        _ if plays => Opening::Play,
        Some(scene) => {
            let seed = seed.map(|seed| ("seed".to_owned(), seed.to_string()));
            let overrides: Vec<_> = overrides.into_iter().chain(seed).collect();
            Opening::Sandbox(Box::new(Stage::open(scene, &overrides)?))
        }
        None => Opening::Title,
    };
    if is_for_game {
        game.check()?;
    }
    let asked = Asked { sight, effort };
    let plan = Plan { script, frames, screenshot, size: size.unwrap_or(SIZE), asked, timings };
    Ok(Start { opening, game, files, plan })
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
