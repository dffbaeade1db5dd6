//! Carries out what phagocytosis decides: encounters are counted, gates opened and closed, prey is drawn in, shrunk,
//! digested and removed, and its engulfer grows.

use super::World;
use crate::behavior::crawl::{MembraneRegion, region};
use crate::behavior::heading;
use crate::capability::Locomotion;
use crate::capability::phagocytosis::{Encounter, Engulfer, Meal, MealPhase, PreyClass};
use crate::collision::Contact;
use crate::event::Event;
use crate::geometry::polygon::{contains_point, nearest_on_segment};
use crate::id::OrganismId;
use crate::organism::{Body, Organism};
use crate::solver::fluid::rest_area;
use crate::solver::lanes::LANES;
use glam::Vec2;

/// Prey has shrunk to its scale for ingestion at this share of the time limit.
const SHRUNK_BY: f32 = 0.6;
/// Size to which digestion shrinks prey before it is freed, relative to its size when it was taken in.
const DIGESTED_SCALE: f32 = 0.25;
/// Gap at which two discs still count as touching, as a share of the smaller one's radius.
const TOUCH_GAP: f32 = 0.5;
/// Share of a node's radius by which prey may still overlap the membrane when it counts as inside.
const OVERLAP: f32 = 0.25;

impl World {
    /// One step of all engulfers: conditions, gates, ingestion, digestion and growth.
    pub(crate) fn advance_phagocytosis(&mut self) {
        let engulfers: Vec<OrganismId> = self
            .organisms
            .iter()
            .filter(|(_, o)| o.engulfer.is_some() && !o.is_quarantined)
            .map(|(id, _)| id)
            .collect();
        for id in engulfers {
            let Some(mut engulfer) = self.organisms.get_mut(id).and_then(|o| o.engulfer.take()) else { continue };
            self.drop_lost_meals(&mut engulfer);
            for k in engulfer.touch(&self.encounters(id), self.config.dt) {
                self.open_gate(id, &mut engulfer.meals[k]);
            }
            self.advance_ingestion(id, &mut engulfer);
            self.advance_digestion(id, &mut engulfer);
            engulfer.held_area = self.held_area(&engulfer);
            if let Some(organism) = self.organisms.get_mut(id) {
                organism.engulfer = Some(engulfer);
            }
            self.grow_pending(id);
        }
    }

    /// Frees all prey of an organism that is about to be removed or was frozen.
    pub(crate) fn release_meals(&mut self, id: OrganismId) {
        let engulfer = self.organisms.get_mut(id).and_then(|organism| organism.engulfer.as_mut());
        for meal in engulfer.map_or(Vec::new(), |engulfer| std::mem::take(&mut engulfer.meals)) {
            self.exemptions.close_gate(&meal.gate, meal.prey.index);
            if self.organisms.get(meal.prey).is_some_and(Organism::is_held) {
                self.set_scale(meal.prey, 1.0);
                self.organisms.get_mut(meal.prey).into_iter().for_each(|prey| prey.set_held_by(None));
            }
        }
    }

    /// Forgets meals that were removed from the world.
    fn drop_lost_meals(&mut self, engulfer: &mut Engulfer) {
        engulfer.meals.retain(|meal| {
            let is_alive = self.organisms.get(meal.prey).is_some_and(|prey| !prey.is_quarantined);
            if !is_alive {
                self.exemptions.close_gate(&meal.gate, meal.prey.index);
            }
            is_alive
        });
    }

    /// What touches the front of an engulfer in this step.
    fn encounters(&self, id: OrganismId) -> Vec<Encounter> {
        let Some(organism) = self.organisms.get(id) else { return Vec::new() };
        let front = front_nodes(organism);
        let mut touched: Vec<OrganismId> = Vec::new();
        for contact in self.scratch.broad_phase.contacts.iter().filter(|contact| self.is_contact(contact)) {
            let other = match (front.binary_search(&contact.i), front.binary_search(&contact.j)) {
                (Ok(_), Err(_)) => contact.j,
                (Err(_), Ok(_)) => contact.i,
                _ => continue,
            };
            touched.extend(self.organisms.id_at(self.particles.owner[other as usize]).filter(|&other| other != id));
        }
        touched.sort_unstable();
        let Some(centre) = self.centroid(id) else { return Vec::new() };
        let to_goal = organism.goal.map(|goal| heading(goal - centre));
        let area = self.engulfer_area(organism);
        let groups = touched.chunk_by(|a, b| a == b);
        groups.filter_map(|group| self.encounter(group[0], group.len() as u32, centre, to_goal, area)).collect()
    }

    /// Whether two discs touch: in any substep of this step, or nearly so now, because a contact between soft bodies
    /// flickers from substep to substep.
    fn is_contact(&self, contact: &Contact) -> bool {
        let (i, j, p) = (contact.i as usize, contact.j as usize, &self.particles);
        let smaller = if p.radius[i] < p.radius[j] { p.radius[i] } else { p.radius[j] };
        contact.touched || p.between(i, j).length() < p.radius[i] + p.radius[j] + TOUCH_GAP * smaller
    }

    fn encounter(
        &self,
        id: OrganismId,
        contacts: u32,
        from: Vec2,
        to_goal: Option<Vec2>,
        area: f32,
    ) -> Option<Encounter> {
        let organism = self.organisms.get(id)?;
        let prey = organism.prey.filter(|prey| prey.held_by.is_none() && !organism.is_quarantined)?;
        let to_prey = heading(self.centroid(id)? - from);
        let heading = to_goal.map(|to_goal| to_goal.dot(to_prey));
        Some(Encounter { prey: id, class: prey.class, contacts, heading, size_ratio: area / organism.spawn_area })
    }

    /// Sum of the areas of the cytoplasm particles (seed, 3.3.1).
    fn engulfer_area(&self, organism: &Organism) -> f32 {
        let radius = |&i: &u32| self.particles.radius[i as usize];
        organism.fluid_particles.iter().map(radius).map(|r| std::f32::consts::PI * r * r).sum()
    }

    fn open_gate(&mut self, id: OrganismId, meal: &mut Meal) {
        meal.gate = self.organisms.get(id).map_or(Vec::new(), front_nodes);
        self.exemptions.open_gate(&meal.gate, meal.prey.index);
        self.organisms.get_mut(meal.prey).into_iter().for_each(|organism| organism.set_held_by(Some(id)));
        self.events.push(Event::IngestionBegan { engulfer: id, prey: meal.prey });
    }

    fn advance_ingestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
        let Some(organism) = self.organisms.get(id) else { return };
        let outline: Vec<Vec2> = organism.outline_particles().map(|i| self.particles.position(i as usize)).collect();
        let node_radius = organism.body.membrane().map_or(0.0, |membrane| membrane.node_radius);
        let clearance = node_radius * (1.0 - OVERLAP);
        let params = engulfer.params;
        engulfer.meals.retain_mut(|meal| {
            let MealPhase::Ingesting(elapsed) = meal.phase else { return true };
            let elapsed = elapsed + self.config.dt;
            meal.phase = MealPhase::Ingesting(elapsed);
            if meal.class == PreyClass::Soft {
                let part = elapsed / (SHRUNK_BY * params.time_limit);
                self.set_scale(meal.prey, 1.0 + (params.soft_prey_scale - 1.0) * if part < 1.0 { part } else { 1.0 });
            }
            self.widen_gate(id, meal);
            match self.place_of_prey(meal.prey, &outline, clearance) {
                Place::Inside => self.complete(id, meal),
                Place::Outside if elapsed >= params.time_limit => {
                    self.release(id, meal);
                    return false;
                }
                Place::Outside | Place::Between => {}
            }
            true
        });
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
        self.set_scale(meal.prey, 1.0);
        self.organisms.get_mut(meal.prey).into_iter().for_each(|organism| organism.set_held_by(None));
        self.events.push(Event::Released { engulfer: id, prey: meal.prey });
    }

    fn advance_digestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
        if !engulfer.digests {
            return;
        }
        let params = engulfer.params;
        let mut eaten = 0.0;
        for meal in &mut engulfer.meals {
            let (progress, time) = match (meal.phase, meal.class) {
                (MealPhase::Ingested, class) => (0.0, params.digestion_time[class as usize]),
                (MealPhase::Digesting(progress), class) => (progress, params.digestion_time[class as usize]),
                _ => continue,
            };
            let progress = progress + self.config.dt / time;
            meal.phase = MealPhase::Digesting(progress);
            let full = if meal.class == PreyClass::Soft { params.soft_prey_scale } else { 1.0 };
            let part = if progress < 1.0 { progress } else { 1.0 };
            self.set_scale(meal.prey, full * (1.0 + (DIGESTED_SCALE - 1.0) * part));
            if progress >= 1.0 {
                eaten += self.consume(id, meal.prey);
            }
        }
        engulfer.meals.retain(|meal| !matches!(meal.phase, MealPhase::Digesting(progress) if progress >= 1.0));
        engulfer.pending_growth += eaten * params.growth_yield;
    }

    /// Area of everything that an engulfer holds or takes in.
    pub(super) fn held_area(&self, engulfer: &Engulfer) -> f32 {
        let held = engulfer.meals.iter().filter(|meal| !matches!(meal.phase, MealPhase::Touching(_)));
        held.filter_map(|meal| self.organisms.get(meal.prey)).map(|prey| prey.spawn_area * self.shrinkage(prey)).sum()
    }

    /// Present area of an organism over its area when spawned.
    fn shrinkage(&self, organism: &Organism) -> f32 {
        let factor = self.scale_of(organism) / organism.spawn_scale;
        factor * factor
    }

    /// Frees digested prey and returns its area.
    fn consume(&mut self, id: OrganismId, prey: OrganismId) -> f32 {
        let Some((kind, area)) = self.organisms.get(prey).map(|organism| (organism.kind, organism.spawn_area)) else {
            return 0.0;
        };
        let is_removed = self.remove(prey).is_ok();
        self.events.push(Event::Consumed { engulfer: id, prey, kind });
        if is_removed { area } else { 0.0 }
    }

    /// Turns area that was digested into cytoplasm, one particle a step so that nothing bursts, and into the membrane
    /// that it needs.
    fn grow_pending(&mut self, id: OrganismId) {
        let Some(organism) = self.organisms.get_mut(id) else { return };
        let Some(fluid) = organism.fluid else { return };
        let each = rest_area(1, self.fluids[fluid as usize].params.spacing);
        let Some(engulfer) = organism.engulfer.as_mut().filter(|engulfer| engulfer.pending_growth >= each) else {
            return;
        };
        engulfer.pending_growth -= each;
        let nodes = organism.missing_nodes();
        // A world that is full, or a cell that is gone, does not grow.
        let _ = self.grow(id, nodes, 1);
    }

    /// The discs of an organism that can move.
    pub(super) fn discs_of(&self, id: OrganismId) -> impl Iterator<Item = usize> + '_ {
        let particles = self.organisms.get(id).into_iter().flat_map(Organism::particles).map(|i| i as usize);
        particles.filter(|&i| self.particles.inv_mass[i] > 0.0)
    }

    /// Where all discs of prey lie with respect to an outline whose inner edge is `clearance` inside its line.
    fn place_of_prey(&self, prey: OrganismId, outline: &[Vec2], clearance: f32) -> Place {
        let Some(organism) = self.organisms.get(prey) else { return Place::Outside };
        let (mut inside, mut outside) = (true, true);
        for i in organism.particles().map(|i| i as usize).filter(|&i| self.particles.inv_mass[i] > 0.0) {
            let position = self.particles.position(i);
            let is_within = contains_point(outline, position);
            inside &= is_within && gap(outline, position) >= self.particles.radius[i] + clearance;
            outside &= !is_within;
        }
        match (inside, outside) {
            (true, _) => Place::Inside,
            (_, true) => Place::Outside,
            _ => Place::Between,
        }
    }

    /// Sets the size of a templated organism relative to its size when spawned.
    fn set_scale(&mut self, id: OrganismId, factor: f32) {
        let Some(organism) = self.organisms.get(id) else { return };
        let Body::Lane { block, first } = organism.body else { return };
        let block = &mut self.blocks[block as usize];
        let lane = (first - block.base) as usize;
        block.scale[lane] = organism.spawn_scale * factor;
        for (slot, node) in self.templates[block.template as usize].nodes().iter().enumerate() {
            self.particles.radius[first as usize + slot * LANES] = node.radius * block.scale[lane];
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

/// Distance of a point from a polygon's edges.
fn gap(outline: &[Vec2], point: Vec2) -> f32 {
    let edge = |k: usize| nearest_on_segment(outline[k], outline[(k + 1) % outline.len()], point);
    (0..outline.len()).fold(f32::INFINITY, |least, k| {
        let distance = (edge(k) - point).length();
        if distance < least { distance } else { least }
    })
}

/// Particles of the front, sorted; none at rest.
fn front_nodes(organism: &Organism) -> Vec<u32> {
    let Locomotion::Crawl { front_centre: Some(front) } = organism.locomotion else { return Vec::new() };
    let count = organism.outline.len() as u32;
    let is_front = |k: u32| region(k, front, count) == MembraneRegion::Front;
    let mut nodes: Vec<u32> =
        organism.outline_particles().zip(0..count).filter(|&(_, k)| is_front(k)).map(|(node, _)| node).collect();
    nodes.sort_unstable();
    nodes
}
