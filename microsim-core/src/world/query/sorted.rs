//! What is sorted for queries: made for the first one that needs it, kept until it changes.

use super::entry::{Bounds, Disc, Entry};
use super::index::Index;
use crate::collision::obstacle::Obstacle;
use crate::world::World;
use crate::world::obstacle::WALLS;
use parry2d::bounding_volume::Aabb;
use std::sync::{Arc, Mutex, PoisonError};

/// Discs, organisms and obstacles of a world, each sorted if it was asked for since it last changed.
#[derive(Debug, Default)]
pub(crate) struct QueryIndex {
    discs: Kept<Index<Disc>>,
    organisms: Kept<Index<Bounds>>,
    obstacles: Kept<Index<Bounds>>,
}

/// What is made when it is needed, by any thread.
#[derive(Debug)]
struct Kept<T>(Mutex<Option<Arc<T>>>);

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self(Mutex::new(None))
    }
}

impl<T> Kept<T> {
    fn clear(&mut self) {
        *self.0.get_mut().unwrap_or_else(PoisonError::into_inner) = None;
    }

    fn get_or(&self, make: impl FnOnce() -> T) -> Arc<T> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(kept.get_or_insert_with(|| Arc::new(make())))
    }
}

impl QueryIndex {
    /// Forgets where organisms are.
    pub(crate) fn clear(&mut self) {
        self.discs.clear();
        self.organisms.clear();
    }

    /// Forgets where obstacles are.
    pub(crate) fn clear_obstacles(&mut self) {
        self.obstacles.clear();
    }
}

impl World {
    /// All discs that can be touched.
    pub(super) fn sorted_discs(&self) -> Arc<Index<Disc>> {
        self.scratch.query_index.discs.get_or(|| {
            let p = &self.particles;
            let solid = p.live().filter(|&i| p.groups[i].memberships != 0 && p.position(i).is_finite());
            let discs = solid.map(|i| Disc { at: p.position(i), radius: p.radius[i], index: i as u32 });
            Index::new(discs, self.config.size)
        })
    }

    /// Boxes around all organisms.
    pub(super) fn sorted_organisms(&self) -> Arc<Index<Bounds>> {
        self.scratch.query_index.organisms.get_or(|| {
            let p = &self.particles;
            let mut boxes = vec![Aabb::new_invalid(); self.organisms.slot_count() as usize];
            for i in p.live() {
                let (aabb, at, radius) = (&mut boxes[p.owner[i] as usize], p.position(i), p.radius[i]);
                aabb.mins = aabb.mins.min(at - radius);
                aabb.maxs = aabb.maxs.max(at + radius);
            }
            let boxes = boxes.into_iter().zip(0..).filter(|(aabb, _)| aabb.mins.x <= aabb.maxs.x);
            Index::new(boxes.map(|(aabb, slot)| Bounds::new(aabb, slot)), self.config.size)
        })
    }

    /// Added obstacles that can be touched and whose boxes may reach into a box.
    pub(in crate::world) fn obstacles_near(&self, bounds: &Aabb) -> Vec<&Obstacle> {
        let index = self.sorted_obstacles();
        let near = index.in_box(bounds.mins, bounds.maxs).map(|entry| &self.obstacles[entry.index() as usize]);
        near.filter(|obstacle| obstacle.is_solid()).collect()
    }

    /// Boxes around the enabled obstacles, without walls.
    pub(super) fn sorted_obstacles(&self) -> Arc<Index<Bounds>> {
        self.scratch.query_index.obstacles.get_or(|| {
            let added = self.obstacles.iter().zip(0..).skip(WALLS).filter(|(obstacle, _)| obstacle.is_enabled);
            Index::new(added.map(|(obstacle, k)| Bounds::new(obstacle.aabb(), k)), self.config.size)
        })
    }
}
