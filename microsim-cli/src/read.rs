//! Reading with a limit, and of regular files alone: a device or a pipe may have no end.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Longest file that is read whole, bytes.
const LONGEST: u64 = 1 << 30;

/// Opens a regular file.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    // Before it is opened, which waits for ever where nobody writes to a pipe.
    if fs::metadata(path)?.is_file() { File::open(path) } else { Err(irregular()) }
}

/// What is said of a device, a pipe or a folder.
pub(crate) fn irregular() -> io::Error {
    io::Error::new(ErrorKind::InvalidInput, "it is not a regular file")
}

/// Refuses a folder in which there is anything but regular files and folders: a link leads to the files of others.
pub(crate) fn check_own(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let kind = entry.file_type()?;
        if kind.is_dir() {
            check_own(&entry.path())?;
        } else if !kind.is_file() {
            let why = format!("{} in it is not a regular file", entry.path().display());
            return Err(io::Error::new(ErrorKind::InvalidInput, why));
        }
    }
    Ok(())
}

/// The content of a regular file.
pub(crate) fn whole(path: &Path) -> io::Result<Vec<u8>> {
    let file = open(path)?;
    let length = file.metadata()?.len();
    if length > LONGEST { Err(too_long()) } else { limited(file, length as usize) }
}

/// What a reader has, about `length` bytes.
pub(crate) fn limited(from: impl Read, length: usize) -> io::Result<Vec<u8>> {
    at_most(LONGEST, from, length)
}

fn at_most(longest: u64, from: impl Read, length: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(length);
    from.take(longest + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > longest { Err(too_long()) } else { Ok(bytes) }
}

fn too_long() -> io::Error {
    io::Error::new(ErrorKind::FileTooLarge, format!("it is longer than {LONGEST} bytes"))
}

/// The text in a regular file.
pub(crate) fn text(path: &Path) -> io::Result<String> {
    in_utf8(whole(path)?)
}

/// Bytes as text.
pub(crate) fn in_utf8(bytes: Vec<u8>) -> io::Result<String> {
    String::from_utf8(bytes).map_err(|error| io::Error::new(ErrorKind::InvalidData, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_too_long_is_refused_before_it_is_read() {
        let path = std::env::temp_dir().join(format!("microsim-long-{}", std::process::id()));
        // A hole: it takes no room.
        File::create(&path).and_then(|file| file.set_len(LONGEST + 1)).unwrap();
        let read = whole(&path);
        fs::remove_file(&path).unwrap();
        assert_eq!(read.unwrap_err().kind(), ErrorKind::FileTooLarge);
    }

    #[test]
    fn what_has_no_end_is_read_up_to_the_limit() {
        assert_eq!(at_most(4, io::repeat(b'0'), 0).unwrap_err().kind(), ErrorKind::FileTooLarge);
        assert_eq!(at_most(4, &b"0123"[..], 0).unwrap(), b"0123");
    }
}
