//! What changes hands when one cell becomes two, or two one: nodes, cytoplasm, prey and phagosomes, with all tables that
//! name them.

use super::World;
use crate::capability::Locomotion;
use crate::capability::phagocytosis::{Engulfer, Meal};
use crate::event::Event;
use crate::geometry::polygon::{centroid, contains_point};
use crate::id::OrganismId;
use crate::organism::ring_surgery::{Swap, set_outline};
use crate::organism::{Organism, Phagosome, Storage};
use crate::rng::Rng;
use glam::Vec2;

/// Part of a cell: a ring, and what is in it.
struct Lobe {
    outline: Vec<u32>,
    fluid_particles: Vec<u32>,
    meals: Vec<Meal>,
    phagosomes: Vec<Phagosome>,
    centre: Vec2,
    /// Share of the cell's cytoplasm.
    share: f32,
}

impl World {
    /// Makes one cell two: the lobe that is cut off becomes an organism of its own, like the first in everything but its
    /// handle and its random numbers.
    pub(super) fn split(&mut self, id: OrganismId, swap: &Swap) {
        let Some(parent) = self.organisms.get(id) else { return };
        let (left, cut) = swap.cut(&parent.outline);
        let (left, cut) = (self.lobe(parent, left), self.lobe(parent, cut));
        let mut daughter = parent.clone();
        let daughter_id = self.organisms.next_id();
        daughter.rng = Rng::new(self.config.seed, daughter_id.stream());
        daughter.home = cut.centre;
        daughter.engulfer = daughter.engulfer.map(|engulfer| Engulfer::new(engulfer.params));
        daughter.fluid = daughter.fluid.map(|fluid| {
            let fluid = &self.fluids[fluid as usize];
            let (params, is_enclosed) = (fluid.params, fluid.is_enclosed);
            self.fluid_for(params, is_enclosed) as u32
        });
        let fluid = self.organisms.get(id).and_then(|parent| parent.fluid);
        self.exemptions.inherit(id.index, daughter_id.index);
        self.organisms.insert(daughter);
        self.rehome_fluid(&cut.fluid_particles, fluid, daughter_id);
        self.move_meals(&cut.meals, id, daughter_id);
        self.round_off(id, left);
        self.round_off(daughter_id, cut);
        self.events.push(Event::Divided { parent: id, daughter: daughter_id });
    }

    /// What a ring of a cell encloses.
    fn lobe(&self, cell: &Organism, outline: Vec<u32>) -> Lobe {
        let ring: Vec<Vec2> = outline.iter().map(|&i| self.particles.position(i as usize)).collect();
        let is_inside = |i: u32| contains_point(&ring, self.particles.position(i as usize));
        let fluid_particles: Vec<u32> = cell.fluid_particles.iter().copied().filter(|&i| is_inside(i)).collect();
        let holds = |meal: &&Meal| self.discs_of(meal.prey).next().is_some_and(|i| is_inside(i as u32));
        let meals = cell.engulfer.iter().flat_map(|engulfer| &engulfer.meals).filter(|meal| meal.phase.is_inside());
        let meals: Vec<Meal> = meals.filter(holds).cloned().collect();
        let is_of_meal = |inner: &&Phagosome| meals.iter().any(|meal| meal.prey == inner.prey);
        Lobe {
            phagosomes: cell.phagosomes.iter().filter(is_of_meal).cloned().collect(),
            share: fluid_particles.len() as f32 / cell.fluid_particles.len() as f32,
            centre: centroid(&ring).unwrap_or(cell.home),
            outline,
            fluid_particles,
            meals,
        }
    }

    /// Makes a lobe of a divided cell a cell at rest.
    fn round_off(&mut self, id: OrganismId, lobe: Lobe) {
        let Self { organisms, particles, fluids, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return };
        let before = organism.outline.len();
        if let Storage::Loose { particles: body, membrane: Some(membrane) } = &mut organism.body {
            *membrane = membrane.resized(before, lobe.outline.len());
            *body = lobe.outline.iter().chain(lobe.phagosomes.iter().flat_map(|inner| &inner.ring)).copied().collect();
            body.iter().for_each(|&node| particles.owner[node as usize] = id.index);
        }
        organism.phagosomes = lobe.phagosomes;
        organism.fluid_particles = lobe.fluid_particles;
        organism.spawn_area *= lobe.share;
        organism.locomotion = Locomotion::Crawl { front_centre: None };
        organism.goal = None;
        set_outline(organism, lobe.outline, particles);
        organism.divider.iter_mut().for_each(|divider| divider.end());
        organism.adapt_nodes(fluids);
    }

    /// Gives a cell everything that another one consisted of, within one outline.
    pub(super) fn adopt(&mut self, id: OrganismId, other: Organism, outline: Vec<u32>) {
        let Some(by) = self.organisms.get(id).map(|cell| self.origin_of(cell) - self.origin_of(&other)) else { return };
        for i in other.particles() {
            self.particles.owner[i as usize] = id.index;
            self.particles.shift_origin(i as usize, by);
        }
        self.rehome_fluid(&other.fluid_particles, other.fluid, id);
        let Self { organisms, particles, .. } = self;
        let Some(cell) = organisms.get_mut(id) else { return };
        let before = cell.outline.len();
        if let (Storage::Loose { particles: body, membrane: Some(membrane) }, Storage::Loose { particles: added, .. }) =
            (&mut cell.body, &other.body)
        {
            body.extend(added);
            *membrane = membrane.resized(before, outline.len());
        }
        cell.fluid_particles.extend(&other.fluid_particles);
        cell.phagosomes.extend(other.phagosomes);
        cell.spawn_area += other.spawn_area;
        let pending = other.engulfer.map_or(0.0, |engulfer| engulfer.pending_growth);
        cell.engulfer.iter_mut().for_each(|engulfer| engulfer.pending_growth += pending);
        set_outline(cell, outline, particles);
    }

    /// Point that the coordinates of an organism with a body are relative to.
    fn origin_of(&self, organism: &Organism) -> Vec2 {
        organism.first_node().map_or(Vec2::ZERO, |i| self.particles.origin(i as usize))
    }

    /// Moves cytoplasm from one fluid to that of another cell.
    pub(super) fn rehome_fluid(&mut self, moving: &[u32], from: Option<u32>, to: OrganismId) {
        let Self { organisms, particles, fluids, .. } = self;
        let Some(into) = organisms.get(to).and_then(|organism| organism.fluid) else { return };
        for &i in moving {
            particles.owner[i as usize] = to.index;
            particles.fluid[i as usize] = into + 1;
        }
        if let Some(from) = from {
            fluids[from as usize].particles.retain(|&i| particles.fluid[i as usize] == from + 1);
        }
        fluids[into as usize].particles.extend(moving);
    }

    /// Hands prey that is inside from one cell to another.
    pub(super) fn move_meals(&mut self, meals: &[Meal], from: OrganismId, to: OrganismId) {
        for meal in meals {
            self.organisms.get_mut(meal.prey).into_iter().for_each(|prey| prey.set_held_by(Some(to)));
        }
        let stays = |meal: &Meal| meals.iter().all(|moved| moved.prey != meal.prey);
        self.change_engulfer(from, |engulfer| engulfer.meals.retain(stays));
        self.change_engulfer(to, |engulfer| engulfer.meals.extend(meals.iter().cloned()));
    }

    fn change_engulfer(&mut self, id: OrganismId, change: impl FnOnce(&mut Engulfer)) {
        let engulfer = self.organisms.get_mut(id).and_then(|organism| organism.engulfer.take());
        let Some(mut engulfer) = engulfer else { return };
        change(&mut engulfer);
        engulfer.held_area = self.held_area(id, &engulfer);
        self.organisms.get_mut(id).into_iter().for_each(|organism| organism.engulfer = Some(engulfer.clone()));
    }
}
