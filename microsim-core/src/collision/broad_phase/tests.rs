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
    let within = p.insert(&disc(Vec2::new(2.0, 1.0), 1.0)) as usize;
    let collides = |a: usize, b: usize| may_collide(&p, a, b, &Exemptions::default());
    assert!(!collides(0, 1) && !collides(1, 0) && !collides(5, 0));
    assert!(collides(0, 2) && collides(2, 0) && collides(4, 0) && collides(0, 3));
    assert!(!collides(0, within) && !collides(within, 0), "no membrane and no fluid");
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

const ROOM: Vec2 = Vec2::new(20.0, 15.0);

/// A pair of discs and the displacement of the image of the first that is in contact with the second; the lower index comes first.
type PairOfImages = (u32, u32, [i32; 2]);

fn image_pair(i: u32, j: u32, shift: Vec2) -> PairOfImages {
    let shift = if i < j { shift } else { -shift };
    (i.min(j), i.max(j), (shift / ROOM).round().as_ivec2().to_array())
}

fn image_pairs(p: &Particles, broad: &BroadPhase) -> Vec<PairOfImages> {
    let shift = |c: &Contact| p.origin(c.j as usize) - p.origin(c.i as usize) - c.between_origins;
    let mut pairs: Vec<_> = broad.contacts.iter().map(|c| image_pair(c.i, c.j, shift(c))).collect();
    pairs.sort_unstable();
    pairs
}

/// Pairs of images of discs of different owners, no more than `gap` apart, by brute force.
fn near_images(p: &Particles, period: Period, gap: f32) -> Vec<PairOfImages> {
    let whole = [-1, 0, 1].into_iter().flat_map(|x| [-1, 0, 1].map(|y| Vec2::new(x as f32, y as f32) * period.0));
    let mut shifts: Vec<Vec2> = whole.collect();
    shifts.sort_by(|a, b| a.to_array().partial_cmp(&b.to_array()).unwrap());
    shifts.dedup();
    let mut found = Vec::new();
    let live: Vec<usize> = p.live().collect();
    for (k, &i) in live.iter().enumerate() {
        for &j in live[k + 1..].iter().filter(|&&j| may_collide(p, i, j, &Exemptions::default())) {
            let is_near = |shift: &Vec2| (p.between(i, j) - *shift).length() < p.radius[i] + p.radius[j] + gap;
            found.extend(shifts.iter().copied().filter(is_near).map(|shift| image_pair(i as u32, j as u32, shift)));
        }
    }
    found.sort_unstable();
    found
}

#[test]
fn finds_each_pair_of_images_once() {
    for (seed, period) in (0..6).zip([ROOM, Vec2::new(20.0, 0.0), Vec2::new(0.0, 15.0)].into_iter().cycle()) {
        let (mut rng, mut p) = (Rng::new(seed, 1), Particles::default());
        for owner in 0..200 {
            let position = Vec2::new(rng.range(0.0, ROOM.x), rng.range(0.0, ROOM.y));
            let radius = if owner % 13 == 0 { rng.range(1.0, 2.0) } else { rng.range(0.2, 0.5) };
            p.insert(&Particle { radius, owner: owner / 2, fluid: owner % 3, ..disc(position, 1.0) });
        }
        let exemptions = Exemptions::default();
        let limits = DisplacementLimits { step: 0.1, substep: 0.1, dt: 0.01 };
        let (mut broad, period) = (BroadPhase::default(), Period(period));
        let input = SearchInput { size: ROOM, period, ..search_input(&p, &exemptions, limits) };
        broad.find_pairs(input, &mut Sleep::default(), 1);
        let (found, expected) = (image_pairs(&p, &broad), near_images(&p, period, 0.2));
        assert_eq!(found, expected, "seed {seed}");
        assert!(expected.iter().filter(|(.., shift)| *shift != [0, 0]).count() > 5);
    }
}

#[test]
fn late_pairs_complete_those_of_images() {
    let (mut late, period) = (0, Period(ROOM));
    for seed in 0..20 {
        let mut rng = Rng::new(seed, 2);
        let (mut p, blocks) = random_blocks(&mut rng, 12);
        let (exemptions, sleep) = (Exemptions::default(), &mut Sleep::default());
        let mut broad = BroadPhase::default();
        let input = search_input(&p, &exemptions, LIMITS);
        broad.find_pairs(SearchInput { blocks: &blocks, size: ROOM, period, ..input }, sleep, 1);
        for substep in 0..8 {
            move_all(&mut p, &blocks, &mut broad, &mut rng);
            let known = image_pairs(&p, &broad);
            assert!(known.windows(2).all(|pair| pair[0] != pair[1]), "a pair was found twice");
            for pair in near_images(&p, period, 0.0) {
                assert!(known.binary_search(&pair).is_ok(), "seed {seed}, substep {substep}: {pair:?}");
            }
            let found = broad.find_late_pairs(&p, &exemptions, sleep, LIMITS.substep);
            late += found.iter().filter(|c| c.between_origins != Vec2::ZERO).count();
        }
    }
    assert!(late > 50, "{late}");
}

/// Blocks of one disc each, in the first lane.
fn single_discs<const N: usize>(p: &mut Particles, discs: [(f32, f32); N]) -> [BlockRange; N] {
    let mut owner = 0;
    discs.map(|(x, inv_mass)| {
        let block = BlockRange { base: p.extend(LANES) as usize, slots: 1 };
        p.set(block.base, &Particle { owner, ..disc(Vec2::new(x, 7.0), inv_mass) });
        owner += 1;
        block
    })
}

#[test]
fn bodies_meet_what_is_fixed_and_fixed_ones_do_not_meet() {
    let (mut p, mut broad, none) = (Particles::default(), BroadPhase::default(), Exemptions::default());
    let blocks = single_discs(&mut p, [(5.0, 0.0), (5.5, 0.0), (6.0, 1.0)]);
    let input = SearchInput { blocks: &blocks, ..search_input(&p, &none, LIMITS) };
    broad.find_pairs(input, &mut Sleep::default(), 1);
    let index = |k: usize| blocks[k].base as u32;
    assert_eq!(pairs_of(&broad), BTreeSet::from([(index(0), index(2)), (index(1), index(2))]));
}

#[test]
fn what_moves_near_an_image_of_a_sleeper_wakes_its_block_and_no_other() {
    for is_fluid in [false, true] {
        let (mut p, mut sleep, none) = (Particles::default(), Sleep::default(), Exemptions::default());
        let blocks = single_discs(&mut p, [(10.0, 1.0), (0.4, 1.0), (if is_fluid { 5.0 } else { 19.7 }, 1.0)]);
        if is_fluid {
            p.insert(&Particle { owner: 3, fluid: 1, ..disc(Vec2::new(19.7, 7.0), 1.0) });
        } else {
            p.vx[blocks[2].base] = 9.0;
        }
        (0..3).for_each(|block| sleep.wake_up(block, 0));
        sleep.fall_asleep(1);
        sleep.update_sleep_times(blocks.iter().copied(), &p, 1.0, 1);
        let input =
            SearchInput { blocks: &blocks, size: ROOM, period: Period(ROOM), ..search_input(&p, &none, LIMITS) };
        BroadPhase::default().find_pairs(input, &mut sleep, 1);
        assert_eq!([0, 1, 2].map(|block| sleep.is_asleep(block)), [true, false, is_fluid], "fluid: {is_fluid}");
    }
}

#[test]
fn every_second_strip_has_discs_of_its_own() {
    let mut particles = random_discs(3, 400);
    particles.fluid.fill(0);
    particles.next_in_ring.fill(NO_OWNER);
    let mut broad = BroadPhase::default();
    broad.find_pairs(search_input(&particles, &Exemptions::default(), LIMITS), &mut Sleep::default(), 1);
    let discs = |list: &mut [Contact]| list.iter().flat_map(|contact| [contact.i, contact.j]).collect::<BTreeSet<_>>();
    let mut strips: Vec<_> = broad.contacts.lists_mut().map(discs).collect();
    // The last list is that of large bodies.
    strips.pop();
    assert!(strips.windows(2).any(|pair| !pair[0].is_disjoint(&pair[1])), "no strip has to do with the next");
    for (k, strip) in strips.iter().enumerate() {
        assert!(strips[k + 1..].iter().skip(1).step_by(2).all(|other| strip.is_disjoint(other)), "strip {k}");
    }
}
