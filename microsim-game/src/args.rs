//! The command line.

use crate::scenery::{Effort, Sight};
use microsim_core::scenario;
use std::fmt;
use std::fs;
use std::path::PathBuf;

/// What the program says about itself.
pub const HELP: &str = "\
microsim-game: cells under the microscope, to watch and to play with

USAGE: microsim-game [NAME | FILE.toml]... [OPTIONS]

  (nothing)          the title: play, or choose a simulation
  NAME               the simulation of a built-in scenario
  FILE.toml          the simulation of a scenario file; more files are in the list of simulations

  --play             the game, at once; with a NAME or FILE, that one
  --set KEY=VALUE    change a value of the scenario, for example game.time=30
  --seed N           the same round every time
  --screenshot FILE  write a PNG of the last frame and exit; steps exactly once per frame
  --frames N         exit after N frames (with --screenshot: 120 unless told)
  --size WxH         size of the window, 160x90 to 7680x4320 (1280x720 unless told)
  --script FILE      take the player's input from a file instead of mouse and keyboard
  --optics NAME      how the world is seen: phase-contrast, dic, ..., or drawn, for slow graphics
  --quality NAME     how much of the machine pictures may take: automatic, high, medium, low
  --timings          say at the end how long steps and frames took
  -h, --help         this text
  -V, --version      the version

CONTROLS: hold the left mouse button: crawl there | hold Q: digest | A, D or wheel: zoom out, in | Space: pause
          R: restart | F11: full screen | F12: picture | Escape: menu. Keys can be changed in the settings.

EXIT CODE: 0 fine, 1 no display or a file that cannot be written, 2 a bad argument or scenario";

/// Frames before a screenshot when none are asked for.
const SCREENSHOT_FRAMES: u32 = 120;

/// What the user asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// To read this and be done.
    Say(String),
    /// To see something.
    Show(Options),
}

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Scene {
    /// A built-in scenario.
    Builtin(String),
    /// A scenario file.
    File(PathBuf),
}

/// Settings of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// What was named, in this order.
    pub scenes: Vec<Scene>,
    /// Whether the game is wanted at once.
    pub plays: bool,
    /// Values of the scenario to change.
    pub overrides: Vec<(String, String)>,
    /// Seed of the scenario.
    pub seed: Option<u64>,
    /// Picture to write at the end.
    pub screenshot: Option<PathBuf>,
    /// Frames after which to exit.
    pub frames: Option<u32>,
    /// Width and height of the window.
    pub size: Option<(u32, u32)>,
    /// Input to play back.
    pub script: Option<PathBuf>,
    /// The way of looking, in place of the one in the settings.
    pub sight: Option<Sight>,
    /// How much of the machine pictures may take, in place of what the settings say.
    pub effort: Option<Effort>,
    /// Whether to say how long everything took.
    pub timings: bool,
}

/// Reads the arguments.
///
/// # Errors
/// Says which argument is wrong and what would be right.
pub fn parse(arguments: impl IntoIterator<Item = String>) -> Result<Command, String> {
    let mut options = Options::default();
    let mut arguments = arguments.into_iter();
    while let Some(argument) = arguments.next() {
        let mut value = |what: &str| arguments.next().ok_or(format!("{argument} needs {what}"));
        match argument.as_str() {
            "-h" | "--help" => return Ok(Command::Say(HELP.to_owned())),
            "-V" | "--version" => return Ok(Command::Say(format!("microsim-game {}", env!("CARGO_PKG_VERSION")))),
            "--play" => options.plays = true,
            "--set" => match pair(&value("KEY=VALUE")?)? {
                (key, value) if key == "seed" => options.seed = Some(seed(&value)?),
                change => options.overrides.push(change),
            },
            "--seed" => options.seed = Some(seed(&value("a number")?)?),
            "--screenshot" => options.screenshot = Some(value("a file")?.into()),
            "--frames" => options.frames = Some(count(&value("a number")?)?),
            "--size" => options.size = Some(size(&value("a size such as 640x360")?)?),
            "--script" => options.script = Some(value("a file")?.into()),
            "--optics" => options.sight = Some(sight(&value("a name")?)?),
            "--quality" => options.effort = Some(effort(&value("a name")?)?),
            "--timings" => options.timings = true,
            other if other.starts_with('-') => return Err(format!("unknown option {other}; --help lists all")),
            other => options.scenes.push(Scene::named(other)),
        }
    }
    if options.screenshot.is_some() {
        options.frames.get_or_insert(SCREENSHOT_FRAMES);
    }
    Ok(Command::Show(options))
}

impl Scene {
    fn named(text: &str) -> Self {
        if text.ends_with(".toml") || text.contains(['/', '\\']) {
            Self::File(text.into())
        } else {
            Self::Builtin(text.to_owned())
        }
    }

    /// Text of the scenario.
    ///
    /// # Errors
    /// When there is no such built-in scenario, or the file cannot be read.
    pub fn text(&self) -> Result<String, String> {
        match self {
            Self::File(path) => {
                fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
            }
            Self::Builtin(name) => scenario::builtin(name).map(|found| found.text.to_owned()).ok_or_else(|| {
                let names: Vec<&str> = scenario::builtins().iter().map(|builtin| builtin.name).collect();
                format!("no built-in scenario {name:?}; there are: {}; a file ends in .toml", names.join(", "))
            }),
        }
    }
}

impl fmt::Display for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Builtin(name) => f.write_str(name),
            Self::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().fmt(f),
        }
    }
}

fn pair(text: &str) -> Result<(String, String), String> {
    let pair = text.split_once('=').map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()));
    pair.filter(|(key, _)| !key.is_empty()).ok_or(format!("--set {text}: not KEY=VALUE"))
}

fn sight(text: &str) -> Result<Sight, String> {
    let names = || Sight::all().map(Sight::name).collect::<Vec<_>>().join(", ");
    Sight::all().find(|sight| sight.name() == text).ok_or_else(|| format!("--optics {text}: not one of {}", names()))
}

fn effort(text: &str) -> Result<Effort, String> {
    let names = || Effort::ALL.map(Effort::name).join(", ");
    Effort::named(text).ok_or_else(|| format!("--quality {text}: not one of {}", names()))
}

fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("--seed {text}: not a whole number from 0 on"))
}

fn count(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(frames @ 1..=1_000_000) => Ok(frames),
        _ => Err(format!("--frames {text}: not a number from 1 to 1000000")),
    }
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once('x').and_then(|(width, height)| {
        let (width, height) = (width.parse().ok()?, height.parse().ok()?);
        ((160..=7680).contains(&width) && (90..=4320).contains(&height)).then_some((width, height))
    });
    sides.ok_or(format!("--size {text}: not a size from 160x90 to 7680x4320"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Command, String> {
        parse(line.split_whitespace().map(str::to_owned))
    }

    fn options(line: &str) -> Options {
        match parsed(line) {
            Ok(Command::Show(options)) => options,
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn names_files_and_options_are_told_apart() {
        assert_eq!(options(""), Options::default());
        let two = options("dam-break ./a.toml");
        assert_eq!(two.scenes, [Scene::Builtin("dam-break".to_owned()), Scene::File("./a.toml".into())]);
        let shot = options("demo --screenshot a.png --size 640x360");
        assert_eq!((shot.frames, shot.size), (Some(SCREENSHOT_FRAMES), Some((640, 360))));
        assert_eq!(options("--screenshot a.png --frames 7").frames, Some(7));
        assert_eq!(options("demo --quality low").effort, Some(Effort::Low));
        assert_eq!(options("--set seed=5"), options("--seed 5"));
        let game = options("--play --set game.time=10 --seed 3");
        assert!(game.plays && game.seed == Some(3));
        assert_eq!(game.overrides, [("game.time".to_owned(), "10".to_owned())]);
    }

    #[test]
    fn mistakes_are_named() {
        for line in [
            "--size 10x10",
            "--size big",
            "--frames 0",
            "--frames",
            "--wrong",
            "--set x",
            "--seed -1",
            "--optics x",
            "--quality x",
        ] {
            assert!(parsed(line).is_err(), "{line}");
        }
        assert!(matches!(parsed("--help"), Ok(Command::Say(text)) if text == HELP));
    }
}
