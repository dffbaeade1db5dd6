//! Ingestion: from its beginning until all of the prey is inside, or all of it is outside again.

use super::encounter::front_nodes;
use super::gate::PreySide;
use crate::capability::phagocytosis::{Engulfer, IngestionWay, Meal, MealPhase, PreyClass};
use crate::event::Event;
use crate::id::OrganismId;
use crate::world::World;

/// Share of the time limit at which soft prey has shrunk to its scale for ingestion.
const SHRUNK_BY: f32 = 0.6;
/// Fewest membrane nodes of a cell that forms a cup: in a smaller one the cup takes too much of the membrane.
const CUP_NODES: usize = 36;
/// Longest substep of a cup, s: in longer ones its lips slip off one prey in twenty.
const CUP_SUBSTEP: f32 = 1.0 / 360.0 + 1e-5;

impl World {
    /// Opens a gate for prey, or prepares the membrane for a cup.
    pub(super) fn begin_ingestion(&mut self, id: OrganismId, meal: &mut Meal) {
        let Self { organisms, fluids, exemptions, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return };
        let is_coarse = self.config.substep() > CUP_SUBSTEP;
        if organism.outline.len() < CUP_NODES || is_coarse {
            meal.way = IngestionWay::Gate;
        }
        match meal.way {
            IngestionWay::Gate => {
                meal.gate = front_nodes(organism);
                exemptions.open_gate(&meal.gate, meal.prey.index);
            }
            IngestionWay::Cup => organism.record_nodes_per_root(fluids),
        }
        self.set_held_by(meal.prey, Some(id));
        self.events.push(Event::IngestionBegan { engulfer: id, prey: meal.prey });
    }

    /// Advances all ingestions of an engulfer by a step; those that reach the time limit outside are given up.
    pub(super) fn advance_ingestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
        let params = engulfer.params;
        engulfer.meals.retain_mut(|meal| {
            let MealPhase::Ingesting(elapsed) = meal.phase else { return true };
            let elapsed = elapsed + self.config.dt;
            meal.phase = MealPhase::Ingesting(elapsed);
            if meal.class == PreyClass::Soft {
                let part = elapsed / (SHRUNK_BY * params.time_limit);
                let full = self.organisms.get(meal.prey).map_or(1.0, |prey| prey.full_scale);
                let scale = full * (1.0 + (params.soft_prey_scale - 1.0) * if part < 1.0 { part } else { 1.0 });
                // Recently released prey is still smaller than its full size.
                let present = self.present_scale(meal.prey);
                self.scale_body(meal.prey, if scale < present { scale } else { present });
            }
            let side = match meal.way {
                IngestionWay::Gate => self.advance_gate(id, meal, &params, elapsed),
                IngestionWay::Cup if self.advance_cup(id, meal.prey, &params) => PreySide::Inside,
                IngestionWay::Cup => PreySide::Outside,
            };
            match side {
                PreySide::Inside => self.complete_ingestion(id, meal),
                PreySide::Outside if elapsed >= params.time_limit => self.abort_ingestion(id, meal),
                PreySide::Outside | PreySide::Between => return true,
            }
            side == PreySide::Inside
        });
    }

    /// Closes the gate behind prey that is inside.
    fn complete_ingestion(&mut self, id: OrganismId, meal: &mut Meal) {
        self.exemptions.close_gate(&meal.gate, meal.prey.index);
        meal.gate.clear();
        meal.phase = MealPhase::Ingested;
        self.events.push(Event::Ingested { engulfer: id, prey: meal.prey });
    }

    /// Lets prey go that stayed outside.
    fn abort_ingestion(&mut self, id: OrganismId, meal: &Meal) {
        self.release_prey(meal);
        self.events.push(Event::Released { engulfer: id, prey: meal.prey });
    }
}
