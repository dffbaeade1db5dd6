//! Chunks: kind (one byte), length of the content (four bytes), content, and half of a checksum over everything before it in
//! the file (four bytes). Numbers are little-endian.

use super::{MAGIC, ReplayError, VERSION};
use crate::fnv::Fnv1a;

const NUMBER: usize = 4;
const CONTENT_AT: usize = 1 + NUMBER;
const CHUNKS_AT: usize = MAGIC.len() + NUMBER;

/// Writes chunks one after the other.
#[derive(Clone, Debug)]
pub(super) struct ChunkWriter(Fnv1a);

impl ChunkWriter {
    /// Returns also what the file begins with.
    pub(super) fn new() -> (Self, Vec<u8>) {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        let mut hash = Fnv1a::new();
        hash.bytes(&bytes);
        (Self(hash), bytes)
    }

    /// One chunk. Content is far shorter than four gigabytes.
    pub(super) fn write(&mut self, kind: u8, content: &[u8]) -> Vec<u8> {
        let mut bytes = vec![kind];
        bytes.extend((content.len() as u32).to_le_bytes());
        bytes.extend(content);
        self.0.bytes(&bytes);
        let sum = checksum(self.0);
        bytes.extend(sum);
        self.0.bytes(&sum);
        bytes
    }
}

/// Why there is no chunk where one should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ChunkError {
    CutOff,
    Damaged,
}

/// Reads chunks one after the other, up to the first that is not whole.
#[derive(Clone, Debug)]
pub(super) struct ChunkReader<'a> {
    bytes: &'a [u8],
    at: usize,
    hash: Fnv1a,
}

impl<'a> ChunkReader<'a> {
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, ReplayError> {
        if !bytes.iter().zip(MAGIC).all(|(&found, expected)| found == expected) {
            return Err(ReplayError::Foreign);
        }
        let found = bytes.get(MAGIC.len()..CHUNKS_AT).and_then(number).ok_or(ReplayError::NoHeader)?;
        if found != VERSION {
            return Err(ReplayError::Version { found, accepted: VERSION });
        }
        let mut hash = Fnv1a::new();
        hash.bytes(&bytes[..CHUNKS_AT]);
        Ok(Self { bytes, at: CHUNKS_AT, hash })
    }

    /// Where the next chunk begins.
    pub(super) fn place(&self) -> u64 {
        self.at as u64
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.at == self.bytes.len()
    }

    fn read(&mut self) -> Result<(u8, &'a [u8]), ChunkError> {
        let rest = &self.bytes[self.at..];
        let length = rest.get(1..CONTENT_AT).and_then(number).ok_or(ChunkError::CutOff)? as usize;
        let (chunk, after) = rest.split_at_checked(CONTENT_AT.saturating_add(length)).ok_or(ChunkError::CutOff)?;
        let sum = after.get(..NUMBER).ok_or(ChunkError::CutOff)?;
        self.hash.bytes(chunk);
        if checksum(self.hash) != sum {
            return Err(ChunkError::Damaged);
        }
        self.hash.bytes(sum);
        self.at += chunk.len() + NUMBER;
        Ok((chunk[0], &chunk[CONTENT_AT..]))
    }
}

impl<'a> Iterator for ChunkReader<'a> {
    type Item = Result<(u8, &'a [u8]), ChunkError>;

    fn next(&mut self) -> Option<Self::Item> {
        (!self.is_at_end()).then(|| self.read())
    }
}

fn number(bytes: &[u8]) -> Option<u32> {
    bytes.try_into().ok().map(u32::from_le_bytes)
}

fn checksum(hash: Fnv1a) -> [u8; NUMBER] {
    let sum = hash.finish();
    ((sum >> 32) as u32 ^ sum as u32).to_le_bytes()
}
