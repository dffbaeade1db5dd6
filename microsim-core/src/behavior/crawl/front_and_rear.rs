//! Crawling by front and rear (thesis, 3.1.2): in every step the membrane is divided into front, rear and two wings. The front
//! is driven towards the goal, the rear a little more slowly towards the centroid, so that it becomes a tail; the wings
//! follow. Cytoplasm that lags behind is accelerated too: in a large cell the membrane alone would leave it behind.
//!
//! The other way, by [pseudopods](super::pseudopods), falls back to this one while a cell turns round or holds on to prey.

use crate::behavior::heading;
use crate::organism::Organism;
use crate::particle::Particles;
use crate::solver::drive::Drive;
use glam::Vec2;

/// Half-width of the front and of the rear, as a share of the membrane.
const HALF_WIDTH: f32 = 1.0 / 8.0;

/// Speed of the rear as a share of the front's.
const REAR_SPEED: f32 = 0.85;
/// Mean speed of the cytoplasm below which it is accelerated, as a share of the cell's speed, ...
const STREAMING_SPEED: f32 = 0.9;
/// ... and the time constant of that, s.
const STREAMING_TIME: f32 = 0.1;

/// Least distance of a goal, in radii of the cell: closer goals are moved out to it in the same direction.
const FAR: f32 = 2.5;
/// Distance from the centroid at which a goal is reached, in radii of the cell.
const ARRIVED: f32 = 0.3;

/// Part of a moving membrane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MembraneRegion {
    /// Around the node nearest to the goal.
    Front,
    /// Counter-clockwise of the front.
    LeftWing,
    /// Opposite to the front.
    Rear,
    /// Clockwise of the front.
    RightWing,
}

/// The region of node `k` in a membrane of `count` nodes whose front is centred on node `front_centre`.
pub(crate) fn region(k: u32, front_centre: u32, count: u32) -> MembraneRegion {
    let half_width = ((count as f32 * HALF_WIDTH) as u32).max(1);
    let ahead = (k + count - front_centre) % count;
    let from_front = ahead.min(count - ahead);
    if from_front <= half_width {
        MembraneRegion::Front
    } else if from_front >= count / 2 - half_width {
        MembraneRegion::Rear
    } else if ahead < count / 2 {
        MembraneRegion::LeftWing
    } else {
        MembraneRegion::RightWing
    }
}

/// Drives front and rear; returns the node of the outline that is the centre of the front, the nearest one to the goal.
pub(crate) fn drive(organism: &Organism, goal: Vec2, particles: &Particles, drives: &mut Vec<Drive>) -> Option<u32> {
    let nodes = organism.outline_positions(particles);
    let front_centre = crate::geometry::ring::nearest_index(&nodes, goal)? as u32;
    let count = nodes.len() as u32;
    let centroid = crate::geometry::polygon::centroid(&nodes)?;
    let goal = beyond(goal, centroid, &nodes)?;
    for ((k, particle), at) in (0..count).zip(organism.outline_particles()).zip(nodes) {
        let (target, share) = match region(k, front_centre, count) {
            MembraneRegion::Front => (goal, 1.0),
            MembraneRegion::Rear => (centroid, REAR_SPEED),
            MembraneRegion::LeftWing | MembraneRegion::RightWing => continue,
        };
        let velocity = heading(target - at) * (share * organism.present_speed());
        drives.push(Drive::new(particle, velocity, f32::INFINITY));
    }
    stream(organism, heading(goal - centroid), particles, drives);
    Some(front_centre)
}

/// Accelerates the cytoplasm evenly while its mean velocity lags behind.
fn stream(organism: &Organism, direction: Vec2, particles: &Particles, drives: &mut Vec<Drive>) {
    let (cytoplasm, speed) = (&organism.fluid_particles, organism.present_speed());
    let sum: Vec2 = cytoplasm.iter().map(|&i| particles.velocity(i as usize)).sum();
    let lag = STREAMING_SPEED * speed - sum.dot(direction) / cytoplasm.len() as f32;
    if lag > 0.0 {
        let (velocity, max_acceleration) = (direction * speed, lag / STREAMING_TIME);
        drives.extend(cytoplasm.iter().map(|&particle| Drive::new(particle, velocity, max_acceleration)));
    }
}

/// The goal, moved out if it is close: nodes that head for a goal next to them would meet in a point. `None` if the goal is
/// near the centroid: the cell has arrived.
pub(super) fn beyond(goal: Vec2, centroid: Vec2, nodes: &[Vec2]) -> Option<Vec2> {
    let radius = (crate::geometry::polygon::signed_area(nodes) / std::f32::consts::PI).sqrt();
    let offset = goal - centroid;
    let distance = offset.length();
    if distance >= FAR * radius {
        Some(goal)
    } else if distance >= ARRIVED * radius {
        Some(centroid + offset * (FAR * radius / distance))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn t20_front_bodies_head_for_the_goal_and_rear_bodies_for_the_centroid() {
        use crate::{AmoeboidCellSpec, Placement, World, WorldConfig};
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let (goal, centroid) = (Vec2::new(120.0, 60.0), world.centroid(id).unwrap());
        let organism = world.organisms.get(id).unwrap();
        let mut drives = Vec::new();
        let front = drive(organism, goal, &world.particles, &mut drives).unwrap();
        let ring: Vec<u32> = organism.outline_particles().collect();
        let count = ring.len() as u32;
        for (k, node) in (0..count).zip(&ring) {
            let given = drives.iter().find(|d| d.particle == *node).map(|d| d.velocity);
            let at = world.particles.position(*node as usize);
            let expected = match region(k, front, count) {
                MembraneRegion::Front => Some((goal - at).normalize() * 8.0),
                MembraneRegion::Rear => Some((centroid - at).normalize() * 8.0 * REAR_SPEED),
                MembraneRegion::LeftWing | MembraneRegion::RightWing => None,
            };
            assert_eq!(given.is_some(), expected.is_some(), "only front and rear drive");
            assert!(given.zip(expected).is_none_or(|(g, e)| (g - e).length() < 1e-3), "{given:?} {expected:?}");
        }
    }

    #[test]
    fn t18_t19_regions_are_symmetric_about_the_front_and_cover_the_ring() {
        for count in [12u32, 40, 65] {
            for front in [0, 5, count - 1] {
                let regions: Vec<_> = (0..count).map(|k| region(k, front, count)).collect();
                let size = |wanted| regions.iter().filter(|&&r| r == wanted).count();
                assert_eq!(regions[front as usize], MembraneRegion::Front);
                assert_eq!(regions[((front + count / 2) % count) as usize], MembraneRegion::Rear);
                assert_eq!(regions[((front + count / 4) % count) as usize], MembraneRegion::LeftWing);
                assert_eq!(regions[((front + count - count / 4) % count) as usize], MembraneRegion::RightWing);
                assert_eq!(size(MembraneRegion::Front) % 2, 1, "symmetric neighbours both ways");
                let wings = size(MembraneRegion::LeftWing).abs_diff(size(MembraneRegion::RightWing));
                assert!(wings <= 1 && size(MembraneRegion::LeftWing) > 0);
            }
        }
    }
}
