//! Cells that change their membrane: growth, shrinkage, division (with its furrow) and fusion.
//!
//! Parameters and state are in [`crate::capability::division`], the contraction of the furrow in
//! [`crate::behavior::furrow_pull`], changes of single rings in [`crate::organism::ring_surgery`].

mod division;
mod furrow;
mod furrow_plan;
mod fusion;
mod growth;
mod shrinkage;
mod transfer;

use crate::capability::division::{Divider, Order};
use crate::capability::phagocytosis::{Meal, MealPhase};
use crate::error::{Error, ErrorKind};
use crate::event::Refusal;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::world::World;
use crate::world::change::WorldChange;

/// Rate of changes that a membrane can follow, 1/s: nodes put in or taken out, particles of cytoplasm added.
const CHANGE_RATE: f64 = 60.0;

impl World {
    /// Number of such changes of each membrane in this step: their rate does not depend on its length.
    pub(in crate::world) fn membrane_changes(&self) -> u32 {
        let by = |step: u64| (step as f64 * f64::from(self.config.dt) * CHANGE_RATE) as u64;
        (by(self.step_index + 1) - by(self.step_index)) as u32
    }

    /// Advances all cells that divide or fuse by a step, and the membranes that adapt to their content.
    pub(crate) fn divide_and_fuse(&mut self) {
        let dt = self.config.dt;
        let cells = self.organisms.with_membrane().filter(|(_, organism)| organism.divider.is_some());
        for id in cells.map(|(id, _)| id).collect::<Vec<_>>() {
            match self.divider_mut(id).and_then(|divider| divider.order.take()) {
                Some(Order::Divide { axis }) => self.begin_division(id, axis),
                Some(Order::Fuse { with }) => self.try_fusion(id, with),
                None => {}
            }
            if self.organisms.get(id).is_some_and(Organism::rounds_up) {
                self.centre_furrow(id);
            } else {
                if let Some(divider) = self.divider_mut(id) {
                    divider.relax(dt);
                }
                self.advance_furrow(id);
            }
            (0..self.membrane_changes()).for_each(|_| self.adapt_membrane(id));
        }
    }

    /// Stores an order, which the next step carries out.
    pub(in crate::world) fn give_order(&mut self, id: OrganismId, order: Order) -> Result<(), Error> {
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        let is_cell = organism.body.membrane().is_some();
        let (accepted, can_obey) = match order {
            Order::Divide { axis: None } => ("an amoeboid cell, or a body whose template has a cut", true),
            Order::Divide { axis: Some(_) } | Order::Fuse { .. } => ("an amoeboid cell", is_cell),
        };
        let divider = organism.divider.as_mut().filter(|_| can_obey);
        divider.ok_or_else(|| Error::unsupported("organism", accepted))?.order = Some(order);
        self.changed(|| WorldChange::Order(id, order));
        Ok(())
    }

    pub(in crate::world) fn divider_mut(&mut self, id: OrganismId) -> Option<&mut Divider> {
        self.organisms.get_mut(id).and_then(|organism| organism.divider.as_mut())
    }

    /// The reason why a cell cannot divide or fuse now, if there is one.
    pub(in crate::world) fn refusal_of_free(organism: &Organism) -> Option<Refusal> {
        if organism.is_held() { Some(Refusal::Held) } else { Self::refusal(organism) }
    }

    /// The reason why the nodes of a membrane have to stay as many as they are now, if there is one.
    pub(in crate::world) fn refusal(organism: &Organism) -> Option<Refusal> {
        let ingests = |meal: &Meal| matches!(meal.phase, MealPhase::Ingesting(_));
        if organism.is_quarantined {
            Some(Refusal::Quarantined)
        } else if organism.furrow().is_some() {
            Some(Refusal::Dividing)
        } else if organism.meals().iter().any(ingests) {
            Some(Refusal::Ingesting)
        } else {
            None
        }
    }
}
