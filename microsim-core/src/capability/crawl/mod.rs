//! Crawling by pseudopods as a capability: an [`ExcitableNetwork`] on the membrane decides where it protrudes. This room holds
//! [parameters](params), the [presets](presets) for types of amoeba and the state; what drives the membrane is in [`crate::behavior::crawl`].
//!
//! A pseudopod starts beside the last one, on alternating sides, or anywhere (Bosgraaf and Van Haastert 2009, "The ordered
//! extension of pseudopodia by amoeboid cells in the absence of external cues"). The goal biases where, as a gradient does.

mod excitable_network;
pub(crate) mod params;
pub(crate) mod presets;

use crate::geometry::ring::{rotate, unit_vector};
use crate::rng::Rng;
use excitable_network::{ExcitableNetwork, Surround};
use glam::Vec2;
pub use params::PseudopodParams;
use serde::{Deserialize, Serialize};

/// Places that are tried for a pseudopod that starts anywhere.
const TRIES: u32 = 8;
/// Share of the stiffness of a crawling membrane that a protruding node loses.
const SOFTENING: f32 = 0.9;
/// Time in which the direction of the push follows the pseudopods, s.
const PUSH_TIME: f32 = 0.3;
/// How much of what may be active is so in the mean while it crawls: it covers its area at rest then, and no gap is too narrow for it.
const MEAN_ACTIVITY: f32 = 0.35;
/// Time in which a cell spreads with its activity, in those in which it crawls its radius, and that in which it rounds up, s.
const SPREADING_TIME: f32 = 0.2;
const ROUNDING_TIME: f32 = 0.5;
/// Share of the push that has to lead to the goal: below it the cell turns round, or begins.
const TURNING: f32 = 0.1;
/// Cosine to the goal below which a pseudopod is withdrawn while the cell turns round.
const OPPOSED: f32 = -0.3;
/// Limits of the rate at which the network runs, in the cell's speed over its radius, 1/s.
const TEMPO: [f32; 2] = [0.1, 4.0];

/// What a crawling cell knows of itself in a step.
pub(crate) struct Posture<'a> {
    /// Unit vectors from its centroid to the nodes of its outline.
    pub outwards: &'a [Vec2],
    /// Unit vector to its goal.
    pub direction: Vec2,
    /// Its speed over its radius, 1/s.
    pub tempo: f32,
    /// Length of the step, s.
    pub dt: f32,
}

/// State of a crawl by pseudopods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pseudopods {
    pub params: PseudopodParams,
    /// Random numbers of their own, so that those of the controller do not depend on the crawl.
    pub rng: Rng,
    /// Activity of each node of the outline.
    pub network: ExcitableNetwork,
    /// Position in the outline of the tip that leads, while it crawls.
    pub front_centre: Option<u32>,
    /// Mean direction of the pseudopods in the last moments; at most a unit vector.
    pub push: Vec2,
    /// Direction in which the last pseudopod started; zero before the first.
    pub last: Vec2,
    /// Side of the one before it on which it started: 1 left, -1 right.
    pub side: f32,
    /// Area that it covers, in that at rest: it is as much thinner, since its volume stays.
    pub spread: f32,
    /// Whether the membrane is as stiff as in the other crawl: while it holds on to prey.
    pub is_stiff: bool,
}

impl Pseudopods {
    pub(crate) fn new(params: PseudopodParams) -> Self {
        Self {
            params,
            rng: Rng::new(0, 0),
            network: ExcitableNetwork::default(),
            front_centre: None,
            push: Vec2::ZERO,
            last: Vec2::ZERO,
            side: 1.0,
            spread: 1.0,
            is_stiff: false,
        }
    }

    /// Whether its numbers are within their ranges, for an outline of so many nodes.
    pub(crate) fn is_sound(&self, nodes: usize) -> bool {
        let is_short = |v: Vec2| v.is_finite() && v.length_squared() <= 1.01;
        self.network.is_sound(nodes)
            && is_short(self.push)
            && is_short(self.last)
            && self.side.abs() == 1.0
            && (0.5..=2.0).contains(&self.spread)
    }

    /// Comes to rest in a step of `dt`: what is extended is withdrawn, and it rounds up.
    pub(crate) fn rest(&mut self, dt: f32) {
        self.spread_to(1.0, dt / ROUNDING_TIME);
        self.network.reset(self.network.len());
        (self.front_centre, self.push, self.last) = (None, Vec2::ZERO, Vec2::ZERO);
    }

    /// Whether it moves and may change its shape.
    pub(crate) fn protrudes(&self) -> bool {
        self.front_centre.is_some() && !self.is_stiff
    }

    /// Share of the bending stiffness that is left at each node: least where it protrudes.
    pub(crate) fn stiffness(&self) -> Vec<f32> {
        let at = |k| self.params.stiffness * (1.0 - SOFTENING * self.network.force(k));
        (0..self.network.len()).map(at).collect()
    }

    /// Whether its pseudopods do not lead towards a goal yet: after a rest, and while it turns round.
    pub(crate) fn is_turning(&self, direction: Vec2) -> bool {
        self.push.dot(direction) < TURNING
    }

    /// Advances the network by a step: pseudopods start, grow and end.
    pub(crate) fn advance(&mut self, posture: &Posture<'_>) {
        let &Posture { outwards, direction, tempo, dt } = posture;
        let tempo = within(tempo, TEMPO);
        if self.rng.unit() < dt * tempo * self.params.start_rate * self.network.room(self.params.coverage) {
            self.start(outwards, direction);
        }
        if self.is_turning(direction) {
            self.network.quench(|k| outwards[k].dot(direction) < OPPOSED);
        }
        let surround = Surround { coverage: self.params.coverage, recovery: tempo / self.params.life, dt };
        self.network.advance(&surround, |k| self.params.goal_bias * outwards[k].dot(direction));
        let active: Vec2 = outwards.iter().zip(self.network.activator()).map(|(&out, &a)| out * a).sum();
        let push = active.normalize_or_zero();
        self.push += (push - self.push) * (dt / (dt + PUSH_TIME));
        let share = 1.0 - self.network.room(self.params.coverage);
        self.spread_to(1.0 + self.params.spreading * (share - MEAN_ACTIVITY), tempo * dt / SPREADING_TIME);
    }

    /// Follows an area in a step that is this share of the time it takes.
    fn spread_to(&mut self, area: f32, step: f32) {
        self.spread += (area - self.spread) * (step / (1.0 + step));
    }

    /// Starts a pseudopod beside the last one or anywhere.
    fn start(&mut self, outwards: &[Vec2], direction: Vec2) {
        let is_split = self.last != Vec2::ZERO && self.rng.unit() < self.params.split_share;
        let found =
            if is_split { self.beside_the_last(outwards, direction) } else { self.anywhere(outwards, direction) };
        let Some(k) = found else { return };
        let turn = self.last.perp_dot(outwards[k]);
        (self.side, self.last) = (1.0_f32.copysign(turn), outwards[k]);
        self.network.excite(k, self.params.width);
    }

    /// The node at the split angle from the last pseudopod, more often on the other side than the one before, and towards the goal.
    fn beside_the_last(&mut self, outwards: &[Vec2], direction: Vec2) -> Option<usize> {
        let angle = self.params.split_angle + self.params.split_spread * self.rng.normal();
        let [left, right] = [1.0, -1.0].map(|side| rotate(self.last, unit_vector(side * angle.to_radians())));
        let alternation = self.params.alternation;
        let weight = |at: Vec2, is_other_side: bool| {
            let side = if is_other_side { alternation } else { 1.0 - alternation };
            side * self.acceptance(at, direction)
        };
        let (to_left, to_right) = (weight(left, self.side < 0.0), weight(right, self.side > 0.0));
        let is_left = self.rng.unit() * (to_left + to_right) < to_left;
        let at = if is_left { left } else { right };
        let nearest = |best: (usize, f32), (k, out): (usize, &Vec2)| {
            let cosine = out.dot(at);
            if cosine > best.1 { (k, cosine) } else { best }
        };
        let (k, _) = outwards.iter().enumerate().fold((0, -2.0), nearest);
        self.network.is_quiet(k, self.params.width).then_some(k)
    }

    /// A random node, rather one towards the goal.
    fn anywhere(&mut self, outwards: &[Vec2], direction: Vec2) -> Option<usize> {
        for _ in 0..TRIES {
            let k = (self.rng.unit() * outwards.len() as f32) as usize;
            let is_accepted = self.rng.unit() < self.acceptance(outwards[k], direction);
            if is_accepted && self.network.is_quiet(k, self.params.width) {
                return Some(k);
            }
        }
        None
    }

    /// Probability with which a place is accepted by its direction.
    fn acceptance(&self, out: Vec2, direction: Vec2) -> f32 {
        let ahead = 0.5 * (1.0 + out.dot(direction));
        ahead * ahead
    }
}

/// A value, or the nearest limit.
fn within(value: f32, [low, high]: [f32; 2]) -> f32 {
    let value = if value > low { value } else { low };
    if value < high { value } else { high }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODES: usize = 49;

    fn outwards() -> Vec<Vec2> {
        (0..NODES).map(|k| unit_vector(std::f32::consts::TAU * k as f32 / NODES as f32)).collect()
    }

    fn crawling(params: PseudopodParams) -> Pseudopods {
        let mut pseudopods = Pseudopods { rng: Rng::new(1, 1), ..Pseudopods::new(params) };
        pseudopods.network.reset(NODES);
        pseudopods
    }

    #[test]
    fn only_a_crawling_cell_that_holds_nothing_protrudes() {
        let mut pseudopods = crawling(PseudopodParams::default());
        assert!(!pseudopods.protrudes());
        pseudopods.front_centre = Some(3);
        assert!(pseudopods.protrudes());
        pseudopods.is_stiff = true;
        assert!(!pseudopods.protrudes());
    }

    #[test]
    fn the_membrane_is_soft_where_it_protrudes_only() {
        let mut pseudopods = crawling(PseudopodParams { stiffness: 0.5, ..PseudopodParams::default() });
        assert_eq!(pseudopods.stiffness(), [0.5; NODES]);
        pseudopods.network.excite(10, 0.1);
        let stiffness = pseudopods.stiffness();
        assert!((stiffness[10] - 0.05).abs() < 1e-6 && stiffness[30] == 0.5, "{stiffness:?}");
    }

    #[test]
    fn pseudopods_start_at_their_rate_and_all_around() {
        let outwards = outwards();
        let posture = Posture { outwards: &outwards, direction: Vec2::ZERO, tempo: 2.0, dt: 0.025 };
        let starts = |start_rate: f32| {
            let params = PseudopodParams { start_rate, split_share: 0.0, goal_bias: 0.0, ..PseudopodParams::default() };
            let mut pseudopods = crawling(params);
            let mut places = Vec::new();
            for _ in 0..2000 {
                pseudopods.advance(&posture);
                places.extend(outwards.iter().position(|&out| out == pseudopods.last));
                pseudopods.rest(0.0);
            }
            places
        };
        let mut places = starts(2.0);
        // 2000 steps of a tenth each, a quarter of the places accepted, eight trials.
        assert!((150..210).contains(&places.len()), "{}", places.len());
        places.sort_unstable();
        places.dedup();
        assert!(places.len() > 40, "{} nodes of {NODES}", places.len());
        assert_eq!(starts(0.0), []);
    }

    #[test]
    fn a_cell_spreads_with_its_activity_and_rounds_up_at_rest() {
        let outwards = outwards();
        let params = PseudopodParams {
            spreading: 0.8,
            start_rate: 0.0,
            life: 100.0,
            coverage: 0.2,
            ..PseudopodParams::default()
        };
        let mut pseudopods = crawling(params);
        let posture = Posture { outwards: &outwards, direction: Vec2::X, tempo: 1.0, dt: 0.02 };
        (0..20).for_each(|_| pseudopods.advance(&posture));
        assert!(pseudopods.spread < 0.95, "nothing is active: {}", pseudopods.spread);
        pseudopods.network.excite(0, 0.3);
        let spreads: Vec<f32> = (0..25).map(|_| (pseudopods.advance(&posture), pseudopods.spread).1).collect();
        assert!(spreads.is_sorted() && spreads[0] < 0.95 && spreads[24] > 1.3, "{spreads:?}");
        (0..200).for_each(|_| pseudopods.rest(0.02));
        assert!((pseudopods.spread - 1.0).abs() < 0.01 && pseudopods.is_sound(NODES), "{}", pseudopods.spread);
        assert!(!Pseudopods { spread: 2.5, ..pseudopods }.is_sound(NODES));
    }

    #[test]
    fn where_sides_alternate_always_they_do() {
        let outwards = outwards();
        let params = PseudopodParams { alternation: 1.0, split_spread: 0.0, ..PseudopodParams::default() };
        let mut pseudopods = crawling(params);
        for side in [1.0, -1.0, 1.0, -1.0] {
            (pseudopods.last, pseudopods.side) = (Vec2::X, -side);
            let k = pseudopods.beside_the_last(&outwards, Vec2::X).unwrap();
            assert!(outwards[k].y * side > 0.5, "{} after one on side {}", outwards[k], -side);
        }
    }

    #[test]
    fn the_push_follows_the_pseudopods_in_a_third_of_a_second() {
        let outwards = outwards();
        let params = PseudopodParams { start_rate: 0.0, life: 100.0, ..PseudopodParams::default() };
        let mut pseudopods = crawling(params);
        pseudopods.network.excite(0, 0.2);
        let posture = Posture { outwards: &outwards, direction: Vec2::X, tempo: 0.1, dt: 0.01 };
        let pushes: Vec<f32> = (0..30).map(|_| (pseudopods.advance(&posture), pseudopods.push.x).1).collect();
        assert!(pushes[0] > 0.0 && pushes[0] < 0.05 && (0.5..0.75).contains(&pushes[29]), "{pushes:?}");
    }
}
