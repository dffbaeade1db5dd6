//! Controllers that change while the world runs.

use super::World;
use super::change::WorldChange;
use crate::capability::Locomotion;
use crate::capability::controller::Controller;
use crate::error::Error;
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;

impl World {
    /// Gives an organism another controller. Inputs still come first.
    ///
    /// # Errors
    /// When the handle is stale, a field is out of range, the controller senses a chemical that this world does not have, the
    /// organism cannot move or has no outline to sense with, it could not follow a random walk, or the room has periodic sides.
    pub fn set_controller(&mut self, id: OrganismId, controller: Controller) -> Result<(), Error> {
        self.organism_or_stale(id, "organism")?;
        with_default_float_environment(|| controller.validate()).map_err(|error| error.within("controller"))?;
        if let Some(organism) = self.organisms.get(id) {
            self.check_controller(&controller, &organism.locomotion, organism.speed, !organism.outline.is_empty())?;
        }
        if let Some(organism) = self.organisms.get_mut(id) {
            organism.controller = controller.clone();
        }
        self.changed(|| WorldChange::SetController(id, Box::new(controller)));
        Ok(())
    }

    /// Checks that a controller suits an organism of this world.
    pub(super) fn check_controller(
        &self,
        controller: &Controller,
        locomotion: &Locomotion,
        speed: f32,
        has_outline: bool,
    ) -> Result<(), Error> {
        self.check_periodic_controller(controller)?;
        controller.chemicals().try_for_each(|chemical| self.check_chemical(chemical, "controller.chemical"))?;
        if *locomotion == Locomotion::None && *controller != Controller::Still {
            return Err(Error::unsupported("controller", "an organism that moves"));
        }
        if controller.needs_outline() && !has_outline {
            return Err(Error::unsupported("controller", "an organism with an outline, to sense with"));
        }
        controller.check_body(locomotion, speed, &self.config)
    }
}
