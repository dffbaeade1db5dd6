//! Conversion of TOML values to the types of fields, and what is said of those types.

use super::context::ReadContext;
use super::value::{SpannedValue, join};
use super::value_type::ValueType;
use glam::Vec2;
use toml::de::DeValue;

/// A type that fields have.
pub(crate) trait Read: Sized {
    /// What is accepted, in words.
    fn accepted() -> String;

    /// What it looks like.
    fn value_type() -> ValueType;

    /// The value as a file would have it.
    fn written(&self) -> String;

    /// Reads the value at `path`; reports what is wrong with it.
    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self>;
}

/// Says that the value is not of this type.
pub(crate) fn mismatch<T: Read>(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<T> {
    refuse_value(value, path, context, T::accepted());
    None
}

/// Says what the value is, and what is accepted.
pub(super) fn refuse_value(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>, accepted: String) {
    let found = match value.get_ref() {
        DeValue::String(text) => format!("is the string \"{}\"", text.chars().take(40).collect::<String>()),
        DeValue::Integer(number) => format!("is {number}"),
        DeValue::Float(number) => format!("is {number}"),
        DeValue::Array(array) => format!("is an array of {}", array.len()),
        other => format!("is a {}", other.type_str()),
    };
    context.refuse(path, found, accepted);
}

/// What is accepted of several words.
pub(super) fn one_of(words: impl IntoIterator<Item = &'static str>) -> String {
    let words: Vec<String> = words.into_iter().map(|word| format!("{word:?}")).collect();
    let (last, others) = words.split_last().expect("a keyword has words");
    format!("{} or {last}", others.join(", "))
}

/// A type whose values are words.
pub(crate) trait Keyword: Copy + PartialEq + 'static {
    /// Every value and its word.
    const KEYWORDS: &'static [(&'static str, Self)];

    /// Its word.
    fn keyword(self) -> &'static str {
        Self::KEYWORDS.iter().find(|(_, value)| *value == self).map_or("", |(word, _)| word)
    }
}

impl<T: Keyword> Read for T {
    fn accepted() -> String {
        one_of(Self::KEYWORDS.iter().map(|(word, _)| *word))
    }

    fn value_type() -> ValueType {
        ValueType::Word(Self::KEYWORDS.iter().map(|(word, _)| *word).collect())
    }

    fn written(&self) -> String {
        format!("{:?}", self.keyword())
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let known = Self::KEYWORDS.iter().find(|(word, _)| value.get_ref().as_str() == Some(word));
        known.map(|(_, value)| *value).or_else(|| mismatch(value, path, context))
    }
}

impl Read for f32 {
    fn accepted() -> String {
        "a number".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::Number
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let number = match value.get_ref() {
            DeValue::Float(number) => number.as_str().parse::<f64>().ok(),
            DeValue::Integer(number) => {
                i64::from_str_radix(number.as_str(), number.radix()).ok().map(|whole| whole as f64)
            }
            _ => None,
        };
        number.map(|number| number as Self).or_else(|| mismatch(value, path, context))
    }
}

impl Read for u64 {
    fn accepted() -> String {
        format!("a whole number, 0 to {}", i64::MAX)
    }

    fn value_type() -> ValueType {
        ValueType::Whole(i64::MAX as Self)
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let whole = value.get_ref().as_integer();
        let whole = whole.and_then(|number| i64::from_str_radix(number.as_str(), number.radix()).ok());
        whole.and_then(|whole| whole.try_into().ok()).or_else(|| mismatch(value, path, context))
    }
}

impl Read for u32 {
    fn accepted() -> String {
        format!("a whole number, 0 to {}", Self::MAX)
    }

    fn value_type() -> ValueType {
        ValueType::Whole(Self::MAX.into())
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let whole = value.get_ref().as_integer();
        let whole = whole.and_then(|number| Self::from_str_radix(number.as_str(), number.radix()).ok());
        whole.or_else(|| mismatch(value, path, context))
    }
}

impl Read for bool {
    fn accepted() -> String {
        "true or false".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::Boolean
    }

    fn written(&self) -> String {
        self.to_string()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        value.get_ref().as_bool().or_else(|| mismatch(value, path, context))
    }
}

impl Read for String {
    fn accepted() -> String {
        "a string in quotes".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::Text
    }

    fn written(&self) -> String {
        format!("{self:?}")
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        value.get_ref().as_str().map(str::to_owned).or_else(|| mismatch(value, path, context))
    }
}

impl<T: Read> Read for Vec<T> {
    fn accepted() -> String {
        format!("an array, of each: {}", T::accepted())
    }

    fn value_type() -> ValueType {
        ValueType::list(T::value_type())
    }

    fn written(&self) -> String {
        format!("[{}]", self.iter().map(T::written).collect::<Vec<_>>().join(", "))
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let Some(array) = value.get_ref().as_array() else {
            return mismatch(value, path, context);
        };
        let elements = array.iter().enumerate();
        elements.map(|(index, element)| T::read(element, &join(path, &index.to_string()), context)).collect()
    }
}

impl<T: Read, const N: usize> Read for [T; N] {
    fn accepted() -> String {
        let names: Vec<String> = ('a'..).take(N).map(String::from).collect();
        format!("[{}], of each: {}", names.join(", "), T::accepted())
    }

    fn value_type() -> ValueType {
        ValueType::array(T::value_type(), N)
    }

    fn written(&self) -> String {
        format!("[{}]", self.iter().map(T::written).collect::<Vec<_>>().join(", "))
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        match value.get_ref().as_array().map(|array| array.len()) {
            Some(count) if count == N => Vec::read(value, path, context)?.try_into().ok(),
            _ => mismatch(value, path, context),
        }
    }
}

impl Read for Vec2 {
    fn accepted() -> String {
        "[x, y], two numbers".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::array(ValueType::Number, 2)
    }

    fn written(&self) -> String {
        self.to_array().written()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        match value.get_ref().as_array().map(|array| array.len()) {
            Some(2) => <[f32; 2]>::read(value, path, context).map(Self::from),
            _ => mismatch(value, path, context),
        }
    }
}
