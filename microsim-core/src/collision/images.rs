//! Where images of things are to be looked for in a room with periodic sides.

use super::aabb::Aabb;
use crate::geometry::period::{Period, leads_on};
use glam::Vec2;

/// The period of a room, and the box around all that moves in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Images {
    pub period: Period,
    pub bounds: Aabb,
}

impl Images {
    /// Displacements to the images of something in a box that come near anything.
    pub(super) fn of(&self, aabb: Aabb) -> impl Iterator<Item = Vec2> + use<> {
        let [of, onto] = [aabb, self.bounds].map(|aabb| [aabb.low(), aabb.high()]);
        self.period.image_shifts(of, onto)
    }

    /// Those of them that lead right or up: each pair of images of two things is found once.
    pub(super) fn ahead(&self, aabb: Aabb) -> impl Iterator<Item = Vec2> + use<> {
        self.of(aabb).filter(|shift| leads_on(*shift))
    }
}
