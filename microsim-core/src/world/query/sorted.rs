//! A world sorted for queries: made by the first query after a step or another change, kept until the next one.

use super::index::{Disc, DiscIndex};
use crate::collider::Collider;
use crate::id::OrganismId;
use crate::world::World;
use parry2d::bounding_volume::Aabb;
use std::sync::{Arc, Mutex, PoisonError};

/// What queries look at.
#[derive(Debug)]
pub(super) struct Sorted {
    pub discs: DiscIndex,
    /// Organisms with an outline, and the boxes around them.
    pub outlined: Vec<(OrganismId, Aabb)>,
    /// Enabled obstacles, walls included, with their indices and the boxes around them.
    pub obstacles: Vec<(Collider, usize, Aabb)>,
}

/// The sorted world, if it was asked for since the last change.
#[derive(Debug, Default)]
pub(crate) struct QueryIndex(Mutex<Option<Arc<Sorted>>>);

impl QueryIndex {
    /// Forgets it; to be called when the world changes.
    pub(crate) fn clear(&mut self) {
        *self.0.get_mut().unwrap_or_else(PoisonError::into_inner) = None;
    }

    pub(super) fn of(&self, world: &World) -> Arc<Sorted> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(kept.get_or_insert_with(|| Arc::new(Sorted::new(world))))
    }
}

impl Sorted {
    fn new(world: &World) -> Self {
        let p = &world.particles;
        let mut discs = Vec::with_capacity(p.live_count());
        let mut bounds = vec![Aabb::new_invalid(); world.organisms.slot_count() as usize];
        for i in p.live() {
            let at = p.position(i);
            bounds[p.owner[i] as usize].take_point(at);
            if p.groups[i].memberships != 0 && at.is_finite() {
                discs.push(Disc { at, radius: p.radius[i], index: i as u32 });
            }
        }
        let outlined = world.organisms.iter().filter(|(_, organism)| !organism.outline.is_empty());
        let outlined = outlined.map(|(id, _)| (id, bounds[id.index as usize])).collect();
        let enabled = world.obstacles.iter().enumerate().filter(|(_, obstacle)| obstacle.is_enabled);
        let known = enabled.filter_map(|(k, obstacle)| Some((world.collider_at(k as u32)?, k, obstacle.aabb())));
        Self { discs: DiscIndex::new(discs, world.config.size), outlined, obstacles: known.collect() }
    }
}
