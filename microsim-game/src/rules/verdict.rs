//! Who of several players has most.

use crate::words::{Key, text_with};

/// What the end says: by the first key of the one who has most, by the second of a draw of all, by the third of a draw of the best.
/// Players without a name have a number.
#[must_use]
pub fn verdict([win, draw, draw_of_best]: [Key; 3], scores: &[u32], names: &[String]) -> String {
    let best = scores.iter().copied().max().unwrap_or_default();
    let mut winners = (1..).zip(scores).filter(|(_, points)| **points == best).map(|(k, _)| k);
    match (winners.next(), winners.next()) {
        (Some(winner), None) => {
            let others = (1..).zip(scores).filter(|(k, _)| *k != winner).map(|(_, points)| points.to_string());
            let others = others.collect::<Vec<String>>().join(", ");
            let number = || text_with(Key::TwoPlayer, &[("number", (winner as u32).into())]);
            let name = names.get(winner - 1).cloned().unwrap_or_else(number);
            text_with(win, &[("name", (&name).into()), ("best", best.into()), ("others", (&others).into())])
        }
        _ if scores.iter().all(|&points| points == best) => text_with(draw, &[("points", best.into())]),
        _ => text_with(draw_of_best, &[("points", best.into())]),
    }
}

/// What the end of a food chain of several lines says: whose lived longest.
#[must_use]
pub fn chain_verdict(lives: &[u32], names: &[String]) -> String {
    verdict([Key::ChainWins, Key::ChainDraw, Key::ChainDrawBest], lives, names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_lived_longest_is_named() {
        let of = |lives: &[u32]| chain_verdict(lives, &["Ada".to_owned()]);
        assert_eq!(of(&[83, 61, 40]), "Ada lived longest, 83 s to 61, 40 s");
        assert_eq!(of(&[61, 83]), "Player 2 lived longest, 83 s to 61 s");
        assert_eq!(of(&[61, 61]), "A draw, all lived 61 s");
        assert_eq!(of(&[61, 61, 9]), "A draw of the best, 61 s each");
    }
}
