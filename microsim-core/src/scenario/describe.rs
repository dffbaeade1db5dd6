//! A description of the format, made by the reader: a JSON Schema is made from it.
//!
//! The reader runs over an empty file and notes what it asks for; ranges are those that it names when it refuses a number
//! beyond any range. What fields mean stands in `explanations.rs`; a test compares that with the fields.

use super::{explanations, file};
use crate::scenario::reader::{Document, Entry, Note, ReadContext, ValueType};
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
    /// What it means; empty for most without the feature `schema`.
    pub words: &'static str,
}

/// Describes the format, in the order in which a file is read.
#[must_use]
pub fn describe() -> Vec<Description> {
    let document = Document::default();
    let context = ReadContext::describing(&document);
    file::read_root(&DeTable::new(), &context);
    let notes = context.notes.map(std::cell::RefCell::into_inner).unwrap_or_default();
    let is_list = |path: &str| notes.iter().any(|note| note.path == path && note.entry == Entry::Tables);
    let described = notes.iter().map(|Note { path, entry }| {
        let accepted = match entry {
            Entry::Value { value_type, .. } => accepted(path, value_type, is_list),
            _ => None,
        };
        let words = explanations::of(path).unwrap_or_default();
        Description { path: path.clone(), entry: entry.clone(), accepted, words }
    });
    described.collect()
}

/// The range that the reader names when it refuses a number beyond any range at a path.
fn accepted(path: &str, value_type: &ValueType, is_list: impl Fn(&str) -> bool) -> Option<String> {
    let (table, field) = path.split_once(".*.").unwrap_or(("", path));
    let (text, path) = match table {
        "" => (String::new(), field.to_owned()),
        _ if is_list(table) => (format!("[[{table}]]\n"), format!("{table}.0.{field}")),
        _ => (format!("[{table}.x]\n"), format!("{table}.x.{field}")),
    };
    let text = format!("{text}{field} = {}\n", value_type.extreme()?);
    let (table, document) = Document::read(&text, &[]).ok()?;
    let diagnostics = file::read(&table, &document).err()?;
    let is_here = |at: &str| at.strip_prefix(&path).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    diagnostics.iter().find(|diagnostic| is_here(&diagnostic.field))?.accepted.clone()
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
        assert_eq!(radius.entry, Entry::Value { value_type: ValueType::Number, is_required: true, default: None });
        assert_eq!(radius.accepted.as_deref(), Some("0.1 to 20"));
        let substeps = find("step.substeps");
        let default = Some("8".to_owned());
        let value_type = ValueType::Whole(u32::MAX.into());
        assert_eq!(substeps.entry, Entry::Value { value_type, is_required: false, default });
        assert_eq!(substeps.accepted.as_deref(), Some("1 to 64"));
        assert_eq!(find("spawn").entry, Entry::Tables);
        assert_eq!(find("amoeboid_cell.*.phagocytosis.time_limit").accepted.as_deref(), Some("0.1 to 60"));
        assert_eq!(find("disc.*.at").accepted.as_deref(), Some("-20000 to 20000"));
    }

    #[test]
    #[cfg_attr(not(feature = "schema"), ignore = "without the feature `schema` fields have no words")]
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
