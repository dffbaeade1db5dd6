//! What the player is told at the end of a round: what was missed, and the next goal.

use super::prey_class;
use super::round::RoundResult;
use crate::words::{self, Key};

/// What was missed in a round, if anything.
#[must_use]
pub fn missed(result: &RoundResult) -> Option<String> {
    let count_of = |is_rigid: bool| -> Option<u32> {
        let of_kind: Vec<u32> = result
            .kinds
            .iter()
            .filter(|(kind, _)| prey_class::is_rigid(*kind) == is_rigid)
            .map(|(_, entry)| entry.count)
            .collect();
        (!of_kind.is_empty()).then(|| of_kind.iter().sum())
    };
    let [rigid, small] = [true, false].map(count_of);
    match (result.undigested, small, rigid) {
        (more @ 1.., ..) => Some(words::text_with(Key::MissedUndigested, &[("count", more.into())])),
        (0, Some(0), Some(0) | None) => Some(words::text(Key::MissedAll).to_owned()),
        (0, None, Some(0)) => Some(words::text(Key::MissedRigid).to_owned()),
        (0, _, Some(0)) => Some(words::text(Key::MissedRigidMost).to_owned()),
        _ => None,
    }
}

/// The next round number above a best score: a fifth more at least, in steps that grow with it.
fn milestone(points: u32) -> u32 {
    let step = if points < 500 { 100 } else { 250 };
    (points + points / 5).div_ceil(step) * step
}

/// The next goal, when `better` is the lowest of the kept scores that are higher.
#[must_use]
pub fn next_goal(points: u32, better: Option<u32>) -> String {
    match (points, better) {
        (_, Some(better)) => words::text_with(Key::GoalBetter, &[("points", better.into())]),
        (0, None) => words::text(Key::GoalFirst).to_owned(),
        (points, None) => words::text_with(Key::GoalOwnBest, &[("points", milestone(points).into())]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::referee::KindScore;
    use microsim_core::Kind;

    fn result(undigested: u32, small: u32, rigid: u32) -> RoundResult {
        let entry = |count| KindScore { count, points: 10 * count };
        let kinds = vec![(Kind::Agar, entry(small)), (Kind::RigidCell, entry(rigid))];
        RoundResult {
            scores: vec![0],
            counts: vec![[small, rigid]],
            score: 10 * (small + rigid),
            time: 90.0,
            kinds,
            undigested,
            attempt: None,
            life: None,
            record: None,
            is_mismatch: false,
        }
    }

    #[test]
    fn what_was_missed_is_said_in_the_order_of_what_it_cost() {
        let said = |undigested, small, rigid| missed(&result(undigested, small, rigid)).unwrap_or_default();
        assert!(said(1, 0, 0).starts_with("One thing was still inside"));
        assert!(said(3, 5, 1).starts_with("3 things were still inside"));
        assert!(said(0, 0, 0).starts_with("You took nothing in"));
        assert!(said(0, 5, 0).starts_with("You took in no ciliate"));
        assert_eq!(missed(&result(0, 5, 1)), None);
        let no_rigid = RoundResult { kinds: result(0, 5, 0).kinds[..1].to_vec(), ..result(0, 5, 0) };
        assert_eq!(missed(&no_rigid), None, "this game has none");
        let no_small = RoundResult { kinds: result(0, 0, 0).kinds[1..].to_vec(), ..result(0, 0, 0) };
        assert!(missed(&no_small).is_some_and(|said| !said.contains("small")), "this game has nothing small");
    }

    #[test]
    fn the_next_goal_is_the_score_above() {
        assert_eq!(next_goal(30, Some(50)), "Next: more than 50");
        assert_eq!(next_goal(50, None), "Next: 100 points");
        assert_eq!(next_goal(0, None), "Next: the first points");
        assert_eq!([10, 100, 120, 510, 1693].map(milestone), [100, 200, 200, 750, 2250]);
    }
}
