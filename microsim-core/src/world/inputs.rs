//! Inputs that name what this world has.

use super::World;
use crate::capability::Locomotion;
use crate::error::Error;
use crate::id::OrganismId;
use crate::inputs::Inputs;
use crate::organism::Organism;

impl World {
    /// Checks that the next step will carry out all of these inputs: it ignores what it cannot.
    ///
    /// # Errors
    /// When a handle is stale, a goal is for an organism that does not move by itself, an actuation is on a node that does not
    /// exist, or an activation is of a channel that its template does not declare.
    pub fn check_inputs(&self, inputs: &Inputs) -> Result<(), Error> {
        for (id, intent) in inputs.iter() {
            let organism = self.named(id, "intent.organism")?;
            if intent.goal().is_some() && organism.locomotion == Locomotion::None {
                return Err(Error::unsupported(
                    "intent.goal",
                    "an organism that moves, or a template with a propulsion",
                ));
            }
        }
        for (id, node, actuation) in inputs.actuations() {
            let organism = self.named(id, "actuation.organism")?;
            let needs_centre = node.is_none() && (actuation.torque != 0.0 || actuation.target.is_some());
            if needs_centre && organism.is_free_fluid() && !self.period().is_none() {
                return Err(Error::unsupported("actuation", "a force or an impulse on fluid with periodic sides"));
            }
            if node.is_some_and(|node| organism.particle_of(node).is_none()) {
                let accepted = format!("a node below {}", organism.particles().count());
                return Err(Error::reference("actuation.node", accepted));
            }
        }
        for (id, channel, _) in inputs.activations() {
            let template = self.named(id, "activation.organism").map(|_| self.view().organism(id)?.template())?;
            let channels = template.map_or(0, |id| self.templates[id.0 as usize].channels().len());
            if channel as usize >= channels {
                return Err(Error::reference(
                    "activation.channel",
                    format!("one of the {channels} channels of its template"),
                ));
            }
        }
        Ok(())
    }

    fn named(&self, id: OrganismId, field: &str) -> Result<&Organism, Error> {
        self.organism_or_stale(id, field)?;
        self.organisms.get(id).ok_or_else(|| Error::reference(field, "an organism"))
    }
}
