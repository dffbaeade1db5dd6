//! Actuation: inputs from outside become forces, and changes of velocity at once.

use crate::actuation::Actuation;
use crate::geometry::period::Period;
use crate::inputs::Inputs;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::particle::mass_properties::MassProperties;
use crate::solver::force::{self, Force, Forces};

/// Turns what acts on organisms into the forces of a step of `dt` seconds; impulses act at once. Nothing acts on what is gone
/// or frozen.
pub(crate) fn actuate(
    organisms: &Organisms,
    inputs: &Inputs,
    particles: &mut Particles,
    forces: &mut Forces,
    dt: f32,
    period: Period,
) {
    for (id, node, actuation) in inputs.actuations() {
        let Some(organism) = organisms.get(id).filter(|organism| !organism.is_quarantined) else { continue };
        let on: Vec<u32> = match node {
            None => organism.particles().collect(),
            Some(node) => organism.particle_of(node).into_iter().collect(),
        };
        // Free fluid all around a room that repeats has no centre.
        let has_centre = period.is_none() || node.is_some() || !organism.is_free_fluid();
        let Actuation { torque, target, .. } = actuation;
        let (torque, target) = if has_centre { (torque, target) } else { (0.0, None) };
        act(Actuation { torque, target, ..actuation }, &on, particles, forces, dt, period);
    }
}

fn act(actuation: Actuation, on: &[u32], particles: &mut Particles, forces: &mut Forces, dt: f32, period: Period) {
    let Some(body) = MassProperties::of(particles, on) else { return };
    force::push(particles, on, actuation.impulse);
    let velocity = actuation.target.map(|target| {
        let at = body.position(particles);
        (period.nearest_image(target, at) - at) / dt
    });
    forces.add(on, Force { acceleration: actuation.force / body.mass, torque: actuation.torque, velocity });
}
