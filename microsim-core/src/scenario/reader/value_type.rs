//! What values of a field look like: enough for an editor to check a file while it is being written.

/// The form of a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// `true` or `false`.
    Boolean,
    /// Any number.
    Number,
    /// A whole number from 0 to this.
    Whole(u64),
    /// Any string.
    Text,
    /// One of these words.
    Word(&'static [&'static str]),
    /// An array of so many values of one form; of any number without it.
    Array(Box<Self>, Option<usize>),
    /// A table of any names, with a value of one form each.
    Table(Box<Self>),
    /// Any of these.
    Either(Vec<Self>),
}

impl Shape {
    /// An array of so many.
    pub(crate) fn array(of: Self, count: usize) -> Self {
        Self::Array(Box::new(of), Some(count))
    }

    /// An array of any length.
    pub(crate) fn list(of: Self) -> Self {
        Self::Array(Box::new(of), None)
    }

    /// A value of this form, as a file would have it, that is a number or consists of numbers far beyond any range; `None`
    /// for what has no range.
    pub(crate) fn extreme(&self) -> Option<String> {
        match self {
            Self::Number => Some("1e30".to_owned()),
            Self::Whole(_) => Some(u32::MAX.to_string()),
            Self::Array(of, Some(length)) => Some(format!("[{}]", vec![of.extreme()?; *length].join(", "))),
            Self::Either(shapes) => shapes.iter().find_map(Self::extreme),
            _ => None,
        }
    }
}
