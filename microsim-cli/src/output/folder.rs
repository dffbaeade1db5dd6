//! The folder that a run writes to. A file appears under its name only when it is complete.

use crate::failure::Failure;
use sha2::{Digest, Sha256};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Seek, SeekFrom, Write};
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
    /// Names of the files that were finished.
    names: Mutex<Vec<String>>,
}

impl Outputs {
    /// Creates the folder if it is missing. Nothing in it is ever removed; unless `is_forced`, it must be empty.
    pub(crate) fn open(folder: &Path, is_forced: bool) -> Result<Self, Failure> {
        let refuse = |why: &str| Err(Failure::Message(format!("--out {}: {why}", folder.display())));
        let fail = |error| Failure::file("write to", folder, &error);
        if folder.exists() && !folder.is_dir() {
            return refuse("it is not a directory, accepted: an empty or new one");
        }
        if folder.is_dir() && !is_forced && fs::read_dir(folder).map_err(fail)?.next().is_some() {
            return refuse("it is not empty, accepted: an empty or new one, or any with --force");
        }
        let is_new = !folder.exists();
        fs::create_dir_all(folder).map_err(fail)?;
        Ok(Self { folder: folder.to_owned(), is_new, is_shared: false, names: Mutex::default() })
    }

    /// A folder that others may write to at the same time.
    pub(crate) fn shared(folder: &Path) -> Result<Self, Failure> {
        let mut outputs = Self::open(folder, true)?;
        outputs.is_shared = true;
        Ok(outputs)
    }

    /// The folder that a file is to lie in, and the file's name there.
    pub(crate) fn beside(path: &Path) -> Result<(Self, String), Failure> {
        let name = path.file_name().and_then(|name| name.to_str());
        let Some(name) = name.filter(|_| !path.is_dir()) else {
            return Err(Failure::Message(format!("{} is not the name of a file", path.display())));
        };
        // A device or a pipe would be replaced by a file.
        if path.symlink_metadata().is_ok_and(|found| !found.is_file() && !found.is_symlink()) {
            return Err(Failure::Message(format!("{} is not a regular file", path.display())));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Ok((Self::shared(folder)?, name.to_owned()))
    }

    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    pub(crate) fn file(&self, name: &str) -> Result<PendingFile, Failure> {
        let (path, temporary) = self.names_of(name);
        let fail = |error| Failure::file("write", &path, &error);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(fail)?;
        }
        let file = File::create(&temporary).map_err(fail)?;
        Ok(PendingFile { writer: Some(BufWriter::new(file)), temporary, path, name: name.to_owned() })
    }

    /// Continues a file after its first `length` bytes, whether it was finished or not.
    pub(crate) fn resume(&self, name: &str, length: u64) -> Result<PendingFile, Failure> {
        let (path, temporary) = self.names_of(name);
        let fail = |error: io::Error| Failure::file("continue", &path, &error);
        if !temporary.exists() && path.exists() {
            fs::rename(&path, &temporary).map_err(fail)?;
        }
        let mut file = OpenOptions::new().write(true).open(&temporary).map_err(fail)?;
        if file.metadata().map_err(fail)?.len() < length {
            let message =
                format!("{} is shorter than its checkpoint says; run the scenario again", temporary.display());
            return Err(Failure::Message(message));
        }
        file.set_len(length).and_then(|()| file.seek(SeekFrom::End(0))).map_err(fail)?;
        Ok(PendingFile { writer: Some(BufWriter::new(file)), temporary, path, name: name.to_owned() })
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
        if self.is_new {
            // Fails unless it is empty.
            let _ = fs::remove_dir(&self.folder);
        }
    }
}

/// SHA-256 of a file, as `sha256sum` prints it.
pub(crate) fn sha256(path: &Path) -> Result<String, Failure> {
    let fail = |error| Failure::file("read", path, &error);
    let mut hasher = Sha256::new();
    let mut reader = BufReader::new(File::open(path).map_err(fail)?);
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

/// A file under a temporary name, removed again unless it is finished.
#[derive(Debug)]
pub(crate) struct PendingFile {
    /// Gone once the file is closed.
    writer: Option<BufWriter<File>>,
    /// Where it lies until it is finished.
    pub temporary: PathBuf,
    /// The path that it will have.
    pub path: PathBuf,
    /// The name within its folder.
    pub name: String,
}

impl PendingFile {
    /// Everything that was written is in the file. Returns its length.
    pub(crate) fn sync(&mut self) -> Result<u64, Failure> {
        let length = self.flush().and_then(|()| fs::metadata(&self.temporary));
        length.map(|data| data.len()).map_err(|error| Failure::file("write", &self.path, &error))
    }

    /// Gives it its name, in place of any file that has it.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        let flushed = self.flush();
        self.writer = None;
        flushed
            .and_then(|()| fs::rename(&self.temporary, &self.path))
            .map_err(|error| Failure::file("write", &self.path, &error))
    }

    /// Leaves it under its temporary name, to be continued.
    pub(crate) fn leave(mut self) -> Result<(), Failure> {
        self.sync()?;
        self.writer = None;
        self.temporary.clear();
        Ok(())
    }
}

impl Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.as_mut().map_or(Ok(0), |writer| writer.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.as_mut().map_or(Ok(()), BufWriter::flush)
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        self.writer = None;
        if !self.temporary.as_os_str().is_empty() {
            // After a rename there is nothing under this name any more.
            let _ = fs::remove_file(&self.temporary);
        }
    }
}
