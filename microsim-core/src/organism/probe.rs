//! Probe: a heavy disc that an experimenter drives through the scene, like a microneedle. It pushes with finite force.

use super::{Blueprint, OrganismSpec};
use crate::capability::Locomotion;
use crate::error::{Error, in_range};
use crate::kind::Kind;
use crate::template::{Node, Template};
use glam::Vec2;

/// A heavy disc that is driven.
#[derive(Clone, Debug, PartialEq)]
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

impl From<ProbeSpec> for OrganismSpec {
    fn from(spec: ProbeSpec) -> Self {
        Self::Probe(spec)
    }
}

impl ProbeSpec {
    pub(crate) fn blueprint(&self) -> Result<Blueprint, Error> {
        in_range("radius", self.radius, 0.1, 100.0)?;
        in_range("mass", self.mass, 0.01, 1e5)?;
        in_range("speed", self.speed, 0.0, 1000.0)?;
        in_range("max_acceleration", self.max_acceleration, 0.0, 1e6)?;
        let mut builder = Template::builder();
        builder.node(Node::disc(Vec2::ZERO, 1.0, 1.0));
        Ok(Blueprint {
            kind: Kind::Probe,
            template: Some(builder.build()?),
            scale: self.radius,
            mass: self.mass,
            has_membrane: false,
            fluid: None,
            locomotion: Locomotion::Tow { max_acceleration: self.max_acceleration },
            speed: self.speed,
            area: std::f32::consts::PI * self.radius * self.radius,
            engulfer: None,
            prey: None,
            divider: None,
        })
    }
}
