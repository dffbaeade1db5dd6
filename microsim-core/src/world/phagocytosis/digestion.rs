//! Digestion: prey shrinks and is consumed, and the engulfer grows by it.

use crate::capability::phagocytosis::{Engulfer, MealPhase};
use crate::event::Event;
use crate::id::OrganismId;
use crate::organism::{LEAST_CYTOPLASM, Organism, at_most};
use crate::solver::fluid::rest_area;
use crate::world::World;
use std::f32::consts::PI;

/// Size to which digestion shrinks prey before it is removed, relative to its size when it was ingested.
const DIGESTED_SCALE: f32 = 0.25;
/// Time in which released prey grows by its full size, s.
const REGROWTH_TIME: f32 = 2.0;

impl World {
    /// Advances the digestion of all prey inside an engulfer that was told to digest.
    pub(super) fn advance_digestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
        if !engulfer.digests {
            return;
        }
        let params = engulfer.params;
        let mut eaten = 0.0;
        for meal in &mut engulfer.meals {
            let before = match meal.phase {
                MealPhase::Ingested => 0.0,
                MealPhase::Digesting(progress) => progress,
                MealPhase::Touching(_) | MealPhase::Ingesting(_) => continue,
            };
            let progress = before + self.config.dt / params.digestion_time[meal.class as usize];
            meal.phase = MealPhase::Digesting(progress);
            let shrunk = self.present_scale(meal.prey) * (digested_scale(progress) / digested_scale(before));
            self.scale_body(meal.prey, shrunk);
            self.dissolve_cell(meal.prey, progress);
            if progress >= 1.0 {
                eaten += self.consume(id, meal.prey);
            }
        }
        engulfer.meals.retain(|meal| !matches!(meal.phase, MealPhase::Digesting(progress) if progress >= 1.0));
        engulfer.pending_growth = at_most(engulfer.pending_growth + eaten * params.growth_yield);
    }

    /// Takes cytoplasm out of a cell that is digested, so that its area shrinks as that of a body does.
    fn dissolve_cell(&mut self, prey: OrganismId, progress: f32) {
        let Some(cell) = self.organisms.get(prey) else { return };
        let (Some(membrane), Some(fluid)) = (cell.body.membrane(), cell.fluid) else { return };
        let each = rest_area(1, self.fluids[fluid as usize].params.spacing);
        let radius = (cell.spawn_area / PI).sqrt() - membrane.rim - membrane.node_radius;
        let scale = digested_scale(progress);
        let left = (PI * radius * radius / each * (scale * scale) + 0.5) as usize;
        let surplus = cell.fluid_particles.len().saturating_sub(left.max(LEAST_CYTOPLASM));
        if surplus > 0 {
            self.lose_cytoplasm(prey, fluid, surplus);
        }
    }

    /// Removes digested prey and returns its area.
    fn consume(&mut self, id: OrganismId, prey: OrganismId) -> f32 {
        let Some((kind, area)) = self.organisms.get(prey).map(|organism| (organism.kind, organism.full_area())) else {
            return 0.0;
        };
        let is_removed = self.remove(prey).is_ok();
        self.events.push(Event::Consumed { engulfer: id, prey, kind });
        if is_removed { area } else { 0.0 }
    }

    /// Turns digested area into cytoplasm, one particle, and adds the nodes
    /// that the membrane then needs.
    pub(super) fn grow_from_digestion(&mut self, id: OrganismId) {
        let Some(organism) = self.organisms.get_mut(id) else { return };
        let Some(fluid) = organism.fluid else { return };
        let each = rest_area(1, self.fluids[fluid as usize].params.spacing);
        let Some(engulfer) = organism.engulfer.as_mut().filter(|engulfer| engulfer.pending_growth >= each) else {
            return;
        };
        engulfer.pending_growth -= each;
        let nodes = organism.missing_nodes();
        // In a full world the cell does not grow.
        let _ = self.enlarge(id, nodes, 1);
    }

    /// Lets released prey return to its full size, slowly enough for its neighbours to make room.
    pub(super) fn regrow_free_prey(&mut self) {
        let is_free = |organism: &Organism| organism.prey.is_some() && !organism.is_held() && !organism.is_quarantined;
        let free = self.organisms.iter().filter(|(_, organism)| is_free(organism));
        let free: Vec<(OrganismId, f32)> = free.map(|(id, organism)| (id, organism.full_scale)).collect();
        for (id, full) in free {
            let present = self.present_scale(id);
            if present < full {
                let grown = present + self.config.dt / REGROWTH_TIME;
                self.scale_body(id, if grown < full { grown } else { full });
            }
        }
    }
}

/// Size of prey at a progress of its digestion, relative to its size when it was ingested.
fn digested_scale(progress: f32) -> f32 {
    1.0 + (DIGESTED_SCALE - 1.0) * if progress < 1.0 { progress } else { 1.0 }
}
