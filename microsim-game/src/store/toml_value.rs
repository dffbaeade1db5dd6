//! TOML as serde reads it, for what the game keeps. It knows neither places in the text nor dates, which would be most of what reading
//! adds to the page.

use serde::de::value::{Error, MapDeserializer, SeqDeserializer};
use serde::de::{DeserializeOwned, Deserializer, Error as _, IntoDeserializer, Visitor};
use serde::forward_to_deserialize_any;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The value that a text stands for, unless it is not TOML or stands for something else.
pub fn from_toml<T: DeserializeOwned>(text: &str) -> Option<T> {
    let table = DeTable::parse(text).ok()?.into_inner();
    T::deserialize(TomlValue(DeValue::Table(table))).ok()
}

/// One value of a text.
struct TomlValue<'a>(DeValue<'a>);

impl<'a> TomlValue<'a> {
    fn of(value: Spanned<DeValue<'a>>) -> Self {
        Self(value.into_inner())
    }
}

impl<'de> Deserializer<'de> for TomlValue<'_> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.0 {
            DeValue::Boolean(value) => visitor.visit_bool(value),
            DeValue::Integer(value) => {
                visitor.visit_i64(i64::from_str_radix(value.as_str(), value.radix()).map_err(Error::custom)?)
            }
            DeValue::Float(value) => visitor.visit_f64(value.as_str().parse().map_err(Error::custom)?),
            DeValue::String(value) => visitor.visit_str(&value),
            DeValue::Array(values) => visitor.visit_seq(SeqDeserializer::new(values.into_iter().map(TomlValue::of))),
            DeValue::Table(table) => {
                let entries = table.into_iter().map(|(key, value)| (key.into_inner(), TomlValue::of(value)));
                visitor.visit_map(MapDeserializer::new(entries))
            }
            DeValue::Datetime(_) => Err(Error::custom("a date")),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        match self.0 {
            DeValue::String(name) => visitor.visit_enum(name.into_deserializer()),
            _ => Err(Error::custom("not a name")),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map struct identifier ignored_any
    }
}

impl<'de> IntoDeserializer<'de, Error> for TomlValue<'_> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::{Deserialize, Serialize};
    use std::collections::BTreeMap;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    enum Shape {
        Round,
        LongOne,
    }

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Width(f32);

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Kept {
        is_on: bool,
        count: u32,
        least: i8,
        wide: Width,
        name: Option<String>,
        shape: Shape,
        #[serde(default)]
        times: BTreeMap<String, f32>,
        list: Vec<(u8, Shape)>,
    }

    #[test]
    fn what_is_written_is_read_as_the_library_reads_it() {
        let kept = Kept {
            is_on: true,
            count: 4_000_000_000,
            least: -7,
            wide: Width(0.1),
            name: Some("buňka \"a\"\n".to_owned()),
            shape: Shape::LongOne,
            times: [("first-steps".to_owned(), 11.25), ("žába".to_owned(), 3.0)].into(),
            list: vec![(1, Shape::Round), (255, Shape::LongOne)],
        };
        let text = toml::to_string(&kept).unwrap();
        assert_eq!(from_toml::<Kept>(&text), Some(kept));
        let other =
            "is_on = false\ncount = 0x1F\nleast = 1\nwide = 3\nshape = 'round'\nlist = []\nmore = { a = [1] }\n";
        assert_eq!(from_toml::<Kept>(other), toml::from_str(other).ok());
        assert!(from_toml::<Kept>(other).is_some_and(|kept| kept.count == 31 && kept.wide == Width(3.0)));
    }

    #[test]
    fn what_is_damaged_or_stands_for_something_else_is_not_read() {
        let good = "is_on = false\ncount = 1\nleast = 1\nwide = 3.5\nshape = 'round'\nlist = []\n";
        assert!(from_toml::<Kept>(good).is_some());
        for (from, to) in [
            ("count = 1", "count = -1"),
            ("count = 1", "count = 5000000000"),
            ("count = 1", "count = 2020-01-01"),
            ("count = 1", "count = "),
            ("least = 1", ""),
            ("'round'", "'square'"),
            ("'round'", "1"),
            ("list = []", "list = [1]"),
            ("is_on = false", "is_on = 'no'"),
        ] {
            assert_eq!(from_toml::<Kept>(&good.replace(from, to)), None, "{to}");
        }
    }
}
