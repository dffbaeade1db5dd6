//! The entries of the field guide that the player has found.

use super::files::PlayerFolder;
use crate::guide::{self, Entry};
use std::collections::BTreeSet;
use std::io;

/// File that they are kept in: a name a line.
const FILE: &str = "guide.txt";

/// Names of entries.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FoundEntries(BTreeSet<&'static str>);

impl FoundEntries {
    /// Reads them. Lines that the guide does not know are left out.
    #[must_use]
    pub fn load(store: &PlayerFolder) -> Self {
        let text = store.read(FILE).map_or(String::new(), |bytes| String::from_utf8_lossy(&bytes).into_owned());
        Self(text.lines().filter_map(guide::find).map(|entry| entry.name).collect())
    }

    /// Notes an entry, and keeps all in the store with what another window has kept since.
    ///
    /// # Errors
    /// When the file cannot be written; the entry counts all the same until the program ends.
    pub fn add(&mut self, entry: &Entry, store: &PlayerFolder) -> io::Result<()> {
        if !self.0.insert(entry.name) {
            return Ok(());
        }
        self.0.extend(Self::load(store).0);
        let lines: String = self.0.iter().flat_map(|name| [name, "\n"]).collect();
        store.write(FILE, lines.as_bytes())
    }

    /// Whether an entry was found.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.0.contains(name)
    }

    /// How many were found.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::files::tests::Folder;

    #[test]
    fn what_was_found_is_kept_over_a_restart_and_strange_names_are_left_out() {
        let (_folder, store) = Folder::new("guide");
        let mut found = FoundEntries::load(&store);
        found.add(guide::find("agar").unwrap(), &store).unwrap();
        let mut other = FoundEntries::default();
        other.add(guide::find("coccus").unwrap(), &store).unwrap();
        assert!(other.has("agar"), "another window's are kept");
        store.write(FILE, b"agar\nunicorn\n\n").unwrap();
        let found = FoundEntries::load(&store);
        assert_eq!((found.count(), found.has("agar")), (1, true));
        store.write(FILE, b"agar\n\xff\ncoccus\n").unwrap();
        assert_eq!(FoundEntries::load(&store).count(), 2, "a damaged line is one entry less");
    }
}
