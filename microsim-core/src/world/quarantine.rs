//! Quarantine: an organism whose state is no longer finite is frozen and reported; the rest of the world goes on.

use super::World;
use crate::event::Event;
use crate::id::OrganismId;
use glam::Vec2;

impl World {
    /// Freezes every organism with a particle that is not finite or has left the room by more than the room's size.
    pub(crate) fn quarantine(&mut self) {
        for id in self.freeze_insane() {
            self.release_meals(id);
        }
    }

    /// Freezes them and returns which.
    fn freeze_insane(&mut self) -> Vec<OrganismId> {
        let Self { particles, organisms, events, config, fluids, .. } = self;
        let is_sane = |i: u32| {
            let Vec2 { x, y } = particles.position(i as usize);
            let velocity = particles.vx[i as usize] + particles.vy[i as usize];
            let in_x = x > -config.size.x && x < 2.0 * config.size.x;
            in_x && y > -config.size.y && y < 2.0 * config.size.y && velocity.is_finite()
        };
        let (mut lost, mut frozen) = (Vec::new(), Vec::new());
        for (id, organism) in organisms.iter_mut().filter(|(_, organism)| !organism.is_quarantined) {
            if !organism.particles().all(is_sane) {
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
