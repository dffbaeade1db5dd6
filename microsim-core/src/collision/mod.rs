//! Which particles may touch during a step: broad phase and filters. Knows no constraints.

mod aabb;
mod bodies;
pub(crate) mod broad_phase;
mod disc;
mod disc_grid;
pub(crate) mod exemptions;
mod images;
mod link_group;
pub(crate) mod obstacle;
pub(crate) mod obstacle_path;
pub(crate) mod obstacle_record;
pub(crate) mod ring;
pub(crate) mod ring_contacts;
mod ring_search;
pub(crate) mod speculative_margin;
pub(crate) mod uniform_grid;

use crate::particle::{Material, Particles};
use glam::Vec2;

/// Share of the sum of two discs' radii from which on their relative way in a substep is a long one: they may pass each other.
pub(crate) const FAST: f32 = 0.5;

/// How a side of a contact gives way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mobility {
    /// Not at all.
    Asleep,
    /// A disc on its own.
    Single,
    /// With others that it is linked to.
    Linked,
    /// A disc on its own that counts as at most so many times as heavy as the linked one.
    Bounded,
}

/// Two discs near enough that they may touch during the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    pub i: u32,
    pub j: u32,
    /// From the origin of `i` to the origin of `j`; origins stay where they are during a step.
    pub between_origins: Vec2,
    pub radius_sum: f32,
    pub friction: f32,
    pub restitution: f32,
    /// Touched in any substep since the pair was found.
    pub touched: bool,
    /// Whether one can be on the other side of the other after a substep.
    pub can_pass: bool,
    /// Of `i` and of `j`; not both are asleep.
    pub mobility: [Mobility; 2],
}

impl Contact {
    /// A contact of two discs that each move by at most `longest` units in a substep.
    pub(crate) fn new(p: &Particles, i: usize, j: usize, mobility: [Mobility; 2], longest: f32) -> Self {
        let (friction, restitution) = combine(p.material[i], p.material[j]);
        let radius_sum = p.radius[i] + p.radius[j];
        Self {
            i: i as u32,
            j: j as u32,
            between_origins: p.origin(j) - p.origin(i),
            radius_sum,
            friction,
            restitution,
            touched: false,
            can_pass: 2.0 * longest > FAST * radius_sum,
            mobility,
        }
    }

    /// That of the image of `i` that is displaced by `shift`.
    fn with_image(self, shift: Vec2) -> Self {
        Self { between_origins: self.between_origins - shift, ..self }
    }
}

/// The contacts of a step, in lists that were filled independently of each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Contacts {
    /// Of small bodies, by strips of the room.
    strips: Vec<Vec<Contact>>,
    others: Vec<Contact>,
}

impl Contacts {
    /// Empty lists with room for as many, and some more.
    fn blank(&self) -> Self {
        let list = |list: &Vec<_>| Vec::with_capacity(list.len() + list.len() / 8);
        Self { strips: self.strips.iter().map(list).collect(), others: list(&self.others) }
    }

    /// Contacts in one list.
    #[cfg(test)]
    pub(crate) fn of(others: Vec<Contact>) -> Self {
        Self { strips: Vec::new(), others }
    }

    fn clear(&mut self) {
        self.strips.iter_mut().for_each(Vec::clear);
        self.others.clear();
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.strips.iter().map(Vec::len).sum::<usize>() + self.others.len()
    }

    /// All of them, always in the same order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Contact> {
        self.strips.iter().flatten().chain(&self.others)
    }

    /// The lists, that of the others last. A contact of a strip has a body of this strip, and another one of this or of the next one.
    pub(crate) fn lists_mut(&mut self) -> impl Iterator<Item = &mut [Contact]> {
        self.strips.iter_mut().chain([&mut self.others]).map(Vec::as_mut_slice)
    }
}

/// A disc and an obstacle that may touch during the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObstacleContact {
    pub particle: u32,
    pub obstacle: u32,
    /// Displacement of the image of the obstacle; 0 for the obstacle itself.
    pub shift: Vec2,
}

/// Friction and restitution of two surfaces on each other.
pub(crate) fn combine(a: Material, b: Material) -> (f32, f32) {
    let restitution = if a.restitution > b.restitution { a.restitution } else { b.restitution };
    let friction = if a.friction == b.friction { a.friction } else { (a.friction * b.friction).sqrt() };
    (friction, restitution)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_surfaces_bounce_as_the_livelier_and_rub_as_their_geometric_mean() {
        let surface = |friction, restitution| Material { friction, restitution };
        let (rough, smooth) = (surface(0.8, 0.1), surface(0.2, 0.6));
        for (a, b) in [(rough, smooth), (smooth, rough)] {
            let (friction, restitution) = combine(a, b);
            assert!((friction - 0.4).abs() < 1e-6 && restitution == 0.6, "{friction}, {restitution}");
        }
        assert_eq!(combine(rough, rough), (0.8, 0.1));
    }
}
