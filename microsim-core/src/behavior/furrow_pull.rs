//! The furrow of a dividing cell: the two sides of its equator are drawn towards each other, as by a contractile ring.

use super::{heading, position_of};
use crate::organism::Organism;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::solver::contraction::Contraction;
use crate::solver::drive::Drive;

/// Speeds of approach at the bottom of the furrow and at the nodes next to it, relative to the furrow's.
const SLOPE: [f32; 3] = [1.0, 0.8, 0.5];
/// Width of the neck, in rest lengths, below which the furrow closes from its bottom outwards, each pair of nodes when the
/// one before is at most `SHUT` apart. All pairs at once would enclose cytoplasm.
const NARROW: f32 = 3.5;
const SHUT: f32 = 1.3;

/// Distance between prey inside and the plane of the furrow, in rest lengths.
const CLEAR: f32 = 2.5;

/// Draws the sides of every furrow together and drives prey out of the plane of the furrow.
pub(crate) fn draw_furrows(
    organisms: &Organisms,
    particles: &Particles,
    drives: &mut Vec<Drive>,
    contractions: &mut Vec<Contraction>,
) {
    for (_, organism) in organisms.with_membrane().filter(|(_, organism)| !organism.is_quarantined) {
        if !organism.rounds_up() {
            draw_furrow(organism, particles, contractions);
        }
        clear_furrow(organism, organisms, particles, drives);
    }
}

fn clear_furrow(organism: &Organism, organisms: &Organisms, p: &Particles, drives: &mut Vec<Drive>) {
    let (Some(furrow), Some(engulfer), Some(membrane)) =
        (organism.furrow(), &organism.engulfer, organism.body.membrane())
    else {
        return;
    };
    let [a, b] = furrow.nodes.map(|node| p.position(node as usize));
    let axis = heading((b - a).perp());
    for meal in engulfer.meals.iter().filter(|meal| meal.phase.is_inside()) {
        let Some(prey) = organisms.get(meal.prey) else { continue };
        let side = (position_of(prey, p) - 0.5 * (a + b)).dot(axis);
        let discs = || prey.particles().map(|i| i as usize);
        let reach = |i: usize| (p.position(i) - position_of(prey, p)).length() + p.radius[i];
        let size = discs().map(reach).fold(0.0, |size, reach| if reach > size { reach } else { size });
        if side.abs() < size + CLEAR * membrane.rest_length {
            let velocity = axis * engulfer.params.pull_speed.copysign(side);
            let max_acceleration = engulfer.params.pull_acceleration;
            drives.extend(prey.particles().map(|particle| Drive::new(particle, velocity, max_acceleration)));
        }
    }
}

fn draw_furrow(organism: &Organism, particles: &Particles, contractions: &mut Vec<Contraction>) {
    let (Some(furrow), Some(divider), Some(membrane)) =
        (organism.furrow(), &organism.divider, organism.body.membrane())
    else {
        return;
    };
    let (ring, count) = (&organism.outline, organism.outline.len());
    let place = |node| ring.iter().position(|&other| other == node);
    let [Some(a), Some(b)] = furrow.nodes.map(place) else { return };
    let speed = 2.0 * divider.params.furrow_speed;
    // Along the ring on one side is against it on the other.
    for (forth, back) in [(1, count - 1), (count - 1, 1)] {
        let mut inner = 0.0;
        for (step, &share) in SLOPE.iter().enumerate() {
            let (a, b) = (ring[(a + step * forth) % count], ring[(b + step * back) % count]);
            let width = particles.between(a as usize, b as usize).length() / membrane.rest_length;
            let is_drawn = (step > 0 || forth == 1) && (width > NARROW || inner < SHUT);
            if is_drawn {
                contractions.push(Contraction { a, b, speed: speed * share });
            }
            inner = width;
        }
    }
}
