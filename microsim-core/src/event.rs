//! Events: what happened in a step. They are kept until the next step begins, in an order that depends on the state only.

use crate::collider::{Collider, ContactPoint, Wall};
use crate::id::{DrainId, EmitterId, JointId, ObstacleId, OrganismId};
use crate::kind::Kind;
use serde::{Deserialize, Serialize};

/// Where organisms and fluid leave a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Outlet {
    /// A drain.
    Drain(DrainId),
    /// A side of the room that is open.
    Side(Wall),
}

/// Something that happened in a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
    /// The conditions have held long enough: a membrane opens its gate to prey, or folds around it.
    IngestionBegan {
        /// Who takes in.
        engulfer: OrganismId,
        /// Who is taken in.
        prey: OrganismId,
    },
    /// All of the prey is inside; the gate, or the cup, is closed.
    Ingested {
        /// Who took in.
        engulfer: OrganismId,
        /// Who was taken in.
        prey: OrganismId,
    },
    /// All of the prey is outside; the gate is closed, or the fold let go.
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
    /// A furrow began to close around a cell.
    DivisionBegan {
        /// The cell.
        organism: OrganismId,
    },
    /// A cell was told to divide and cannot; it stays as it is.
    DivisionRefused {
        /// The cell.
        organism: OrganismId,
        /// Why.
        reason: Refusal,
    },
    /// A furrow did not close; the cell returns to rest.
    DivisionAbandoned {
        /// The cell.
        organism: OrganismId,
        /// What kept it open when its time was over.
        reason: Refusal,
    },
    /// One cell became two.
    Divided {
        /// The cell, now with one of the lobes.
        parent: OrganismId,
        /// The other lobe.
        daughter: OrganismId,
    },
    /// A cell was told to fuse with another and cannot; both stay as they are.
    FusionRefused {
        /// The cell that was told to.
        organism: OrganismId,
        /// The other one.
        with: OrganismId,
        /// Why.
        reason: Refusal,
    },
    /// Two cells became one.
    Fused {
        /// The larger one, which contains both now.
        into: OrganismId,
        /// The smaller one; the handle is stale.
        from: OrganismId,
    },
    /// The force of a joint exceeded what it bears.
    JointBroken {
        /// The joint; the handle is stale.
        joint: JointId,
        /// Whom it joined; `None` for a place of the world or of an obstacle.
        between: [Option<OrganismId>; 2],
    },
    /// Something that a joint held is gone or frozen, or is an obstacle that is disabled.
    JointEnded {
        /// The joint; the handle is stale.
        joint: JointId,
        /// Whom it joined; `None` for a place of the world or of an obstacle. Handles may be stale.
        between: [Option<OrganismId>; 2],
    },
    /// The state of an organism was no longer finite, or a load has pressed its membrane flat; it is frozen where it last was, and
    /// the world goes on.
    Quarantined {
        /// The organism.
        organism: OrganismId,
    },
    /// A kinematic obstacle that stops met a body that it would have crushed; it stays where it is.
    ObstacleBlocked {
        /// The obstacle.
        obstacle: ObstacleId,
    },
    /// Something entered a sensor. Exactly one [`Event::SensorLeft`] follows, even if one of them is removed.
    SensorEntered {
        /// The sensor.
        sensor: ObstacleId,
        /// What entered, or whose particle.
        organism: OrganismId,
        /// Of fluid without a membrane, of which each particle enters by itself: which one, see
        /// [`crate::ParticleView::index`].
        particle: Option<u32>,
    },
    /// Something left a sensor.
    SensorLeft {
        /// The sensor; after its removal the handle is stale.
        sensor: ObstacleId,
        /// What left, or whose particle; after its removal the handle is stale.
        organism: OrganismId,
        /// Of fluid without a membrane: which of its particles.
        particle: Option<u32>,
    },
    /// An organism began to touch an obstacle or a wall, if [contacts are reported](crate::World::set_contact_reporting).
    /// Exactly one [`Event::TouchEnded`] follows, even if one of them is removed, unless reports are turned off.
    TouchBegan {
        /// The organism.
        organism: OrganismId,
        /// The obstacle or wall.
        collider: Collider,
    },
    /// An organism stopped touching an obstacle or a wall.
    TouchEnded {
        /// The organism; after its removal the handle is stale.
        organism: OrganismId,
        /// The obstacle or wall; after its removal the handle is stale.
        collider: Collider,
    },
    /// Two touched as fast as [`ContactReporting::hit_speed`](crate::ContactReporting::hit_speed): once for each two, and not in
    /// the step after.
    Hit {
        /// Their fastest contact, with the impulse of all of them.
        contact: ContactPoint,
    },
    /// An emitter put an organism into the world, at the end of the step.
    Emitted {
        /// Which one.
        emitter: EmitterId,
        /// The organism.
        organism: OrganismId,
    },
    /// A drain or an open side took an organism, or particles of fluid, at the end of the step.
    Drained {
        /// Which one.
        outlet: Outlet,
        /// The organism. The handle is stale, but of fluid of which some is left.
        organism: OrganismId,
        /// What it is.
        kind: Kind,
        /// How many of its particles went.
        particles: u32,
    },
    /// A link of a body was stretched beyond its breaking strain, and is gone for good. A body
    /// that falls into pieces so is one organism as before.
    LinkTorn {
        /// The organism.
        organism: OrganismId,
        /// The nodes of its template that the link held.
        nodes: [u32; 2],
    },
}

/// Why a cell does not divide or fuse, or a body does not divide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Refusal {
    /// It is frozen.
    Quarantined,
    /// It, or the other one, is dividing already.
    Dividing,
    /// It, or the other one, is taking prey in.
    Ingesting,
    /// A lobe would have too little cytoplasm or too few membrane nodes.
    TooSmall,
    /// Soft prey lies in the furrow.
    PreyInFurrow,
    /// The two sides of the furrow did not come near enough to each other.
    FurrowOpen,
    /// The membranes are too far from each other, or something is between them.
    NotTouching,
    /// Both hold soft prey, and there is one place for it.
    PlaceTaken,
    /// The other one is gone, or no cell that can fuse.
    NoPartner,
    /// The world would hold too many particles.
    WorldFull,
    /// A half of a body has no room.
    NoRoom,
    /// A half of a body cannot go on as its template says: the template is gone, or mass, size or what moves it does not suit.
    UnfitHalf,
    /// It, or the other one, is held by a cell that takes it in or has taken it in.
    Held,
}

impl Refusal {
    /// Name in output.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Quarantined => "quarantined",
            Self::Dividing => "dividing",
            Self::Ingesting => "ingesting",
            Self::TooSmall => "too_small",
            Self::PreyInFurrow => "prey_in_furrow",
            Self::FurrowOpen => "furrow_open",
            Self::NotTouching => "not_touching",
            Self::PlaceTaken => "place_taken",
            Self::NoPartner => "no_partner",
            Self::WorldFull => "world_full",
            Self::NoRoom => "no_room",
            Self::UnfitHalf => "unfit_half",
            Self::Held => "held",
        }
    }
}

impl Event {
    /// Names of all kinds, see [`Event::name`].
    pub const NAMES: [&str; 25] = [
        "contact_began",
        "contact_ended",
        "front_switched",
        "ingestion_began",
        "ingested",
        "released",
        "consumed",
        "division_began",
        "division_refused",
        "division_abandoned",
        "divided",
        "fusion_refused",
        "fused",
        "joint_broken",
        "joint_ended",
        "quarantined",
        "obstacle_blocked",
        "sensor_entered",
        "sensor_left",
        "touch_began",
        "touch_ended",
        "hit",
        "emitted",
        "drained",
        "link_torn",
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
            Self::DivisionBegan { .. } => "division_began",
            Self::DivisionRefused { .. } => "division_refused",
            Self::DivisionAbandoned { .. } => "division_abandoned",
            Self::Divided { .. } => "divided",
            Self::FusionRefused { .. } => "fusion_refused",
            Self::Fused { .. } => "fused",
            Self::JointBroken { .. } => "joint_broken",
            Self::JointEnded { .. } => "joint_ended",
            Self::Quarantined { .. } => "quarantined",
            Self::ObstacleBlocked { .. } => "obstacle_blocked",
            Self::SensorEntered { .. } => "sensor_entered",
            Self::SensorLeft { .. } => "sensor_left",
            Self::TouchBegan { .. } => "touch_began",
            Self::TouchEnded { .. } => "touch_ended",
            Self::Hit { .. } => "hit",
            Self::Emitted { .. } => "emitted",
            Self::Drained { .. } => "drained",
            Self::LinkTorn { .. } => "link_torn",
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
            Self::Divided { parent: a, daughter: b }
            | Self::FusionRefused { organism: a, with: b, .. }
            | Self::Fused { into: a, from: b } => [Some(a), Some(b)],
            Self::JointBroken { between, .. } | Self::JointEnded { between, .. } => between,
            Self::FrontSwitched { organism }
            | Self::DivisionBegan { organism }
            | Self::DivisionRefused { organism, .. }
            | Self::DivisionAbandoned { organism, .. }
            | Self::SensorEntered { organism, .. }
            | Self::SensorLeft { organism, .. }
            | Self::TouchBegan { organism, .. }
            | Self::TouchEnded { organism, .. }
            | Self::Emitted { organism, .. }
            | Self::Drained { organism, .. }
            | Self::LinkTorn { organism, .. }
            | Self::Quarantined { organism } => [Some(organism), None],
            Self::Hit { contact } => [Some(contact.organism), contact.partner.organism()],
            Self::ObstacleBlocked { .. } => [None, None],
        }
    }
}
