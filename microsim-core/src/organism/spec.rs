//! Specs: organisms as plain data, and what the file of each says of its kind.

use super::OrganismSpec;
use super::blueprint::Blueprint;
use crate::capability::Locomotion;
use crate::error::Error;
use crate::float_environment::with_default_float_environment;
use crate::look::Look;
use crate::spec_field::FieldVisitor;

/// The tables of a kind of organism in scenario files, `[agar.NAME]` for example.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpecTable {
    /// Their name.
    pub name: &'static str,
    /// What they describe, in a line.
    pub words: &'static str,
    /// What one of them describes, in a line.
    pub entry_words: &'static str,
}

/// What the file of an organism says of it.
pub(crate) trait Spec {
    /// Its tables in scenario files.
    fn table(&self) -> SpecTable;

    /// Its fields, in the order in which they are checked.
    fn fields(&mut self, visit: &mut FieldVisitor<'_>);

    /// The particles, constraints and capabilities that it amounts to. Every field is checked.
    fn blueprint(&self) -> Result<Blueprint, Error>;

    /// How it looks.
    fn look(&self) -> Look;

    /// Scales its fields, where a larger one has more particles rather than larger ones; `false` where it has not.
    fn scale(&mut self, _scale: f32) -> bool {
        false
    }
}

impl OrganismSpec {
    /// The particles, constraints and capabilities that it amounts to.
    pub(crate) fn blueprint(&self) -> Result<Blueprint, Error> {
        self.spec().blueprint()
    }

    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.blueprint().map(drop)
    }

    /// Its tables in scenario files.
    #[must_use]
    pub fn table(&self) -> SpecTable {
        self.spec().table()
    }

    /// Shows every field to a visitor, which may change it.
    pub fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        self.spec_mut().fields(visit);
    }

    /// Whether it moves by itself, so that a controller or an input can steer it.
    #[must_use]
    pub fn can_move(&self) -> bool {
        self.blueprint().is_ok_and(|blueprint| blueprint.locomotion != Locomotion::None)
    }

    /// Whether it takes in others, which makes it grow.
    #[must_use]
    pub fn can_grow(&self) -> bool {
        self.blueprint().is_ok_and(|blueprint| blueprint.engulfer.is_some())
    }

    /// Whether it is fluid or a membrane around fluid.
    #[cfg(feature = "scenario")]
    pub(crate) fn holds_fluid(&self) -> bool {
        self.blueprint().is_ok_and(|blueprint| blueprint.holds_fluid())
    }

    /// The same in another size, and the scale that is left for [`super::Placement::scale`]. Where fluid is part of it, the
    /// spec itself is scaled: a larger cell has more nodes and more cytoplasm, not larger ones (thesis, 3.1.2).
    #[must_use]
    pub fn scaled(&self, scale: f32) -> (Self, f32) {
        let mut scaled = self.clone();
        let is_scaled = with_default_float_environment(|| scaled.spec_mut().scale(scale));
        (scaled, if is_scaled { 1.0 } else { scale })
    }

    /// Number of particles that it takes.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn particle_count(&self) -> Result<usize, Error> {
        self.blueprint().map(|blueprint| blueprint.particle_count())
    }

    /// Largest distance of a point of it from its place, units.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn extent(&self) -> Result<f32, Error> {
        self.blueprint().map(|blueprint| blueprint.extent())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec_field::FieldValue;

    #[test]
    fn every_kind_has_a_sound_default_a_table_of_its_own_and_fields() {
        let defaults = OrganismSpec::defaults();
        for (k, spec) in defaults.iter().enumerate() {
            assert_eq!(spec.blueprint().unwrap().kind, spec.kind());
            assert!(defaults[..k].iter().all(|other| other.table().name != spec.table().name), "{spec:?}");
            let mut required = 0;
            spec.clone().fields(&mut |field, _| required += u32::from(field.is_required));
            assert!(required > 0, "{spec:?}");
        }
    }

    #[test]
    fn a_field_beyond_its_range_is_refused_by_its_name() {
        for spec in OrganismSpec::defaults() {
            let mut names = Vec::new();
            spec.clone().fields(&mut |field, value| {
                names.extend(matches!(value, FieldValue::Number(..)).then_some(field.name));
            });
            for name in names {
                let mut spec = spec.clone();
                spec.fields(&mut |field, value| match value {
                    FieldValue::Number(value, [_, high]) if field.name == name => *value = 2.0 * high,
                    _ => {}
                });
                let error = spec.validate().unwrap_err();
                assert_eq!(error.field().trim_start_matches("fluid."), name);
            }
        }
    }
}
