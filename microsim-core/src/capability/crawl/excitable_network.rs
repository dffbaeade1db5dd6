//! An excitable network on the nodes of a membrane: a FitzHugh-Nagumo system with a global inhibitor
//! (FitzHugh 1961, Biophys. J. 1, 445; local excitation and global inhibition: Levchenko and Iglesias 2002, Biophys. J. 82, 50;
//! Xiong et al. 2010, PNAS 107, 17079).
//!
//! With the activator `a` and the inhibitor `b` of a node, and the mean `A` of `a`:
//!
//! ```text
//! da/dt = RATE (a (1 - a) (a - t) - b) + DIFFUSION (a_left + a_right - 2 a)
//! db/dt = r (GAIN a - DECAY b)             r: recovery, the rate at which activity ends
//! t     = THRESHOLD - bias + INHIBITION A / coverage
//! ```

use super::within;
use serde::{Deserialize, Serialize};

/// Rate of the activator, and of its exchange between neighbouring nodes, 1/s.
const RATE: f32 = 60.0;
const DIFFUSION: f32 = 8.0;
/// Threshold of excitation at rest, its rise with the activity, and its limits.
const THRESHOLD: f32 = 0.2;
const INHIBITION: f32 = 0.42;
const THRESHOLDS: [f32; 2] = [0.03, 0.9];
/// Rise and decay of the inhibitor: activity of 1 ends it after a time of about 1 / r.
const GAIN: f32 = 0.2;
const DECAY: f32 = 0.8;
/// Inhibitor above which a node cannot be excited.
const REFRACTORY: f32 = 0.06;
/// Activator of a node that is excited.
const EXCITED: f32 = 0.7;
/// Longest step of the explicit Euler method, s.
const LONGEST_STEP: f32 = 1.0 / 59.0;

/// Activator at which a node begins to protrude, and how far above that it does so with full force.
const PROTRUDING: f32 = 0.2;
const PROTRUSION_RANGE: f32 = 0.5;
/// Least force, of the full one, that counts.
const LEAST_FORCE: f32 = 0.02;

/// What acts on all nodes alike.
pub(crate) struct Surround {
    /// Share of the membrane that is active at most.
    pub coverage: f32,
    /// Rate at which activity ends, 1/s.
    pub recovery: f32,
    /// Length of the step, s.
    pub dt: f32,
}

/// Activator and inhibitor of each node, each 0 to 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ExcitableNetwork {
    activator: Vec<f32>,
    inhibitor: Vec<f32>,
}

impl ExcitableNetwork {
    pub(crate) fn activator(&self) -> &[f32] {
        &self.activator
    }

    pub(crate) fn len(&self) -> usize {
        self.activator.len()
    }

    /// Makes it one of so many quiet nodes.
    pub(crate) fn reset(&mut self, nodes: usize) {
        for column in [&mut self.activator, &mut self.inhibitor] {
            column.clear();
            column.resize(nodes, 0.0);
        }
    }

    /// Puts a node between two neighbours, like them.
    pub(crate) fn insert(&mut self, k: usize) {
        for column in [&mut self.activator, &mut self.inhibitor] {
            let (before, after) = (column[k - 1], column[k % column.len()]);
            column.insert(k, 0.5 * (before + after));
        }
    }

    /// Gives it the nodes of another ring: each is one of its own, or a new, quiet one.
    pub(crate) fn rearrange(&mut self, sources: &[Option<usize>]) {
        for column in [&mut self.activator, &mut self.inhibitor] {
            *column = sources.iter().map(|source| source.map_or(0.0, |k| column[k])).collect();
        }
    }

    /// Force with which a node protrudes, of the full one: 0 to 1.
    pub(crate) fn force(&self, k: usize) -> f32 {
        let share = within((self.activator[k] - PROTRUDING) / PROTRUSION_RANGE, [0.0, 1.0]);
        share * share * (3.0 - 2.0 * share)
    }

    pub(crate) fn protrudes(&self, k: usize) -> bool {
        self.force(k) > LEAST_FORCE
    }

    /// Arcs of nodes that protrude: each by its first node, in the order of the ring, and its number of nodes.
    pub(crate) fn arcs(&self) -> Vec<(usize, usize)> {
        let count = self.len();
        let is_first = |&k: &usize| self.protrudes(k) && !self.protrudes((k + count - 1) % count);
        let length = |k: usize| (0..count).take_while(|step| self.protrudes((k + step) % count)).count();
        (0..count).filter(is_first).map(|k| (k, length(k))).collect()
    }

    /// Whether both columns have so many numbers, each 0 to 1.
    pub(crate) fn is_sound(&self, nodes: usize) -> bool {
        let is_sound = |column: &[f32]| column.len() == nodes && column.iter().all(|a| (0.0..=1.0).contains(a));
        is_sound(&self.activator) && is_sound(&self.inhibitor)
    }

    /// How much of what the coverage allows is quiet, 0 to 1.
    pub(crate) fn room(&self, coverage: f32) -> f32 {
        within(1.0 - self.mean() / coverage, [0.0, 1.0])
    }

    /// Whether all nodes around one, this share of all, are neither active nor refractory.
    pub(crate) fn is_quiet(&self, centre: usize, share: f32) -> bool {
        self.around(centre, share).all(|k| self.activator[k] < PROTRUDING && self.inhibitor[k] < REFRACTORY)
    }

    /// Excites the nodes around one: this share of all.
    pub(crate) fn excite(&mut self, centre: usize, share: f32) {
        for k in self.around(centre, share) {
            self.activator[k] = EXCITED;
        }
    }

    fn around(&self, centre: usize, share: f32) -> impl Iterator<Item = usize> + use<> {
        let count = self.len();
        let half = ((0.5 * share * count as f32) as usize).max(1);
        (0..=2 * half).map(move |step| (centre + count + step - half) % count)
    }

    /// Ends the activity of some nodes.
    pub(crate) fn quench(&mut self, is_meant: impl Fn(usize) -> bool) {
        for k in (0..self.len()).filter(|&k| is_meant(k)) {
            self.activator[k] = 0.0;
        }
    }

    /// Advances it by a step. `bias` of a node lowers its threshold.
    pub(crate) fn advance(&mut self, surround: &Surround, bias: impl Fn(usize) -> f32) {
        let parts = (surround.dt / LONGEST_STEP) as u32 + 1;
        for _ in 0..parts {
            self.advance_part(surround, surround.dt / parts as f32, &bias);
        }
    }

    fn advance_part(&mut self, surround: &Surround, dt: f32, bias: &impl Fn(usize) -> f32) {
        let inhibition = INHIBITION * self.mean() / surround.coverage;
        let recovery = within(surround.recovery * dt, [0.0, 1.0]);
        let count = self.len();
        let Some(&first) = self.activator.first() else { return };
        let mut left = self.activator[count - 1];
        for k in 0..count {
            let (a, b) = (self.activator[k], self.inhibitor[k]);
            let right = if k + 1 < count { self.activator[k + 1] } else { first };
            let threshold = within(THRESHOLD - bias(k) + inhibition, THRESHOLDS);
            let reaction = a * (1.0 - a) * (a - threshold) - b;
            let change = RATE * reaction + DIFFUSION * (left + right - 2.0 * a);
            self.activator[k] = within(a + dt * change, [0.0, 1.0]);
            self.inhibitor[k] = within(b + recovery * (GAIN * a - DECAY * b), [0.0, 1.0]);
            left = a;
        }
    }

    fn mean(&self) -> f32 {
        self.activator.iter().sum::<f32>() / self.len() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SURROUND: Surround = Surround { coverage: 0.35, recovery: 2.5, dt: 1.0 / 60.0 };

    fn quiet(nodes: usize) -> ExcitableNetwork {
        let mut network = ExcitableNetwork::default();
        network.reset(nodes);
        network
    }

    /// Steps for which some node is active after one was excited.
    fn duration(surround: &Surround) -> usize {
        let mut network = quiet(49);
        network.excite(7, 0.1);
        let is_active = |network: &ExcitableNetwork| network.activator().iter().any(|&a| a > 0.2);
        (0..2000).take_while(|_| (network.advance(surround, |_| 0.0), is_active(&network)).1).count()
    }

    #[test]
    fn activity_begins_where_it_is_excited_ends_by_itself_and_sooner_with_faster_recovery() {
        let mut network = quiet(49);
        network.advance(&SURROUND, |_| 0.0);
        assert!(network.activator().iter().all(|&a| a == 0.0), "a quiet network stays quiet");
        let (usual, fast) = (duration(&SURROUND), duration(&Surround { recovery: 10.0, ..SURROUND }));
        assert!(usual > 12 && usual < 60 && fast < usual, "{usual} and {fast} steps");
    }

    #[test]
    fn a_weak_stimulus_dies_and_a_bias_spreads_activity() {
        let active = |bias: f32| {
            let mut network = quiet(49);
            network.excite(20, 0.1);
            (0..10).for_each(|_| network.advance(&SURROUND, |_| bias));
            network.activator().iter().filter(|&&a| a > 0.2).count()
        };
        assert!(active(0.17) > active(0.0) && active(0.0) > active(-0.6), "towards the goal the threshold is lower");
    }

    #[test]
    fn arcs_are_what_protrudes_across_the_end_of_the_ring_too() {
        let mut network = quiet(49);
        assert_eq!(network.arcs(), []);
        network.excite(0, 0.1);
        network.excite(20, 0.1);
        assert_eq!(network.arcs(), [(18, 5), (47, 5)]);
    }

    #[test]
    fn nodes_keep_their_activity_in_another_ring() {
        let mut network = quiet(12);
        network.excite(3, 0.1);
        assert!(!network.is_quiet(5, 0.1) && network.is_quiet(6, 0.1));
        network.insert(4);
        assert!(network.is_sound(13) && network.activator()[4] == EXCITED);
        let kept: Vec<_> = [Some(4), None, Some(9)].into_iter().cycle().take(9).collect();
        network.rearrange(&kept);
        assert!(network.is_sound(9));
        assert_eq!(network.activator()[..3], [EXCITED, 0.0, 0.0]);
    }
}
