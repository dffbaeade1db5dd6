//! The text of a scenario as a tree of values: overrides and parameters put in, and where each value stands.

use crate::scenario::diagnostic::{Diagnostic, Diagnostics, line_and_column, nearest};
use crate::scenario::reader::overrides;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and where it stands.
pub(crate) type Value<'a> = Spanned<DeValue<'a>>;

/// The text and the place of every value in it, by dotted path.
///
/// A value that an override brought does not stand in the text: its span begins beyond the end of the text, by one plus
/// the index of the override. Values that a parameter brought stand where the parameter does: there they can be changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Source {
    pub text: String,
    pub overrides: Vec<(String, String)>,
    places: BTreeMap<String, Place>,
}

#[derive(Clone, Debug)]
struct Place {
    key: Range<usize>,
    value: Range<usize>,
}

impl Source {
    /// Parses the text, applies the overrides and puts parameters in.
    pub(crate) fn read<'a>(
        text: &'a str,
        overrides: &'a [(String, String)],
    ) -> Result<(DeTable<'a>, Self), Diagnostics> {
        let mut source = Self { text: text.to_owned(), overrides: overrides.to_vec(), places: BTreeMap::new() };
        let (root, errors) = DeTable::parse_recoverable(text);
        // What follows from a syntax error is no use to anybody: at most one for each line.
        let mut broken: Vec<Diagnostic> = errors.iter().map(|error| source.syntax_error(error)).collect();
        broken.dedup_by_key(|diagnostic| diagnostic.line);
        broken.truncate(crate::scenario::MAX_ERRORS);
        Diagnostics::check(broken)?;
        let mut root = Spanned::new(root.span(), DeValue::Table(root.into_inner()));
        let mut found = Vec::new();
        for (index, (key, value)) in overrides.iter().enumerate() {
            let span = text.len() + 1 + index;
            if let Err((message, accepted)) = overrides::apply(&mut root, key, value, span..span) {
                found.push(source.diagnostic_at(span..span, key.clone(), message, Some(accepted)));
            }
        }
        let parameters = source.parameters(&root, &mut found);
        source.substitute(&mut root, "", &parameters, &mut found);
        source.record("", 0..0, &root);
        Diagnostics::check(found)?;
        match root.into_inner() {
            DeValue::Table(table) => Ok((table, source)),
            _ => Ok((DeTable::new(), source)),
        }
    }

    /// The diagnostic for the value at a path; for one that is not in the file, at the table that it belongs to.
    pub(crate) fn diagnostic(&self, field: &str, message: impl Into<String>, accepted: Option<String>) -> Diagnostic {
        let (field, place) = self.locate(field);
        self.diagnostic_at(place.value, field, message.into(), accepted)
    }

    /// The diagnostic for the key at a path.
    pub(crate) fn key_diagnostic(&self, field: &str, message: String, accepted: String) -> Diagnostic {
        let (field, place) = self.locate(field);
        self.diagnostic_at(place.key, field, message, Some(accepted))
    }

    /// Whether the file has a value at a path.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.places.contains_key(path)
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
            message = format!("{message}, as set by `{key}={value}`");
        }
        let (line, column) = line_and_column(&self.text, span.start);
        let is_in_text = beyond.is_none();
        Diagnostic {
            field,
            message,
            accepted,
            span: is_in_text.then_some(span),
            line: is_in_text.then_some(line),
            column: is_in_text.then_some(column),
        }
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
    fn locate(&self, path: &str) -> (String, Place) {
        let path = self.in_file(path);
        let mut around = path.as_str();
        loop {
            if let Some(place) = self.places.get(around) {
                return (path.clone(), place.clone());
            }
            around = match around.rsplit_once('.') {
                Some((parent, _)) => parent,
                None if around.is_empty() => return (path.clone(), Place { key: 0..0, value: 0..0 }),
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

    fn record(&mut self, path: &str, key: Range<usize>, value: &Value<'_>) {
        let place = Place { key, value: value.span() };
        self.places.insert(path.to_owned(), place);
        match value.get_ref() {
            DeValue::Table(table) => {
                for (key, child) in table {
                    self.record(&join(path, key.get_ref()), key.span(), child);
                }
            }
            DeValue::Array(array) => {
                for (index, child) in array.iter().enumerate() {
                    self.record(&join(path, &index.to_string()), child.span(), child);
                }
            }
            _ => {}
        }
    }

    /// The `[parameters]` table.
    fn parameters<'a>(&self, root: &Value<'a>, found: &mut Vec<Diagnostic>) -> BTreeMap<String, Value<'a>> {
        let Some(parameters) = root.get_ref().get("parameters") else {
            return BTreeMap::new();
        };
        let mut refuse = |field: String, span, message: &str, accepted: &str| {
            found.push(self.diagnostic_at(span, field, message.to_owned(), Some(accepted.to_owned())));
        };
        let Some(table) = parameters.get_ref().as_table() else {
            refuse("parameters".into(), parameters.span(), "not a table", "a [parameters] table");
            return BTreeMap::new();
        };
        for (key, value) in table {
            let field = join("parameters", key.get_ref());
            if !is_name(key.get_ref()) {
                refuse(field.clone(), key.span(), "not a usable name", NAME);
            }
            if value.get_ref().is_table() || value.get_ref().is_array() {
                refuse(field, value.span(), "not a single value", "a number, a string or a boolean");
            }
        }
        let entry = |(key, value): (&Spanned<Cow<'_, str>>, &Value<'a>)| (key.get_ref().to_string(), value.clone());
        table.iter().map(entry).collect()
    }

    /// Replaces every string `$name` outside `[parameters]` by that parameter.
    fn substitute<'a>(
        &self,
        value: &mut Value<'a>,
        path: &str,
        parameters: &BTreeMap<String, Value<'a>>,
        found: &mut Vec<Diagnostic>,
    ) {
        let name = value.get_ref().as_str().and_then(|text| text.strip_prefix('$'));
        if let Some(name) = name.filter(|name| is_name(name)) {
            match parameters.get(name) {
                Some(parameter) => *value = parameter.clone(),
                None => {
                    let names: Vec<&str> = parameters.keys().map(String::as_str).collect();
                    let (message, accepted) = unknown("parameter", name, &names);
                    found.push(self.diagnostic_at(value.span(), path.to_owned(), message, Some(accepted)));
                }
            }
            return;
        }
        match value.get_mut() {
            DeValue::Table(table) => table
                .iter_mut()
                .filter(|(key, _)| !(path.is_empty() && key.get_ref() == "parameters"))
                .for_each(|(key, child)| self.substitute(child, &join(path, key.get_ref()), parameters, found)),
            DeValue::Array(array) => array
                .iter_mut()
                .enumerate()
                .for_each(|(index, child)| self.substitute(child, &join(path, &index.to_string()), parameters, found)),
            _ => {}
        }
    }
}

/// A degree in radians: files hold degrees.
pub(crate) const DEGREE: f32 = std::f32::consts::PI / 180.0;

/// What names of prototypes, controllers, organisms and parameters look like.
pub(crate) const NAME: &str = "1 to 64 letters, digits, _ or -";

/// Whether this is a name: nothing that needs quoting in a dotted path.
pub(crate) fn is_name(text: &str) -> bool {
    let is_part = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    (1..=64).contains(&text.len()) && text.bytes().all(is_part)
}

/// Extends a dotted path.
pub(crate) fn join(path: &str, last: &str) -> String {
    if path.is_empty() { last.to_owned() } else { format!("{path}.{last}") }
}

/// Message and accepted names for a name that is none of those known.
pub(crate) fn unknown(what: &str, name: &str, known: &[&str]) -> (String, String) {
    let guess = nearest(name, known.iter().copied()).map_or(String::new(), |near| format!(", did you mean `{near}`?"));
    let accepted = if known.is_empty() { "none: there is none".to_owned() } else { known.join(", ") };
    (format!("unknown {what} `{name}`{guess}"), accepted)
}
