//! Contacts of discs with obstacles: any `parry2d` shape, fixed or on its way. The world's walls are the first user.
//!
//! A moving obstacle pushes with no limit of force, but moves back from what is caught: from a disc that something fixed has
//! pushed into it, or that others press into it by more than [`PRESS`] of its radius.

use super::contact::{Impact, friction, moved, shift};
use super::contact_record::{ContactRecorder, Projected, Touched};
use super::lanes::ratio;
use super::sweep::{Stop, first_stop};
use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_path::{ObstaclePath, path_of};
use crate::collision::{ObstacleContact, combine};
use crate::geometry::ring::direction_or;
use crate::particle::Particles;
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};

/// What rounding may make of a coordinate, relative to it, at the most.
const ROUNDING: f32 = 1e-5;
/// Share of a disc's radius by which a moving obstacle lets it be pressed in.
const PRESS: f32 = 0.1;
/// A one-way platform holds a disc that was at least this share of its radius above it ...
const CLEAR: f32 = 0.9;
/// ... in a direction whose cosine with the normal is at least this.
const UPRIGHT: f32 = 0.5;

/// Moves discs out of obstacles in a substep of `h`; obstacles on their way move back from what is caught.
pub(crate) fn project(
    contacts: &[ObstacleContact],
    obstacles: &[Obstacle],
    paths: &mut [ObstaclePath],
    particles: &mut Particles,
    impacts: &mut Vec<Impact>,
    recorder: &mut ContactRecorder,
    h: f32,
) {
    for (contact, bounds) in with_bounds(contacts, obstacles) {
        let (i, obstacle) = (contact.particle as usize, &obstacles[contact.obstacle as usize]);
        let path = path_of(paths, contact.obstacle);
        if let Some(Stop { away, depth, has_passed }) = separate(contact, obstacle, path.as_deref(), bounds, particles)
        {
            let at = particles.position(i) - contact.shift;
            let way = path.as_deref().map_or(Vec2::ZERO, |path| path.displacement(at));
            let (mu, restitution) = combine(particles.material[i], obstacle.material);
            if restitution > 0.0 || has_passed {
                impacts.extend(Impact::on_surface(
                    contact.particle,
                    particles.velocity(i),
                    -away,
                    restitution,
                    way / h,
                ));
            }
            recorder.note(|| Projected {
                particle: contact.particle,
                touched: Touched::Obstacle(contact.obstacle),
                point: particles.position(i) - away * particles.radius[i],
                normal: away,
                depth,
                weight: particles.inv_mass[i],
                restitution,
                way: way / h - particles.velocity(i),
            });
            if let Some(path) = path {
                let approach = (way - particles.velocity(i) * h).dot(away);
                let pressed = depth - if approach > 0.0 { approach } else { 0.0 };
                path.give_way(pressed - PRESS * particles.radius[i], way, away);
            }
            let rub = friction(moved(particles, i) - way, away, mu * depth);
            shift(particles, i, rub);
        }
    }
    // In a corner the friction on one wall may have moved a disc into the other.
    for (contact, bounds) in with_bounds(contacts, obstacles) {
        let path = path_of(paths, contact.obstacle);
        separate(contact, &obstacles[contact.obstacle as usize], path.as_deref(), bounds, particles);
    }
    if !paths.is_empty() {
        move_back(contacts, obstacles, paths, particles);
    }
}

/// All contacts, which lie side by side for each obstacle, with the box around it, and some more: rounding takes nothing away that a
/// disc may touch.
fn with_bounds<'a>(
    contacts: &'a [ObstacleContact],
    obstacles: &'a [Obstacle],
) -> impl Iterator<Item = (&'a ObstacleContact, Aabb)> {
    contacts.chunk_by(|a, b| a.obstacle == b.obstacle).flat_map(|of_one| {
        let Aabb { mins, maxs } = obstacles[of_one[0].obstacle as usize].aabb();
        let rim = (mins.abs().max_element() + maxs.abs().max_element()) * ROUNDING;
        let bounds = Aabb { mins: mins - rim, maxs: maxs + rim };
        of_one.iter().map(move |contact| (contact, bounds))
    })
}

/// Moves obstacles back from the discs that something fixed has pushed into them.
fn move_back(contacts: &[ObstacleContact], obstacles: &[Obstacle], paths: &mut [ObstaclePath], p: &Particles) {
    for (contact, bounds) in with_bounds(contacts, obstacles) {
        let Some(path) = path_of(paths, contact.obstacle) else { return };
        let (i, obstacle) = (contact.particle as usize, &obstacles[contact.obstacle as usize]);
        if let Some(Stop { away, depth, .. }) = overlap(contact, obstacle, Some(path), bounds, p) {
            path.give_way(depth, path.displacement(p.position(i) - contact.shift), away);
        }
    }
}

/// Moves a disc out of an obstacle; returns the way out and how deep it was, if it was inside.
fn separate(
    contact: &ObstacleContact,
    obstacle: &Obstacle,
    path: Option<&ObstaclePath>,
    bounds: Aabb,
    particles: &mut Particles,
) -> Option<Stop> {
    let stop = overlap(contact, obstacle, path, bounds, particles)?;
    shift(particles, contact.particle as usize, stop.away * stop.depth);
    Some(stop)
}

/// The way out of an obstacle and how deep a disc is in it, or beyond where it met it, if it is.
fn overlap(
    contact: &ObstacleContact,
    obstacle: &Obstacle,
    path: Option<&ObstaclePath>,
    bounds: Aabb,
    particles: &Particles,
) -> Option<Stop> {
    let i = contact.particle as usize;
    // As the obstacle itself would see what its image does.
    let (position, last) = (particles.position(i) - contact.shift, particles.last_position(i) - contact.shift);
    // Where it came from, beside the obstacle as it stands now.
    let from = last + path.map_or(Vec2::ZERO, |path| path.displacement(last));
    let radius = particles.radius[i];
    if (position - from).length_squared() > radius * radius
        && let Some(stop) = stop_on_way(obstacle, [from, position], radius)
    {
        return Some(stop);
    }
    // Most discs that may touch do not, and shapes are slow to ask.
    if !bounds.loosened(radius).contains_local_point(position) {
        return None;
    }
    let (surface, is_inside) = obstacle.nearest(position);
    let (away, distance) = direction(position - surface, is_inside, last - surface);
    let depth = radius - distance;
    let is_held = || obstacle.one_way.is_none_or(|normal| is_above(from, radius, obstacle, normal));
    (depth > 0.0 && is_held()).then_some(Stop { away, depth, has_passed: false })
}

/// Where a disc on a long way meets an obstacle first.
#[cold]
fn stop_on_way(obstacle: &Obstacle, way: [Vec2; 2], radius: f32) -> Option<Stop> {
    let Some(normal) = obstacle.one_way else { return first_stop(obstacle, way, radius, |_| true) };
    let normal = direction_or(obstacle.pose.transform_vector(normal), Vec2::Y);
    let (surface, _) = obstacle.nearest(way[0]);
    let is_clear = (way[0] - surface).length() >= CLEAR * radius;
    if is_clear { first_stop(obstacle, way, radius, |away| away.dot(normal) >= UPRIGHT) } else { None }
}

/// Whether a disc was wholly on the solid side of a one-way platform when the substep began.
fn is_above(from: Vec2, radius: f32, platform: &Obstacle, normal: Vec2) -> bool {
    let (surface, is_inside) = platform.nearest(from);
    let (way, normal) = (from - surface, platform.pose.transform_vector(normal));
    let distance = way.length();
    !is_inside && distance >= CLEAR * radius && way.dot(normal) * ratio(1.0, normal.length()) >= UPRIGHT * distance
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
    use crate::particle::Material;
    use crate::rng::Rng;
    use parry2d::math::{Pose, Rot2};
    use parry2d::shape::SharedShape;

    fn out_of(shape: SharedShape, start: Vec2) -> f32 {
        let obstacle = Obstacle::new(shape, Pose::translation(10.0, 5.0));
        let mut p = line(100.0, [1.0, 1.0]);
        (p.x[0], p.y[0]) = (start.x, start.y);
        let contact = ObstacleContact { particle: 0, obstacle: 0, shift: Vec2::ZERO };
        project(
            &[contact],
            std::slice::from_ref(&obstacle),
            &mut [],
            &mut p,
            &mut Vec::new(),
            &mut ContactRecorder::default(),
            0.01,
        );
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
    fn no_box_takes_a_contact_away() {
        let (mut rng, mut touching) = (Rng::new(6, 3), 0);
        for k in 0..20_000 {
            // As far away as a room is wide, turned, and with the disc as near as it may be to touch.
            let place = Vec2::new(rng.range(0.0, 9000.0), rng.range(0.0, 9000.0));
            let pose = Pose::from_parts(place, Rot2::from_angle(rng.range(0.0, 6.0)));
            let obstacle = Obstacle::new(SharedShape::cuboid(rng.range(0.1, 4000.0), rng.range(0.1, 4.0)), pose);
            let side = pose.transform_vector(if k % 2 == 0 { Vec2::X } else { Vec2::Y });
            let edge = obstacle.nearest(place + side * 1e4).0;
            let mut p = line(100.0, [1.0, 1.0]);
            let at = edge + side * (p.radius[0] + rng.range(-1e-3, 1e-3));
            (p.origin_x[0], p.origin_y[0], p.x[0], p.y[0]) = (0.0, 0.0, at.x, at.y);
            (p.prev_x[0], p.prev_y[0]) = (p.x[0], p.y[0]);
            let contacts = [ObstacleContact { particle: 0, obstacle: 0, shift: Vec2::ZERO }];
            let everywhere = Aabb { mins: Vec2::NEG_INFINITY, maxs: Vec2::INFINITY };
            let of = |bounds| overlap(&contacts[0], &obstacle, None, bounds, &p).map(|stop| (stop.away, stop.depth));
            let bounds = with_bounds(&contacts, std::slice::from_ref(&obstacle)).next().unwrap().1;
            assert_eq!(of(bounds), of(everywhere), "{obstacle:?} {at}");
            touching += u32::from(of(bounds).is_some());
        }
        assert!((5000..15_000).contains(&touching), "{touching}");
    }

    #[test]
    fn discs_apart_are_left_alone() {
        assert!((out_of(SharedShape::ball(1.0), Vec2::new(10.0, 8.0)) - 2.0).abs() < 1e-5);
    }

    #[test]
    fn a_one_way_platform_holds_what_begins_clear_above_it() {
        let platform = Obstacle::new(SharedShape::cuboid(4.0, 0.1), Pose::translation(10.0, 5.0));
        let platform = Obstacle { one_way: Some(Vec2::Y), ..platform };
        let passes = |from: f32, to: f32| stop_on_way(&platform, [from, to].map(|y| Vec2::new(10.0, y)), 0.5);
        let stop = passes(6.1, -20.0).unwrap();
        assert!(stop.has_passed && stop.away.y > 0.99 && (stop.depth - 25.6).abs() < 0.01, "{stop:?}");
        assert!(passes(3.9, 30.0).is_none() && passes(5.3, -20.0).is_none());
        let is_above = |x: f32, y: f32| is_above(Vec2::new(x, y), 0.5, &platform, Vec2::Y);
        assert_eq!([5.6, 5.3, 5.0, 4.4].map(|y| is_above(10.0, y)), [true, false, false, false]);
        assert!(!is_above(14.6, 5.0) && !is_above(14.6, 5.2) && is_above(14.1, 5.7));
    }

    #[test]
    fn only_surfaces_that_bounce_make_impacts() {
        for (restitution, made) in [(0.0, 0), (0.5, 1)] {
            let obstacle = Obstacle::new(SharedShape::cuboid(2.0, 1.0), Pose::IDENTITY);
            let obstacle = Obstacle { material: Material { friction: 0.0, restitution }, ..obstacle };
            let (mut p, mut impacts) = (line(100.0, [1.0, 1.0]), Vec::new());
            (p.y[0], p.vy[0]) = (1.3, -3.0);
            let contacts = [ObstacleContact { particle: 0, obstacle: 0, shift: Vec2::ZERO }];
            project(&contacts, &[obstacle], &mut [], &mut p, &mut impacts, &mut ContactRecorder::default(), 0.01);
            assert_eq!(impacts.len(), made, "restitution {restitution}");
        }
    }

    #[test]
    fn a_disc_on_the_surface_itself_goes_back_where_it_came_from() {
        let obstacle = Obstacle::new(SharedShape::cuboid(2.0, 1.0), Pose::translation(10.0, 5.0));
        let mut p = line(100.0, [1.0, 1.0]);
        (p.x[0], p.y[0], p.prev_x[0], p.prev_y[0]) = (10.5, 6.0, 10.5, 6.25);
        let contact = ObstacleContact { particle: 0, obstacle: 0, shift: Vec2::ZERO };
        let stop = overlap(&contact, &obstacle, None, obstacle.aabb(), &p).unwrap();
        assert_eq!((stop.away, stop.depth), (Vec2::Y, 0.5));
    }
}
