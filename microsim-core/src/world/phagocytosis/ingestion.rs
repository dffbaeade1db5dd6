//! Ingestion: from its beginning until all of the prey is inside, or all of it is outside again.

use super::encounter::front_nodes;
use super::gate::PreySide;
use crate::capability::phagocytosis::{Engulfer, IngestionWay, Meal, MealPhase, PhagocytosisParams, PreyClass};
use crate::event::Event;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::organism::ring_surgery::insert_node;
use crate::solver::fluid::{Fluid, rest_area};
use crate::world::World;
use std::f32::consts::{PI, TAU};

/// Share of the time limit at which soft prey has shrunk to its scale for ingestion.
const SHRUNK_BY: f32 = 0.6;
/// Fewest membrane nodes of a cell that forms a cup: in a smaller one the cup takes too much of the membrane.
const CUP_NODES: usize = 36;
/// Longest substep of a cup, s: in longer ones its lips slip off one prey in twenty.
const CUP_SUBSTEP: f32 = 1.0 / 360.0 + 1e-5;
/// Least radius of prey in a cup, in node radii, and largest one, in radii of the cell: round less a fold of membrane does not bend,
/// and round more it is not long enough.
const SMALLEST_IN_CUP: f32 = 1.0;
const LARGEST_IN_CUP: f32 = 0.45;
/// Length of links, in rest lengths, above which a membrane gets a node for prey that a gate lets in.
const MOST_STRETCHED: f32 = 1.15;
/// Share of the time limit after which a cup that has not closed becomes a gate, and where in its time the gate then begins.
const CUP_SHARE: f32 = 0.75;
const GATE_SHARE: f32 = 0.25;

impl World {
    /// Opens a gate for prey, or prepares the membrane for a cup.
    pub(super) fn begin_ingestion(&mut self, id: OrganismId, meal: &mut Meal, params: &PhagocytosisParams) {
        if meal.way == IngestionWay::Cup && !self.can_form_cup(id, meal, params) {
            meal.way = IngestionWay::Gate;
        }
        let area = self.area_of(meal.prey);
        self.prepare_cell(meal.prey, area);
        let Self { organisms, fluids, exemptions, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return };
        match meal.way {
            IngestionWay::Gate | IngestionWay::WideGate => {
                meal.gate = front_nodes(organism);
                exemptions.open_gate(&meal.gate, meal.prey.index);
                if is_stretched(organism, area, fluids) {
                    organism.record_nodes_per_root(fluids);
                }
            }
            IngestionWay::Cup => organism.record_nodes_per_root(fluids),
        }
        self.set_held_by(meal.prey, Some(id));
        self.events.push(Event::IngestionBegan { engulfer: id, prey: meal.prey });
    }

    /// Lets a cell that is about to be held forget what it was about to take in, and notes its area.
    fn prepare_cell(&mut self, prey: OrganismId, area: f32) {
        if let Some(cell) = self.organisms.get_mut(prey).filter(|prey| prey.is_cell()) {
            cell.spawn_area = area;
            if let Some(engulfer) = &mut cell.engulfer {
                engulfer.meals.clear();
            }
        }
    }

    /// Whether a fold of the membrane can hold the prey: in this substep, with so many nodes, and of this size.
    fn can_form_cup(&self, id: OrganismId, meal: &Meal, params: &PhagocytosisParams) -> bool {
        let Some(organism) = self.organisms.get(id) else { return false };
        let Some(membrane) = organism.body.membrane() else { return false };
        let scale = if meal.class == PreyClass::Soft { params.soft_prey_scale } else { 1.0 };
        let radius = scale * (self.area_of(meal.prey) / PI).sqrt();
        let cell = membrane.rest_length * organism.outline.len() as f32 / TAU;
        let fits = radius >= SMALLEST_IN_CUP * membrane.node_radius && radius <= LARGEST_IN_CUP * cell;
        fits && organism.outline.len() >= CUP_NODES && self.config.substep() <= CUP_SUBSTEP
    }

    /// Puts a node into a membrane that goes round prey in a gate only if its links are stretched.
    pub(super) fn lengthen_gate(&mut self, id: OrganismId, engulfer: &Engulfer) {
        let has_room = (self.particles.live_count() as u64) < u64::from(self.config.max_particles);
        let Self { organisms, fluids, particles, .. } = self;
        let Some(organism) = organisms.get_mut(id).filter(|_| has_room) else { return };
        if engulfer.meals.iter().any(Meal::is_in_gate) && is_stretched(organism, engulfer.held_area, fluids) {
            insert_node(organism, particles);
        }
    }

    /// Advances all ingestions of an engulfer by a step; those that reach the time limit outside are given up.
    pub(super) fn advance_ingestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
        let params = engulfer.params;
        engulfer.meals.retain_mut(|meal| {
            let MealPhase::Ingesting(elapsed) = meal.phase else { return true };
            let elapsed = replace_late_cup(meal, elapsed + self.config.dt, params.time_limit);
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
                IngestionWay::Gate | IngestionWay::WideGate => self.advance_gate(id, meal, &params, elapsed),
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

/// Whether the links of a membrane at rest around its cytoplasm and so much area besides are stretched.
fn is_stretched(organism: &Organism, held_area: f32, fluids: &[Fluid]) -> bool {
    let (Some(membrane), Some(fluid)) = (organism.body.membrane(), organism.fluid) else { return false };
    let own = rest_area(organism.fluid_particles.len(), fluids[fluid as usize].params.spacing);
    let radius = ((own + held_area) / PI).sqrt() + membrane.rim;
    TAU * radius > MOST_STRETCHED * membrane.rest_length * organism.outline.len() as f32
}

/// Lets prey in through a gate that a cup has not enclosed by then; returns the time since its ingestion began, as the way counts it.
fn replace_late_cup(meal: &mut Meal, elapsed: f32, time_limit: f32) -> f32 {
    if meal.way != IngestionWay::Cup || elapsed < CUP_SHARE * time_limit {
        return elapsed;
    }
    meal.way = IngestionWay::Gate;
    GATE_SHARE * time_limit
}
