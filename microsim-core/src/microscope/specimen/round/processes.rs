//! Processes of bodies that are described from their centre outwards: filopodia and cilia.

use super::super::thread::Thread;
use super::RoundBody;
use crate::geometry::{direction_or, rotate, unit_vector};
use crate::look::Cilia;
use crate::microscope::maths::mix;
use crate::microscope::matter::Matter;
use crate::microscope::noise::{HashRng, wobble};
use glam::Vec2;
use std::f32::consts::TAU;

/// Points of the curve that a cilium is.
const CILIUM_POINTS: usize = 5;
/// The same for a filopodium.
const FILOPODIUM_POINTS: usize = 6;

impl RoundBody {
    /// Processes into which its edge is drawn out: broad where they begin, and bent.
    pub(super) fn filopodia(&self, threads: &mut Vec<Thread>) {
        let mut rng = HashRng::new(self.seed ^ 0xf170);
        let count = if self.look.filopodia > 0 { rng.bits() % (self.look.filopodia + 1) } else { 0 };
        for _ in 0..count {
            let (own, mean) = (rng.direction(), self.polar.mean);
            let share = rng.unit();
            let (length, width) = ((0.15 + 0.65 * share * share) * mean, rng.range([0.10, 0.22]) * mean);
            let mut at = self.place(own, 0.72);
            let mut step = rotate(rotate(own, self.facing), unit_vector(0.35 * rng.normal()));
            step *= (length + 0.28 * mean) / (FILOPODIUM_POINTS - 1) as f32;
            let bend = unit_vector(0.22 * rng.normal());
            let points: [Vec2; FILOPODIUM_POINTS] = std::array::from_fn(|_| {
                let point = at;
                at += step;
                step = rotate(step, bend);
                point
            });
            let matter = Matter { cytoplasm: 0.08, ..Matter::phase(0.10) } * rng.range([0.5, 1.2]);
            threads.extend(Thread::curve(&points, |k| width / (1.0 + 0.9 * k as f32), matter));
        }
    }

    /// The cilium at a share of the way around: it swings with the metachronal wave and bends as it swings.
    pub(super) fn cilium(&self, cilia: &Cilia, share: f32, time: f32, threads: &mut Vec<Thread>) {
        // Between even in angle and even on the stretched disc, they are about as dense everywhere.
        let stretch = Vec2::new(self.axes.x.sqrt(), self.axes.y.sqrt());
        let root = |share: f32| {
            let direction = rotate(unit_vector(TAU * share) * stretch, self.facing).normalize_or_zero();
            self.polar.centre + direction * self.polar.radius(direction)
        };
        let from = root(share);
        let outwards = -direction_or(root(share + 0.004) - root(share - 0.004), Vec2::X).perp();
        let wave = unit_vector(TAU * (share * cilia.waves - time * cilia.rate) + 0.6 * wobble(share * 40.0, self.seed));
        // No two beat quite alike, and some are bent or broken.
        let mut rng = HashRng::new(self.seed ^ share.to_bits());
        let aside = 0.16 * rng.normal();
        let part = cilia.length * self.polar.mean * rng.range([0.6, 1.15]) / (CILIUM_POINTS - 1) as f32;
        let mut at = from;
        let point = |k: usize| {
            let point = at;
            let along = k as f32 / (CILIUM_POINTS - 2) as f32;
            let swing = mix(0.5 * wave.y - 0.3, 0.8 * wave.y - 0.55 + 0.35 * wave.x, along);
            at += rotate(outwards, unit_vector(swing + aside)) * part;
            point
        };
        let points: [Vec2; CILIUM_POINTS] = std::array::from_fn(point);
        let matter = Matter { cytoplasm: 0.15, ..Matter::phase(cilia.phase) };
        threads.extend(Thread::curve(&points, |_| 0.5 * cilia.width, matter));
    }
}
