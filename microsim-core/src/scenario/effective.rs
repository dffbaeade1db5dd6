//! The scenario that is run, as text: overrides and parameters put in, keys in order.

use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

/// The tree of values without what only a reader of the text needs.
pub(super) fn table(table: &DeTable<'_>) -> Table {
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
        DeValue::Table(table) => Value::Table(self::table(table)),
    }
}
