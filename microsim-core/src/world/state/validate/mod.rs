//! Validation: whether the whole state is one that stepping can reach, and if not, in words what is wrong and where.
//!
//! For tests, for soaks and for worlds that came from outside. It changes nothing, costs about as much as a step, and does
//! not panic on any state, however broken.

mod bodies;
mod meals;
mod store;
pub(super) mod structure;

use crate::id::OrganismId;
use crate::kind::Kind;
use crate::world::World;
use std::fmt;

/// Something in a world that must not be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    subject: Subject,
    what: String,
}

/// What a violation is about: an organism, one of its particles, or neither.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Subject {
    organism: Option<(OrganismId, Kind)>,
    particle: Option<u32>,
}

/// What a check finds.
type Check = Result<(), Violation>;

impl World {
    /// Checks everything that holds between steps, whatever was asked of the world: numbers are finite and in sane bounds,
    /// every index names what is there, what names each other does so both ways, membranes are simple, closed and
    /// counter-clockwise with all cytoplasm inside, nothing is outside the walls, nothing is lost, and there is a
    /// concentration of every chemical everywhere.
    ///
    /// # Errors
    /// The first thing that is wrong. That is a bug of this library, or of the file that the world was read from.
    pub fn validate(&self) -> Result<(), Violation> {
        self.config.validate().map_err(|error| Subject::default().violation(error.to_string()))?;
        store::check_columns(&self.particles)?;
        structure::check(self)?;
        store::check(self)?;
        bodies::check(self)?;
        meals::check(self)
    }
}

impl Violation {
    /// The organism that it is about, if it is about one.
    #[must_use]
    pub fn organism(&self) -> Option<OrganismId> {
        self.subject.organism.map(|(id, _)| id)
    }

    /// The particle that it is about, see [`crate::ParticleView::index`].
    #[must_use]
    pub fn particle(&self) -> Option<u32> {
        self.subject.particle
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((id, kind)) = self.subject.organism {
            write!(f, "{} {} (generation {}): ", kind.name(), id.index, id.generation)?;
        }
        if let Some(particle) = self.subject.particle {
            write!(f, "particle {particle}: ")?;
        }
        f.write_str(&self.what)
    }
}

impl std::error::Error for Violation {}

impl Subject {
    fn organism(id: OrganismId, kind: Kind) -> Self {
        Self { organism: Some((id, kind)), particle: None }
    }

    /// A particle, and whose it is if that is known.
    fn particle(world: &World, i: usize) -> Self {
        let owner = world.particles.owner.get(i).and_then(|&owner| world.organisms.id_at(owner));
        let organism = owner.and_then(|id| world.organisms.get(id).map(|organism| (id, organism.kind)));
        Self { organism, particle: Some(i as u32) }
    }

    fn violation(self, what: impl Into<String>) -> Violation {
        Violation { subject: self, what: what.into() }
    }

    /// Nothing, if something holds.
    fn must(self, holds: bool, else_what: impl FnOnce() -> String) -> Check {
        if holds { Ok(()) } else { Err(self.violation(else_what())) }
    }

    /// Nothing, if a number is finite and within `low..=high`.
    fn must_range(self, name: &str, value: f32, low: f32, high: f32) -> Check {
        let is_inside = value.is_finite() && value >= low && value <= high;
        self.must(is_inside, || format!("{name} is {value}, must be {low} to {high}"))
    }
}

#[cfg(test)]
mod tests;
