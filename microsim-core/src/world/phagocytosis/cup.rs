//! Ingestion by cup: nodes for the fold around prey, the cut when its lips have met, and what becomes of the arc that was
//! cut off, the phagosome. How the lips move is [`crate::behavior::phagocytosis`].

use crate::world::World;
use crate::behavior::phagocytosis::Fold;
use crate::capability::phagocytosis::{Engulfer, Meal, MealPhase, PhagocytosisParams};
use crate::geometry::polygon::{contains_point, is_simple, signed_area};
use crate::id::OrganismId;
use crate::organism::ring_surgery::{Swap, free_nodes, insert_node_in, set_outline, take_out};
use crate::organism::{Organism, Phagosome};
use glam::Vec2;
use std::f32::consts::{PI, TAU};

/// Time in which the membrane lengthens by what a fold needs, s.
const FOLDING_TIME: f32 = 0.8;
/// Nodes beyond those that lie against prey among which the links to swap are looked for.
const REACH: usize = 4;
/// Fewest nodes of a phagosome.
const LEAST_NODES: usize = 5;
/// Area of a phagosome over that of its prey.
const ROOM: f32 = 1.1;

impl World {
    /// One step of prey that a cup takes in; returns whether the cup has closed.
    pub(in crate::world) fn advance_cup(&mut self, id: OrganismId, prey: OrganismId, params: &PhagocytosisParams) -> bool {
        let room = (self.particles.live_count() as u64) < u64::from(self.config.max_particles);
        let (Some(organism), Some(eaten)) = (self.organisms.get(id), self.organisms.get(prey)) else { return false };
        let Some(fold) = Fold::find(organism, eaten, &self.particles) else { return false };
        if let Some(swap) = self.closing_cut(organism, prey, &fold, params) {
            self.cut_off(id, prey, &swap);
            return true;
        }
        let Self { organisms, particles, .. } = self;
        if let Some(organism) = organisms.get_mut(id).filter(|organism| room && organism.missing_nodes() > 0) {
            let count = organism.outline.len();
            let first = fold.bottom + count - fold.before - 1;
            insert_node_in(organism, first..first + fold.before + fold.after + 2, particles);
        }
        false
    }

    /// The links to swap, if the lips are near enough and all of the prey, and nothing else, is behind them.
    fn closing_cut(
        &self,
        organism: &Organism,
        prey: OrganismId,
        fold: &Fold,
        params: &PhagocytosisParams,
    ) -> Option<Swap> {
        let outline = self.outline_of(organism);
        let count = outline.len();
        let window = |from: usize| (from..from + 2 * REACH).map(move |k| k % count);
        let firsts = window(fold.bottom + 2 * count - fold.before - 2 * REACH + 1);
        let swap = Swap::shortest([&outline, &outline], firsts, window(fold.bottom + fold.after))?;
        if swap.length > params.closing_length * organism.body.membrane()?.rest_length {
            return None;
        }
        let (left, pocket) = swap.cut(&outline);
        let holds = |ring: &[Vec2], i: usize| contains_point(ring, self.particles.position(i));
        let is_cut = pocket.len() >= LEAST_NODES && left.len() >= 2 * LEAST_NODES && signed_area(&pocket) < 0.0;
        let is_sound = is_cut && is_simple(&left) && is_simple(&pocket);
        let p = &self.particles;
        let own = p.owner[organism.outline[0] as usize];
        let is_foreign = |&i: &usize| p.owner[i] != prey.index && p.owner[i] != own && p.inv_mass[i] > 0.0;
        let is_clear = is_sound
            && self.discs_of(prey).all(|i| holds(&pocket, i))
            && organism.fluid_particles.iter().all(|&i| holds(&left, i as usize))
            && !p.live().filter(is_foreign).any(|i| holds(&pocket, i))
            && !self.obstacles.iter().any(|obstacle| contains_point(&pocket, obstacle.bounds().center()));
        is_clear.then_some(swap)
    }

    /// Re-wires the ring: prey and the membrane around it are inside now.
    fn cut_off(&mut self, id: OrganismId, prey: OrganismId, swap: &Swap) {
        let area = self.area_of(prey);
        let Self { organisms, particles, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return };
        let count = organism.outline.len();
        let (left, mut ring) = swap.cut(&organism.outline);
        ring.reverse();
        particles.link_ring(&ring);
        if let Some(membrane) = organism.body.membrane_mut() {
            let inner = membrane.resized(count, ring.len());
            *membrane = membrane.resized(count, left.len());
            organism.phagosomes.push(Phagosome { prey, ring, membrane: inner, area });
        }
        set_outline(organism, left, particles);
    }

    /// Lets phagosomes follow the size of their prey, and removes those without; returns whether there were any.
    pub(in crate::world) fn advance_phagosomes(&mut self, id: OrganismId, engulfer: &Engulfer) -> bool {
        let mut phagosomes = self.organisms.get_mut(id).map_or(Vec::new(), |o| std::mem::take(&mut o.phagosomes));
        for phagosome in &mut phagosomes {
            phagosome.area = ROOM * self.area_of(phagosome.prey);
        }
        let Self { organisms, particles, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return false };
        let count = phagosomes.len();
        phagosomes.retain_mut(|phagosome| {
            let is_needed = engulfer.meals.iter().any(|meal| meal.prey == phagosome.prey);
            let wanted = phagosome.membrane.rest_perimeter() / phagosome.membrane.rest_length;
            if !is_needed {
                free_nodes(organism, &phagosome.ring, particles);
            } else if wanted < phagosome.ring.len() as f32 - 0.5 && phagosome.ring.len() > LEAST_NODES {
                free_nodes(organism, take_out(&mut phagosome.ring, particles).as_slice(), particles);
            }
            is_needed
        });
        organism.phagosomes = phagosomes;
        organism.phagosomes.len() < count
    }

    /// Length of membrane that the folds around prey need now.
    pub(in crate::world) fn fold_length(&self, id: OrganismId, engulfer: &Engulfer) -> f32 {
        let membrane = self.organisms.get(id).and_then(|organism| organism.body.membrane());
        let node_radius = membrane.map_or(0.0, |membrane| membrane.node_radius);
        let length = |meal: &Meal| {
            let MealPhase::Ingesting(elapsed) = meal.phase else { return 0.0 };
            let part = if elapsed < FOLDING_TIME { elapsed / FOLDING_TIME } else { 1.0 };
            part * TAU * ((self.area_of(meal.prey) / PI).sqrt() + 2.0 * node_radius)
        };
        engulfer.meals.iter().filter(|meal| meal.is_in_cup()).map(length).sum()
    }

    /// Present area of an organism.
    pub(in crate::world) fn area_of(&self, id: OrganismId) -> f32 {
        self.organisms.get(id).map_or(0.0, |organism| organism.spawn_area * self.shrinkage(organism))
    }
}
