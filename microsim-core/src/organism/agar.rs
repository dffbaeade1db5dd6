//! Agar (seed, 3.1.4): one small disc.

use super::{Blueprint, OrganismSpec};
use crate::capability::Locomotion;
use crate::capability::phagocytosis::PreyClass;
use crate::error::{Error, in_range};
use crate::kind::Kind;
use crate::template::{Node, Template};
use glam::Vec2;

/// A small disc to be eaten.
#[derive(Clone, Debug, PartialEq)]
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

impl From<AgarSpec> for OrganismSpec {
    fn from(spec: AgarSpec) -> Self {
        Self::Agar(spec)
    }
}

impl AgarSpec {
    pub(crate) fn blueprint(&self) -> Result<Blueprint, Error> {
        in_range("radius", self.radius, 0.1, 20.0)?;
        in_range("density", self.density, 0.01, 100.0)?;
        let mass = std::f32::consts::PI * self.radius * self.radius * self.density;
        let mut builder = Template::builder();
        builder.node(Node::disc(Vec2::ZERO, 1.0, 1.0));
        Ok(Blueprint {
            kind: Kind::Agar,
            template: Some(builder.build()?),
            scale: self.radius,
            mass,
            has_membrane: false,
            fluid: None,
            locomotion: Locomotion::None,
            speed: 0.0,
            area: std::f32::consts::PI * self.radius * self.radius,
            engulfer: None,
            prey: Some(PreyClass::Simple),
            divider: None,
        })
    }
}

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
