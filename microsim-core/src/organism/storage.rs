//! Where the particles of an organism lie in the store.

use crate::solver::block::Block;
use crate::solver::lanes::LANES;
use crate::solver::membrane::Membrane;
use serde::{Deserialize, Serialize};

/// Where the particles of an organism lie in the store.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Storage {
    /// In one lane of a block. `first` is the particle of slot 0.
    Lane { block: u32, first: u32 },
    /// At indices of their own: a membrane, or nothing but fluid.
    Loose { particles: Vec<u32>, membrane: Option<Membrane> },
}

impl Storage {
    /// Particle of a node: a slot of a lane, or already an index.
    pub(crate) fn particle(&self, node: u32) -> u32 {
        match self {
            Self::Lane { first, .. } => first + node * LANES as u32,
            Self::Loose { .. } => node,
        }
    }

    /// Its block, and its lane there.
    pub(crate) fn lane(&self, blocks: &[Block]) -> Option<(u32, usize)> {
        match *self {
            Self::Lane { block, first } => Some((block, (first - blocks[block as usize].base) as usize)),
            Self::Loose { .. } => None,
        }
    }

    pub(crate) fn membrane_mut(&mut self) -> Option<&mut Membrane> {
        match self {
            Self::Lane { .. } => None,
            Self::Loose { membrane, .. } => membrane.as_mut(),
        }
    }

    pub(crate) fn membrane(&self) -> Option<&Membrane> {
        match self {
            Self::Lane { .. } => None,
            Self::Loose { membrane, .. } => membrane.as_ref(),
        }
    }
}
