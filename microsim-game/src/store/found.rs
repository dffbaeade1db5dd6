//! The entries of the field guide that the player has found.

use super::files::PlayerFolder;
use crate::guide;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::io;

/// File that they are kept in.
const FILE: &str = "guide.toml";

/// Names of entries.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FoundEntries {
    found: BTreeSet<String>,
}

impl FoundEntries {
    /// Reads them, with a word on what is wrong with the file. Names that the guide does not have are left out.
    #[must_use]
    pub fn load(store: &PlayerFolder) -> (Self, Option<String>) {
        let (Self { mut found }, problem) = store.load(FILE);
        found.retain(|name| guide::find(name).is_some());
        (Self { found }, problem)
    }

    /// Notes an entry, and keeps all in the store with what another window has kept since.
    ///
    /// # Errors
    /// When the file cannot be written; the entry counts all the same until the program ends.
    pub fn add(&mut self, name: &str, store: &PlayerFolder) -> io::Result<()> {
        if !self.found.insert(name.to_owned()) {
            return Ok(());
        }
        self.found.extend(Self::load(store).0.found);
        store.save(FILE, self)
    }

    /// Whether an entry was found.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.found.contains(name)
    }

    /// How many were found.
    #[must_use]
    pub fn count(&self) -> usize {
        self.found.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::files::tests::Folder;

    #[test]
    fn what_was_found_is_kept_over_a_restart_and_strange_names_are_left_out() {
        let (_folder, store) = Folder::new("guide");
        let mut found = FoundEntries::load(&store).0;
        found.add("agar", &store).unwrap();
        let mut other = FoundEntries::default();
        other.add("coccus", &store).unwrap();
        assert!(other.has("agar"), "another window's are kept");
        store.write(FILE, b"found = [\"agar\", \"unicorn\"]").unwrap();
        let (found, problem) = FoundEntries::load(&store);
        assert_eq!((found.count(), found.has("agar"), problem), (1, true, None));
    }
}
