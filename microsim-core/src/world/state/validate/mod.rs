//! Validation: whether stepping can reach the state of a world, and if not, what is wrong and where.
//!
//! For tests, soaks and worlds from files. It costs about as much as a step and does not panic on any state.

mod bodies;
pub(super) mod numbers;
mod relations;
mod store;
pub(super) mod structure;

use crate::error::Error;
use crate::id::OrganismId;
use crate::kind::Kind;
use crate::world::World;
use std::fmt;

/// An invalid part of a world's state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    subject: Subject,
    what: String,
}

/// Subject of a violation: an organism, one of its particles, or neither.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Subject {
    organism: Option<(OrganismId, Kind)>,
    particle: Option<u32>,
}

/// Result of a check.
type Check = Result<(), Violation>;

impl World {
    /// Checks all that holds between steps: numbers are finite and within their bounds, indices and references are valid in
    /// both directions, membranes are simple, closed and counter-clockwise with all cytoplasm inside, everything is within the
    /// walls, no particle is lost, and every chemical has a concentration everywhere.
    ///
    /// # Errors
    /// The first violation: a bug of this library, or of the file that the world was read from.
    pub fn validate(&self) -> Result<(), Violation> {
        let refused = |error: Error| Subject::default().violation(error.to_string());
        self.config.validate().map_err(refused)?;
        if self.organisms.with_membrane().next().is_some() {
            self.config.check_membranes().map_err(refused)?;
        }
        self.fluids.iter().try_for_each(|fluid| self.check_fluid(&fluid.params)).map_err(refused)?;
        store::check_columns(&self.particles)?;
        structure::check(self)?;
        numbers::check(self)?;
        store::check(self)?;
        bodies::check(self)?;
        relations::check(self)
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

    /// An error, unless a condition holds.
    fn must(self, holds: bool, else_what: impl FnOnce() -> String) -> Check {
        if holds { Ok(()) } else { Err(self.violation(else_what())) }
    }

    /// An error, unless a number is finite and within `low..=high`.
    fn must_range(self, name: &str, value: f32, low: f32, high: f32) -> Check {
        let is_inside = value.is_finite() && value >= low && value <= high;
        self.must(is_inside, || format!("{name} is {value}, must be {low} to {high}"))
    }
}

#[cfg(test)]
mod tests;
