//! Ingestion: prey between the moment in which an engulfer begins to take it in and the one in which all of it is inside, or
//! all of it outside again.

use super::encounter::front_nodes;
use super::gate::PreySide;
use crate::capability::phagocytosis::{Engulfer, IngestionWay, Meal, MealPhase, PreyClass};
use crate::event::Event;
use crate::id::OrganismId;
use crate::world::World;

/// Prey has shrunk to its scale for ingestion at this share of the time limit.
const SHRUNK_BY: f32 = 0.6;
/// Fewest membrane nodes of a cell that folds around prey; with less the fold takes in too much of the ring.
const CUP_NODES: usize = 36;

impl World {
    pub(super) fn begin_ingestion(&mut self, id: OrganismId, meal: &mut Meal) {
        let Self { organisms, fluids, exemptions, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return };
        if organism.outline.len() < CUP_NODES {
            meal.way = IngestionWay::Gate;
        }
        match meal.way {
            IngestionWay::Gate => {
                meal.gate = front_nodes(organism);
                exemptions.open_gate(&meal.gate, meal.prey.index);
            }
            IngestionWay::Cup => organism.note_first_nodes(fluids),
        }
        self.organisms.get_mut(meal.prey).into_iter().for_each(|organism| organism.set_held_by(Some(id)));
        self.events.push(Event::IngestionBegan { engulfer: id, prey: meal.prey });
    }

    pub(super) fn advance_ingestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
        let params = engulfer.params;
        engulfer.meals.retain_mut(|meal| {
            let MealPhase::Ingesting(elapsed) = meal.phase else { return true };
            let elapsed = elapsed + self.config.dt;
            meal.phase = MealPhase::Ingesting(elapsed);
            if meal.class == PreyClass::Soft {
                let part = elapsed / (SHRUNK_BY * params.time_limit);
                let scale = 1.0 + (params.soft_prey_scale - 1.0) * if part < 1.0 { part } else { 1.0 };
                // Prey that was released a moment ago has not got its size back yet.
                let present = self.present_scale(meal.prey);
                self.set_scale(meal.prey, if scale < present { scale } else { present });
            }
            let side = match meal.way {
                IngestionWay::Gate => self.pass_gate(id, meal, &params, elapsed),
                IngestionWay::Cup if self.advance_cup(id, meal.prey, &params) => PreySide::Inside,
                IngestionWay::Cup => PreySide::Outside,
            };
            match side {
                PreySide::Inside => self.complete(id, meal),
                PreySide::Outside if elapsed >= params.time_limit => self.release(id, meal),
                PreySide::Outside | PreySide::Between => return true,
            }
            side == PreySide::Inside
        });
    }

    /// Closes the gate behind prey that is inside.
    fn complete(&mut self, id: OrganismId, meal: &mut Meal) {
        self.exemptions.close_gate(&meal.gate, meal.prey.index);
        meal.gate.clear();
        meal.phase = MealPhase::Ingested;
        self.events.push(Event::Ingested { engulfer: id, prey: meal.prey });
    }

    /// Closes the gate behind prey that stayed outside.
    fn release(&mut self, id: OrganismId, meal: &Meal) {
        self.exemptions.close_gate(&meal.gate, meal.prey.index);
        self.organisms.get_mut(meal.prey).into_iter().for_each(|organism| organism.set_held_by(None));
        self.events.push(Event::Released { engulfer: id, prey: meal.prey });
    }
}
