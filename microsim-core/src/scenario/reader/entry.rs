//! What the reader asks for: a field or table at a path.

use super::value_type::ValueType;

/// What stands at a path.
#[derive(Clone, Debug, PartialEq)]
pub enum Entry {
    /// A table.
    Table,
    /// Any number of tables, `[[...]]`.
    Tables,
    /// A value.
    Value {
        /// Its type.
        value_type: ValueType,
        /// Whether it has to be there.
        is_required: bool,
        /// What it is where a file does not say, as a file would say it; `None` where that is not one value.
        default: Option<String>,
    },
}

/// A field that was asked for.
#[derive(Debug, PartialEq)]
pub(crate) struct Note {
    pub path: String,
    pub entry: Entry,
}

impl Note {
    /// Stands for any name and any index in a path.
    pub(crate) const ANY: &'static str = "*";
}
