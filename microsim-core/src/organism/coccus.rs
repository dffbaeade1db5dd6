//! Coccus: a small round bacterium, such as *Staphylococcus aureus*: one disc that does not swim but is jostled about.

use super::{Blueprint, OrganismSpec};
use crate::capability::Locomotion;
use crate::capability::phagocytosis::PreyClass;
use crate::error::{Error, in_range};
use crate::kind::Kind;
use crate::template::{Node, Template};
use glam::Vec2;

/// Largest acceleration of what jostles it, units/s2: it is light, so a push stops it at once.
const JOSTLE: f32 = 50.0;

/// A small round bacterium.
#[derive(Clone, Debug, PartialEq)]
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

impl From<CoccusSpec> for OrganismSpec {
    fn from(spec: CoccusSpec) -> Self {
        Self::Coccus(spec)
    }
}

impl CoccusSpec {
    pub(crate) fn blueprint(&self) -> Result<Blueprint, Error> {
        in_range("radius", self.radius, 0.1, 20.0)?;
        in_range("density", self.density, 0.01, 100.0)?;
        in_range("speed", self.speed, 0.0, 1000.0)?;
        let area = std::f32::consts::PI * self.radius * self.radius;
        let mut builder = Template::builder();
        builder.node(Node::disc(Vec2::ZERO, 1.0, 1.0));
        Ok(Blueprint {
            kind: Kind::Coccus,
            template: Some(builder.build()?),
            scale: self.radius,
            mass: area * self.density,
            has_membrane: false,
            fluid: None,
            locomotion: Locomotion::Tow { max_acceleration: JOSTLE },
            speed: self.speed,
            area,
            engulfer: None,
            prey: Some(PreyClass::Bacterium),
            divider: None,
        })
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
