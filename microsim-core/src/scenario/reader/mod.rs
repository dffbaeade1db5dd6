//! The reader of TOML text: values with their spans, overrides and parameters, fields by name and type.
//!
//! Which fields there are is said in [`sections`](super::sections).

mod context;
mod convert;
mod document;
mod entry;
mod fields;
mod name;
mod overrides;
mod parameters;
mod unknown_name;
mod value;
mod value_type;

pub(crate) use context::ReadContext;
pub(crate) use convert::{Keyword, Read, mismatch};
pub(crate) use document::Document;
pub use entry::Entry;
pub(crate) use entry::Note;
pub(crate) use fields::Fields;
pub(crate) use name::{NAME, is_name};
pub(crate) use value::{DEGREE, SpannedValue, join, without_spans};
pub use value_type::ValueType;
