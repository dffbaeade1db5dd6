//! Sorts of prey: small things, and soft cells of which there is room for one only.

use super::referee::KindScore;
use microsim_core::{Kind, OrganismView, PreyClass};

/// Whether it is taken in by any cell that touches it.
#[must_use]
pub fn is_small(prey: OrganismView<'_>) -> bool {
    matches!(prey.prey_class(), Some(PreyClass::Simple | PreyClass::Bacterium))
}

/// Whether it is taken in one at a time, and only by a cell that is large enough.
#[must_use]
pub fn is_soft(prey: OrganismView<'_>) -> bool {
    prey.prey_class() == Some(PreyClass::Soft)
}

/// Whether a score of this kind counts as one of rigid cells.
#[must_use]
pub fn is_rigid(kind: Kind) -> bool {
    kind == Kind::RigidCell
}

/// How many small things, and how many rigid cells, were digested.
#[must_use]
pub fn counts(kinds: &[(Kind, KindScore)]) -> [u32; 2] {
    [false, true].map(|rigid| {
        let of_sort = kinds.iter().filter(|(kind, _)| is_rigid(*kind) == rigid);
        of_sort.map(|(_, entry)| entry.count).sum()
    })
}
