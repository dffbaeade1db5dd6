//! The format described: every field that the reader asks for, as the reader asks for it.
//!
//! Nothing here names a field. The reader is run over an empty file and notes what it asks for; ranges are what it accepts
//! instead of a number that is out of any range. So neither the description nor the JSON Schema made from it can say
//! anything but what is true of the reader. Only the words of explanation stand in a list of their own, `explanations.rs`, and a
//! test compares that with the fields.

use super::reader::document::Source;
use super::reader::fields::Report;
use super::reader::value_type::Shape;
use super::{Scenario, explanations, file};
use toml::de::DeTable;

/// One field or table of the format.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Dotted path; `*` stands for any name, or for each of several tables: `agar.*.radius`, `spawn.*.at`.
    pub path: String,
    /// What stands there.
    pub entry: Entry,
    /// The values that are accepted, in words; `None` where any of its form is, or where it depends on other fields.
    pub accepted: Option<String>,
    /// What it means.
    pub words: &'static str,
}

/// What stands at a path.
#[derive(Clone, Debug, PartialEq)]
pub enum Entry {
    /// A table.
    Table,
    /// Any number of tables, `[[...]]`.
    Tables,
    /// A value.
    Value {
        /// Its form.
        shape: Shape,
        /// Whether it has to be there.
        is_required: bool,
        /// What it is where a file does not say, as a file would say it; `None` where that is not one value.
        default: Option<String>,
    },
}

/// A field that was asked for.
#[derive(Debug, PartialEq)]
pub(super) struct Note {
    pub path: String,
    pub entry: Entry,
}

impl Note {
    /// Stands for any name and any index in a path.
    pub(super) const ANY: &'static str = "*";

    /// What is accepted here in place of a number beyond any range.
    fn accepted(&self, is_list: impl Fn(&str) -> bool) -> Option<String> {
        let Entry::Value { shape, .. } = &self.entry else {
            return None;
        };
        let (table, field) = self.path.split_once(".*.").unwrap_or(("", &self.path));
        let (text, path) = match table {
            "" => (String::new(), field.to_owned()),
            _ if is_list(table) => (format!("[[{table}]]\n"), format!("{table}.0.{field}")),
            _ => (format!("[{table}.x]\n"), format!("{table}.x.{field}")),
        };
        let text = format!("{text}{field} = {}\n", shape.extreme()?);
        let problems = Scenario::parse(&text, &[]).err()?;
        let is_here = |at: &str| at.strip_prefix(&path).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        problems.iter().find(|problem| is_here(&problem.field))?.accepted.clone()
    }
}

/// Describes the format, in the order in which a file is read.
#[must_use]
pub fn describe() -> Vec<Description> {
    let source = Source::default();
    let report = Report::describing(&source);
    file::read_root(&DeTable::new(), &report);
    let notes = report.notes.map(std::cell::RefCell::into_inner).unwrap_or_default();
    let is_list = |path: &str| notes.iter().any(|note| note.path == path && note.entry == Entry::Tables);
    let accepted: Vec<_> = notes.iter().map(|note| note.accepted(is_list)).collect();
    let described = notes.into_iter().zip(accepted);
    let described = described.map(|(Note { path, entry }, accepted)| {
        let words = explanations::of(&path).unwrap_or_default();
        Description { path, entry, accepted, words }
    });
    described.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(path: &str) -> Description {
        describe().into_iter().find(|description| description.path == path).unwrap_or_else(|| panic!("no {path}"))
    }

    #[test]
    fn fields_have_the_form_the_default_and_the_range_that_the_reader_knows() {
        let radius = find("agar.*.radius");
        assert_eq!(radius.entry, Entry::Value { shape: Shape::Number, is_required: true, default: None });
        assert_eq!(radius.accepted.as_deref(), Some("0.1 to 20"));
        let substeps = find("step.substeps");
        let default = Some("8".to_owned());
        let shape = Shape::Whole(u32::MAX.into());
        assert_eq!(substeps.entry, Entry::Value { shape, is_required: false, default });
        assert_eq!(substeps.accepted.as_deref(), Some("1 to 64"));
        assert_eq!(find("spawn").entry, Entry::Tables);
        assert_eq!(find("amoeboid_cell.*.phagocytosis.time_limit").accepted.as_deref(), Some("0.1 to 60"));
        assert_eq!(find("disc.*.at").accepted.as_deref(), Some("-20000 to 20000"));
    }

    #[test]
    fn every_field_is_explained_and_nothing_else_is() {
        let described = describe();
        let missing: Vec<_> =
            described.iter().filter(|field| field.words.is_empty()).map(|field| &field.path).collect();
        assert!(missing.is_empty(), "no words for {missing:#?}");
        let is_field = |path: &str| described.iter().any(|field| field.path == path);
        let stray: Vec<_> = explanations::paths().filter(|path| !is_field(path)).collect();
        assert!(stray.is_empty(), "words for fields that there are not: {stray:#?}");
    }
}
