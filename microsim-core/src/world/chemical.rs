//! Behaviour at the world's own request: controllers that change while it runs, chemicals, and who secretes what.

use super::World;
use crate::capability::Locomotion;
use crate::capability::controller::Controller;
use crate::capability::exchange::Exchange;
use crate::chemical::{Chemical, ChemicalSpec};
use crate::error::{Error, ErrorKind};
use crate::id::{ChemicalId, OrganismId};

impl World {
    /// Gives an organism another controller. Inputs still come first.
    ///
    /// # Errors
    /// When the handle is stale, a field is out of range, the controller goes by a chemical that this world does not have, or
    /// the organism cannot move or has no outline to sense with.
    pub fn set_controller(&mut self, id: OrganismId, controller: Controller) -> Result<(), Error> {
        self.organism_or_stale(id, "organism")?;
        controller.validate().map_err(|error| error.within("controller"))?;
        if let Some(organism) = self.organisms.get(id) {
            self.check_controller(&controller, &organism.locomotion, !organism.outline.is_empty())?;
        }
        self.organisms.get_mut(id).into_iter().for_each(|organism| organism.controller = controller.clone());
        Ok(())
    }

    /// Adds a chemical, in the concentration that its spec says.
    ///
    /// # Errors
    /// Names the field out of its range, which may depend on the room and the time step.
    pub fn add_chemical(&mut self, spec: ChemicalSpec) -> Result<ChemicalId, Error> {
        let mut chemical = Chemical::new(spec, &self.config)?;
        for obstacle in self.obstacles() {
            chemical.close(|at| obstacle.nearest(at).1);
        }
        self.chemicals.push(chemical);
        Ok(ChemicalId(self.chemicals.len() as u32 - 1))
    }

    /// Lets an organism secrete and take up a chemical, in place of what it did with that one before.
    ///
    /// # Errors
    /// When the organism or the chemical does not exist, or a number is out of range.
    pub fn set_exchange(&mut self, id: OrganismId, exchange: Exchange) -> Result<(), Error> {
        exchange.validate()?;
        self.check_chemical(exchange.chemical, "chemical")?;
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        organism.exchanges.retain(|other| other.chemical != exchange.chemical);
        organism.exchanges.push(exchange);
        Ok(())
    }

    /// Checks that a controller suits an organism of this world.
    pub(super) fn check_controller(
        &self,
        controller: &Controller,
        locomotion: &Locomotion,
        has_outline: bool,
    ) -> Result<(), Error> {
        controller.chemicals().try_for_each(|chemical| self.check_chemical(chemical, "controller.chemical"))?;
        if *locomotion == Locomotion::None && *controller != Controller::Still {
            return Err(Error::unsupported("controller", "an organism that moves"));
        }
        if controller.needs_outline() && !has_outline {
            return Err(Error::unsupported("controller", "an organism with an outline, to sense with"));
        }
        Ok(())
    }

    pub(super) fn check_chemical(&self, id: ChemicalId, field: &str) -> Result<(), Error> {
        let is_known = (id.0 as usize) < self.chemicals.len();
        is_known.then_some(()).ok_or_else(|| Error::reference(field, "a chemical of this world"))
    }
}
