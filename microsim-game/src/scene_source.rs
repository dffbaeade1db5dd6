//! Where the scenario of a scene comes from.

use crate::rules::{food_chain, two_players};
use crate::words::{self, Key};
use crate::{platform, slides};
use microsim_core::scenario;
use std::path::PathBuf;
use std::{fmt, io};

/// Where the scenario of a scene comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneSource {
    /// A built-in scenario, a slide, or a game beside them.
    Builtin(String),
    /// A scenario file.
    File(PathBuf),
}

/// A file if the text ends in `.toml` or looks like a path, otherwise a built-in scenario.
impl From<&str> for SceneSource {
    fn from(text: &str) -> Self {
        if text.ends_with(".toml") || text.contains(['/', '\\']) {
            Self::File(text.into())
        } else {
            Self::Builtin(text.to_owned())
        }
    }
}

impl SceneSource {
    /// Text of the scenario.
    ///
    /// # Errors
    /// When there is no such built-in scenario, or the file cannot be read.
    pub fn text(&self) -> Result<String, String> {
        match self {
            Self::File(path) => {
                let text = platform::read(path).map(String::from_utf8);
                let text = text.and_then(|text| text.map_err(|_| io::ErrorKind::InvalidData.into()));
                text.map_err(|error| words::of_file(Key::FileUnreadable, path, &error))
            }
            Self::Builtin(name) => builtin_text(name).map(str::to_owned).ok_or_else(|| {
                let names: Vec<&str> = scenario::builtins().iter().map(|builtin| builtin.name).collect();
                format!("no built-in scenario {name:?}; there are: {}; a file ends in .toml", names.join(", "))
            }),
        }
    }
}

/// Text of a built-in scenario, of a slide, or of a game beside them.
fn builtin_text(name: &str) -> Option<&'static str> {
    let slide = || slides::find(name).map(|slide| slide.text);
    let games = [(food_chain::NAME, food_chain::TEXT), (two_players::NAME, two_players::TEXT)];
    let game = || games.into_iter().find(|(known, _)| *known == name).map(|(_, text)| text);
    scenario::builtin(name).map(|found| found.text).or_else(slide).or_else(game)
}

impl fmt::Display for SceneSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Builtin(name) => f.write_str(name),
            Self::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().fmt(f),
        }
    }
}
