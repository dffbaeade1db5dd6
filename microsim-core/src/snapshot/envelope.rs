//! Envelope of a file: eight bytes that name its format, a version, the length of the content, the content, and a checksum of
//! all of these. Numbers are little-endian.

use super::SnapshotError;
use crate::fnv::Fnv1a;

const VERSION_AT: usize = 8;
const LENGTH_AT: usize = VERSION_AT + 4;
const CONTENT_AT: usize = LENGTH_AT + 8;
const CHECKSUM: usize = 8;

/// A file format.
#[derive(Clone, Copy, Debug)]
pub(super) struct Format {
    pub magic: [u8; VERSION_AT],
    pub version: u32,
}

impl Format {
    /// Content with its envelope.
    pub(super) fn seal(self, content: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(CONTENT_AT + content.len() + CHECKSUM);
        bytes.extend(self.magic);
        bytes.extend(self.version.to_le_bytes());
        bytes.extend((content.len() as u64).to_le_bytes());
        bytes.extend(content);
        bytes.extend(checksum(&bytes));
        bytes
    }

    /// The content, if the envelope is valid.
    pub(super) fn open(self, bytes: &[u8]) -> Result<&[u8], SnapshotError> {
        let begins = bytes.iter().zip(self.magic).all(|(&found, expected)| found == expected);
        if !begins {
            return Err(SnapshotError::Foreign);
        }
        let truncated =
            |expected: usize| SnapshotError::Truncated { expected: expected as u64, found: bytes.len() as u64 };
        let found = bytes.get(VERSION_AT..LENGTH_AT).ok_or_else(|| truncated(CONTENT_AT + CHECKSUM))?;
        let found = found.try_into().map_or(0, u32::from_le_bytes);
        if found != self.version {
            return Err(SnapshotError::Version { found, accepted: self.version });
        }
        let length = bytes.get(LENGTH_AT..CONTENT_AT).ok_or_else(|| truncated(CONTENT_AT + CHECKSUM))?;
        let length = length.try_into().map_or(0, u64::from_le_bytes);
        let expected = length.saturating_add((CONTENT_AT + CHECKSUM) as u64);
        let found = bytes.len() as u64;
        if found < expected {
            return Err(SnapshotError::Truncated { expected, found });
        }
        if found > expected {
            return Err(SnapshotError::Trailing { count: found - expected });
        }
        let (sealed, sum) = bytes.split_at(bytes.len() - CHECKSUM);
        if checksum(sealed) != sum {
            return Err(SnapshotError::Corrupt);
        }
        Ok(&sealed[CONTENT_AT..])
    }
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let mut hash = Fnv1a::new();
    hash.bytes(bytes);
    hash.finish().to_le_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORMAT: Format = Format { magic: *b"TESTFILE", version: 3 };

    #[test]
    fn what_was_sealed_is_opened() {
        for content in [&b""[..], b"a", &[7; 1000]] {
            assert_eq!(FORMAT.open(&FORMAT.seal(content)), Ok(content));
        }
    }

    #[test]
    fn each_kind_of_damage_has_an_error_of_its_own() {
        let sealed = FORMAT.seal(b"content");
        for length in 0..sealed.len() {
            let expected = if length < CONTENT_AT { CONTENT_AT + CHECKSUM } else { sealed.len() } as u64;
            let truncated = SnapshotError::Truncated { expected, found: length as u64 };
            assert_eq!(FORMAT.open(&sealed[..length]), Err(truncated));
        }
        let longer: Vec<u8> = sealed.iter().chain(b"xy").copied().collect();
        assert_eq!(FORMAT.open(&longer), Err(SnapshotError::Trailing { count: 2 }));
        let other = Format { version: 2, ..FORMAT }.seal(b"content");
        assert_eq!(FORMAT.open(&other), Err(SnapshotError::Version { found: 2, accepted: 3 }));
        assert_eq!(FORMAT.open(b"PNG"), Err(SnapshotError::Foreign));
        for bit in 0..sealed.len() * 8 {
            let mut flipped = sealed.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            let error = FORMAT.open(&flipped).unwrap_err();
            match bit / 8 {
                0..VERSION_AT => assert_eq!(error, SnapshotError::Foreign),
                VERSION_AT..LENGTH_AT => assert!(matches!(error, SnapshotError::Version { .. })),
                LENGTH_AT..CONTENT_AT => {
                    assert!(matches!(error, SnapshotError::Truncated { .. } | SnapshotError::Trailing { .. }));
                }
                _ => assert_eq!(error, SnapshotError::Corrupt),
            }
        }
    }
}
