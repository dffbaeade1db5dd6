//! Actuation: what acts on an organism or one of its nodes from outside, for one step.

use crate::error::{Error, in_range};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Largest component of a force or an impulse, and largest torque.
const STRONGEST: f32 = 1e9;

/// What acts on an organism or one of its nodes in a step; the default is nothing.
///
/// The unit of mass is that of [`crate::Node::mass`]. What acts on an organism is spread over all its particles by mass, so that
/// it is accelerated as a whole. Nothing gets faster than [`crate::WorldConfig::max_speed`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Actuation {
    /// Force, mass times units/s2, in every substep; components within ±1e9.
    pub force: Vec2,
    /// Impulse, mass times units/s, once when the step begins; components within ±1e9.
    pub impulse: Vec2,
    /// Torque about the centre of mass, mass times units2/s2, counter-clockwise, in every substep; within ±1e9. Not for nodes.
    pub torque: f32,
    /// Where the centre of mass, or the node, is to be at the end of the step: it gets the velocity for that, whatever its mass,
    /// in place of gravity and force, and contacts and constraints act as usual. Coordinates within ±1 000 000.
    pub target: Option<Vec2>,
}

impl Actuation {
    /// A force.
    #[must_use]
    pub fn force(force: Vec2) -> Self {
        Self { force, ..Self::default() }
    }

    /// An impulse.
    #[must_use]
    pub fn impulse(impulse: Vec2) -> Self {
        Self { impulse, ..Self::default() }
    }

    /// A torque.
    #[must_use]
    pub fn torque(torque: f32) -> Self {
        Self { torque, ..Self::default() }
    }

    /// A kinematic target.
    #[must_use]
    pub fn target(target: Vec2) -> Self {
        Self { target: Some(target), ..Self::default() }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field that is not finite or out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        let target = self.target.unwrap_or_default();
        for (field, value, most) in [
            ("force.x", self.force.x, STRONGEST),
            ("force.y", self.force.y, STRONGEST),
            ("impulse.x", self.impulse.x, STRONGEST),
            ("impulse.y", self.impulse.y, STRONGEST),
            ("torque", self.torque, STRONGEST),
            ("target.x", target.x, 1e6),
            ("target.y", target.y, 1e6),
        ] {
            in_range(field, value, -most, most)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_out_of_range_is_named() {
        let refused = |actuation: Actuation| actuation.validate().unwrap_err().field().to_owned();
        assert_eq!(refused(Actuation::force(Vec2::new(f32::NAN, 0.0))), "force.x");
        assert_eq!(refused(Actuation::impulse(Vec2::new(0.0, 2e9))), "impulse.y");
        assert_eq!(refused(Actuation::torque(f32::INFINITY)), "torque");
        assert_eq!(refused(Actuation::target(Vec2::new(0.0, -2e6))), "target.y");
        assert_eq!(Actuation { torque: -1e9, target: Some(Vec2::ZERO), ..Actuation::default() }.validate(), Ok(()));
    }
}
