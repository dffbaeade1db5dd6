//! Broad phase, once per step: pairs that may touch before the next one; of bodies that exceed their margin, once more.
//!
//! The speed limit bounds the displacement `d` of a step, so only pairs within `r_i + r_j + 2 d` can touch. Soft bodies and
//! single discs are searched by their boxes first ([`bodies`]), membranes and fluid disc by disc ([`disc_grid`]). Between two
//! soft bodies the margin is smaller at first ([`speculative_margin`]).
//!
//! [`bodies`]: super::bodies
//! [`disc_grid`]: super::disc_grid
//! [`speculative_margin`]: super::speculative_margin

use super::aabb::Aabb as SearchBox;
use super::bodies::{Bodies, BodyProxy, PairFilter};
use super::disc::Disc;
use super::disc_grid::{DiscColumns, DiscGrid, FluidChanges};
use super::exemptions::Exemptions;
use super::images::Images;
use super::obstacle::Obstacle;
use super::obstacle_path::ObstaclePath;
use super::ring::{Containment, Ring};
use super::ring_contacts::RingContacts;
use super::ring_search::RingQuery;
use super::speculative_margin::{DisplacementLimits, SpeculativeMargins};
use super::{Contact, Contacts, Mobility, ObstacleContact};
use crate::geometry::period::Period;
use crate::instruction_set::Dispatch;
use crate::parallel;
use crate::particle::sleep::Sleep;
use crate::particle::{BlockRange, NO_OWNER, Particles, outside_of};
use crate::shared::Shared;
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};

/// The pairs of this step, and what found them.
#[derive(Debug, Default)]
pub(crate) struct BroadPhase {
    pub contacts: Shared<Contacts>,
    /// Those of moving obstacles first, so that fixed ones have the last word.
    pub obstacle_contacts: Vec<ObstacleContact>,
    /// Discs that may be in a sensor at the end of the step.
    pub sensor_contacts: Vec<ObstacleContact>,
    pub ring_contacts: Shared<RingContacts>,
    pub margins: SpeculativeMargins,
    bodies: Bodies,
    membranes: DiscGrid,
    fluid: DiscGrid,
    fluid_changes: FluidChanges,
    /// Of a room with periodic sides.
    images: Option<Images>,
}

/// What a pair search needs to know of the world.
#[derive(Clone, Copy)]
pub(crate) struct SearchInput<'a> {
    pub particles: &'a Particles,
    /// The blocks, in the order in which they lie in the store.
    pub blocks: &'a [BlockRange],
    pub obstacles: &'a [Obstacle],
    /// Of the obstacles that move in this step, in their order.
    pub paths: &'a [ObstaclePath],
    pub exemptions: &'a Exemptions,
    /// Rings whose links collide. Without any, ring nodes collide as discs.
    pub rings: &'a [Ring<'a>],
    /// Which of them holds each owner, by owner.
    pub containments: &'a [Containment],
    /// Upper right corner of the room.
    pub size: Vec2,
    pub period: Period,
    /// How many of the obstacles, the first ones, are walls as long as the room and its images.
    pub walls: usize,
    pub limits: DisplacementLimits,
    pub dispatch: Dispatch,
}

impl BroadPhase {
    /// Copies the contacts, which queries between steps need.
    pub(crate) fn share_pairs_of(&mut self, other: &Self) {
        self.contacts.clone_from(&other.contacts);
        self.ring_contacts.clone_from(&other.ring_contacts);
    }

    /// Finds the pairs of the step that begins, and the blocks that sleep in it: those whose bodies have all been slow for
    /// `steps_to_sleep` steps, with nothing near that moves.
    pub(crate) fn find_pairs(&mut self, input: SearchInput<'_>, sleep: &mut Sleep, steps_to_sleep: u16) {
        self.sort(input, sleep);
        if sleep.fall_asleep(steps_to_sleep) {
            self.keep_awake(input, sleep);
        }
        let sleep = &*sleep;
        let Self { contacts, ring_contacts, bodies, membranes, fluid, fluid_changes, images, .. } = self;
        let (contacts, bodies) = (contacts.get_mut_or(Contacts::blank), &*bodies);
        let filter = PairFilter {
            particles: input.particles,
            exemptions: input.exemptions,
            sleep,
            longest: input.limits.substep,
        };
        parallel::join(
            || find_contacts(contacts, bodies, [membranes, fluid], fluid_changes, *images, filter, input),
            || find_ring_contacts(ring_contacts, bodies, [membranes, fluid], input),
        );
        self.find_obstacle_contacts(input, sleep);
    }

    /// Finds the pairs of bodies that may exceed their speculative margin with another displacement of `next`: in the present
    /// substep, if the displacements up to its beginning have been subtracted.
    pub(crate) fn find_late_pairs(
        &mut self,
        particles: &Particles,
        exemptions: &Exemptions,
        sleep: &Sleep,
        next: f32,
    ) -> &mut [Contact] {
        let Self { contacts, bodies, margins, images, .. } = self;
        let known = contacts.others.len();
        if margins.any_below(next) {
            let filter = PairFilter { particles, exemptions, sleep, longest: next };
            bodies.late_pairs(filter, margins, next, images.as_ref(), &mut contacts.others);
        }
        &mut contacts.others[known..]
    }

    /// Keeps the blocks of sleepers awake near which something moves. Membranes and fluid always count as moving.
    fn keep_awake(&self, input: SearchInput<'_>, sleep: &mut Sleep) {
        let Self { bodies, membranes, fluid, .. } = self;
        let grids = [membranes, fluid].into_iter().filter(|grid| !grid.is_empty());
        let in_grids = grids.flat_map(|grid| {
            let is_in = |body: &&BodyProxy| grid.in_box(body.aabb.low(), body.aabb.high()).next().is_some();
            bodies.sleepers(sleep).filter(is_in)
        });
        let boxes = input.paths.iter().map(|path| path.aabb(&input.obstacles[path.obstacle as usize]));
        let pushed =
            boxes.flat_map(|aabb| bodies.in_box(aabb.mins, aabb.maxs)).filter(|body| sleep.is_asleep(body.block));
        let mut woken = bodies.woken(sleep);
        woken.extend(in_grids.chain(pushed).map(|body| body.block));
        if let Some(images) = &self.images {
            woken.extend(bodies.woken_across(images, sleep));
            woken.extend(self.woken_by_images(images, input, sleep));
        }
        for block in woken {
            sleep.keep_awake(block);
        }
    }

    /// Pairs of particles that have touched since they were found; of a link, the nearer node.
    pub(crate) fn touched(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let discs = self.contacts.iter().filter(|contact| contact.touched).map(|contact| (contact.i, contact.j));
        discs.chain(self.ring_contacts.iter().filter_map(|(contact, _)| Some((contact.particle, contact.touched?))))
    }

    /// Sorts the colliding particles into bodies, membranes and fluid.
    fn sort(&mut self, input: SearchInput<'_>, sleep: &Sleep) {
        let SearchInput { particles: p, blocks, size, period, limits, dispatch, .. } = input;
        let Self { bodies, membranes, fluid, margins, .. } = self;
        membranes.found.clear();
        fluid.found.clear();
        bodies.collect(blocks, p, sleep, limits, margins, dispatch);
        let (columns, in_fluid, next_in_ring) = (DiscColumns::of(p), &p.fluid[..p.len()], &p.next_in_ring[..p.len()]);
        for range in outside_of(blocks.iter().copied(), p.len()) {
            for i in range {
                let Some(disc) = columns.disc(i, limits.step) else { continue };
                match (in_fluid[i], next_in_ring[i]) {
                    (0, NO_OWNER) => bodies.add_single(disc, p.owner[i]),
                    (0, _) => membranes.found.push(disc),
                    _ => fluid.found.push(disc),
                }
            }
        }
        let bodies_and_membranes = || {
            bodies.sort(size);
            membranes.sort(size);
        };
        parallel::join(bodies_and_membranes, || fluid.sort(size));
        self.images = (!period.is_none()).then(|| self.images_in(period));
    }

    #[cold]
    fn images_in(&self, period: Period) -> Images {
        let fluid = self.fluid.iter().fold(SearchBox::EMPTY, |all, disc| all.union(disc.aabb()));
        Images { period, bounds: self.bodies.bounds().union(fluid) }
    }

    /// Blocks of sleepers of which an image is near fluid or an obstacle that moves.
    #[cold]
    #[inline(never)]
    fn woken_by_images(&self, images: &Images, input: SearchInput<'_>, sleep: &Sleep) -> Vec<u32> {
        let Self { bodies, fluid, .. } = self;
        let is_in_fluid = |body: &&BodyProxy| {
            let places = images.of(body.aabb).map(|shift| body.aabb.moved(shift));
            !fluid.is_empty()
                && places.into_iter().any(|place| fluid.in_box(place.low(), place.high()).next().is_some())
        };
        let wet = bodies.sleepers(sleep).filter(is_in_fluid).map(|body| body.block);
        let boxes = input.paths.iter().map(|path| path.aabb(&input.obstacles[path.obstacle as usize]));
        let places = boxes.map(|aabb| SearchBox::new(aabb.mins, aabb.maxs));
        let places = places.flat_map(|aabb| images.of(aabb).map(move |shift| aabb.moved(shift)));
        let pushed = places.flat_map(|place| bodies.in_box(place.low(), place.high()));
        wet.chain(pushed.map(|body| body.block).filter(|block| sleep.is_asleep(*block))).collect()
    }

    fn find_obstacle_contacts(&mut self, input: SearchInput<'_>, sleep: &Sleep) {
        self.obstacle_contacts.clear();
        self.sensor_contacts.clear();
        let SearchInput { obstacles, paths, .. } = input;
        for path in paths {
            self.find_contacts_of(path.obstacle, path.aabb(&obstacles[path.obstacle as usize]), input, sleep);
        }
        let moves = |k: u32| paths.binary_search_by_key(&k, |path| path.obstacle).is_ok();
        for (obstacle, k) in obstacles.iter().zip(0..).filter(|(obstacle, k)| obstacle.is_enabled && !moves(*k)) {
            self.find_contacts_of(k, obstacle.aabb(), input, sleep);
        }
    }

    /// Finds the discs that may touch an obstacle in this box, or an image of it.
    fn find_contacts_of(&mut self, obstacle: u32, aabb: Aabb, input: SearchInput<'_>, sleep: &Sleep) {
        self.find_contacts_at(Vec2::ZERO, obstacle, aabb, input, sleep);
        if let Some(images) = self.images.filter(|_| obstacle as usize >= input.walls) {
            for shift in images.of(SearchBox::new(aabb.mins, aabb.maxs)) {
                let place = Aabb { mins: aabb.mins + shift, maxs: aabb.maxs + shift };
                self.find_contacts_at(shift, obstacle, place, input, sleep);
            }
        }
    }

    /// Finds those that may touch an image of it that is in this box.
    fn find_contacts_at(&mut self, shift: Vec2, obstacle: u32, aabb: Aabb, input: SearchInput<'_>, sleep: &Sleep) {
        let Self { obstacle_contacts, sensor_contacts, bodies, membranes, fluid, .. } = self;
        let (low, high) = (aabb.mins, aabb.maxs);
        let Obstacle { groups, is_sensor, .. } = input.obstacles[obstacle as usize];
        let is_near = |disc: &Disc| {
            let (p, i) = (input.particles, disc.index as usize);
            let is_inside = aabb.loosened(disc.swept_radius).contains_local_point(disc.at);
            is_inside && p.inv_mass[i] > 0.0 && p.groups[i].meets(groups)
        };
        let awake = bodies.in_box(low, high).filter(|body| !sleep.is_asleep(body.block));
        let of_bodies = awake.flat_map(|body| bodies.discs_of(body));
        let of_grids = [&*membranes, &*fluid].into_iter().flat_map(|grid| grid.in_box(low, high).copied());
        let near = of_bodies.chain(of_grids).filter(is_near);
        let contacts = if is_sensor { sensor_contacts } else { obstacle_contacts };
        contacts.extend(near.map(|disc| ObstacleContact { particle: disc.index, obstacle, shift }));
    }
}

/// Finds the contacts of discs.
fn find_contacts(
    contacts: &mut Contacts,
    bodies: &Bodies,
    [membranes, fluid]: [&DiscGrid; 2],
    fluid_changes: &mut FluidChanges,
    images: Option<Images>,
    filter: PairFilter<'_>,
    input: SearchInput<'_>,
) {
    contacts.clear();
    let Contacts { strips, others } = contacts;
    bodies.pairs(filter, strips, others);
    let mut consider = |a: &Disc, b: &Disc| others.extend(contact(a, b, input));
    membranes.pairs(&mut consider);
    if !fluid.is_empty() {
        bodies.pairs_with(fluid, &mut consider);
    }
    if input.rings.is_empty() {
        bodies.pairs_with(membranes, &mut consider);
        for node in membranes.iter() {
            fluid.near(node).for_each(|other| consider(node, other));
        }
    }
    if fluid_changes.find(fluid, input.particles) {
        fluid_changes.pairs(fluid, consider);
    }
    if let Some(images) = images {
        bodies.pairs_across(&images, filter, others);
        fluid_across(bodies, fluid, &images, input, others);
    }
}

/// Finds the contacts of discs with links of rings.
fn find_ring_contacts(
    ring_contacts: &mut Shared<RingContacts>,
    bodies: &Bodies,
    disc_grids: [&DiscGrid; 2],
    input: SearchInput<'_>,
) {
    let SearchInput { particles, exemptions, containments, rings, limits, dispatch, .. } = input;
    ring_contacts.get_mut_or(|_| RingContacts::default()).find(
        rings,
        RingQuery { particles, exemptions, containments, bodies, disc_grids, margin: 2.0 * limits.step, dispatch },
    );
}

/// Adds the contacts of fluid with images of bodies, and of other fluid.
#[cold]
#[inline(never)]
fn fluid_across(bodies: &Bodies, fluid: &DiscGrid, images: &Images, input: SearchInput<'_>, found: &mut Vec<Contact>) {
    if fluid.is_empty() {
        return;
    }
    let mut consider = |image: &Disc, other: &Disc, shift: Vec2| {
        found.extend(contact(image, other, input).map(|contact| contact.with_image(shift)));
    };
    bodies.pairs_across_with(images, fluid, &mut consider);
    for disc in fluid.iter() {
        for shift in images.ahead(disc.aabb()) {
            let image = disc.moved(shift);
            fluid.near(&image).for_each(|other| consider(&image, other, shift));
        }
    }
}

/// The contact of two discs that are near each other, if they collide at all.
fn contact(a: &Disc, b: &Disc, input: SearchInput<'_>) -> Option<Contact> {
    let (p, i, j) = (input.particles, a.index as usize, b.index as usize);
    let is_for_rings = !input.rings.is_empty() && is_for_rings(p, i, j);
    let mobility = match [i, j].map(|i| p.next_in_ring[i] != NO_OWNER) {
        [true, true] => [Mobility::Linked; 2],
        [true, false] => [Mobility::Linked, Mobility::Bounded],
        [false, true] => [Mobility::Bounded, Mobility::Linked],
        [false, false] => [Mobility::Single; 2],
    };
    (!is_for_rings && may_collide(p, i, j, input.exemptions))
        .then(|| Contact::new(p, i, j, mobility, input.limits.substep))
}

/// Whether two particles meet as a disc and a link: one is a ring's node and the other is not of that ring.
fn is_for_rings(p: &Particles, a: usize, b: usize) -> bool {
    let in_ring = [a, b].map(|i| p.next_in_ring[i] != NO_OWNER);
    in_ring != [false; 2] && (in_ring != [true; 2] || p.owner[a] != p.owner[b])
}

fn may_collide(p: &Particles, a: usize, b: usize, exemptions: &Exemptions) -> bool {
    if p.inv_mass[a] + p.inv_mass[b] <= 0.0 || !p.groups[a].meets(p.groups[b]) {
        return false;
    }
    if p.owner[a] == p.owner[b] {
        // Within one owner a membrane holds its cytoplasm and does not pass through itself; nothing else collides.
        let in_membrane = p.next_in_ring[a] != NO_OWNER && p.next_in_ring[b] != NO_OWNER;
        return p.fluid[a] != p.fluid[b] || (in_membrane && !p.are_ring_neighbours(a, b));
    }
    if p.fluid[a] == p.fluid[b] && p.fluid[a] != 0 {
        return false; // A fluid keeps its particles apart by itself.
    }
    let owners = [p.owner[a], p.owner[b]];
    !exemptions.contains(owners[0], owners[1]) && !exemptions.gate_is_open([a as u32, b as u32], owners)
}

#[cfg(test)]
mod tests;
