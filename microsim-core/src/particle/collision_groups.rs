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

    /// In a tier of the slide, 0 to 31, colliding with what lies in the same one and with what is in every group; `None` if
    /// there is no such tier. Bodies of different tiers pass over each other.
    #[must_use]
    pub fn in_tier(tier: u32) -> Option<Self> {
        let bit = 1u32.checked_shl(tier)?;
        Some(Self { memberships: bit, filter: bit })
    }

    /// The tier, if these are the groups of one.
    #[must_use]
    pub fn tier(self) -> Option<u32> {
        let is_tier = self.memberships == self.filter && self.memberships.is_power_of_two();
        is_tier.then(|| self.memberships.trailing_zeros())
    }

    /// What both allow.
    #[must_use]
    pub(crate) fn and(self, other: Self) -> Self {
        Self { memberships: self.memberships & other.memberships, filter: self.filter & other.filter }
    }

    /// Whether particles of these two groups collide.
    #[must_use]
    pub fn meets(self, other: Self) -> bool {
        self.memberships & other.filter != 0 && other.memberships & self.filter != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiers_meet_themselves_and_what_is_in_all_groups() {
        let [low, high] = [0, 31].map(|tier| CollisionGroups::in_tier(tier).unwrap());
        assert!(low.meets(low) && low.meets(CollisionGroups::ALL) && !low.meets(high));
        assert_eq!([low.tier(), high.tier()], [Some(0), Some(31)]);
        assert_eq!([CollisionGroups::ALL, CollisionGroups::NONE].map(CollisionGroups::tier), [None; 2]);
        assert_eq!(CollisionGroups::in_tier(32), None);
        assert_eq!([low.and(CollisionGroups::ALL), low.and(high)], [low, CollisionGroups::NONE]);
    }
}
