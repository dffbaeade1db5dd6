//! Carries out what phagocytosis decides: encounters are counted, prey is taken in (see [`super::ingestion`]), digested and
//! removed, and its engulfer grows.

use super::World;
use super::touching::NearPair;
use crate::behavior::crawl::{MembraneRegion, region};
use crate::behavior::heading;
use crate::capability::Locomotion;
use crate::capability::phagocytosis::{Encounter, Engulfer, IngestionWay, Meal, MealPhase};
use crate::event::Event;
use crate::id::OrganismId;
use crate::organism::{Organism, Storage};
use crate::solver::fluid::rest_area;
use crate::solver::lanes::LANES;
use glam::Vec2;
use std::f32::consts::PI;

/// Size to which digestion shrinks prey before it is freed, relative to its size when it was taken in.
const DIGESTED_SCALE: f32 = 0.25;
/// Time in which released prey would grow from nothing to its own size, s.
const REGROWTH_TIME: f32 = 2.0;
/// Gap at which two discs still count as touching, as a share of the smaller one's radius.
const TOUCH_GAP: f32 = 0.5;

impl World {
    /// One step of all engulfers: conditions, gates, ingestion, digestion and growth.
    pub(crate) fn advance_phagocytosis(&mut self) {
        self.regrow_free_prey();
        let engulfers: Vec<OrganismId> = self
            .organisms
            .with_membrane()
            .filter(|(_, o)| o.engulfer.is_some() && !o.is_quarantined)
            .map(|(id, _)| id)
            .collect();
        for id in engulfers {
            let Some(mut engulfer) = self.organisms.get_mut(id).and_then(|o| o.engulfer.take()) else { continue };
            self.drop_lost_meals(&mut engulfer);
            for k in engulfer.touch(&self.encounters(id), self.config.dt) {
                self.begin_ingestion(id, &mut engulfer.meals[k]);
            }
            self.advance_ingestion(id, &mut engulfer);
            self.advance_digestion(id, &mut engulfer);
            let is_folded = engulfer.fold_length > 0.0;
            let is_rid = self.advance_phagosomes(id, &engulfer);
            engulfer.held_area = self.held_area(id, &engulfer);
            engulfer.fold_length = self.fold_length(id, &engulfer);
            let has_spare_nodes = is_rid || (is_folded && engulfer.fold_length == 0.0);
            if let Some(organism) = self.organisms.get_mut(id) {
                organism.engulfer = Some(engulfer);
                if has_spare_nodes {
                    organism.adapt_nodes(&self.fluids);
                }
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
                self.organisms.get_mut(meal.prey).into_iter().for_each(|prey| prey.set_held_by(None));
            }
        }
    }

    /// Forgets meals that were removed from the world or are frozen.
    fn drop_lost_meals(&mut self, engulfer: &mut Engulfer) {
        engulfer.meals.retain(|meal| {
            let prey = self.organisms.get_mut(meal.prey);
            let is_alive = prey.as_ref().is_some_and(|prey| !prey.is_quarantined);
            if !is_alive {
                self.exemptions.close_gate(&meal.gate, meal.prey.index);
                prey.into_iter().for_each(|frozen| frozen.set_held_by(None));
            }
            is_alive
        });
    }

    /// What touches the front of an engulfer in this step.
    fn encounters(&self, id: OrganismId) -> Vec<Encounter> {
        let Some(organism) = self.organisms.get(id) else { return Vec::new() };
        let front = front_nodes(organism);
        let mut touched: Vec<OrganismId> = Vec::new();
        for pair in self.near_pairs().filter(|pair| self.is_contact(pair)) {
            let other = match (front.binary_search(&pair.i), front.binary_search(&pair.j)) {
                (Ok(_), Err(_)) => pair.j,
                (Err(_), Ok(_)) => pair.i,
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
    fn is_contact(&self, pair: &NearPair) -> bool {
        pair.touched || pair.gap < TOUCH_GAP * self.particles.smaller_radius(pair.i, pair.j)
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
    pub(super) fn engulfer_area(&self, organism: &Organism) -> f32 {
        let radius = |&i: &u32| self.particles.radius[i as usize];
        organism.fluid_particles.iter().map(radius).map(|r| PI * r * r).sum()
    }

    fn advance_digestion(&mut self, id: OrganismId, engulfer: &mut Engulfer) {
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
            self.shrink(meal.prey, digested_scale(progress) / digested_scale(before));
            if progress >= 1.0 {
                eaten += self.consume(id, meal.prey);
            }
        }
        engulfer.meals.retain(|meal| !matches!(meal.phase, MealPhase::Digesting(progress) if progress >= 1.0));
        engulfer.pending_growth += eaten * params.growth_yield;
    }

    /// Area of everything that an engulfer holds, phagosomes included, or lets through its gate.
    pub(super) fn held_area(&self, id: OrganismId, engulfer: &Engulfer) -> f32 {
        let node_radius = self.organisms.get(id).and_then(|o| o.body.membrane()).map_or(0.0, |m| m.node_radius);
        let takes_room = |meal: &&Meal| !matches!(meal.phase, MealPhase::Touching(_)) && !meal.is_in_cup();
        let area = |meal: &Meal| {
            let area = self.area_of(meal.prey);
            let radius = (area / PI).sqrt() + 2.0 * node_radius;
            if meal.way == IngestionWay::Gate { area } else { PI * radius * radius }
        };
        engulfer.meals.iter().filter(takes_room).map(area).sum()
    }

    /// Present area of an organism over its area when spawned.
    pub(super) fn shrinkage(&self, organism: &Organism) -> f32 {
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
        let _ = self.enlarge(id, nodes, 1);
    }

    /// The discs of an organism that can move.
    pub(super) fn discs_of(&self, id: OrganismId) -> impl Iterator<Item = usize> + '_ {
        let particles = self.organisms.get(id).into_iter().flat_map(Organism::particles).map(|i| i as usize);
        particles.filter(|&i| self.particles.inv_mass[i] > 0.0)
    }

    /// Multiplies the present size of a templated organism.
    fn shrink(&mut self, id: OrganismId, factor: f32) {
        self.set_scale(id, self.present_scale(id) * factor);
    }

    /// Size of an organism relative to its size when spawned.
    pub(super) fn present_scale(&self, id: OrganismId) -> f32 {
        self.organisms.get(id).map_or(1.0, |organism| self.scale_of(organism) / organism.spawn_scale)
    }

    /// Prey that was released gets its size back, slowly enough for what lies around it to give way.
    fn regrow_free_prey(&mut self) {
        let is_free = |organism: &Organism| organism.prey.is_some() && !organism.is_held() && !organism.is_quarantined;
        let free: Vec<OrganismId> = self.organisms.iter().filter(|(_, o)| is_free(o)).map(|(id, _)| id).collect();
        for id in free {
            let present = self.present_scale(id);
            if present < 1.0 {
                let grown = present + self.config.dt / REGROWTH_TIME;
                self.set_scale(id, if grown < 1.0 { grown } else { 1.0 });
            }
        }
    }

    /// Sets the size of a templated organism relative to its size when spawned.
    pub(super) fn set_scale(&mut self, id: OrganismId, factor: f32) {
        let Some(organism) = self.organisms.get(id) else { return };
        let Storage::Lane { block: index, first } = organism.body else { return };
        let block = &mut self.blocks[index as usize];
        let lane = (first - block.base) as usize;
        block.scale[lane] = organism.spawn_scale * factor;
        self.sleep.disturb(index, lane);
        for (slot, node) in self.templates[block.template as usize].nodes().iter().enumerate() {
            self.particles.radius[first as usize + slot * LANES] = node.radius * block.scale[lane];
        }
    }
}

/// Size of prey that is digested so far, relative to its size when it was taken in.
fn digested_scale(progress: f32) -> f32 {
    1.0 + (DIGESTED_SCALE - 1.0) * if progress < 1.0 { progress } else { 1.0 }
}

/// Particles of the front, sorted; none at rest.
pub(super) fn front_nodes(organism: &Organism) -> Vec<u32> {
    let Locomotion::Crawl { front_centre: Some(front) } = organism.locomotion else { return Vec::new() };
    let count = organism.outline.len() as u32;
    let is_front = |k: u32| region(k, front, count) == MembraneRegion::Front;
    let mut nodes: Vec<u32> =
        organism.outline_particles().zip(0..count).filter(|&(_, k)| is_front(k)).map(|(node, _)| node).collect();
    nodes.sort_unstable();
    nodes
}
