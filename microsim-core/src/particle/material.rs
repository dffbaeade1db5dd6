//! Materials: friction and restitution of surfaces.

use serde::{Deserialize, Serialize};

/// Surface of a particle in contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Coulomb friction coefficient, 0 to 10; of two materials the geometric mean counts.
    pub friction: f32,
    /// Fraction of the approach speed kept after an impact, 0 to 1; of two materials the larger counts.
    pub restitution: f32,
}

impl Material {
    /// That of all surfaces for which nothing else is said.
    pub(crate) const DEFAULT: Self = Self { friction: 0.2, restitution: 0.0 };
}

impl Default for Material {
    fn default() -> Self {
        Self::DEFAULT
    }
}
