//! Movement of a rigid cell (thesis, 3.1.1): the front body is given a velocity towards the goal and pulls the cell after
//! it, which also turns it. If the goal is nearer to the opposite body, that one becomes the front. A cell that backs up is
//! pulled by its rear, away from the goal.

use super::heading;
use crate::organism::Organism;
use crate::particle::Particles;
use crate::solver::drive::Drive;
use glam::Vec2;

/// Drives the front body and returns which body of the outline is the front now.
pub(crate) fn drive(
    organism: &Organism,
    front: u32,
    goal: Vec2,
    particles: &Particles,
    drives: &mut Vec<Drive>,
) -> u32 {
    let count = organism.outline.len() as u32;
    let particle = |k: u32| organism.body.particle(organism.outline[(k % count) as usize]);
    let offset = |k: u32| goal - particles.position(particle(k) as usize);
    let opposite = (front + count / 2) % count;
    if organism.relative_speed < 0.0 {
        let velocity = heading(offset(opposite)) * organism.present_speed();
        drives.push(Drive::pull(particle(opposite), velocity));
        return front;
    }
    let front = if offset(opposite).length_squared() < offset(front).length_squared() { opposite } else { front };
    let velocity = heading(offset(front)) * organism.present_speed();
    drives.push(Drive::pull(particle(front), velocity));
    front
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Inputs, Intent, Placement, RigidCellSpec, World, WorldConfig};

    fn drives_to(goal: Vec2) -> (World, Vec<Drive>, u32) {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&RigidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let mut drives = Vec::new();
        let organism = world.organisms.get(cell).unwrap();
        let front = drive(organism, 0, goal, &world.particles, &mut drives);
        (world.clone(), drives, front)
    }

    #[test]
    fn t13_only_the_front_body_gets_the_normalised_direction_times_the_speed() {
        let goal = Vec2::new(120.0, 70.0);
        let (world, drives, front) = drives_to(goal);
        assert_eq!((drives.len(), front), (1, 0));
        let at = world.particles.position(drives[0].particle as usize);
        assert!((drives[0].velocity - (goal - at).normalize() * 8.0).length() < 1e-4);
        assert!(drives[0].max_acceleration.is_infinite() && drives[0].is_pull, "set, not approached");
    }

    #[test]
    fn a_rigid_cell_is_as_fast_in_substeps_of_any_length() {
        let way = |damping: f32, substeps: u32| {
            let config = WorldConfig { damping, substeps, ..WorldConfig::default() };
            let mut world = World::new(config).unwrap();
            let cell = world.spawn(&RigidCellSpec::default().into(), Placement::at(20.0, 45.0)).unwrap();
            let mut inputs = Inputs::new();
            inputs.set(cell, Intent::toward(Vec2::new(500.0, 45.0)).unwrap());
            (0..120).for_each(|_| world.step(&inputs));
            world.centroid(cell).unwrap().x - 20.0
        };
        for damping in [0.5, 2.0] {
            let ways = [4, 8, 16, 64].map(|substeps| way(damping, substeps));
            let mean = ways.iter().sum::<f32>() / 4.0;
            assert!(ways.iter().all(|way| (way / mean - 1.0).abs() < 0.03), "damping {damping}: {ways:?}");
        }
    }

    #[test]
    fn a_small_rigid_cell_swims_calmly_in_long_substeps() {
        for (satellites, substeps) in [(8, 1), (8, 2), (28, 1), (28, 2)] {
            let config = WorldConfig { substeps, protects_membranes: false, ..WorldConfig::default() };
            let mut world = World::new(config).unwrap();
            let spec = RigidCellSpec { satellites, layers: 1, ..RigidCellSpec::default() };
            let cell = world.spawn(&spec.into(), Placement::at(20.0, 45.0)).unwrap();
            let mut inputs = Inputs::new();
            inputs.set(cell, Intent::toward(Vec2::new(500.0, 45.0)).unwrap());
            let mut fastest = 0.0_f32;
            for _ in 0..120 {
                world.step(&inputs);
                let list: Vec<u32> = world.organisms.get(cell).unwrap().particles().collect();
                fastest = list.iter().map(|&i| world.particles.velocity(i as usize).length()).fold(fastest, f32::max);
            }
            assert!(fastest < 16.0, "{satellites} satellites, {substeps} substeps: {fastest}");
        }
    }

    #[test]
    fn t14_front_switches_only_when_the_goal_is_nearer_to_the_opposite_body() {
        assert_eq!(drives_to(Vec2::new(80.5, 200.0)).2, 0);
        assert_eq!(drives_to(Vec2::new(79.5, 200.0)).2, 14);
        assert_eq!(drives_to(Vec2::new(0.0, 45.0)).2, 14);
    }

    #[test]
    fn a_front_at_its_goal_is_not_driven_anywhere() {
        let (world, drives, _) = drives_to(Vec2::new(200.0, 45.0));
        let at = world.particles.position(drives[0].particle as usize);
        assert_eq!(drives_to(at).1[0].velocity, Vec2::ZERO);
    }
}
