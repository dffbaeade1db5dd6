//! Drives of phagocytosis: prey is pulled into the cell, and the lips of a cup close around it.

pub(crate) mod lips;

use super::{heading, position_of};
use crate::capability::phagocytosis::MealPhase;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::solver::drive::Drive;

/// Draws prey that is being taken in towards the centroid of who takes it in (thesis, 3.1.3).
pub(crate) fn draw_in_prey(organisms: &Organisms, particles: &Particles, drives: &mut Vec<Drive>) {
    for (_, organism) in organisms.with_membrane() {
        let Some(engulfer) = &organism.engulfer else { continue };
        let taken_in = engulfer.meals.iter().filter(|meal| matches!(meal.phase, MealPhase::Ingesting(_)));
        for meal in taken_in {
            let Some(prey) = organisms.get(meal.prey) else { continue };
            let inwards = heading(position_of(organism, particles) - position_of(prey, particles));
            let velocity = if meal.is_expelled { -inwards } else { inwards } * engulfer.params.pull_speed;
            let pull = |particle| Drive::new(particle, velocity, engulfer.params.pull_acceleration);
            drives.extend(prey.particles().map(pull));
        }
    }
}
