//! Chemotaxis with the whole outline: a cell compares how many receptors are occupied all around it and turns towards where
//! there are more; what it cannot tell apart it ignores, and walks at random.
//!
//! Occupancy `c / (c + K)`: Zigmond 1977 (J. Cell Biol. 75, 606), who found that neutrophils tell a difference of about 1 %
//! across their length, best near `K`. That receptors are counted sets the lower limit: of `N` receptors around the rim about
//! `N q` are occupied, binomially, so that each component of the reading has the variance `8 (1 - q) / (N q)` (Berg and Purcell
//! 1977, Biophys. J. 20, 193; around a rim Hu et al. 2010), and what no receptor tells is not heard. Direction from the first moment of the occupancy around the rim: Hu et al. 2010
//! (Phys. Rev. Lett. 105, 048104). Turning bit by bit instead of growing a new front: Arrieumerlou and Meyer 2005 (Dev. Cell
//! 8, 215).

use super::persistent_walk::{PersistentWalk, PersistentWalkParams};
use super::senses::{Senses, Steering, larger};
use crate::error::{Error, in_range};
use crate::geometry::ring::{direction_or, rotate, unit_vector};
use crate::id::ChemicalId;
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Receptors of a cell, about those of *Dictyostelium* (Hu et al. 2010). Between readings all of them change.
const RECEPTORS: f32 = 80_000.0;

/// Parameters of chemotaxis, see [`super::Controller::chemotaxis`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChemotaxisParams {
    /// The chemical that attracts it.
    pub chemical: ChemicalId,
    /// Concentration at which half of its receptors are occupied, amount per square unit, 1e-9 to 1e9.
    pub saturation: f32,
    /// Least difference of occupancy between its two sides that it goes by, over the mean occupancy, 0 to 2.
    pub threshold: f32,
    /// Standard deviation of each component of that difference in one reading, 0 to 2, beside that of the number of occupied
    /// receptors.
    pub noise: f32,
    /// Time from one reading to the next, s, 0.01 to 60.
    pub interval: f32,
    /// Fastest turn, radians/s, 0 to 100.
    pub turn_rate: f32,
    /// Time over which it keeps its direction otherwise, s, as in [`PersistentWalkParams`].
    pub persistence: f32,
}

impl ChemotaxisParams {
    /// The defaults, towards this chemical.
    #[must_use]
    pub fn towards(chemical: ChemicalId) -> Self {
        Self {
            chemical,
            saturation: 1.0,
            threshold: 0.02,
            noise: 0.01,
            interval: 0.25,
            turn_rate: 2.0,
            persistence: 10.0,
        }
    }
}

/// A persistent random walk that turns towards a chemical.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chemotaxis {
    pub(super) params: ChemotaxisParams,
    pub(super) walk: PersistentWalk,
    /// Where the last reading said that there is more: a unit vector.
    signal: Option<Vec2>,
    /// Time until the next reading, s.
    remaining: f32,
}

impl Chemotaxis {
    pub(super) fn new(params: ChemotaxisParams) -> Self {
        let walk = PersistentWalk::new(PersistentWalkParams { persistence: params.persistence });
        Self { params, walk, signal: None, remaining: 0.0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        in_range("saturation", self.params.saturation, 1e-9, 1e9)?;
        in_range("threshold", self.params.threshold, 0.0, 2.0)?;
        in_range("noise", self.params.noise, 0.0, 2.0)?;
        in_range("interval", self.params.interval, 0.01, 60.0)?;
        in_range("turn_rate", self.params.turn_rate, 0.0, 100.0)?;
        self.walk.validate()
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let dt = senses.around.dt;
        self.remaining -= dt;
        if self.remaining <= 0.0 {
            self.remaining = self.params.interval;
            self.signal = self.read(senses, rng);
        }
        self.walk.turn(dt, rng);
        self.walk.heading = match self.signal {
            Some(signal) => turned(self.walk.heading, signal, self.params.turn_rate * dt),
            // What it is after may sit at a wall.
            None => senses.along_walls(self.walk.heading),
        };
        Some(senses.along(self.walk.heading))
    }

    /// Where a reading says that there is more, if it says anything.
    fn read(&self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Vec2> {
        let (difference, occupancy) = self.compare(senses);
        let occupied = RECEPTORS * occupancy;
        let variance = self.params.noise * self.params.noise + 8.0 * (1.0 - occupancy) / larger(occupied, 1.0);
        let reading = difference + Vec2::new(rng.normal(), rng.normal()) * variance.sqrt();
        // With the probability of this none is occupied.
        let is_silent = rng.exponential() > occupied;
        let is_heard = !is_silent && reading.length_squared() > self.params.threshold * self.params.threshold;
        is_heard.then(|| direction_or(reading, Vec2::X))
    }

    /// Difference of occupancy between two sides of the outline, over the mean, and where it points: twice the first moment; and
    /// the mean.
    fn compare(&self, senses: &Senses<'_>) -> (Vec2, f32) {
        let (mut sum, mut moment, mut middle) = (0.0, Vec2::ZERO, Vec2::ZERO);
        for &node in senses.outline {
            let concentration = senses.concentration(self.params.chemical, node);
            let occupancy = concentration / (concentration + self.params.saturation);
            let outwards = direction_or(node - senses.at, Vec2::ZERO);
            sum += occupancy;
            moment += outwards * occupancy;
            middle += outwards;
        }
        let count = senses.outline.len() as f32;
        // Nodes are not spread evenly in direction around a cell that is not round.
        let moment = moment - middle * (sum / count);
        if sum > 0.0 { (moment * (4.0 / sum), sum / count) } else { (Vec2::ZERO, 0.0) }
    }
}

/// A unit vector turned towards another one by at most an angle, radians.
fn turned(heading: Vec2, towards: Vec2, angle: f32) -> Vec2 {
    let limit = unit_vector(if angle < std::f32::consts::PI { angle } else { std::f32::consts::PI });
    if heading.dot(towards) >= limit.x {
        return towards;
    }
    let side = if heading.perp_dot(towards) >= 0.0 { limit } else { Vec2::new(limit.x, -limit.y) };
    rotate(heading, side)
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::{Bench, slope};
    use super::*;

    fn bench(change: impl Fn(&mut ChemotaxisParams)) -> Bench {
        let mut params = ChemotaxisParams { noise: 0.0, ..ChemotaxisParams::towards(ChemicalId(0)) };
        change(&mut params);
        let mut bench = Bench::new(Controller::chemotaxis(params), 0.1);
        bench.chemicals = vec![slope(0.2)];
        bench.at = Vec2::new(15.0, 10.0);
        bench
    }

    /// Mean of the heading's component along the slope in 60 s.
    fn drift(mut bench: Bench) -> f32 {
        for _ in 0..50 {
            bench.decide();
        }
        (0..600).map(|_| bench.heading().unwrap().x).sum::<f32>() / 600.0
    }

    #[test]
    fn it_turns_up_the_slope_no_faster_than_its_limit() {
        assert!(drift(bench(|_| {})) > 0.9);
        let mut bench = bench(|params| (params.turn_rate, params.persistence) = (0.5, 1e4));
        let ways: Vec<Vec2> = (0..100).map(|_| bench.heading().unwrap()).collect();
        let fastest = ways.windows(2).map(|pair| (pair[1] - pair[0]).length()).fold(0.0, f32::max);
        assert!(fastest < 0.05 + 0.03, "{fastest} in 0.1 s, noise included");
    }

    #[test]
    fn what_is_too_faint_or_saturates_or_is_not_there_is_not_followed() {
        assert!(drift(bench(|params| params.threshold = 0.5)).abs() < 0.6, "below the threshold");
        assert!(drift(bench(|params| (params.saturation, params.threshold) = (1e-3, 0.01))).abs() < 0.6, "saturated");
        assert!(drift(bench(|params| params.chemical = ChemicalId(9))).abs() < 0.6, "not there");
        assert!(drift(bench(|params| params.noise = 2.0)).abs() < 0.6, "drowned in noise");
    }

    #[test]
    fn it_loses_its_way_with_the_number_of_occupied_receptors() {
        // Over the concentration where it is, which is 3.
        let index = |saturation: f32| {
            let drift = |seed| {
                let mut bench = bench(|params| (params.saturation, params.persistence) = (3.0 * saturation, 2.0));
                bench.rng = Rng::new(seed, 1);
                drift(bench)
            };
            (0..10).map(drift).sum::<f32>() / 10.0
        };
        let indices = [1.0, 1e2, 1e4, 1e6, 3e8].map(index);
        println!("chemotactic index at c / K of 1, 1e-2, 1e-4, 1e-6, 3e-9: {indices:?}");
        assert!(indices[0] > 0.9 && indices[1] > 0.5 && indices[2] < 0.4, "{indices:?}");
        assert!(indices[2] < indices[1] && indices[3].abs() < 0.15 && indices[4].abs() < 0.15, "{indices:?}");
    }

    #[test]
    fn turning_ends_at_its_aim() {
        assert_eq!(turned(Vec2::X, Vec2::Y, 2.0), Vec2::Y);
        assert!(turned(Vec2::X, Vec2::Y, 0.5).abs_diff_eq(unit_vector(0.5), 1e-6));
        assert!(turned(Vec2::X, -Vec2::Y, 0.5).abs_diff_eq(unit_vector(-0.5), 1e-6));
        assert_eq!(turned(Vec2::X, -Vec2::X, 100.0), -Vec2::X);
    }
}
