//! Behaviour: how organisms choose a goal, and the drives that move them and their prey.

pub(crate) mod actuation;
pub(crate) mod crawl;
pub(crate) mod exchange;
pub(crate) mod front_pull;
pub(crate) mod furrow_pull;
pub(crate) mod phagocytosis;
pub(crate) mod sensing;
mod tow;

use crate::capability::Locomotion;
use crate::capability::controller::Controller;
use crate::capability::controller::senses::{Environment, Senses, Steering};
use crate::event::Event;
use crate::id::OrganismId;
use crate::inputs::Inputs;
use crate::organism::Organism;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::solver::drive::{Drive, Tow};
use glam::Vec2;
use sensing::OwnBody;

/// Turns inputs and controllers into the drives of this step.
pub(crate) fn steer_organisms(
    organisms: &mut Organisms,
    inputs: &Inputs,
    particles: &Particles,
    environment: &Environment<'_>,
    drives: &mut Vec<Drive>,
    tows: &mut Vec<Tow>,
    events: &mut Vec<Event>,
) {
    drives.clear();
    tows.clear();
    let can_move = |organism: &Organism| !organism.is_quarantined && organism.locomotion != Locomotion::None;
    for (id, organism) in organisms.iter_mut(can_move) {
        let body = OwnBody::of(organism, particles);
        let senses = body.senses(id, organism, environment);
        let before = tow::wanted_velocity(organism, senses.at);
        let own = decide(organism, &senses);
        let intent = inputs.get(id);
        let nearest = |goal: Vec2| Steering::to(environment.period.nearest_image(goal, senses.at));
        let steering = intent.map_or(own, |intent| intent.goal().map(nearest));
        let may_move = organism.obey(intent.is_some_and(|intent| intent.digests())) && !organism.is_held();
        organism.goal = steering.filter(|steering| may_move && steering.relative_speed != 0.0).map(|it| it.goal);
        organism.relative_speed = steering.map_or(1.0, |steering| steering.relative_speed);
        if let Locomotion::Tow { max_acceleration } = organism.locomotion {
            let is_hindered = !tow::follows(senses.velocity, before);
            organism.progress.note(organism.goal.is_some() && is_hindered, &senses);
            // What nobody steers is moved by others only, and does not brake.
            if intent.is_some() || organism.controller != Controller::Still {
                tows.extend(tow::tow(organism, senses.at, steering, before, max_acceleration));
            }
        } else {
            organism.progress.note(organism.goal.is_some(), &senses);
            move_towards(id, organism, particles, environment.dt, drives, events);
        }
    }
}

/// The steering of an organism's controller, or its way out while it is stuck.
fn decide(organism: &mut Organism, senses: &Senses<'_>) -> Option<Steering> {
    let Organism { controller, progress, rng, .. } = organism;
    let steering = controller.decide(senses, rng)?;
    let way_out = if controller.insists() { None } else { progress.way_out(steering, senses, rng) };
    if let Some(escape) = way_out {
        controller.head(heading(escape.goal - senses.at));
    }
    Some(way_out.unwrap_or(steering))
}

fn move_towards(
    id: OrganismId,
    organism: &mut Organism,
    particles: &Particles,
    dt: f32,
    drives: &mut Vec<Drive>,
    events: &mut Vec<Event>,
) {
    let goal = organism.goal;
    match organism.locomotion {
        Locomotion::None | Locomotion::Tow { .. } => {}
        Locomotion::FrontPull { front } => {
            let Some(goal) = goal else { return };
            let new_front = front_pull::drive(organism, front, goal, particles, drives);
            if new_front != front {
                events.push(Event::FrontSwitched { organism: id });
                organism.locomotion = Locomotion::FrontPull { front: new_front };
            }
        }
        Locomotion::Crawl { .. } => {
            let front_centre = goal.and_then(|goal| crawl::front_and_rear::drive(organism, goal, particles, drives));
            organism.locomotion = Locomotion::Crawl { front_centre };
        }
        Locomotion::Protrude(_) => crawl::pseudopods::protrude(organism, particles, dt, drives),
        Locomotion::Propel { max_acceleration } => {
            let Some(goal) = goal else { return };
            let velocity = heading(goal - position_of(organism, particles)) * organism.present_speed();
            drives.extend(organism.particles().map(|particle| Drive::new(particle, velocity, max_acceleration)));
        }
    }
}

/// Unit vector of a displacement, or zero for none.
pub(crate) fn heading(way: Vec2) -> Vec2 {
    crate::geometry::ring::direction_or(way, Vec2::ZERO)
}

/// Position of an organism for its controller: the mean of its outline, or its first particle.
pub(crate) fn position_of(organism: &Organism, particles: &Particles) -> Vec2 {
    let count = organism.outline.len();
    if count == 0 {
        return organism.particles().next().map_or(organism.home, |i| particles.position(i as usize));
    }
    organism.outline_particles().map(|i| particles.position(i as usize)).sum::<Vec2>() / count as f32
}
