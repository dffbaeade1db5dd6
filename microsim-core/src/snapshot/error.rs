//! What snapshots are refused with.

use std::fmt;

/// Error of reading or writing a snapshot.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The first bytes are not those of a snapshot.
    Foreign,
    /// Another version of the format.
    Version {
        /// The version of the bytes.
        found: u32,
        /// The only one that is read.
        accepted: u32,
    },
    /// The end is missing.
    Truncated {
        /// Expected number of bytes.
        expected: u64,
        /// Number of bytes found.
        found: u64,
    },
    /// Something follows the end.
    Trailing {
        /// Number of surplus bytes.
        count: u64,
    },
    /// The content was changed: the checksum is wrong.
    Corrupt,
    /// The checksum is right, but the content is not a valid state of a world.
    Invalid {
        /// What is wrong with it.
        flaw: String,
    },
    /// The world cannot be written: the shape of an obstacle is of a kind that the format does not know. It knows balls,
    /// cuboids, capsules, segments, triangles, convex polygons, polylines, and compounds of all but the last.
    UnknownShape {
        /// Its position in [`World::obstacles`](crate::World::obstacles).
        obstacle: usize,
    },
}

impl fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign => write!(f, "not a snapshot: the first bytes are wrong"),
            Self::Version { found, accepted } => {
                write!(f, "version {found} of the format, accepted: version {accepted}")
            }
            Self::Truncated { expected, found } => write!(f, "the end is missing: {found} of {expected} bytes"),
            Self::Trailing { count } => write!(f, "{count} bytes follow the end"),
            Self::Corrupt => write!(f, "damaged: the checksum is wrong"),
            Self::Invalid { flaw } => write!(f, "no state of a world: {flaw}"),
            Self::UnknownShape { obstacle } => {
                write!(f, "the shape of obstacle {obstacle} cannot be written")
            }
        }
    }
}

impl std::error::Error for SnapshotError {}
