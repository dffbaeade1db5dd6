//! Phagosomes: membranes around prey inside a cell; also the area and the membrane that prey takes up in its engulfer.

use crate::capability::phagocytosis::{Engulfer, IngestionWay, Meal, MealPhase};
use crate::id::OrganismId;
use crate::organism::at_most;
use crate::organism::ring_surgery::{free_nodes, take_out};
use crate::world::World;
use std::f32::consts::{PI, TAU};

/// Time in which the membrane lengthens by what a fold needs, s.
const FOLDING_TIME: f32 = 0.8;
/// Fewest nodes of a phagosome.
pub(super) const LEAST_NODES: usize = 5;
/// Area of a phagosome over that of its prey.
const AREA_RATIO: f32 = 1.1;

impl World {
    /// Fits phagosomes to the size of their prey and removes those whose prey is gone; returns whether any was removed.
    pub(in crate::world) fn advance_phagosomes(&mut self, id: OrganismId, engulfer: &Engulfer) -> bool {
        let changes = self.membrane_changes();
        let mut phagosomes = self.organisms.get_mut(id).map_or(Vec::new(), |o| std::mem::take(&mut o.phagosomes));
        for phagosome in &mut phagosomes {
            phagosome.area = at_most(AREA_RATIO * self.area_of(phagosome.prey));
        }
        let Self { organisms, particles, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return false };
        let count = phagosomes.len();
        phagosomes.retain_mut(|phagosome| {
            let has_prey = engulfer.meals.iter().any(|meal| meal.prey == phagosome.prey);
            if !has_prey {
                free_nodes(organism, &phagosome.ring, particles);
            }
            let wanted = phagosome.membrane.rest_perimeter() / phagosome.membrane.rest_length;
            for _ in (0..changes).filter(|_| has_prey) {
                if wanted < phagosome.ring.len() as f32 - 0.5 && phagosome.ring.len() > LEAST_NODES {
                    free_nodes(organism, take_out(&mut phagosome.ring, particles).as_slice(), particles);
                }
            }
            has_prey
        });
        organism.phagosomes = phagosomes;
        organism.phagosomes.len() < count
    }

    /// Area of all prey inside an engulfer or passing its gate, phagosomes included.
    pub(in crate::world) fn held_area(&self, id: OrganismId, engulfer: &Engulfer) -> f32 {
        let node_radius = self.organisms.get(id).and_then(|o| o.body.membrane()).map_or(0.0, |m| m.node_radius);
        let takes_room = |meal: &&Meal| !matches!(meal.phase, MealPhase::Touching(_)) && !meal.is_in_cup();
        let area = |meal: &Meal| {
            let area = self.area_of(meal.prey);
            let radius = (area / PI).sqrt() + 2.0 * node_radius;
            if meal.way == IngestionWay::Cup { PI * radius * radius } else { area }
        };
        at_most(engulfer.meals.iter().filter(takes_room).map(area).sum())
    }

    /// Length of membrane that the cups around prey need now.
    pub(in crate::world) fn fold_length(&self, id: OrganismId, engulfer: &Engulfer) -> f32 {
        let membrane = self.organisms.get(id).and_then(|organism| organism.body.membrane());
        let node_radius = membrane.map_or(0.0, |membrane| membrane.node_radius);
        let length = |meal: &Meal| {
            let MealPhase::Ingesting(elapsed) = meal.phase else { return 0.0 };
            let part = if elapsed < FOLDING_TIME { elapsed / FOLDING_TIME } else { 1.0 };
            part * TAU * ((self.area_of(meal.prey) / PI).sqrt() + 2.0 * node_radius)
        };
        at_most(engulfer.meals.iter().filter(|meal| meal.is_in_cup()).map(length).sum())
    }
}
