//! What a query looks at.

use crate::collider::Collider;
use crate::id::OrganismId;
use crate::kind::Kind;
use crate::particle::CollisionGroups;
use std::fmt;

/// What a query looks at: by default everything that can be touched.
#[derive(Clone, Copy)]
pub struct QueryFilter<'a> {
    /// Only what meets these groups.
    pub groups: CollisionGroups,
    /// Whether organisms are looked at.
    pub organisms: bool,
    /// Whether obstacles are.
    pub obstacles: bool,
    /// Whether the walls of the room are.
    pub walls: bool,
    /// Whether sensors are.
    pub sensors: bool,
    /// Of organisms, only those of this kind.
    pub kind: Option<Kind>,
    /// All but this organism.
    pub excluded: Option<OrganismId>,
    /// Only what this is true for.
    pub predicate: Option<&'a dyn Fn(Collider) -> bool>,
}

impl Default for QueryFilter<'_> {
    fn default() -> Self {
        Self {
            groups: CollisionGroups::ALL,
            organisms: true,
            obstacles: true,
            walls: true,
            sensors: false,
            kind: None,
            excluded: None,
            predicate: None,
        }
    }
}

impl QueryFilter<'_> {
    /// Organisms only.
    #[must_use]
    pub fn organisms() -> Self {
        Self { obstacles: false, walls: false, ..Self::default() }
    }

    /// Obstacles and walls only.
    #[must_use]
    pub fn surfaces() -> Self {
        Self { organisms: false, ..Self::default() }
    }

    /// Whether the predicate lets something through.
    pub(super) fn accepts(&self, collider: Collider) -> bool {
        self.predicate.is_none_or(|predicate| predicate(collider))
    }
}

impl fmt::Debug for QueryFilter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("QueryFilter")
            .field("groups", &self.groups)
            .field("organisms", &self.organisms)
            .field("obstacles", &self.obstacles)
            .field("walls", &self.walls)
            .field("sensors", &self.sensors)
            .field("kind", &self.kind)
            .field("excluded", &self.excluded)
            .finish_non_exhaustive()
    }
}
