//! Types of values: enough for an editor to check a file while it is being written.

/// The type of a value.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueType {
    /// `true` or `false`.
    Boolean,
    /// Any number.
    Number,
    /// A whole number from 0 to this.
    Whole(u64),
    /// Any string.
    Text,
    /// One of these words.
    Word(Vec<&'static str>),
    /// An array of so many values of one type; of any number without it.
    Array(Box<Self>, Option<usize>),
    /// An array of at least and at most so many values of one type.
    List(Box<Self>, [usize; 2]),
    /// A table of any names, with a value of one type each.
    Table(Box<Self>),
    /// Any of these.
    Either(Vec<Self>),
}

impl ValueType {
    /// An array of so many.
    pub(crate) fn array(of: Self, count: usize) -> Self {
        Self::Array(Box::new(of), Some(count))
    }

    /// An array of any length.
    pub(crate) fn list(of: Self) -> Self {
        Self::Array(Box::new(of), None)
    }

    /// A value of this type, as a file would have it, that is a number or consists of numbers far beyond any range; `None`
    /// for what has no range.
    pub(crate) fn extreme(&self) -> Option<String> {
        match self {
            Self::Number => Some("1e30".to_owned()),
            Self::Whole(_) => Some(u32::MAX.to_string()),
            Self::Array(of, Some(length)) => Some(format!("[{}]", vec![of.extreme()?; *length].join(", "))),
            Self::Either(types) => types.iter().find_map(Self::extreme),
            _ => None,
        }
    }
}
