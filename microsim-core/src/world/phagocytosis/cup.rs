//! Ingestion by cup: the membrane around the prey gets more nodes, and when the lips meet, the arc around the prey is cut
//! off and becomes a phagosome.

use super::phagosome::LEAST_NODES;
use crate::behavior::phagocytosis::lips::Fold;
use crate::capability::phagocytosis::PhagocytosisParams;
use crate::geometry::polygon::{contains_point, is_simple, signed_area};
use crate::id::OrganismId;
use crate::organism::ring_surgery::{Swap, insert_node_in, set_outline};
use crate::organism::{Organism, Phagosome};
use crate::world::World;
use glam::Vec2;

/// Number of nodes, beyond those that lie against prey, between which the links to swap are searched for.
const SEARCHED_NODES: usize = 4;

impl World {
    /// Advances a cup by a step; returns whether it has closed.
    pub(super) fn advance_cup(&mut self, id: OrganismId, prey: OrganismId, params: &PhagocytosisParams) -> bool {
        let (Some(organism), Some(eaten)) = (self.organisms.get(id), self.organisms.get(prey)) else { return false };
        let Some(fold) = Fold::find(organism, eaten, &self.particles) else { return false };
        if let Some(swap) = self.cup_swap(organism, prey, &fold, params) {
            self.form_phagosome(id, prey, &swap);
            return true;
        }
        (0..self.membrane_changes()).for_each(|_| self.lengthen_fold(id, &fold));
        false
    }

    /// Puts a node into the fold of a membrane that needs one.
    fn lengthen_fold(&mut self, id: OrganismId, fold: &Fold) {
        let has_room = (self.particles.live_count() as u64) < u64::from(self.config.max_particles);
        let Self { organisms, particles, .. } = self;
        if let Some(organism) = organisms.get_mut(id).filter(|organism| has_room && organism.missing_nodes() > 0) {
            let count = organism.outline.len();
            let first = fold.bottom + count - fold.before - 1;
            insert_node_in(organism, first..first + fold.before + fold.after + 2, particles);
        }
    }

    /// The links to swap, if the lips are close enough and enclose all of the prey and nothing else.
    fn cup_swap(
        &self,
        organism: &Organism,
        prey: OrganismId,
        fold: &Fold,
        params: &PhagocytosisParams,
    ) -> Option<Swap> {
        let outline = self.outline_of(organism);
        let count = outline.len();
        let window = |from: usize| (from..from + 2 * SEARCHED_NODES).map(move |k| k % count);
        let firsts = window(fold.bottom + 2 * count - fold.before - 2 * SEARCHED_NODES + 1);
        let swap = Swap::shortest([&outline, &outline], firsts, window(fold.bottom + fold.after))?;
        if swap.length > params.closing_length * organism.body.membrane()?.rest_length {
            return None;
        }
        let (left, arc) = swap.cut(&outline);
        let holds = |ring: &[Vec2], i: usize| contains_point(ring, self.particles.position(i));
        let is_cut = arc.len() >= LEAST_NODES && left.len() >= 2 * LEAST_NODES && signed_area(&arc) < 0.0;
        let is_sound = is_cut && is_simple(&left) && is_simple(&arc);
        let p = &self.particles;
        let own = p.owner[organism.outline[0] as usize];
        let is_foreign = |&i: &usize| p.owner[i] != prey.index && p.owner[i] != own && p.inv_mass[i] > 0.0;
        let is_clear = is_sound
            && self.discs_of(prey).all(|i| holds(&arc, i))
            && organism.fluid_particles.iter().all(|&i| holds(&left, i as usize))
            && !p.live().filter(is_foreign).any(|i| holds(&arc, i))
            && !self.solid_obstacles().any(|obstacle| contains_point(&arc, obstacle.aabb().center()));
        is_clear.then_some(swap)
    }

    /// Cuts the arc around prey off the outline: it becomes a phagosome inside the cell.
    fn form_phagosome(&mut self, id: OrganismId, prey: OrganismId, swap: &Swap) {
        let area = self.area_of(prey);
        let Self { organisms, particles, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return };
        let count = organism.outline.len();
        let (left, mut ring) = swap.cut(&organism.outline);
        ring.reverse();
        particles.link_ring(&ring);
        if let Some(membrane) = organism.body.membrane_mut() {
            let mut inner = membrane.resized(count, ring.len());
            inner.rim = inner.node_radius;
            *membrane = membrane.resized(count, left.len());
            organism.phagosomes.push(Phagosome { prey, ring, membrane: inner, area });
        }
        set_outline(organism, left, particles);
    }
}
