//! Calls that read everything there is to read: views, moments, reports, what was set.

use super::{Outcome, Sequence};
use microsim_core::{Inputs, OrganismView, Phase, View, World};

impl Sequence<'_> {
    /// Reads all, and takes a step of a clone that is watched: it is the same as one that is not.
    pub(super) fn look(&mut self) -> Outcome {
        let before = self.world.digest();
        let moment = self.world.moment();
        see(self.world.view());
        see(self.world.view_since(&moment, self.choices.range(0.0, 1.0)));
        self.report();
        let mut watched = self.world.clone();
        let mut stepped = self.world.clone();
        let was_recording = watched.record_changes(true);
        let mut phases = Vec::new();
        watched.step_observed(&self.inputs, |phase| phases.push(phase));
        stepped.step(&self.inputs);
        assert!(!was_recording && Phase::ALL.iter().all(|phase| phases.contains(phase)));
        assert_eq!(watched.digest(), stepped.digest(), "a step that is watched is another one");
        assert!(watched.first_difference(&stepped).is_none() && watched.first_difference(&self.world).is_some());
        see(watched.view_since(&moment, 0.5));
        assert_eq!(self.world.digest(), before, "looking has changed the world");
        Ok(())
    }

    /// What the world says of joints, sensors, fields, contacts and inputs.
    fn report(&mut self) {
        let place = self.place();
        let world = &self.world;
        assert!(world.field_at(place).is_finite() || !place.is_finite());
        assert!(world.joints().all(|joint| world.joint(joint.id) == Some(joint) && joint.force >= 0.0));
        for &obstacle in &self.obstacles {
            let is_known = world.obstacle(obstacle).is_some();
            assert!(is_known || world.obstacle_target(obstacle).is_none());
            // What has gone since the last step is still there.
            assert!(world.inside_sensor(obstacle).count() <= world.census().particles + 2500);
        }
        assert!(world.contact_reporting().is_some() || world.contacts().is_empty());
        assert!(self.handles.iter().all(|&id| world.contacts_of(id).count() <= world.contacts().len()));
        assert!(world.events().iter().all(|event| !format!("{event:?}").is_empty()));
        let templates = self.templates.iter().filter_map(|&id| Some((id, world.template(id)?)));
        let is_found = |name: &str| name.is_empty() == world.template_named(name).is_none();
        assert!(templates.map(|(_, template)| template.name()).all(is_found));
        let mut told = Inputs::new();
        told.replace_with(&self.inputs);
        assert_eq!(told, self.inputs);
        for (id, _) in self.inputs.iter() {
            told.remove(id);
            assert!(told.get(id).is_none() && self.inputs.get(id).is_some());
        }
        measure(world);
    }
}

fn measure(world: &World) {
    let census = world.census();
    assert!(census.organisms == world.organisms().count() && !format!("{:?}", world.quality()).is_empty());
    assert!(world.time() >= 0.0 && world.emitters().count() + world.drains().count() + world.fields().count() < 1000);
    for (_, chemical) in world.view().chemicals() {
        assert_eq!(chemical.values().len(), chemical.cells()[0] * chemical.cells()[1]);
        assert!(chemical.amount() >= 0.0 && chemical.gradient(world.config().size * 0.3).is_finite());
    }
}

/// Everything of a view is finite, and what belongs together agrees.
fn see(view: View<'_>) {
    assert!(view.bonds().flat_map(|(_, ends)| ends).chain(view.contacts().flatten()).all(|at| at.is_finite()));
    view.organisms().for_each(see_organism);
}

fn see_organism(organism: OrganismView<'_>) {
    let (low, high) = organism.bounds();
    assert!(low.cmple(high).all() && organism.centroid().is_finite() && organism.centre_of_mass().is_finite());
    assert_eq!(organism.outline().len(), organism.surface().len());
    assert!(organism.velocity().is_finite() && organism.angular_velocity().is_finite() && organism.mass() >= 0.0);
    assert!(organism.angle().is_none_or(f32::is_finite));
    assert!(organism.template().is_some() || organism.template_name().is_none());
    let is_damped = [organism.linear_damping(), organism.angular_damping()].iter().all(|damping| *damping >= 0.0);
    assert!(is_damped && organism.scale() > 0.0 && organism.speed() >= 0.0 && organism.gravity_scale().is_finite());
    let outline = organism.outline().len();
    assert!(organism.front_index().is_none_or(|k| k < outline) && organism.front().is_none_or(|at| at.is_finite()));
    assert!(organism.membrane_regions().is_none_or(|regions| regions.len() == outline));
    assert!(organism.protrusion().is_none_or(|shares| shares.len() == outline));
    assert!(organism.phagosomes().all(|(_, ring)| ring.len() > 2));
    assert!(organism.meals().count() == 0 || organism.phagocytosis().is_some());
    assert!(organism.stalled_for() >= 0.0 && organism.dividing_for().is_none_or(|time| time >= 0.0));
    assert!(organism.cytoplasm_area() >= 0.0 && organism.spawn_area().is_finite());
    assert!(organism.goal().is_none_or(|goal| goal.is_finite()) && organism.tier().is_none_or(|tier| tier < 32));
    let words = format!("{:?} {:?} {:?}", organism.controller(), organism.exchanges(), organism.drawn_look());
    assert!(!words.is_empty());
    let (is_prey, is_held) = (organism.prey_class().is_some(), organism.held_by().is_some());
    assert!(is_prey || !is_held);
    let states = [organism.is_full(), organism.is_at_rest(), organism.is_quarantined(), organism.nucleus().is_some()];
    assert!(states.iter().filter(|state| **state).count() <= 4 && organism.user_data() < u128::MAX);
}
