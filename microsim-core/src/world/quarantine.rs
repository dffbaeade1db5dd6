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
        for id in self.freeze_insane() {
            self.release_meals(id);
        }
    }

    /// Freezes them and returns which.
    fn freeze_insane(&mut self) -> Vec<OrganismId> {
        let Self { particles, organisms, events, config, fluids, .. } = self;
        let is_sane = |i: u32| is_sane(particles, i as usize, config.size);
        let (mut lost, mut frozen) = (Vec::new(), Vec::new());
        for (id, organism) in organisms.iter_mut().filter(|(_, organism)| !organism.is_quarantined) {
            if !organism.particles().all(is_sane) {
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
    let is_number = |value: f32| value.is_finite() && value >= 0.0;
    is_near
        && p.velocity(i).is_finite()
        && p.last_position(i).is_finite()
        && is_number(p.inv_mass[i])
        && is_number(p.radius[i])
}

#[cfg(test)]
mod tests;
