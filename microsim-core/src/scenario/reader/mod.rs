//! The reader of TOML text: values with their places in it, overrides and parameters, fields by name and type.
//!
//! Nothing here knows a field of the format: see [`sections`](super::sections).

pub(crate) mod document;
pub(crate) mod fields;
mod overrides;
pub(crate) mod value_type;
