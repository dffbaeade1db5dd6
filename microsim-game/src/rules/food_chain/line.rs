//! The line of one player: the cell that is played, and its sisters.

use super::change::Change;
use super::feats::Feats;
use microsim_core::{OrganismId, Rng};

/// Streams of random numbers from here on are for offers, one for each line.
const STREAM: u64 = 5 << 60;

/// What the rules know of a line, beside its cells.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// The changes of which its player may choose one.
    pub offer: Option<[Change; 3]>,
    rng: Rng,
    /// How its last cell that is gone came to its end.
    pub fate: Option<Fate>,
    /// Who bit one of its cells last.
    pub biter: Option<OrganismId>,
    /// What it has done, as far as the referee does not count it.
    pub feats: Feats,
    /// When none of its cells was left, s.
    pub end: Option<f32>,
}

/// How the last cell of a player's line came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It had nothing left to live on.
    Starved,
    /// A larger amoeba ate it.
    Eaten,
}

impl Line {
    /// The line of a player in a round of this seed.
    pub(super) fn new(seed: u64, player: usize) -> Self {
        Self {
            offer: None,
            rng: Rng::new(seed, STREAM + player as u64),
            fate: None,
            biter: None,
            feats: Feats::default(),
            end: None,
        }
    }

    /// Offers three changes by chance, if none are offered.
    pub(super) fn offer_changes(&mut self) {
        if self.offer.is_none() {
            let mut left = Change::ALL.to_vec();
            self.offer = Some([(); 3].map(|()| left.swap_remove(self.rng.next_u32() as usize % left.len())));
        }
    }
}
