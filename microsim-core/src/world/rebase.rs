//! Origin rebasing: keeps organisms near their origins, where `f32` is precise.

use super::World;
use glam::Vec2;

/// Distance of an organism's first particle from its origin beyond which the origin moves, units.
const FARTHEST: f32 = 16.0;

impl World {
    /// Moves the origins of organisms that are too far from theirs. Free fluid keeps its origin: it has no rigid parts.
    pub(crate) fn rebase(&mut self) {
        let Self { particles, organisms, .. } = self;
        for (_, organism) in organisms.iter() {
            let Some(first) = organism.first_node().map(|i| i as usize) else {
                continue;
            };
            let offset = Vec2::new(particles.x[first], particles.y[first]);
            if offset.abs().max_element() > FARTHEST && !organism.is_quarantined {
                let by = offset.round();
                organism.particles().for_each(|i| particles.shift_origin(i as usize, by));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Controller, Inputs, Placement, ProbeSpec, World, WorldConfig, glam::Vec2};

    #[test]
    fn an_organism_that_travels_takes_its_origin_along_without_a_jump() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let way = Controller::patrol(vec![Vec2::new(140.0, 45.0)], false);
        let spec = ProbeSpec { speed: 15.0, ..ProbeSpec::default() };
        let probe = world.spawn(&spec.into(), Placement::at(10.0, 45.0).steered_by(way)).unwrap();
        let mut last = world.centroid(probe).unwrap();
        for _ in 0..600 {
            world.step(&Inputs::new());
            let at = world.centroid(probe).unwrap();
            assert!((at - last).length() < 0.3, "jumped from {last} to {at}");
            last = at;
        }
        assert!(last.x > 135.0, "arrived at {last}");
        assert!(world.particles.x[world.organisms.get(probe).unwrap().first_node().unwrap() as usize].abs() <= 17.0);
    }
}
