//! Fields of a table: every one is asked for by name and type, and what nobody asked for is refused.
//!
//! Reading goes on after an error with a value that makes sense, so that one pass finds all that is wrong. What is asked
//! for is also the description of the format: see [`describe`](crate::scenario::describe()).

use super::context::ReadContext;
use super::convert::{Read, one_of, refuse_value};
use super::entry::{Entry, Note};
use super::name::{NAME, is_name};
use super::value::{SpannedValue, join};
use super::value_type::ValueType;
use toml::de::DeTable;

/// One table that is being read.
#[derive(Debug)]
pub(crate) struct Fields<'a> {
    /// Not there if the file has no such table, or something else in its place.
    table: Option<&'a DeTable<'a>>,
    /// Something else is in its place, which is reported already.
    is_broken: bool,
    pub path: String,
    asked: Vec<&'static str>,
    pub context: &'a ReadContext<'a>,
}

impl<'a> Fields<'a> {
    pub(crate) fn root(table: &'a DeTable<'a>, context: &'a ReadContext<'a>) -> Self {
        Self::new(Some(table), false, String::new(), context)
    }

    fn of(value: &'a SpannedValue<'a>, path: String, context: &'a ReadContext<'a>) -> Self {
        let table = value.get_ref().as_table();
        if table.is_none() {
            context.refuse(&path, format!("is a {}", value.get_ref().type_str()), "a table");
        }
        Self::new(table, table.is_none(), path, context)
    }

    fn new(table: Option<&'a DeTable<'a>>, is_broken: bool, path: String, context: &'a ReadContext<'a>) -> Self {
        let asked = Vec::new();
        Self { table, is_broken, path, asked, context }
    }

    /// Path of a field.
    pub(crate) fn at(&self, field: &str) -> String {
        join(&self.path, field)
    }

    /// Refuses the value of a field.
    pub(crate) fn refuse(&self, field: &str, message: impl Into<String>, accepted: impl Into<String>) {
        self.context.refuse(&self.at(field), message, accepted);
    }

    /// Refuses the value of a field: a name that is none of those known.
    pub(crate) fn refuse_unknown<'n>(
        &self,
        field: &str,
        what: &str,
        name: &str,
        known: impl IntoIterator<Item = &'n str>,
    ) {
        self.context.refuse_unknown(&self.at(field), what, name, known);
    }

    fn ask(&mut self, field: &'static str) -> Option<&'a SpannedValue<'a>> {
        if !self.asked.contains(&field) {
            self.asked.push(field);
        }
        let value = self.table.and_then(|table| table.get(field))?;
        let is_refused = !value.get_ref().is_table() && self.context.is_refused(&self.at(field));
        (!is_refused).then_some(value)
    }

    /// Reads a field of which the default is noted.
    fn read<T: Read>(&mut self, field: &'static str, is_required: bool, default: Option<&T>) -> Option<T> {
        let entry = || Entry::Value { value_type: T::value_type(), is_required, default: default.map(T::written) };
        self.context.note(self.at(field), entry);
        let value = self.ask(field)?;
        T::read(value, &self.at(field), self.context)
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

    /// One of several words, by its index, or a default.
    pub(crate) fn word(&mut self, field: &'static str, words: &[&'static str], default: usize) -> usize {
        let entry = || Entry::Value {
            value_type: ValueType::Word(words.to_vec()),
            is_required: false,
            default: words.get(default).map(|word| format!("{word:?}")),
        };
        self.context.note(self.at(field), entry);
        let Some(value) = self.ask(field) else { return default };
        let index = value.get_ref().as_str().and_then(|text| words.iter().position(|word| *word == text));
        if index.is_none() {
            refuse_value(value, &self.at(field), self.context, one_of(words.iter().copied()));
        }
        index.unwrap_or(default)
    }

    /// Reports that a field is not there, if it is not.
    pub(crate) fn require(&self, field: &str, accepted: &str) {
        if !self.is_broken && !self.has(field) {
            self.refuse(field, format!("missing field `{field}`"), accepted);
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

    /// A number within a range, if it is there.
    pub(crate) fn number_within(&mut self, field: &'static str, range: [f32; 2]) -> Option<f32> {
        self.get(field).filter(|&value| self.is_within(field, value, range))
    }

    /// Whether the field's value is within a range; reports it if it is not.
    pub(crate) fn is_within(&self, field: &str, value: f32, [low, high]: [f32; 2]) -> bool {
        let is_within = (low..=high).contains(&value);
        if !is_within {
            self.refuse(field, format!("{value} is out of range"), format!("{low} to {high}"));
        }
        is_within
    }

    /// A table of this table; where it is missing, one without fields.
    pub(crate) fn table(&mut self, field: &'static str) -> Self {
        let path = self.at(field);
        self.context.note(path.clone(), || Entry::Table);
        match self.ask(field) {
            Some(value) => Self::of(value, path, self.context),
            None => Self::new(None, false, path, self.context),
        }
    }

    /// The tables `[field.NAME]`, each with its name.
    pub(crate) fn named(&mut self, field: &'static str) -> Vec<(String, Self)> {
        let tables = self.table(field);
        if self.context.notes.is_some() {
            let path = tables.at(Note::ANY);
            self.context.note(path.clone(), || Entry::Table);
            return vec![(Note::ANY.to_owned(), Self::new(None, false, path, self.context))];
        }
        let mut named = Vec::new();
        for (key, value) in tables.table.into_iter().flatten() {
            let path = tables.at(key.get_ref());
            if !is_name(key.get_ref()) {
                self.context.refuse_key(&path, "not a usable name", NAME);
            }
            named.push((key.get_ref().to_string(), Self::of(value, path, self.context)));
        }
        named
    }

    /// The tables `[[field]]`.
    pub(crate) fn list(&mut self, field: &'static str) -> Vec<Self> {
        let path = self.at(field);
        self.context.note(path.clone(), || Entry::Tables);
        if self.context.notes.is_some() {
            return vec![Self::new(None, false, join(&path, Note::ANY), self.context)];
        }
        let Some(value) = self.ask(field) else {
            return Vec::new();
        };
        let Some(array) = value.get_ref().as_array() else {
            self.context.refuse(&path, format!("is a {}", value.get_ref().type_str()), format!("[[{field}]] tables"));
            return Vec::new();
        };
        let entry = |(index, value)| Self::of(value, join(&path, &format!("{index}")), self.context);
        array.iter().enumerate().map(entry).collect()
    }

    /// Refuses what was not asked for, in the order of the text.
    pub(crate) fn finish(self) {
        let keys = self.table.into_iter().flat_map(DeTable::keys);
        let mut others: Vec<_> = keys.filter(|key| !self.asked.contains(&key.get_ref().as_ref())).collect();
        others.sort_by_key(|key| key.span().start);
        for key in others.into_iter().map(|key| key.get_ref().as_ref()) {
            self.context.refuse_unknown_key(&self.at(key), "field", key, self.asked.iter().copied());
        }
    }
}
