//! Fields of a spec: name, meaning and range, declared once. Checks and scenario files visit the same fields.

use crate::error::{Error, count_in_range, in_range};
use glam::Vec2;

/// What a field of a spec is called and means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpecField {
    /// Its name.
    pub name: &'static str,
    /// What it means, with its unit, in a line; lengths are in micrometres. Empty without the feature `schema`.
    pub words: &'static str,
    /// Whether a scenario file has to state it.
    pub is_required: bool,
}

/// The value of a field, to be read or changed, with the least and the greatest value that are accepted.
#[non_exhaustive]
#[allow(missing_debug_implementations, reason = "a function has none")]
pub enum FieldValue<'a> {
    /// A number.
    Number(&'a mut f32, [f32; 2]),
    /// A whole number.
    Count(&'a mut u32, [u32; 2]),
    /// A vector; the range is that of each component.
    Vector(&'a mut Vec2, [f32; 2]),
    /// Three numbers; the range is that of each.
    Triple(&'a mut [f32; 3], [f32; 2]),
    /// One of several words, by its index.
    Word(&'a mut usize, &'static [&'static str]),
    /// A table: shows its fields to a visitor.
    Table(&'a mut dyn FnMut(&mut FieldVisitor<'_>)),
}

/// Is shown every field of a spec.
pub type FieldVisitor<'v> = dyn FnMut(SpecField, FieldValue<'_>) + 'v;

/// A field with a default. Inlined, so that programs without the feature `schema` do not hold the words.
#[inline(always)]
pub(crate) const fn field(name: &'static str, words: &'static str) -> SpecField {
    SpecField { name, words: if cfg!(feature = "schema") { words } else { "" }, is_required: false }
}

/// A field that a scenario file has to state.
#[inline(always)]
pub(crate) const fn required(name: &'static str, words: &'static str) -> SpecField {
    SpecField { is_required: true, ..field(name, words) }
}

/// Checks that all fields of a spec are within their ranges; names the first that is not.
pub(crate) fn check<T>(mut spec: T, fields: impl FnOnce(&mut T, &mut FieldVisitor<'_>)) -> Result<(), Error> {
    let mut result = Ok(());
    fields(&mut spec, &mut |field, value| {
        if result.is_ok() {
            result = check_field(field.name, value);
        }
    });
    result
}

fn check_field(name: &str, value: FieldValue<'_>) -> Result<(), Error> {
    match value {
        FieldValue::Number(value, [low, high]) => in_range(name, *value, low, high),
        FieldValue::Count(value, [low, high]) => count_in_range(name, *value, low, high),
        FieldValue::Vector(value, [low, high]) => {
            in_range(&format!("{name}.x"), value.x, low, high)?;
            in_range(&format!("{name}.y"), value.y, low, high)
        }
        FieldValue::Triple(value, [low, high]) => {
            (0..3).try_for_each(|k| in_range(&format!("{name}[{k}]"), value[k], low, high))
        }
        FieldValue::Word(..) => Ok(()),
        FieldValue::Table(fields) => check(fields, |fields, visit| fields(visit)).map_err(|error| error.within(name)),
    }
}
