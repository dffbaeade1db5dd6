//! Probe: a heavy disc that an experimenter drives through the scene, like a microneedle. It pushes with finite force.

use super::blueprint::Blueprint;
use super::spec::{Spec, SpecTable};
use crate::capability::Locomotion;
use crate::error::Error;
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{ImageLook, Look, Matter, PaintedLook, RoundLook};
use crate::spec_field::FieldValue::Number;
use crate::spec_field::{FieldVisitor, check, field, required};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A heavy disc that is driven.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProbeSpec {
    /// Radius, units, 0.1 to 100.
    pub radius: f32,
    /// Mass, 0.01 to 100 000.
    pub mass: f32,
    /// Speed, units/s, 0 to 1000.
    pub speed: f32,
    /// Largest acceleration of its drive, units/s2, 0 to 1 000 000: times the mass, the force with which it pushes.
    pub max_acceleration: f32,
}

impl Default for ProbeSpec {
    fn default() -> Self {
        Self { radius: 4.0, mass: 240.0, speed: 5.0, max_acceleration: 400.0 }
    }
}

impl Spec for ProbeSpec {
    fn table(&self) -> SpecTable {
        SpecTable {
            name: "probe",
            words: "Discs that move with a limited force: an experimenter's needle.",
            entry_words: "A probe of this name.",
        }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(required("radius", "Radius, micrometres."), Number(&mut self.radius, [0.1, 100.0]));
        visit(field("mass", "Its mass."), Number(&mut self.mass, [0.01, 1e5]));
        visit(field("speed", "Speed, micrometres/s."), Number(&mut self.speed, [0.0, 1000.0]));
        visit(
            field("max_acceleration", "Largest acceleration of its drive, micrometres/s2."),
            Number(&mut self.max_acceleration, [0.0, 1e6]),
        );
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        Ok(Blueprint {
            locomotion: Locomotion::Tow { max_acceleration: self.max_acceleration },
            speed: self.speed,
            ..Blueprint::disc(Kind::Probe, self.radius, self.mass)?
        })
    }

    /// The round tip of a glass needle, much denser than anything alive.
    fn look(&self) -> Look {
        Look {
            image: ImageLook::Round(&RoundLook { matter: Matter { phase: 5.0, ..Matter::NONE }, ..RoundLook::PLAIN }),
            drawn: DrawnLook { form: Form::Metal, tint: Tint::hex([0x8D98A3, 0x56626E, 0x323B44, 0xC6CED6]), layer: 6 },
            painted: PaintedLook { body: Vec3::new(0.55, 0.62, 0.7), rim: Vec3::new(0.3, 0.35, 0.42), mottle: 0.05 },
        }
    }
}
