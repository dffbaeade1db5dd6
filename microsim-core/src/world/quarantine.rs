//! Quarantine: an organism whose state is no longer finite, or whose membrane is flat or inside out, is frozen and reported; the
//! rest of the world goes on.

use super::World;
use crate::event::Event;
use crate::geometry::polygon::signed_area;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::parallel::{self, CHUNK};
use crate::particle::Particles;
use glam::Vec2;
use std::ops::Range;

impl World {
    /// Freezes every organism with a particle that has a number that is not finite, or is outside of where particles may be
    /// ([`crate::config::WorldConfig::particle_bounds`]), or with a membrane that encloses no area.
    pub(crate) fn quarantine(&mut self) {
        // The fast check of whole columns nearly always succeeds.
        if !self.all_are_valid() || self.is_anybody_flat() {
            for id in self.freeze_invalid() {
                self.release_meals(id);
                self.wake_up_touching(id);
            }
        }
    }

    /// Whether all particles are valid: the same check as for each organism, but column by column.
    fn all_are_valid(&self) -> bool {
        let (p, [low, high]) = (&self.particles, self.config.particle_bounds());
        let chunks = (0..p.len()).step_by(CHUNK).map(|first| first..p.len().min(first + CHUNK));
        let are_valid = |at: Range<usize>| {
            self.dispatch.run(
                #[inline(always)]
                || {
                    are_near(&p.origin_x[at.clone()], &p.x[at.clone()], [low.x, high.x])
                        && are_near(&p.origin_y[at.clone()], &p.y[at.clone()], [low.y, high.y])
                        && [&p.vx, &p.vy, &p.prev_x, &p.prev_y]
                            .iter()
                            .all(|column| are_finite(&column[at.clone()], ANY_SIGN))
                        && [&p.inv_mass, &p.radius].iter().all(|column| are_finite(&column[at.clone()], POSITIVE))
                },
            )
        };
        parallel::map(chunks.collect(), are_valid).into_iter().all(|are_valid| are_valid)
    }

    /// Whether a load has pressed a membrane flat or turned it inside out; nothing restores those.
    fn is_anybody_flat(&self) -> bool {
        let (p, mut outline) = (&self.particles, Vec::new());
        let mut all = self.organisms.with_membrane();
        self.config.protects_membranes && all.any(|(_, organism)| is_flat(organism, p, &mut outline))
    }

    /// Freezes all organisms with an invalid particle or a flat membrane and returns them.
    fn freeze_invalid(&mut self) -> Vec<OrganismId> {
        let Self { particles, organisms, events, config, fluids, .. } = self;
        let [low, high] = config.particle_bounds();
        let is_valid = |i: u32| is_valid(particles, i as usize, [low, high]);
        let is_flat = |organism: &Organism| config.protects_membranes && is_flat(organism, particles, &mut Vec::new());
        let (mut lost, mut frozen) = (Vec::new(), Vec::new());
        let is_lost = |organism: &Organism| {
            !organism.is_quarantined && (!organism.particles().all(is_valid) || is_flat(organism))
        };
        for (id, organism) in organisms.iter_mut(is_lost) {
            organism.is_quarantined = true;
            organism.fluid = None;
            organism.goal = None;
            frozen.push(id);
            events.push(Event::Quarantined { organism: id });
            // A body may have its centre far from the room.
            let home = organism.home.clamp(low, high);
            lost.extend(organism.particles().map(|i| (i, home)));
        }
        for (i, home) in lost {
            let last = particles.last_position(i as usize);
            let at = if last.is_finite() { last.clamp(Vec2::ZERO, config.size) } else { home };
            particles.freeze(i as usize, home.round(), at);
            fluids.iter_mut().for_each(|fluid| fluid.particles.retain(|&j| j != i));
        }
        frozen
    }
}

/// Whether one of its membranes encloses no area. `outline` is room for its nodes.
fn is_flat(organism: &Organism, p: &Particles, outline: &mut Vec<Vec2>) -> bool {
    let mut rings = organism.membranes().map(|(_, ring)| ring);
    !organism.is_quarantined
        && rings.any(|ring| {
            outline.clear();
            outline.extend(ring.iter().map(|&node| p.position(node as usize)));
            signed_area(outline) <= 0.0
        })
}

/// Whether all positions, each an origin and an offset, are between two coordinates.
#[inline(always)]
fn are_near(origins: &[f32], offsets: &[f32], [low, high]: [f32; 2]) -> bool {
    let places = origins.iter().zip(offsets).map(|(origin, offset)| origin + offset);
    places.fold(true, |all, at| all & (at > low) & (at < high))
}

/// The bits of a number that are looked at: all, or all but the sign.
const POSITIVE: u32 = u32::MAX;
const ANY_SIGN: u32 = !(1 << 31);

/// Whether all numbers of a column are finite, by these of their bits: as whole numbers, those of what is not are the largest,
/// and those of what is negative are larger.
#[inline(always)]
fn are_finite(column: &[f32], bits: u32) -> bool {
    column.iter().fold(0, |most, value| most.max(value.to_bits() & bits)) <= f32::MAX.to_bits()
}

/// Whether a particle is finite and between two corners.
fn is_valid(p: &Particles, i: usize, [low, high]: [Vec2; 2]) -> bool {
    let at = p.position(i);
    let is_near = at.cmpgt(low).all() && at.cmplt(high).all();
    let is_number = |value: f32| value.is_finite() && value >= 0.0;
    is_near
        && p.velocity(i).is_finite()
        && p.last_position(i).is_finite()
        && is_number(p.inv_mass[i])
        && is_number(p.radius[i])
}

#[cfg(test)]
mod tests;
