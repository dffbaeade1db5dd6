//! Reading tables: every field is asked for by name and type, and what nobody asked for is refused.
//!
//! Reading goes on after an error with a value that makes sense, so that one pass finds all that is wrong. What is asked
//! for is also the description of the format: see [`crate::scenario::describe`].

use crate::error::Error;
use crate::scenario::describe::{Entry, Note};
use crate::scenario::diagnostic::{Diagnostic, in_words};
use crate::scenario::reader::document::{NAME, Source, Value, is_name, join, unknown};
use crate::scenario::reader::value_type::Shape;
use glam::Vec2;
use std::cell::RefCell;
use toml::de::{DeTable, DeValue};

/// What was found to be wrong so far. Shared by all readers of one file, hence the cell.
#[derive(Debug)]
pub(crate) struct Report<'s> {
    pub source: &'s Source,
    pub found: RefCell<Vec<Diagnostic>>,
    /// Every field that was asked for, if the format is being described.
    pub notes: Option<RefCell<Vec<Note>>>,
    /// Paths of values that were refused by themselves and are read as if they were not there.
    refused: RefCell<Vec<String>>,
}

impl<'s> Report<'s> {
    pub(crate) fn new(source: &'s Source) -> Self {
        Self { source, found: RefCell::default(), notes: None, refused: RefCell::default() }
    }

    /// One that takes notes of what is asked for instead of reading.
    pub(crate) fn describing(source: &'s Source) -> Self {
        Self { notes: Some(RefCell::default()), ..Self::new(source) }
    }

    fn note(&self, path: String, entry: impl FnOnce() -> Entry) {
        if let Some(notes) = &self.notes {
            let note = Note { path, entry: entry() };
            let mut notes = notes.borrow_mut();
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
    }

    /// Refuses the value at a path.
    pub(crate) fn refuse(&self, path: &str, message: impl Into<String>, accepted: impl Into<String>) {
        let diagnostic = self.source.diagnostic(path, message, Some(accepted.into()));
        self.found.borrow_mut().push(diagnostic);
    }

    /// Refuses the key at a path.
    pub(crate) fn refuse_key(&self, path: &str, message: String, accepted: String) {
        let diagnostic = self.source.key_diagnostic(path, message, accepted);
        self.found.borrow_mut().push(diagnostic);
    }

    /// Passes on what the library says of a value in the table at `path`.
    pub(crate) fn check<T>(&self, path: &str, result: Result<T, Error>) -> Option<T> {
        let refuse = |error: Error| self.found.borrow_mut().push(self.diagnostic(path, &error));
        result.map_err(refuse).ok()
    }

    /// Reads something of the table at `path` and has it checked. Where the library refuses a value, that is reported and it
    /// is read once more without that value, so that whatever else is wrong shows too.
    pub(crate) fn check_all<T>(&self, path: &str, mut read: impl FnMut() -> Result<T, Error>) -> Option<T> {
        let mut result = read();
        let is_sound = result.is_ok();
        while let Err(error) = &result {
            let diagnostic = self.diagnostic(path, error);
            let refused = diagnostic.field.clone();
            self.found.borrow_mut().push(diagnostic);
            if !self.source.has(&refused) || self.is_refused(&refused) {
                return None;
            }
            self.refused.borrow_mut().push(refused);
            result = read();
        }
        result.ok().filter(|_| is_sound)
    }

    /// Whether the value at a path, or an element of it, was refused.
    fn is_refused(&self, path: &str) -> bool {
        let is_within =
            |refused: &String| refused.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        self.refused.borrow().iter().any(is_within)
    }

    /// What the library says of a value in the table at `path`.
    pub(crate) fn diagnostic(&self, path: &str, error: &Error) -> Diagnostic {
        let (message, accepted) = in_words(error);
        // The parameters of a fluid are fields of its table.
        let field = error.field().strip_prefix("fluid.").unwrap_or(error.field());
        self.source.diagnostic(&join(path, field), message, accepted)
    }
}

/// A type that fields have.
pub(crate) trait Read: Sized {
    /// What is accepted, in words.
    fn accepted() -> String;

    /// What it looks like.
    fn shape() -> Shape;

    /// The value as a file would have it.
    fn written(&self) -> String;

    /// Reads the value at `path`; reports what is wrong with it.
    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self>;
}

/// Says that the value is not of this type.
pub(crate) fn mismatch<T: Read>(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<T> {
    let found = match value.get_ref() {
        DeValue::String(text) => format!("is the string \"{}\"", text.chars().take(40).collect::<String>()),
        DeValue::Integer(number) => format!("is {number}"),
        DeValue::Float(number) => format!("is {number}"),
        DeValue::Array(array) => format!("is an array of {}", array.len()),
        other => format!("is a {}", other.type_str()),
    };
    report.refuse(path, found, T::accepted());
    None
}

impl Read for f32 {
    fn accepted() -> String {
        "a number".to_owned()
    }

    fn shape() -> Shape {
        Shape::Number
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        let number = match value.get_ref() {
            DeValue::Float(number) => number.as_str().parse::<f64>().ok(),
            DeValue::Integer(number) => {
                i64::from_str_radix(number.as_str(), number.radix()).ok().map(|whole| whole as f64)
            }
            _ => None,
        };
        number.map(|number| number as Self).or_else(|| mismatch(value, path, report))
    }
}

impl Read for u64 {
    fn accepted() -> String {
        format!("a whole number, 0 to {}", i64::MAX)
    }

    fn shape() -> Shape {
        Shape::Whole(i64::MAX as Self)
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        let whole = value.get_ref().as_integer();
        let whole = whole.and_then(|number| i64::from_str_radix(number.as_str(), number.radix()).ok());
        whole.and_then(|whole| whole.try_into().ok()).or_else(|| mismatch(value, path, report))
    }
}

impl Read for u32 {
    fn accepted() -> String {
        format!("a whole number, 0 to {}", Self::MAX)
    }

    fn shape() -> Shape {
        Shape::Whole(Self::MAX.into())
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        let whole = value.get_ref().as_integer();
        let whole = whole.and_then(|number| Self::from_str_radix(number.as_str(), number.radix()).ok());
        whole.or_else(|| mismatch(value, path, report))
    }
}

impl Read for bool {
    fn accepted() -> String {
        "true or false".to_owned()
    }

    fn shape() -> Shape {
        Shape::Boolean
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        value.get_ref().as_bool().or_else(|| mismatch(value, path, report))
    }
}

impl Read for String {
    fn accepted() -> String {
        "a string in quotes".to_owned()
    }

    fn shape() -> Shape {
        Shape::Text
    }

    fn written(&self) -> String {
        format!("{self:?}")
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        value.get_ref().as_str().map(str::to_owned).or_else(|| mismatch(value, path, report))
    }
}

impl<T: Read> Read for Vec<T> {
    fn accepted() -> String {
        format!("an array, of each: {}", T::accepted())
    }

    fn shape() -> Shape {
        Shape::list(T::shape())
    }

    fn written(&self) -> String {
        format!("[{}]", self.iter().map(T::written).collect::<Vec<_>>().join(", "))
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        let Some(array) = value.get_ref().as_array() else {
            return mismatch(value, path, report);
        };
        let elements = array.iter().enumerate();
        elements.map(|(index, element)| T::read(element, &join(path, &index.to_string()), report)).collect()
    }
}

impl<T: Read, const N: usize> Read for [T; N] {
    fn accepted() -> String {
        let names: Vec<String> = ('a'..).take(N).map(String::from).collect();
        format!("[{}], of each: {}", names.join(", "), T::accepted())
    }

    fn shape() -> Shape {
        Shape::array(T::shape(), N)
    }

    fn written(&self) -> String {
        format!("[{}]", self.iter().map(T::written).collect::<Vec<_>>().join(", "))
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        match value.get_ref().as_array().map(|array| array.len()) {
            Some(count) if count == N => Vec::read(value, path, report)?.try_into().ok(),
            _ => mismatch(value, path, report),
        }
    }
}

impl Read for Vec2 {
    fn accepted() -> String {
        "[x, y], two numbers".to_owned()
    }

    fn shape() -> Shape {
        Shape::array(Shape::Number, 2)
    }

    fn written(&self) -> String {
        self.to_array().written()
    }

    fn read(value: &Value<'_>, path: &str, report: &Report<'_>) -> Option<Self> {
        match value.get_ref().as_array().map(|array| array.len()) {
            Some(2) => <[f32; 2]>::read(value, path, report).map(Self::from),
            _ => mismatch(value, path, report),
        }
    }
}

/// One table that is being read.
#[derive(Debug)]
pub(crate) struct Fields<'a> {
    /// Not there if the file has no such table, or something else in its place.
    table: Option<&'a DeTable<'a>>,
    /// Something else is in its place, which is reported already.
    is_broken: bool,
    pub path: String,
    asked: Vec<&'static str>,
    pub report: &'a Report<'a>,
}

impl<'a> Fields<'a> {
    pub(crate) fn root(table: &'a DeTable<'a>, report: &'a Report<'a>) -> Self {
        Self::new(Some(table), false, String::new(), report)
    }

    fn of(value: &'a Value<'a>, path: String, report: &'a Report<'a>) -> Self {
        let table = value.get_ref().as_table();
        if table.is_none() {
            report.refuse(&path, format!("is a {}", value.get_ref().type_str()), "a table");
        }
        Self::new(table, table.is_none(), path, report)
    }

    fn new(table: Option<&'a DeTable<'a>>, is_broken: bool, path: String, report: &'a Report<'a>) -> Self {
        let asked = Vec::new();
        Self { table, is_broken, path, asked, report }
    }

    /// Path of a field.
    pub(crate) fn at(&self, field: &str) -> String {
        join(&self.path, field)
    }

    fn ask(&mut self, field: &'static str) -> Option<&'a Value<'a>> {
        if !self.asked.contains(&field) {
            self.asked.push(field);
        }
        let value = self.table.and_then(|table| table.get(field))?;
        let is_refused = !value.get_ref().is_table() && self.report.is_refused(&self.at(field));
        (!is_refused).then_some(value)
    }

    /// Reads a field of which the default is noted.
    fn read<T: Read>(&mut self, field: &'static str, is_required: bool, default: Option<&T>) -> Option<T> {
        let entry = || Entry::Value { shape: T::shape(), is_required, default: default.map(T::written) };
        self.report.note(self.at(field), entry);
        let value = self.ask(field)?;
        T::read(value, &self.at(field), self.report)
    }

    /// Whether the field is there.
    pub(crate) fn has(&self, field: &str) -> bool {
        self.table.is_some_and(|table| table.contains_key(field))
    }

    /// The field, if it is there.
    pub(crate) fn get<T: Read>(&mut self, field: &'static str) -> Option<T> {
        self.read(field, false, None)
    }

    /// The field, or a default.
    pub(crate) fn or<T: Read>(&mut self, field: &'static str, default: T) -> T {
        self.read(field, false, Some(&default)).unwrap_or(default)
    }

    /// Reports that a field is not there, if it is not.
    pub(crate) fn require(&self, field: &str, accepted: &str) {
        if !self.is_broken && !self.has(field) {
            self.report.refuse(&self.at(field), format!("missing field `{field}`"), accepted);
        }
    }

    /// The field. Where it is missing, that is reported.
    pub(crate) fn required<T: Read>(&mut self, field: &'static str) -> Option<T> {
        self.require(field, &T::accepted());
        self.read(field, true, None)
    }

    /// A number within a range, or a default within it.
    pub(crate) fn number(&mut self, field: &'static str, default: f32, range: [f32; 2]) -> f32 {
        let value = self.or(field, default);
        if self.is_within(field, value, range) { value } else { default }
    }

    /// Whether the field's value is within a range; reports it if it is not.
    pub(crate) fn is_within(&self, field: &str, value: f32, [low, high]: [f32; 2]) -> bool {
        let is_within = (low..=high).contains(&value);
        if !is_within {
            let message = format!("{value} is out of range");
            self.report.refuse(&self.at(field), message, format!("{low} to {high}"));
        }
        is_within
    }

    /// A table of this table; where it is missing, one without fields.
    pub(crate) fn table(&mut self, field: &'static str) -> Self {
        let path = self.at(field);
        self.report.note(path.clone(), || Entry::Table);
        match self.ask(field) {
            Some(value) => Self::of(value, path, self.report),
            None => Self::new(None, false, path, self.report),
        }
    }

    /// The tables `[field.NAME]`, each with its name.
    pub(crate) fn named(&mut self, field: &'static str) -> Vec<(String, Self)> {
        let tables = self.table(field);
        if self.report.notes.is_some() {
            let path = tables.at(Note::ANY);
            self.report.note(path.clone(), || Entry::Table);
            return vec![(Note::ANY.to_owned(), Self::new(None, false, path, self.report))];
        }
        let mut named = Vec::new();
        for (key, value) in tables.table.into_iter().flatten() {
            let path = tables.at(key.get_ref());
            if !is_name(key.get_ref()) {
                self.report.refuse_key(&path, "not a usable name".to_owned(), NAME.to_owned());
            }
            named.push((key.get_ref().to_string(), Self::of(value, path, self.report)));
        }
        named
    }

    /// The tables `[[field]]`.
    pub(crate) fn list(&mut self, field: &'static str) -> Vec<Self> {
        let path = self.at(field);
        self.report.note(path.clone(), || Entry::Tables);
        if self.report.notes.is_some() {
            return vec![Self::new(None, false, join(&path, Note::ANY), self.report)];
        }
        let Some(value) = self.ask(field) else {
            return Vec::new();
        };
        let Some(array) = value.get_ref().as_array() else {
            self.report.refuse(&path, format!("is a {}", value.get_ref().type_str()), format!("[[{field}]] tables"));
            return Vec::new();
        };
        let entry = |(index, value)| Self::of(value, join(&path, &format!("{index}")), self.report);
        array.iter().enumerate().map(entry).collect()
    }

    /// Refuses what was not asked for.
    pub(crate) fn finish(self) {
        let keys = self.table.into_iter().flat_map(DeTable::keys).map(|key| key.get_ref().as_ref());
        for key in keys.filter(|key| !self.asked.contains(key)) {
            let (message, accepted) = unknown("field", key, &self.asked);
            self.report.refuse_key(&self.at(key), message, accepted);
        }
    }
}
