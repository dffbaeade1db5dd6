//! Generational handles: a stale one never names a newer organism.

use crate::arena::Handle;
use serde::{Deserialize, Serialize};

/// Names one organism of a world for as long as it lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct OrganismId {
    pub(crate) index: u32,
    pub(crate) generation: u32,
}

impl OrganismId {
    /// Position in the world's table; reused after removal.
    #[must_use]
    pub fn index(self) -> u32 {
        self.index
    }

    /// How many organisms had this index before.
    #[must_use]
    pub fn generation(self) -> u32 {
        self.generation
    }

    pub(crate) fn of((index, generation): Handle) -> Self {
        Self { index, generation }
    }

    pub(crate) fn handle(self) -> Handle {
        (self.index, self.generation)
    }

    /// Stream of its random numbers: its own, and no other organism's of this world.
    pub(crate) fn stream(self) -> u64 {
        (u64::from(self.generation) << 32) | u64::from(self.index)
    }

    /// Stream of the random numbers of its crawl.
    pub(crate) fn crawl_stream(self) -> u64 {
        self.stream() ^ (1 << 62)
    }

    /// Stream of the kicks that it gets from molecules.
    pub(crate) fn thermal_stream(self) -> u64 {
        self.stream() ^ (1 << 61)
    }
}

/// Names a template that was added to a world; valid as long as the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TemplateId(pub(crate) u32);

/// Names one obstacle of a world until it is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ObstacleId {
    pub(crate) index: u32,
    pub(crate) generation: u32,
}

impl ObstacleId {
    /// Position in the world's table; reused after removal.
    #[must_use]
    pub fn index(self) -> u32 {
        self.index
    }

    /// How many obstacles had this index before.
    #[must_use]
    pub fn generation(self) -> u32 {
        self.generation
    }

    pub(crate) fn of((index, generation): Handle) -> Self {
        Self { index, generation }
    }

    pub(crate) fn handle(self) -> Handle {
        (self.index, self.generation)
    }
}

/// Names a joint of a world until it is removed, breaks or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct JointId {
    index: u32,
    generation: u32,
}

impl JointId {
    pub(crate) fn of((index, generation): Handle) -> Self {
        Self { index, generation }
    }

    pub(crate) fn handle(self) -> Handle {
        (self.index, self.generation)
    }
}

/// Names a force field of a world until it is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FieldId {
    index: u32,
    generation: u32,
}

impl FieldId {
    pub(crate) fn of((index, generation): Handle) -> Self {
        Self { index, generation }
    }

    pub(crate) fn handle(self) -> Handle {
        (self.index, self.generation)
    }
}

/// Names an emitter of a world until it is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct EmitterId {
    index: u32,
    generation: u32,
}

impl EmitterId {
    pub(crate) fn of((index, generation): Handle) -> Self {
        Self { index, generation }
    }

    pub(crate) fn handle(self) -> Handle {
        (self.index, self.generation)
    }
}

/// Names a drain of a world until it is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct DrainId {
    index: u32,
    generation: u32,
}

impl DrainId {
    pub(crate) fn of((index, generation): Handle) -> Self {
        Self { index, generation }
    }

    pub(crate) fn handle(self) -> Handle {
        (self.index, self.generation)
    }
}

/// Names a chemical of a world; valid as long as the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ChemicalId(pub(crate) u32);
