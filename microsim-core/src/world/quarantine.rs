//! Quarantine: an organism whose state is no longer finite is frozen and reported; the rest of the world goes on.

use super::World;
use crate::event::Event;
use crate::id::OrganismId;
use glam::Vec2;

impl World {
    /// Freezes every organism with a particle that is not finite or has left the room by more than the room's size.
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
    }

    /// Freezes them and returns which.
    fn freeze_insane(&mut self) -> Vec<OrganismId> {
        let Self { particles, organisms, events, config, fluids, .. } = self;
        let is_sane = |i: usize| {
            let Vec2 { x, y } = particles.position(i);
            let velocity = particles.vx[i] + particles.vy[i];
            let in_x = x > -config.size.x && x < 2.0 * config.size.x;
            in_x && y > -config.size.y && y < 2.0 * config.size.y && velocity.is_finite()
        };
        let (mut lost, mut frozen) = (Vec::new(), Vec::new());
        for (id, organism) in organisms.iter_mut().filter(|(_, organism)| !organism.is_quarantined) {
            if !organism.particles().all(|i| is_sane(i as usize)) {
                organism.is_quarantined = true;
                organism.fluid = None;
                frozen.push(id);
                events.push(Event::Quarantined { organism: id });
                lost.extend(organism.particles().map(|i| (i, organism.home)));
            }
        }
        for (i, home) in lost {
            let last = particles.last_position(i as usize);
            particles.freeze(i as usize, if last.is_finite() { last.clamp(Vec2::ZERO, config.size) } else { home });
            fluids.iter_mut().for_each(|fluid| fluid.particles.retain(|&j| j != i));
        }
        frozen
    }
}

#[cfg(test)]
mod tests {
    use crate::{AgarSpec, Event, Inputs, Placement, PlateletSpec, World, WorldConfig};

    #[test]
    fn a_broken_organism_is_frozen_and_the_others_go_on() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let broken = world.spawn(&PlateletSpec::default().into(), Placement::at(20.0, 20.0)).unwrap();
        let sound = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 20.0)).unwrap();
        let first = world.organisms.get(broken).unwrap().particles().next().unwrap() as usize;
        world.particles.x[first] = f32::NAN;
        world.step(&Inputs::new());
        assert_eq!(world.events(), [Event::Quarantined { organism: broken }]);
        assert_eq!(world.census().quarantined, 1);
        for _ in 0..10 {
            world.step(&Inputs::new());
            assert!(world.events().is_empty(), "reported once");
        }
        let view = world.view();
        assert!(view.organism(broken).unwrap().particles().all(|p| p.position.is_finite()));
        assert!(view.organism(sound).unwrap().particles().all(|p| p.position.is_finite()));
    }
}
