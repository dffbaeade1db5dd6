//! The calls that change files. All of them are here, so that tests can make any one of them fail.

use crate::read;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// A file that is open for writing.
#[derive(Debug)]
pub(crate) struct Written {
    file: File,
    /// What a power cut would leave of it.
    #[cfg(test)]
    survivor: super::fault::Survivor,
}

impl Written {
    fn new(file: File) -> Self {
        Self {
            #[cfg(test)]
            survivor: super::fault::opened(&file),
            file,
        }
    }

    /// A new, empty file, in place of any that has its name. A link of that name is replaced, not followed.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        #[cfg(test)]
        super::fault::renames(&[path]);
        let made = attempt(|| match File::create_new(path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                fs::remove_file(path).and_then(|()| File::create_new(path))
            }
            made => made,
        });
        made.map(Self::new)
    }

    /// An existing file, to be written to at its end.
    pub(crate) fn append(path: &Path) -> io::Result<Self> {
        attempt(|| OpenOptions::new().append(true).open(path)).map(Self::new)
    }

    /// A file that is there to be locked; its content stays. A link is not followed, and a pipe not waited for.
    pub(crate) fn lockable(path: &Path) -> io::Result<Self> {
        if fs::symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
            return Err(read::irregular());
        }
        attempt(|| OpenOptions::new().create(true).append(true).open(path)).map(|file| Self {
            // It holds nothing, and must not stay open.
            #[cfg(test)]
            survivor: super::fault::Survivor::default(),
            file,
        })
    }

    pub(crate) fn truncate(&self, length: u64) -> io::Result<()> {
        attempt(|| self.file.set_len(length))
    }

    /// Waits until the content is on the disk.
    pub(crate) fn sync(&self) -> io::Result<()> {
        attempt(|| self.file.sync_all())?;
        #[cfg(test)]
        self.survivor.grow(self.length()?);
        Ok(())
    }

    pub(crate) fn length(&self) -> io::Result<u64> {
        self.file.metadata().map(|data| data.len())
    }

    /// Takes the file at this path for this process alone, until it is closed; `false` where another has it. The system
    /// gives up the lock of a process that dies. Where the file system has no locks, the file counts as free.
    pub(crate) fn try_lock(&self, path: &Path) -> bool {
        !matches!(self.file.try_lock(), Err(fs::TryLockError::WouldBlock)) && self.is_at(path)
    }

    /// Whether it still has this path: the process that held the lock before removes it.
    fn is_at(&self, path: &Path) -> bool {
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            let place = |data: fs::Metadata| (data.dev(), data.ino());
            self.file.metadata().map(place).ok() == fs::metadata(path).map(place).ok()
        }
        #[cfg(not(unix))]
        path.exists()
    }
}

impl Write for Written {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        #[cfg(test)]
        if let Err(error) = super::fault::next_call() {
            // A full disk and the moment of a crash may leave the first part.
            if matches!(error.kind(), ErrorKind::StorageFull | ErrorKind::Other) {
                let _ = self.file.write(&bytes[..bytes.len() / 2]);
            }
            return Err(error);
        }
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Creates a folder where it is missing, and those above it. Their names are on the disk then.
pub(crate) fn create_folder(path: &Path) -> io::Result<()> {
    let missing: Vec<&Path> = path.ancestors().take_while(|folder| !folder.exists()).collect();
    #[cfg(test)]
    super::fault::renames(&missing);
    attempt(|| fs::create_dir_all(path))?;
    missing.iter().filter_map(|folder| folder.parent()).try_for_each(sync_folder)
}

/// Gives a file another name, in place of any file that has it.
pub(crate) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    #[cfg(test)]
    super::fault::renames(&[from, to]);
    attempt(|| fs::rename(from, to))
}

/// Waits until the names in a folder are on the disk. Only Unix opens folders.
pub(crate) fn sync_folder(path: &Path) -> io::Result<()> {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    attempt(|| if cfg!(unix) { File::open(path)?.sync_all() } else { Ok(()) })?;
    #[cfg(test)]
    super::fault::synced(path);
    Ok(())
}

pub(crate) fn remove(path: &Path) -> io::Result<()> {
    #[cfg(test)]
    super::fault::renames(&[path]);
    attempt(|| fs::remove_file(path))
}

/// Removes a folder if it is empty.
pub(crate) fn remove_folder(path: &Path) -> io::Result<()> {
    attempt(|| fs::remove_dir(path))
}

/// Makes a call, again where a signal has interrupted it.
fn attempt<T>(call: impl Fn() -> io::Result<T>) -> io::Result<T> {
    loop {
        #[cfg(test)]
        let made = super::fault::next_call().and_then(|()| call());
        #[cfg(not(test))]
        let made = call();
        match made {
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            made => return made,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_lock_has_one_owner_and_is_worth_nothing_once_its_file_is_removed() {
        let path = std::env::temp_dir().join(format!("microsim-lock-{}", std::process::id()));
        let [first, second] = [(); 2].map(|()| Written::lockable(&path).unwrap());
        assert!(first.try_lock(&path) && !second.try_lock(&path));
        drop(first);
        fs::remove_file(&path).unwrap();
        assert!(!second.try_lock(&path));
    }
}
