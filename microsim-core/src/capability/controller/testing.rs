//! A bench on which a controller decides for a point-like organism of radius 1 in a room without walls.

use super::Controller;
use super::senses::{Environment, Other, Senses, Steering};
use crate::chemical::{Chemical, ChemicalSpec};
use crate::config::WorldConfig;
use crate::geometry::period::Period;
use crate::geometry::ring::{direction_or, ellipse};
use crate::id::OrganismId;
use crate::rng::Rng;
use glam::Vec2;

pub(super) const ROOM: Vec2 = Vec2::new(30.0, 20.0);

pub(super) struct Bench {
    pub controller: Controller,
    pub rng: Rng,
    pub dt: f32,
    pub at: Vec2,
    pub velocity: Vec2,
    pub speed: f32,
    pub others: Vec<Other>,
    pub chemicals: Vec<Chemical>,
}

impl Bench {
    pub(super) const ME: OrganismId = OrganismId { index: 7, generation: 0 };

    pub(super) fn new(controller: Controller, dt: f32) -> Self {
        let (rng, at, velocity) = (Rng::new(1, 1), Vec2::ZERO, Vec2::ZERO);
        Self { controller, rng, dt, at, velocity, speed: 1.0, others: Vec::new(), chemicals: Vec::new() }
    }

    pub(super) fn decide(&mut self) -> Option<Steering> {
        let around = Environment {
            size: ROOM,
            period: Period::NONE,
            dt: self.dt,
            chemicals: &self.chemicals,
            obstacles: &[],
            others: &self.others,
        };
        let outline: Vec<Vec2> = ellipse(Vec2::ONE, 16).into_iter().map(|arm| self.at + arm).collect();
        let (at, velocity, speed) = (self.at, self.velocity, self.speed);
        let senses = Senses {
            me: Self::ME,
            at,
            velocity,
            speed,
            radius: 1.0,
            arrival: 0.25,
            outline: &outline,
            around: &around,
        };
        self.controller.decide(&senses, &mut self.rng)
    }

    /// The direction of the next decision.
    pub(super) fn heading(&mut self) -> Option<Vec2> {
        let at = self.at;
        self.decide().map(|steering| direction_or(steering.goal - at, Vec2::ZERO))
    }

    /// Decides and moves, as what follows its steering exactly does.
    pub(super) fn walk(&mut self, speed: f32) {
        let (at, dt) = (self.at, self.dt);
        self.speed = speed;
        let velocity =
            |steering: Steering| direction_or(steering.goal - at, Vec2::ZERO) * (steering.relative_speed * speed);
        self.velocity = self.decide().map_or(Vec2::ZERO, velocity);
        self.at += self.velocity * dt;
    }
}

/// Mean square of the distance from the start after a time, s.
pub(super) fn mean_squared_displacement(controller: &Controller, speed: f32, time: f32, walkers: u64) -> f64 {
    const DT: f32 = 1.0 / 60.0;
    let square = |walker: u64| {
        let mut bench = Bench { rng: Rng::new(walker, 5), ..Bench::new(controller.clone(), DT) };
        (0..(time / DT).round() as u32).for_each(|_| bench.walk(speed));
        f64::from(bench.at.length_squared())
    };
    (0..walkers).map(square).sum::<f64>() / walkers as f64
}

/// A chemical that rises evenly from 0 at the left wall, as long as it is not stepped.
pub(super) fn slope(per_unit: f32) -> Chemical {
    let spec = ChemicalSpec { spacing: 1.0, ..ChemicalSpec::default() };
    let mut chemical = Chemical::new(spec, &WorldConfig { size: ROOM, ..WorldConfig::default() }).unwrap();
    for (column, row) in (0..30_u8).flat_map(|column| (0..20_u8).map(move |row| (column, row))) {
        let at = Vec2::new(f32::from(column) + 0.5, f32::from(row) + 0.5);
        chemical.add(at, per_unit * at.x);
    }
    chemical
}

pub(super) fn engulfer(index: u32, at: Vec2) -> Other {
    let id = OrganismId { index, generation: 0 };
    Other { id, at, velocity: Vec2::ZERO, radius: 1.0, is_engulfer: true, is_prey: false }
}

pub(super) fn prey(index: u32, at: Vec2) -> Other {
    Other { radius: 0.5, is_engulfer: false, is_prey: true, ..engulfer(index, at) }
}
