//! Ring surgery: nodes put into a membrane and taken out, one ring cut into two, two rings joined to one.
//!
//! ```text
//!      i --- i+1                i     i+1
//!                    swap       |      |          one ring becomes two, two rings become one: the same two links
//!    j+1 --- j                 j+1     j          either way
//! ```

use super::living::Organism;
use super::storage::Storage;
use crate::capability::Locomotion;
use crate::capability::crawl::Pseudopods;
use crate::particle::{Particle, Particles};
use crate::solver::membrane::links;
use glam::Vec2;
use std::ops::Range;

/// Nodes on both sides of one that is taken out which share its place.
const SHARING: usize = 5;
/// Fewest nodes of a ring.
pub(crate) const LEAST_NODES: usize = 5;

/// Two links that can be swapped: `first` to its follower and `second` to its follower become `first` to the follower of
/// `second` and `second` to the follower of `first`. Positions in one ring, or in two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Swap {
    pub first: usize,
    pub second: usize,
    /// Length of the longer one of the two new links.
    pub length: f32,
}

impl Swap {
    /// The swap with the shortest new links between positions of two rings (which may be the same one).
    pub(crate) fn shortest(
        rings: [&[Vec2]; 2],
        firsts: impl Iterator<Item = usize>,
        seconds: impl Iterator<Item = usize> + Clone,
    ) -> Option<Self> {
        let length = |i: usize, j: usize| {
            let [a, b] = rings;
            let there = (b[(j + 1) % b.len()] - a[i]).length();
            let back = (a[(i + 1) % a.len()] - b[j]).length();
            if there > back { there } else { back }
        };
        let mut best: Option<Self> = None;
        for first in firsts {
            for second in seconds.clone() {
                let length = length(first, second);
                if best.is_none_or(|best| length < best.length) {
                    best = Some(Self { first, second, length });
                }
            }
        }
        best
    }

    /// Cuts a ring in two: what is left, and the arc from the follower of `first` to `second`. Both keep the ring's sense.
    pub(crate) fn cut<T: Copy>(&self, ring: &[T]) -> (Vec<T>, Vec<T>) {
        let count = ring.len();
        let arc = |from: usize, to: usize| (0..(to + count - from) % count + 1).map(move |k| ring[(from + k) % count]);
        (arc((self.second + 1) % count, self.first).collect(), arc((self.first + 1) % count, self.second).collect())
    }

    /// Joins two rings to one.
    pub(crate) fn join<T: Copy>(&self, a: &[T], b: &[T]) -> Vec<T> {
        let into = |ring: &[T], last: usize| {
            let mut turned = ring.to_vec();
            turned.rotate_left((last + 1) % ring.len());
            turned
        };
        let mut ring = into(a, self.first);
        ring.extend(into(b, self.second));
        ring
    }
}

/// Gives an organism another outline: nodes are linked again and keep their activity, and its front stays a place in it.
pub(crate) fn set_outline(organism: &mut Organism, outline: Vec<u32>, p: &mut Particles) {
    p.link_ring(&outline);
    let is_in_it = |k: &u32| (*k as usize) < outline.len();
    match &mut organism.locomotion {
        Locomotion::Crawl { front_centre } => *front_centre = front_centre.filter(is_in_it),
        Locomotion::Protrude(pseudopods) => {
            carry_activity(pseudopods, &organism.outline, &outline);
            pseudopods.front_centre = pseudopods.front_centre.filter(is_in_it);
        }
        Locomotion::None | Locomotion::FrontPull { .. } | Locomotion::Tow { .. } | Locomotion::Propel { .. } => {}
    }
    organism.outline = outline;
}

/// Carries the activity of nodes over into another ring; new nodes are quiet.
fn carry_activity(pseudopods: &mut Pseudopods, before: &[u32], after: &[u32]) {
    let mut places: Vec<(u32, usize)> = before.iter().copied().zip(0..).collect();
    places.sort_unstable();
    let place = |node: &u32| places.binary_search_by_key(node, |&(known, _)| known).ok().map(|found| places[found].1);
    pseudopods.network.rearrange(&after.iter().map(place).collect::<Vec<_>>());
}

/// Puts a node into the longest link of a membrane.
pub(crate) fn insert_node(organism: &mut Organism, p: &mut Particles) {
    insert_node_in(organism, 0..organism.outline.len(), p);
}

/// Puts a node like its neighbours into the longest of the links that begin at these positions (counted on beyond the
/// ring's end). The link is replaced by two of the same rest length.
pub(crate) fn insert_node_in(organism: &mut Organism, places: Range<usize>, p: &mut Particles) {
    let (ring, count) = (&organism.outline, organism.outline.len());
    let link = |k: usize| (ring[k % count] as usize, ring[(k + 1) % count] as usize);
    let mut longest = (places.start, 0.0);
    for k in places {
        let (a, b) = link(k);
        let length = p.between(a, b).length_squared();
        longest = if length > longest.1 { (k, length) } else { longest };
    }
    let (a, b) = link(longest.0);
    let like = p.get(a);
    let node = p.insert(&Particle {
        offset: like.offset + p.between(a, b) * 0.5,
        velocity: (p.velocity(a) + p.velocity(b)) * 0.5,
        ..like
    });
    organism.outline.insert(longest.0 % count + 1, node);
    if let Some(pseudopods) = organism.locomotion.pseudopods_mut() {
        pseudopods.network.insert(longest.0 % count + 1);
    }
    if let Storage::Loose { particles, .. } = &mut organism.body {
        particles.push(node);
    }
    p.link_ring(&organism.outline);
}

/// Takes one node of the shortest link out of a membrane.
pub(crate) fn remove_node(organism: &mut Organism, p: &mut Particles) {
    let mut outline = organism.outline.clone();
    let removed = take_out(&mut outline, p);
    set_outline(organism, outline, p);
    free_nodes(organism, removed.as_slice(), p);
}

/// Takes a node of the shortest link out of a ring; the nodes around share the gap along the line that there was, so that
/// no link becomes much longer. A ring too short for that stays as it is.
pub(crate) fn take_out(ring: &mut Vec<u32>, p: &mut Particles) -> Option<u32> {
    let count = ring.len();
    let sharing = SHARING.min((count - 1) / 2);
    if count <= LEAST_NODES {
        return None;
    }
    let lengths = links(ring).map(|(a, b)| p.between(a as usize, b as usize).length_squared());
    let shortest = |best: (usize, f32), (k, length)| if length < best.1 { (k, length) } else { best };
    let (k, _) = lengths.enumerate().fold((0, f32::INFINITY), shortest);
    let around: Vec<u32> = (0..=2 * sharing).map(|step| ring[(k + count + step - sharing) % count]).collect();
    close_up(&around, p);
    let removed = ring.remove(k);
    p.link_ring(ring);
    Some(removed)
}

/// Takes nodes that are in no ring any more out of the world.
pub(crate) fn free_nodes(organism: &mut Organism, nodes: &[u32], p: &mut Particles) {
    if let Storage::Loose { particles, .. } = &mut organism.body {
        particles.retain(|node| !nodes.contains(node));
    }
    nodes.iter().for_each(|&node| p.remove(node));
}

/// Moves the nodes between the ends, the middle one excepted, to even distances along the line through all of them.
fn close_up(around: &[u32], p: &mut Particles) {
    let line: Vec<Vec2> = around.iter().map(|&i| p.between(around[0] as usize, i as usize)).collect();
    let length: f32 = line.windows(2).map(|pair| (pair[1] - pair[0]).length()).sum();
    let spacing = length / (around.len() - 2) as f32;
    let inner = around.iter().enumerate().filter(|&(k, _)| k != around.len() / 2);
    for (place, (k, &node)) in inner.enumerate() {
        if k != 0 && k + 1 != around.len() {
            let by = point_along(&line, spacing * place as f32) - line[k];
            let i = node as usize;
            (p.x[i], p.y[i]) = (p.x[i] + by.x, p.y[i] + by.y);
            (p.prev_x[i], p.prev_y[i]) = (p.prev_x[i] + by.x, p.prev_y[i] + by.y);
        }
    }
}

/// The point at this distance from the beginning of a line of segments.
fn point_along(line: &[Vec2], mut distance: f32) -> Vec2 {
    for pair in line.windows(2) {
        let way = pair[1] - pair[0];
        let length = way.length();
        if distance <= length && length > 0.0 {
            return pair[0] + way * (distance / length);
        }
        distance -= length;
    }
    line[line.len() - 1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn cutting_and_joining_again_gives_the_same_ring(count in 8usize..80, first in 0usize..80, arc in 1usize..78) {
            let ring: Vec<usize> = (0..count).collect();
            let first = first % count;
            let second = (first + 1 + arc % (count - 2)) % count;
            let swap = Swap { first, second, length: 0.0 };
            let (left, cut) = swap.cut(&ring);
            prop_assert_eq!(left.len() + cut.len(), count);
            let mut all: Vec<usize> = left.iter().chain(&cut).copied().collect();
            all.sort_unstable();
            prop_assert_eq!(&all, &ring);
            // Only the two swapped links are new.
            let follows = |ring: &[usize]| (0..ring.len()).filter(|&k| ring[(k + 1) % ring.len()] != (ring[k] + 1) % count).count();
            prop_assert_eq!(follows(&left) + follows(&cut), 2);
            let back = Swap { first: left.len() - 1, second: cut.len() - 1, length: 0.0 }.join(&left, &cut);
            prop_assert_eq!(follows(&back), 0);
        }

        #[test]
        fn the_shortest_swap_is_the_shortest(points in proptest::collection::vec((0.0f32..10.0, 0.0f32..10.0), 6..20)) {
            let ring: Vec<Vec2> = points.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
            let count = ring.len();
            let best = Swap::shortest([&ring, &ring], 0..3, 3..count).unwrap();
            for i in 0..3 {
                for j in 3..count {
                    let longer = (ring[(j + 1) % count] - ring[i]).length().max((ring[i + 1] - ring[j]).length());
                    prop_assert!(best.length <= longer);
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn nodes_go_in_and_out_and_the_ring_stays_a_ring(changes in proptest::collection::vec(any::<bool>(), 1..60)) {
            use crate::geometry::polygon::{is_simple, signed_area};
            use crate::{AmoeboidCellSpec, Placement, World, WorldConfig};
            let mut world = World::new(WorldConfig::default()).unwrap();
            let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
            let World { organisms, particles, .. } = &mut world;
            let organism = organisms.get_mut(cell).unwrap();
            for is_insertion in changes {
                let (nodes, live) = (organism.outline.len(), particles.live_count());
                if is_insertion {
                    insert_node(organism, particles);
                    prop_assert_eq!((organism.outline.len(), particles.live_count()), (nodes + 1, live + 1));
                } else {
                    remove_node(organism, particles);
                    let taken = usize::from(nodes > LEAST_NODES);
                    prop_assert_eq!((organism.outline.len(), particles.live_count()), (nodes - taken, live - taken));
                }
                let ring: Vec<Vec2> = organism.outline_particles().map(|i| particles.position(i as usize)).collect();
                prop_assert!(is_simple(&ring) && signed_area(&ring) > 0.0);
                for (a, b) in links(&organism.outline) {
                    prop_assert_eq!(particles.next_in_ring[a as usize], b);
                    prop_assert_eq!(particles.owner[a as usize], cell.index);
                }
                prop_assert_eq!(organism.particles().count(), particles.live_count());
            }
        }
    }

    #[test]
    fn a_node_is_taken_out_without_a_long_link() {
        use crate::{AmoeboidCellSpec, Inputs, Placement, World, WorldConfig};
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        (0..30).for_each(|_| world.step(&Inputs::new()));
        let World { organisms, particles, .. } = &mut world;
        let organism = organisms.get_mut(cell).unwrap();
        let (nodes, live) = (organism.outline.len(), particles.live_count());
        let area = |o: &Organism, p: &Particles| {
            crate::geometry::polygon::signed_area(
                &o.outline_particles().map(|i| p.position(i as usize)).collect::<Vec<_>>(),
            )
        };
        let before = area(organism, particles);
        remove_node(organism, particles);
        assert_eq!((organism.outline.len(), particles.live_count()), (nodes - 1, live - 1));
        assert!(area(organism, particles) > 0.99 * before, "the line stays where it is");
        let longest = links(&organism.outline).map(|(a, b)| particles.between(a as usize, b as usize).length());
        assert!(longest.fold(0.0, f32::max) < 1.15 * organism.body.membrane().unwrap().rest_length);
        for (a, b) in links(&organism.outline) {
            assert_eq!(particles.next_in_ring[a as usize], b);
        }
        assert_eq!(organism.particles().count(), particles.live_count());
    }
}
