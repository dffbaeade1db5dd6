//! Contacts of discs with static geometry: any `parry2d` shape. The world's walls are the first user.

use super::contact::{Impact, friction, moved, shift};
use crate::collision::obstacle::Obstacle;
use crate::collision::{ObstacleContact, combine};
use crate::geometry::ring::direction_or;
use crate::particle::Particles;
use glam::Vec2;

/// Moves discs out of obstacles.
pub(crate) fn project(
    contacts: &[ObstacleContact],
    obstacles: &[Obstacle],
    particles: &mut Particles,
    impacts: &mut Vec<Impact>,
) {
    for contact in contacts {
        let (i, obstacle) = (contact.particle as usize, &obstacles[contact.obstacle as usize]);
        if let Some((away, depth)) = separate(i, obstacle, particles) {
            let (mu, restitution) = combine(particles.material[i], obstacle.material);
            impacts.extend(Impact::on_static(particles, contact.particle, -away, restitution));
            let rub = friction(moved(particles, i), away, mu * depth);
            shift(particles, i, rub);
        }
    }
    // In a corner the friction on one wall may have moved a disc into the other.
    for contact in contacts {
        separate(contact.particle as usize, &obstacles[contact.obstacle as usize], particles);
    }
}

/// Moves a disc out of an obstacle; returns the way out and how deep it was, if it was inside.
fn separate(i: usize, obstacle: &Obstacle, particles: &mut Particles) -> Option<(Vec2, f32)> {
    let position = particles.position(i);
    let (surface, is_inside) = obstacle.nearest(position);
    let came_from = particles.last_position(i) - surface;
    let (away, distance) = direction(position - surface, is_inside, came_from);
    let depth = particles.radius[i] - distance;
    (depth > 0.0).then(|| {
        shift(particles, i, away * depth);
        (away, depth)
    })
}

/// Unit vector out of the obstacle and signed distance to its surface (negative inside). On the surface itself the way out
/// is the way back.
fn direction(from_surface: Vec2, is_inside: bool, came_from: Vec2) -> (Vec2, f32) {
    let length = from_surface.length();
    if length <= 1e-6 {
        (direction_or(came_from, Vec2::Y), 0.0)
    } else if is_inside {
        (-from_surface / length, -length)
    } else {
        (from_surface / length, length)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::line;
    use super::*;
    use parry2d::math::Pose;
    use parry2d::shape::SharedShape;

    fn out_of(shape: SharedShape, start: Vec2) -> f32 {
        let obstacle = Obstacle::new(shape, Pose::translation(10.0, 5.0));
        let mut p = line(100.0, [1.0, 1.0]);
        (p.x[0], p.y[0]) = (start.x, start.y);
        let contact = ObstacleContact { particle: 0, obstacle: 0 };
        project(&[contact], std::slice::from_ref(&obstacle), &mut p, &mut Vec::new());
        let (surface, is_inside) = obstacle.nearest(p.position(0));
        let distance = (p.position(0) - surface).length();
        if is_inside { -distance } else { distance }
    }

    #[test]
    fn discs_end_outside_every_kind_of_shape() {
        let shapes = [
            SharedShape::cuboid(2.0, 1.0),
            SharedShape::ball(1.5),
            SharedShape::capsule(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.5), 0.7),
            SharedShape::convex_hull(&[Vec2::new(-2.0, -1.0), Vec2::new(2.0, -1.0), Vec2::new(0.0, 2.0)]).unwrap(),
            SharedShape::compound(vec![
                (Pose::translation(-3.0, 0.0), SharedShape::ball(1.0)),
                (Pose::translation(0.5, 0.0), SharedShape::cuboid(1.0, 1.0)),
            ]),
        ];
        for shape in shapes {
            for start in [Vec2::new(10.3, 5.2), Vec2::new(9.0, 4.6), Vec2::new(10.2, 6.6)] {
                let gap = out_of(shape.clone(), start);
                assert!(gap > 0.49, "{:?} from {start}: gap {gap}", shape.shape_type());
            }
        }
    }

    #[test]
    fn discs_apart_are_left_alone() {
        assert!((out_of(SharedShape::ball(1.0), Vec2::new(10.0, 8.0)) - 2.0).abs() < 1e-5);
    }
}
