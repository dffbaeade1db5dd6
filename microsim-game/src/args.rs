//! The command line.

use crate::scene_source::SceneSource;
use crate::scenery::{Effort, Sight};
use clap::Parser;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;

/// Frames before a screenshot when none are asked for.
const SCREENSHOT_FRAMES: u32 = 120;

const AFTER_HELP: &str = "\
Without a scenario: the title, to play or to choose a simulation.

CONTROLS: hold the left mouse button: crawl there | A, D or wheel: zoom out, in | Space: pause
          R: restart | F11: full screen | F12: picture | Escape: menu. Keys can be changed in the settings.

EXIT CODE: 0 fine, 1 no display or a file that cannot be written, 2 a bad argument or scenario";

/// Cells under the microscope, to watch and to play with
#[derive(Clone, Debug, PartialEq, Parser)]
#[command(name = "microsim-game", version, args_override_self = true, after_help = AFTER_HELP)]
pub struct Args {
    /// A built-in scenario, or a scenario file; more files are in the list of simulations
    #[arg(value_name = "NAME | FILE.toml")]
    pub scenes: Vec<SceneSource>,
    /// Play the game at once; with a NAME or FILE, that one
    #[arg(long)]
    pub play: bool,
    /// Change a value of the scenario, for example game.time=30
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = pair)]
    pub overrides: Vec<(String, String)>,
    /// Play the same round every time
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Play over a network: the code of a room, 4 to 12 letters and digits
    #[arg(long, value_name = "CODE", conflicts_with_all = ["play", "scenes", "overrides", "seed"])]
    pub room: Option<String>,
    /// Address of the server of rooms; a page has its own
    #[arg(long, value_name = "ADDRESS", default_value = "localhost")]
    pub server: String,
    /// What other players call you
    #[arg(long, value_name = "NAME", default_value = "")]
    pub name: String,
    /// Watch a round that was recorded, such as last-game.replay
    #[arg(long, value_name = "FILE", conflicts_with_all = ["play", "scenes", "overrides", "seed"])]
    pub replay: Option<PathBuf>,
    /// Write a PNG of the last frame and exit; takes exactly one step in each frame
    #[arg(long, value_name = "FILE")]
    pub screenshot: Option<PathBuf>,
    /// Exit after N frames, 1 to 1000000 (with --screenshot: 120 unless told)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub frames: Option<u32>,
    /// Size of the window, 160x90 to 7680x4320
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x720")]
    pub size: (u32, u32),
    /// Take the player's input from a file instead of mouse and keyboard
    #[arg(long, value_name = "FILE")]
    pub script: Option<PathBuf>,
    /// How the world is seen, in place of the settings; drawn suits slow graphics
    #[arg(long = "optics", value_name = "NAME", value_parser = sights())]
    pub sight: Option<Sight>,
    /// How much of the machine pictures may take, in place of the settings
    #[arg(long = "quality", value_name = "NAME", value_parser = efforts())]
    pub effort: Option<Effort>,
    /// Say at the end how long steps and frames took
    #[arg(long)]
    pub timings: bool,
}

impl Args {
    /// Frames after which to exit.
    #[must_use]
    pub fn frames(&self) -> Option<u32> {
        self.frames.or(self.screenshot.as_ref().map(|_| SCREENSHOT_FRAMES))
    }
}

fn pair(text: &str) -> Result<(String, String), String> {
    let pair = text.split_once('=').map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()));
    pair.filter(|(key, _)| !key.is_empty()).ok_or_else(|| "not KEY=VALUE".to_owned())
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once('x').and_then(|(width, height)| {
        let (width, height) = (width.parse().ok()?, height.parse().ok()?);
        ((160..=7680).contains(&width) && (90..=4320).contains(&height)).then_some((width, height))
    });
    sides.ok_or_else(|| "not a size from 160x90 to 7680x4320".to_owned())
}

fn sights() -> impl TypedValueParser<Value = Sight> {
    PossibleValuesParser::new(Sight::all().map(Sight::name)).map(|name| Sight::named(&name))
}

fn efforts() -> impl TypedValueParser<Value = Effort> {
    PossibleValuesParser::new(Effort::ALL.map(Effort::name)).map(Effort::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::error::ErrorKind;

    fn parsed(line: &str) -> Result<Args, clap::Error> {
        Args::try_parse_from(["microsim-game"].into_iter().chain(line.split_whitespace()))
    }

    fn args(line: &str) -> Args {
        parsed(line).unwrap_or_else(|error| panic!("{line}: {error}"))
    }

    #[test]
    fn names_files_and_options_are_told_apart() {
        let none = args("");
        assert!(none.scenes.is_empty() && !none.play && none.size == (1280, 720) && none.frames().is_none());
        let two = args("dam-break ./a.toml");
        assert_eq!(two.scenes, [SceneSource::Builtin("dam-break".to_owned()), SceneSource::File("./a.toml".into())]);
        let shot = args("demo --screenshot a.png --size 640x360");
        assert_eq!((shot.frames(), shot.size), (Some(SCREENSHOT_FRAMES), (640, 360)));
        assert_eq!(args("--screenshot a.png --frames 7").frames(), Some(7));
        assert_eq!(args("demo --quality low").effort, Some(Effort::Low));
        assert_eq!(args("demo --optics drawn").sight, Some(Sight::Drawn));
        assert_eq!(args("--seed 1 --seed 5").seed, Some(5), "the last one counts");
        let game = args("--play --set game.time=10 demo --set a=b --seed 3");
        assert!(game.play && game.seed == Some(3) && game.scenes.len() == 1);
        assert_eq!(game.overrides, [("game.time", "10"), ("a", "b")].map(|(key, value)| (key.into(), value.into())));
    }

    #[test]
    fn mistakes_are_refused_with_exit_code_2() {
        assert!(parsed("--replay a.replay --play").is_err() && args("--replay a.replay").replay.is_some());
        let numbers = ["--size 10x10", "--size big", "--frames 0", "--frames", "--seed -1"];
        let words = ["--wrong", "--set x", "--set =1", "--optics x", "--quality x"];
        for line in numbers.into_iter().chain(words) {
            assert_eq!(parsed(line).map_err(|error| error.exit_code()), Err(2), "{line}");
        }
    }

    #[test]
    fn help_and_version_are_no_mistakes() {
        for (line, kind) in [("--help", ErrorKind::DisplayHelp), ("-V", ErrorKind::DisplayVersion)] {
            let answer = parsed(line).unwrap_err();
            assert_eq!((answer.kind(), answer.exit_code()), (kind, 0));
        }
        assert!(parsed("-h").unwrap_err().to_string().contains("CONTROLS"));
    }
}
