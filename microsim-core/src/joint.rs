//! Joints as plain data: what is joined, and how.

use crate::config::WorldConfig;
use crate::error::{Error, in_range};
use crate::id::{ObstacleId, OrganismId};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Longest joint, units.
const LONGEST: f32 = 1e5;
/// Largest force that can be given.
const STRONGEST: f32 = 1e12;

/// What one end of a joint holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum JointEnd {
    /// A node: a slot of a template, or a position in [`crate::OrganismView::particles`] when the joint is made. A node of a
    /// membrane stays joined wherever it goes in the ring.
    Node {
        /// Whose it is.
        organism: OrganismId,
        /// Which it is.
        node: u32,
    },
    /// The centre of mass of an organism; the force is spread over all its particles by mass.
    Centre(OrganismId),
    /// A place of the world, coordinates within ±100 000.
    Point(Vec2),
    /// A place of an obstacle, which it takes along when it moves, and which nothing pulls from it.
    Obstacle {
        /// The obstacle; it has to be enabled.
        obstacle: ObstacleId,
        /// The place in the obstacle's own frame, coordinates within ±100 000.
        at: Vec2,
    },
}

/// What a joint does. Lengths are 0 to 100 000 units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum JointKind {
    /// The ends coincide. Discs that collide cannot: see [`crate::World::set_exempt`].
    Pin,
    /// The ends keep a distance.
    Distance {
        /// The distance.
        length: f32,
    },
    /// The ends keep the distance that they have when the joint is made. Two welds side by side also keep an angle.
    Weld,
    /// The ends get no farther apart than a length.
    Rope {
        /// The length.
        max_length: f32,
    },
    /// The ends swing about a distance, with the masses of both.
    Spring {
        /// Distance at rest.
        length: f32,
        /// Frequency without damping, Hz, 0.01 to 1000, and at most 0.04 over the substep: 19 by default.
        frequency: f32,
        /// 0 is undamped, 1 critically damped; 0 to 10.
        damping_ratio: f32,
    },
    /// A spring of no length with a limited force: one end follows the other, as by a mouse.
    Mouse {
        /// Frequency without damping, Hz, 0.01 to 1000, and at most 0.04 over the substep: 19 by default.
        frequency: f32,
        /// 0 is undamped, 1 critically damped; 0 to 10.
        damping_ratio: f32,
        /// Largest force, 0 to 1e12.
        max_force: f32,
    },
    /// The ends are brought to a distance with a limited force.
    LengthMotor {
        /// The distance.
        length: f32,
        /// Largest force, 0 to 1e12.
        max_force: f32,
    },
    /// The distance of the ends changes at a speed, with a limited force.
    SpeedMotor {
        /// The speed, units/s, negative to draw the ends together; within ±1000.
        speed: f32,
        /// Largest force, 0 to 1e12.
        max_force: f32,
    },
}

/// A joint, see [`crate::World::add_joint`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointSpec {
    /// One end.
    pub a: JointEnd,
    /// The other end.
    pub b: JointEnd,
    /// What it does.
    pub kind: JointKind,
    /// Force above which it breaks, 0 to 1e12, or infinite for one that does not.
    pub break_force: f32,
}

impl JointSpec {
    /// A joint that does not break.
    #[must_use]
    pub fn new(a: JointEnd, b: JointEnd, kind: JointKind) -> Self {
        Self { a, b, kind, break_force: f32::INFINITY }
    }

    /// The same, breaking at a force.
    #[must_use]
    pub fn breaking_at(mut self, force: f32) -> Self {
        self.break_force = force;
        self
    }

    /// Checks every number.
    ///
    /// # Errors
    /// Names the first one out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        for (end, name) in [(self.a, "a"), (self.b, "b")] {
            if let JointEnd::Point(at) | JointEnd::Obstacle { at, .. } = end {
                in_range("x", at.x, -LONGEST, LONGEST).map_err(|error| error.within(name))?;
                in_range("y", at.y, -LONGEST, LONGEST).map_err(|error| error.within(name))?;
            }
        }
        if self.break_force != f32::INFINITY {
            in_range("break_force", self.break_force, 0.0, STRONGEST)?;
        }
        self.kind.validate().map_err(|error| error.within("kind"))
    }

    /// Checks all numbers, and that substeps are short enough for its frequency.
    pub(crate) fn check(&self, config: &WorldConfig) -> Result<(), Error> {
        self.validate()?;
        match self.kind {
            JointKind::Spring { frequency, .. } | JointKind::Mouse { frequency, .. } => {
                config.check_frequency(frequency).map_err(|error| error.within("kind"))
            }
            _ => Ok(()),
        }
    }
}

impl JointKind {
    /// A mouse joint that follows quickly and hardly swings.
    #[must_use]
    pub fn mouse(max_force: f32) -> Self {
        Self::Mouse { frequency: 5.0, damping_ratio: 0.7, max_force }
    }

    fn validate(self) -> Result<(), Error> {
        let swing = |frequency: f32, damping_ratio: f32| {
            in_range("frequency", frequency, 0.01, 1000.0)?;
            in_range("damping_ratio", damping_ratio, 0.0, 10.0)
        };
        let length = |length: f32| in_range("length", length, 0.0, LONGEST);
        let force = |force: f32| in_range("max_force", force, 0.0, STRONGEST);
        match self {
            Self::Pin | Self::Weld => Ok(()),
            Self::Distance { length: it } => length(it),
            Self::Rope { max_length } => in_range("max_length", max_length, 0.0, LONGEST),
            Self::Spring { length: it, frequency, damping_ratio } => {
                length(it)?;
                swing(frequency, damping_ratio)
            }
            Self::Mouse { frequency, damping_ratio, max_force } => {
                swing(frequency, damping_ratio)?;
                force(max_force)
            }
            Self::LengthMotor { length: it, max_force } => {
                length(it)?;
                force(max_force)
            }
            Self::SpeedMotor { speed, max_force } => {
                in_range("speed", speed, -1000.0, 1000.0)?;
                force(max_force)
            }
        }
    }
}

impl JointEnd {
    /// The organism that it holds; `None` for a place of the world or of an obstacle.
    #[must_use]
    pub fn organism(self) -> Option<OrganismId> {
        match self {
            Self::Node { organism, .. } | Self::Centre(organism) => Some(organism),
            Self::Point(_) | Self::Obstacle { .. } => None,
        }
    }

    /// The obstacle that it holds, and the place there.
    pub(crate) fn obstacle(self) -> Option<(ObstacleId, Vec2)> {
        if let Self::Obstacle { obstacle, at } = self { Some((obstacle, at)) } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_out_of_range_is_named() {
        let at = JointEnd::Point(Vec2::ZERO);
        let refused = |kind| JointSpec::new(at, at, kind).validate().unwrap_err().field().to_owned();
        let (length, frequency, damping_ratio, max_force) = (1.0, 1.0, 1.0, 1.0);
        assert_eq!(refused(JointKind::Distance { length: -1.0 }), "kind.length");
        assert_eq!(refused(JointKind::Rope { max_length: f32::NAN }), "kind.max_length");
        assert_eq!(refused(JointKind::Spring { length, frequency: 0.0, damping_ratio }), "kind.frequency");
        assert_eq!(refused(JointKind::Mouse { frequency, damping_ratio: 11.0, max_force }), "kind.damping_ratio");
        assert_eq!(refused(JointKind::mouse(-1.0)), "kind.max_force");
        assert_eq!(refused(JointKind::LengthMotor { length: 2e5, max_force }), "kind.length");
        assert_eq!(refused(JointKind::SpeedMotor { speed: 1e4, max_force }), "kind.speed");
        let point = JointSpec::new(at, JointEnd::Point(Vec2::new(0.0, f32::NAN)), JointKind::Pin);
        assert_eq!(point.validate().unwrap_err().field(), "b.y");
        assert_eq!(
            JointSpec::new(at, at, JointKind::Pin).breaking_at(-1.0).validate().unwrap_err().field(),
            "break_force"
        );
    }
}
