//! What the browser keeps for this page.

use super::host;
use std::io;

/// Where values are kept by name: the page's `localStorage`.
#[derive(Clone, Debug)]
pub struct Storage;

impl Storage {
    /// The player's own, if the browser lets the page keep something.
    #[must_use]
    pub fn of_the_player() -> Option<Self> {
        host::ask("has storage", "").map(|_| Self)
    }

    /// Where the player finds a value.
    #[must_use]
    pub fn place(&self, name: &str) -> String {
        name.to_owned()
    }

    /// Whether there is a value of this name.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.read(name).is_ok()
    }

    /// A value.
    ///
    /// # Errors
    /// `NotFound` if there is none.
    pub fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        host::ask("kept", name).ok_or(io::ErrorKind::NotFound.into())
    }

    /// Keeps a value, wholly or not at all.
    ///
    /// # Errors
    /// When there is no room for it; the old value is as it was then.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        host::tell("keep", name, bytes).then_some(()).ok_or(io::ErrorKind::StorageFull.into())
    }

    /// Gives a value another name.
    ///
    /// # Errors
    /// When there is no such value.
    pub fn rename(&self, name: &str, other: &str) -> io::Result<()> {
        host::tell("rename", name, other.as_bytes()).then_some(()).ok_or(io::ErrorKind::NotFound.into())
    }
}
