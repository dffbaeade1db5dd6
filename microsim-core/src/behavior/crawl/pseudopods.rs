//! Crawling by pseudopods: where the [network](crate::capability::crawl) is active the membrane is pushed outwards and cytoplasm
//! follows, the rest of the front holds, and the rear contracts towards the centroid.
//!
//! While the cell turns round it crawls with front and rear, which answers at once; so it does while it touches prey or takes it
//! in, since a membrane that is soft loses hold of prey.

use super::front_and_rear::{self, beyond};
use crate::behavior::heading;
use crate::capability::Locomotion;
use crate::capability::crawl::{Posture, Pseudopods};
use crate::geometry::polygon::{centroid, signed_area};
use crate::organism::Organism;
use crate::particle::Particles;
use crate::solver::drive::Drive;
use glam::Vec2;
use std::f32::consts::PI;

/// Shares of a tip's direction: of its node's normal and of its pseudopod's direction.
const NORMAL: f32 = 0.4;
const ALONG: f32 = 0.6;
/// Times in which a tip, the rear, cytoplasm behind a tip and the rest of the front reach their speed, s.
const TIP_TIME: f32 = 0.0125;
const REAR_TIME: f32 = 0.0125;
const CYTOPLASM_TIME: f32 = 0.02;
const HOLD_TIME: f32 = 0.025;
/// Cosine to the push above which nodes that do not protrude hold, and their speed in the cell's.
const HOLDING: f32 = 0.3;
const HOLD_SPEED: f32 = 0.2;
/// Cosine to the push below which nodes are of the rear.
const REAR: f32 = -0.45;
/// Distance from a tip within which cytoplasm follows it, in node radii.
const REACH: f32 = 5.0;

/// A node that protrudes, where it is, and the velocity that it is given.
struct Tip {
    at: Vec2,
    drive: Drive,
}

/// Crawls towards the goal, or rests if there is none.
pub(crate) fn protrude(organism: &mut Organism, particles: &Particles, dt: f32, drives: &mut Vec<Drive>) {
    let Locomotion::Protrude(mut pseudopods) = std::mem::replace(&mut organism.locomotion, Locomotion::None) else {
        return;
    };
    let goal = organism.goal;
    let front = goal.and_then(|goal| crawl(organism, &mut pseudopods, goal, particles, dt, drives));
    if front.is_none() {
        pseudopods.rest(dt);
    }
    pseudopods.front_centre = front;
    organism.locomotion = Locomotion::Protrude(pseudopods);
}

/// Drives the membrane towards the goal; returns the node that leads.
fn crawl(
    organism: &Organism,
    pseudopods: &mut Pseudopods,
    goal: Vec2,
    particles: &Particles,
    dt: f32,
    drives: &mut Vec<Drive>,
) -> Option<u32> {
    let nodes = organism.outline_positions(particles);
    let centre = centroid(&nodes)?;
    beyond(goal, centre, &nodes)?;
    let direction = heading(goal - centre) * 1.0_f32.copysign(organism.relative_speed);
    let outwards: Vec<Vec2> = nodes.iter().map(|&at| heading(at - centre)).collect();
    let tempo = organism.speed / (signed_area(&nodes) / PI).sqrt();
    pseudopods.advance(&Posture { outwards: &outwards, direction, tempo, dt });
    pseudopods.is_stiff = organism.meals().iter().any(|meal| !meal.phase.is_inside());
    if pseudopods.is_stiff || pseudopods.is_turning(direction) {
        return front_and_rear::drive(organism, goal, particles, drives);
    }
    let cell =
        Cell { organism, nodes: &nodes, outwards: &outwards, centre, direction, speed: organism.present_speed().abs() };
    let (tips, front) = cell.tips(pseudopods);
    cell.draw_cytoplasm(&tips, particles, drives);
    drives.extend(tips.iter().map(|tip| tip.drive));
    cell.contract(pseudopods, drives);
    front.or(pseudopods.front_centre)
}

/// A cell that protrudes in this step.
struct Cell<'a> {
    organism: &'a Organism,
    nodes: &'a [Vec2],
    outwards: &'a [Vec2],
    centre: Vec2,
    direction: Vec2,
    speed: f32,
}

impl Cell<'_> {
    /// The nodes that protrude, and the middle of the strongest pseudopod towards the goal.
    fn tips(&self, pseudopods: &Pseudopods) -> (Vec<Tip>, Option<u32>) {
        let (mut tips, mut strongest) = (Vec::new(), (0.0, None));
        let network = &pseudopods.network;
        for (first, length) in network.arcs() {
            let arc = (first..first + length).map(|k| k % self.nodes.len());
            let along = heading(arc.clone().map(|k| self.outwards[k] * network.force(k)).sum());
            let strength = arc.clone().map(|k| network.force(k)).sum::<f32>() * (1.0 + along.dot(self.direction));
            if strength > strongest.0 {
                strongest = (strength, Some(((first + length / 2) % self.nodes.len()) as u32));
            }
            tips.extend(arc.map(|k| self.tip(k, along, network.force(k), pseudopods.params.tip_speed)));
        }
        (tips, strongest.1)
    }

    fn tip(&self, k: usize, along: Vec2, force: f32, tip_speed: f32) -> Tip {
        let direction = heading(NORMAL * self.normal(k) + ALONG * along);
        let velocity = direction * (tip_speed * self.speed);
        let max_acceleration = force * self.speed / TIP_TIME;
        Tip { at: self.nodes[k], drive: Drive::new(self.organism.outline[k], velocity, max_acceleration) }
    }

    /// Unit vector outwards across the links of a node.
    fn normal(&self, k: usize) -> Vec2 {
        let count = self.nodes.len();
        -heading((self.nodes[(k + 1) % count] - self.nodes[(k + count - 1) % count]).perp())
    }

    /// Lets cytoplasm near a tip follow the nearest one.
    fn draw_cytoplasm(&self, tips: &[Tip], particles: &Particles, drives: &mut Vec<Drive>) {
        let reach = REACH * self.organism.body.membrane().map_or(0.0, |membrane| membrane.node_radius);
        let max_acceleration = self.speed / CYTOPLASM_TIME;
        for &particle in &self.organism.fluid_particles {
            let at = particles.position(particle as usize);
            let nearest = |best: (f32, Vec2), tip: &Tip| {
                let distance = (tip.at - at).length_squared();
                if distance < best.0 { (distance, tip.drive.velocity) } else { best }
            };
            let (distance, velocity) = tips.iter().fold((f32::INFINITY, Vec2::ZERO), nearest);
            if distance < reach * reach {
                drives.push(Drive::new(particle, velocity, max_acceleration));
            }
        }
    }

    /// Draws the rear together and holds what else is in front.
    fn contract(&self, pseudopods: &Pseudopods, drives: &mut Vec<Drive>) {
        let push = heading(pseudopods.push);
        for (k, &particle) in
            self.organism.outline.iter().enumerate().filter(|(k, _)| !pseudopods.network.protrudes(*k))
        {
            let cosine = self.outwards[k].dot(push);
            if cosine < REAR {
                let velocity = heading(self.centre - self.nodes[k]) * self.speed;
                drives.push(Drive::new(particle, velocity, self.speed / REAR_TIME));
            } else if cosine > HOLDING {
                let velocity = push * (HOLD_SPEED * self.speed);
                drives.push(Drive::new(particle, velocity, self.speed / HOLD_TIME));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capability::crawl::presets::Crawl;
    use crate::{AmoeboidCellSpec, Controller, Inputs, Intent, OrganismId, Placement, World, WorldConfig};

    fn a_cell(crawl: Crawl, seed: u64, controller: Controller) -> (World, OrganismId) {
        let mut world = World::new(WorldConfig { size: Vec2::splat(1000.0), seed, ..WorldConfig::default() }).unwrap();
        let spec = AmoeboidCellSpec { crawl, ..AmoeboidCellSpec::default() };
        let cell = world.spawn(&spec.into(), Placement::at(500.0, 500.0).steered_by(controller)).unwrap();
        (world, cell)
    }

    #[test]
    fn the_crawl_has_random_numbers_of_its_own() {
        let run = |crawl: Crawl, seed: u64| {
            let (mut world, cell) = a_cell(crawl, seed, Controller::wander([1.0, 2.0], 0.0));
            (0..120).for_each(|_| world.step(&Inputs::new()));
            (world.organisms.get(cell).unwrap().rng.clone(), world.digest())
        };
        let (old, new, other) = (run(Crawl::FrontAndRear, 1), run(Crawl::Neutrophil, 1), run(Crawl::Neutrophil, 2));
        assert_eq!(old.0, new.0, "the controller draws as before");
        assert!(old.1 != new.1 && new.1 != other.1);
        assert_eq!(run(Crawl::Neutrophil, 1).1, new.1);
    }

    #[test]
    fn tips_are_pushed_outwards_the_rear_inwards_and_prey_makes_the_membrane_stiff() {
        let (mut world, cell) = a_cell(Crawl::Neutrophil, 1, Controller::Still);
        let mut inputs = Inputs::new();
        inputs.set(cell, Intent::toward(Vec2::new(1e4, 500.0)).unwrap());
        (0..60).for_each(|_| world.step(&inputs));
        let organism = world.organisms.get(cell).unwrap().clone();
        let Locomotion::Protrude(mut pseudopods) = organism.locomotion.clone() else { panic!("it has pseudopods") };
        assert!(pseudopods.protrudes());
        let nodes = organism.outline_positions(&world.particles);
        let (goal, centre) = (Vec2::new(1e4, 500.0), centroid(&nodes).unwrap());
        let mut drives = Vec::new();
        crawl(&organism, &mut pseudopods, goal, &world.particles, 1.0 / 60.0, &mut drives).unwrap();
        for (k, node) in organism.outline.iter().enumerate() {
            let Some(drive) = drives.iter().find(|drive| drive.particle == *node) else { continue };
            let (out, speed) = (heading(nodes[k] - centre), drive.velocity.length());
            if pseudopods.network.protrudes(k) {
                assert!(drive.velocity.dot(out) > 0.0 && speed > 8.0, "tip {k}: {}", drive.velocity);
            } else if out.x < -0.9 {
                assert!(drive.velocity.dot(out) < 0.0, "rear {k}: {}", drive.velocity);
            }
        }
        let prey = world.spawn(&crate::AgarSpec::default().into(), Placement::at(centre.x + 14.0, centre.y)).unwrap();
        let touches = |world: &World| world.organisms.get(cell).unwrap().meals().iter().any(|meal| meal.prey == prey);
        assert!((0..300).any(|_| (world.step(&inputs), touches(&world)).1), "it meets the prey");
        world.step(&inputs);
        assert!(world.organisms.get(cell).unwrap().locomotion.pseudopods().unwrap().is_stiff);
    }
}
