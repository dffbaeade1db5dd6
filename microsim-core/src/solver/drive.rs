//! Drives: velocities that a body gives to its own particles, for example the front of a crawling cell.

use crate::particle::Particles;
use glam::Vec2;

/// One particle that is to move with a given velocity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive {
    pub particle: u32,
    /// Wanted velocity, units/s.
    pub velocity: Vec2,
    /// Largest acceleration towards it, units/s2; infinite sets it at once, as the seed does.
    pub max_acceleration: f32,
}

pub(crate) fn apply(drives: &[Drive], particles: &mut Particles, h: f32) {
    for drive in drives {
        let i = drive.particle as usize;
        let change = drive.velocity - particles.velocity(i);
        let limit = super::ratio_limit(change.length_squared(), drive.max_acceleration * h);
        particles.vx[i] += change.x * limit;
        particles.vy[i] += change.y * limit;
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::line;
    use super::*;

    #[test]
    fn unlimited_drive_sets_and_limited_drive_approaches() {
        let mut p = line(1.0, [1.0, 1.0]);
        let drive = Drive { particle: 0, velocity: Vec2::new(3.0, 4.0), max_acceleration: f32::INFINITY };
        apply(&[drive], &mut p, 0.01);
        assert_eq!(p.velocity(0), Vec2::new(3.0, 4.0));
        apply(&[Drive { particle: 1, max_acceleration: 100.0, ..drive }], &mut p, 0.01);
        assert!((p.velocity(1).length() - 1.0).abs() < 1e-6);
    }
}
