//! Digest: 64 bits that stand for the whole state.
//!
//! FNV-1a over fixed-width little-endian words. Order: step index; settings, templates, fluids, obstacles; every particle entry by index (owner, then for live
//! ones origin, x, y, vx, vy, inverse mass, radius, role, fluid, groups, material); every organism by index (kind, outline, locomotion,
//! controller, exchange, progress, random generator); blocks (owners and scales); touching pairs, exemptions, free lists;
//! chemicals. Zeros are made
//! positive and every NaN the same, so that equal states have equal digests.

use super::World;
use crate::capability::Locomotion;
use crate::capability::division::{Divider, Furrow, Order};
use crate::capability::phagocytosis::{Engulfer, MealPhase};
use crate::collision::obstacle::Obstacle;
use crate::config::WorldConfig;
use crate::organism::Organism;
use glam::Vec2;

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
struct Digest(u64);

impl Digest {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;

    fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(Self::PRIME);
        }
    }

    fn long(&mut self, long: u64) {
        self.word(long as u32);
        self.word((long >> 32) as u32);
    }

    fn float(&mut self, value: f32) {
        let canonical = if value == 0.0 { 0.0 } else { value };
        self.word(if value.is_nan() { f32::NAN.to_bits() & 0x7fff_ffff } else { canonical.to_bits() });
    }

    fn vector(&mut self, v: Vec2) {
        self.float(v.x);
        self.float(v.y);
    }

    fn text(&mut self, text: &str) {
        self.words(text.bytes().map(u32::from));
    }

    fn words(&mut self, words: impl IntoIterator<Item = u32>) {
        let mut count = 0;
        for word in words {
            self.word(word);
            count += 1;
        }
        self.word(count);
    }
}

impl World {
    /// 64 bits that stand for the whole state: equal worlds have equal digests on every platform, and worlds that differ
    /// anywhere in what the next step depends on differ in it (up to chance, 2^-64).
    #[must_use]
    pub fn digest(&self) -> u64 {
        let mut digest = Digest(Digest::OFFSET);
        digest.long(self.step_index);
        digest.long(self.guard.wrong_side);
        digest.long(self.guard.net_fired);
        self.digest_settings(&mut digest);
        self.digest_particles(&mut digest);
        for (id, organism) in self.organisms.iter() {
            digest.words([id.index, id.generation]);
            digest_organism(organism, &mut digest);
        }
        digest.words(self.organisms.bookkeeping());
        for block in &self.blocks {
            digest.words(block.owner);
            block.scale.iter().for_each(|&scale| digest.float(scale));
        }
        digest.words(self.touching.pairs().iter().flat_map(|(a, b)| [a.index, a.generation, b.index, b.generation]));
        digest.words(self.exemptions.pairs().iter().flat_map(|&(a, b)| [a, b]));
        digest.words(self.exemptions.gates().iter().flat_map(|&(a, b)| [a, b]));
        for chemical in &self.chemicals {
            digest.text(&format!("{:?}", chemical.spec()));
            chemical.values().iter().for_each(|&value| digest.float(value));
        }
        for fluid in &self.fluids {
            digest.words(fluid.particles.iter().copied());
        }
        digest.0
    }

    /// What was fixed when the world, its templates and its fluids were made.
    fn digest_settings(&self, digest: &mut Digest) {
        let WorldConfig { size, dt, substeps, gravity, damping, max_speed, seed, protects_membranes, max_particles } =
            &self.config;
        digest.vector(*size);
        digest.vector(*gravity);
        [*dt, *damping, *max_speed].into_iter().for_each(|value| digest.float(value));
        digest.words([*substeps, *max_particles, u32::from(*protects_membranes)]);
        digest.long(*seed);
        self.template_digests.iter().for_each(|&template| digest.long(template));
        self.fluids.iter().for_each(|fluid| digest.text(&format!("{:?}", fluid.params)));
        self.obstacle_digests.iter().for_each(|&obstacle| digest.long(obstacle));
    }

    fn digest_particles(&self, digest: &mut Digest) {
        let p = &self.particles;
        for i in 0..p.len() {
            digest.word(p.owner[i]);
            if p.is_live(i) {
                for value in
                    [p.origin_x[i], p.origin_y[i], p.x[i], p.y[i], p.vx[i], p.vy[i], p.inv_mass[i], p.radius[i]]
                {
                    digest.float(value);
                }
                digest.word(u32::from(p.role[i]));
                digest.word(p.fluid[i]);
                digest.word(p.groups[i].memberships);
                digest.word(p.groups[i].filter);
                digest.float(p.material[i].friction);
                digest.float(p.material[i].restitution);
            }
        }
        digest.words(p.free_indices().iter().copied());
    }
}

/// Digest of something that never changes, by its text, which gives every number exactly.
pub(super) fn of_text(value: &impl std::fmt::Debug) -> u64 {
    let mut digest = Digest(Digest::OFFSET);
    digest.text(&format!("{value:?}"));
    digest.0
}

/// Digest of an obstacle by what the step sees of it: its surface from a grid of points around it.
pub(super) fn of_obstacle(obstacle: &Obstacle) -> u64 {
    const POINTS: u8 = 8;
    let mut digest = Digest(Digest::OFFSET);
    let bounds = obstacle.bounds();
    let extent = bounds.maxs - bounds.mins;
    for k in 0..POINTS * POINTS {
        let share = Vec2::new(f32::from(k % POINTS), f32::from(k / POINTS)) / f32::from(POINTS - 1);
        let (surface, is_inside) = obstacle.nearest(bounds.mins + extent * share);
        digest.vector(surface);
        digest.word(u32::from(is_inside));
    }
    digest.float(obstacle.material.friction);
    digest.float(obstacle.material.restitution);
    digest.words([obstacle.groups.memberships, obstacle.groups.filter]);
    digest.0
}

fn digest_organism(organism: &Organism, digest: &mut Digest) {
    digest.word(organism.kind as u32);
    digest.words(organism.particles());
    digest.words(organism.outline.iter().copied());
    if let Some(membrane) = organism.body.membrane() {
        membrane.state().into_iter().for_each(|value| digest.float(value));
    }
    for phagosome in &organism.phagosomes {
        digest.words(phagosome.ring.iter().copied());
        phagosome.membrane.state().into_iter().for_each(|value| digest.float(value));
    }
    match organism.locomotion {
        Locomotion::None => digest.word(0),
        Locomotion::FrontPull { front } => digest.words([1, front]),
        Locomotion::Crawl { front_centre } => digest.words([2, front_centre.map_or(u32::MAX, |k| k)]),
        Locomotion::Tow { max_acceleration } => digest.float(max_acceleration),
    }
    [organism.speed, organism.spawn_area, organism.spawn_scale].into_iter().for_each(|value| digest.float(value));
    organism.engulfer.iter().for_each(|engulfer| digest_engulfer(engulfer, digest));
    organism.divider.iter().for_each(|divider| digest_divider(divider, digest));
    organism.prey.and_then(|prey| prey.held_by).into_iter().for_each(|id| digest.words([id.index, id.generation]));
    digest.text(&format!("{:?} {:?} {:?}", organism.controller, organism.exchanges, organism.progress));
    digest.long(organism.rng.state);
    digest.long(organism.rng.increment);
    digest.word(u32::from(organism.is_quarantined));
}

fn digest_engulfer(engulfer: &Engulfer, digest: &mut Digest) {
    digest.text(&format!("{:?}", engulfer.params));
    digest.word(u32::from(engulfer.digests));
    digest.float(engulfer.held_area);
    digest.float(engulfer.fold_length);
    digest.float(engulfer.pending_growth);
    for meal in &engulfer.meals {
        digest.words([meal.prey.index, meal.prey.generation, meal.way as u32]);
        match meal.phase {
            MealPhase::Touching(time) => digest.float(time),
            MealPhase::Ingesting(time) => digest.float(1000.0 + time),
            MealPhase::Ingested => digest.float(-1.0),
            MealPhase::Digesting(progress) => digest.float(-2.0 - progress),
        }
        digest.words(meal.gate.iter().copied().chain(meal.is_expelled.then_some(u32::MAX)));
    }
}

/// Nothing for a cell that has never been told to divide or fuse.
fn digest_divider(divider: &Divider, digest: &mut Digest) {
    if *divider == Divider::new(divider.params) {
        return;
    }
    match divider.order {
        None => digest.word(0),
        Some(Order::Divide { axis }) => digest.vector(axis.unwrap_or(Vec2::NAN)),
        Some(Order::Fuse { with }) => digest.words([with.index, with.generation]),
    }
    if let Some(Furrow { nodes, width, elapsed }) = divider.furrow {
        digest.words(nodes);
        digest.float(width);
        digest.float(elapsed);
    }
    digest.float(divider.lobes);
    digest.float(divider.nodes_per_root.unwrap_or(f32::NAN));
    digest.words(divider.wanted_nodes);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_and_nans_are_canonical_and_order_matters() {
        let of = |values: &[f32]| {
            let mut digest = Digest(Digest::OFFSET);
            values.iter().for_each(|&value| digest.float(value));
            digest.0
        };
        assert_eq!(of(&[0.0]), of(&[-0.0]));
        assert_eq!(of(&[f32::NAN]), of(&[-f32::NAN]));
        assert_ne!(of(&[1.0, 2.0]), of(&[2.0, 1.0]));
    }

    #[test]
    fn words_are_hashed_as_fnv1a_does() {
        // FNV-1a of the four bytes "abcd".
        let mut digest = Digest(Digest::OFFSET);
        digest.word(u32::from_le_bytes(*b"abcd"));
        assert_eq!(digest.0, 0xfc17_9f83_ee07_24dd);
    }
}
