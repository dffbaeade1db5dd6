//! What is wrong with a scenario, and where.

use crate::error::{Error, ErrorKind};
use std::fmt;
use std::ops::Range;

/// Errors after which reading or building gives up: the rest would be more of the same.
pub(super) const MAX_ERRORS: usize = 20;

/// One thing that is wrong with a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Dotted path of the field, for example `spawn.0.count`; empty when the text is not TOML.
    pub field: String,
    /// What is wrong.
    pub message: String,
    /// What would be accepted, in words.
    pub accepted: Option<String>,
    /// The offending value: bytes of the text. `None` when it came from an override.
    pub span: Option<Range<usize>>,
    /// Line of the value, from 1.
    pub line: Option<usize>,
    /// Column of the value in characters, from 1.
    pub column: Option<usize>,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let (Some(line), Some(column)) = (self.line, self.column) {
            write!(f, "line {line}, column {column}: ")?;
        }
        if !self.field.is_empty() {
            write!(f, "{}: ", self.field)?;
        }
        write!(f, "{}", self.message)?;
        match &self.accepted {
            Some(accepted) => write!(f, " (accepted: {accepted})"),
            None => Ok(()),
        }
    }
}

/// Everything that is wrong with a scenario, in the order of the text; at least one thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    /// An error unless the list is empty.
    pub(super) fn check(mut list: Vec<Diagnostic>) -> Result<(), Self> {
        list.sort_by_key(|diagnostic| (diagnostic.span.is_none(), diagnostic.span.as_ref().map(|span| span.start)));
        list.dedup();
        if list.is_empty() { Ok(()) } else { Err(Self(list)) }
    }

    /// The diagnostics, first line first.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.0.iter()
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Never: there is always one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Self(vec![diagnostic])
    }
}

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = std::slice::Iter<'a, Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for diagnostic in self {
            write!(f, "{separator}{diagnostic}")?;
            separator = "\n";
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

/// What the library says of a refused value: message and what it accepts.
pub(super) fn in_words(error: &Error) -> (String, Option<String>) {
    let (message, accepted) = match error.kind() {
        // Files hold what is `f32` here: the shortest digits that mean it are the ones that were written.
        ErrorKind::OutOfRange { value, accepted } => (format!("{} is out of range", *value as f32), accepted.clone()),
        ErrorKind::BadReference { accepted } => ("refers to nothing usable".to_owned(), accepted.clone()),
        ErrorKind::OutsideWorld { accepted } => ("reaches beyond the walls".to_owned(), accepted.clone()),
        ErrorKind::Overlap { with } => {
            let place = "a place where nothing overlaps".to_owned();
            (format!("overlaps {with}"), place)
        }
        ErrorKind::TooMany { asked, limit } => {
            let message = format!("the world would hold {asked} particles");
            (message, format!("at most {limit} (world.max_particles)"))
        }
        ErrorKind::Stale => return ("no longer exists".to_owned(), None),
        ErrorKind::Unsupported { accepted } => ("cannot be that".to_owned(), accepted.clone()),
    };
    (message, Some(accepted))
}

/// Line and column of a byte of the text, from 1, the column in characters.
pub(super) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let offset = offset.min(text.len());
    let before = &text.as_bytes()[..offset];
    let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
    let start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
    let column = text.get(start..offset).map_or(offset - start, |part| part.chars().count()) + 1;
    (line, column)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_characters_from_one() {
        let text = "a\nµµb\n";
        assert_eq!(line_and_column(text, 0), (1, 1));
        assert_eq!(line_and_column(text, text.find('b').unwrap()), (2, 3));
        assert_eq!(line_and_column(text, text.len()), (3, 1));
        assert_eq!(line_and_column(text, 3), (2, 2), "inside a character");
        assert_eq!(line_and_column("", 7), (1, 1));
    }

    #[test]
    fn a_diagnostic_reads_as_one_line() {
        let mut diagnostic = Diagnostic {
            field: "agar.a.radius".into(),
            message: "-1 is out of range".into(),
            accepted: Some("0.1 to 20".into()),
            span: Some(4..6),
            line: Some(2),
            column: Some(3),
        };
        assert_eq!(diagnostic.to_string(), "line 2, column 3: agar.a.radius: -1 is out of range (accepted: 0.1 to 20)");
        (diagnostic.line, diagnostic.accepted) = (None, None);
        assert_eq!(diagnostic.to_string(), "agar.a.radius: -1 is out of range");
    }
}
