//! Overrides: `key=value` pairs that change a scenario before it is read.

use super::unknown_name::unknown;
use super::value::SpannedValue;
use std::borrow::Cow;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Top-level fields that an override may set by their bare name.
const SETTABLE: [&str; 4] = ["name", "description", "seed", "duration"];
/// Tables that a path may name although the file does not have them.
const OPTIONAL: [&str; 7] = ["world", "step", "invariants", "output", "measures", "trajectories", "frames"];

/// Most parts of a path; no value lies as deep.
const MAX_PARTS: usize = 16;

/// What is wrong, and what would be accepted.
type Refusal = (String, String);

/// Sets one value by the name of a parameter or by its path. What is set stands at `span`.
pub(crate) fn apply<'a>(
    root: &mut SpannedValue<'a>,
    key: &'a str,
    text: &'a str,
    span: Range<usize>,
) -> Result<(), Refusal> {
    let path = path_of(root, key)?;
    let value = parse(text, &span)?;
    set(root, &path, value)
}

/// The path that a key means: a bare name is a parameter's before it is a field's.
fn path_of<'a>(root: &SpannedValue<'_>, key: &'a str) -> Result<Vec<&'a str>, Refusal> {
    let parameters = root.get_ref().get("parameters").and_then(|table| table.get_ref().as_table());
    let names: Vec<&str> =
        parameters.into_iter().flat_map(|table| table.keys()).map(|key| key.get_ref().as_ref()).collect();
    let name = key.strip_prefix("parameters.").unwrap_or(key);
    if names.contains(&name) {
        return Ok(vec!["parameters", name]);
    }
    let is_field = name == key && (key.contains('.') || SETTABLE.contains(&key));
    let parts = name.split('.').count();
    if is_field && parts > MAX_PARTS {
        return Err((format!("a path of {parts} parts"), format!("at most {MAX_PARTS}")));
    }
    if !is_field {
        let (message, accepted) = unknown("parameter", name, names.into_iter().chain(SETTABLE));
        return Err((message, format!("{accepted}, or a path such as world.damping")));
    }
    Ok(key.split('.').collect())
}

/// The value that TOML text means; bare words become strings.
fn parse<'a>(text: &'a str, span: &Range<usize>) -> Result<SpannedValue<'a>, Refusal> {
    let is_word = text.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == '$');
    let mut value = match DeValue::parse(text) {
        Ok(value) => value,
        Err(_) if is_word => Spanned::new(0..0, DeValue::String(Cow::Borrowed(text))),
        Err(error) => {
            let accepted = "a TOML value; bare words become strings".to_owned();
            return Err((error.message().to_owned(), accepted));
        }
    };
    move_to(&mut value, span);
    Ok(value)
}

/// Makes every part of a value stand at `span`.
fn move_to(value: &mut SpannedValue<'_>, span: &Range<usize>) {
    match value.get_mut() {
        DeValue::Table(table) => table.iter_mut().for_each(|(_, child)| move_to(child, span)),
        DeValue::Array(array) => array.iter_mut().for_each(|child| move_to(child, span)),
        _ => {}
    }
    let inner = std::mem::replace(value.get_mut(), DeValue::Boolean(false));
    *value = Spanned::new(span.clone(), inner);
}

/// Sets the value at a path.
fn set<'a>(parent: &mut SpannedValue<'a>, path: &[&'a str], value: SpannedValue<'a>) -> Result<(), Refusal> {
    let [part, rest @ ..] = path else {
        *parent = value;
        return Ok(());
    };
    let child = match parent.get_mut() {
        DeValue::Table(table) => {
            let may_be_new = rest.is_empty() || OPTIONAL.contains(part);
            entry(table, part, may_be_new, value.span())?
        }
        DeValue::Array(array) => {
            let last = array.len().saturating_sub(1);
            let index = part.parse().unwrap_or(usize::MAX);
            let missing = || (format!("there is no entry `{part}`"), format!("0 to {last}"));
            array.get_mut(index).ok_or_else(missing)?
        }
        other => {
            let message = format!("a {} has no part `{part}`", other.type_str());
            return Err((message, "the path of a value in the file".to_owned()));
        }
    };
    set(child, rest, value)
}

fn entry<'t, 'a>(
    table: &'t mut DeTable<'a>,
    key: &'a str,
    may_be_new: bool,
    span: Range<usize>,
) -> Result<&'t mut SpannedValue<'a>, Refusal> {
    if may_be_new && !table.contains_key(key) {
        let nothing = Spanned::new(span.clone(), DeValue::Table(DeTable::new()));
        table.insert(Spanned::new(span, Cow::Borrowed(key)), nothing);
    }
    let known: Vec<String> = table.keys().map(|key| key.get_ref().to_string()).collect();
    let missing = || unknown("part", key, known.iter().map(String::as_str));
    table.get_mut(key).ok_or_else(missing)
}
