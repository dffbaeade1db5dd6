//! Layout of serialised types, recorded while they are deserialised. It must not change without a new version of the format.

use super::known_layout::is_known;
use super::tests::worlds;
use super::{Content, ObstacleRecord, WORLD};
use crate::value_walk::{Leaf, PathSegment, Visitor, walk};
use serde::de::value::{Error, U32Deserializer};
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Error as _, IntoDeserializer, MapAccess,
    SeqAccess, VariantAccess,
};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Paths of all values in a type, each once, with its kind.
#[derive(Default)]
struct Layout {
    way: Vec<String>,
    parts: Vec<(String, &'static str)>,
    known: BTreeSet<(String, &'static str)>,
    /// Number of visits of each enum, by path.
    visits: BTreeMap<String, usize>,
}

impl Layout {
    /// Layout of a type with all variants of its enums.
    fn of<T: DeserializeOwned>() -> Self {
        /// Enough rounds to visit each variant of an enum inside the rarest variant of another one several times.
        const ROUNDS: usize = 100;
        let mut layout = Self::default();
        loop {
            let before = layout.parts.len();
            (0..ROUNDS).for_each(|_| drop(T::deserialize(Wishes(&mut layout)).unwrap()));
            if layout.parts.len() == before {
                return layout;
            }
        }
    }

    fn way(&self) -> String {
        self.way.concat().trim_start_matches('.').to_owned()
    }

    fn note(&mut self, kind: &'static str) {
        let part = (self.way(), kind);
        if self.known.insert(part.clone()) {
            self.parts.push(part);
        }
    }

    /// Continues below the last path.
    fn within(&mut self, what: &str) {
        match self.way.last_mut() {
            Some(last) => last.push_str(what),
            None => self.way.push(what.to_owned()),
        }
    }

    /// The next variant of an enum, in turn.
    fn turn(&mut self, variants: &[&'static str]) -> u32 {
        let visits = self.visits.entry(self.way.concat()).or_default();
        *visits += 1;
        let place = (*visits - 1) % variants.len();
        self.leaf(Leaf::Variant(place as u32, variants[place]));
        place as u32
    }

    fn text(&self) -> String {
        self.parts.iter().map(|(way, kind)| format!("{way} {kind}\n")).collect()
    }
}

impl Visitor for Layout {
    fn enter(&mut self, part: PathSegment) {
        let is_listed = self.way.last().is_some_and(|last| last.ends_with("[]"));
        self.way.push(match part {
            PathSegment::Field(name) => format!(".{name}"),
            PathSegment::Element(_) if is_listed => String::new(),
            PathSegment::Element(index) => format!(".{index}"),
        });
    }

    fn leave(&mut self) {
        self.way.pop();
    }

    fn leaf(&mut self, leaf: Leaf<'_>) {
        match leaf {
            Leaf::Variant(_, "none") => self.note("option"),
            Leaf::Variant(_, "some") => {
                self.note("option");
                self.within("?");
            }
            Leaf::Variant(_, name) => {
                self.note(name);
                self.within(&format!(".{name}"));
            }
            Leaf::Count(_) => {
                self.note("list");
                self.within("[]");
            }
            _ => self.note("value"),
        }
    }
}

/// A deserialiser that records what a type reads, and gives it zeros, lists of one element, and all variants in turn.
struct Wishes<'a>(&'a mut Layout);

impl<'a> Wishes<'a> {
    fn parts(self, parts: impl Iterator<Item = PathSegment>, is_list: bool) -> Parts<'a> {
        Parts { layout: self.0, parts: parts.collect::<Vec<_>>().into_iter(), is_list }
    }
}

macro_rules! leaves {
    ($($method:ident: $kind:literal => $visit:ident($value:expr);)*) => {
        $(fn $method<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
            self.0.note($kind);
            visitor.$visit($value)
        })*
    };
}

impl<'de> Deserializer<'de> for Wishes<'_> {
    type Error = Error;

    leaves! {
        deserialize_bool: "bool" => visit_bool(false);
        deserialize_i32: "i32" => visit_i32(0);
        deserialize_i64: "i64" => visit_i64(0);
        deserialize_u8: "u8" => visit_u8(0);
        deserialize_u16: "u16" => visit_u16(0);
        deserialize_u32: "u32" => visit_u32(0);
        deserialize_u64: "u64" => visit_u64(0);
        deserialize_f32: "f32" => visit_f32(0.0);
        deserialize_f64: "f64" => visit_f64(0.0);
        // A name that checks accept.
        deserialize_str: "text" => visit_str("leaks");
        deserialize_string: "text" => visit_str("leaks");
    }

    serde::forward_to_deserialize_any! {
        i8 i16 i128 u128 char bytes byte_buf unit unit_struct identifier ignored_any
    }

    fn deserialize_any<V: de::Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        Err(Error::custom(format!("{}: a kind of value that layouts do not know", self.0.way())))
    }

    fn is_human_readable(&self) -> bool {
        false
    }

    fn deserialize_option<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.0.leaf(Leaf::Variant(1, "some"));
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: de::Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.0.leaf(Leaf::Count(1));
        visitor.visit_seq(self.parts(std::iter::once(PathSegment::Element(0)), true))
    }

    fn deserialize_map<V: de::Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        self.0.note("map");
        visitor.visit_map(self.parts(["key", "value"].into_iter().map(PathSegment::Field), false))
    }

    fn deserialize_tuple<V: de::Visitor<'de>>(self, count: usize, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_seq(self.parts((0..count).map(PathSegment::Element), false))
    }

    fn deserialize_tuple_struct<V: de::Visitor<'de>>(
        self,
        _: &'static str,
        count: usize,
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.deserialize_tuple(count, visitor)
    }

    fn deserialize_struct<V: de::Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        visitor.visit_seq(self.parts(fields.iter().copied().map(PathSegment::Field), false))
    }

    fn deserialize_enum<V: de::Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        let place = self.0.turn(variants);
        visitor.visit_enum(Chosen { place, content: self })
    }
}

/// A variant and its content.
struct Chosen<'a> {
    place: u32,
    content: Wishes<'a>,
}

impl<'de, 'a> EnumAccess<'de> for Chosen<'a> {
    type Error = Error;
    type Variant = Wishes<'a>;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Wishes<'a>), Error> {
        let place: U32Deserializer<Error> = self.place.into_deserializer();
        Ok((seed.deserialize(place)?, self.content))
    }
}

impl<'de> VariantAccess<'de> for Wishes<'_> {
    type Error = Error;

    fn unit_variant(self) -> Result<(), Error> {
        Ok(())
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Error> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: de::Visitor<'de>>(self, count: usize, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_tuple(count, visitor)
    }

    fn struct_variant<V: de::Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.deserialize_struct("", fields, visitor)
    }
}

/// Fields, or the one element of a list.
struct Parts<'a> {
    layout: &'a mut Layout,
    parts: std::vec::IntoIter<PathSegment>,
    is_list: bool,
}

impl Parts<'_> {
    fn next<'de, S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Error> {
        let Some(part) = self.parts.next() else { return Ok(None) };
        self.layout.enter(part);
        let value = seed.deserialize(Wishes(&mut *self.layout));
        self.layout.leave();
        // An element that refuses zeros is left out of the list: its parts are recorded already.
        if self.is_list { Ok(value.ok()) } else { value.map(Some) }
    }
}

impl<'de> SeqAccess<'de> for Parts<'_> {
    type Error = Error;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Error> {
        self.next(seed)
    }
}

impl<'de> MapAccess<'de> for Parts<'_> {
    type Error = Error;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Error> {
        self.next(seed)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Error> {
        self.next(seed)?.ok_or_else(|| Error::custom("a key without a value"))
    }
}

fn file_of(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name)
}

/// Compares a layout with the one that is known for this version.
fn check(layout: &Layout, version: u32, file: &str) {
    let file = file_of(file);
    let golden = std::fs::read_to_string(&file).unwrap_or_default();
    let mut now = format!("version {version}\n{}", layout.text());
    let is_new = golden.lines().next() != now.lines().next();
    if !is_new && is_known(&now, &golden) {
        now.clone_from(&golden);
    }
    assert!(is_new || golden == now, "the fields in {} changed: raise the version of the format", file.display());
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&file, &now).unwrap();
    } else {
        assert_eq!(golden, now, "update {} with UPDATE_GOLDEN=1", file.display());
    }
}

#[test]
fn the_version_changes_with_the_layout_of_a_world() {
    check(&Layout::of::<Content>(), WORLD.version, "layout.txt");
}

#[cfg(feature = "scenario")]
#[test]
fn the_version_changes_with_the_layout_of_a_run() {
    use super::checkpoint::{Content, RUN};
    check(&Layout::of::<Content>(), RUN.version, "layout-run.txt");
}

#[test]
fn the_worlds_of_the_tests_hold_everything_that_can_be_written() {
    /// Shapes that a compound cannot contain, and state that lasts a few steps only.
    const EXCEPT: [&str; 3] = [
        "0[].shape.Several[].1.Polyline",
        "0[].shape.Several[].1.Several",
        "1.organisms.slots[].value?.divider?.wanted_nodes?",
    ];
    let mut held = Layout::default();
    for world in worlds() {
        let records: Vec<_> = world.obstacles().filter_map(|id| ObstacleRecord::of(world.obstacle(id)?)).collect();
        walk(&(records, &world), &mut held);
    }
    let ways = |layout: &Layout| layout.parts.iter().map(|(way, _)| way.clone()).collect::<BTreeSet<_>>();
    let (held, readable) = (ways(&held), ways(&Layout::of::<Content>()));
    let golden = std::fs::read_to_string(file_of("layout.txt")).unwrap();
    let known = golden.lines().skip(1).filter_map(|line| line.rsplit_once(' '));
    let known: BTreeSet<_> = known.map(|(way, _)| way.to_owned()).collect();
    let missing: Vec<_> =
        known.difference(&held).filter(|way| !EXCEPT.iter().any(|part| way.starts_with(*part))).collect();
    assert!(missing.is_empty(), "no world holds {missing:#?}");
    let unknown: Vec<_> = held.difference(&readable).collect();
    assert!(unknown.is_empty(), "written, but not read: {unknown:#?}");
}

/// Two types that differ in one thing must differ in their layout.
#[test]
fn a_layout_sees_every_variant_and_the_order_and_width_of_fields() {
    #[derive(serde::Deserialize)]
    #[allow(dead_code, reason = "only its type matters")]
    enum Choice {
        Nothing,
        Pair(u8, Option<f32>),
        Names { first: String, others: Vec<u16> },
    }
    let expected = "0 list\n0[] Nothing\n1 u64\n0[] Pair\n0[].Pair.0 u8\n0[].Pair.1 option\n0[].Pair.1? f32\n\
                    0[] Names\n0[].Names.first text\n0[].Names.others list\n0[].Names.others[] u16\n";
    assert_eq!(Layout::of::<(Vec<Choice>, u64)>().text(), expected);
}
