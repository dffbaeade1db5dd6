//! The folder that a run writes to. A file appears under its name only when it is complete.

use crate::failure::Failure;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A folder that was found fit to write to.
#[derive(Debug)]
pub(crate) struct Outputs {
    folder: PathBuf,
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
        fs::create_dir_all(folder).map_err(fail)?;
        Ok(Self { folder: folder.to_owned() })
    }

    /// The folder that a file is to lie in, and the file's name there.
    pub(crate) fn beside(path: &Path) -> Result<(Self, String), Failure> {
        let name = path.file_name().and_then(|name| name.to_str());
        let Some(name) = name.filter(|_| !path.is_dir()) else {
            return Err(Failure::Message(format!("{} is not the name of a file", path.display())));
        };
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Ok((Self::open(folder, true)?, name.to_owned()))
    }

    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Starts a file.
    pub(crate) fn file(&self, name: &str) -> Result<PendingFile, Failure> {
        let path = self.folder.join(name);
        let temporary = self.folder.join(format!(".{name}.{}.partial", std::process::id()));
        let file = File::create_new(&temporary).map_err(|error| Failure::file("write", &path, &error))?;
        Ok(PendingFile { writer: Some(BufWriter::new(file)), temporary, path })
    }

    /// Writes a whole file.
    pub(crate) fn write(&self, name: &str, content: &[u8]) -> Result<(), Failure> {
        let mut file = self.file(name)?;
        file.write_all(content).map_err(|error| Failure::file("write", &file.path, &error))?;
        file.finish()
    }
}

/// A file under a temporary name, removed again unless it is finished.
#[derive(Debug)]
pub(crate) struct PendingFile {
    /// Gone once the file is closed.
    writer: Option<BufWriter<File>>,
    temporary: PathBuf,
    path: PathBuf,
}

impl PendingFile {
    /// The name that it will have.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Where it lies until it is finished.
    pub(crate) fn temporary(&self) -> &Path {
        &self.temporary
    }

    /// Gives it its name, in place of any file that has it.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        let flushed = self.flush();
        self.writer = None;
        flushed
            .and_then(|()| fs::rename(&self.temporary, &self.path))
            .map_err(|error| Failure::file("write", &self.path, &error))
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
        // After a rename there is nothing under this name any more.
        let _ = fs::remove_file(&self.temporary);
    }
}
