//! The command line.

use std::path::PathBuf;

/// What the program says about itself.
pub const HELP: &str = "\
microsim-game: a window into microsim

USAGE: microsim-game [NAME | FILE.toml] [OPTIONS]

  NAME               a built-in scenario, `demo` if none is named
  FILE.toml          a scenario file

  --screenshot FILE  write a PNG of the last frame and exit; steps exactly once per frame
  --frames N         exit after N frames (with --screenshot: 120 unless told)
  --size WxH         size of the window, 160x90 to 7680x4320 (1280x720 unless told)
  --script FILE      take the player's actions from a file instead of mouse and keyboard
  -h, --help         this text
  -V, --version      the version

CONTROLS: hold the left mouse button: move there | A, D or wheel: zoom out, in | Space: pause | N: one step
          1-9: built-in scenario | F12: screenshot | Escape: quit

EXIT CODE: 0 fine, 1 no display or a file that cannot be written, 2 a bad argument or scenario";

/// Frames before a screenshot when none are asked for.
const SCREENSHOT_FRAMES: u32 = 120;

/// What the user asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// To read this and be done.
    Say(String),
    /// To see a scene.
    Play(Options),
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
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What to show.
    pub scene: Scene,
    /// Picture to write at the end.
    pub screenshot: Option<PathBuf>,
    /// Frames after which to exit.
    pub frames: Option<u32>,
    /// Width and height of the window.
    pub size: (u32, u32),
    /// Actions to play back.
    pub script: Option<PathBuf>,
}

/// Reads the arguments.
///
/// # Errors
/// Says which argument is wrong and what would be right.
pub fn parse(arguments: impl IntoIterator<Item = String>) -> Result<Command, String> {
    let mut options = Options {
        scene: Scene::Builtin("demo".to_owned()),
        screenshot: None,
        frames: None,
        size: (1280, 720),
        script: None,
    };
    let (mut arguments, mut scenes) = (arguments.into_iter(), 0);
    while let Some(argument) = arguments.next() {
        let mut value = |what: &str| arguments.next().ok_or(format!("{argument} needs {what}"));
        match argument.as_str() {
            "-h" | "--help" => return Ok(Command::Say(HELP.to_owned())),
            "-V" | "--version" => return Ok(Command::Say(format!("microsim-game {}", env!("CARGO_PKG_VERSION")))),
            "--screenshot" => options.screenshot = Some(value("a file")?.into()),
            "--frames" => options.frames = Some(count(&value("a number")?)?),
            "--size" => options.size = size(&value("a size such as 640x360")?)?,
            "--script" => options.script = Some(value("a file")?.into()),
            other if other.starts_with('-') => return Err(format!("unknown option {other}; --help lists all")),
            other => {
                options.scene = scene(other);
                scenes += 1;
            }
        }
    }
    if scenes > 1 {
        return Err("more than one scenario named".to_owned());
    }
    if options.screenshot.is_some() {
        options.frames.get_or_insert(SCREENSHOT_FRAMES);
    }
    Ok(Command::Play(options))
}

fn scene(text: &str) -> Scene {
    if text.ends_with(".toml") || text.contains(['/', '\\']) {
        Scene::File(text.into())
    } else {
        Scene::Builtin(text.to_owned())
    }
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
            Ok(Command::Play(options)) => options,
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn nothing_named_is_the_demo() {
        let options = options("");
        assert_eq!(options.scene, Scene::Builtin("demo".to_owned()));
        assert_eq!((options.size, options.frames), ((1280, 720), None));
    }

    #[test]
    fn names_files_and_options_are_told_apart() {
        assert_eq!(options("dam-break").scene, Scene::Builtin("dam-break".to_owned()));
        assert_eq!(options("./a.toml").scene, Scene::File("./a.toml".into()));
        let shot = options("demo --screenshot a.png --size 640x360");
        assert_eq!((shot.frames, shot.size), (Some(SCREENSHOT_FRAMES), (640, 360)));
        assert_eq!(options("--screenshot a.png --frames 7").frames, Some(7));
    }

    #[test]
    fn mistakes_are_named() {
        for line in ["--size 10x10", "--size big", "--frames 0", "--frames", "--wrong", "demo platelets"] {
            assert!(parsed(line).is_err(), "{line}");
        }
        assert!(matches!(parsed("--help"), Ok(Command::Say(text)) if text == HELP));
    }
}
