//! Size of an organism relative to its size when spawned.

use super::World;
use crate::id::OrganismId;
use crate::organism::{Organism, Storage};
use crate::solver::lanes::LANES;

impl World {
    /// Scale of an organism's constraints.
    pub(crate) fn scale_of(&self, organism: &Organism) -> f32 {
        match organism.body {
            Storage::Lane { block, first } => {
                let block = &self.blocks[block as usize];
                block.scale[(first - block.base) as usize]
            }
            Storage::Loose { .. } => 1.0,
        }
    }

    /// Size of an organism relative to its size when spawned.
    pub(in crate::world) fn present_scale(&self, id: OrganismId) -> f32 {
        self.organisms.get(id).map_or(1.0, |organism| self.scale_of(organism) / organism.spawn_scale)
    }

    /// Sets the size of a templated organism relative to its size when spawned.
    pub(in crate::world) fn set_scale(&mut self, id: OrganismId, factor: f32) {
        let Some(organism) = self.organisms.get(id) else { return };
        let Storage::Lane { block: index, first } = organism.body else { return };
        let block = &mut self.blocks[index as usize];
        let lane = (first - block.base) as usize;
        block.scale[lane] = organism.spawn_scale * factor;
        self.sleep.wake_up(index, lane);
        for (slot, node) in self.templates[block.template as usize].nodes().iter().enumerate() {
            self.particles.radius[first as usize + slot * LANES] = node.radius * block.scale[lane];
        }
    }

    /// Present area of an organism.
    pub(in crate::world) fn area_of(&self, id: OrganismId) -> f32 {
        let scale = self.present_scale(id);
        self.organisms.get(id).map_or(0.0, |organism| organism.spawn_area * (scale * scale))
    }
}
