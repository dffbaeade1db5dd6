//! `schema`: the JSON Schema of scenario files, made from the descriptions of their fields.

use crate::console::print;
use crate::failure::Failure;
use microsim_core::scenario::{Description, Entry, ValueType, describe};
use serde_json::{Map, Value, json};

/// Names of prototypes, controllers and parameters.
const NAME: &str = "^[A-Za-z0-9_-]{1,64}$";

pub(crate) fn schema() -> Result<(), Failure> {
    Ok(print(text())?)
}

/// The schema as a file.
pub(crate) fn text() -> String {
    let fields = describe();
    let mut schema = object("", &fields);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("microsim scenario");
    schema["definitions"] = json!({
        "parameter": { "type": "string", "pattern": "^\\$[A-Za-z0-9_-]{1,64}$", "description": "The value of a parameter." }
    });
    schema["properties"]["parameters"]["additionalProperties"] = json!({ "type": ["number", "string", "boolean"] });
    format!("{schema:#}\n")
}

/// The table at a path.
fn object(path: &str, fields: &[Description]) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    let mut schema = json!({ "type": "object", "additionalProperties": false });
    for field in fields {
        let (parent, name) = field.path.rsplit_once('.').unwrap_or(("", &field.path));
        if parent != path {
            continue;
        }
        let value = schema_of(field, fields);
        if name == "*" {
            schema["patternProperties"] = json!({ NAME: value });
            continue;
        }
        properties.insert(name.to_owned(), value);
        if matches!(field.entry, Entry::Value { is_required: true, .. }) {
            required.push(name);
        }
    }
    if !properties.is_empty() {
        schema["properties"] = properties.into();
    }
    if !required.is_empty() {
        schema["required"] = required.into();
    }
    schema
}

fn schema_of(field: &Description, fields: &[Description]) -> Value {
    let mut schema = match &field.entry {
        Entry::Table => object(&field.path, fields),
        Entry::Tables => json!({ "type": "array", "items": object(&format!("{}.*", field.path), fields) }),
        Entry::Value { value_type, default, .. } => value(field, value_type, default.as_deref()),
    };
    if schema.get("description").is_none() {
        schema["description"] = field.words.into();
    }
    schema
}

fn value(field: &Description, value_type: &ValueType, default: Option<&str>) -> Value {
    let accepted = field.accepted.as_deref().unwrap_or_default();
    let mut schema =
        json!({ "anyOf": [type_schema(value_type, range(accepted)), { "$ref": "#/definitions/parameter" }] });
    if !accepted.is_empty() {
        schema["description"] = format!("{} Accepted: {accepted}.", field.words).into();
    }
    // Values in TOML are JSON too.
    if let Some(default) = default.and_then(|text| serde_json::from_str::<Value>(text).ok()) {
        schema["default"] = default;
    }
    schema
}

/// Least and greatest number of `0.1 to 20`.
fn range(accepted: &str) -> Option<[f64; 2]> {
    if let Ok(only) = accepted.parse() {
        return Some([only, only]);
    }
    let (low, high) = accepted.split_once(" to ")?;
    Some([low.parse().ok()?, high.parse().ok()?])
}

fn type_schema(value_type: &ValueType, range: Option<[f64; 2]>) -> Value {
    let ranged = |mut schema: Value| {
        if let Some([low, high]) = range {
            schema["minimum"] = number(low);
            schema["maximum"] = number(high);
        }
        schema
    };
    match value_type {
        ValueType::Boolean => json!({ "type": "boolean" }),
        ValueType::Text => json!({ "type": "string" }),
        ValueType::Number => ranged(json!({ "type": "number" })),
        ValueType::Whole(most) => {
            let whole = json!({ "type": "integer", "minimum": 0, "maximum": most });
            ranged(whole)
        }
        ValueType::Word(words) => json!({ "enum": words }),
        ValueType::Array(of, None) => json!({ "type": "array", "items": type_schema(of, range) }),
        ValueType::Array(of, Some(length)) => {
            json!({ "type": "array", "items": type_schema(of, range), "minItems": length, "maxItems": length })
        }
        ValueType::List(of, [least, most]) => {
            json!({ "type": "array", "items": type_schema(of, range), "minItems": least, "maxItems": most })
        }
        ValueType::Table(of) => json!({ "type": "object", "additionalProperties": type_schema(of, range) }),
        ValueType::Either(types) => {
            json!({ "anyOf": types.iter().map(|of| type_schema(of, range)).collect::<Vec<_>>() })
        }
    }
}

/// Whole numbers without a fraction.
fn number(value: f64) -> Value {
    if value.fract() == 0.0 && value.abs() < 1e15 { json!(value as i64) } else { json!(value) }
}
