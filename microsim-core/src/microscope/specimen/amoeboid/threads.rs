//! Threads of a crawling cell: mitochondria in it, retraction fibres and thin processes at it.

use super::super::front::Front;
use super::super::thread::Thread;
use super::AmoeboidBody;
use crate::geometry::{rotate, unit_vector};
use crate::microscope::maths::{larger, smoothstep};
use crate::microscope::matter::Matter;
use crate::microscope::noise::{HashRng, scramble, wobble};
use crate::template::Role;
use crate::world::view::{OrganismView, ParticleView};
use glam::Vec2;
use std::f32::consts::TAU;

/// Time that a thin process takes to come and go, s; half its width where it begins, micrometres, and its points.
const PROCESS_PERIOD: f32 = 5.0;
const PROCESS: f32 = 0.26;
const PROCESS_POINTS: usize = 4;
/// Half the width of a mitochondrion, micrometres, its points, and turns that it makes in a second.
const MITOCHONDRION: f32 = 0.13;
const MITOCHONDRION_POINTS: usize = 4;
const WRITHING: f32 = 0.15;

impl AmoeboidBody {
    /// Retraction fibres, which the tail leaves on the glass, and all other threads.
    pub(in super::super) fn threads(&self, organism: OrganismView<'_>) -> Vec<Thread> {
        let Front { direction, tail: strength, behind, .. } = self.front;
        let mut rng = HashRng::new(self.seed ^ 0xf1b);
        let tail = self.field.pushed_inside(self.centre - direction * behind, 0.1);
        let fibre = |_| {
            let direction = rotate(-direction, unit_vector(rng.range([-0.45, 0.45])));
            let length = rng.range([2.0, 4.0]) * strength;
            let matter = Matter { cytoplasm: 0.10, ..Matter::phase(0.20) } * strength;
            Thread { from: tail, to: tail + direction * length, radius: 0.09, matter, peak: 0.0 }
        };
        let mut threads: Vec<Thread> = (0..self.look.fibres).map(fibre).collect();
        (0..self.look.processes).for_each(|k| self.process(k, &mut threads));
        let carriers = organism.particles().filter(|particle| particle.role == Role::Cytoplasm);
        carriers.for_each(|carrier| self.mitochondria_on(&carrier, &mut threads));
        threads
    }

    /// Mitochondria on the particle of cytoplasm that carries them: bent rods, near the nucleus and along the cell.
    fn mitochondria_on(&self, carrier: &ParticleView, threads: &mut Vec<Thread>) {
        let mut rng = HashRng::new(carrier.index ^ 0x3170);
        let spacing = 2.0 * carrier.radius;
        let expected = self.look.mitochondria * 0.866 * spacing * spacing;
        for _ in 0..((expected + rng.unit()) as u32).min(8) {
            let at = carrier.position + Vec2::new(rng.range([-0.5, 0.5]), rng.range([-0.5, 0.5])) * spacing;
            let length = self.look.longest_mitochondrion * (0.25 + 0.75 * rng.unit());
            let turned = wobble(self.time * WRITHING, rng.bits()) + TAU * rng.unit();
            let (bend, threshold, dense) = (unit_vector(0.5 * rng.normal()), rng.unit(), rng.range([0.5, 1.2]));
            let room = smoothstep(0.2, 0.7, self.field.at(at) - 0.5 * length - 0.5 * self.look.ectoplasm);
            let share = room * (1.0 - self.lamella(at)) * (1.0 - 0.9 * self.nucleus(at, 0.1));
            let share = share * smoothstep(threshold - 0.1, threshold + 0.1, 0.25 + 0.8 * self.crowd(at));
            if share < 0.02 {
                continue;
            }
            let mut step = rotate(Vec2::X, unit_vector(turned)) * (length / (MITOCHONDRION_POINTS - 1) as f32);
            let mut place = at - step * (0.5 * (MITOCHONDRION_POINTS - 1) as f32);
            let points: [Vec2; MITOCHONDRION_POINTS] = std::array::from_fn(|_| {
                let point = place;
                place += step;
                step = rotate(step, bend);
                point
            });
            let matter = Matter { cytoplasm: 0.45, ..Matter::phase(0.14) } * (share * dense);
            threads.extend(Thread::curve(&points, |k| MITOCHONDRION / larger(k as f32, 1.0).sqrt(), matter));
        }
    }

    /// A thin process: it grows out of the membrane, bent and tapering, goes back, and grows again somewhere else.
    fn process(&self, number: u32, threads: &mut Vec<Thread>) {
        let own = scramble(self.seed ^ scramble(number));
        let cycle = self.time / PROCESS_PERIOD + HashRng::new(own).unit();
        let mut rng = HashRng::new(own ^ scramble(cycle as u32));
        let direction = (self.from_shape.inverse() * rng.direction()).normalize_or_zero();
        let grown = unit_vector(TAU * 0.5 * cycle.fract()).y;
        let length = self.look.longest_process * rng.unit() * grown;
        let Some(edge) = self.field.crossing(self.centre, direction, 0.05 * self.radius) else { return };
        let mut at = self.centre + direction * (edge - 0.5);
        let mut step =
            rotate(direction, unit_vector(0.4 * rng.normal())) * ((length + 0.5) / (PROCESS_POINTS - 1) as f32);
        let bend = unit_vector(0.35 * rng.normal());
        let points: [Vec2; PROCESS_POINTS] = std::array::from_fn(|_| {
            let point = at;
            at += step;
            step = rotate(step, bend);
            point
        });
        let matter = Matter { cytoplasm: 0.12, ..Matter::phase(0.20) } * smoothstep(0.1, 0.6, length);
        let radius = |k: usize| PROCESS / (1 + k) as f32;
        threads.extend(Thread::curve(&points, radius, matter));
    }
}
