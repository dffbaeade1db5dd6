//! Collision groups: which particles collide.

use serde::{Deserialize, Serialize};

/// Which particles collide: `a` meets `b` when each one's filter contains one of the other's memberships.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct CollisionGroups {
    /// Groups that this particle is in, one bit each.
    pub memberships: u32,
    /// Groups that it collides with, one bit each.
    pub filter: u32,
}

impl CollisionGroups {
    /// In every group, colliding with every group.
    pub const ALL: Self = Self { memberships: u32::MAX, filter: u32::MAX };
    /// Colliding with nothing.
    pub const NONE: Self = Self { memberships: 0, filter: 0 };

    /// Whether particles of these two groups collide.
    #[must_use]
    pub fn meets(self, other: Self) -> bool {
        self.memberships & other.filter != 0 && other.memberships & self.filter != 0
    }
}
