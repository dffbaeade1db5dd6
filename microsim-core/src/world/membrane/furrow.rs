//! The furrow of a dividing cell: it gets longer and narrower until its two sides are joined, or it is abandoned.

use crate::capability::division::{DivisionParams, Furrow};
use crate::capability::phagocytosis::Meal;
use crate::event::{Event, Refusal};
use crate::geometry::polygon::{contains_point, is_simple};
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::organism::ring_surgery::{Swap, insert_node_in};
use crate::particle::Particles;
use crate::solver::membrane::links;
use crate::world::World;
use glam::Vec2;
use std::ops::Range;

/// Length of a link in a closing furrow above which it gets a new node, in rest lengths.
const LONGEST: f32 = 1.15;
/// Number of nodes on both sides of the bottom of the furrow between which the links to swap are searched for.
const SEARCHED_NODES: usize = 4;

impl World {
    /// Advances a furrow by a step: adds nodes where the membrane is stretched, and swaps links when both sides have met.
    pub(super) fn advance_furrow(&mut self, id: OrganismId) {
        let Some(organism) = self.organisms.get_mut(id) else { return };
        let Some(Furrow { elapsed, .. }) = organism.furrow() else { return };
        if organism.is_quarantined {
            return self.abandon_division(id, Refusal::Quarantined);
        }
        let elapsed = elapsed + self.config.dt;
        let Some(divider) = organism.divider.as_mut() else { return };
        divider.furrow = divider.furrow.map(|furrow| Furrow { elapsed, ..furrow });
        let time_limit = divider.params.time_limit;
        (0..self.membrane_changes()).for_each(|_| self.lengthen_furrow(id));
        let Some(organism) = self.organisms.get(id) else { return };
        match self.division_swap(organism) {
            Ok(swap) => self.split(id, &swap),
            Err(reason) if elapsed >= time_limit => self.abandon_division(id, reason),
            Err(_) => {}
        }
    }

    /// Puts a node into the membrane of the furrow, if it needs one.
    fn lengthen_furrow(&mut self, id: OrganismId) {
        let has_room = (self.particles.live_count() as u64) < u64::from(self.config.max_particles);
        let Self { organisms, particles, .. } = self;
        let Some(organism) = organisms.get_mut(id).filter(|_| has_room) else { return };
        if organism.missing_nodes() > 0 || longest_link(organism, particles) > LONGEST {
            insert_node_in(organism, shorter_arc(organism), particles);
        }
    }

    fn abandon_division(&mut self, id: OrganismId, reason: Refusal) {
        let Some(organism) = self.organisms.get_mut(id) else { return };
        if let Some(divider) = &mut organism.divider {
            divider.furrow = None;
        }
        organism.update_wanted_nodes(&self.fluids);
        self.events.push(Event::DivisionAbandoned { organism: id, reason });
    }

    /// The links to swap, if both sides of the furrow are close enough and all content lies in one lobe or the other.
    pub(super) fn division_swap(&self, organism: &Organism) -> Result<Swap, Refusal> {
        let (Some(furrow), Some(divider), Some(membrane)) =
            (organism.furrow(), &organism.divider, organism.body.membrane())
        else {
            return Err(Refusal::FurrowOpen);
        };
        let outline = self.outline_of(organism);
        let count = outline.len();
        let place = |node: u32| organism.outline.iter().position(|&other| other == node).ok_or(Refusal::FurrowOpen);
        let around = |k: usize| (0..=2 * SEARCHED_NODES).map(move |step| (k + count + step - SEARCHED_NODES) % count);
        let (first, second) = (place(furrow.nodes[0])?, place(furrow.nodes[1])?);
        let swap = Swap::shortest([&outline, &outline], around(first), around(second)).ok_or(Refusal::FurrowOpen)?;
        if swap.length > divider.params.closing_length * membrane.rest_length {
            return Err(Refusal::FurrowOpen);
        }
        let (kept, cut) = swap.cut(&outline);
        if !(is_simple(&kept) && is_simple(&cut)) {
            return Err(Refusal::FurrowOpen);
        }
        self.check_lobes(organism, &divider.params, &kept, &cut).map(|()| swap)
    }

    /// Checks that both rings are large enough, that each particle of cytoplasm is in exactly one of them, and that no prey
    /// is in both.
    fn check_lobes(
        &self,
        organism: &Organism,
        params: &DivisionParams,
        kept: &[Vec2],
        cut: &[Vec2],
    ) -> Result<(), Refusal> {
        let is_in = |lobe: &[Vec2], i: usize| contains_point(lobe, self.particles.position(i));
        let fluid = || organism.fluid_particles.iter().map(|&i| i as usize);
        let is_small = |lobe: &[Vec2]| {
            let inside = fluid().filter(|&i| is_in(lobe, i)).count();
            lobe.len() < params.least_nodes as usize || inside < params.least_particles as usize
        };
        if is_small(kept) || is_small(cut) {
            return Err(Refusal::TooSmall);
        }
        if fluid().any(|i| is_in(kept, i) == is_in(cut, i)) {
            return Err(Refusal::FurrowOpen);
        }
        let lies_between = |meal: &Meal| {
            let phagosome = organism.phagosomes.iter().find(|inner| inner.prey == meal.prey);
            let around = phagosome.into_iter().flat_map(|inner| &inner.ring).map(|&i| i as usize);
            let mut sides = self.discs_of(meal.prey).chain(around).map(|i| is_in(kept, i));
            let first = sides.next();
            sides.any(|side| Some(side) != first)
        };
        let mut held = organism.meals().iter().filter(|meal| meal.phase.is_inside());
        if held.any(lies_between) { Err(Refusal::PreyInFurrow) } else { Ok(()) }
    }
}

/// Positions in the outline of the side of the furrow with fewer nodes: lobes with equal membranes become equal.
fn shorter_arc(organism: &Organism) -> Range<usize> {
    let count = organism.outline.len();
    let nodes = organism.furrow().map_or([0; 2], |furrow| furrow.nodes);
    let [a, b] = nodes.map(|node| organism.outline.iter().position(|&other| other == node).unwrap_or(0));
    let arcs = [(a, b), (b, a)].map(|(from, to)| from..from + (to + count - from) % count);
    let [one, other] = arcs;
    if one.len() < other.len() { one } else { other }
}

/// Length of the longest link over its rest length.
fn longest_link(organism: &Organism, particles: &Particles) -> f32 {
    let rest = organism.body.membrane().map_or(f32::INFINITY, |membrane| membrane.rest_length);
    let length = |(a, b): (u32, u32)| particles.between(a as usize, b as usize).length();
    links(&organism.outline).map(length).fold(0.0, |longest, length| if length > longest { length } else { longest })
        / rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AmoeboidCellSpec, Placement, WorldConfig};

    #[test]
    fn lobes_have_at_least_what_is_asked_and_all_of_the_content() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        let organism = world.organisms.get(cell).unwrap();
        let box_of = |[left, right]: [f32; 2]| {
            [(left, 0.0), (right, 0.0), (right, 90.0), (left, 90.0)].map(|(x, y)| Vec2::new(x, y)).to_vec()
        };
        // Between two particles.
        let (kept, cut) = (box_of([0.0, 80.013]), box_of([80.013, 160.0]));
        let inside = |lobe: &[Vec2]| {
            let is_in = |&&i: &&u32| contains_point(lobe, world.particles.position(i as usize));
            organism.fluid_particles.iter().filter(is_in).count() as u32
        };
        let fewer = inside(&kept).min(inside(&cut));
        assert!(fewer > 0 && inside(&kept) + inside(&cut) == organism.fluid_particles.len() as u32);
        let check = |least_nodes, least_particles, cut: &[Vec2]| {
            let params = DivisionParams { least_nodes, least_particles, ..DivisionParams::default() };
            world.check_lobes(organism, &params, &kept, cut)
        };
        assert_eq!(check(4, fewer, &cut), Ok(()));
        assert_eq!(check(5, fewer, &cut), Err(Refusal::TooSmall));
        assert_eq!(check(4, fewer + 1, &cut), Err(Refusal::TooSmall));
        assert_eq!(check(4, 1, &box_of([84.0, 160.0])), Err(Refusal::FurrowOpen), "some are in neither");
        assert_eq!(check(4, 1, &box_of([76.0, 160.0])), Err(Refusal::FurrowOpen), "some are in both");
    }
}
