//! Reading with a limit, and of regular files alone: a device or a pipe may have no end.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Longest file that is read whole, bytes.
const LONGEST: u64 = 1 << 30;

/// Opens a regular file.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    // Before it is opened, which waits for ever where nobody writes to a pipe.
    if fs::metadata(path)?.is_file() {
        File::open(path)
    } else {
        Err(io::Error::new(ErrorKind::InvalidInput, "it is not a regular file"))
    }
}

/// The content of a regular file.
pub(crate) fn whole(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(LONGEST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LONGEST {
        let message = format!("it is longer than {LONGEST} bytes");
        return Err(io::Error::new(ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

/// The text in a regular file.
pub(crate) fn text(path: &Path) -> io::Result<String> {
    String::from_utf8(whole(path)?).map_err(|error| io::Error::new(ErrorKind::InvalidData, error))
}
