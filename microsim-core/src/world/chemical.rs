//! Chemicals, and which organisms secrete and take them up.

use super::World;
use super::change::WorldChange;
use crate::capability::exchange::Exchange;
use crate::chemical::{Chemical, ChemicalSpec};
use crate::error::{Error, ErrorKind};
use crate::float_environment::with_default_float_environment;
use crate::id::{ChemicalId, OrganismId};

impl World {
    /// Adds a chemical, in the concentration that its spec says.
    ///
    /// # Errors
    /// Names the field out of its range, which may depend on the room and the time step.
    pub fn add_chemical(&mut self, spec: ChemicalSpec) -> Result<ChemicalId, Error> {
        let id = with_default_float_environment(|| self.insert_chemical(spec))?;
        self.changed(|| WorldChange::AddChemical(spec));
        Ok(id)
    }

    fn insert_chemical(&mut self, spec: ChemicalSpec) -> Result<ChemicalId, Error> {
        let mut chemical = Chemical::new(spec, &self.config)?;
        for obstacle in self.solid_obstacles().filter(|obstacle| obstacle.stops_chemicals()) {
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
        with_default_float_environment(|| exchange.validate())?;
        self.check_chemical(exchange.chemical, "chemical")?;
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        organism.exchanges.retain(|other| other.chemical != exchange.chemical);
        organism.exchanges.push(exchange);
        self.changed(|| WorldChange::SetExchange(id, exchange));
        Ok(())
    }

    pub(super) fn check_chemical(&self, id: ChemicalId, field: &str) -> Result<(), Error> {
        let is_known = (id.0 as usize) < self.chemicals.len();
        is_known.then_some(()).ok_or_else(|| Error::reference(field, "a chemical of this world"))
    }
}
