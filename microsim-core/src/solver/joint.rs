//! Joints: two places are held at a length, by a spring, or with a limited force.
//!
//! `C = |b - a| - l`, two XPBD iterations per substep (see [`super::constraint::Distance`]), forwards and backwards, so that joints
//! of any number and order make no energy (see `template/projection.rs`), where a place is a point or the
//! centre of mass of some particles, which moves with the inverse of their total mass. A spring of frequency `f` and damping
//! ratio `z` has `k = w^2 / W`, `w = 2 pi f`, `W` the sum of inverse masses, and the damping time `2 z / w`. The multiplier
//! over `h^2` is the force.

use super::lanes::ratio;
use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_path::{ObstaclePath, path_of};
use crate::particle::Particles;
use crate::particle::mass_properties::movable;
use glam::Vec2;
use std::f32::consts::TAU;
use std::iter;
use std::ops::Range;

/// One end in a step.
#[derive(Clone, Debug)]
pub(crate) enum End {
    /// Some of the particles of [`Joints`], and whether nothing can move them in this step.
    Particles { range: Range<usize>, is_static: bool },
    /// A place on the grid of origins, the place relative to that, and how far it has moved in the substep.
    Point { origin: Vec2, offset: Vec2, moved: Vec2 },
}

/// What holds the ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Law {
    /// Wanted length, units.
    pub length: f32,
    /// Speed at which the present length is to change, in place of a wanted length.
    pub speed: Option<f32>,
    /// Frequency, Hz, and damping ratio of a spring; `None` is rigid.
    pub spring: Option<[f32; 2]>,
    /// Whether it does nothing to what is nearer.
    pub only_pulls: bool,
    pub max_force: f32,
    pub break_force: f32,
}

impl Law {
    /// A rigid one that neither breaks nor gives way.
    pub(crate) fn rigid(length: f32) -> Self {
        let (max_force, break_force) = (f32::INFINITY, f32::INFINITY);
        Self { length, speed: None, spring: None, only_pulls: false, max_force, break_force }
    }
}

/// A joint in a step.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub ends: [End; 2],
    /// Displacement of the second end from the image of it that is joined.
    pub shift: Vec2,
    pub law: Law,
    /// Multiplier in this substep so far.
    pub lambda: f32,
    /// Largest force in a substep so far.
    pub force: f32,
    pub is_broken: bool,
}

/// An end at a place of an obstacle.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// Which joint and which of its ends.
    pub joint: usize,
    pub end: usize,
    /// Index among all obstacles.
    pub obstacle: u32,
    /// In the obstacle's frame.
    pub at: Vec2,
}

/// The joints of a step, in the order of projection, the particles of their ends, and the ends that obstacles hold.
#[derive(Debug, Default)]
pub(crate) struct Joints {
    pub list: Vec<Joint>,
    pub particles: Vec<u32>,
    pub held: Vec<Held>,
}

/// An end in a substep.
struct Place {
    origin: Vec2,
    offset: Vec2,
    /// Since the substep began.
    moved: Vec2,
    inv_mass: f32,
}

/// What a joint does to its ends.
struct Pull {
    /// Multiplier in this substep, with what was done so far.
    lambda: f32,
    /// From the first end to the second.
    normal: Vec2,
    inv_masses: [f32; 2],
}

impl Joints {
    pub(crate) fn clear(&mut self) {
        self.list.clear();
        self.particles.clear();
        self.held.clear();
    }

    /// Takes the ends that obstacles hold to where these are at the end of the substep.
    pub(crate) fn follow(&mut self, obstacles: &[Obstacle], paths: &mut [ObstaclePath]) {
        for held in &self.held {
            let at = obstacles[held.obstacle as usize].pose.transform_point(held.at);
            let moved = path_of(paths, held.obstacle).map_or(Vec2::ZERO, |path| path.displacement(at));
            self.list[held.joint].ends[held.end] = End::place(at, moved);
        }
    }

    /// Projects the joints forwards and backwards, the last one once, in a substep of `h` seconds.
    pub(crate) fn project(&mut self, p: &mut Particles, h: f32) {
        let Self { list, particles, .. } = self;
        let Some((last, others)) = list.split_last_mut() else { return };
        for joint in &mut *others {
            joint.lambda = 0.0;
            joint.project_forwards(particles, p, h);
        }
        last.lambda = 0.0;
        for joint in iter::once(last).chain(others.iter_mut().rev()) {
            joint.project_backwards(particles, p, h);
        }
    }
}

impl Joint {
    /// With no more than what breaks it: that is decided on the way back.
    fn project_forwards(&mut self, list: &[u32], p: &mut Particles, h: f32) {
        let Some(pull) = self.pull(list, p, h) else { return };
        let most = self.law.break_force * h * h;
        self.exert(Pull { lambda: pull.lambda.clamp(-most, most), ..pull }, list, p);
    }

    /// With the force of this substep, which is measured, or which breaks it.
    fn project_backwards(&mut self, list: &[u32], p: &mut Particles, h: f32) {
        let Some(pull) = self.pull(list, p, h) else { return };
        let force = pull.lambda.abs() / (h * h);
        self.is_broken = force > self.law.break_force;
        self.force = if force > self.force { force } else { self.force };
        if !self.is_broken {
            self.exert(pull, list, p);
        }
    }

    /// Moves the ends by what a multiplier is more than the one so far.
    fn exert(&mut self, Pull { lambda, normal, inv_masses: [a, b] }: Pull, list: &[u32], p: &mut Particles) {
        let more = lambda - self.lambda;
        self.lambda = lambda;
        self.ends[0].shift(normal * (-more * a), list, p);
        self.ends[1].shift(normal * (more * b), list, p);
    }

    /// What it asks for now; `None` where nothing is to be done.
    fn pull(&self, list: &[u32], p: &Particles, h: f32) -> Option<Pull> {
        if self.is_broken {
            return None;
        }
        let [a, b] = self.ends.each_ref().map(|end| end.present(list, p));
        // A weight on a joint of 10 units stretches it by 4e-5 units in a substep, of which `f32` would lose a fiftieth.
        let between_origins = b.origin - a.origin - self.shift;
        let across = [0, 1].map(|k| f64::from(between_origins[k]) + f64::from(b.offset[k] - a.offset[k]));
        let length = length_of(across);
        let weight = a.inv_mass + b.inv_mass;
        // What is no longer finite harms nobody else.
        if !(length > 0.0 && length < f64::INFINITY && weight > 0.0) {
            return None;
        }
        let moved = (b.moved - a.moved).to_array().map(f64::from);
        let earlier = [0, 1].map(|k| across[k] - moved[k]);
        let before = length_of(earlier);
        // As in `ConservativeDistance`: along the line when the substep began, unless it has changed too much for that.
        let (way, long) = if 2.0 * length_of(moved) < before { (earlier, before) } else { (across, length) };
        let cosine = (way[0] * across[0] + way[1] * across[1]) / (long * length);
        let normal = Vec2::from(way.map(|way| (way / long) as f32));
        let lambda = self.law.multiplier([before, length], weight, cosine as f32, self.lambda, h);
        Some(Pull { lambda, normal, inv_masses: [a.inv_mass, b.inv_mass] })
    }
}

fn length_of([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

impl Law {
    /// Multiplier, which is `lambda` so far, for ends that were so far apart when the substep began, and are now; `cosine` is that of
    /// the angle between the line through them and the line along which they are moved.
    fn multiplier(&self, [before, length]: [f64; 2], weight: f32, cosine: f32, lambda: f32, h: f32) -> f32 {
        let wanted = self.speed.map_or(f64::from(self.length), |speed| before + f64::from(speed * h));
        let error = (length - if wanted > 0.0 { wanted } else { 0.0 }) as f32;
        let (alpha, gamma) = self.spring.map_or((0.0, 0.0), |[frequency, damping_ratio]| {
            let omega = TAU * frequency;
            let alpha = weight / (omega * omega * h * h);
            (alpha, 2.0 * damping_ratio / (omega * h) - alpha / (alpha + weight))
        });
        let opening = (length - before) as f32;
        let lambda = lambda + ratio(-error - alpha * lambda - gamma * opening, (1.0 + gamma) * weight * cosine + alpha);
        let most = self.max_force * h * h;
        lambda.clamp(-most, if self.only_pulls { 0.0 } else { most })
    }
}

impl End {
    /// A place that has moved so far in the substep.
    pub(crate) fn place(at: Vec2, moved: Vec2) -> Self {
        let origin = at.round();
        Self::Point { origin, offset: at - origin, moved }
    }

    fn present(&self, list: &[u32], p: &Particles) -> Place {
        match *self {
            Self::Point { origin, offset, moved } => Place { origin, offset, moved, inv_mass: 0.0 },
            Self::Particles { ref range, is_static } => Place::of(&list[range.clone()], is_static, p),
        }
    }

    fn shift(&self, by: Vec2, list: &[u32], p: &mut Particles) {
        let Self::Particles { range, is_static: false } = self else { return };
        for &i in &list[range.clone()] {
            if p.inv_mass[i as usize] > 0.0 {
                super::contact::shift(p, i as usize, by);
            }
        }
    }
}

impl Place {
    /// Centre of mass of some particles; of a single one, its place.
    fn of(list: &[u32], is_static: bool, p: &Particles) -> Self {
        let reference = list[0] as usize;
        let (mut mass, mut offset, mut moved) = (0.0, Vec2::ZERO, Vec2::ZERO);
        for (i, m) in movable(p, list) {
            mass += m;
            offset += ((p.origin(i) - p.origin(reference)) + p.offset(i)) * m;
            moved += super::contact::moved(p, i) * m;
        }
        let inv_mass = if is_static { 0.0 } else { ratio(1.0, mass) };
        let (offset, moved) = if mass > 0.0 && list.len() > 1 {
            (offset / mass, moved / mass)
        } else {
            (p.offset(reference), super::contact::moved(p, reference))
        };
        Self { origin: p.origin(reference), offset, moved, inv_mass }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_pair_laws, line, momentum};
    use super::*;

    const H: f32 = 0.01;

    fn joints(law: Law) -> Joints {
        let end = |k: usize| End::Particles { range: k..k + 1, is_static: false };
        let joint = Joint { ends: [end(0), end(1)], shift: Vec2::ZERO, law, lambda: 0.0, force: 0.0, is_broken: false };
        Joints { list: vec![joint], particles: vec![0, 1], held: Vec::new() }
    }

    #[test]
    fn obeys_the_laws_of_a_pair_constraint() {
        for spring in [None, Some([5.0, 0.0])] {
            let law = Law { spring, ..Law::rigid(1.0) };
            assert_pair_laws(&[0.5, 1.7], 1.0, |p| {
                p.prev_x.clone_from(&p.x);
                joints(law).project(p, H);
            });
        }
    }

    #[test]
    fn a_rope_only_pulls() {
        let law = Law { only_pulls: true, ..Law::rigid(1.0) };
        let [mut slack, mut taut] = [0.5, 2.0].map(|length| line(length, [0.0, 1.0]));
        joints(law).project(&mut slack, H);
        joints(law).project(&mut taut, H);
        assert_eq!((slack.x[1], taut.x[1]), (0.5, 1.0));
    }

    #[test]
    fn a_force_is_limited_reported_and_breaks() {
        let law = Law { max_force: 100.0, ..Law::rigid(1.0) };
        let mut p = line(2.0, [0.0, 0.5]);
        let mut limited = joints(law);
        limited.project(&mut p, H);
        // 100 * h^2 / 2.
        assert!((p.x[1] - 1.995).abs() < 1e-6 && (limited.list[0].force - 100.0).abs() < 1e-3);
        let mut breaking = joints(Law { break_force: 99.0, ..law });
        let before = p.x.clone();
        (0..2).for_each(|_| breaking.project(&mut p, H));
        assert!(breaking.list[0].is_broken && p.x == before);
    }

    #[test]
    fn what_the_way_back_takes_off_is_no_force() {
        // The first joint takes the disc from 2 to 1, the second one to 0.5, and the first one back to 1.
        let first = |break_force| {
            let mut p = line(1.0, [1.0, 1.0]);
            p.x[0] = 2.0;
            let joint = |(length, break_force)| {
                let ends = [End::place(Vec2::ZERO, Vec2::ZERO), End::Particles { range: 0..1, is_static: false }];
                let law = Law { break_force, ..Law::rigid(length) };
                Joint { ends, shift: Vec2::ZERO, law, lambda: 0.0, force: 0.0, is_broken: false }
            };
            let list = [(1.0, break_force), (0.5, f32::INFINITY)].map(joint).to_vec();
            let mut joints = Joints { list, particles: vec![0], held: Vec::new() };
            joints.project(&mut p, H);
            assert_eq!(p.x[0], 1.0);
            joints.list.remove(0)
        };
        let whole = 1.0 / (H * H);
        assert!((first(f32::INFINITY).force - 0.5 * whole).abs() < 1e-2 * whole);
        assert!(!first(0.75 * whole).is_broken);
    }

    #[test]
    fn a_motor_changes_the_length_at_its_speed_and_keeps_momentum() {
        let mut p = line(2.0, [1.0, 0.5]);
        let before = momentum(&p);
        p.prev_x.clone_from(&p.x);
        joints(Law { speed: Some(-10.0), ..Law::rigid(0.0) }).project(&mut p, H);
        assert!((p.between(0, 1).x - 1.9).abs() < 1e-6 && (momentum(&p) - before).length() < 1e-6);
    }

    #[test]
    fn the_centre_of_a_body_is_moved_as_a_whole() {
        let mut p = line(2.0, [1.0, 0.5]);
        let ends = [End::Particles { range: 0..2, is_static: false }, End::place(Vec2::Y, Vec2::ZERO)];
        let joint = Joint { ends, shift: Vec2::ZERO, law: Law::rigid(0.0), lambda: 0.0, force: 0.0, is_broken: false };
        Joints { list: vec![joint], particles: vec![0, 1], held: Vec::new() }.project(&mut p, H);
        assert!((p.x[0] + 4.0 / 3.0).abs() < 1e-6 && (p.x[1] - 2.0 / 3.0).abs() < 1e-6 && p.y == [1.0, 1.0]);
    }

    #[test]
    fn fixed_particles_are_where_the_first_of_them_is() {
        let place = Place::of(&[0, 1], false, &line(3.0, [0.0, 0.0]));
        assert_eq!((place.offset, place.moved, place.inv_mass), (Vec2::ZERO, Vec2::ZERO, 0.0));
    }
}
