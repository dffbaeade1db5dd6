//! Files that are never half written: the new text goes to a file of its own, which then takes the old one's name.

use directories::ProjectDirs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{fs, process};

/// Where values are kept by name: a folder.
#[derive(Clone, Debug)]
pub struct Storage(PathBuf);

impl Storage {
    /// The player's own, if the platform has a place for it.
    #[must_use]
    pub fn of_the_player() -> Option<Self> {
        ProjectDirs::from("", "", "microsim").map(|dirs| Self(dirs.config_dir().to_owned()))
    }

    /// A folder of choice; it is made when something is first kept in it.
    #[must_use]
    pub fn at(folder: &Path) -> Self {
        Self(folder.to_owned())
    }

    /// Where the player finds a value.
    #[must_use]
    pub fn place(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    /// Whether there is a value of this name.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.0.join(name).exists()
    }

    /// A value.
    ///
    /// # Errors
    /// When it cannot be read; `NotFound` if there is none.
    pub fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        fs::read(self.0.join(name))
    }

    /// Keeps a value, wholly or not at all.
    ///
    /// # Errors
    /// When the folder or the file cannot be written; the old file is as it was then.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        fs::create_dir_all(&self.0)?;
        let fresh = self.0.join(format!("{name}.{}.new", process::id()));
        let written = fs::File::create(&fresh).and_then(|mut file| {
            file.write_all(bytes)?;
            file.sync_all()
        });
        let result = written.and_then(|()| fs::rename(&fresh, self.0.join(name)));
        if result.is_err() {
            let _ = fs::remove_file(&fresh);
        }
        result
    }

    /// Gives a value another name.
    ///
    /// # Errors
    /// When the file cannot be renamed.
    pub fn rename(&self, name: &str, other: &str) -> io::Result<()> {
        fs::rename(self.0.join(name), self.0.join(other))
    }
}
