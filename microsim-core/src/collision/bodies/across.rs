//! Bodies and the images of others, across periodic sides. The same floating-point numbers are compared whoever is looked for,
//! so no pair is found by none of two searches: of two bodies the one is displaced that meets the other to the right or above.

use super::{Bodies, BodyProxy, PairFilter};
use crate::collision::Contact;
use crate::collision::aabb::Aabb;
use crate::collision::disc::Disc;
use crate::collision::disc_grid::DiscGrid;
use crate::collision::images::Images;
use crate::collision::speculative_margin::SpeculativeMargins;
use crate::geometry::period::leads_on;
use crate::particle::sleep::Sleep;
use glam::Vec2;

impl Bodies {
    /// The box around all of them.
    pub(in crate::collision) fn bounds(&self) -> Aabb {
        self.iter().fold(Aabb::EMPTY, |all, body| all.union(body.aabb))
    }

    /// Adds the contacts of discs with images of others that may touch within the speculative margins.
    #[cold]
    #[inline(never)]
    pub(in crate::collision) fn pairs_across(&self, images: &Images, filter: PairFilter<'_>, found: &mut Vec<Contact>) {
        for body in self.iter() {
            for shift in images.ahead(body.aabb) {
                for other in self.near_image(body, shift) {
                    self.contacts_across([body, other], shift, body.slack + other.slack, filter, |_, _| true, found);
                }
            }
        }
    }

    /// Adds those that the speculative margins left out of a body that may exceed its own.
    #[cold]
    #[inline(never)]
    pub(super) fn late_pairs_of_images(
        &self,
        body: &BodyProxy,
        images: &Images,
        filter: PairFilter<'_>,
        margins: &SpeculativeMargins,
        found: &mut Vec<Contact>,
    ) {
        for shift in images.of(body.aabb) {
            for other in self.near_image(body, shift) {
                let slack = margins.slack_of(other);
                let (pair, shift) = if leads_on(shift) { ([body, other], shift) } else { ([other, body], -shift) };
                let is_missing = |a: &Disc, b: &Disc| !a.is_within(b, body.slack + slack);
                self.contacts_across(pair, shift, slack, filter, is_missing, found);
            }
        }
    }

    /// Blocks of sleepers of which an image is near a body that moves.
    pub(in crate::collision) fn woken_across(&self, images: &Images, sleep: &Sleep) -> Vec<u32> {
        let moving = self.iter().filter(|body| body.is_moving);
        let near = moving.flat_map(|body| images.of(body.aabb).flat_map(|shift| self.near_image(body, shift)));
        near.filter(|other| sleep.is_asleep(other.block)).map(|sleeper| sleeper.block).collect()
    }

    /// Calls `visit` once for each disc of the image of a body, and the displacement of it, and each disc of a grid that may touch.
    pub(in crate::collision) fn pairs_across_with(
        &self,
        images: &Images,
        grid: &DiscGrid,
        mut visit: impl FnMut(&Disc, &Disc, Vec2),
    ) {
        for body in self.iter() {
            for shift in images.of(body.aabb) {
                let image = body.aabb.moved(shift);
                for other in grid.in_box(image.low(), image.high()).filter(|other| other.aabb().overlaps(image)) {
                    let near = self.discs_of(body).map(|disc| disc.moved(shift));
                    near.filter(|disc| disc.is_near(other)).for_each(|disc| visit(&disc, other, shift));
                }
            }
        }
    }

    /// Bodies near the image of one.
    fn near_image(&self, body: &BodyProxy, shift: Vec2) -> impl Iterator<Item = &BodyProxy> {
        let image = body.aabb.moved(shift).shrunk(0.0);
        self.in_box(image.low(), image.high())
    }

    /// Adds the contacts of the discs of a body's image with those of another body that may touch if both together move by `slack`
    /// less than the largest displacements, if they are `wanted`.
    fn contacts_across(
        &self,
        [body, other]: [&BodyProxy; 2],
        shift: Vec2,
        slack: f32,
        filter: PairFilter<'_>,
        wanted: impl Fn(&Disc, &Disc) -> bool,
        found: &mut Vec<Contact>,
    ) {
        let Some(mobility) = filter.mobility(body, other) else { return };
        let image = body.aabb.moved(shift).shrunk(0.0).shrunk(slack);
        let mut near = Vec::new();
        self.discs_in(other, image).for_each(|disc| near.push(disc));
        let of_image = self.discs_of(body).map(|disc| disc.moved(shift));
        for disc in of_image.filter(|_| !near.is_empty()) {
            for other in near.iter().filter(|other| disc.is_within(other, slack) && wanted(&disc, other)) {
                let contact = filter.contact(&disc, other, mobility);
                found.extend(contact.map(|contact| contact.with_image(shift)));
            }
        }
    }
}
