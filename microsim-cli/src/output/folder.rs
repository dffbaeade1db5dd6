//! The folder that a run writes to. A file appears under its name only when it is complete.

use super::files::{self, Written};
use super::pending::PendingFile;
use crate::failure::Failure;
use crate::read;
use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A folder that can be written to.
#[derive(Debug)]
pub(crate) struct Outputs {
    folder: PathBuf,
    /// Whether it was made for this.
    is_new: bool,
    /// Whether others may write to it at the same time.
    is_shared: bool,
    /// Whether a file must be on the disk before it has its name.
    is_durable: bool,
    /// Names of the files that were finished.
    names: Mutex<Vec<String>>,
    /// Held while no other process may write to it.
    lock: Option<Written>,
}

/// The file that is locked while a process writes to its folder.
const LOCK: &str = ".lock";

impl Outputs {
    /// Creates the folder if it is missing, and locks it. Nothing in it is ever removed; unless `is_forced`, it must be
    /// empty.
    pub(crate) fn open(folder: &Path, is_forced: bool) -> Result<Self, Failure> {
        let mut outputs = Self::unlocked(folder, is_forced)?;
        let path = folder.join(LOCK);
        let lock = Written::lockable(&path).map_err(|error| Failure::file("write", &path, &error))?;
        if !lock.try_lock(&path) {
            let why = "another run writes to it, accepted: the folder when that has ended, or another one";
            return Err(Failure::Message(format!("{}: {why}", folder.display())));
        }
        outputs.lock = Some(lock);
        Ok(outputs)
    }

    /// Locks the folder of a stopped run, which may be a stranger's: it is refused unless all files in it are its own.
    pub(crate) fn reopen(folder: &Path) -> Result<Self, Failure> {
        read::check_own(folder).map_err(|error| Failure::file("continue", folder, &error))?;
        Self::open(folder, true)
    }

    fn unlocked(folder: &Path, is_forced: bool) -> Result<Self, Failure> {
        let refuse = |why: &str| Err(Failure::Message(format!("--out {}: {why}", folder.display())));
        let fail = |error| Failure::file("write to", folder, &error);
        if folder.exists() && !folder.is_dir() {
            return refuse("it is not a directory, accepted: an empty or new one");
        }
        if folder.is_dir() && !is_forced && fs::read_dir(folder).map_err(fail)?.next().is_some() {
            return refuse("it is not empty, accepted: an empty or new one, or any with --force");
        }
        let is_new = !folder.exists();
        files::create_folder(folder).map_err(fail)?;
        Ok(Self {
            folder: folder.to_owned(),
            is_new,
            is_shared: false,
            is_durable: true,
            names: Mutex::default(),
            lock: None,
        })
    }

    /// A folder that others may write to at the same time. A power cut may leave torn files in it.
    pub(crate) fn shared(folder: &Path) -> Result<Self, Failure> {
        let mut outputs = Self::unlocked(folder, true)?;
        (outputs.is_shared, outputs.is_durable) = (true, false);
        Ok(outputs)
    }

    /// The folder that a file is to lie in, and the file's name there.
    pub(crate) fn beside(path: &Path) -> Result<(Self, String), Failure> {
        let name = path.file_name().and_then(|name| name.to_str());
        let Some(name) = name.filter(|_| !path.is_dir()) else {
            return Err(Failure::Message(format!("{} is not the name of a file", path.display())));
        };
        // A device, a pipe or a link would be replaced by a file.
        if path.symlink_metadata().is_ok_and(|found| !found.is_file()) {
            return Err(Failure::Message(format!("{} is not a regular file", path.display())));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut outputs = Self::shared(folder)?;
        outputs.is_durable = true;
        Ok((outputs, name.to_owned()))
    }

    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Begins a file.
    pub(crate) fn file(&self, name: &str) -> Result<PendingFile, Failure> {
        let paths = self.names_of(name);
        if let Some(parent) = paths.0.parent() {
            files::create_folder(parent).map_err(|error| Failure::file("write", &paths.0, &error))?;
        }
        PendingFile::create(name, paths, self.is_durable)
    }

    /// Continues a file after its first `length` bytes, whether it was finished or not.
    pub(crate) fn resume(&self, name: &str, length: u64) -> Result<PendingFile, Failure> {
        PendingFile::resume(name, self.names_of(name), length)
    }

    /// Refuses a file that cannot be continued after its first `length` bytes, which must end with a row. Changes nothing.
    pub(crate) fn check_resumable(&self, name: &str, length: u64) -> Result<(), Failure> {
        let (path, temporary) = self.names_of(name);
        let path = if temporary.exists() { temporary } else { path };
        let fail = |error| Failure::file("continue", &path, &error);
        let mut file = read::open(&path).map_err(fail)?;
        let refuse = |why| Failure::Message(format!("{} {why}; run the scenario again", path.display()));
        if file.metadata().map_err(fail)?.len() < length {
            return Err(refuse("is shorter than its checkpoint says"));
        }
        let mut last = *b"\n";
        if length > 0 {
            file.seek(SeekFrom::Start(length - 1)).and_then(|_| file.read_exact(&mut last)).map_err(fail)?;
        }
        if last == *b"\n" { Ok(()) } else { Err(refuse("has no end of a row where its checkpoint says")) }
    }

    /// Waits until the names of all files are on the disk, in the folder and in those in it.
    pub(crate) fn sync(&self) -> Result<(), Failure> {
        let paths: Vec<PathBuf> = self.names().iter().map(|name| self.folder.join(name)).collect();
        let mut folders: BTreeSet<&Path> = paths.iter().filter_map(|path| path.parent()).collect();
        folders.insert(&self.folder);
        let sync = |folder| files::sync_folder(folder).map_err(|error| Failure::file("write to", folder, &error));
        folders.into_iter().try_for_each(sync)
    }

    fn names(&self) -> MutexGuard<'_, Vec<String>> {
        self.names.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Where a file will lie, and where it lies until then.
    fn names_of(&self, name: &str) -> (PathBuf, PathBuf) {
        let path = self.folder.join(name);
        let last = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let owner = if self.is_shared { format!(".{}", std::process::id()) } else { String::new() };
        (path.clone(), path.with_file_name(format!(".{last}{owner}.partial")))
    }

    /// Writes a whole file.
    pub(crate) fn write(&self, name: &str, content: &[u8]) -> Result<(), Failure> {
        self.names().push(name.to_owned());
        self.replace(name, content)
    }

    /// Writes a whole file that is no result, in place of any that has its name.
    pub(crate) fn replace(&self, name: &str, content: &[u8]) -> Result<(), Failure> {
        let mut file = self.file(name)?;
        file.write_all(content).map_err(|error| Failure::file("write", &file.path, &error))?;
        file.finish()
    }

    /// Gives a file its name, in place of any file that has it.
    pub(crate) fn finish(&self, file: PendingFile) -> Result<(), Failure> {
        self.names().push(file.name.clone());
        file.finish()
    }

    /// Names of the files that were finished.
    pub(crate) fn names_written(&self) -> Vec<String> {
        self.names().clone()
    }

    /// Files that another process has finished.
    pub(crate) fn note_written(&self, names: &[String]) {
        self.names().extend_from_slice(names);
    }

    /// The files that were finished, in the order of their names, with the `digest` of each.
    pub(crate) fn written<T>(&self, digest: impl Fn(&Path) -> Result<T, Failure>) -> Result<Vec<(String, T)>, Failure> {
        let mut names = self.names().clone();
        names.sort();
        names.dedup();
        names.into_iter().map(|name| digest(&self.folder.join(&name)).map(|digest| (name, digest))).collect()
    }
}

impl Drop for Outputs {
    fn drop(&mut self) {
        if self.lock.is_some() {
            let _ = files::remove(&self.folder.join(LOCK));
        }
        if self.is_new {
            // Fails unless it is empty.
            let _ = files::remove_folder(&self.folder);
        }
    }
}

/// SHA-256 of a file, as `sha256sum` prints it.
pub(crate) fn sha256(path: &Path) -> Result<String, Failure> {
    let fail = |error| Failure::file("read", path, &error);
    let mut hasher = hmac_sha256::Hash::new();
    let mut reader = BufReader::new(read::open(path).map_err(fail)?);
    loop {
        let bytes = reader.fill_buf().map_err(fail)?;
        let count = bytes.len();
        if count == 0 {
            break;
        }
        hasher.update(bytes);
        reader.consume(count);
    }
    Ok(hex(&hasher.finalize()))
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_goes_again_only_if_it_was_made_and_stayed_empty() {
        let folder = std::env::temp_dir().join(format!("microsim-empty-{}", std::process::id()));
        drop(Outputs::open(&folder, false).unwrap());
        assert!(!folder.exists(), "it was made for nothing");
        fs::create_dir(&folder).unwrap();
        drop(Outputs::open(&folder, false).unwrap());
        assert!(folder.exists(), "it was there before");
        fs::remove_dir(&folder).unwrap();
    }
}
