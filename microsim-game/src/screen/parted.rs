//! A match whose worlds came apart: what is kept of it.

use crate::rules::round::Round;
use crate::store::files::PlayerFolder;
use crate::words::{self, Key};

/// Its files.
const RECORD: &str = "desync.replay";
const WORLD: &str = "desync.snapshot";

/// Keeps the round of a match that came apart, as it was at a step, and gives it to the player. Says so.
pub(super) fn keep_parted(
    round: &Round,
    step: u64,
    store: &PlayerFolder,
    hand_over: impl Fn(&str, &[u8]) -> bool,
) -> String {
    let told = words::text_with(Key::MatchDiffers, &[("step", (&step.to_string()).into())]);
    let (Some(record), Ok(world)) = (round.record(), round.world().to_snapshot()) else { return told };
    let files = [(RECORD, record), (WORLD, world)];
    let kept = files.iter().filter(|(name, bytes)| store.write(name, bytes).is_ok()).count();
    let given = files.iter().filter(|(name, bytes)| hand_over(name, bytes)).count();
    let key = if given == files.len() { Key::MatchGiven } else { Key::MatchKept };
    let where_found = words::text_with(key, &[("record", RECORD.into()), ("world", WORLD.into())]);
    if kept.max(given) == files.len() { format!("{told} {where_found}") } else { told }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::two_players;
    use crate::store::files::tests::Folder;
    use microsim_core::replay::{Player, Replay};
    use microsim_core::scenario::Scenario;
    use microsim_core::{Intent, World};
    use std::cell::RefCell;

    #[test]
    fn a_match_that_came_apart_is_kept_as_a_record_and_the_world_at_its_end() {
        let (_folder, store) = Folder::new("parted");
        let mut round = Round::new(&Scenario::parse(two_players::TEXT, &[]).unwrap()).unwrap();
        (0..90).for_each(|_| round.step_all(&[Intent::REST, Intent::REST]));
        let told = keep_parted(&round, 90, &store, |_, _| false);
        assert!([RECORD, WORLD, "90", "settings"].iter().all(|said| told.contains(said)), "{told}");
        let world = World::from_snapshot(&store.read(WORLD).unwrap()).unwrap();
        let mut player = Player::new(&Replay::read(&store.read(RECORD).unwrap()).unwrap()).unwrap();
        assert_eq!(player.by_ref().filter(|played| played.is_ok()).count(), 90);
        assert_eq!(player.world().digest(), world.digest());
    }

    #[test]
    fn where_what_is_kept_is_out_of_reach_the_files_are_given_to_the_player() {
        let (_folder, store) = Folder::new("given");
        let round = Round::new(&Scenario::parse(two_players::TEXT, &[]).unwrap()).unwrap();
        let given = RefCell::new(Vec::new());
        let told = keep_parted(&round, 90, &store, |name, bytes| {
            given.borrow_mut().push((name.to_owned(), bytes.to_vec()));
            true
        });
        let kept = [RECORD, WORLD].map(|name| (name.to_owned(), store.read(name).unwrap()));
        assert!(*given.borrow() == kept && told.contains("downloads"), "{told}");
    }
}
