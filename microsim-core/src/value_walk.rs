//! A walk through any serialisable value, field by field in the order of declaration. Digests and comparisons of worlds are
//! visitors of this walk.

use serde::Serialize;
use serde::ser::{self, Serializer};
use std::fmt::{self, Display};

/// A value that has no parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Leaf<'a> {
    /// An integer of up to 32 bits, or a boolean.
    Word(u32),
    /// An integer of 64 bits.
    Long(u64),
    Single(f32),
    Double(f64),
    Text(&'a str),
    /// A variant of an enum, by its place and name. `Option` is one. What it holds follows.
    Variant(u32, &'static str),
    /// Number of elements of a list. They follow.
    Count(usize),
}

/// One step of the path to a value: a field or an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PathSegment {
    Field(&'static str),
    Element(usize),
}

/// Receives every leaf in order, and the path to it.
pub(crate) trait Visitor {
    fn enter(&mut self, _: PathSegment) {}
    fn leave(&mut self) {}
    fn leaf(&mut self, leaf: Leaf<'_>);
}

/// Passes every leaf of `value` to a visitor.
pub(crate) fn walk(value: &(impl Serialize + ?Sized), visitor: &mut impl Visitor) {
    let walked = value.serialize(ValueWalker(visitor));
    debug_assert!(walked.is_ok(), "state has no maps, and every part can be serialised");
}

/// Walks one value.
struct ValueWalker<'a, V>(&'a mut V);

/// Walks the fields or elements of a value.
struct CompoundWalker<'a, V> {
    visitor: &'a mut V,
    count: usize,
}

/// Error of a walk: a map, or a type that cannot be serialised.
#[derive(Debug)]
struct Refused;

impl Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value that cannot be walked")
    }
}

impl std::error::Error for Refused {}

impl ser::Error for Refused {
    fn custom<T: Display>(_: T) -> Self {
        Self
    }
}

impl<'a, V: Visitor> ValueWalker<'a, V> {
    fn show(self, leaf: Leaf<'_>) -> Result<(), Refused> {
        self.0.leaf(leaf);
        Ok(())
    }

    fn parts(self, leaf: Option<Leaf<'_>>) -> Result<CompoundWalker<'a, V>, Refused> {
        if let Some(leaf) = leaf {
            self.0.leaf(leaf);
        }
        Ok(CompoundWalker { visitor: self.0, count: 0 })
    }
}

impl<V: Visitor> CompoundWalker<'_, V> {
    fn part(&mut self, part: PathSegment, value: &(impl Serialize + ?Sized)) -> Result<(), Refused> {
        self.visitor.enter(part);
        let walked = value.serialize(ValueWalker(&mut *self.visitor));
        self.visitor.leave();
        walked
    }

    fn element(&mut self, value: &(impl Serialize + ?Sized)) -> Result<(), Refused> {
        self.count += 1;
        self.part(PathSegment::Element(self.count - 1), value)
    }
}

/// Methods of the serialiser for values without parts.
macro_rules! leaves {
    ($($method:ident($kind:ty) => $leaf:expr;)*) => {
        $(fn $method(self, value: $kind) -> Result<(), Refused> {
            self.show($leaf(value))
        })*
    };
}

impl<'a, V: Visitor> Serializer for ValueWalker<'a, V> {
    type Ok = ();
    type Error = Refused;
    type SerializeSeq = CompoundWalker<'a, V>;
    type SerializeTuple = CompoundWalker<'a, V>;
    type SerializeTupleStruct = CompoundWalker<'a, V>;
    type SerializeTupleVariant = CompoundWalker<'a, V>;
    type SerializeMap = ser::Impossible<(), Refused>;
    type SerializeStruct = CompoundWalker<'a, V>;
    type SerializeStructVariant = CompoundWalker<'a, V>;

    leaves! {
        serialize_bool(bool) => |value| Leaf::Word(u32::from(value));
        serialize_i8(i8) => |value| Leaf::Word(i32::from(value) as u32);
        serialize_i16(i16) => |value| Leaf::Word(i32::from(value) as u32);
        serialize_i32(i32) => |value| Leaf::Word(value as u32);
        serialize_i64(i64) => |value| Leaf::Long(value as u64);
        serialize_u8(u8) => |value| Leaf::Word(u32::from(value));
        serialize_u16(u16) => |value| Leaf::Word(u32::from(value));
        serialize_u32(u32) => Leaf::Word;
        serialize_u64(u64) => Leaf::Long;
        serialize_f32(f32) => Leaf::Single;
        serialize_f64(f64) => Leaf::Double;
        serialize_char(char) => |value| Leaf::Word(u32::from(value));
        serialize_str(&str) => Leaf::Text;
    }

    fn serialize_bytes(self, bytes: &[u8]) -> Result<(), Refused> {
        bytes.serialize(self)
    }

    fn serialize_none(self) -> Result<(), Refused> {
        self.show(Leaf::Variant(0, "none"))
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Refused> {
        self.0.leaf(Leaf::Variant(1, "some"));
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), Refused> {
        Ok(())
    }

    fn serialize_unit_struct(self, _: &'static str) -> Result<(), Refused> {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, place: u32, name: &'static str) -> Result<(), Refused> {
        self.show(Leaf::Variant(place, name))
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Result<(), Refused> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        place: u32,
        name: &'static str,
        value: &T,
    ) -> Result<(), Refused> {
        self.0.leaf(Leaf::Variant(place, name));
        value.serialize(self)
    }

    fn serialize_seq(self, count: Option<usize>) -> Result<CompoundWalker<'a, V>, Refused> {
        self.parts(Some(Leaf::Count(count.ok_or(Refused)?)))
    }

    fn serialize_tuple(self, _: usize) -> Result<CompoundWalker<'a, V>, Refused> {
        self.parts(None)
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<CompoundWalker<'a, V>, Refused> {
        self.parts(None)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        place: u32,
        name: &'static str,
        _: usize,
    ) -> Result<CompoundWalker<'a, V>, Refused> {
        self.parts(Some(Leaf::Variant(place, name)))
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, Refused> {
        Err(Refused)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<CompoundWalker<'a, V>, Refused> {
        self.parts(None)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        place: u32,
        name: &'static str,
        _: usize,
    ) -> Result<CompoundWalker<'a, V>, Refused> {
        self.parts(Some(Leaf::Variant(place, name)))
    }
}

/// Implements the traits of values with parts, each with its method for one part.
macro_rules! compounds {
    ($($compound:ident::$method:ident($($name:ident)?);)*) => {
        $(impl<V: Visitor> ser::$compound for CompoundWalker<'_, V> {
            type Ok = ();
            type Error = Refused;

            fn $method<T: Serialize + ?Sized>(&mut self, $($name: &'static str,)? value: &T) -> Result<(), Refused> {
                compounds!(@ self value $($name)?)
            }

            fn end(self) -> Result<(), Refused> {
                Ok(())
            }
        })*
    };
    (@ $parts:ident $value:ident) => { $parts.element($value) };
    (@ $parts:ident $value:ident $name:ident) => { $parts.part(PathSegment::Field($name), $value) };
}

compounds! {
    SerializeSeq::serialize_element();
    SerializeTuple::serialize_element();
    SerializeTupleStruct::serialize_field();
    SerializeTupleVariant::serialize_field();
    SerializeStruct::serialize_field(name);
    SerializeStructVariant::serialize_field(name);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize)]
    enum Outline {
        Point,
        Disc { radius: f32 },
        Pair(u8, Option<u64>),
    }

    #[derive(Serialize)]
    struct Scene<'a> {
        name: &'a str,
        shapes: Vec<Outline>,
        corner: [f64; 2],
    }

    #[derive(Default)]
    struct Listing(Vec<String>, Vec<String>);

    impl Visitor for Listing {
        fn enter(&mut self, part: PathSegment) {
            self.0.push(match part {
                PathSegment::Field(name) => name.to_owned(),
                PathSegment::Element(index) => index.to_string(),
            });
        }

        fn leave(&mut self) {
            self.0.pop();
        }

        fn leaf(&mut self, leaf: Leaf<'_>) {
            self.1.push(format!("{} {leaf:?}", self.0.join(".")));
        }
    }

    #[test]
    fn a_walk_visits_every_leaf_once_with_its_path() {
        let shapes = vec![Outline::Point, Outline::Disc { radius: 2.0 }, Outline::Pair(7, Some(9))];
        let mut listing = Listing::default();
        walk(&Scene { name: "a", shapes, corner: [0.0, -1.0] }, &mut listing);
        let expected = [
            "name Text(\"a\")",
            "shapes Count(3)",
            "shapes.0 Variant(0, \"Point\")",
            "shapes.1 Variant(1, \"Disc\")",
            "shapes.1.radius Single(2.0)",
            "shapes.2 Variant(2, \"Pair\")",
            "shapes.2.0 Word(7)",
            "shapes.2.1 Variant(1, \"some\")",
            "shapes.2.1 Long(9)",
            "corner.0 Double(0.0)",
            "corner.1 Double(-1.0)",
        ];
        assert_eq!(listing.1, expected);
    }
}
