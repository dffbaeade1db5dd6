//! Where and how an organism is put into the world.

use crate::capability::controller::Controller;
use crate::error::{Error, in_range};
use crate::geometry::ring::{rotate, unit_vector};
use crate::particle::CollisionGroups;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Overlap of two discs that always is allowed, as a share of the sum of their radii: neighbours may touch.
pub(crate) const TOUCHING: f32 = 0.02;

/// Farthest that a coordinate of a centre is from the room's lower left corner, units.
pub(crate) const FARTHEST: f32 = 1e5;

/// Where and how an organism is put into the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    /// Its centre, units from the room's lower left corner.
    pub at: Vec2,
    /// Its direction, radians counter-clockwise from the x axis, within ±1000.
    pub angle: f32,
    /// Size relative to what its spec or template says, 0.01 to 100.
    pub scale: f32,
    /// What steers it when no input does.
    pub controller: Controller,
    /// How far its discs may overlap those of others, as a share of the sum of both radii, 0 to 0.5: for what is spawned among
    /// others that press. Contacts push them apart in the next step; where nothing holds them they fly apart, at up to the speed
    /// limit. Organisms with an outline are spawned, and overlapped, by 0.02 at most.
    pub overlap: f32,
    /// What its discs collide with, those excepted that its template lets collide with less: a tier of the slide
    /// ([`CollisionGroups::in_tier`]) lets it pass over what lies in others. What has a membrane or is fluid is in all groups.
    pub groups: CollisionGroups,
    /// Damping of its motion as a whole besides that of the medium, 1/s, see [`crate::World::set_linear_damping`].
    pub linear_damping: f32,
    /// Damping of its rotation as a whole, 1/s, see [`crate::World::set_angular_damping`].
    pub angular_damping: f32,
}

impl Placement {
    /// At this place, unturned, in its own size, steered by inputs only.
    #[must_use]
    pub fn at(x: f32, y: f32) -> Self {
        let (controller, groups) = (Controller::Still, CollisionGroups::ALL);
        let (linear_damping, angular_damping) = (0.0, 0.0);
        let (at, overlap) = (Vec2::new(x, y), TOUCHING);
        Self { at, angle: 0.0, scale: 1.0, controller, overlap, groups, linear_damping, angular_damping }
    }

    /// The same with another controller.
    #[must_use]
    pub fn steered_by(mut self, controller: Controller) -> Self {
        self.controller = controller;
        self
    }

    /// The same, turned to `angle` radians.
    #[must_use]
    pub fn turned(mut self, angle: f32) -> Self {
        self.angle = angle;
        self
    }

    /// The same in another size.
    #[must_use]
    pub fn scaled(mut self, scale: f32) -> Self {
        self.scale = scale;
        self
    }

    /// The same, allowing an overlap with others, who are pushed apart, see [`Placement::overlap`].
    #[must_use]
    pub fn overlapping(mut self, share: f32) -> Self {
        self.overlap = share;
        self
    }

    /// The same, colliding with these groups only, see [`Placement::groups`].
    #[must_use]
    pub fn in_groups(mut self, groups: CollisionGroups) -> Self {
        self.groups = groups;
        self
    }

    /// The same with damping of its own, of its motion and of its rotation, 1/s.
    #[must_use]
    pub fn damped(mut self, linear: f32, angular: f32) -> Self {
        (self.linear_damping, self.angular_damping) = (linear, angular);
        self
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        in_range("at.x", self.at.x, -FARTHEST, FARTHEST)?;
        in_range("at.y", self.at.y, -FARTHEST, FARTHEST)?;
        in_range("angle", self.angle, -1000.0, 1000.0)?;
        in_range("scale", self.scale, 0.01, 100.0)?;
        in_range("overlap", self.overlap, 0.0, 0.5)?;
        self.controller.validate().map_err(|error| error.within("controller"))
    }

    /// Takes a point of the organism's own frame into the world's directions, relative to `origin`.
    pub(crate) fn place(&self, point: Vec2, scale: f32, origin: Vec2) -> Vec2 {
        (self.at - origin) + rotate(point * scale, unit_vector(self.angle))
    }
}
