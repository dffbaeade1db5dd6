//! The one particle store: everything that moves is a disc in these arrays.
//!
//! Plain `f32` columns, so that a kernel over eight neighbouring entries compiles to vector instructions. Two layouts
//! share the one index space, and only [`crate::solver`] knows the difference:
//!
//! ```text
//! block: eight instances of one template, slot-major         loose: one index each, reused after removal
//!   base + slot * 8 + lane                                     membranes and cytoplasm that grow, free fluid
//!   slot 0: |0 1 2 3 4 5 6 7|  slot 1: |0 1 2 3 4 5 6 7| ...   | . | . | . |
//! ```
//!
//! A position is an origin, a multiple of [`GRID`], and a small offset from it; each step ends with the origins moved so that
//! no offset is longer than half a grid step. Origins are exact and offsets are fine, so that neither a short substep nor the
//! distance from the room's corner costs digits: at 100 units a unit in the last place, over a substep of 16 us, is a speed
//! of 0.5 units/s. [`Particles::position`] gives world coordinates.
//!
//! A dead entry (an empty lane, a freed index) has inverse mass 0, owner [`NO_OWNER`] and belongs to no collision group.

mod block_range;
mod collision_groups;
mod columns;
pub(crate) mod mass_properties;
mod material;
mod position_cells;
pub(crate) mod sleep;

use crate::shared::Shared;
pub(crate) use block_range::{BlockRange, LANES, outside_of};
pub use collision_groups::CollisionGroups;
pub(crate) use columns::Columns;
use glam::Vec2;
pub use material::Material;
pub(crate) use position_cells::{DisjointPositions, PositionCells};
use serde::{Deserialize, Serialize};

/// Distance of neighbouring origins, units: a power of two, so that coordinates up to 65 536 units lie on it exactly.
pub(crate) const GRID: f32 = 1.0 / 256.0;
/// Owner of an entry that holds no live particle.
pub(crate) const NO_OWNER: u32 = u32::MAX;
/// One particle, as it is put into the store.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Particle {
    /// On the grid of origins.
    pub origin: Vec2,
    /// Position relative to the origin.
    pub offset: Vec2,
    pub velocity: Vec2,
    pub inv_mass: f32,
    pub radius: f32,
    pub groups: CollisionGroups,
    pub material: Material,
    /// What the particle is to its owner; the solver does not read it.
    pub role: u8,
    pub owner: u32,
    /// 0, or one plus the index of the fluid that it belongs to.
    pub fluid: u32,
}

impl Particle {
    /// Position in the world.
    pub(crate) fn position(&self) -> Vec2 {
        self.origin + self.offset
    }

    /// The same elsewhere, by a displacement on the grid of origins.
    pub(crate) fn moved(self, by: Vec2) -> Self {
        Self { origin: self.origin + by, ..self }
    }
}

/// The store: one column per property, all of the same length. Clones share the columns that seldom change; positions at the
/// start of a substep mean nothing in them before the next one.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Particles {
    /// The nearest place on the grid of origins when the step began, length units.
    pub origin_x: Vec<f32>,
    pub origin_y: Vec<f32>,
    /// Position relative to the origin, length units.
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    /// Position at the start of the substep; the next one sets it.
    #[serde(skip)]
    pub prev_x: Vec<f32>,
    #[serde(skip)]
    pub prev_y: Vec<f32>,
    /// Velocity, length units per second.
    pub vx: Vec<f32>,
    pub vy: Vec<f32>,
    /// 1 / mass; 0 for what nothing can move.
    pub inv_mass: Shared<Vec<f32>>,
    pub radius: Shared<Vec<f32>>,
    pub groups: Shared<Vec<CollisionGroups>>,
    pub material: Shared<Vec<Material>>,
    pub role: Shared<Vec<u8>>,
    /// The following node of the membrane that it is in, or [`NO_OWNER`]. Membranes collide with themselves.
    pub next_in_ring: Shared<Vec<u32>>,
    pub owner: Shared<Vec<u32>>,
    pub fluid: Shared<Vec<u32>>,
    /// Freed loose indices, the last freed first.
    free: Vec<u32>,
    #[serde(skip)]
    live_count: usize,
    #[serde(skip)]
    births: Births,
}

/// Which entries hold another particle than at the last search for pairs.
#[derive(Clone, Debug, Default)]
struct Births {
    /// Number of the search.
    search: u32,
    /// The search after which each entry was set; as long as needed.
    after: Vec<u32>,
}

impl Births {
    fn note(&mut self, i: usize) {
        if self.after.len() <= i {
            self.after.resize(i + 1, NO_OWNER);
        }
        self.after[i] = self.search;
    }
}

impl Clone for Particles {
    fn clone(&self) -> Self {
        let mut clone = Self::default();
        clone.clone_from(self);
        clone
    }

    fn clone_from(&mut self, source: &Self) {
        let Self {
            origin_x,
            origin_y,
            x,
            y,
            prev_x,
            prev_y,
            vx,
            vy,
            inv_mass,
            radius,
            groups,
            material,
            role,
            next_in_ring,
            owner,
            fluid,
            free,
            live_count,
            births,
        } = source;
        self.origin_x.clone_from(origin_x);
        self.origin_y.clone_from(origin_y);
        self.x.clone_from(x);
        self.y.clone_from(y);
        // Set before anyone reads them.
        self.prev_x.resize(prev_x.len(), 0.0);
        self.prev_y.resize(prev_y.len(), 0.0);
        self.vx.clone_from(vx);
        self.vy.clone_from(vy);
        self.inv_mass.clone_from(inv_mass);
        self.radius.clone_from(radius);
        self.groups.clone_from(groups);
        self.material.clone_from(material);
        self.role.clone_from(role);
        self.next_in_ring.clone_from(next_in_ring);
        self.owner.clone_from(owner);
        self.fluid.clone_from(fluid);
        self.free.clone_from(free);
        self.live_count = *live_count;
        self.births.clone_from(births);
    }
}

impl Particles {
    /// Number of entries, dead ones included.
    pub(crate) fn len(&self) -> usize {
        self.x.len()
    }

    /// Number of live particles.
    pub(crate) fn live_count(&self) -> usize {
        self.live_count
    }

    /// The columns of all particles that constraints and integration use.
    pub(crate) fn columns(&mut self) -> Columns<'_> {
        let Self { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass, .. } = self;
        Columns { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass }
    }

    /// Whether entry `i` holds a live particle.
    pub(crate) fn is_live(&self, i: usize) -> bool {
        self.owner[i] != NO_OWNER
    }

    /// Origin of particle `i`.
    pub(crate) fn origin(&self, i: usize) -> Vec2 {
        Vec2::new(self.origin_x[i], self.origin_y[i])
    }

    /// Position of particle `i` relative to its origin.
    #[inline(always)]
    pub(crate) fn offset(&self, i: usize) -> Vec2 {
        Vec2::new(self.x[i], self.y[i])
    }

    /// Position of particle `i` in the world.
    #[inline(always)]
    pub(crate) fn position(&self, i: usize) -> Vec2 {
        Vec2::new(self.origin_x[i] + self.x[i], self.origin_y[i] + self.y[i])
    }

    /// From particle `i` to particle `j`, exact where both are near their origins.
    #[inline(always)]
    pub(crate) fn between(&self, i: usize, j: usize) -> Vec2 {
        Vec2::new(
            (self.origin_x[j] - self.origin_x[i]) + (self.x[j] - self.x[i]),
            (self.origin_y[j] - self.origin_y[i]) + (self.y[j] - self.y[i]),
        )
    }

    /// The smaller one of two particles' radii.
    pub(crate) fn smaller_radius(&self, i: u32, j: u32) -> f32 {
        let (i, j) = (self.radius[i as usize], self.radius[j as usize]);
        if i < j { i } else { j }
    }

    pub(crate) fn velocity(&self, i: usize) -> Vec2 {
        Vec2::new(self.vx[i], self.vy[i])
    }

    /// Puts one loose particle into the store.
    pub(crate) fn insert(&mut self, particle: &Particle) -> u32 {
        let index = self.free.pop().unwrap_or_else(|| self.extend(1));
        self.set(index as usize, particle);
        index
    }

    /// Frees a loose particle; its index is handed out again.
    pub(crate) fn remove(&mut self, index: u32) {
        self.clear_entry(index as usize);
        self.free.push(index);
    }

    /// Appends `count` dead entries and returns the first one's index.
    pub(crate) fn extend(&mut self, count: usize) -> u32 {
        let first = self.len();
        let len = first + count;
        let Self { origin_x, origin_y, x, y, prev_x, prev_y, vx, vy, inv_mass, radius, .. } = self;
        let shared: [&mut Vec<f32>; 2] = [inv_mass, radius];
        for column in shared.into_iter().chain([origin_x, origin_y, x, y, prev_x, prev_y, vx, vy]) {
            column.resize(len, 0.0);
        }
        self.groups.resize(len, CollisionGroups::NONE);
        self.material.resize(len, Material::default());
        self.role.resize(len, 0);
        self.next_in_ring.resize(len, NO_OWNER);
        self.owner.resize(len, NO_OWNER);
        self.fluid.resize(len, 0);
        u32::try_from(first).unwrap_or(NO_OWNER)
    }

    /// Entry `i` as a whole.
    pub(crate) fn get(&self, i: usize) -> Particle {
        Particle {
            origin: self.origin(i),
            offset: self.offset(i),
            velocity: self.velocity(i),
            inv_mass: self.inv_mass[i],
            radius: self.radius[i],
            groups: self.groups[i],
            material: self.material[i],
            role: self.role[i],
            owner: self.owner[i],
            fluid: self.fluid[i],
        }
    }

    /// Overwrites entry `i`.
    pub(crate) fn set(&mut self, i: usize, particle: &Particle) {
        self.place(i, particle.origin, particle.offset);
        (self.vx[i], self.vy[i]) = particle.velocity.into();
        self.inv_mass[i] = particle.inv_mass;
        self.radius[i] = particle.radius;
        self.groups[i] = particle.groups;
        self.material[i] = particle.material;
        self.role[i] = particle.role;
        self.live_count += usize::from(!self.is_live(i));
        self.next_in_ring[i] = NO_OWNER;
        self.owner[i] = particle.owner;
        self.fluid[i] = particle.fluid;
        self.births.note(i);
    }

    /// Notes that all live particles are searched for pairs.
    pub(crate) fn begin_search(&mut self) {
        self.births.search = self.births.search.wrapping_add(1);
    }

    /// Whether entry `i` was set after the last search for pairs: what was found there is of another particle.
    pub(crate) fn is_new(&self, i: usize) -> bool {
        self.births.after.get(i) == Some(&self.births.search)
    }

    /// Puts entry `i` somewhere, as if it had been there when the substep began.
    fn place(&mut self, i: usize, origin: Vec2, offset: Vec2) {
        (self.origin_x[i], self.origin_y[i]) = origin.into();
        (self.x[i], self.y[i]) = offset.into();
        (self.prev_x[i], self.prev_y[i]) = offset.into();
    }

    /// Moves entry `i` by a displacement on the grid of origins, its place at the start of the substep with it.
    pub(crate) fn displace(&mut self, i: usize, by: Vec2) {
        self.origin_x[i] += by.x;
        self.origin_y[i] += by.y;
    }

    /// Notes which nodes follow each other in a membrane.
    pub(crate) fn link_ring(&mut self, ring: &[u32]) {
        for (k, &node) in ring.iter().enumerate() {
            self.next_in_ring[node as usize] = ring[(k + 1) % ring.len()];
        }
    }

    /// Whether two nodes of a membrane are the ends of one link.
    pub(crate) fn are_ring_neighbours(&self, a: usize, b: usize) -> bool {
        self.next_in_ring[a] as usize == b || self.next_in_ring[b] as usize == a
    }

    /// Makes entry `i` dead without freeing its index (a lane of a block).
    pub(crate) fn clear_entry(&mut self, i: usize) {
        self.live_count -= usize::from(self.is_live(i));
        (self.vx[i], self.vy[i]) = (0.0, 0.0);
        self.inv_mass[i] = 0.0;
        self.groups[i] = CollisionGroups::NONE;
        self.owner[i] = NO_OWNER;
        self.next_in_ring[i] = NO_OWNER;
        self.fluid[i] = 0;
    }

    /// Stops entry `i`: no velocity, no collisions, infinite mass, and numbers that are finite.
    pub(crate) fn freeze(&mut self, i: usize, origin: Vec2, at: Vec2) {
        self.place(i, origin, at - origin);
        (self.vx[i], self.vy[i]) = (0.0, 0.0);
        self.inv_mass[i] = 0.0;
        self.groups[i] = CollisionGroups::NONE;
        if !(self.radius[i].is_finite() && self.radius[i] >= 0.0) {
            self.radius[i] = 0.0;
        }
    }

    /// Where entry `i` was when the substep began.
    pub(crate) fn last_position(&self, i: usize) -> Vec2 {
        self.origin(i) + Vec2::new(self.prev_x[i], self.prev_y[i])
    }

    /// Restores what a file leaves out: positions at the start of the substep, and the number of live particles.
    ///
    /// # Errors
    /// When columns differ in length.
    #[cfg(feature = "snapshot")]
    pub(crate) fn restore_skipped(&mut self) -> Result<(), String> {
        let len = self.len();
        let Self { origin_x, origin_y, x, y, vx, vy, inv_mass, radius, .. } = &*self;
        let columns = [origin_x, origin_y, x, y, vx, vy, inv_mass, radius];
        let others =
            [self.groups.len(), self.material.len(), self.role.len(), self.next_in_ring.len(), self.owner.len()];
        let lengths = columns.iter().map(|column| column.len()).chain(others).chain([self.fluid.len()]);
        if lengths.into_iter().any(|other| other != len) || len >= NO_OWNER as usize - 1 {
            return Err("particles: columns differ in length".to_owned());
        }
        self.prev_x.clone_from(&self.x);
        self.prev_y.clone_from(&self.y);
        self.live_count = self.live().count();
        Ok(())
    }

    /// Freed loose indices, in the reverse order in which they are handed out again.
    pub(crate) fn free_indices(&self) -> &[u32] {
        &self.free
    }

    /// Indices of the live particles, ascending.
    pub(crate) fn live(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.len()).filter(|&i| self.is_live(i))
    }
}
