//! Values of a TOML text, and dotted paths to them.

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

/// A value and where it stands.
pub(crate) type SpannedValue<'a> = Spanned<DeValue<'a>>;

/// A degree in radians: files hold degrees.
pub(crate) const DEGREE: f32 = std::f32::consts::PI / 180.0;

/// Extends a dotted path.
pub(crate) fn join(path: &str, last: &str) -> String {
    if path.is_empty() { last.to_owned() } else { format!("{path}.{last}") }
}

/// The tree of values without what only a reader of the text needs.
pub(crate) fn without_spans(table: &DeTable<'_>) -> Table {
    table.iter().map(|(key, child)| (key.get_ref().to_string(), value(child.get_ref()))).collect()
}

fn value(of: &DeValue<'_>) -> Value {
    match of {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Integer(number) => {
            i64::from_str_radix(number.as_str(), number.radix()).map_or(Value::Boolean(false), Value::Integer)
        }
        DeValue::Float(number) => number.as_str().parse().map_or(Value::Boolean(false), Value::Float),
        DeValue::Boolean(is_so) => Value::Boolean(*is_so),
        DeValue::Datetime(time) => Value::Datetime(*time),
        DeValue::Array(array) => Value::Array(array.iter().map(|child| value(child.get_ref())).collect()),
        DeValue::Table(table) => Value::Table(without_spans(table)),
    }
}
