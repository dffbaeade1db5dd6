//! Pairs of owners that do not collide, whatever their groups say, and open gates.

use serde::{Deserialize, Serialize};

/// A symmetric set of owner pairs, sorted.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Exemptions {
    pairs: Vec<(u32, u32)>,
    /// Membrane nodes and the owner that each ignores, sorted.
    gates: Vec<(u32, u32)>,
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

    /// Lets these membrane nodes ignore an owner's particles.
    pub(crate) fn open_gate(&mut self, nodes: &[u32], owner: u32) {
        self.gates.extend(nodes.iter().map(|&node| (node, owner)));
        self.gates.sort_unstable();
        self.gates.dedup();
    }

    /// Lets them collide again.
    pub(crate) fn close_gate(&mut self, nodes: &[u32], owner: u32) {
        self.gates.retain(|&(node, other)| other != owner || !nodes.contains(&node));
    }

    /// Whether one of two particles is a node that ignores the other's owner.
    pub(crate) fn gate_is_open(&self, particles: [u32; 2], owners: [u32; 2]) -> bool {
        let is_open = |node: u32, owner: u32| self.gates.binary_search(&(node, owner)).is_ok();
        !self.gates.is_empty() && (is_open(particles[0], owners[1]) || is_open(particles[1], owners[0]))
    }

    /// The open gates, ascending.
    pub(crate) fn gates(&self) -> &[(u32, u32)] {
        &self.gates
    }

    /// The pairs, smaller owner first, ascending.
    pub(crate) fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// Exempts a new owner from what another one is exempt from.
    pub(crate) fn inherit(&mut self, from: u32, to: u32) {
        let others = self.pairs.iter().filter(|&&(a, b)| a == from || b == from);
        let others: Vec<u32> = others.map(|&(a, b)| if a == from { b } else { a }).collect();
        for other in others {
            self.set(to, other, true);
        }
    }

    /// Forgets every pair of an owner that is gone.
    pub(crate) fn forget(&mut self, owner: u32) {
        self.pairs.retain(|&(a, b)| a != owner && b != owner);
        self.gates.retain(|&(_, other)| other != owner);
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
        assert!(exemptions.pairs.is_empty());
    }

    #[test]
    fn t31_a_gate_is_open_for_its_nodes_and_for_one_owner_only() {
        let mut exemptions = Exemptions::default();
        exemptions.open_gate(&[4, 5], 9);
        // A particle of owner 9 and a node of owner 1, in either order.
        assert!(exemptions.gate_is_open([4, 70], [1, 9]) && exemptions.gate_is_open([70, 5], [9, 1]));
        assert!(!exemptions.gate_is_open([6, 70], [1, 9]), "another node still collides");
        assert!(!exemptions.gate_is_open([4, 80], [1, 8]), "other prey still collides");
        assert!(!exemptions.gate_is_open([4, 20], [1, 1]), "and so does the cytoplasm");
        exemptions.close_gate(&[4], 9);
        assert!(!exemptions.gate_is_open([4, 70], [1, 9]) && exemptions.gate_is_open([5, 70], [1, 9]));
        exemptions.forget(9);
        assert!(exemptions.gates.is_empty());
    }

    #[test]
    fn pairs_are_in_order_inherited_and_forgotten_from_either_end() {
        let mut exemptions = Exemptions::default();
        exemptions.set(7, 3, true);
        exemptions.set(9, 7, true);
        exemptions.set(1, 2, true);
        assert_eq!(exemptions.pairs(), [(1, 2), (3, 7), (7, 9)]);
        exemptions.inherit(7, 5);
        assert_eq!(exemptions.pairs(), [(1, 2), (3, 5), (3, 7), (5, 9), (7, 9)]);
        exemptions.forget(7);
        assert_eq!(exemptions.pairs(), [(1, 2), (3, 5), (5, 9)]);
    }
}
