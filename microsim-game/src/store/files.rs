//! What is kept by name, as text that people can read. Damaged values are put aside, never overwritten.

use super::toml_value::from_toml;
use crate::platform::Storage;
use crate::words::{self, Key};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io;

/// The player's settings, scores and last game.
#[derive(Clone, Debug)]
pub struct PlayerFolder(Option<Storage>);

impl PlayerFolder {
    /// The player's own; where the platform has no place for it, nothing is kept.
    #[must_use]
    pub fn of_the_platform() -> Self {
        Self(Storage::of_the_player())
    }

    /// A place of choice.
    #[must_use]
    pub fn at(storage: Storage) -> Self {
        Self(Some(storage))
    }

    /// Keeps nothing, for pictures that must come out the same everywhere.
    #[must_use]
    pub fn nowhere() -> Self {
        Self(None)
    }

    /// Reads a value. An unreadable one is renamed and reported, and the default is used.
    pub fn load<T: DeserializeOwned + Default>(&self, name: &str) -> (T, Option<String>) {
        let Some(storage) = &self.0 else { return (T::default(), None) };
        let bytes = match storage.read(name) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return (T::default(), None),
            bytes => bytes.ok(),
        };
        match bytes.and_then(|bytes| parse(&bytes)) {
            Some(value) => (value, None),
            None => {
                let told = words::text_with(Key::FileSenseless, &[("file", name.into())]);
                let with = |aside: String| {
                    words::text_with(Key::FilePutAside, &[("told", (&told).into()), ("aside", (&aside).into())])
                };
                (T::default(), Some(put_aside(storage, name).map_or_else(|_| told.clone(), with)))
            }
        }
    }

    /// What is kept under a name, if it can be read.
    #[must_use]
    pub fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.0.as_ref()?.read(name).ok()
    }

    /// Keeps a value for [`PlayerFolder::load`].
    ///
    /// # Errors
    /// See [`PlayerFolder::write`].
    pub fn save<T: Serialize>(&self, name: &str, value: &T) -> io::Result<()> {
        self.write(name, toml::to_string(value).map_err(io::Error::other)?.as_bytes())
    }

    /// Keeps bytes, wholly or not at all.
    ///
    /// # Errors
    /// When they cannot be kept; what was kept before is as it was then.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        self.0.as_ref().map_or(Ok(()), |storage| storage.write(name, bytes))
    }
}

fn parse<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    from_toml(std::str::from_utf8(bytes).ok()?)
}

/// Gives a value a name that none has yet, so that it is not overwritten. Returns where it is then.
fn put_aside(storage: &Storage, name: &str) -> io::Result<String> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let numbered = (2..).map(|number| format!("{stem}.broken-{number}"));
    let mut names = [format!("{stem}.broken")].into_iter().chain(numbered);
    let aside = names.find(|name| !storage.has(name)).ok_or(io::ErrorKind::AlreadyExists)?;
    storage.rename(name, &aside).map(|()| storage.place(&aside))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::collections::BTreeMap;
    use std::path::PathBuf;
    use std::{fs, process};

    type Table = BTreeMap<String, u32>;

    /// A folder of a test, which is removed after it.
    pub(crate) struct Folder(pub(crate) PathBuf);

    impl Folder {
        pub(crate) fn new(name: &str) -> (Self, PlayerFolder) {
            let path = std::env::temp_dir().join(format!("microsim-{name}-{}", process::id()));
            let store = PlayerFolder::at(Storage::at(&path));
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
