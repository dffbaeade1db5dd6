//! Phagocytosis: how a cell takes in prey, digests it and grows. Each file is one part of it, in the order of a meal:
//! [`encounter`], [`ingestion`] through a [`gate`] or by a [`cup`], [`phagosome`], [`digestion`].
//!
//! The conditions and parameters are in [`crate::capability::phagocytosis`]; the forces on prey and on the lips of a cup in
//! [`crate::behavior::phagocytosis`].

mod cup;
mod digestion;
mod encounter;
mod gate;
mod ingestion;
mod phagosome;

use crate::capability::phagocytosis::{Engulfer, Meal};
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::world::World;
use encounter::NearPrey;

impl World {
    /// Advances all engulfers by a step: encounters, ingestion, digestion and growth.
    pub(crate) fn advance_phagocytosis(&mut self) {
        self.regrow_free_prey();
        let engulfers: Vec<OrganismId> = self
            .organisms
            .with_membrane()
            .filter(|(_, o)| o.engulfer.is_some() && !o.is_quarantined)
            .map(|(id, _)| id)
            .collect();
        let near_prey = if engulfers.is_empty() { NearPrey::default() } else { self.near_prey() };
        for id in engulfers {
            // A cell that is held, perhaps only now, takes nothing in.
            let free = self.organisms.get_mut(id).filter(|organism| !organism.is_held());
            let Some(mut engulfer) = free.and_then(|organism| organism.engulfer.take()) else { continue };
            self.remove_lost_meals(&mut engulfer);
            let encounters = self.encounters(id, engulfer.params.way, &near_prey);
            for k in engulfer.advance_touching(&encounters, self.config.dt) {
                self.begin_ingestion(id, &mut engulfer.meals[k], &engulfer.params);
            }
            (0..self.membrane_changes()).for_each(|_| self.lengthen_gate(id, &engulfer));
            let held = engulfer.meals.len();
            self.advance_ingestion(id, &mut engulfer);
            self.advance_digestion(id, &mut engulfer);
            let is_folded = engulfer.fold_length > 0.0;
            let has_removed = self.advance_phagosomes(id, &engulfer);
            engulfer.held_area = self.held_area(id, &engulfer);
            engulfer.fold_length = self.fold_length(id, &engulfer);
            let has_spare_nodes =
                has_removed || engulfer.meals.len() < held || (is_folded && engulfer.fold_length == 0.0);
            if let Some(organism) = self.organisms.get_mut(id) {
                organism.engulfer = Some(engulfer);
                if has_spare_nodes {
                    organism.update_wanted_nodes(&self.fluids);
                }
            }
            (0..self.membrane_changes()).for_each(|_| self.grow_from_digestion(id));
        }
    }

    /// Releases all prey of an organism that is about to be removed or was frozen.
    pub(crate) fn release_meals(&mut self, id: OrganismId) {
        let engulfer = self.organisms.get_mut(id).and_then(|organism| organism.engulfer.as_mut());
        for meal in engulfer.map_or(Vec::new(), |engulfer| std::mem::take(&mut engulfer.meals)) {
            self.release_prey(&meal);
        }
    }

    /// Removes meals whose prey was removed from the world or is frozen.
    fn remove_lost_meals(&mut self, engulfer: &mut Engulfer) {
        engulfer.meals.retain(|meal| {
            let is_alive = self.organisms.get(meal.prey).is_some_and(|prey| !prey.is_quarantined);
            if !is_alive {
                self.release_prey(meal);
            }
            is_alive
        });
    }

    /// Closes the gate for prey and lets it go.
    fn release_prey(&mut self, meal: &Meal) {
        self.exemptions.close_gate(&meal.gate, meal.prey.index);
        if self.organisms.get(meal.prey).is_some_and(Organism::is_held) {
            self.set_held_by(meal.prey, None);
        }
    }

    /// Notes which engulfer holds an organism, if any.
    pub(super) fn set_held_by(&mut self, prey: OrganismId, engulfer: Option<OrganismId>) {
        if let Some(prey) = self.organisms.get_mut(prey) {
            prey.set_held_by(engulfer);
        }
    }
}
