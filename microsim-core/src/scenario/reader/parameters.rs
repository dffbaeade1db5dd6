//! Parameters: the table `[parameters]`, whose values stand wherever the text says `"$name"`.

use super::name::{NAME, is_name};
use super::unknown_name::unknown;
use super::value::{SpannedValue, join};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

/// Most characters of a parameter that is a string: it may stand in many places.
const MAX_LENGTH: usize = 400;

/// Takes a refused value or key: where it stands, its path, the kind of problem, and what says what is wrong with it and what is
/// accepted.
type Refuse<'r> = &'r mut dyn FnMut(Range<usize>, &str, &str, &dyn Fn() -> (String, String));

/// Replaces every string `$name` outside `[parameters]` by that parameter.
pub(super) fn substitute(root: &mut SpannedValue<'_>, refuse: Refuse<'_>) {
    let parameters = parameters(root, refuse);
    substitute_in(root, "", &parameters, refuse);
}

/// The `[parameters]` table.
fn parameters<'a>(root: &SpannedValue<'a>, refuse: Refuse<'_>) -> BTreeMap<String, SpannedValue<'a>> {
    let Some(parameters) = root.get_ref().get("parameters") else {
        return BTreeMap::new();
    };
    let Some(table) = parameters.get_ref().as_table() else {
        let message = "not a table";
        refuse(parameters.span(), "parameters", message, &|| (message.to_owned(), "a [parameters] table".to_owned()));
        return BTreeMap::new();
    };
    let mut parameters = BTreeMap::new();
    for (key, value) in table {
        let path = join("parameters", key.get_ref());
        if !is_name(key.get_ref()) {
            let message = "not a usable name";
            refuse(key.span(), &path, message, &|| (message.to_owned(), NAME.to_owned()));
        }
        let flaw = flaw(value);
        if let Some((message, accepted)) = &flaw {
            refuse(value.span(), &path, message, &|| (message.clone(), accepted.clone()));
        }
        let nothing = || Spanned::new(value.span(), DeValue::Boolean(false));
        let value = if flaw.is_some() { nothing() } else { value.clone() };
        parameters.insert(key.get_ref().to_string(), value);
    }
    parameters
}

/// Why a value cannot be a parameter, and what can.
fn flaw(value: &SpannedValue<'_>) -> Option<(String, String)> {
    if value.get_ref().is_table() || value.get_ref().is_array() {
        return Some(("not a single value".to_owned(), "a number, a string or a boolean".to_owned()));
    }
    let length = value.get_ref().as_str().map_or(0, |text| text.chars().count());
    (length > MAX_LENGTH).then(|| (format!("{length} characters"), format!("at most {MAX_LENGTH} characters")))
}

fn substitute_in<'a>(
    value: &mut SpannedValue<'a>,
    path: &str,
    parameters: &BTreeMap<String, SpannedValue<'a>>,
    refuse: Refuse<'_>,
) {
    let name = value.get_ref().as_str().and_then(|text| text.strip_prefix('$'));
    if let Some(name) = name.filter(|name| is_name(name)) {
        match parameters.get(name) {
            Some(parameter) => *value = parameter.clone(),
            None => {
                let describe = || unknown("parameter", name, parameters.keys().map(String::as_str));
                refuse(value.span(), path, "unknown parameter", &describe);
            }
        }
        return;
    }
    match value.get_mut() {
        DeValue::Table(table) => {
            let is_parameters = |key: &str| path.is_empty() && key == "parameters";
            for (key, child) in table.iter_mut().filter(|(key, _)| !is_parameters(key.get_ref())) {
                substitute_in(child, &join(path, key.get_ref()), parameters, refuse);
            }
        }
        DeValue::Array(array) => {
            for (index, child) in array.iter_mut().enumerate() {
                substitute_in(child, &join(path, &index.to_string()), parameters, refuse);
            }
        }
        _ => {}
    }
}
