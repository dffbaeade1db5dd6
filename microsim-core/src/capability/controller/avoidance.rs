//! The avoiding reaction of a ciliate such as *Paramecium*: it swims on a helix, which from above is a swaying line; where its
//! front meets something it backs up, turns to a side and swims on. What it grazes it follows.
//!
//! Jennings 1906 (Behavior of the Lower Organisms, ch. 3); times and angles Elices et al. 2023 (PLOS Comput. Biol. 19,
//! e1010899); swimming along walls Ohmura et al. 2018 (PNAS 115, 3231).

use super::senses::{Senses, Steering};
use crate::error::{Error, in_range};
use crate::geometry::ring::{direction_or, rotate, unit_vector};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::{PI, TAU};

/// Share of its speed from which on it is on its way, ...
const CRUISING: f32 = 0.6;
/// ... and below which, once it has been, something stops it.
const STOPPED: f32 = 0.3;

/// Parameters of the avoiding reaction, see [`super::Controller::avoidance`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AvoidanceParams {
    /// Shortest and longest time for which it backs up, s, 0.05 to 60.
    pub back: [f32; 2],
    /// Smallest and largest angle by which it turns then, to either side, radians, 0 to pi.
    pub turn: [f32; 2],
    /// Largest angle between its way and a wall at which it follows the wall instead, radians, 0 to pi / 2.
    pub follow: f32,
    /// Mean time between avoiding reactions that nothing causes, s, 0.1 to 100 000.
    pub spontaneous: f32,
    /// Angle of the helix, radians, 0 to 1.5.
    pub sway: f32,
    /// Time of one turn of the helix, s, 0.05 to 600.
    pub period: f32,
}

impl Default for AvoidanceParams {
    fn default() -> Self {
        let degree = PI / 180.0;
        Self {
            back: [0.4, 0.9],
            turn: [40.0 * degree, 140.0 * degree],
            follow: 35.0 * degree,
            spontaneous: 15.0,
            sway: 12.0 * degree,
            period: 1.2,
        }
    }
}

/// A swaying way, and the reaction to what is in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Avoidance {
    params: AvoidanceParams,
    /// Its way, a unit vector; zero before the first step.
    heading: Vec2,
    /// How far around the helix it is, 0 to 1.
    phase: f32,
    /// Time for which it still backs up, s.
    backing: f32,
    /// Whether it has come up to speed since it last turned: what is heavy takes a while.
    is_cruising: bool,
}

impl Avoidance {
    pub(super) fn new(params: AvoidanceParams) -> Self {
        Self { params, heading: Vec2::ZERO, phase: 0.0, backing: 0.0, is_cruising: false }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        let AvoidanceParams { back, turn, follow, spontaneous, sway, period } = self.params;
        in_range("back[0]", back[0], 0.05, 60.0)?;
        in_range("back[1]", back[1], back[0], 60.0)?;
        in_range("turn[0]", turn[0], 0.0, PI)?;
        in_range("turn[1]", turn[1], turn[0], PI)?;
        in_range("follow", follow, 0.0, 0.5 * PI)?;
        in_range("spontaneous", spontaneous, 0.1, 1e5)?;
        in_range("sway", sway, 0.0, 1.5)?;
        in_range("period", period, 0.05, 600.0)
    }

    pub(super) fn decide(&mut self, senses: &Senses<'_>, rng: &mut Rng) -> Option<Steering> {
        let dt = senses.around.dt;
        if self.heading == Vec2::ZERO {
            (self.heading, self.phase) = (unit_vector(rng.range(0.0, TAU)), rng.unit());
        }
        if self.backing > 0.0 {
            self.backing -= dt;
            if self.backing <= 0.0 {
                self.turn(rng);
            }
            return Some(Steering { relative_speed: -1.0, ..senses.along(self.heading) });
        }
        let forwards = senses.velocity.dot(self.heading);
        self.is_cruising |= forwards > CRUISING * senses.speed;
        let is_stopped = self.is_cruising && forwards < STOPPED * senses.speed;
        let steepest = unit_vector(self.params.follow).y;
        let hits = senses.wall_ahead(self.heading).is_some_and(|away| -away.dot(self.heading) > steepest);
        if hits || is_stopped || rng.unit() * self.params.spontaneous < dt {
            self.is_cruising = false;
            self.backing = rng.range(self.params.back[0], self.params.back[1]);
        }
        self.heading = senses.along_walls(self.heading);
        self.phase = (self.phase + dt / self.params.period).fract();
        let sway = self.params.sway * unit_vector(TAU * self.phase).y;
        Some(senses.along(rotate(self.heading, unit_vector(sway))))
    }

    /// Swims on in a direction.
    pub(super) fn head(&mut self, way: Vec2) {
        (self.heading, self.backing, self.is_cruising) = (way, 0.0, false);
    }

    fn turn(&mut self, rng: &mut Rng) {
        let angle = rng.range(self.params.turn[0], self.params.turn[1]);
        let side = if rng.unit() < 0.5 { angle } else { -angle };
        self.heading = direction_or(rotate(self.heading, unit_vector(side)), Vec2::X);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Controller;
    use super::super::testing::Bench;
    use super::*;
    use crate::{Inputs, Placement, RigidCellSpec, World, WorldConfig};

    /// It and its heading, at 1/60 s.
    fn bench(backing: f32) -> Bench {
        let params = AvoidanceParams { spontaneous: 1e5, ..AvoidanceParams::default() };
        let model = Avoidance { heading: Vec2::X, backing, ..Avoidance::new(params) };
        assert_eq!(model.validate(), Ok(()), "the default is in its ranges");
        Bench::new(Controller::Avoidance(model), 1.0 / 60.0)
    }

    #[test]
    fn it_sways_by_its_angle_to_both_sides_in_each_period() {
        let mut bench = bench(0.0);
        let angles: Vec<f32> = (0..72).map(|_| bench.heading().unwrap().y).collect();
        let least = angles.iter().copied().min_by(f32::total_cmp).unwrap();
        let most = angles.iter().copied().max_by(f32::total_cmp).unwrap();
        let sine = unit_vector(AvoidanceParams::default().sway).y;
        assert!((most / sine - 1.0).abs() < 0.05 && (least / sine + 1.0).abs() < 0.05, "{least} to {most}");
    }

    #[test]
    fn it_backs_up_for_its_time_and_turns_then() {
        let mut bench = bench(0.5);
        let speeds: Vec<f32> = (0..40).map(|_| bench.decide().unwrap().relative_speed).collect();
        let backing = speeds.iter().take_while(|&&speed| speed == -1.0).count();
        assert!((29..=31).contains(&backing) && speeds[backing..].iter().all(|&speed| speed == 1.0), "{speeds:?}");
        let Controller::Avoidance(model) = &bench.controller else { unreachable!() };
        assert!(model.heading.x.abs() < 0.767, "40 to 140 degrees to a side: {}", model.heading);
    }

    #[test]
    fn at_a_wall_it_backs_up_turns_and_swims_on() {
        let mut world =
            World::new(WorldConfig { size: Vec2::new(120.0, 80.0), seed: 4, ..WorldConfig::default() }).unwrap();
        let params = AvoidanceParams { spontaneous: 1e5, ..AvoidanceParams::default() };
        let placement = Placement::at(60.0, 40.0).steered_by(Controller::avoidance(params));
        let cell = world.spawn(&RigidCellSpec::default().into(), placement).unwrap();
        let mut places = vec![world.centroid(cell).unwrap()];
        for _ in 0..240 {
            (0..15).for_each(|_| world.step(&Inputs::new()));
            places.push(world.centroid(cell).unwrap());
        }
        let moves: Vec<Vec2> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let reversals = moves.windows(2).filter(|pair| pair[0].dot(pair[1]) < 0.0).count();
        let stays = |places: &&[Vec2]| places.iter().all(|at| at.distance(places[0]) < 0.5);
        let pinned = places.windows(5).filter(stays).count();
        assert!(reversals >= 4, "{reversals} reversals in a minute");
        assert_eq!(pinned, 0, "seconds in which it got nowhere");
    }
}
