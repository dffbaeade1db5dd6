//! The one error type: what was wrong, in which field, and what would be accepted.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A value handed in that the library refuses. Nothing was changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Error {
    kind: ErrorKind,
    field: String,
}

/// Why a value was refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A number is not finite or outside its range.
    OutOfRange {
        /// The number as it was given.
        value: f64,
        /// The accepted range, in words.
        accepted: String,
    },
    /// A constraint, outline or link names a node that does not exist, or the same one twice.
    BadReference {
        /// What would be accepted, in words.
        accepted: String,
    },
    /// Something would lie outside the world's walls.
    OutsideWorld {
        /// What would be accepted, in words.
        accepted: String,
    },
    /// Something would overlap what is already there.
    Overlap {
        /// What it overlaps.
        with: String,
    },
    /// The world would hold more than [`crate::WorldConfig::max_particles`].
    TooMany {
        /// Particles asked for, those already there included.
        asked: u64,
        /// The limit.
        limit: u64,
    },
    /// A handle names something that no longer exists.
    Stale,
    /// The thing named cannot do what was asked.
    Unsupported {
        /// What would be accepted, in words.
        accepted: String,
    },
}

impl Error {
    pub(crate) fn new(kind: ErrorKind, field: impl Into<String>) -> Self {
        Self { kind, field: field.into() }
    }

    pub(crate) fn stale(field: impl Into<String>) -> Self {
        Self::new(ErrorKind::Stale, field)
    }

    pub(crate) fn reference(field: impl Into<String>, accepted: impl Into<String>) -> Self {
        Self::new(ErrorKind::BadReference { accepted: accepted.into() }, field)
    }

    pub(crate) fn unsupported(field: impl Into<String>, accepted: impl Into<String>) -> Self {
        Self::new(ErrorKind::Unsupported { accepted: accepted.into() }, field)
    }

    /// Why the value was refused.
    #[must_use]
    pub fn kind(&self) -> &ErrorKind {
        &self.kind
    }

    /// Path of the field that was refused, for example `radii.x`.
    #[must_use]
    pub fn field(&self) -> &str {
        &self.field
    }

    /// The same error with `prefix.` in front of the field's path.
    #[must_use]
    pub fn within(mut self, prefix: &str) -> Self {
        self.field = if self.field.is_empty() { prefix.to_owned() } else { format!("{prefix}.{}", self.field) };
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let field = &self.field;
        match &self.kind {
            ErrorKind::OutOfRange { value, accepted } => write!(f, "`{field}` is {value}, accepted: {accepted}"),
            ErrorKind::BadReference { accepted } => {
                write!(f, "`{field}` refers to nothing usable, accepted: {accepted}")
            }
            ErrorKind::OutsideWorld { accepted } => write!(f, "`{field}` lies outside the walls, accepted: {accepted}"),
            ErrorKind::Overlap { with } => {
                write!(f, "`{field}` overlaps {with}, accepted: a place where nothing overlaps")
            }
            ErrorKind::TooMany { asked, limit } => {
                write!(f, "`{field}` asks for {asked} particles, accepted: at most {limit} in one world")
            }
            ErrorKind::Stale => write!(f, "`{field}` no longer exists"),
            ErrorKind::Unsupported { accepted } => write!(f, "`{field}` cannot do that, accepted: {accepted}"),
        }
    }
}

impl std::error::Error for Error {}

/// Checks that `value` is finite and within `low..=high`.
pub(crate) fn in_range(field: &str, value: f32, low: f32, high: f32) -> Result<(), Error> {
    let is_inside = value.is_finite() && value >= low && value <= high;
    is_inside.then_some(()).ok_or_else(|| out_of_range(field, f64::from(value), format!("{low} to {high}")))
}

/// Checks that `value` is within `low..=high`.
pub(crate) fn count_in_range(field: &str, value: u32, low: u32, high: u32) -> Result<(), Error> {
    let is_inside = (low..=high).contains(&value);
    is_inside.then_some(()).ok_or_else(|| out_of_range(field, f64::from(value), format!("{low} to {high}")))
}

pub(crate) fn out_of_range(field: &str, value: f64, accepted: String) -> Error {
    Error::new(ErrorKind::OutOfRange { value, accepted }, field)
}
