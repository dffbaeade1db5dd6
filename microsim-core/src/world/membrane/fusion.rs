//! Fusion of two cells with membranes that touch: two links are swapped, and the larger cell takes over the nodes, cytoplasm
//! and prey of the smaller one.

use crate::capability::division::Order;
use crate::capability::phagocytosis::Meal;
use crate::error::Error;
use crate::event::{Event, Refusal};
use crate::geometry::polygon::{contains_point, is_simple};
use crate::id::OrganismId;
use crate::organism::ring_surgery::{Swap, set_outline};
use crate::organism::{Organism, Storage, at_most};
use crate::world::World;

impl World {
    /// Tells an amoeboid cell to fuse with another that it touches. In the next step the larger one, by cytoplasm, takes over
    /// everything of the smaller one, whose handle becomes stale: [`Event::Fused`]; or [`Event::FusionRefused`] says why
    /// not. Cytoplasm is conserved; the membrane loses the nodes that one cell does not need.
    ///
    /// # Errors
    /// When a handle is stale or an organism is no amoeboid cell.
    pub fn fuse(&mut self, a: OrganismId, b: OrganismId) -> Result<(), Error> {
        self.organism_or_stale(b, "b")?;
        self.give_order(a, Order::Fuse { with: b })
    }

    pub(super) fn try_fusion(&mut self, a: OrganismId, b: OrganismId) {
        match self.plan_fusion(a, b) {
            Ok((into, from, swap)) => self.merge(into, from, swap),
            Err(reason) => self.events.push(Event::FusionRefused { organism: a, with: b, reason }),
        }
    }

    /// The larger cell, the smaller cell and the links to swap, or the reason why they cannot fuse.
    fn plan_fusion(&self, a: OrganismId, b: OrganismId) -> Result<(OrganismId, OrganismId, Swap), Refusal> {
        let partner =
            |id| self.organisms.get(id).filter(|organism| organism.divider.is_some() && organism.fluid.is_some());
        let (one, other) = (partner(a).ok_or(Refusal::NoPartner)?, partner(b).ok_or(Refusal::NoPartner)?);
        Self::refusal_of_free(one).or_else(|| Self::refusal_of_free(other)).map_or(Ok(()), Err)?;
        let (Some(membrane), Some(fluid), Some(divider)) = (one.body.membrane(), one.fluid, &one.divider) else {
            return Err(Refusal::NoPartner);
        };
        let is_alike = other.body.membrane().is_some_and(|m| m.node_radius == membrane.node_radius)
            && other.fluid.is_some_and(|f| self.fluids[f as usize].params == self.fluids[fluid as usize].params);
        if a == b || !is_alike {
            return Err(Refusal::NoPartner);
        }
        let holds_soft = |organism: &Organism| organism.engulfer.iter().any(|engulfer| engulfer.slot_is_taken());
        if holds_soft(one) && holds_soft(other) {
            return Err(Refusal::PlaceTaken);
        }
        let is_larger = one.fluid_particles.len() >= other.fluid_particles.len();
        let (into, from) = if is_larger { (a, b) } else { (b, a) };
        let swap = self.fusion_swap(into, from).ok_or(Refusal::NotTouching)?;
        let is_near = swap.length <= divider.params.closing_length * membrane.rest_length;
        is_near.then_some((into, from, swap)).ok_or(Refusal::NotTouching)
    }

    /// The links whose swap joins two cells with the shortest new links, if nothing lies between them.
    fn fusion_swap(&self, into: OrganismId, from: OrganismId) -> Option<Swap> {
        let (a, b) = (self.outline_of(self.organisms.get(into)?), self.outline_of(self.organisms.get(from)?));
        let swap = Swap::shortest([&a, &b], 0..a.len(), 0..b.len())?;
        let (i, j) = (swap.first, swap.second);
        let neck = [a[i], b[(j + 1) % b.len()], b[j], a[(i + 1) % a.len()]];
        let p = &self.particles;
        let mut others =
            p.live().filter(|&k| p.owner[k] != into.index && p.owner[k] != from.index && p.inv_mass[k] > 0.0);
        let is_free = !others.any(|k| contains_point(&neck, p.position(k)));
        (is_free && is_simple(&swap.join(&a, &b))).then_some(swap)
    }

    fn merge(&mut self, into: OrganismId, from: OrganismId, swap: Swap) {
        let (Some(larger), Some(smaller)) = (self.organisms.get(into), self.organisms.get(from)) else { return };
        let outline = swap.join(&larger.outline, &smaller.outline);
        let (a, b) = (self.nodes_per_root(larger), self.nodes_per_root(smaller));
        let meals: Vec<Meal> = smaller.meals().iter().filter(|meal| meal.phase.is_inside()).cloned().collect();
        self.move_meals(&meals, from, into);
        let Some(smaller) = self.organisms.remove(from) else { return };
        self.exemptions.forget(from.index);
        self.take_over(into, smaller, outline);
        let Self { organisms, fluids, events, .. } = self;
        let Some(larger) = organisms.get_mut(into) else { return };
        if let Some(divider) = &mut larger.divider {
            divider.nodes_per_root = Some(at_most(if a > b { a } else { b }));
            divider.lobes = 2.0;
        }
        larger.update_wanted_nodes(fluids);
        events.push(Event::Fused { into, from });
    }

    /// Gives a cell all particles and prey of another one, within a common outline.
    fn take_over(&mut self, id: OrganismId, other: Organism, outline: Vec<u32>) {
        other.particles().for_each(|i| self.particles.owner[i as usize] = id.index);
        self.move_cytoplasm(&other.fluid_particles, other.fluid, id);
        let Self { organisms, particles, .. } = self;
        let Some(cell) = organisms.get_mut(id) else { return };
        let before = cell.outline.len();
        if let (Storage::Loose { particles: body, membrane: Some(membrane) }, Storage::Loose { particles: added, .. }) =
            (&mut cell.body, &other.body)
        {
            body.extend(added);
            *membrane = membrane.resized(before, outline.len());
        }
        cell.fluid_particles.extend(&other.fluid_particles);
        cell.phagosomes.extend(other.phagosomes);
        cell.spawn_area = at_most(cell.spawn_area + other.spawn_area);
        if let (Some(engulfer), Some(other)) = (&mut cell.engulfer, &other.engulfer) {
            engulfer.pending_growth = at_most(engulfer.pending_growth + other.pending_growth);
        }
        set_outline(cell, outline, particles);
    }

    /// Membrane nodes over the square root of the content.
    fn nodes_per_root(&self, organism: &Organism) -> f32 {
        let known = organism.divider.as_ref().and_then(|divider| divider.nodes_per_root);
        known.unwrap_or_else(|| organism.outline.len() as f32 / organism.content(&self.fluids).sqrt())
    }
}
