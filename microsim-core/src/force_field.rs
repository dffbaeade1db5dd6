//! Force fields as plain data: an acceleration in a region, or the kicks of molecules there.

mod grid;

use crate::error::{Error, in_range};
use glam::Vec2;
pub use grid::AccelerationGrid;
use serde::{Deserialize, Serialize};

/// Largest coordinate and radius, units.
const FARTHEST: f32 = 1e5;
/// Largest acceleration, units/s2.
const STRONGEST: f32 = 1e6;
/// Largest mobility of a thermal field, cubic units/s.
const MOST_MOBILE: f32 = 1e4;

/// Where a field acts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Region {
    /// Everywhere.
    All,
    /// In a circle. Coordinates are within ±100 000.
    Circle {
        /// Its centre, units.
        centre: Vec2,
        /// Its radius, units, 0 to 100 000.
        radius: f32,
    },
    /// In an upright box. Coordinates are within ±100 000.
    Box {
        /// Lower left corner, units.
        low: Vec2,
        /// Upper right corner, units, not below the lower one.
        high: Vec2,
    },
}

/// The acceleration of what is in a field, whatever its mass, units/s2. Its components, or its size, are within ±1 000 000.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum FieldKind {
    /// The same everywhere.
    Uniform {
        /// The acceleration.
        acceleration: Vec2,
    },
    /// Away from a centre, or towards it if negative.
    Radial {
        /// The centre, units.
        centre: Vec2,
        /// Size of the acceleration.
        acceleration: f32,
    },
    /// Around a centre, counter-clockwise, or clockwise if negative.
    Vortex {
        /// The centre, units.
        centre: Vec2,
        /// Size of the acceleration.
        acceleration: f32,
    },
    /// Brownian motion of bodies, by their size: Langevin's equation with the world's drag and the body's own (Langevin 1908, C. R. Acad. Sci. 146,
    /// 530). A body with the area of a disc of radius `a` and its centre in the region diffuses with `D = mobility / a` (Stokes
    /// and Einstein: `k T / (6 pi eta)` is 0.215 cubic micrometres/s in water of 20 degrees) and turns with `3 D / (4 a^2)`, once
    /// the time `1 / damping` has passed. What has a membrane, is fluid, follows a goal or is held by a cell is not kicked;
    /// neither is anything without damping, of the world or its own. A quarter of the speed limit must be at least the speed
    /// `sqrt(D damping)` of every body of the world, as if it were in the hottest place: otherwise the field, or the body, is refused.
    Thermal {
        /// Diffusion coefficient times radius, cubic units/s, 0 to 10 000.
        mobility: f32,
    },
    /// As the nodes of a grid say.
    Grid(AccelerationGrid),
}

/// A force field, see [`crate::World::add_field`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForceField {
    /// Where it acts.
    pub region: Region,
    /// How.
    pub kind: FieldKind,
}

impl ForceField {
    /// Acceleration of what is at a point, units/s2; zero outside of its region and of its grid, at the centre of a radial field or
    /// vortex, and in a thermal field.
    #[must_use]
    pub fn acceleration_at(&self, point: Vec2) -> Vec2 {
        if !self.region.contains(point) {
            return Vec2::ZERO;
        }
        let outward = |centre: Vec2| (point - centre).normalize_or_zero();
        match &self.kind {
            &FieldKind::Uniform { acceleration } => acceleration,
            &FieldKind::Radial { centre, acceleration } => outward(centre) * acceleration,
            &FieldKind::Vortex { centre, acceleration } => outward(centre).perp() * acceleration,
            FieldKind::Thermal { .. } => Vec2::ZERO,
            FieldKind::Grid(grid) => grid.acceleration_at(point),
        }
    }

    /// Mobility of what is at a point, see [`FieldKind::Thermal`].
    pub(crate) fn mobility_at(&self, point: Vec2) -> f32 {
        match self.kind {
            FieldKind::Thermal { mobility } if self.region.contains(point) => mobility,
            _ => 0.0,
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// Names the first one out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.region.validate().map_err(|error| error.within("region"))?;
        self.kind.validate().map_err(|error| error.within("kind"))
    }
}

impl Region {
    /// Whether a point is in it.
    #[must_use]
    pub fn contains(&self, point: Vec2) -> bool {
        match *self {
            Self::All => true,
            Self::Circle { centre, radius } => (point - centre).length_squared() <= radius * radius,
            Self::Box { low, high } => point.cmpge(low).all() && point.cmple(high).all(),
        }
    }

    /// Lower left and upper right corner of the box around it.
    pub(crate) fn bounds(&self) -> [Vec2; 2] {
        match *self {
            Self::All => [Vec2::NEG_INFINITY, Vec2::INFINITY],
            Self::Circle { centre, radius } => [centre - radius, centre + radius],
            Self::Box { low, high } => [low, high],
        }
    }

    /// Whether the boxes around it and another one meet.
    pub(crate) fn may_meet(&self, other: &Self) -> bool {
        let ([low, high], [others_low, others_high]) = (self.bounds(), other.bounds());
        low.cmple(others_high).all() && others_low.cmple(high).all()
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        match *self {
            Self::All => Ok(()),
            Self::Circle { centre, radius } => {
                point_in_range("centre", centre)?;
                in_range("radius", radius, 0.0, FARTHEST)
            }
            Self::Box { low, high } => {
                point_in_range("low", low)?;
                in_range("high.x", high.x, low.x, FARTHEST)?;
                in_range("high.y", high.y, low.y, FARTHEST)
            }
        }
    }
}

impl FieldKind {
    fn validate(&self) -> Result<(), Error> {
        match *self {
            Self::Uniform { acceleration } => {
                in_range("acceleration.x", acceleration.x, -STRONGEST, STRONGEST)?;
                in_range("acceleration.y", acceleration.y, -STRONGEST, STRONGEST)
            }
            Self::Radial { centre, acceleration } | Self::Vortex { centre, acceleration } => {
                point_in_range("centre", centre)?;
                in_range("acceleration", acceleration, -STRONGEST, STRONGEST)
            }
            Self::Thermal { mobility } => in_range("mobility", mobility, 0.0, MOST_MOBILE),
            // It was checked when it was made.
            Self::Grid(_) => Ok(()),
        }
    }
}

fn point_in_range(field: &str, point: Vec2) -> Result<(), Error> {
    in_range("x", point.x, -FARTHEST, FARTHEST).map_err(|error| error.within(field))?;
    in_range("y", point.y, -FARTHEST, FARTHEST).map_err(|error| error.within(field))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_acts_in_its_region_and_in_its_direction() {
        let centre = Vec2::new(10.0, 10.0);
        let circle = Region::Circle { centre, radius: 5.0 };
        let at = |region, kind, x, y| ForceField { region, kind }.acceleration_at(Vec2::new(x, y));
        let radial = FieldKind::Radial { centre, acceleration: -2.0 };
        assert_eq!(at(circle, radial.clone(), 13.0, 10.0), Vec2::new(-2.0, 0.0));
        assert_eq!(at(circle, radial.clone(), 16.0, 10.0), Vec2::ZERO);
        assert_eq!(at(circle, radial, 10.0, 10.0), Vec2::ZERO);
        assert_eq!(at(Region::All, FieldKind::Vortex { centre, acceleration: 2.0 }, 13.0, 10.0), Vec2::new(0.0, 2.0));
        let below = Region::Box { low: Vec2::ZERO, high: Vec2::new(9.0, 4.0) };
        let wind = FieldKind::Uniform { acceleration: Vec2::X };
        assert_eq!((at(below, wind.clone(), 9.0, 4.0), at(below, wind, 9.0, 4.1)), (Vec2::X, Vec2::ZERO));
    }

    #[test]
    fn every_number_out_of_range_is_named() {
        let refused = |region, kind| ForceField { region, kind }.validate().unwrap_err().field().to_owned();
        let (centre, wind) = (Vec2::ZERO, || FieldKind::Uniform { acceleration: Vec2::X });
        assert_eq!(refused(Region::Circle { centre, radius: -1.0 }, wind()), "region.radius");
        assert_eq!(refused(Region::Circle { centre: Vec2::NAN, radius: 1.0 }, wind()), "region.centre.x");
        assert_eq!(refused(Region::Box { low: Vec2::ONE, high: Vec2::X }, wind()), "region.high.y");
        let blown = FieldKind::Uniform { acceleration: Vec2::new(0.0, 2e6) };
        assert_eq!(refused(Region::All, blown), "kind.acceleration.y");
        assert_eq!(refused(Region::All, FieldKind::Thermal { mobility: -1.0 }), "kind.mobility");
        assert_eq!(refused(Region::All, FieldKind::Vortex { centre, acceleration: f32::NAN }), "kind.acceleration");
    }
}
