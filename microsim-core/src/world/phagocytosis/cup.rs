//! Ingestion by cup: nodes for the fold around prey, the cut when its lips have met, and what becomes of the arc that was
//! cut off, the phagosome. How the lips move is [`crate::behavior::phagocytosis`].

use super::phagosome::LEAST_NODES;
use crate::behavior::phagocytosis::lips::Fold;
use crate::capability::phagocytosis::PhagocytosisParams;
use crate::geometry::polygon::{contains_point, is_simple, signed_area};
use crate::id::OrganismId;
use crate::organism::ring_surgery::{Swap, insert_node_in, set_outline};
use crate::organism::{Organism, Phagosome};
use crate::world::World;
use glam::Vec2;

/// Nodes beyond those that lie against prey among which the links to swap are looked for.
const REACH: usize = 4;

impl World {
    /// One step of prey that a cup takes in; returns whether the cup has closed.
    pub(super) fn advance_cup(&mut self, id: OrganismId, prey: OrganismId, params: &PhagocytosisParams) -> bool {
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
}
