//! What happened in a step. Events are kept until the next step begins, in an order that depends on the state only.

use crate::id::OrganismId;
use crate::kind::Kind;

/// One thing that happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Event {
    /// Two organisms began to touch. Exactly one [`Event::ContactEnded`] follows, even if one is removed.
    ContactBegan {
        /// The organism with the smaller index.
        a: OrganismId,
        /// The other one.
        b: OrganismId,
    },
    /// Two organisms stopped touching.
    ContactEnded {
        /// The organism with the smaller index.
        a: OrganismId,
        /// The other one.
        b: OrganismId,
    },
    /// A rigid cell's goal lies behind it, so its opposite body became its front.
    FrontSwitched {
        /// The cell.
        organism: OrganismId,
    },
    /// The conditions have held long enough: a membrane opened its gate for prey.
    IngestionBegan {
        /// Who takes in.
        engulfer: OrganismId,
        /// Who is taken in.
        prey: OrganismId,
    },
    /// All of the prey is inside; the gate is closed.
    Ingested {
        /// Who took in.
        engulfer: OrganismId,
        /// Who was taken in.
        prey: OrganismId,
    },
    /// All of the prey is outside; the gate is closed.
    Released {
        /// Who failed to take in.
        engulfer: OrganismId,
        /// Who stayed outside.
        prey: OrganismId,
    },
    /// Prey was digested and removed.
    Consumed {
        /// Who digested.
        engulfer: OrganismId,
        /// Who was digested; the handle is stale.
        prey: OrganismId,
        /// What it was.
        kind: Kind,
    },
    /// The state of an organism was no longer finite; it is frozen where it last was, and the world goes on.
    Quarantined {
        /// The organism.
        organism: OrganismId,
    },
}

impl Event {
    /// Names of all kinds, see [`Event::name`].
    pub const NAMES: [&str; 8] = [
        "contact_began",
        "contact_ended",
        "front_switched",
        "ingestion_began",
        "ingested",
        "released",
        "consumed",
        "quarantined",
    ];

    /// Name of its kind, for counting.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::ContactBegan { .. } => "contact_began",
            Self::ContactEnded { .. } => "contact_ended",
            Self::FrontSwitched { .. } => "front_switched",
            Self::IngestionBegan { .. } => "ingestion_began",
            Self::Ingested { .. } => "ingested",
            Self::Released { .. } => "released",
            Self::Consumed { .. } => "consumed",
            Self::Quarantined { .. } => "quarantined",
        }
    }

    /// The organisms that it is about.
    #[must_use]
    pub fn organisms(&self) -> [Option<OrganismId>; 2] {
        match *self {
            Self::ContactBegan { a, b } | Self::ContactEnded { a, b } => [Some(a), Some(b)],
            Self::IngestionBegan { engulfer, prey }
            | Self::Ingested { engulfer, prey }
            | Self::Released { engulfer, prey }
            | Self::Consumed { engulfer, prey, .. } => [Some(engulfer), Some(prey)],
            Self::FrontSwitched { organism } | Self::Quarantined { organism } => [Some(organism), None],
        }
    }
}
