//! The text of a scenario as a tree of values, with overrides and parameters put in, and the span of each value.

use super::value::{SpannedValue, join};
use super::{overrides, parameters};
use crate::scenario::diagnostic::{Diagnostic, Diagnostics, Findings, Places};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Most bytes of a text.
const MAX_BYTES: usize = 1_000_000;
/// Most dots in keys: each makes a table of a kilobyte, which keys of two bytes would make half a million times.
const MAX_DOTS: usize = 50_000;
/// Longest text of which all syntax errors are found, bytes: each takes memory, and there may be as many as bytes.
const MAX_RECOVERED: usize = 100_000;
/// Most values of a file, tables and arrays among them.
const MAX_VALUES: usize = 200_000;
/// Most bytes of the paths of all values: a long name of a table is part of the path of each value in it.
const MAX_PATHS: usize = 20_000_000;
/// Most characters of an override that a message repeats.
const MAX_REPEATED: usize = 80;

/// The text and the spans of every value in it, by dotted path.
///
/// A value that an override brought does not stand in the text: its span begins beyond the end of the text, by one plus
/// the index of the override. Values that a parameter brought stand where the parameter does: there they can be changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Document {
    pub text: String,
    pub overrides: Vec<(String, String)>,
    spans: BTreeMap<String, Spans>,
    /// Bytes of all paths.
    paths: usize,
}

/// The path of a value, what is wrong, and what is accepted.
type TooMuch = (String, &'static str, String);

/// Where a value and its key stand, bytes of the text.
#[derive(Clone, Debug)]
struct Spans {
    key: Range<usize>,
    value: Range<usize>,
}

impl Document {
    /// Parses the text of this document.
    fn parse<'a>(&self, text: &'a str) -> Result<SpannedValue<'a>, Diagnostics> {
        let (root, mut errors) = parse(text);
        // Those that the parser finds later may stand before others.
        errors.sort_by_key(|error| error.span().map(|span| span.start));
        // One syntax error for each line: others there are consequences of it.
        let mut places = Places::of(text);
        let mut last = None;
        let mut found = Findings::default();
        for diagnostic in errors.iter().map(|error| self.syntax_error(error)) {
            let line = diagnostic.span.as_ref().map(|span| places.at(span.start).0);
            if line != last {
                found.add_diagnostic(diagnostic);
            }
            last = line;
        }
        found.check(text)?;
        Ok(Spanned::new(root.span(), DeValue::Table(root.into_inner())))
    }

    /// Parses the text, applies the overrides and puts parameters in.
    pub(crate) fn read<'a>(
        text: &'a str,
        overrides: &'a [(String, String)],
    ) -> Result<(DeTable<'a>, Self), Diagnostics> {
        check_length(text, overrides)?;
        let mut document = Self { text: text.to_owned(), overrides: overrides.to_vec(), ..Self::default() };
        let mut root = document.parse(text)?;
        let mut found = Findings::default();
        for (index, (key, value)) in overrides.iter().enumerate() {
            let span = text.len() + 1 + index;
            if let Err((message, accepted)) = overrides::apply(&mut root, key, value, span..span) {
                found.add_diagnostic(document.diagnostic_at(span..span, key.clone(), message, Some(accepted)));
            }
        }
        parameters::substitute(&mut root, &mut |span, field, kind, describe| {
            found.add(kind, field.to_owned(), || {
                let (message, accepted) = describe();
                document.diagnostic_at(span, field.to_owned(), message, Some(accepted))
            });
        });
        if let Err((path, message, accepted)) = document.record("", 0..0, &root) {
            found.add_diagnostic(document.diagnostic(&path, message, Some(accepted)));
        }
        found.check(text)?;
        match root.into_inner() {
            DeValue::Table(table) => Ok((table, document)),
            _ => Ok((DeTable::new(), document)),
        }
    }

    /// The diagnostic for the value at a path; for one that is not in the file, at the table that it belongs to.
    pub(crate) fn diagnostic(&self, field: &str, message: impl Into<String>, accepted: Option<String>) -> Diagnostic {
        let (field, spans) = self.locate(field);
        self.diagnostic_at(spans.value, field, message.into(), accepted)
    }

    /// The diagnostic for the key at a path.
    pub(crate) fn key_diagnostic(&self, field: &str, message: String, accepted: String) -> Diagnostic {
        let (field, spans) = self.locate(field);
        self.diagnostic_at(spans.key, field, message, Some(accepted))
    }

    /// Whether the file has a value at a path.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.spans.contains_key(path)
    }

    fn diagnostic_at(
        &self,
        span: Range<usize>,
        field: String,
        mut message: String,
        accepted: Option<String>,
    ) -> Diagnostic {
        let beyond = span.start.checked_sub(self.text.len() + 1);
        if let Some((key, value)) = beyond.and_then(|index| self.overrides.get(index)) {
            let whole = format!("{key}={value}");
            let mut repeated: String = whole.chars().take(MAX_REPEATED).collect();
            repeated.push_str(if repeated.len() < whole.len() { "…" } else { "" });
            message = format!("{message}, as set by `{repeated}`");
        }
        let span = beyond.is_none().then_some(span);
        Diagnostic { field, message, accepted, span, line: None, column: None }
    }

    fn syntax_error(&self, error: &toml::de::Error) -> Diagnostic {
        let span = error.span().unwrap_or(0..0);
        let key = self.text.get(span.clone()).unwrap_or_default();
        let is_duplicate = error.message().contains("duplicate key");
        let field = if is_duplicate { key.to_owned() } else { String::new() };
        let accepted = match error.message() {
            _ if is_duplicate => "each key once".to_owned(),
            _ => "TOML: `key = value` lines under `[table]` headers, strings in quotes".to_owned(),
        };
        self.diagnostic_at(span, field, error.message().to_owned(), Some(accepted))
    }

    /// The path as the file spells it (`at.0` for `at.x`) and the place of it or of the nearest table around it.
    fn locate(&self, path: &str) -> (String, Spans) {
        let path = self.in_file(path);
        let mut around = path.as_str();
        loop {
            if let Some(spans) = self.spans.get(around) {
                return (path.clone(), spans.clone());
            }
            around = match around.rsplit_once('.') {
                Some((parent, _)) => parent,
                None if around.is_empty() => return (path.clone(), Spans { key: 0..0, value: 0..0 }),
                None => "",
            };
        }
    }

    /// Turns the library's `[1]`, `.x` and `.y` into positions where the file has an array there.
    fn in_file(&self, path: &str) -> String {
        let path = path.replace('[', ".").replace(']', "");
        let element = path.rsplit_once('.').and_then(|(parent, last)| match last {
            "x" => Some(format!("{parent}.0")),
            "y" => Some(format!("{parent}.1")),
            _ => None,
        });
        match element {
            Some(element) if !self.has(&path) && self.has(&element) => element,
            _ => path,
        }
    }

    /// Records a value and all that it holds; of the first one that is too much its path, what is wrong, and what is accepted.
    fn record(&mut self, path: &str, key: Range<usize>, value: &SpannedValue<'_>) -> Result<(), TooMuch> {
        self.paths += path.len();
        if self.spans.len() == MAX_VALUES {
            return Err((path.to_owned(), "one value too many", format!("at most {MAX_VALUES} values in a file")));
        }
        if self.paths > MAX_PATHS {
            let accepted = format!("paths of all values of at most {MAX_PATHS} bytes together");
            return Err((path.to_owned(), "names that are too long", accepted));
        }
        let spans = Spans { key, value: value.span() };
        self.spans.insert(path.to_owned(), spans);
        match value.get_ref() {
            DeValue::Table(table) => {
                for (key, child) in table {
                    self.record(&join(path, key.get_ref()), key.span(), child)?;
                }
            }
            DeValue::Array(array) => {
                for (index, child) in array.iter().enumerate() {
                    self.record(&join(path, &index.to_string()), child.span(), child)?;
                }
            }
            _ => {}
        }
        Ok(())
    }
}

/// The values of a text and what is no TOML in it: all of it, or the first of a text that nobody wrote by hand.
fn parse(text: &str) -> (Spanned<DeTable<'_>>, Vec<toml::de::Error>) {
    if text.len() <= MAX_RECOVERED {
        return DeTable::parse_recoverable(text);
    }
    match DeTable::parse(text) {
        Ok(root) => (root, Vec::new()),
        Err(first) => (Spanned::new(0..0, DeTable::new()), vec![first]),
    }
}

/// Refuses texts before they are parsed that are so long that parsing would take much memory.
fn check_length(text: &str, overrides: &[(String, String)]) -> Result<(), Diagnostics> {
    let refuse = |message: String, accepted: String, at: usize| {
        let span = Some(at..at);
        let refused =
            Diagnostic { field: String::new(), message, accepted: Some(accepted), span, line: None, column: None };
        Err(Diagnostics::only(refused, text))
    };
    let bytes = text.len() + overrides.iter().map(|(key, value)| key.len() + value.len()).sum::<usize>();
    if bytes > MAX_BYTES {
        let message = format!("the file and what is set have {bytes} bytes");
        return refuse(message, format!("at most {MAX_BYTES} bytes"), text.len().min(MAX_BYTES));
    }
    let dots = dots_in_keys(text) + overrides.iter().map(|(_, value)| dots_in_keys(value)).sum::<usize>();
    if dots > MAX_DOTS {
        return refuse(format!("{dots} dots in keys"), format!("at most {MAX_DOTS}"), 0);
    }
    Ok(())
}

/// Dots of a text but for one within a number or a word, which takes more bytes.
fn dots_in_keys(text: &str) -> usize {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric();
    let dots = |word: &str| match word.split_once('.') {
        Some((before, after)) if before.ends_with(is_plain) && after.starts_with(is_plain) && !after.contains('.') => 0,
        _ => word.matches('.').count(),
    };
    text.split(|letter: char| letter.is_whitespace() || ",=[]{}".contains(letter)).map(dots).sum()
}
