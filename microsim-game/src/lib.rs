//! A window into microsim: a game, and a microscope to watch and meddle with cells.
//!
//! Errors in arguments, scenarios and scripts are reported before a window opens.
//!
//! ```text
//!   input --> screen --> rules, stage --> core            (what is played; `rules` knows no window)
//!               +--> sound                                     (what is heard of it)
//!               +--> network --> rules                         (who plays along)
//!               |
//!               +--> viewer --> scenery --> draw, microscope   (the scene: a moment of the world, on the screen)
//!               +--> hud, ui                                   (what lies above it)
//! ```
//!
//! Only [`platform`] knows whether this is a desktop or a page in a browser, and only [`convert`] knows both the core's vectors and macroquad's.

pub mod album;
pub mod app;
pub mod args;
pub mod camera;
pub mod clock;
pub mod convert;
pub mod draw;
pub mod game_choice;
pub mod guide;
pub mod hud;
pub mod input;
pub mod input_device;
pub mod microscope;
pub mod network;
#[cfg(target_arch = "wasm32")]
mod page;
pub mod platform;
pub mod rules;
pub mod scene_source;
pub mod scenery;
pub mod screen;
pub mod shot;
pub mod slides;
pub mod sound;
pub mod stage;
pub mod store;
pub mod timings;
pub mod ui;
pub mod viewer;
mod waiting;
mod window;
pub mod words;

use app::{App, RunOptions};
use args::{Answer, Args};
use game_choice::GameChoice;
use input::script::InputScript;
use microsim_core::replay::Replay;
use rules::round::Round;
use scene_source::SceneSource;
use screen::MainScreen;
use screen::context::{AppContext, Asked, Party, choose_first_language};
use stage::Stage;
use std::path::Path;
use std::process::ExitCode;
use store::files::PlayerFolder;
use words::Language;

/// Exit code when there is no display, or a file cannot be written.
const NO_DISPLAY: u8 = 1;
/// Exit code for bad arguments and scenarios.
const BAD_REQUEST: u8 = 2;
/// The scenario of the game.
const GAME: &str = "game";

/// Runs the program with the arguments that the platform has for it.
pub fn launch() -> ExitCode {
    let args = match Args::parse(platform::arguments()) {
        Ok(args) => args,
        Err(Answer::Asked(text)) => {
            platform::answer(&text);
            return ExitCode::SUCCESS;
        }
        Err(Answer::Mistake(problem)) => return fail(&problem, BAD_REQUEST),
    };
    match Start::prepare(args).map(Start::run) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(problem)) => fail(&problem, NO_DISPLAY),
        Err(problem) => fail(&problem, BAD_REQUEST),
    }
}

/// Opens a window on a scene and runs it with these options.
///
/// # Errors
/// When there is no display, or the picture cannot be written.
pub fn show(stage: Stage, options: RunOptions) -> Result<(), String> {
    let game = GameChoice { source: GAME.into(), overrides: Vec::new(), seed: None };
    let (first, files, party) = (MainScreen::Simulation(Box::new(stage)), Vec::new(), Party::default());
    Start { first, game, files, record: None, party, options }.run()
}

/// Everything that is needed to open the window.
struct Start {
    first: MainScreen,
    game: GameChoice,
    files: Vec<SceneSource>,
    /// A recorded round to watch, in place of the last one.
    record: Option<Vec<u8>>,
    party: Party,
    options: RunOptions,
}

impl Start {
    fn prepare(mut args: Args) -> Result<Self, String> {
        take_seed(&mut args)?;
        let options = RunOptions {
            script: args.script.as_deref().map(read_script).transpose()?,
            frames: args.frames(),
            screenshot: args.screenshot.take(),
            size: args.size,
            asked: Asked { sight: args.sight, effort: args.effort, language: args.language },
            timings: args.timings,
        };
        let record = args.replay.as_deref().map(read_replay).transpose()?;
        let Args { scenes, play, overrides, seed, room, server, name, .. } = args;
        let files = scenes.iter().filter(|scene| matches!(scene, SceneSource::File(_))).cloned().collect();
        let named = scenes.into_iter().next();
        let mut game = GameChoice { source: GAME.into(), overrides: Vec::new(), seed: None };
        let first = match named {
            Some(scene) if !play => {
                let seed = seed.map(|seed| ("seed".to_owned(), seed.to_string()));
                let overrides: Vec<_> = overrides.into_iter().chain(seed).collect();
                MainScreen::Simulation(Box::new(Stage::open(&scene, &overrides)?))
            }
            named => {
                game = GameChoice { source: named.unwrap_or(game.source), overrides, seed };
                game.round(1)?;
                match (&record, &room) {
                    (Some(_), _) => MainScreen::Replay,
                    (None, Some(code)) => MainScreen::Room(code.clone()),
                    (None, None) if play => MainScreen::Round,
                    (None, None) => MainScreen::Title,
                }
            }
        };
        let party = Party { server, code: room.unwrap_or_default(), name, key: platform::room_key() };
        Ok(Self { first, game, files, record, party, options })
    }

    fn run(self) -> Result<(), String> {
        let Self { first, game, files, record, party, options } = self;
        let folder = if options.is_exact() { PlayerFolder::nowhere() } else { PlayerFolder::of_the_platform() };
        let title = match &first {
            MainScreen::Simulation(stage) => format!("microsim - {}", stage.name()),
            _ => "microsim".to_owned(),
        };
        window::open(&title, options.size, async move || {
            let locale = if options.is_exact() { String::new() } else { platform::locale() };
            let system = Language::for_locale(&locale);
            choose_first_language(&options.asked, &folder, system);
            if !options.is_exact() {
                waiting::show().await;
            }
            let mut context = AppContext::new(folder, game, files);
            context.system_language = system;
            context.party = party;
            context.last_game = record.or(context.last_game);
            App::new(first, context, options).run().await
        })
    }
}

/// `--set seed=N` is `--seed N`.
fn take_seed(args: &mut Args) -> Result<(), String> {
    let is_seed = |(key, _): &mut (String, String)| key == "seed";
    if let Some((_, value)) = args.overrides.extract_if(.., is_seed).last() {
        args.seed = Some(value.parse().map_err(|_| format!("--set seed={value}: not a whole number from 0 on"))?);
    }
    Ok(())
}

fn read_replay(path: &Path) -> Result<Vec<u8>, String> {
    let bytes = platform::read(path).map_err(|error| words::of_file(words::Key::FileUnreadable, path, &error))?;
    let round = Replay::read(&bytes).map_err(|error| error.to_string()).and_then(|replay| Round::again(&replay));
    round.map(|_| bytes).map_err(|problem| format!("{}: {problem}", path.display()))
}

fn read_script(path: &Path) -> Result<InputScript, String> {
    let text = SceneSource::File(path.to_owned()).text()?;
    InputScript::parse(&text).map_err(|problem| format!("{}: {problem}", path.display()))
}

fn fail(problem: &str, code: u8) -> ExitCode {
    platform::fail(problem);
    ExitCode::from(code)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn args(line: &str) -> Args {
        Args::parse(["microsim-game"].into_iter().chain(line.split_whitespace())).unwrap()
    }

    #[test]
    fn the_seed_can_be_set_like_any_other_value() {
        let mut set = args("--set seed=4 --set a=1 --set seed=5");
        take_seed(&mut set).unwrap();
        assert_eq!(set, args("--seed 5 --set a=1"));
        assert!(take_seed(&mut args("--set seed=x")).is_err());
    }

    #[test]
    fn the_named_scene_is_shown_first() {
        let start = |line: &str| Start::prepare(args(line)).map(|start| (start.first, start.game));
        assert!(matches!(start("").unwrap(), (MainScreen::Title, _)));
        assert!(matches!(start("demo").unwrap(), (MainScreen::Simulation(stage), _) if stage.name() == "demo"));
        let (first, game) = start("--play --seed 3 --set game.time=10").unwrap();
        assert!(matches!(first, MainScreen::Round) && game.seed == Some(3) && game.time() == Some(10.0));
        let (first, game) = start("--room ab12 --seed 3").unwrap();
        assert!(matches!(first, MainScreen::Room(code) if code == "ab12") && game.seed == Some(3));
        for line in [
            "nonsense",
            "--play empty",
            "demo --set a=1",
            "--script /nonexistent",
            "--replay /nonexistent",
            "--replay Cargo.toml",
        ] {
            assert!(start(line).is_err(), "{line}");
        }
    }
}
