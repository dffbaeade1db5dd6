//! Drives: velocities that a body gives to its own particles, for example the front of a crawling cell, and tows, velocities of
//! a body as a whole.

use super::force;
use super::lanes::LANES;
use crate::config::WorldConfig;
use crate::geometry::ring::direction_or;
use crate::particle::Particles;
use crate::particle::mass_properties::MassProperties;
use glam::Vec2;

/// Time in which a rod turns most of the way to its heading, s.
const TURN_TIME: f32 = 0.1;

/// Substep in which a particle that pulls a body takes on its whole velocity, s.
const PULL_SUBSTEP: f32 = 1.0 / 480.0;

/// Share of its change of velocity that a particle that pulls a body takes on at most: beyond twice the change it swings.
const MOST_PULL: f32 = 2.0;

/// One particle that is to move with a given velocity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive {
    pub particle: u32,
    /// Wanted velocity, units/s.
    pub velocity: Vec2,
    /// Largest acceleration towards it, units/s2; infinite sets it at once, as the thesis does.
    pub max_acceleration: f32,
    /// Whether the particle pulls a body along, by as much momentum as a substep of [`PULL_SUBSTEP`] gives it: with the whole change
    /// in each substep a body would be the faster, the more substeps there are. In substeps longer than 1/240 s it pulls less.
    pub is_pull: bool,
}

impl Drive {
    /// One that is not pulled back.
    pub(crate) fn new(particle: u32, velocity: Vec2, max_acceleration: f32) -> Self {
        Self { particle, velocity, max_acceleration, is_pull: false }
    }

    /// One that pulls its body along.
    pub(crate) fn pull(particle: u32, velocity: Vec2) -> Self {
        Self { particle, velocity, max_acceleration: f32::INFINITY, is_pull: true }
    }

    /// What of a change is made in a substep of `h`.
    fn limit(&self, change: Vec2, h: f32) -> Vec2 {
        let share = h / PULL_SUBSTEP;
        let share = if share < MOST_PULL { share } else { MOST_PULL };
        let change = change * if self.is_pull { share } else { 1.0 };
        change * super::ratio_limit(change.length_squared(), self.max_acceleration * h)
    }
}

pub(crate) fn apply(drives: &[Drive], particles: &mut Particles, h: f32) {
    for drive in drives {
        let i = drive.particle as usize;
        let change = drive.limit(drive.velocity - particles.velocity(i), h);
        particles.vx[i] += change.x;
        particles.vy[i] += change.y;
    }
}

/// The drives of a body that pulls itself along what it touches.
#[derive(Debug)]
pub(crate) struct Traction {
    pub drives: Vec<Drive>,
    /// Unit vector of the only directions in which they act; `None`: all.
    pub along: Option<Vec2>,
    /// Particles of the organisms that are pulled the other way; none where something fixed is touched.
    pub on: Vec<u32>,
}

/// Pulls bodies along, and what they touch the other way. Wanted velocities are relative to what is touched.
pub(crate) fn pull(tractions: &[Traction], particles: &mut Particles, h: f32) {
    for Traction { drives, along, on } in tractions {
        let ground = MassProperties::of(particles, on).map_or(Vec2::ZERO, |ground| ground.velocity);
        let mut given = Vec2::ZERO;
        for drive in drives {
            let i = drive.particle as usize;
            let change = ground + drive.velocity - particles.velocity(i);
            let change = along.map_or(change, |along| along * change.dot(along));
            let change = drive.limit(change, h);
            particles.vx[i] += change.x;
            particles.vy[i] += change.y;
            given += change * super::lanes::ratio(1.0, particles.inv_mass[i]);
        }
        force::push(particles, on, -given);
    }
}

/// A body in a block that is to move as a whole with a given velocity, with its first particle ahead.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tow {
    /// Its first particle, and the number of its particles.
    pub first: u32,
    pub slots: u32,
    /// Wanted velocity of its centre, units/s.
    pub velocity: Vec2,
    /// Where the first particle is to point: a unit vector, or zero to turn no further.
    pub heading: Vec2,
    /// Largest acceleration towards the velocity, units/s2, beyond that against drag.
    pub max_acceleration: f32,
    /// Damping of its own besides that of the medium, 1/s.
    pub own_damping: f32,
    /// Change of velocity in this step that needs no acceleration, units/s: at low Reynolds number nothing has inertia.
    pub at_once: f32,
}

impl Tow {
    fn particles(&self) -> impl Iterator<Item = usize> + use<> {
        (self.first as usize..).step_by(LANES).take(self.slots as usize)
    }

    fn mean_velocity(&self, particles: &Particles) -> Vec2 {
        self.particles().map(|i| particles.velocity(i)).sum::<Vec2>() / self.slots as f32
    }

    /// Brings the velocity of its centre nearer to the wanted one, by at most `limit`.
    fn approach(&self, particles: &mut Particles, limit: f32) {
        let change = self.velocity - self.mean_velocity(particles);
        let change = change * super::ratio_limit(change.length_squared(), limit);
        for i in self.particles() {
            particles.vx[i] += change.x;
            particles.vy[i] += change.y;
        }
    }

    /// Turns it towards its heading about its centre, which it leaves as it is.
    fn turn(&self, particles: &mut Particles, fastest: f32, limit: f32) {
        if self.slots < 2 {
            return;
        }
        let (first, last) = (self.first as usize, self.first as usize + (self.slots as usize - 1) * LANES);
        let rod = particles.between(last, first);
        let (axis, arm) = (direction_or(rod, Vec2::X), 0.5 * rod.length());
        let side = axis.perp_dot(self.heading);
        let side = if axis.dot(self.heading) < 0.0 { 1.0_f32.copysign(side) } else { side };
        let wanted = side * arm / TURN_TIME;
        let wanted = wanted * super::ratio_limit(wanted * wanted, fastest);
        let present = (particles.velocity(first) - particles.velocity(last)).dot(axis.perp()) * 0.5;
        let change = wanted - present;
        let change = axis.perp() * (change * super::ratio_limit(change * change, limit));
        for (slot, i) in self.particles().enumerate() {
            let share = 1.0 - 2.0 * slot as f32 / (self.slots - 1) as f32;
            particles.vx[i] += change.x * share;
            particles.vy[i] += change.y * share;
        }
    }
}

/// Begins a step: changes of velocity that need no acceleration.
pub(crate) fn begin_tows(tows: &[Tow], particles: &mut Particles) {
    for tow in tows.iter().filter(|tow| tow.at_once > 0.0) {
        tow.approach(particles, tow.at_once);
    }
}

pub(crate) fn apply_tows(tows: &[Tow], particles: &mut Particles, config: &WorldConfig, h: f32) {
    for tow in tows {
        let speed = tow.velocity.length();
        tow.approach(particles, (tow.max_acceleration + (config.damping + tow.own_damping) * speed) * h);
        let room = config.speed_limit() - speed;
        let room = if room > 0.0 { room } else { 0.0 };
        tow.turn(particles, if room < speed { room } else { speed }, tow.max_acceleration * h);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::line;
    use super::*;

    #[test]
    fn unlimited_drive_sets_and_limited_drive_approaches() {
        let mut p = line(1.0, [1.0, 1.0]);
        let drive = Drive::new(0, Vec2::new(3.0, 4.0), f32::INFINITY);
        apply(&[drive], &mut p, 0.01);
        assert_eq!(p.velocity(0), Vec2::new(3.0, 4.0));
        apply(&[Drive { particle: 1, max_acceleration: 100.0, ..drive }], &mut p, 0.01);
        assert!((p.velocity(1).length() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_pull_gives_as_much_momentum_per_second_in_substeps_of_any_length() {
        for h in [1.0 / 240.0, 1.0 / 480.0, 1.0 / 3840.0] {
            let mut p = line(1.0, [1.0, 1.0]);
            apply(&[Drive::pull(0, Vec2::new(3.0, 4.0))], &mut p, h);
            assert!((p.velocity(0).length() / h - 2400.0).abs() < 1.0, "substep {h}");
        }
        let mut p = line(1.0, [1.0, 1.0]);
        apply(&[Drive::pull(0, Vec2::new(3.0, 4.0))], &mut p, 1.0 / 60.0);
        assert!((p.velocity(0).length() - 10.0).abs() < 1e-3, "at most twice the change");
    }

    #[test]
    fn what_pulls_takes_on_its_velocity_in_both_directions_and_pushes_back() {
        let mut p = line(1.0, [1.0, 0.5]);
        let drives = vec![Drive::new(0, Vec2::new(3.0, 4.0), f32::INFINITY)];
        pull(&[Traction { drives, along: None, on: vec![1] }], &mut p, 0.01);
        assert_eq!([p.velocity(0), p.velocity(1)], [Vec2::new(3.0, 4.0), Vec2::new(-1.5, -2.0)]);
    }

    #[test]
    fn a_tow_turns_a_rod_about_its_centre_as_fast_as_its_acceleration_allows() {
        let mut p = Particles::default();
        p.extend(3 * LANES);
        for slot in 0..3 {
            p.set(slot * LANES, &super::super::testing::disc(Vec2::new(-(slot as f32), 0.0), 1.0));
        }
        let [velocity, heading] = [Vec2::new(5.0, 0.0), Vec2::Y];
        let rates =
            Tow { first: 0, slots: 3, velocity, heading, max_acceleration: 100.0, own_damping: 0.0, at_once: 0.0 };
        let config = WorldConfig { damping: 0.0, ..WorldConfig::default() };
        apply_tows(&[rates], &mut p, &config, 0.01);
        let velocities = [0, LANES, 2 * LANES].map(|i| p.velocity(i));
        assert_eq!(velocities, [Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::new(1.0, -1.0)]);
    }
}
