//! Emitters and drains as plain data: where organisms and fluid come into a world, and where they leave it.

use crate::error::{Error, in_range};
use crate::force_field::Region;
use crate::id::TemplateId;
use crate::kind::Kind;
use crate::organism::OrganismSpec;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Most organisms that an emitter emits in a second.
const FASTEST: f32 = 1000.0;

/// What can be put into a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Recipe {
    /// An organism, or a block of fluid ([`FluidBlockSpec`](crate::FluidBlockSpec)), which mixes with fluid of its kind.
    Organism(OrganismSpec),
    /// A body of a template of this world.
    Template(TemplateId),
}

impl From<OrganismSpec> for Recipe {
    fn from(spec: OrganismSpec) -> Self {
        Self::Organism(spec)
    }
}

impl From<TemplateId> for Recipe {
    fn from(template: TemplateId) -> Self {
        Self::Template(template)
    }
}

/// A region in which organisms come into the world, see [`crate::World::add_emitter`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Emitter {
    /// Where their centres may be, at random.
    pub region: Region,
    /// What they are.
    pub recipe: Recipe,
    /// How many come in a second where there is room, 0 to 1000. One that finds no room in a step tries another place in the next.
    pub rate: f32,
    /// Their velocity at first, units/s, components within ±1000; at most the speed limit counts.
    pub velocity: Vec2,
    /// Their direction, radians counter-clockwise from the x axis, within ±1000; `None`: at random.
    pub angle: Option<f32>,
}

impl Emitter {
    /// One that emits things at rest, in random directions.
    #[must_use]
    pub fn new(region: Region, recipe: Recipe, rate: f32) -> Self {
        Self { region, recipe, rate, velocity: Vec2::ZERO, angle: None }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// Names the first one out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.region.validate().map_err(|error| error.within("region"))?;
        if let Recipe::Organism(spec) = &self.recipe {
            spec.validate().map_err(|error| error.within("recipe"))?;
        }
        in_range("rate", self.rate, 0.0, FASTEST)?;
        in_range("velocity.x", self.velocity.x, -1000.0, 1000.0)?;
        in_range("velocity.y", self.velocity.y, -1000.0, 1000.0)?;
        in_range("angle", self.angle.unwrap_or(0.0), -1000.0, 1000.0)
    }
}

/// A region that organisms and fluid leave the world by, see [`crate::World::add_drain`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drain {
    /// What has its centre here goes; of fluid without a membrane, each particle.
    pub region: Region,
    /// Only organisms of this kind; `None`: all.
    pub kind: Option<Kind>,
}

impl Drain {
    /// Checks every number.
    ///
    /// # Errors
    /// Names the first one out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.region.validate().map_err(|error| error.within("region"))
    }
}
