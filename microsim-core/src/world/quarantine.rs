//! Quarantine: an organism whose state is no longer finite is frozen and reported; the rest of the world goes on.

use super::World;
use crate::event::Event;
use crate::id::OrganismId;
use crate::particle::Particles;
use glam::Vec2;

impl World {
    /// Freezes every organism with a particle of which a number is not finite or that has left the room by more than the
    /// room's size.
    pub(crate) fn quarantine(&mut self) {
        // Hardly ever is there anything to find.
        if !self.all_is_sane() {
            for id in self.freeze_insane() {
                self.release_meals(id);
            }
        }
    }

    /// The same as asking each organism, column by column and without asking whose the particles are.
    fn all_is_sane(&self) -> bool {
        let p = &self.particles;
        let is_near = |origins: &[f32], offsets: &[f32], size: f32| {
            let places = origins.iter().zip(offsets).map(|(origin, offset)| origin + offset);
            places.fold(true, |all, at| all & (at > -size) & (at < 2.0 * size))
        };
        is_near(&p.origin_x, &p.x, self.config.size.x)
            && is_near(&p.origin_y, &p.y, self.config.size.y)
            && p.vx.iter().zip(&p.vy).fold(true, |all, (x, y)| all & (x + y).is_finite())
            && p.inv_mass.iter().zip(&p.radius).fold(true, |all, (&w, &radius)| all & is_number(w) & is_number(radius))
    }

    /// Freezes them and returns which.
    fn freeze_insane(&mut self) -> Vec<OrganismId> {
        let Self { particles, organisms, events, config, fluids, .. } = self;
        let is_sane = |i: usize| is_sane(particles, i, config.size);
        let (mut lost, mut frozen) = (Vec::new(), Vec::new());
        for (id, organism) in organisms.iter_mut().filter(|(_, organism)| !organism.is_quarantined) {
            if !organism.particles().all(|i| is_sane(i as usize)) {
                organism.is_quarantined = true;
                organism.fluid = None;
                organism.goal = None;
                frozen.push(id);
                events.push(Event::Quarantined { organism: id });
                lost.extend(organism.particles().map(|i| (i, organism.home)));
            }
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

/// Whether a particle of a room of this size has numbers that a step can go on with.
fn is_sane(p: &Particles, i: usize, size: Vec2) -> bool {
    let at = p.position(i);
    let is_near = at.cmpgt(-size).all() && at.cmplt(2.0 * size).all();
    is_near && p.velocity(i).is_finite() && is_number(p.inv_mass[i]) && is_number(p.radius[i])
}

fn is_number(value: f32) -> bool {
    value.is_finite() && value >= 0.0
}

#[cfg(test)]
mod tests;
