//! Worlds of before the last acts of tools, to go back to.

use crate::stage::Stage;
use std::collections::VecDeque;

/// Acts that can be undone.
const MOST: usize = 24;

/// The last worlds, the newest last.
#[derive(Debug, Default)]
pub(super) struct Undo(VecDeque<Stage>);

impl Undo {
    /// Keeps the scene of before an act; the oldest one goes.
    pub(super) fn keep(&mut self, before: Stage) {
        if self.0.len() == MOST {
            self.0.pop_front();
        }
        self.0.push_back(before);
    }

    /// The scene of before the last act that was not yet undone.
    pub(super) fn take(&mut self) -> Option<Stage> {
        self.0.pop_back()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::{AgarSpec, Placement, World, WorldConfig};

    #[test]
    fn the_last_twenty_four_acts_are_taken_back_in_turn() {
        let mut stage = Stage::new("test".to_owned(), World::new(WorldConfig::default()).unwrap(), None);
        let (mut undo, mut digests) = (Undo::default(), Vec::new());
        for k in 0..30 {
            digests.push(stage.world().digest());
            undo.keep(stage.clone());
            let at = Placement::at(10.0 + 4.0 * k as f32, 40.0);
            stage.world_mut().spawn(&AgarSpec::default().into(), at).unwrap();
            stage.step();
        }
        for k in (6..30).rev() {
            assert_eq!(undo.take().unwrap().world().digest(), digests[k], "act {k}");
        }
        assert!(undo.take().is_none());
    }
}
