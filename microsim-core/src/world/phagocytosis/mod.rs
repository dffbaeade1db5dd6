//! Carries out what phagocytosis decides: encounters are counted, prey is taken in (see [`super::ingestion`]), digested and
//! removed, and its engulfer grows.

mod cup;
mod digestion;
mod encounter;
mod gate;
mod ingestion;
mod phagosome;

use crate::capability::phagocytosis::Engulfer;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::world::World;

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
}
