//! Pairs of owners that do not collide, whatever their groups say.

/// A symmetric set of owner pairs, sorted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Exemptions {
    pairs: Vec<(u32, u32)>,
}

impl Exemptions {
    /// Exempts a pair, or takes the exemption back.
    pub(crate) fn set(&mut self, a: u32, b: u32, is_exempt: bool) {
        let pair = ordered(a, b);
        match (self.pairs.binary_search(&pair), is_exempt) {
            (Err(at), true) => self.pairs.insert(at, pair),
            (Ok(at), false) => {
                self.pairs.remove(at);
            }
            _ => {}
        }
    }

    pub(crate) fn contains(&self, a: u32, b: u32) -> bool {
        !self.pairs.is_empty() && self.pairs.binary_search(&ordered(a, b)).is_ok()
    }

    /// Forgets every pair of an owner that is gone.
    pub(crate) fn forget(&mut self, owner: u32) {
        self.pairs.retain(|&(a, b)| a != owner && b != owner);
    }

    /// The pairs, smaller owner first, ascending.
    pub(crate) fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }
}

fn ordered(a: u32, b: u32) -> (u32, u32) {
    if a < b { (a, b) } else { (b, a) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exemptions_are_symmetric_and_can_be_taken_back() {
        let mut exemptions = Exemptions::default();
        exemptions.set(7, 3, true);
        exemptions.set(3, 9, true);
        assert!(exemptions.contains(3, 7) && exemptions.contains(9, 3) && !exemptions.contains(7, 9));
        exemptions.set(3, 7, false);
        assert!(!exemptions.contains(7, 3));
        exemptions.forget(9);
        assert!(exemptions.pairs().is_empty());
    }
}
