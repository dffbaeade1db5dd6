//! Sensing: what organisms perceive of their own body and of each other.

use super::position_of;
use crate::capability::Locomotion;
use crate::capability::controller::senses::{Environment, Other, Senses};
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use glam::Vec2;

/// Distance at which a goal is reached, units, ...
const ARRIVED: f32 = 0.25;
/// ... or, for organisms that pull or crawl, in their radii: more than the distance at which [`super::crawl`] stops.
const ARRIVED_BODY: f32 = 0.4;

/// What an organism perceives of its own body.
#[derive(Debug)]
pub(crate) struct OwnBody {
    at: Vec2,
    velocity: Vec2,
    radius: f32,
    outline: Vec<Vec2>,
}

impl OwnBody {
    pub(crate) fn of(organism: &Organism, particles: &Particles) -> Self {
        let at = position_of(organism, particles);
        let outline = organism.outline_positions(particles);
        let count = outline.len() as f32;
        if outline.is_empty() {
            let radius = organism.first_node().map_or(0.0, |i| particles.radius[i as usize]);
            let count = organism.particles().count().max(1) as f32;
            let velocity = organism.particles().map(|i| particles.velocity(i as usize)).sum::<Vec2>() / count;
            return Self { at, velocity, radius, outline };
        }
        let velocity = organism.outline_particles().map(|i| particles.velocity(i as usize)).sum::<Vec2>() / count;
        let radius = outline.iter().map(|node| (*node - at).length()).sum::<f32>() / count;
        Self { at, velocity, radius, outline }
    }

    pub(crate) fn senses<'a>(&'a self, me: OrganismId, organism: &Organism, around: &'a Environment<'a>) -> Senses<'a> {
        let arrival = match organism.locomotion {
            Locomotion::Crawl { .. } | Locomotion::Protrude(_) | Locomotion::FrontPull { .. } => {
                ARRIVED_BODY * self.radius
            }
            Locomotion::None | Locomotion::Tow { .. } | Locomotion::Propel { .. } => ARRIVED,
        };
        let Self { at, velocity, radius, ref outline } = *self;
        Senses { me, at, velocity, speed: organism.own_speed(), radius, arrival, outline, around }
    }
}

/// All organisms that others pursue or flee from.
pub(crate) fn others(organisms: &Organisms, particles: &Particles) -> Vec<Other> {
    let matters = |organism: &Organism| {
        (organism.engulfer.is_some() || organism.prey.is_some()) && !organism.is_quarantined && !organism.is_held()
    };
    let all = organisms.iter().filter(|(_, organism)| matters(organism));
    let seen = all.map(|(id, organism)| {
        let at = position_of(organism, particles);
        let first = organism.first_node().map_or(0, |i| i as usize);
        let far = |far: f32, i: u32| {
            let distance = (particles.position(i as usize) - at).length();
            if distance > far { distance } else { far }
        };
        let radius = organism.outline_particles().fold(particles.radius[first], far);
        let (is_engulfer, is_prey) = (organism.engulfer.is_some(), organism.prey.is_some());
        Other { id, at, velocity: particles.velocity(first), radius, is_engulfer, is_prey }
    });
    seen.collect()
}
