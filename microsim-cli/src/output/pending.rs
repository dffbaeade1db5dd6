//! A file under a temporary name until it is complete.

use super::files::{self, Written};
use crate::failure::Failure;
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;

/// A file under a temporary name, removed again unless it is finished or a checkpoint needs it.
#[derive(Debug)]
pub(crate) struct PendingFile {
    writer: BufWriter<Written>,
    /// Where it lies until it is finished.
    pub temporary: PathBuf,
    /// The path that it will have.
    pub path: PathBuf,
    /// The name within its folder.
    pub name: String,
    /// Whether it stays when it is not finished.
    is_kept: bool,
    /// Whether it must be on the disk before it has its name.
    is_durable: bool,
}

impl PendingFile {
    pub(super) fn create(name: &str, paths: (PathBuf, PathBuf), is_durable: bool) -> Result<Self, Failure> {
        let (path, temporary) = paths;
        let file = Written::create(&temporary).map_err(|error| Failure::file("write", &path, &error))?;
        let writer = BufWriter::new(file);
        Ok(Self { writer, temporary, path, name: name.to_owned(), is_kept: false, is_durable })
    }

    /// Continues a file after its first `length` bytes.
    pub(super) fn resume(name: &str, paths: (PathBuf, PathBuf), length: u64) -> Result<Self, Failure> {
        let (path, temporary) = paths;
        let open = || {
            if !temporary.exists() {
                files::rename(&path, &temporary)?;
            }
            let file = Written::append(&temporary)?;
            file.truncate(length)?;
            Ok(BufWriter::new(file))
        };
        let writer = open().map_err(|error| Failure::file("continue", &path, &error))?;
        Ok(Self { writer, temporary, path, name: name.to_owned(), is_kept: true, is_durable: true })
    }

    /// Everything that was written is on the disk, and stays there for a checkpoint. Returns the length.
    pub(crate) fn keep(&mut self) -> Result<u64, Failure> {
        self.is_kept = true;
        let file = self.writer.flush().map(|()| self.writer.get_ref());
        let length = file.and_then(|file| file.sync().and_then(|()| file.length()));
        length.map_err(|error| Failure::file("write", &self.path, &error))
    }

    /// Gives it its name, in place of any file that has it.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        let written =
            self.writer.flush().and_then(|()| if self.is_durable { self.writer.get_ref().sync() } else { Ok(()) });
        written
            .and_then(|()| files::rename(&self.temporary, &self.path))
            .map_err(|error| Failure::file("write", &self.path, &error))?;
        self.is_kept = true;
        Ok(())
    }
}

impl Write for PendingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        if !self.is_kept {
            let _ = files::remove(&self.temporary);
        }
    }
}
