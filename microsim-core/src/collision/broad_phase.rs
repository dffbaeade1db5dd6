//! Broad phase, once per step: pairs that may touch before the next one; of bodies that exceed their margin, once more.
//!
//! The speed limit bounds the displacement `d` of a step, so only pairs within `r_i + r_j + 2 d` can touch. Soft bodies and
//! single discs are searched by their boxes first ([`bodies`]), membranes and fluid disc by disc ([`disc_grid`]). Between two
//! soft bodies the margin is smaller at first ([`speculative_margin`]).
//!
//! [`bodies`]: super::bodies
//! [`disc_grid`]: super::disc_grid
//! [`speculative_margin`]: super::speculative_margin

use super::bodies::{Bodies, BodyProxy, PairFilter};
use super::disc_grid::{Disc, DiscColumns, DiscGrid, FluidChanges};
use super::exemptions::Exemptions;
use super::obstacle::Obstacle;
use super::obstacle_path::ObstaclePath;
use super::ring::{Containment, Ring, RingContacts, RingQuery};
use super::speculative_margin::{DisplacementLimits, SpeculativeMargins};
use super::{Contact, Contacts, Mobility, ObstacleContact};
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
        self.bodies.make_discs(input.blocks, input.particles, sleep);
        let Self { contacts, bodies, membranes, fluid, fluid_changes, .. } = self;
        let contacts = contacts.get_mut_or(Contacts::blank);
        contacts.clear();
        let Contacts { strips, others } = contacts;
        let SearchInput { particles, exemptions, limits, .. } = input;
        let filter = PairFilter { particles, exemptions, sleep, longest: limits.substep };
        bodies.pairs(filter, strips, others);
        let mut consider = |a: &Disc, b: &Disc| others.extend(contact(a, b, input));
        membranes.pairs(&mut consider);
        if !fluid.is_empty() {
            bodies.pairs_with(fluid, input.particles, &mut consider);
        }
        if input.rings.is_empty() {
            bodies.pairs_with(membranes, input.particles, &mut consider);
            for node in membranes.iter() {
                fluid.near(node).for_each(|other| consider(node, other));
            }
        }
        if fluid_changes.find(fluid, input.particles) {
            fluid_changes.pairs(fluid, input.particles, consider);
        }
        self.find_obstacle_contacts(input, sleep);
        self.find_ring_contacts(input);
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
        let Self { contacts, bodies, margins, .. } = self;
        let known = contacts.others.len();
        if margins.any_below(next) {
            let filter = PairFilter { particles, exemptions, sleep, longest: next };
            bodies.late_pairs(filter, margins, next, &mut contacts.others);
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
        for block in woken {
            sleep.keep_awake(block);
        }
    }

    fn find_ring_contacts(&mut self, input: SearchInput<'_>) {
        let Self { ring_contacts, bodies, membranes, fluid, .. } = self;
        let SearchInput { particles, exemptions, containments, rings, limits, dispatch, .. } = input;
        let disc_grids = [&*membranes, &*fluid];
        ring_contacts.get_mut_or(|_| RingContacts::default()).find(
            rings,
            RingQuery { particles, exemptions, containments, bodies, disc_grids, margin: 2.0 * limits.step, dispatch },
        );
    }

    /// Pairs of particles that have touched since they were found; of a link, the nearer node.
    pub(crate) fn touched(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let discs = self.contacts.iter().filter(|contact| contact.touched).map(|contact| (contact.i, contact.j));
        let links = self.ring_contacts.contacts.iter();
        discs.chain(links.filter_map(|contact| Some((contact.particle, contact.touched?))))
    }

    /// Sorts the colliding particles into bodies, membranes and fluid.
    fn sort(&mut self, input: SearchInput<'_>, sleep: &Sleep) {
        let SearchInput { particles: p, blocks, size, limits, dispatch, .. } = input;
        let Self { bodies, membranes, fluid, margins, .. } = self;
        membranes.found.clear();
        fluid.found.clear();
        bodies.collect(blocks, p, sleep, limits, margins, dispatch);
        let columns = DiscColumns::of(p);
        let loose = outside_of(blocks.iter().copied(), p.len()).flatten();
        for (i, disc) in loose.filter_map(|i| columns.disc(i, limits.step).map(|disc| (i, disc))) {
            match (p.fluid[i], p.next_in_ring[i]) {
                (0, NO_OWNER) => bodies.add_single(disc, p.owner[i]),
                (0, _) => membranes.found.push(disc),
                _ => fluid.found.push(disc),
            }
        }
        parallel::serial(p.len(), || {
            bodies.sort(size);
            membranes.sort(size);
            fluid.sort(size);
        });
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

    /// Finds the discs that may touch an obstacle in this box.
    fn find_contacts_of(&mut self, obstacle: u32, aabb: Aabb, input: SearchInput<'_>, sleep: &Sleep) {
        let Self { obstacle_contacts, sensor_contacts, bodies, membranes, fluid, .. } = self;
        let (low, high) = (aabb.mins, aabb.maxs);
        let Obstacle { groups, is_sensor, .. } = input.obstacles[obstacle as usize];
        let is_near = |disc: &Disc| {
            let (p, i) = (input.particles, disc.index as usize);
            let is_inside = aabb.loosened(disc.swept_radius).contains_local_point(disc.at);
            is_inside && p.inv_mass[i] > 0.0 && p.groups[i].meets(groups)
        };
        let awake = bodies.in_box(low, high).filter(|body| !sleep.is_asleep(body.block));
        let of_bodies = awake.flat_map(|body| bodies.discs_of(body, input.particles));
        let of_grids = [&*membranes, &*fluid].into_iter().flat_map(|grid| grid.in_box(low, high).copied());
        let near = of_bodies.chain(of_grids).filter(is_near);
        let contacts = if is_sensor { sensor_contacts } else { obstacle_contacts };
        contacts.extend(near.map(|disc| ObstacleContact { particle: disc.index, obstacle }));
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
mod tests {
    use super::*;
    use crate::particle::{CollisionGroups, LANES, Particle};
    use crate::rng::Rng;
    use crate::solver::block::subtract_displacement;
    use crate::solver::testing::{disc, overlapping, search_input};
    use std::collections::BTreeSet;

    #[test]
    fn nodes_of_a_membrane_collide_unless_a_link_joins_them() {
        let mut p = Particles::default();
        let ring: Vec<u32> = (0..6).map(|k| p.insert(&disc(Vec2::new(k as f32, 0.0), 1.0))).collect();
        p.link_ring(&ring);
        let collides = |a: usize, b: usize| may_collide(&p, a, b, &Exemptions::default());
        assert!(!collides(0, 1) && !collides(1, 0) && !collides(5, 0));
        assert!(collides(0, 2) && collides(2, 0) && collides(4, 0) && collides(0, 3));
    }

    fn random_discs(seed: u64, count: u32) -> Particles {
        let mut rng = Rng::new(seed, 1);
        let mut particles = Particles::default();
        for owner in 0..count {
            let position = Vec2::new(rng.range(0.0, 40.0), rng.range(0.0, 30.0));
            let mut particle = disc(position, 1.0);
            particle.radius = if owner % 13 == 0 { rng.range(2.0, 4.0) } else { rng.range(0.2, 0.5) };
            particle.owner = owner / 3;
            particle.fluid = u32::from(owner % 5 == 0) + u32::from(owner % 10 == 0);
            particles.insert(&particle);
        }
        let ring: Vec<u32> = (0..count).filter(|&i| i % 7 == 0 && particles.fluid[i as usize] == 0).collect();
        particles.link_ring(&ring);
        particles
    }

    fn found(particles: &Particles, exemptions: &Exemptions) -> Vec<(u32, u32)> {
        let mut broad = BroadPhase::default();
        let limits = DisplacementLimits { step: 0.1, substep: 0.1, dt: 0.01 };
        broad.find_pairs(search_input(particles, exemptions, limits), &mut Sleep::default(), 1);
        pairs_of(&broad).into_iter().collect()
    }

    #[test]
    fn finds_exactly_the_pairs_that_brute_force_finds() {
        for seed in 0..5 {
            let particles = random_discs(seed, 400);
            let mut exemptions = Exemptions::default();
            exemptions.set(0, 1, true);
            let mut expected = Vec::new();
            for i in 0..particles.len() {
                for j in i + 1..particles.len() {
                    let gap = (particles.position(i) - particles.position(j)).length();
                    let is_near = gap < particles.radius[i] + particles.radius[j] + 0.2;
                    if is_near && may_collide(&particles, i, j, &exemptions) {
                        expected.push((i as u32, j as u32));
                    }
                }
            }
            assert_eq!(found(&particles, &exemptions), expected, "seed {seed}");
            assert!(!expected.is_empty());
        }
    }

    const LIMITS: DisplacementLimits = DisplacementLimits { step: 0.8, substep: 0.1, dt: 0.02 };

    /// Bodies of four discs in blocks, somewhere, some of them fast, those of the first block large.
    fn random_blocks(rng: &mut Rng, count: u32) -> (Particles, Vec<BlockRange>) {
        let mut p = Particles::default();
        let ranges: Vec<_> = (0..count).map(|_| BlockRange { base: p.extend(4 * LANES) as usize, slots: 4 }).collect();
        for (block, k) in ranges.iter().zip(0..) {
            for lane in 0..LANES {
                let at = Vec2::new(rng.range(0.0, 20.0), rng.range(0.0, 15.0));
                let velocity = Vec2::new(0.0, rng.range(-9.0, 9.0).max(0.0));
                let size = if k == 0 { 4.0 } else { 1.0 };
                for slot in 0..4 {
                    let place = at + Vec2::new(0.5 * size * slot as f32, rng.range(-0.2, 0.2));
                    let owner = 8 * k + lane as u32;
                    let particle = Particle { owner, radius: 0.3 * size, velocity, ..disc(place, 1.0) };
                    p.set(block.entry(slot, lane), &particle);
                }
            }
        }
        (p, ranges)
    }

    /// Moves half of the bodies as far as they can in a substep, the others a little, to either side, and notes how far.
    fn move_all(p: &mut Particles, blocks: &[BlockRange], broad: &mut BroadPhase, rng: &mut Rng) {
        for (block, left) in blocks.iter().zip(broad.margins.blocks_mut()) {
            for lane in 0..LANES {
                let way = if lane < 4 { LIMITS.substep } else { rng.range(0.0, 0.03) };
                let way = if lane % 2 == 0 { way } else { -way };
                for i in (0..4).map(|slot| block.entry(slot, lane)) {
                    (p.prev_x[i], p.prev_y[i]) = (p.x[i], p.y[i]);
                    p.x[i] += way;
                }
            }
            subtract_displacement(&mut p.columns().part(block.base..block.end()), left);
        }
    }

    #[test]
    fn late_pairs_complete_the_pairs_of_bodies_that_exceed_their_margin() {
        let (mut widened, mut missed_at_first) = (0, 0);
        for seed in 0..20 {
            let mut rng = Rng::new(seed, 1);
            let (mut p, blocks) = random_blocks(&mut rng, 12);
            let (exemptions, sleep) = (Exemptions::default(), &mut Sleep::default());
            let mut broad = BroadPhase::default();
            let input = search_input(&p, &exemptions, LIMITS);
            broad.find_pairs(SearchInput { blocks: &blocks, size: Vec2::new(20.0, 15.0), ..input }, sleep, 1);
            let at_first = pairs_of(&broad);
            for substep in 0..8 {
                move_all(&mut p, &blocks, &mut broad, &mut rng);
                let known = pairs_of(&broad);
                assert_eq!(known.len(), broad.contacts.iter().count(), "a pair was found twice");
                for pair in overlapping(&p) {
                    missed_at_first += usize::from(!at_first.contains(&pair));
                    assert!(known.contains(&pair), "seed {seed}, substep {substep}: {pair:?}");
                }
                broad.find_late_pairs(&p, &exemptions, sleep, LIMITS.substep);
                widened += broad.contacts.iter().count() - known.len();
            }
        }
        assert!(widened > 100 && missed_at_first > 10, "{widened} {missed_at_first}");
    }

    fn pairs_of(broad: &BroadPhase) -> BTreeSet<(u32, u32)> {
        broad.contacts.iter().map(|c| (c.i.min(c.j), c.i.max(c.j))).collect()
    }

    #[test]
    fn owners_groups_and_exemptions_keep_pairs_apart() {
        let mut particles = Particles::default();
        for owner in [0, 0, 1] {
            particles.insert(&Particle { owner, ..disc(Vec2::new(5.0, 5.0), 1.0) });
        }
        let none = Exemptions::default();
        assert_eq!(found(&particles, &none), [(0, 2), (1, 2)]);
        let mut exempt = Exemptions::default();
        exempt.set(0, 1, true);
        assert_eq!(found(&particles, &exempt), []);
        let groups = [(1, 2), (4, 2), (2, 1)];
        *particles.groups = groups.map(|(memberships, filter)| CollisionGroups { memberships, filter }).to_vec();
        assert_eq!(found(&particles, &none), [(0, 2)]);
    }
}
