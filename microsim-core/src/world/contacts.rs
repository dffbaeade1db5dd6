//! Contacts: the search for pairs, the pairs that it found, and one begin and one end event per pair of organisms.

use super::World;
use super::obstacle::WALLS;
use crate::collision::broad_phase::SearchInput;
use crate::collision::ring::{FoundLink, Link, Ring, RingContact};
use crate::collision::speculative_margin::DisplacementLimits;
use crate::collision::{Contact, Mobility};
use crate::event::Event;
use crate::geometry::period::Period;
use crate::id::OrganismId;
use crate::organism::table::Organisms;
use crate::particle::{BlockRange, Particles};
use crate::solver::block::Block;
use crate::solver::contact::is_heavy;
use crate::solver::ring_contact;
use serde::{Deserialize, Serialize};

/// Pairs of organisms that touched in the last step, sorted.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Touching {
    pairs: Vec<(OrganismId, OrganismId)>,
    #[serde(skip)]
    now: Vec<(OrganismId, OrganismId)>,
}

/// What the last step's search found near each other, before anything is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Near {
    Discs {
        i: u32,
        j: u32,
        touched: bool,
    },
    /// A disc, a link of a membrane, and the node that the disc touched last.
    DiscAndLink {
        i: u32,
        link: Link,
        touched: Option<u32>,
    },
}

/// Two particles whose surfaces may have touched in the last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearPair {
    pub i: u32,
    /// The other disc; for a link of a membrane its nearer node. Each link is a pair of its own.
    pub j: u32,
    /// Present distance of the surfaces, negative where they overlap.
    pub gap: f32,
    pub touched: bool,
}

/// Bounds the mass of heavy discs that a drive moves against linked ones.
pub(crate) fn bound_driven_discs<'a>(
    contacts: impl Iterator<Item = &'a mut Contact>,
    particles: &Particles,
    organisms: &Organisms,
) {
    let is_driven = |disc: u32| {
        let id = organisms.id_at(particles.owner[disc as usize]);
        id.and_then(|id| organisms.get(id)).is_some_and(|organism| organism.goal.is_some())
    };
    for contact in contacts {
        let (disc, on) = match contact.mobility {
            [Mobility::Single, Mobility::Linked] => (0, 1),
            [Mobility::Linked, Mobility::Single] => (1, 0),
            _ => continue,
        };
        let sides = [contact.i, contact.j];
        let inv_mass = sides.map(|i| particles.inv_mass[i as usize]);
        if is_heavy(inv_mass[disc], inv_mass[on]) && is_driven(sides[disc]) {
            contact.mobility[disc] = Mobility::Bounded;
        }
    }
}

/// The links near a disc, one pair each.
fn near_links<'a>(contact: &RingContact, links: &'a [FoundLink]) -> impl Iterator<Item = Near> + Clone + use<'a> {
    let RingContact { particle: i, touched, .. } = *contact;
    links.iter().map(move |found| Near::DiscAndLink { i, link: found.link, touched })
}

impl World {
    /// Finds the pairs of bodies and discs that can touch before the next search, and which blocks are asleep.
    pub(crate) fn find_pairs(&mut self) {
        self.particles.begin_search();
        let Self { config, particles, blocks, sleep, organisms, obstacles, exemptions, scratch, dispatch, .. } = self;
        let (step, substep) = (config.max_displacement(), config.max_substep_displacement());
        let (size, limits) = (config.size, DisplacementLimits { step, substep, dt: config.dt });
        let rings: Vec<Ring<'_>> = if config.protects_membranes { organisms.rings().collect() } else { Vec::new() };
        let (rings, containments) = (rings.as_slice(), &organisms.containments());
        let blocks: &[BlockRange] = &blocks.iter().map(Block::range).collect::<Vec<_>>();
        let paths = &scratch.obstacle_paths;
        let input = SearchInput {
            particles,
            blocks,
            obstacles,
            paths,
            exemptions,
            rings,
            containments,
            size,
            period: Period(config.period_lengths()),
            walls: WALLS,
            limits,
            dispatch: *dispatch,
        };
        scratch.broad_phase.find_pairs(input, sleep, config.steps_to_sleep());
        let contacts = scratch.broad_phase.contacts.lists_mut().flatten();
        bound_driven_discs(contacts, particles, organisms);
    }

    /// All pairs of live particles that the last step's search found.
    pub(crate) fn near_pairs(&self) -> impl Iterator<Item = NearPair> + '_ {
        self.near().filter_map(|near| self.near_pair(near))
    }

    /// All that the last step's search found, not measured.
    pub(crate) fn near(&self) -> impl Iterator<Item = Near> + '_ {
        let found = &self.scratch.broad_phase;
        let discs = found.contacts.iter().map(Near::discs);
        discs.chain(found.ring_contacts.iter().flat_map(|(contact, links)| near_links(contact, links)))
    }

    /// The same of different owners only, who are looked up once for all links near a disc.
    pub(crate) fn near_of_others(&self) -> impl Iterator<Item = ([u32; 2], Near)> + '_ {
        let found = &self.scratch.broad_phase;
        let others = |near: Near| Some(near.owners(&self.particles)).filter(|[a, b]| a != b);
        let discs = found.contacts.iter().map(Near::discs).filter_map(move |near| Some((others(near)?, near)));
        let near_rings = found.ring_contacts.iter().map(|(contact, links)| near_links(contact, links));
        let of_others = near_rings.filter_map(move |near| Some((others(near.clone().next()?)?, near)));
        let links = of_others.flat_map(|(owners, near)| near.map(move |near| (owners, near)));
        discs.chain(links)
    }

    /// Measures what was found, if both particles are still those that were found.
    pub(crate) fn near_pair(&self, near: Near) -> Option<NearPair> {
        let p = &self.particles;
        let pair = match near {
            Near::Discs { i, j, touched } => {
                let (a, b) = (i as usize, j as usize);
                let way = self.period().nearest(p.between(a, b));
                NearPair { i, j, gap: way.length() - p.radius[a] - p.radius[b], touched }
            }
            Near::DiscAndLink { i, link, touched } => {
                let (j, gap) = ring_contact::gap(i, link, p);
                NearPair { i, j, gap, touched: touched == Some(j) }
            }
        };
        [pair.i, pair.j].map(|i| i as usize).into_iter().all(|i| p.is_live(i) && !p.is_new(i)).then_some(pair)
    }
}

impl Near {
    fn discs(&Contact { i, j, touched, .. }: &Contact) -> Self {
        Self::Discs { i, j, touched }
    }

    /// Owners of the two.
    pub(crate) fn owners(self, p: &Particles) -> [u32; 2] {
        let (Self::Discs { i, j, .. } | Self::DiscAndLink { i, link: Link { a: j, .. }, .. }) = self;
        [i, j].map(|particle| p.owner[particle as usize])
    }
}

impl Touching {
    /// The pairs.
    pub(crate) fn pairs(&self) -> &[(OrganismId, OrganismId)] {
        &self.pairs
    }

    /// Compares the pairs that touched in this step with those of the last step and reports the differences. Pairs of
    /// sleeping organisms keep touching.
    pub(crate) fn update(
        &mut self,
        touched: impl Iterator<Item = (u32, u32)>,
        is_asleep: impl Fn(OrganismId) -> bool,
        particles: &Particles,
        organisms: &Organisms,
        events: &mut Vec<Event>,
    ) {
        self.now.clear();
        // Contacts of two bodies lie side by side.
        let mut last = (0, 0);
        for (i, j) in touched {
            let (a, b) = (particles.owner[i as usize], particles.owner[j as usize]);
            if a != b && (a, b) != last {
                last = (a, b);
                let ids = (organisms.id_at(a.min(b)), organisms.id_at(a.max(b)));
                self.now.extend(ids.0.zip(ids.1));
            }
        }
        self.now.extend(self.pairs.iter().filter(|(a, b)| is_asleep(*a) && is_asleep(*b)));
        self.now.sort_unstable();
        self.now.dedup();
        events.extend(missing(&self.pairs, &self.now).map(|(a, b)| Event::ContactEnded { a, b }));
        events.extend(missing(&self.now, &self.pairs).map(|(a, b)| Event::ContactBegan { a, b }));
        std::mem::swap(&mut self.pairs, &mut self.now);
    }
}

/// What is in a sorted list and not in another one.
fn missing<'a, T: Copy + Ord>(from: &'a [T], others: &'a [T]) -> impl Iterator<Item = T> + 'a {
    let mut others = others.iter().peekable();
    from.iter().copied().filter(move |one| {
        while others.next_if(|other| *other < one).is_some() {}
        others.peek() != Some(&one)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::testing::overlapping;
    use crate::{AgarSpec, CoccusSpec, Inputs, Placement, PlateletSpec, RedCellSpec, RigidCellSpec, WorldConfig};
    use glam::Vec2;
    use std::collections::BTreeSet;

    /// Rows of small discs at rest, platelets behind them and a cell before them, with gaps that only something fast closes
    /// in a step.
    fn rows(substeps: u32) -> (World, OrganismId) {
        let mut world = World::new(WorldConfig { sleeps: false, substeps, ..WorldConfig::default() }).unwrap();
        for k in 0..200 {
            let at = Vec2::new(46.0 + 2.2 * (k % 20) as f32, 34.0 + 2.15 * (k / 20) as f32);
            world.spawn(&AgarSpec::default().into(), Placement::at(at.x, at.y)).unwrap();
        }
        for y in [35.0, 40.0, 45.5, 51.0] {
            world.spawn(&PlateletSpec::default().into(), Placement::at(95.0, y)).unwrap();
        }
        let cell = world.spawn(&RigidCellSpec::default().into(), Placement::at(30.0, 46.0)).unwrap();
        (world, cell)
    }

    #[test]
    fn every_overlap_after_a_step_is_a_known_pair() {
        for substeps in [1, 3, 8] {
            let (mut world, cell) = rows(substeps);
            let mut overlaps = 0;
            for step in 0..240 {
                // The cell is thrown into others that rest, and throws them on within the step.
                let at = world.centroid(cell).unwrap();
                let speed = 20.0 * if step / 60 % 2 == 0 { 1.0 } else { -1.0 };
                world.push(cell, Vec2::new(speed, 0.2 * (45.0 - at.y))).unwrap();
                world.step(&Inputs::new());
                let known = world.near_pairs().map(|pair| (pair.i.min(pair.j), pair.i.max(pair.j)));
                let known: BTreeSet<_> = known.collect();
                assert_eq!(known.len(), world.near_pairs().count(), "a pair was found twice");
                for pair in overlapping(&world.particles) {
                    overlaps += 1;
                    assert!(known.contains(&pair), "{substeps} substeps, step {step}: {pair:?}");
                }
            }
            assert!(overlaps > 100, "{overlaps}");
        }
    }

    #[test]
    fn what_is_missing_from_a_sorted_list_is_found() {
        let lists: [&[i32]; 5] = [&[], &[1], &[2, 5, 7], &[1, 2, 3, 5, 8], &[0, 9]];
        for (from, others) in lists.into_iter().flat_map(|from| lists.map(|others| (from, others))) {
            let expected: Vec<i32> = from.iter().copied().filter(|one| !others.contains(one)).collect();
            assert_eq!(missing(from, others).collect::<Vec<_>>(), expected, "{from:?} without {others:?}");
        }
    }

    #[test]
    fn who_touches_one_wakes_and_nobody_else() {
        let mut world = World::new(WorldConfig { gravity: Vec2::ZERO, ..WorldConfig::default() }).unwrap();
        // Of different templates: bodies of one sleep together.
        let specs = [
            AgarSpec::default().into(),
            CoccusSpec::default().into(),
            PlateletSpec::default().into(),
            RedCellSpec::default().into(),
        ];
        let spawn = |(k, spec): (u8, &crate::OrganismSpec)| {
            world.spawn(spec, Placement::at(30.0 + 25.0 * f32::from(k), 45.0)).unwrap()
        };
        let all: Vec<OrganismId> = (0..).zip(&specs).map(spawn).collect();
        let is_at_rest = |world: &World, id| world.view().organism(id).unwrap().is_at_rest();
        for (touched, other) in [(0, 1), (1, 0)] {
            (0..180).for_each(|_| world.step(&Inputs::new()));
            assert!(all.iter().all(|&id| is_at_rest(&world, id)));
            world.touching.pairs = vec![(all[0], all[1]), (all[2], all[3])];
            world.wake_up_touching(all[touched]);
            let rests: Vec<bool> = all.iter().map(|&id| is_at_rest(&world, id)).collect();
            assert!(!rests[other] && rests[2] && rests[3], "{rests:?}");
        }
    }
}
