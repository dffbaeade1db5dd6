//! Agar (thesis, 3.1.4): one small disc.

use super::blueprint::Blueprint;
use super::spec::{Spec, SpecTable};
use crate::capability::phagocytosis::PreyClass;
use crate::error::Error;
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{
    ImageLook, Inclusion, Look, Matter, OutlineLook, PaintedLook, Profile, RoundLook, SpotShape, Texture,
};
use crate::spec_field::FieldValue::Number;
use crate::spec_field::{FieldVisitor, check, field, required};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A small disc to be eaten.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AgarSpec {
    /// Radius, units, 0.1 to 20.
    pub radius: f32,
    /// Mass per square unit, 0.01 to 100.
    pub density: f32,
}

impl Default for AgarSpec {
    fn default() -> Self {
        Self { radius: 1.0, density: 1.0 }
    }
}

impl Spec for AgarSpec {
    fn table(&self) -> SpecTable {
        SpecTable { name: "agar", words: "Discs to eat.", entry_words: "Agar of this name." }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(required("radius", "Radius, micrometres."), Number(&mut self.radius, [0.1, 20.0]));
        visit(field("density", "Mass per square micrometre."), Number(&mut self.density, [0.01, 100.0]));
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        let mass = std::f32::consts::PI * self.radius * self.radius * self.density;
        Ok(Blueprint { prey: Some(PreyClass::Simple), ..Blueprint::disc(Kind::Agar, self.radius, mass)? })
    }

    /// A soft bead of gel, hardly denser than water.
    fn look(&self) -> Look {
        Look {
            image: ImageLook::Round(&RoundLook {
                profile: Profile::Dome(0.8),
                matter: Matter { phase: 0.45, haemoglobin: 0.0, cytoplasm: 0.35, nucleus: 0.0 },
                variation: 0.3,
                texture: Texture { amount: 0.12, size: 0.7 },
                outline: OutlineLook {
                    size: 0.08,
                    waves: [0.10, 0.05],
                    decay: 1.6,
                    spread: 0.8,
                    ovals: 0.2,
                    bites: 0.15,
                    ..OutlineLook::EVEN
                },
                inclusions: &[LUMPS],
                ..RoundLook::PLAIN
            }),
            drawn: DrawnLook { form: Form::Beads, tint: Tint::hex([0xF4CE86, 0xDFA44A, 0xA8732A, 0xFFF3D8]), layer: 2 },
            painted: PaintedLook { body: Vec3::new(0.86, 0.6, 0.3), rim: Vec3::new(0.6, 0.4, 0.2), mottle: 0.0 },
        }
    }
}

/// Where the gel is denser.
const LUMPS: Inclusion = Inclusion {
    count: [1, 4],
    radius: [0.25, 0.6],
    place: [0.0, 0.6],
    matter: Matter { phase: 0.15, haemoglobin: 0.0, cytoplasm: 0.12, nucleus: 0.0 },
    shape: SpotShape::Bump,
    grains: [0, 0],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agar_is_one_small_disc() {
        let blueprint = AgarSpec { radius: 0.8, density: 1.0 }.blueprint().unwrap();
        assert_eq!(blueprint.particle_count(), 1);
        assert!((blueprint.extent() - 0.8).abs() < 1e-6);
        assert_eq!(AgarSpec { radius: -1.0, ..AgarSpec::default() }.blueprint().unwrap_err().field(), "radius");
    }
}
