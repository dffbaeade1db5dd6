//! Ingestion: prey between the moment in which an engulfer begins to take it in and the one in which all of it is inside, or
//! all of it outside again.

use crate::world::World;
use super::front_nodes;
use crate::capability::phagocytosis::{Engulfer, IngestionWay, Meal, MealPhase, PhagocytosisParams, PreyClass};
use crate::event::Event;
use crate::geometry::polygon::{contains_point, nearest_on_segment};
use crate::id::OrganismId;
use crate::solver::contact::shift;
use glam::Vec2;

/// Prey has shrunk to its scale for ingestion at this share of the time limit.
const SHRUNK_BY: f32 = 0.6;
/// Share of a node's radius by which prey may still overlap the membrane when it counts as inside.
const OVERLAP: f32 = 0.25;
/// Fewest membrane nodes of a cell that folds around prey; with less the fold takes in too much of the ring.
const CUP_NODES: usize = 36;
/// Prey that is neither inside nor outside is put on its side of the membrane after so many time limits.
const PUT_AFTER: f32 = 2.0;

impl World {
    pub(in crate::world) fn begin_ingestion(&mut self, id: OrganismId, meal: &mut Meal) {
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

    pub(in crate::world) fn advance_ingestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
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
            let place = match meal.way {
                IngestionWay::Gate => self.pass_gate(id, meal, &params, elapsed),
                IngestionWay::Cup if self.advance_cup(id, meal.prey, &params) => Place::Inside,
                IngestionWay::Cup => Place::Outside,
            };
            match place {
                Place::Inside => self.complete(id, meal),
                Place::Outside if elapsed >= params.time_limit => self.release(id, meal),
                Place::Outside | Place::Between => return true,
            }
            place == Place::Inside
        });
    }

    /// Widens the gate to where the prey is now, and says where that is. After the time limit the ray cast decides: prey
    /// whose centre is outside is driven out, and after as much time again everything is put where its centre is.
    fn pass_gate(&mut self, id: OrganismId, meal: &mut Meal, params: &PhagocytosisParams, elapsed: f32) -> Place {
        self.widen_gate(id, meal);
        let Some(organism) = self.organisms.get(id) else { return Place::Outside };
        let outline = self.outline_of(organism);
        let clearance = organism.body.membrane().map_or(0.0, |membrane| membrane.node_radius) * (1.0 - OVERLAP);
        let place = self.place_of_prey(meal.prey, &outline, clearance);
        if place != Place::Between || elapsed < params.time_limit {
            return place;
        }
        if !meal.is_expelled && elapsed - self.config.dt < params.time_limit {
            let centre = self.organisms.get(meal.prey).map(|prey| self.centre_of(prey));
            meal.is_expelled = centre.is_some_and(|centre| !contains_point(&outline, centre));
        }
        if elapsed < PUT_AFTER * params.time_limit {
            return place;
        }
        self.put_prey(meal.prey, !meal.is_expelled, &outline, clearance);
        if meal.is_expelled { Place::Outside } else { Place::Inside }
    }

    /// Moves every disc of prey that is not on one side of an outline there, next to the nearest place.
    fn put_prey(&mut self, prey: OrganismId, inside: bool, outline: &[Vec2], clearance: f32) {
        for i in self.discs_of(prey).collect::<Vec<_>>() {
            let at = self.particles.position(i);
            let (edge, outwards) = nearest_edge(outline, at);
            let reach = self.particles.radius[i] + clearance;
            let is_there = contains_point(outline, at) == inside && (at - edge).length() >= reach;
            if !is_there {
                let by = edge + outwards * if inside { -reach } else { reach } - at;
                shift(&mut self.particles, i, by);
                self.particles.prev_x[i] += by.x;
                self.particles.prev_y[i] += by.y;
            }
        }
    }

    /// Closes the gate behind prey that is inside.
    fn complete(&mut self, id: OrganismId, meal: &mut Meal) {
        self.exemptions.close_gate(&meal.gate, meal.prey.index);
        meal.gate.clear();
        meal.phase = MealPhase::Ingested;
        self.events.push(Event::Ingested { engulfer: id, prey: meal.prey });
    }

    /// Opens the gate to the nodes next to the prey: it may have slid along the membrane since the gate was opened.
    fn widen_gate(&mut self, id: OrganismId, meal: &mut Meal) {
        let (Some(engulfer), Some(prey)) = (self.organisms.get(id), self.organisms.get(meal.prey)) else { return };
        let p = &self.particles;
        let margin = 2.0 * self.config.reach();
        let discs: Vec<usize> = prey.particles().map(|i| i as usize).filter(|&i| p.inv_mass[i] > 0.0).collect();
        let is_near =
            |node: usize| discs.iter().any(|&i| p.between(node, i).length() < p.radius[node] + p.radius[i] + margin);
        let nodes = engulfer.outline_particles().filter(|node| !meal.gate.contains(node) && is_near(*node as usize));
        let nodes: Vec<u32> = nodes.collect();
        self.exemptions.open_gate(&nodes, meal.prey.index);
        meal.gate.extend(nodes);
    }

    /// Closes the gate behind prey that stayed outside.
    fn release(&mut self, id: OrganismId, meal: &Meal) {
        self.exemptions.close_gate(&meal.gate, meal.prey.index);
        self.organisms.get_mut(meal.prey).into_iter().for_each(|organism| organism.set_held_by(None));
        self.events.push(Event::Released { engulfer: id, prey: meal.prey });
    }

    /// Where all discs of prey lie with respect to an outline whose inner edge is `clearance` inside its line.
    fn place_of_prey(&self, prey: OrganismId, outline: &[Vec2], clearance: f32) -> Place {
        let (mut inside, mut outside) = (self.organisms.get(prey).is_some(), true);
        for i in self.discs_of(prey) {
            let position = self.particles.position(i);
            let is_within = contains_point(outline, position);
            inside &= is_within
                && (nearest_edge(outline, position).0 - position).length() >= self.particles.radius[i] + clearance;
            outside &= !is_within;
        }
        match (inside, outside) {
            (true, _) => Place::Inside,
            (_, true) => Place::Outside,
            _ => Place::Between,
        }
    }
}

/// Where prey is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Inside,
    Outside,
    Between,
}

/// The nearest point of a counter-clockwise polygon's edges, and the direction out of it there.
fn nearest_edge(outline: &[Vec2], point: Vec2) -> (Vec2, Vec2) {
    let mut best = (f32::INFINITY, point, Vec2::X);
    for k in 0..outline.len() {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        let at = nearest_on_segment(a, b, point);
        let distance = (at - point).length();
        if distance < best.0 {
            best = (distance, at, -(b - a).perp().normalize_or_zero());
        }
    }
    (best.1, best.2)
}
