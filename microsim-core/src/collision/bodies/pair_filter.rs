//! Which pairs of bodies, and of their discs, collide.

use super::BodyProxy;
use crate::collision::disc::Disc;
use crate::collision::exemptions::Exemptions;
use crate::collision::{Contact, Mobility};
use crate::particle::Particles;
use crate::particle::sleep::Sleep;

/// Which pairs of bodies, and of their discs, collide.
#[derive(Clone, Copy)]
pub(in crate::collision) struct PairFilter<'a> {
    pub particles: &'a Particles,
    pub exemptions: &'a Exemptions,
    pub sleep: &'a Sleep,
    /// Largest displacement of a particle in a substep, units.
    pub longest: f32,
}

impl PairFilter<'_> {
    /// How two bodies give way, if they collide at all.
    pub(super) fn mobility(self, a: &BodyProxy, b: &BodyProxy) -> Option<[Mobility; 2]> {
        let mobility = [a, b].map(|body| match body.is_linked {
            _ if self.sleep.is_asleep(body.block) => Mobility::Asleep,
            true => Mobility::Linked,
            false => Mobility::Single,
        });
        let sleep = mobility == [Mobility::Asleep; 2];
        let collide = !sleep && a.owner != b.owner && !self.exemptions.contains(a.owner, b.owner);
        collide.then_some(mobility)
    }

    /// The contact of a disc of one with a disc of the other, if they collide; neither is in fluid or a ring.
    pub(super) fn contact(self, a: &Disc, b: &Disc, mobility: [Mobility; 2]) -> Option<Contact> {
        let (p, i, j) = (self.particles, a.index as usize, b.index as usize);
        let collide = p.inv_mass[i] + p.inv_mass[j] > 0.0 && p.groups[i].meets(p.groups[j]);
        collide.then(|| Contact::new(p, i, j, mobility, self.longest))
    }
}
