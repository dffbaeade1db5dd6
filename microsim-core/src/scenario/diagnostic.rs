//! What is wrong with a scenario, and where.

use crate::error::{Error, ErrorKind};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;

/// Diagnostics of one kind that are listed: the rest would be more of the same.
const MAX_OF_A_KIND: usize = 20;
/// Characters of a field, a message or what is accepted: a name in it may be as long as the file.
const MAX_CHARACTERS: usize = 2000;

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

impl Diagnostic {
    /// Finds line and column of its span.
    fn place(&mut self, places: &mut Places<'_>) {
        let place = self.span.as_ref().map(|span| places.at(span.start));
        (self.line, self.column) = (place.map(|(line, _)| line), place.map(|(_, column)| column));
    }

    /// Cuts off what nobody would read.
    fn shorten(&mut self) {
        [&mut self.field, &mut self.message].into_iter().chain(&mut self.accepted).for_each(shorten);
    }
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

/// Diagnostics of a kind that are not listed, because enough are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// What the messages have in common.
    pub kind: String,
    /// How many there are.
    pub count: usize,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "and {} more: {}", in_thousands(self.count), self.kind)
    }
}

/// Everything that is wrong with a scenario, in the order of the text; at least one thing, and at most twenty of a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics {
    listed: Vec<Diagnostic>,
    left_out: Vec<LeftOut>,
}

impl Diagnostics {
    /// The diagnostics, first line first.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.listed.iter()
    }

    /// How many are listed.
    #[must_use]
    pub fn len(&self) -> usize {
        self.listed.len()
    }

    /// Never: there is always one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.listed.is_empty()
    }

    /// What is not listed, of each kind.
    #[must_use]
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }
}

impl Diagnostics {
    /// The only one, placed in the text.
    pub(super) fn only(mut diagnostic: Diagnostic, text: &str) -> Self {
        diagnostic.place(&mut Places::of(text));
        diagnostic.into()
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Self { listed: vec![diagnostic], left_out: Vec::new() }
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
        let lines = self.listed.iter().map(Diagnostic::to_string).chain(self.left_out.iter().map(LeftOut::to_string));
        f.write_str(&lines.collect::<Vec<_>>().join("\n"))
    }
}

impl std::error::Error for Diagnostics {}

/// What has been found to be wrong so far; lines and columns are found at the end, of what is listed.
#[derive(Debug, Default)]
pub(super) struct Findings {
    listed: Vec<Diagnostic>,
    /// The cases of each kind.
    kinds: BTreeMap<String, BTreeSet<String>>,
}

impl Findings {
    /// Adds a case of a kind, unless it is known; `describe` is called if it is to be listed.
    pub(super) fn add(&mut self, kind: &str, case: String, describe: impl FnOnce() -> Diagnostic) {
        let cases = self.kinds.entry(kind.to_owned()).or_default();
        if cases.insert(case) && cases.len() <= MAX_OF_A_KIND {
            self.listed.push(describe());
        }
    }

    /// The same; the message says the kind.
    pub(super) fn add_diagnostic(&mut self, diagnostic: Diagnostic) {
        let start = diagnostic.span.as_ref().map(|span| span.start);
        self.add(&kind_of(&diagnostic.message), format!("{start:?} {diagnostic}"), || diagnostic);
    }

    /// An error unless nothing was found in this text.
    pub(super) fn check(self, text: &str) -> Result<(), Diagnostics> {
        let Self { mut listed, kinds } = self;
        listed.sort_by_key(|diagnostic| (diagnostic.span.is_none(), diagnostic.span.as_ref().map(|span| span.start)));
        let mut places = Places::of(text);
        listed.iter_mut().for_each(|diagnostic| {
            diagnostic.place(&mut places);
            diagnostic.shorten();
        });
        let left_out = |(kind, cases): (String, BTreeSet<String>)| {
            let count = cases.len().saturating_sub(MAX_OF_A_KIND);
            (count > 0).then_some(LeftOut { kind, count })
        };
        let left_out = kinds.into_iter().filter_map(left_out).collect();
        if listed.is_empty() { Ok(()) } else { Err(Diagnostics { listed, left_out }) }
    }
}

fn shorten(text: &mut String) {
    if let Some((end, _)) = text.char_indices().nth(MAX_CHARACTERS) {
        text.truncate(end);
        text.push('…');
    }
}

/// A message without what differs from case to case: names in quotes, and numbers.
fn kind_of(message: &str) -> String {
    let mut kind = String::new();
    let mut quote = None;
    for letter in message.chars() {
        let is_quote = matches!(letter, '`' | '"') && quote.is_none_or(|quote| quote == letter);
        if is_quote {
            quote = if quote.is_some() { None } else { Some(letter) };
        }
        let differs = is_quote || quote.is_some() || letter.is_ascii_digit();
        match (differs, kind.ends_with('…')) {
            (false, true) if matches!(letter, '.' | '-' | 'e') => {}
            (false, _) => kind.push(letter),
            (true, false) => kind.push('…'),
            (true, true) => {}
        }
    }
    kind
}

/// A count with a comma after the thousands.
fn in_thousands(count: usize) -> String {
    let digits = count.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().filter_map(|group| str::from_utf8(group).ok()).collect();
    groups.join(",")
}

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

/// A walk through a text that counts lines and columns.
#[derive(Debug)]
pub(super) struct Places<'t> {
    text: &'t [u8],
    offset: usize,
    line: usize,
    column: usize,
}

impl<'t> Places<'t> {
    /// From the beginning.
    pub(super) fn of(text: &'t str) -> Self {
        Self { text: text.as_bytes(), offset: 0, line: 1, column: 1 }
    }

    /// Line and column of a byte of the text, from 1, the column in characters. It goes on from the byte before, or from the
    /// beginning if this one comes earlier.
    pub(super) fn at(&mut self, offset: usize) -> (usize, usize) {
        let offset = offset.min(self.text.len());
        if offset < self.offset {
            (self.offset, self.line, self.column) = (0, 1, 1);
        }
        for &byte in &self.text[self.offset..offset] {
            let begins_character = byte & 0xc0 != 0x80;
            (self.line, self.column) = match byte {
                b'\n' => (self.line + 1, 1),
                _ => (self.line, self.column + usize::from(begins_character)),
            };
        }
        self.offset = offset;
        (self.line, self.column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_characters_from_one() {
        let text = "a\nµµb\n";
        let mut places = Places::of(text);
        assert_eq!(places.at(0), (1, 1));
        assert_eq!(places.at(text.find('b').unwrap()), (2, 3));
        assert_eq!(places.at(text.len()), (3, 1));
        assert_eq!(places.at(3), (2, 2), "inside a character, and back");
        assert_eq!(Places::of("").at(7), (1, 1));
    }

    #[test]
    fn kinds_have_no_names_and_numbers() {
        for (message, kind) in [
            ("unknown field `radus`, did you mean `radius`?", "unknown field …, did you mean …?"),
            ("-1.5e-3 is out of range", "-… is out of range"),
            ("is the string \"it's `so` wide\"", "is the string …"),
            ("overlaps the agar at [12.0, 4.5]", "overlaps the agar at […, …]"),
            ("missing", "missing"),
        ] {
            assert_eq!(kind_of(message), kind);
        }
        assert_eq!([7, 999, 4_980, 1_234_567].map(in_thousands), ["7", "999", "4,980", "1,234,567"]);
    }

    #[test]
    fn only_what_is_listed_is_described_and_nothing_is_found_twice() {
        let mut described = 0;
        let mut findings = Findings::default();
        for turn in 0..3 {
            for case in 0..200_000 / (turn + 1) {
                findings.add("unknown field", case.to_string(), || {
                    described += 1;
                    let (message, span) = (format!("unknown field `{case}`"), Some(case..case + 1));
                    Diagnostic { field: String::new(), message, accepted: None, span, line: None, column: None }
                });
            }
        }
        let found = findings.check(&"x".repeat(200_000)).unwrap_err();
        assert_eq!((described, found.len()), (MAX_OF_A_KIND, MAX_OF_A_KIND));
        assert_eq!(found.left_out(), [LeftOut { kind: "unknown field".into(), count: 199_980 }]);
        assert!(found.to_string().ends_with("\nand 199,980 more: unknown field"));
    }

    #[test]
    fn what_nobody_would_read_is_cut_off() {
        let text = |count| "µ".repeat(count);
        let whole = Diagnostic {
            field: text(MAX_CHARACTERS),
            message: text(MAX_CHARACTERS + 1),
            accepted: Some(text(900_000)),
            span: None,
            line: None,
            column: None,
        };
        let mut findings = Findings::default();
        findings.add("kind", String::new(), || whole.clone());
        let found = findings.check("").unwrap_err();
        let Diagnostic { field, message, accepted, .. } = found.iter().next().unwrap();
        let cut = text(MAX_CHARACTERS) + "…";
        assert_eq!((field, message, accepted), (&whole.field, &cut, &Some(cut.clone())));
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
