//! Threads of a crawling cell: mitochondria in it, retraction fibres and thin processes at it.

use super::super::front::Front;
use super::super::thread::Thread;
use super::AmoeboidBody;
use crate::geometry::{rotate, unit_vector};
use crate::microscope::maths::{larger, mix, smoothstep};
use crate::microscope::matter::Matter;
use crate::microscope::noise::{HashRng, scramble, wobble};
use crate::template::Role;
use crate::world::view::{OrganismView, ParticleView};
use glam::Vec2;
use std::f32::consts::TAU;

/// Time that a thin process takes to come and go, s; half its width where it begins, micrometres, and its points.
const PROCESS_PERIOD: f32 = 5.0;
const PROCESS: f32 = 0.26;
const PROCESS_POINTS: usize = 5;
/// Share of their length that they have where the cell does not draw back.
const PROCESS_AHEAD: f32 = 0.15;
/// Half the width of a mitochondrion, micrometres, its points, and turns that it makes in a second.
const MITOCHONDRION: f32 = 0.13;
const MITOCHONDRION_POINTS: usize = 4;
const WRITHING: f32 = 0.15;
/// Half the width of the thread that holds two lobes of a nucleus together, micrometres, and its points.
const FILAMENT: f32 = 0.20;
const FILAMENT_POINTS: usize = 5;
/// Points of a retraction fibre.
const FIBRE_POINTS: usize = 5;

impl AmoeboidBody {
    /// Retraction fibres, which the tail leaves on the glass, and all other threads.
    pub(in super::super) fn threads(&self, organism: OrganismView<'_>) -> Vec<Thread> {
        let Front { direction, tail: strength, behind, .. } = self.front;
        let mut rng = HashRng::new(self.seed ^ 0xf1b);
        let tail = self.field.pushed_inside(self.centre - direction * behind, 0.1);
        let fibre = |_| {
            let direction = rotate(-direction, unit_vector(rng.range([-0.45, 0.45])));
            let length = 2.2 * libm::expf(0.5 * rng.normal()) * strength;
            let matter = Matter { cytoplasm: 0.10, ..Matter::phase(0.20) } * strength;
            let step = direction * (length / (FIBRE_POINTS - 1) as f32);
            let points: [Vec2; FIBRE_POINTS] = walk(tail, step, unit_vector(0.16 * rng.normal()));
            Thread::curve(&points, |_| 0.09, matter).collect::<Vec<_>>()
        };
        let mut threads: Vec<Thread> = (0..self.look.fibres).flat_map(fibre).collect();
        threads.extend(self.filaments());
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
            let length = self.look.longest_mitochondrion * libm::expf(0.6 * rng.normal() - 0.8);
            let turned = wobble(self.time * WRITHING, rng.bits()) + TAU * rng.unit();
            let (bend, threshold, dense) = (unit_vector(0.5 * rng.normal()), rng.unit(), rng.range([0.5, 1.2]));
            let room = smoothstep(0.2, 0.7, self.field.at(at) - 0.5 * length - 0.5 * self.look.ectoplasm);
            let share = room * (1.0 - self.lamella(at)) * (1.0 - 0.9 * self.nucleus(at, 0.1));
            let share = share * smoothstep(threshold - 0.1, threshold + 0.1, 0.25 + 0.8 * self.crowd(at));
            if share < 0.02 {
                continue;
            }
            let step = unit_vector(turned) * (length / (MITOCHONDRION_POINTS - 1) as f32);
            let first = at - step * (0.5 * (MITOCHONDRION_POINTS - 1) as f32);
            let points: [Vec2; MITOCHONDRION_POINTS] = walk(first, step, bend);
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
        let length = self.look.longest_process * rng.unit() * grown * self.drawn_back(direction);
        let Some(edge) = self.field.crossing(self.centre, direction, 0.05 * self.radius) else { return };
        let at = self.centre + direction * (edge - 0.5);
        let step = rotate(direction, unit_vector(0.4 * rng.normal())) * ((length + 0.5) / (PROCESS_POINTS - 1) as f32);
        let bend = unit_vector(0.45 * rng.normal());
        let points: [Vec2; PROCESS_POINTS] = walk(at, step, bend);
        let matter = Matter { cytoplasm: 0.12, ..Matter::phase(0.20) } * smoothstep(0.1, 0.6, length);
        let radius = |k: usize| PROCESS / (1 + k) as f32;
        threads.extend(Thread::curve(&points, radius, matter));
    }

    /// How far processes reach in a direction, as a share: where the cell draws back they are left behind.
    fn drawn_back(&self, direction: Vec2) -> f32 {
        let back = smoothstep(-0.1, 0.7, -direction.dot(self.front.direction)) * self.front.strength;
        mix(PROCESS_AHEAD, 1.0, back)
    }

    /// Threads of chromatin between neighbouring lobes of a nucleus that does not part.
    pub(super) fn filaments(&self) -> Vec<Thread> {
        let mut rng = HashRng::new(self.nucleus_seed() ^ 0xf17a);
        let between = |pair: &[(Vec2, f32)]| {
            let step = (pair[1].0 - pair[0].0) / (FILAMENT_POINTS - 1) as f32;
            let (half, bend) = (0.5 * (FILAMENT_POINTS - 2) as f32, 0.25 * rng.normal());
            // It ends where it would have without the bend.
            let step = rotate(step, unit_vector(-bend * half));
            let points: [Vec2; FILAMENT_POINTS] = walk(pair[0].0, step, unit_vector(bend));
            Thread::curve(&points, |_| FILAMENT, self.look.nucleus.matter * 0.7).collect::<Vec<_>>()
        };
        let lobes = if self.look.nucleus.lobes[0] == 1 { &[] } else { &self.lobes[..] };
        lobes.windows(2).flat_map(between).collect()
    }
}

/// Places on a way whose every step is turned against the one before.
fn walk<const N: usize>(from: Vec2, step: Vec2, turn: Vec2) -> [Vec2; N] {
    let (mut at, mut step) = (from, step);
    std::array::from_fn(|_| {
        let place = at;
        at += step;
        step = rotate(step, turn);
        place
    })
}
