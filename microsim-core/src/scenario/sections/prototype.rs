//! Prototypes: the tables `[rigid_cell.NAME]`, `[agar.NAME]` and so on, one kind of table per kind of organism.

use crate::error::Error;
use crate::kind::Kind;
use crate::organism::OrganismSpec;
use crate::scenario::reader::{Fields, Read};
use crate::{FieldValue, SpecField};
use std::collections::BTreeMap;

/// An organism that can be spawned by name.
#[derive(Clone, Debug)]
pub(crate) struct Prototype {
    pub name: String,
    spec: OrganismSpec,
    /// Farthest that it reaches from its centre, units.
    extent: f32,
}

/// Prototypes by name; `None` where its table is wrong, which is reported once, there.
pub(crate) type Prototypes = BTreeMap<String, Option<Prototype>>;

/// Reads all prototypes of a file.
pub(crate) fn read(root: &mut Fields<'_>) -> Prototypes {
    let mut prototypes = Prototypes::new();
    for default in OrganismSpec::defaults() {
        for (name, mut fields) in root.named(default.table().name) {
            let (path, context) = (fields.path.clone(), fields.context);
            let prototype = context.check_all(&path, || {
                let mut spec = default.clone();
                spec.fields(&mut |field, value| read_field(&mut fields, field, value));
                Prototype::new(name.clone(), spec)
            });
            fields.finish();
            if prototypes.contains_key(&name) {
                let accepted = "a name that no other prototype has";
                context.refuse_key(&path, format!("the name `{name}` is taken"), accepted.to_owned());
            }
            prototypes.insert(name, prototype);
        }
    }
    prototypes
}

/// The prototype that the field `of` names, if it is sound; reports it if there is none of that name.
pub(crate) fn read_named(fields: &mut Fields<'_>, prototypes: &Prototypes) -> Option<Prototype> {
    let of: String = fields.required("of")?;
    if let Some(prototype) = prototypes.get(&of) {
        return prototype.clone();
    }
    fields.refuse_unknown("of", "prototype", &of, prototypes.keys().map(String::as_str));
    None
}

/// The same where `of` may be missing.
pub(crate) fn read_optional(fields: &mut Fields<'_>, prototypes: &Prototypes) -> Option<Prototype> {
    let of: String = fields.get("of")?;
    let known = prototypes.get(&of);
    if known.is_none() {
        fields.refuse_unknown("of", "prototype", &of, prototypes.keys().map(String::as_str));
    }
    known.cloned().flatten()
}

impl Prototype {
    fn new(name: String, spec: OrganismSpec) -> Result<Self, Error> {
        let extent = spec.extent()?;
        Ok(Self { name, spec, extent })
    }

    /// What kind of organism it is.
    pub(crate) fn kind(&self) -> Kind {
        self.spec.kind()
    }

    /// Whether anything can steer it.
    pub(crate) fn can_move(&self) -> bool {
        self.spec.can_move()
    }

    /// Whether it takes others in and grows.
    pub(crate) fn can_grow(&self) -> bool {
        self.spec.can_grow()
    }

    /// Whether it is fluid or a membrane around fluid.
    pub(crate) fn holds_fluid(&self) -> bool {
        self.spec.holds_fluid()
    }

    /// Farthest that it reaches from its centre when scaled, units.
    pub(crate) fn extent(&self, scale: f32) -> f32 {
        self.extent * scale
    }

    /// Particles that one of it takes.
    pub(crate) fn particles(&self, scale: f32) -> Result<u64, Error> {
        let (spec, _) = self.scaled(scale);
        spec.particle_count().map(|count| count as u64)
    }

    /// Its spec in another size, and what is left for [`crate::Placement::scale`] to do.
    pub(crate) fn scaled(&self, scale: f32) -> (OrganismSpec, f32) {
        self.spec.scaled(scale)
    }
}

/// What the table or field of a prototype at a path means.
pub(crate) fn words_of(path: &str) -> Option<&'static str> {
    let (name, rest) = path.split_once('.').unwrap_or((path, ""));
    let mut spec = OrganismSpec::defaults().into_iter().find(|spec| spec.table().name == name)?;
    match rest {
        "" => Some(spec.table().words),
        "*" => Some(spec.table().entry_words),
        _ => {
            let (path, mut words) = (rest.strip_prefix("*.")?, None);
            spec.fields(&mut |field, value| words = words.or_else(|| words_in(path, field, value)));
            words
        }
    }
}

/// What the field at a path means, if it is this one or within it.
fn words_in(path: &str, field: SpecField, value: FieldValue<'_>) -> Option<&'static str> {
    let within = path.strip_prefix(field.name)?;
    let mut words = within.is_empty().then_some(field.words);
    if let (FieldValue::Table(fields), Some(path)) = (value, within.strip_prefix('.')) {
        fields(&mut |field, value| words = words.or_else(|| words_in(path, field, value)));
    }
    words
}

/// Reads a field of a spec. Its range is checked with the whole spec.
fn read_field(fields: &mut Fields<'_>, field: SpecField, value: FieldValue<'_>) {
    match value {
        FieldValue::Number(value, _) => read_value(fields, field, value),
        FieldValue::Count(value, _) => read_value(fields, field, value),
        FieldValue::Vector(value, _) => read_value(fields, field, value),
        FieldValue::Triple(value, _) => read_value(fields, field, value),
        FieldValue::Word(index, words) => *index = fields.word(field.name, words, *index),
        FieldValue::Table(visit) => {
            let mut inner = fields.table(field.name);
            visit(&mut |field, value| read_field(&mut inner, field, value));
            inner.finish();
        }
    }
}

fn read_value<T: Read + Copy>(fields: &mut Fields<'_>, field: SpecField, value: &mut T) {
    *value =
        if field.is_required { fields.required(field.name).unwrap_or(*value) } else { fields.or(field.name, *value) };
}
