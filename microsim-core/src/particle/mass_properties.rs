//! Mass properties: mass, centre, velocity and rotation of some particles as a whole.

use super::Particles;
use glam::Vec2;

/// Least moment of inertia of what can be turned.
pub(crate) const LEAST_INERTIA: f32 = 1e-12;

/// Mass, centre and velocity of the particles in a list that can move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MassProperties {
    pub mass: f32,
    /// The first of them.
    pub reference: usize,
    /// Centre of mass relative to that particle.
    pub centre: Vec2,
    pub velocity: Vec2,
}

/// The particles of a list that can move, each with its mass.
pub(crate) fn movable<'a>(p: &'a Particles, list: &'a [u32]) -> impl Iterator<Item = (usize, f32)> + 'a {
    let moves = list.iter().map(|&i| (i as usize, p.inv_mass[i as usize])).filter(|&(_, inv_mass)| inv_mass > 0.0);
    moves.map(|(i, inv_mass)| (i, 1.0 / inv_mass))
}

impl MassProperties {
    /// Those of a list; `None` if nothing in it can move.
    pub(crate) fn of(p: &Particles, list: &[u32]) -> Option<Self> {
        let (reference, _) = movable(p, list).next()?;
        let (mut mass, mut centre, mut velocity) = (0.0, Vec2::ZERO, Vec2::ZERO);
        for (i, m) in movable(p, list) {
            mass += m;
            centre += p.between(reference, i) * m;
            velocity += p.velocity(i) * m;
        }
        Some(Self { mass, reference, centre: centre / mass, velocity: velocity / mass })
    }

    /// Where a particle is relative to the centre of mass.
    pub(crate) fn arm(&self, p: &Particles, i: usize) -> Vec2 {
        p.between(self.reference, i) - self.centre
    }

    /// Centre of mass in the world.
    pub(crate) fn position(&self, p: &Particles) -> Vec2 {
        p.position(self.reference) + self.centre
    }

    /// Moment of inertia about the centre of mass; `None` for what cannot be turned.
    pub(crate) fn inertia(&self, p: &Particles, list: &[u32]) -> Option<f32> {
        let inertia = movable(p, list).map(|(i, m)| m * self.arm(p, i).length_squared()).sum();
        (inertia > LEAST_INERTIA).then_some(inertia)
    }

    /// Rotation from some places, one for each of a list, to where its particles are, that fits best by mass: the vector of its cosine
    /// and sine, times a factor, which is zero for a single particle.
    pub(crate) fn rotation(&self, p: &Particles, list: &[u32], places: impl Iterator<Item = Vec2>) -> Vec2 {
        let places: Vec<(Vec2, f32, usize)> = (list.iter().zip(places))
            .flat_map(|(i, place)| movable(p, std::slice::from_ref(i)).map(move |(i, mass)| (place, mass, i)))
            .collect();
        let centre = places.iter().map(|&(place, mass, _)| place * mass).sum::<Vec2>() / self.mass;
        let (mut dot, mut cross) = (0.0, 0.0);
        for (place, mass, i) in places {
            let (from, to) = (place - centre, self.arm(p, i));
            dot += mass * from.dot(to);
            cross += mass * from.perp_dot(to);
        }
        Vec2::new(dot, cross)
    }

    /// Angular momentum about the centre of mass.
    pub(crate) fn angular_momentum(&self, p: &Particles, list: &[u32]) -> f32 {
        movable(p, list).map(|(i, m)| m * self.arm(p, i).perp_dot(p.velocity(i) - self.velocity)).sum()
    }

    /// Angular velocity about the centre of mass, radians/s counter-clockwise; 0 for what cannot be turned.
    pub(crate) fn angular_velocity(&self, p: &Particles, list: &[u32]) -> f32 {
        self.inertia(p, list).map_or(0.0, |inertia| self.angular_momentum(p, list) / inertia)
    }
}
