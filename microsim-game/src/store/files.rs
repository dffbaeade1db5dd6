//! Files that are never half written: the new text goes to a file of its own, which then takes the old one's name.

use directories::ProjectDirs;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{fs, process};

/// A folder with files.
#[derive(Clone, Debug)]
pub struct PlayerFolder(Option<PathBuf>);

impl PlayerFolder {
    /// The player's own folder; without one, nothing is kept.
    #[must_use]
    pub fn of_the_platform() -> Self {
        Self(ProjectDirs::from("", "", "microsim").map(|dirs| dirs.config_dir().to_owned()))
    }

    /// A folder of choice; it is made when something is first kept in it.
    #[must_use]
    pub fn at(folder: &Path) -> Self {
        Self(Some(folder.to_owned()))
    }

    /// Keeps nothing, for pictures that must come out the same everywhere.
    #[must_use]
    pub fn nowhere() -> Self {
        Self(None)
    }

    /// Reads a file. An unreadable one is renamed and reported, and the default is used.
    pub fn load<T: DeserializeOwned + Default>(&self, name: &str) -> (T, Option<String>) {
        let Some(path) = self.0.as_ref().map(|folder| folder.join(name)) else { return (T::default(), None) };
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return (T::default(), None),
            text => text.map_err(|error| error.to_string()),
        };
        let first_line = |error: toml::de::Error| error.message().lines().next().unwrap_or_default().to_owned();
        match text.and_then(|text| toml::from_str(&text).map_err(first_line)) {
            Ok(value) => (value, None),
            Err(problem) => {
                let kept = put_aside(&path).map_or(String::new(), |aside| format!("; kept as {}", aside.display()));
                (T::default(), Some(format!("{name} makes no sense: {problem}{kept}")))
            }
        }
    }

    /// What is in a file, if it can be read.
    #[must_use]
    pub fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.0.as_ref()?.join(name)).ok()
    }

    /// Writes a value for [`PlayerFolder::load`].
    ///
    /// # Errors
    /// See [`PlayerFolder::write`].
    pub fn save<T: Serialize>(&self, name: &str, value: &T) -> io::Result<()> {
        self.write(name, toml::to_string(value).map_err(io::Error::other)?.as_bytes())
    }

    /// Writes a file, wholly or not at all.
    ///
    /// # Errors
    /// When the folder or the file cannot be written; the old file is as it was then.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let Some(folder) = &self.0 else { return Ok(()) };
        fs::create_dir_all(folder)?;
        let fresh = folder.join(format!("{name}.{}.new", process::id()));
        let written = fs::File::create(&fresh).and_then(|mut file| {
            file.write_all(bytes)?;
            file.sync_all()
        });
        let result = written.and_then(|()| fs::rename(&fresh, folder.join(name)));
        if result.is_err() {
            let _ = fs::remove_file(&fresh);
        }
        result
    }
}

/// Gives a file a name that no file has yet, so that it is not overwritten.
fn put_aside(path: &Path) -> io::Result<PathBuf> {
    let numbered = (2..).map(|number| path.with_extension(format!("broken-{number}")));
    let mut names = [path.with_extension("broken")].into_iter().chain(numbered);
    let aside = names.find(|name| !name.exists()).ok_or(io::ErrorKind::AlreadyExists)?;
    fs::rename(path, &aside).map(|()| aside)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::collections::BTreeMap;

    type Table = BTreeMap<String, u32>;

    /// A folder of a test, which is removed after it.
    pub(crate) struct Folder(pub(crate) PathBuf);

    impl Folder {
        pub(crate) fn new(name: &str) -> (Self, PlayerFolder) {
            let path = std::env::temp_dir().join(format!("microsim-{name}-{}", process::id()));
            let store = PlayerFolder::at(&path);
            (Self(path), store)
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn what_is_kept_is_there_again_and_nothing_else() {
        let (folder, store) = Folder::new("store");
        assert_eq!(store.load::<Table>("a.toml"), (Table::new(), None));
        let table = Table::from([("x".to_owned(), 7)]);
        store.save("a.toml", &table).unwrap();
        store.save("a.toml", &table).unwrap();
        assert_eq!(store.load::<Table>("a.toml"), (table, None));
        let names: Vec<_> = fs::read_dir(&folder.0).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(names, ["a.toml"]);
    }

    #[test]
    fn a_broken_file_is_put_aside() {
        let (folder, store) = Folder::new("broken");
        fs::create_dir_all(&folder.0).unwrap();
        for (bytes, aside) in [(&b"x = ["[..], "a.broken"), (b"x = 1 # \xff", "a.broken-2")] {
            fs::write(folder.0.join("a.toml"), bytes).unwrap();
            let (table, problem) = store.load::<Table>("a.toml");
            assert!(table.is_empty() && problem.unwrap().ends_with(aside));
            assert_eq!(fs::read(folder.0.join(aside)).unwrap(), bytes);
        }
    }

    #[test]
    fn a_file_that_cannot_be_written_leaves_the_old_one() {
        let (folder, store) = Folder::new("blocked");
        fs::create_dir_all(folder.0.join("a.toml/in the way")).unwrap();
        assert!(store.save("a.toml", &Table::new()).is_err());
        assert_eq!(fs::read_dir(&folder.0).unwrap().count(), 1);
    }
}
