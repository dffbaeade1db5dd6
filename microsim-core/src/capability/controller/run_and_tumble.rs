//! Run and tumble of a bacterium: straight runs of random length, between them tumbles into a random direction. Too small to
//! compare its two ends, it compares now with before, and runs on while things get better.
//!
//! Times and angles: Berg and Brown 1972 (Nature 239, 500), *Escherichia coli* AW405. Memory of a few seconds: Segall, Block
//! and Berg 1986 (PNAS 83, 8987). What sets the lower limit is that receptors are counted: of `N` about `N q` are occupied, from one
//! reading to the next with the variance `N q (1 - q)` (Berg and Purcell 1977, Biophys. J. 20, 193), and the rate of tumbles is the
//! mean over that. Where nothing changes it is the same at any concentration (Barkai and Leibler 1997, Nature 387, 913). In an even field it diffuses with `v^2 tau^2 / (2 (1 - a) (tau + T))`, `a` being the mean
//! cosine of a turn and `T` the time of a tumble (Lovely and Dahlquist 1975, J. Theor. Biol. 50, 477, in two dimensions).

use super::check_time;
use super::senses::{Senses, Steering, larger};
use crate::error::{Error, in_range};
use crate::geometry::ring::{direction_or, rotate, unit_vector};
use crate::id::ChemicalId;
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// Receptors of a bacterium, about those of *Escherichia coli* (Li and Hazelbauer 2004, J. Bacteriol. 186, 3687): what it
/// remembers counts as one of them at least.
const RECEPTORS: f32 = 15_000.0;
/// Medians of the quarters of a half of the standard normal distribution.
const DEVIATIONS: [f32; 4] = [0.157, 0.489, 0.887, 1.534];

/// Parameters of run and tumble, see [`super::Controller::run_and_tumble`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunAndTumbleParams {
    /// Mean time of a run where nothing gets better, s, 0.02 to 600; at least three steps.
    pub run: f32,
    /// Mean time of a tumble, s, 0 to 60.
    pub tumble: f32,
    /// Mean and standard deviation of the angle by which a tumble turns it to either side, radians, 0 to 10 each.
    pub turn: [f32; 2],
    /// The chemical that attracts it, if any.
    pub chemical: Option<ChemicalId>,
    /// Concentration at which half of its receptors are occupied, amount per square unit, 1e-9 to 1e9.
    pub saturation: f32,
    /// Time over which it remembers, s, 0.02 to 600.
    pub memory: f32,
    /// By how much runs get longer, per rise of the occupancy over what it remembers, relative to that, 0 to 10 000.
    pub gain: f32,
}

impl Default for RunAndTumbleParams {
    fn default() -> Self {
        let degree = std::f32::consts::PI / 180.0;
        Self {
            run: 0.86,
            tumble: 0.14,
            turn: [68.0 * degree, 36.0 * degree],
            chemical: None,
            saturation: 1.0,
            memory: 2.0,
            gain: 30.0,
        }
    }
}

/// A bacterium's runs and tumbles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunAndTumble {
    pub(super) params: RunAndTumbleParams,
    /// A unit vector; zero before the first run.
    heading: Vec2,
    /// How much is left of a run, in mean runs.
    run_left: f32,
    /// How much is left of a tumble, s; it runs at 0.
    tumble_left: f32,
    /// Occupancy that it remembers; negative before the first step.
    remembered: f32,
}

impl RunAndTumble {
    pub(super) fn new(params: RunAndTumbleParams) -> Self {
        Self { params, heading: Vec2::ZERO, run_left: 0.0, tumble_left: 0.0, remembered: -1.0 }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        let RunAndTumbleParams { run, tumble, turn, saturation, memory, gain, .. } = self.params;
        in_range("run", run, 0.02, 600.0)?;
        in_range("tumble", tumble, 0.0, 60.0)?;
        in_range("turn[0]", turn[0], 0.0, 10.0)?;
        in_range("turn[1]", turn[1], 0.0, 10.0)?;
        in_range("saturation", saturation, 1e-9, 1e9)?;
        in_range("memory", memory, 0.02, 600.0)?;
        in_range("gain", gain, 0.0, 1e4)
    }

    pub(super) fn check_step(&self, dt: f32) -> Result<(), Error> {
        check_time("run", self.params.run, dt)
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let dt = senses.around.dt;
        let stretch = self.stretch(senses);
        if self.heading == Vec2::ZERO {
            self.heading = unit_vector(rng.range(0.0, TAU));
            self.run_left = rng.exponential();
        }
        if self.tumble_left > 0.0 {
            self.tumble_left -= dt;
            if self.tumble_left > 0.0 {
                return Some(senses.with_velocity(Vec2::ZERO));
            }
            self.begin_run(rng);
        }
        let part = dt / (self.params.run * stretch);
        self.run_left -= part;
        // Rounded to steps, runs and tumbles are neither longer nor shorter on average.
        if self.run_left <= 0.5 * part {
            self.tumble_left = self.params.tumble * rng.exponential() + 0.5 * dt;
            if self.tumble_left < dt {
                self.begin_run(rng);
            }
        }
        self.heading = senses.along_walls(self.heading);
        Some(senses.with_velocity(self.heading))
    }

    fn begin_run(&mut self, rng: &mut Rng) {
        let [mean, deviation] = self.params.turn;
        let angle = mean + deviation * rng.normal();
        let side = if rng.unit() < 0.5 { angle } else { -angle };
        self.heading = direction_or(rotate(self.heading, unit_vector(side)), Vec2::X);
        (self.run_left, self.tumble_left) = (rng.exponential(), 0.0);
    }

    /// By how much runs are longer than on average now: only what gets better counts, as far as it can be told from chance.
    fn stretch(&mut self, senses: &Senses<'_>) -> f32 {
        let Some(chemical) = self.params.chemical else { return 1.0 };
        let concentration = senses.concentration(chemical, senses.at);
        let occupancy = concentration / (concentration + self.params.saturation);
        if self.remembered < 0.0 {
            self.remembered = occupancy;
        }
        let before = larger(self.remembered, 1.0 / RECEPTORS);
        let rise = (occupancy - self.remembered) / before;
        let deviation = (occupancy * (1.0 - occupancy) / RECEPTORS).sqrt() / before;
        let part = senses.around.dt / (self.params.memory + senses.around.dt);
        self.remembered += (occupancy - self.remembered) * part;
        self.tumbles(0.0, deviation) / self.tumbles(rise, deviation)
    }

    /// Rate of tumbles over that of one that notices nothing, for a rise of the occupancy with this standard deviation, both over what it
    /// remembers.
    fn tumbles(&self, rise: f32, deviation: f32) -> f32 {
        let rate = |rise: f32| 1.0 / (1.0 + self.params.gain * larger(rise, 0.0));
        let both = |off: &f32| rate(rise + off * deviation) + rate(rise - off * deviation);
        DEVIATIONS.iter().map(both).sum::<f32>() / 8.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::{Bench, mean_squared_displacement, slope};
    use super::*;

    #[test]
    fn it_diffuses_as_theory_says() {
        let speed = 14.2;
        let params = RunAndTumbleParams::default();
        let [run, tumble, mean, deviation] = [params.run, params.tumble, params.turn[0], params.turn[1]].map(f64::from);
        let cosine = mean.cos() * (-0.5 * deviation * deviation).exp();
        let expected = f64::from(speed).powi(2) * run * run / (2.0 * (1.0 - cosine) * (run + tumble));
        let time = 60.0;
        let walk = Controller::run_and_tumble(params);
        // Between two times, so that the beginning, which is straighter, does not count.
        let rise =
            mean_squared_displacement(&walk, speed, time, 6000) - mean_squared_displacement(&walk, speed, 5.0, 6000);
        let measured = rise / (4.0 * (f64::from(time) - 5.0));
        println!("diffusion of run and tumble {measured:.1}, theory {expected:.1}, mean cosine {cosine:.3}");
        assert!((measured / expected - 1.0).abs() < 0.05, "{measured} instead of {expected}");
    }

    #[test]
    fn it_tumbles_for_its_share_of_the_time_and_turns_by_its_angle() {
        let mut bench = Bench::new(Controller::run_and_tumble(RunAndTumbleParams::default()), 1.0 / 60.0);
        let ways: Vec<Vec2> = (0..120_000)
            .map(|_| {
                let at = bench.at;
                let steering = bench.decide().unwrap();
                direction_or(steering.goal - at, Vec2::ZERO) * steering.relative_speed
            })
            .collect();
        let tumbling = ways.iter().filter(|way| **way == Vec2::ZERO).count() as f32 / ways.len() as f32;
        let runs: Vec<Vec2> = ways.chunk_by(|a, b| a == b).map(|run| run[0]).filter(|way| *way != Vec2::ZERO).collect();
        let cosine = runs.windows(2).map(|pair| pair[0].dot(pair[1])).sum::<f32>() / (runs.len() - 1) as f32;
        // 0.14 of 0.14 + 0.86 s; cos 68 degrees times exp(-(36 degrees)^2 / 2)
        assert!((tumbling / 0.14 - 1.0).abs() < 0.1, "{tumbling}");
        assert!((cosine - 0.3075).abs() < 0.06, "{cosine} of {}", runs.len());
    }

    /// Mean way up a slope in 20 s, with a saturation relative to the concentration at the start.
    fn drift(chemical: Option<ChemicalId>, saturation: f32) -> f32 {
        let params = RunAndTumbleParams { chemical, saturation: 1.5 * saturation, ..RunAndTumbleParams::default() };
        let mut total = 0.0;
        for seed in 0..200 {
            let mut bench = Bench::new(Controller::run_and_tumble(params), 0.05);
            bench.chemicals = vec![slope(0.1)];
            bench.rng = Rng::new(seed, 1);
            bench.at = Vec2::new(15.0, 10.0);
            (0..400).for_each(|_| bench.walk(1.0));
            total += bench.at.x - 15.0;
        }
        total / 200.0
    }

    #[test]
    fn it_drifts_up_a_slope_and_not_without_a_sense_of_it() {
        let (blind, seeing) = (drift(None, 1.0), drift(Some(ChemicalId(0)), 1.0));
        assert!(blind.abs() < 1.0 && seeing > 1.5, "blind {blind}, seeing {seeing}");
    }

    #[test]
    fn it_loses_its_way_with_the_number_of_occupied_receptors() {
        let drifts = [1.0, 10.0, 1e2, 1e3, 1e4, 1e6].map(|saturation| drift(Some(ChemicalId(0)), saturation));
        println!("drift at c / K of 1, 0.1, 1e-2, 1e-3, 1e-4, 1e-6: {drifts:?}");
        assert!(drifts[0] > 1.5 && drifts[1] > 1.5 && drifts[3] < 0.5 * drifts[1], "{drifts:?}");
        assert!(drifts[4].abs() < 0.7 && drifts[5].abs() < 0.7, "{drifts:?}");
    }

    #[test]
    fn a_rise_counts_the_less_the_more_of_it_may_be_chance() {
        let walk = RunAndTumble::new(RunAndTumbleParams::default());
        let rates = [0.0, 0.01, 0.1, 1.0, 100.0].map(|off| walk.tumbles(0.1, off) / walk.tumbles(0.0, off));
        assert!(rates[0] == 0.25 && rates[4] < 1.0 && rates.is_sorted(), "{rates:?}");
    }
}
