//! Broad phase, once per step: pairs that may touch before the next one.
//!
//! Two grids, because discs differ in size by a factor of ten and more: small discs in a fine grid, large ones (nuclei,
//! interlayers, probes) in a coarse one, and large ones also look through the fine grid. Nothing moves farther in a step
//! than the speed limit allows, so pairs within `r_i + r_j + 2 reach` are all that can touch.

use super::filter::Exemptions;
use super::grid::Grid;
use super::obstacle::Obstacle;
use super::{Contact, ObstacleContact, combine};
use crate::particle::{NO_OWNER, Particles};
use glam::Vec2;
use parry2d::bounding_volume::BoundingVolume;

/// The pairs of this step, and the grids that found them.
#[derive(Clone, Debug, Default)]
pub(crate) struct BroadPhase {
    pub contacts: Vec<Contact>,
    pub obstacle_contacts: Vec<ObstacleContact>,
    fine: Grid,
    coarse: Grid,
    small: Vec<u32>,
    large: Vec<u32>,
}

/// What a pair search needs to know of the world.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub particles: &'a Particles,
    pub obstacles: &'a [Obstacle],
    pub exemptions: &'a Exemptions,
    /// Upper right corner of the room.
    pub size: Vec2,
    /// Farthest that a particle moves in one step.
    pub reach: f32,
}

impl BroadPhase {
    /// Finds the pairs of the step that begins.
    pub(crate) fn find_pairs(&mut self, around: Surroundings<'_>) {
        let (small_radius, large_radius) = self.sort_by_size(around.particles);
        let margin = 2.0 * around.reach;
        let fill = |grid: &mut Grid, radius: f32, entries: &[u32]| {
            let position = |e: usize| around.particles.position(entries[e] as usize);
            grid.fill(Vec2::ZERO, around.size, Vec2::splat(2.0 * radius + margin), entries.len(), position);
        };
        fill(&mut self.fine, small_radius, &self.small);
        fill(&mut self.coarse, large_radius, &self.large);
        self.contacts.clear();
        pairs_within(&self.fine, &self.small, around, margin, &mut self.contacts);
        pairs_within(&self.coarse, &self.large, around, margin, &mut self.contacts);
        self.pairs_across(around, small_radius, margin);
        self.find_obstacle_contacts(around, small_radius);
    }

    /// Splits the colliding particles at twice their mean radius; returns the largest radius on both sides.
    fn sort_by_size(&mut self, particles: &Particles) -> (f32, f32) {
        let collides = |&i: &usize| particles.groups[i].memberships != 0 && particles.is_live(i);
        let (mut sum, mut count) = (0.0, 0.0);
        for i in (0..particles.len()).filter(collides) {
            sum += particles.radius[i];
            count += 1.0;
        }
        let threshold = if count > 0.0 { 2.0 * sum / count } else { 0.0 };
        let (mut small_radius, mut large_radius) = (0.0, 0.0);
        self.small.clear();
        self.large.clear();
        for i in (0..particles.len()).filter(collides) {
            let radius = particles.radius[i];
            let (list, largest) = if radius <= threshold {
                (&mut self.small, &mut small_radius)
            } else {
                (&mut self.large, &mut large_radius)
            };
            list.push(i as u32);
            *largest = if radius > *largest { radius } else { *largest };
        }
        (small_radius, large_radius)
    }

    fn pairs_across(&mut self, around: Surroundings<'_>, small_radius: f32, margin: f32) {
        for &i in &self.large {
            let position = around.particles.position(i as usize);
            let reach = Vec2::splat(around.particles.radius[i as usize] + small_radius + margin);
            for j in self.fine.in_box(position - reach, position + reach) {
                consider(i, self.small[j as usize], around, margin, &mut self.contacts);
            }
        }
    }

    fn find_obstacle_contacts(&mut self, around: Surroundings<'_>, small_radius: f32) {
        self.obstacle_contacts.clear();
        for (k, obstacle) in around.obstacles.iter().enumerate() {
            let bounds = obstacle.bounds().loosened(around.reach);
            let reach = Vec2::splat(small_radius);
            let small = self.fine.in_box(bounds.mins - reach, bounds.maxs + reach).map(|e| self.small[e as usize]);
            for particle in small.chain(self.large.iter().copied()) {
                let i = particle as usize;
                let near = bounds.loosened(around.particles.radius[i]);
                if around.particles.inv_mass[i] > 0.0
                    && near.contains_local_point(around.particles.position(i))
                    && around.particles.groups[i].meets(obstacle.groups)
                {
                    self.obstacle_contacts.push(ObstacleContact { particle, obstacle: k as u32 });
                }
            }
        }
    }
}

/// Pairs of one grid: within a cell, with the cell to the right, and with the three cells above.
fn pairs_within(grid: &Grid, list: &[u32], around: Surroundings<'_>, margin: f32, contacts: &mut Vec<Contact>) {
    let entries = grid.order();
    for row in 0..grid.rows() {
        for column in 0..grid.columns() {
            let cell = grid.row_range(row, column..column + 1);
            let right = grid.row_range(row, column..column + 2);
            let above = grid.row_range(row + 1, column.saturating_sub(1)..column + 2);
            for k in cell {
                for &j in entries[k + 1..right.end].iter().chain(&entries[above.clone()]) {
                    consider(list[entries[k] as usize], list[j as usize], around, margin, contacts);
                }
            }
        }
    }
}

fn consider(i: u32, j: u32, around: Surroundings<'_>, margin: f32, contacts: &mut Vec<Contact>) {
    let p = around.particles;
    let (a, b) = (i as usize, j as usize);
    // First what is cheapest and by far the most frequent.
    if keep_apart_themselves(p, a, b) {
        return;
    }
    let reach = p.radius[a] + p.radius[b] + margin;
    if p.between(a, b).length_squared() < reach * reach && may_collide(p, a, b, around.exemptions) {
        let (friction, restitution) = combine(p.material[a], p.material[b]);
        contacts.push(Contact { i, j, friction, restitution, touched: false });
    }
}

/// Whether two particles belong to one fluid, which keeps its particles apart by itself, or to one soft body, whose
/// constraints do.
fn keep_apart_themselves(p: &Particles, a: usize, b: usize) -> bool {
    let in_one_body = p.owner[a] == p.owner[b] && p.next_in_ring[a] == NO_OWNER && p.next_in_ring[b] == NO_OWNER;
    p.fluid[a] == p.fluid[b] && (p.fluid[a] != 0 || in_one_body)
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
    let owners = [p.owner[a], p.owner[b]];
    !exemptions.contains(owners[0], owners[1]) && !exemptions.gate_is_open([a as u32, b as u32], owners)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::CollisionGroups;
    use crate::rng::Rng;
    use crate::solver::testing::disc;

    fn random_discs(seed: u64, count: u32) -> Particles {
        let mut rng = Rng::new(seed, 1);
        let mut particles = Particles::default();
        for owner in 0..count {
            let position = Vec2::new(rng.range(0.0, 40.0), rng.range(0.0, 30.0));
            let mut particle = disc(position, 1.0);
            particle.radius = if owner % 13 == 0 { rng.range(2.0, 4.0) } else { rng.range(0.2, 0.5) };
            particle.owner = owner / 3;
            particle.fluid = u32::from(owner % 5 == 0);
            particles.insert(&particle);
        }
        particles
    }

    fn found(particles: &Particles, exemptions: &Exemptions) -> Vec<(u32, u32)> {
        let mut broad = BroadPhase::default();
        let size = Vec2::new(40.0, 30.0);
        broad.find_pairs(Surroundings { particles, obstacles: &[], exemptions, size, reach: 0.1 });
        let mut pairs: Vec<_> = broad.contacts.iter().map(|c| (c.i.min(c.j), c.i.max(c.j))).collect();
        pairs.sort_unstable();
        pairs
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
                    if is_near && !keep_apart_themselves(&particles, i, j) && may_collide(&particles, i, j, &exemptions)
                    {
                        expected.push((i as u32, j as u32));
                    }
                }
            }
            assert_eq!(found(&particles, &exemptions), expected, "seed {seed}");
            assert!(!expected.is_empty());
        }
    }

    #[test]
    fn owners_groups_and_exemptions_keep_pairs_apart() {
        let mut particles = Particles::default();
        for owner in [0, 0, 1] {
            particles.insert(&crate::particle::Particle { owner, ..disc(Vec2::new(5.0, 5.0), 1.0) });
        }
        let none = Exemptions::default();
        assert_eq!(found(&particles, &none), [(0, 2), (1, 2)]);
        let mut exempt = Exemptions::default();
        exempt.set(0, 1, true);
        assert_eq!(found(&particles, &exempt), []);
        particles.groups[2] = CollisionGroups { memberships: 2, filter: 1 };
        particles.groups[0] = CollisionGroups { memberships: 1, filter: 2 };
        particles.groups[1] = CollisionGroups { memberships: 4, filter: 2 };
        assert_eq!(found(&particles, &none), [(0, 2)]);
    }
}
