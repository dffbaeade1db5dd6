//! Quarantine: an organism whose state is no longer finite is frozen and reported; the rest of the world goes on.

use super::World;
use crate::event::Event;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::parallel::{self, CHUNK};
use crate::particle::Particles;
use glam::Vec2;
use std::ops::Range;

impl World {
    /// Freezes every organism with a particle of which a number is not finite or that has left the room by more than the
    /// room's size.
    pub(crate) fn quarantine(&mut self) {
        // Hardly ever is there anything to find.
        if !self.all_is_sane() {
            for id in self.freeze_insane() {
                self.release_meals(id);
                self.wake_up_touching(id);
            }
        }
    }

    /// The same as asking each organism, column by column and without asking whose the particles are.
    fn all_is_sane(&self) -> bool {
        let (p, size) = (&self.particles, self.config.size);
        let chunks = (0..p.len()).step_by(CHUNK).map(|first| first..p.len().min(first + CHUNK));
        let is_sane = |at: Range<usize>| {
            are_near(&p.origin_x[at.clone()], &p.x[at.clone()], size.x)
                && are_near(&p.origin_y[at.clone()], &p.y[at.clone()], size.y)
                && [&p.vx, &p.vy, &p.prev_x, &p.prev_y].iter().all(|column| are_within(&column[at.clone()], -f32::MAX))
                && [&p.inv_mass, &p.radius].iter().all(|column| are_within(&column[at.clone()], 0.0))
        };
        parallel::map(chunks.collect(), is_sane).into_iter().all(|is_sane| is_sane)
    }

    /// Freezes them and returns which.
    fn freeze_insane(&mut self) -> Vec<OrganismId> {
        let Self { particles, organisms, events, config, fluids, .. } = self;
        let is_sane = |i: u32| is_sane(particles, i as usize, config.size);
        let (mut lost, mut frozen) = (Vec::new(), Vec::new());
        let is_lost = |organism: &Organism| !organism.is_quarantined && !organism.particles().all(is_sane);
        for (id, organism) in organisms.iter_mut(is_lost) {
            organism.is_quarantined = true;
            organism.fluid = None;
            organism.goal = None;
            frozen.push(id);
            events.push(Event::Quarantined { organism: id });
            lost.extend(organism.particles().map(|i| (i, organism.home)));
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

/// Whether all places, each an origin and an offset, are less than a room's size away from the room.
fn are_near(origins: &[f32], offsets: &[f32], size: f32) -> bool {
    let places = origins.iter().zip(offsets).map(|(origin, offset)| origin + offset);
    places.fold(true, |all, at| all & (at > -size) & (at < 2.0 * size))
}

/// Whether all numbers of a column are finite and not below a least one.
fn are_within(column: &[f32], least: f32) -> bool {
    column.iter().fold(true, |all, &value| all & (value >= least) & (value <= f32::MAX))
}

/// Whether a particle of a room of this size has numbers that a step can go on with.
fn is_sane(p: &Particles, i: usize, size: Vec2) -> bool {
    let at = p.position(i);
    let is_near = at.cmpgt(-size).all() && at.cmplt(2.0 * size).all();
    let is_number = |value: f32| value.is_finite() && value >= 0.0;
    is_near
        && p.velocity(i).is_finite()
        && p.last_position(i).is_finite()
        && is_number(p.inv_mass[i])
        && is_number(p.radius[i])
}

#[cfg(test)]
mod tests;
