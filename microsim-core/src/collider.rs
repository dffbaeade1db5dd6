//! What can be touched: organisms, obstacles and walls; where two of them touch, and what is reported of that.

use crate::id::{ObstacleId, OrganismId};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// One of the four walls of a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Wall {
    /// At y = 0.
    Bottom,
    /// At the room's height.
    Top,
    /// At x = 0.
    Left,
    /// At the room's width.
    Right,
}

impl Wall {
    /// All of them, in the order of the world's obstacles.
    pub const ALL: [Self; 4] = [Self::Bottom, Self::Top, Self::Left, Self::Right];
}

/// What can be touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Collider {
    /// An organism.
    Organism(OrganismId),
    /// An obstacle that was added.
    Obstacle(ObstacleId),
    /// A wall of the room.
    Wall(Wall),
}

impl Collider {
    /// The organism, if it is one.
    #[must_use]
    pub fn organism(self) -> Option<OrganismId> {
        if let Self::Organism(id) = self { Some(id) } else { None }
    }

    /// The obstacle, if it is one that was added.
    #[must_use]
    pub fn obstacle(self) -> Option<ObstacleId> {
        if let Self::Obstacle(id) = self { Some(id) } else { None }
    }
}

/// What is reported of contacts, besides that organisms begin and cease to touch each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactReporting {
    /// Speed of approach from which on a contact is a hit, units/s, 0 to 1 000 000; without it nothing is.
    pub hit_speed: Option<f32>,
}

/// Where a disc of an organism touched something in a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactPoint {
    /// The organism.
    pub organism: OrganismId,
    /// What it touched.
    pub partner: Collider,
    /// Its particle, see [`crate::ParticleView::index`].
    pub node: u32,
    /// The particle of another organism; of a membrane's link the nearer node.
    pub partner_node: Option<u32>,
    /// On the surface of the organism's particle, units.
    pub point: Vec2,
    /// Unit vector from the partner to the organism.
    pub normal: Vec2,
    /// Greatest speed at which the two approached each other along the normal, units/s; 0 if they did not.
    pub speed: f32,
    /// Total normal impulse of the step, mass times units/s.
    pub impulse: f32,
}

impl ContactPoint {
    /// The same contact as the partner feels it, if that is an organism; across a periodic side its point stays where it is, see
    /// [`crate::World::contacts_of`].
    #[must_use]
    pub fn flipped(self) -> Option<Self> {
        let (organism, node) = (self.partner.organism()?, self.partner_node?);
        let (partner, partner_node) = (Collider::Organism(self.organism), Some(self.node));
        Some(Self { organism, partner, node, partner_node, normal: -self.normal, ..self })
    }
}
