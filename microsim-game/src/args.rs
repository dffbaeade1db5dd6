//! The command line. `lexopt` reads it, because a page downloads this program and `clap` is larger.

use crate::scene_source::SceneSource;
use crate::scenery::{Effort, Sight};
use crate::words::{LANGUAGES, Language};
use lexopt::{Arg, Parser, ValueExt};
use std::ffi::OsString;
use std::path::PathBuf;

/// Frames before a screenshot when none are asked for.
const SCREENSHOT_FRAMES: u32 = 120;

const HELP: &str = "\
Cells under the microscope, to watch and to play with

Usage: microsim-game [OPTIONS] [NAME | FILE.toml]...

Without a scenario: the title, to play or to choose a simulation. More files are in the list of simulations.

Options:
      --play             Play the game at once; with a NAME or FILE, that one
      --set <KEY=VALUE>  Change a value of the scenario, for example game.time=30
      --seed <N>         Play the same round every time
      --room <CODE>      Play over a network: the code of a room, 4 to 12 letters and digits
      --server <ADDRESS> Address of the server of rooms [default: localhost]; a page has its own
      --name <NAME>      What other players call you
      --replay <FILE>    Watch a round that was recorded, such as last-game.replay
      --screenshot <FILE>
                         Write a PNG of the last frame and exit; takes exactly one step in each frame
      --frames <N>       Exit after N frames, 1 to 1000000 (with --screenshot: 120 unless told)
      --size <WxH>       Size of the window, 160x90 to 7680x4320 [default: 1280x720]
      --script <FILE>    Take the player's input from a file instead of mouse and keyboard
      --language <TAG>   Language of all that is read in the window: en or cs, in place of the settings
      --optics <NAME>    How the world is seen, in place of the settings; drawn suits slow graphics
      --quality <NAME>   How much of the machine pictures may take, in place of the settings
      --timings          Say at the end how long steps and frames took
  -h, --help             Print help
  -V, --version          Print version

CONTROLS: hold the left mouse button: crawl there | A, D or wheel: zoom out, in | left Shift: lunge | Space: pause
          R: restart | F11: full screen | F12: picture | Escape: menu. Keys can be changed in the settings.

EXIT CODE: 0 fine, 1 no display or a file that cannot be written, 2 a bad argument or scenario
";

/// What the command line asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Args {
    /// Scenarios to show; the first one is shown first.
    pub scenes: Vec<SceneSource>,
    /// Whether the game is played at once.
    pub play: bool,
    /// Changed values of the scenario, by key.
    pub overrides: Vec<(String, String)>,
    /// The seed of every round.
    pub seed: Option<u64>,
    /// The code of a room to play in over a network.
    pub room: Option<String>,
    /// Address of the server of rooms.
    pub server: String,
    /// What other players call this one.
    pub name: String,
    /// A recorded round to watch.
    pub replay: Option<PathBuf>,
    /// Where a picture of the last frame is written.
    pub screenshot: Option<PathBuf>,
    /// Frames after which the program ends.
    pub frames: Option<u32>,
    /// Size of the window, pixels.
    pub size: (u32, u32),
    /// A file in place of mouse and keyboard.
    pub script: Option<PathBuf>,
    /// How the world is seen.
    pub sight: Option<Sight>,
    /// How much of the machine pictures may take.
    pub effort: Option<Effort>,
    /// The language of what is read.
    pub language: Option<&'static Language>,
    /// Whether times are told at the end.
    pub timings: bool,
}

impl Default for Args {
    fn default() -> Self {
        Self {
            scenes: Vec::new(),
            play: false,
            overrides: Vec::new(),
            seed: None,
            room: None,
            server: "localhost".to_owned(),
            name: String::new(),
            replay: None,
            screenshot: None,
            frames: None,
            size: (1280, 720),
            script: None,
            sight: None,
            effort: None,
            language: None,
            timings: false,
        }
    }
}

/// What is said in place of doing what was asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// What was asked for: help, or the version.
    Asked(String),
    /// What is wrong.
    Mistake(String),
}

impl From<lexopt::Error> for Answer {
    fn from(error: lexopt::Error) -> Self {
        Self::Mistake(error.to_string())
    }
}

impl Args {
    /// Reads a command line, the first word of which is the program's name. An option that is given twice counts as the last says.
    ///
    /// # Errors
    /// What to say instead: help, the version, or what is wrong.
    pub fn parse(words: impl IntoIterator<Item = impl Into<OsString>>) -> Result<Self, Answer> {
        let (mut args, mut parser) = (Self::default(), Parser::from_iter(words));
        while let Some(arg) = parser.next()? {
            match arg {
                Arg::Value(scene) => args.scenes.push(scene.string()?.as_str().into()),
                Arg::Long(option) => {
                    let option = option.to_owned();
                    args.read(&option, &mut parser)?;
                }
                Arg::Short('h') => return Err(Answer::Asked(HELP.to_owned())),
                Arg::Short('V') => return Err(Answer::Asked(version())),
                Arg::Short(_) => return Err(arg.unexpected().into()),
            }
        }
        let has_scene = args.play || !args.scenes.is_empty() || !args.overrides.is_empty();
        let has_seed = args.seed.is_some() && args.room.is_none();
        let kinds = [has_scene || has_seed, args.replay.is_some(), args.room.is_some()];
        if kinds.into_iter().filter(|&is_asked| is_asked).count() > 1 {
            let kinds = "a scenario with --play, --set, --seed; --replay; --room with --seed";
            return Err(Answer::Mistake(format!("more than one thing to play; accepted is one of: {kinds}")));
        }
        Ok(args)
    }

    fn read(&mut self, option: &str, parser: &mut Parser) -> Result<(), Answer> {
        match option {
            "help" => return Err(Answer::Asked(HELP.to_owned())),
            "version" => return Err(Answer::Asked(version())),
            "play" => self.play = true,
            "timings" => self.timings = true,
            "room" => self.room = Some(parser.value()?.string()?),
            "server" => self.server = parser.value()?.string()?,
            "name" => self.name = parser.value()?.string()?,
            "replay" => self.replay = Some(parser.value()?.into()),
            "screenshot" => self.screenshot = Some(parser.value()?.into()),
            "script" => self.script = Some(parser.value()?.into()),
            "set" => self.overrides.push(checked(option, parser, "KEY=VALUE", pair)?),
            "seed" => self.seed = Some(checked(option, parser, "a whole number from 0 on", |word| word.parse().ok())?),
            "frames" => self.frames = Some(checked(option, parser, "a number from 1 to 1000000", frames)?),
            "size" => self.size = checked(option, parser, "a size from 160x90 to 7680x4320", size)?,
            "optics" => self.sight = Some(checked(option, parser, &sights(), sight)?),
            "quality" => self.effort = Some(checked(option, parser, &efforts(), Effort::named)?),
            "language" => self.language = Some(checked(option, parser, &languages(), Language::named)?),
            _ => return Err(Arg::Long(option).unexpected().into()),
        }
        Ok(())
    }

    /// Frames after which to exit.
    #[must_use]
    pub fn frames(&self) -> Option<u32> {
        self.frames.or(self.screenshot.as_ref().map(|_| SCREENSHOT_FRAMES))
    }
}

fn version() -> String {
    format!("microsim-game {}\n", env!("CARGO_PKG_VERSION"))
}

/// The value of an option; `wanted` is what it has to be.
fn checked<T>(
    option: &str,
    parser: &mut Parser,
    wanted: &str,
    read: impl FnOnce(&str) -> Option<T>,
) -> Result<T, Answer> {
    let word = parser.value()?.string()?;
    read(&word).ok_or_else(|| Answer::Mistake(format!("--{option} {word}: not {wanted}")))
}

fn pair(text: &str) -> Option<(String, String)> {
    let (key, value) = text.split_once('=')?;
    let key = key.trim();
    (!key.is_empty()).then(|| (key.to_owned(), value.trim().to_owned()))
}

fn frames(text: &str) -> Option<u32> {
    text.parse().ok().filter(|count| (1..=1_000_000).contains(count))
}

fn size(text: &str) -> Option<(u32, u32)> {
    let (width, height) = text.split_once('x')?;
    let (width, height) = (width.parse().ok()?, height.parse().ok()?);
    ((160..=7680).contains(&width) && (90..=4320).contains(&height)).then_some((width, height))
}

fn sight(name: &str) -> Option<Sight> {
    Sight::all().find(|sight| sight.name() == name)
}

fn sights() -> String {
    format!("one of {}", Sight::all().map(Sight::name).collect::<Vec<_>>().join(", "))
}

fn languages() -> String {
    format!("one of {}", LANGUAGES.iter().map(|language| language.code).collect::<Vec<_>>().join(", "))
}

fn efforts() -> String {
    format!("one of {}", Effort::ALL.map(Effort::name).join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Args, Answer> {
        Args::parse(["microsim-game"].into_iter().chain(line.split_whitespace()))
    }

    fn args(line: &str) -> Args {
        parsed(line).unwrap_or_else(|error| panic!("{line}: {error:?}"))
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
    fn mistakes_are_refused_with_what_is_accepted() {
        assert!(args("--replay a.replay").replay.is_some() && args("--room ab12 --seed 3").seed == Some(3));
        let numbers = ["--size 10x10", "--size big", "--frames 0", "--frames", "--seed -1", "--seed"];
        let words = ["--wrong", "-x", "--set x", "--set =1", "--optics x", "--language x", "--quality x", "--play=1"];
        let replays = ["--play", "demo", "--set a=1", "--seed 1", "--room ab12"]
            .map(|other| format!("--replay a.replay {other}"));
        let rooms = ["--room ab12 demo", "--room ab12 --set a=1"];
        for line in numbers.into_iter().chain(words).chain(rooms).chain(replays.iter().map(String::as_str)) {
            assert!(matches!(parsed(line), Err(Answer::Mistake(_))), "{line}");
        }
        let Err(Answer::Mistake(mistake)) = parsed("--optics x") else { panic!("accepted") };
        assert!(mistake.contains("--optics x: not one of phase-contrast,"), "{mistake}");
    }

    #[test]
    fn help_names_each_option_and_the_version_is_told() {
        let Err(Answer::Asked(help)) = parsed("--help") else { panic!("no help") };
        let options = [
            "play",
            "set",
            "seed",
            "room",
            "server",
            "name",
            "replay",
            "screenshot",
            "frames",
            "size",
            "script",
            "optics",
            "language",
            "quality",
            "timings",
        ];
        for option in options {
            assert!(help.contains(&format!(" --{option}")), "{option}");
            assert_ne!(parsed(&format!("--{option}")), Err(Arg::Long(option).unexpected().into()), "{option}");
        }
        assert!(help.lines().all(|line| line.chars().count() <= 120));
        assert_eq!(parsed("-h"), Err(Answer::Asked(help)));
        assert_eq!(parsed("-V"), Err(Answer::Asked(version())));
    }
}
