//! The files of the page, in memory: no name of a request is ever a name of a file.

use crate::read;
use hyper::body::Bytes;
use std::collections::HashMap;
use std::fs;
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

/// Most bytes of all files together.
const MOST: usize = 256 << 20;

/// A file as it is sent.
#[derive(Debug)]
pub(super) struct File {
    pub kind: &'static str,
    pub bytes: Bytes,
}

/// Files by their path in an address.
#[derive(Debug, Default)]
pub(super) struct Page(HashMap<String, File>);

impl Page {
    /// Reads a folder and those in it; links to elsewhere are refused.
    pub(super) fn read(folder: &Path) -> Result<Self> {
        read::check_own(folder)?;
        let mut page = Self::default();
        page.add(folder, "/")?;
        Ok(page)
    }

    fn add(&mut self, folder: &Path, prefix: &str) -> Result<()> {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            let Some(name) = path.file_name().and_then(|name| name.to_str()) else { continue };
            let address = format!("{prefix}{name}");
            if path.is_dir() {
                self.add(&path, &format!("{address}/"))?;
                continue;
            }
            let file = File { kind: kind(name), bytes: read::whole(&path)?.into() };
            self.0.insert(address, file);
            if self.0.values().map(|file| file.bytes.len()).sum::<usize>() > MOST {
                return Err(Error::new(ErrorKind::FileTooLarge, format!("more than {MOST} bytes")));
            }
        }
        Ok(())
    }

    /// The file of an address; a folder's is its `index.html`.
    pub(super) fn find(&self, path: &str) -> Option<&File> {
        if path.ends_with('/') { self.0.get(&format!("{path}index.html")) } else { self.0.get(path) }
    }
}

/// The type of a file, by its name.
fn kind(name: &str) -> &'static str {
    match name.rsplit_once('.').map_or("", |(_, end)| end) {
        "css" => "text/css",
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript",
        "png" => "image/png",
        "txt" => "text/plain; charset=utf-8",
        "wasm" => "application/wasm",
        "webmanifest" => "application/manifest+json",
        _ => "application/octet-stream",
    }
}
