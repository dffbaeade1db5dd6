//! Lips of a phagocytic cup: the membrane folds around prey that is drawn in, and its two lips close behind it.
//!
//! ```text
//!        lip  \           / lip          lips are driven around the prey until they are past it,
//!              \  (prey) /               then drawn together across the mouth
//!     cell      \_______/      cell
//!                bottom
//! ```

use crate::behavior::{heading, position_of};
use crate::capability::phagocytosis::Engulfer;
use crate::geometry::polygon::contains_point;
use crate::organism::Organism;
use crate::organism::table::Organisms;
use crate::particle::Particles;
use crate::solver::contraction::Contraction;
use crate::solver::drive::Drive;
use glam::Vec2;

/// Gap below which a node lies against the prey, in node radii.
const GRIP: f32 = 0.9;
/// Nodes of each lip that are driven, from the last that lies against the prey outwards.
const LIP: usize = 5;
/// Distance of the lips, in rest lengths, below which they close pair by pair from the prey outwards.
const NARROW: f32 = 3.0;

/// Where a membrane lies around prey: positions in the outline, counted on beyond its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fold {
    /// The deepest node.
    pub bottom: usize,
    /// Number of nodes from the bottom to the last one that lies against the prey, before and after it.
    pub before: usize,
    pub after: usize,
    /// Out of the cell.
    pub mouth: Vec2,
}

impl Fold {
    /// The fold of a membrane around prey.
    pub(crate) fn find(organism: &Organism, prey: &Organism, p: &Particles) -> Option<Self> {
        let (ring, count) = (&organism.outline, organism.outline.len());
        let mouth = heading(position_of(prey, p) - position_of(organism, p));
        let deepest = |&(best, least): &(usize, f32), k: usize| {
            let (gap, away) = nearest(prey, ring[k] as usize, p);
            // Nodes on the cell's side of the prey come before nodes beside it.
            let depth = gap + away.dot(mouth) * p.radius[ring[k] as usize];
            if depth < least { (k, depth) } else { (best, least) }
        };
        let (bottom, _) = (0..count).fold((0, f32::INFINITY), |best, k| deepest(&best, k));
        let lies_against = |k: usize| {
            let node = ring[k % count] as usize;
            nearest(prey, node, p).0 < GRIP * p.radius[node]
        };
        let most = count / 3;
        let before = (1..most).rev().find(|&step| lies_against(bottom + count - step)).unwrap_or(0);
        let after = (1..most).rev().find(|&step| lies_against(bottom + step)).unwrap_or(0);
        Some(Self { bottom, before, after, mouth })
    }
}

/// Gap between a node and the nearest disc of prey, and the unit vector from that disc to the node.
fn nearest(prey: &Organism, node: usize, p: &Particles) -> (f32, Vec2) {
    let mut best = (f32::INFINITY, Vec2::ZERO);
    for i in prey.particles().map(|i| i as usize).filter(|&i| p.inv_mass[i] > 0.0) {
        let away = p.between(i, node);
        let gap = away.length() - p.radius[i] - p.radius[node];
        if gap < best.0 {
            best = (gap, away);
        }
    }
    (best.0, heading(best.1))
}

/// Drives the lips of every cup.
pub(crate) fn drive_lips(
    organisms: &Organisms,
    particles: &Particles,
    drives: &mut Vec<Drive>,
    contractions: &mut Vec<Contraction>,
) {
    for (_, organism) in organisms.with_membrane() {
        let Some(engulfer) = organism.engulfer.as_ref() else { continue };
        let taken_in = engulfer.meals.iter().filter(|meal| meal.is_in_cup());
        for prey in taken_in.filter_map(|meal| organisms.get(meal.prey)) {
            let Some(fold) = Fold::find(organism, prey, particles) else { continue };
            let cup = Cup { organism, engulfer, prey, particles, fold };
            if !cup.is_past_prey() {
                cup.advance(drives);
            } else if !cup.is_blocked() {
                cup.close(contractions);
            }
        }
    }
}

/// One cup in one step.
struct Cup<'a> {
    organism: &'a Organism,
    engulfer: &'a Engulfer,
    prey: &'a Organism,
    particles: &'a Particles,
    fold: Fold,
}

impl Cup<'_> {
    /// The node so many places beyond the last one that lies against the prey, on either side.
    fn lip(&self, is_after: bool, step: usize) -> u32 {
        let count = self.organism.outline.len();
        let Fold { bottom, before, after, .. } = self.fold;
        let k = if is_after { bottom + after + step } else { bottom + 2 * count - before - step };
        self.organism.outline[k % count]
    }

    /// Whether both lips have passed the prey's widest place.
    fn is_past_prey(&self) -> bool {
        [false, true].into_iter().all(|is_after| {
            let (_, away) = nearest(self.prey, self.lip(is_after, 0) as usize, self.particles);
            away.dot(self.fold.mouth) > 0.0
        })
    }

    /// Whether something else is between the lips, which would crush it. They wait until it is gone or the time limit is over.
    fn is_blocked(&self) -> bool {
        let (p, ring) = (self.particles, &self.organism.outline);
        let middle = self.fold.bottom + 2 * ring.len();
        let arc = middle - self.fold.before - self.rim(false)..=middle + self.fold.after + self.rim(true);
        let fold: Vec<Vec2> = arc.map(|k| p.position(ring[k % ring.len()] as usize)).collect();
        let (low, high) = fold.iter().fold((fold[0], fold[0]), |(low, high), &at| (low.min(at), high.max(at)));
        let owners = [ring[0], self.prey.particles().next().unwrap_or(ring[0])].map(|i| p.owner[i as usize]);
        p.live().filter(|&i| !owners.contains(&p.owner[i])).any(|i| {
            let at = p.position(i);
            at.cmpge(low).all() && at.cmple(high).all() && contains_point(&fold, at)
        })
    }

    /// The step of the lip's node that is farthest out.
    fn rim(&self, is_after: bool) -> usize {
        let out = |step: usize| self.particles.position(self.lip(is_after, step) as usize).dot(self.fold.mouth);
        (1..=LIP).fold(0, |rim, step| if out(step) > out(rim) { step } else { rim })
    }

    /// Moves the lips along the prey's surface towards the mouth.
    fn advance(&self, drives: &mut Vec<Drive>) {
        let (ring, Fold { bottom, before, after, mouth }) = (&self.organism.outline, self.fold);
        let inwards = -mouth * self.engulfer.params.pull_speed;
        for k in bottom + ring.len() - before..=bottom + ring.len() + after {
            let particle = ring[k % ring.len()];
            drives.push(Drive::new(particle, inwards, f32::INFINITY));
        }
        for (is_after, step) in [false, true].into_iter().flat_map(|side| (0..LIP).map(move |step| (side, step))) {
            let particle = self.lip(is_after, step);
            let (gap, away) = nearest(self.prey, particle as usize, self.particles);
            // Counter-clockwise around the prey before the bottom of the fold, clockwise after it.
            let along = if is_after { -away.perp() } else { away.perp() };
            let nearer = gap / self.particles.radius[particle as usize];
            let way = along - away * if nearer < 1.0 { nearer } else { 1.0 };
            let velocity = heading(way) * self.engulfer.params.lip_speed;
            drives.push(Drive::new(particle, velocity, f32::INFINITY));
        }
    }

    /// Draws the lips together: all pairs of a wide mouth at once, in a narrow one each after the pair before it has closed.
    fn close(&self, contractions: &mut Vec<Contraction>) {
        let rest_length = self.organism.body.membrane().map_or(1.0, |membrane| membrane.rest_length);
        let mut inner = 0.0;
        for step in 0..LIP {
            let (a, b) = (self.lip(false, step), self.lip(true, step));
            let width = self.particles.between(a as usize, b as usize).length() / rest_length;
            if width > NARROW || inner < self.engulfer.params.closing_length {
                contractions.push(Contraction { a, b, speed: 2.0 * self.engulfer.params.lip_speed });
            }
            inner = width;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::World;
    use crate::{AgarSpec, AmoeboidCellSpec, Inputs, Intent, Placement, PlateletSpec, WorldConfig};

    #[test]
    fn lips_do_not_close_on_other_organisms() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 45.0)).unwrap();
        let prey = world.spawn(&AgarSpec::default().into(), Placement::at(56.0, 45.0)).unwrap();
        let platelet = world.spawn(&PlateletSpec::default().into(), Placement::at(90.0, 45.0)).unwrap();
        for _ in 0..900 {
            let mut inputs = Inputs::new();
            if let Some(at) = world.centroid(prey) {
                inputs.set(cell, Intent::toward(at).unwrap());
            }
            world.step(&inputs);
            if !world.scratch.contractions.is_empty() {
                break;
            }
        }
        let closing = |world: &World| {
            let mut contractions = Vec::new();
            drive_lips(&world.organisms, &world.particles, &mut Vec::new(), &mut contractions);
            contractions
        };
        let lips = closing(&world);
        let [a, b] = [lips[0].a, lips[0].b].map(|i| world.particles.position(i as usize));
        let p = &mut world.particles;
        let disc = p.live().find(|&i| p.owner[i] == platelet.index).unwrap();
        let by = (a + b) * 0.5 - p.position(disc);
        (p.x[disc], p.y[disc]) = (p.x[disc] + by.x, p.y[disc] + by.y);
        assert!(closing(&world).is_empty());
    }
}
