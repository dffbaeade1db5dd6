//! Coccus: a small round bacterium, such as *Staphylococcus aureus*: one disc that does not swim but is jostled about.

use super::blueprint::Blueprint;
use super::spec::{Spec, SpecTable};
use crate::capability::Locomotion;
use crate::capability::phagocytosis::PreyClass;
use crate::error::Error;
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{ImageLook, Look, Matter, OutlineLook, PaintedLook, RoundLook};
use crate::spec_field::FieldValue::Number;
use crate::spec_field::{FieldVisitor, check, field, required};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Largest acceleration of what jostles it, units/s2: it is light, so a push stops it at once.
const JOSTLE: f32 = 50.0;

/// Colours of bacteria in drawings, and painted.
pub(super) const TINT: Tint = Tint::hex([0x8B7FA8, 0x5E5280, 0x3E3459, 0xD8D2E6]);
pub(super) const PAINTED: PaintedLook =
    PaintedLook { body: Vec3::new(0.36, 0.30, 0.48), rim: Vec3::new(0.2, 0.2, 0.3), mottle: 0.0 };

/// A small round bacterium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoccusSpec {
    /// Radius, units, 0.1 to 20. *Staphylococcus*: 0.4 to 0.5.
    pub radius: f32,
    /// Mass per square unit, 0.01 to 100.
    pub density: f32,
    /// Speed with which it drifts where its controller says, units/s, 0 to 1000. Brownian motion has its own, but not none.
    pub speed: f32,
}

impl Default for CoccusSpec {
    fn default() -> Self {
        Self { radius: 0.47, density: 1.0, speed: 1.0 }
    }
}

impl Spec for CoccusSpec {
    fn table(&self) -> SpecTable {
        SpecTable { name: "coccus", words: "Round bacteria.", entry_words: "A coccus of this name." }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(required("radius", "Radius, micrometres."), Number(&mut self.radius, [0.1, 20.0]));
        visit(field("density", "Mass per square micrometre."), Number(&mut self.density, [0.01, 100.0]));
        visit(
            field("speed", "Speed with which it drifts where its controller says, micrometres/s."),
            Number(&mut self.speed, [0.0, 1000.0]),
        );
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        let area = std::f32::consts::PI * self.radius * self.radius;
        Ok(Blueprint {
            locomotion: Locomotion::Tow { max_acceleration: JOSTLE },
            speed: self.speed,
            prey: Some(PreyClass::Bacterium),
            ..Blueprint::disc(Kind::Coccus, self.radius, area * self.density)?
        })
    }

    /// A small dense ball.
    fn look(&self) -> Look {
        Look {
            image: ImageLook::Round(&RoundLook {
                matter: Matter { phase: 0.6, haemoglobin: 0.0, cytoplasm: 0.5, nucleus: 1.2 },
                variation: 0.25,
                outline: OutlineLook { size: 0.06, ovals: 0.4, spread: 0.9, ..const { OutlineLook::uneven(0.03) } },
                ..RoundLook::PLAIN
            }),
            drawn: DrawnLook { form: Form::Beads, tint: TINT, layer: 3 },
            painted: PAINTED,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BrownianParams, Controller, Inputs, Placement, World, WorldConfig};

    #[test]
    fn coccus_is_one_small_disc_that_is_jostled() {
        let spec = CoccusSpec::default();
        assert_eq!(spec.blueprint().unwrap().particle_count(), 1);
        let mut world = World::new(WorldConfig::default()).unwrap();
        let place = Placement::at(80.0, 45.0).steered_by(Controller::brownian(BrownianParams::default()));
        let id = world.spawn(&spec.into(), place).unwrap();
        let start = world.centroid(id).unwrap();
        let mut farthest = 0.0_f32;
        for _ in 0..600 {
            world.step(&Inputs::new());
            farthest = farthest.max((world.centroid(id).unwrap() - start).length());
        }
        assert!(farthest > 0.5 && farthest < 12.0, "{farthest}");
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let refuse = |spec: CoccusSpec, field: &str| assert_eq!(spec.blueprint().unwrap_err().field(), field);
        refuse(CoccusSpec { radius: 0.0, ..CoccusSpec::default() }, "radius");
        refuse(CoccusSpec { density: f32::NAN, ..CoccusSpec::default() }, "density");
        refuse(CoccusSpec { speed: -1.0, ..CoccusSpec::default() }, "speed");
    }
}
