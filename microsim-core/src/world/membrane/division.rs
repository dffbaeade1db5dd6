//! Division of cells with a membrane: a furrow closes around the equator, two links are swapped, one ring becomes two, and
//! everything inside goes to the lobe that holds it. What a cell carries of it is [`crate::capability::division`].

use crate::world::World;
use crate::capability::division::{Divider, DivisionParams, Furrow, Order};
use crate::capability::phagocytosis::{Meal, MealPhase, PreyClass};
use crate::error::{Error, ErrorKind};
use crate::event::{Event, Refusal};
use crate::geometry::polygon::{centroid, contains_point, is_simple};
use crate::geometry::ring::direction_or;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::organism::ring_surgery::{Swap, insert_node, insert_node_in, remove_node};
use crate::particle::Particles;
use crate::solver::membrane::links;
use glam::Vec2;
use std::ops::Range;

/// Nodes on both sides of the bottom of the furrow between which links are swapped.
const REACH: usize = 4;
/// A link of a closing furrow's membrane that is longer than this, in rest lengths, gets a new node.
const LONGEST: f32 = 1.15;
/// Share of its nodes by which a membrane may grow in a division: two circles need 1.41 times the nodes of one.
const SLACK: f32 = 0.6;

impl World {
    /// Tells an amoeboid cell to divide across its longest axis. In the next step [`Event::DivisionBegan`] happens, or
    /// [`Event::DivisionRefused`] says why not; the cell rests until [`Event::Divided`] or [`Event::DivisionAbandoned`].
    ///
    /// Cytoplasm is conserved. The membrane gets the nodes that two cells need, some 1.41 times as many.
    ///
    /// # Errors
    /// When the handle is stale or the organism is no amoeboid cell.
    pub fn divide(&mut self, id: OrganismId) -> Result<(), Error> {
        self.give_order(id, Order::Divide { axis: None })
    }

    /// The same, with one lobe to each side along `axis`.
    ///
    /// # Errors
    /// When the handle is stale, the organism is no amoeboid cell, or the axis is zero or not finite.
    pub fn divide_along(&mut self, id: OrganismId, axis: Vec2) -> Result<(), Error> {
        let axis = direction_or(axis, Vec2::ZERO);
        if axis == Vec2::ZERO {
            return Err(Error::unsupported("axis", "a finite vector that is not zero"));
        }
        self.give_order(id, Order::Divide { axis: Some(axis) })
    }

    /// Notes what a cell is to do with the next step.
    pub(in crate::world) fn give_order(&mut self, id: OrganismId, order: Order) -> Result<(), Error> {
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::new(ErrorKind::Stale, "organism"))?;
        let divider = organism.divider.as_mut();
        divider.ok_or_else(|| Error::unsupported("organism", "an amoeboid cell"))?.order = Some(order);
        Ok(())
    }

    /// One step of all cells that divide, fuse, or adapt their membrane to what they hold since.
    pub(crate) fn divide_and_fuse(&mut self) {
        let dt = self.config.dt;
        let cells = self.organisms.with_membrane().filter(|(_, organism)| organism.divider.is_some());
        for id in cells.map(|(id, _)| id).collect::<Vec<_>>() {
            match self.divider_mut(id).and_then(|divider| divider.order.take()) {
                Some(Order::Divide { axis }) => self.begin_division(id, axis),
                Some(Order::Fuse { with }) => self.try_fusion(id, with),
                None => {}
            }
            self.divider_mut(id).into_iter().for_each(|divider| divider.relax(dt));
            self.constrict(id);
            self.turn_over(id);
        }
    }

    pub(in crate::world) fn divider_mut(&mut self, id: OrganismId) -> Option<&mut Divider> {
        self.organisms.get_mut(id).and_then(|organism| organism.divider.as_mut())
    }

    /// What keeps a cell from changing the shape of its membrane.
    pub(in crate::world) fn hindrance(organism: &Organism) -> Option<Refusal> {
        let ingests = |meal: &Meal| matches!(meal.phase, MealPhase::Ingesting(_));
        if organism.is_quarantined {
            Some(Refusal::Quarantined)
        } else if organism.furrow().is_some() {
            Some(Refusal::Dividing)
        } else if organism.engulfer.iter().flat_map(|engulfer| &engulfer.meals).any(ingests) {
            Some(Refusal::Ingesting)
        } else {
            None
        }
    }

    fn begin_division(&mut self, id: OrganismId, axis: Option<Vec2>) {
        let Some(organism) = self.organisms.get(id) else { return };
        match self.plan_furrow(organism, axis) {
            Ok(furrow) => {
                let Self { organisms, fluids, .. } = self;
                let Some(organism) = organisms.get_mut(id) else { return };
                organism.note_first_nodes(fluids);
                let Some(divider) = organism.divider.as_mut() else { return };
                divider.furrow = Some(furrow);
                divider.wanted_nodes = None;
                self.events.push(Event::DivisionBegan { organism: id });
            }
            Err(reason) => self.events.push(Event::DivisionRefused { organism: id, reason }),
        }
    }

    /// Where the furrow is to be, if nothing is against it.
    fn plan_furrow(&self, organism: &Organism, axis: Option<Vec2>) -> Result<Furrow, Refusal> {
        Self::hindrance(organism).map_or(Ok(()), Err)?;
        let Some(params) = organism.divider.as_ref().map(|divider| divider.params) else {
            return Err(Refusal::TooSmall);
        };
        let outline = self.outline_of(organism);
        let centre = centroid(&outline).ok_or(Refusal::TooSmall)?;
        let axis = axis.unwrap_or_else(|| long_axis(&outline, centre));
        let slack = (SLACK * outline.len() as f32) as u64;
        if self.particles.live_count() as u64 + slack > u64::from(self.config.max_particles) {
            return Err(Refusal::WorldFull);
        }
        let ahead = |at: Vec2| (at - centre).dot(axis) > 0.0;
        let fluid = organism.fluid_particles.iter().map(|&i| self.particles.position(i as usize));
        let is_small = |count: usize, all: usize, least: u32| count.min(all - count) < least as usize;
        if is_small(fluid.filter(|&at| ahead(at)).count(), organism.fluid_particles.len(), params.least_particles)
            || is_small(outline.iter().filter(|&&at| ahead(at)).count(), outline.len(), params.least_nodes)
        {
            return Err(Refusal::TooSmall);
        }
        if self.soft_prey_reaches(organism, centre, axis) {
            return Err(Refusal::PreyInFurrow);
        }
        let nodes = bottom_nodes(organism, &outline, centre, axis).ok_or(Refusal::TooSmall)?;
        let width = self.particles.between(nodes[0] as usize, nodes[1] as usize).length();
        Ok(Furrow { nodes, width, elapsed: 0.0 })
    }

    /// Whether soft prey inside a cell reaches the line across `axis` through a point, or comes nearer than the membrane
    /// of the furrow would need.
    fn soft_prey_reaches(&self, organism: &Organism, point: Vec2, axis: Vec2) -> bool {
        let room = organism.body.membrane().map_or(0.0, |membrane| membrane.rest_length);
        let meals = organism.engulfer.iter().flat_map(|engulfer| &engulfer.meals);
        let soft = meals.filter(|meal| meal.class == PreyClass::Soft && meal.phase.is_inside());
        soft.filter_map(|meal| self.organisms.get(meal.prey)).any(|prey| {
            let side = |i: usize, reach: f32| (self.particles.position(i) - point).dot(axis) + reach;
            let discs = || prey.particles().map(|i| (i as usize, self.particles.radius[i as usize] + room));
            discs().any(|(i, reach)| side(i, reach) > 0.0) && discs().any(|(i, reach)| side(i, -reach) < 0.0)
        })
    }

    /// One step of a furrow: new nodes where the membrane is stretched, and the swap when both sides have met.
    fn constrict(&mut self, id: OrganismId) {
        let Some(organism) = self.organisms.get_mut(id) else { return };
        let Some(Furrow { elapsed, .. }) = organism.furrow() else { return };
        if organism.is_quarantined {
            return self.abandon(id, Refusal::Quarantined);
        }
        let elapsed = elapsed + self.config.dt;
        let Some(divider) = organism.divider.as_mut() else { return };
        divider.furrow = divider.furrow.map(|furrow| Furrow { elapsed, ..furrow });
        let time_limit = divider.params.time_limit;
        let room = u64::from(self.config.max_particles).saturating_sub(self.particles.live_count() as u64);
        if room > 0 && (organism.missing_nodes() > 0 || longest_link(organism, &self.particles) > LONGEST) {
            insert_node_in(organism, shorter_arc(organism), &mut self.particles);
        }
        let Some(organism) = self.organisms.get(id) else { return };
        match self.closing_swap(organism) {
            Ok(swap) => self.split(id, &swap),
            Err(reason) if elapsed >= time_limit => self.abandon(id, reason),
            Err(_) => {}
        }
    }

    fn abandon(&mut self, id: OrganismId, reason: Refusal) {
        let Some(organism) = self.organisms.get_mut(id) else { return };
        organism.divider.iter_mut().for_each(|divider| divider.furrow = None);
        organism.adapt_nodes(&self.fluids);
        self.events.push(Event::DivisionAbandoned { organism: id, reason });
    }

    /// The links to swap, if both sides of the furrow are near enough and everything inside is in one lobe or the other.
    fn closing_swap(&self, organism: &Organism) -> Result<Swap, Refusal> {
        let (Some(furrow), Some(divider), Some(membrane)) =
            (organism.furrow(), &organism.divider, organism.body.membrane())
        else {
            return Err(Refusal::FurrowOpen);
        };
        let outline = self.outline_of(organism);
        let count = outline.len();
        let place = |node: u32| organism.outline.iter().position(|&other| other == node).ok_or(Refusal::FurrowOpen);
        let around = |k: usize| (0..=2 * REACH).map(move |step| (k + count + step - REACH) % count);
        let (first, second) = (place(furrow.nodes[0])?, place(furrow.nodes[1])?);
        let swap = Swap::shortest([&outline, &outline], around(first), around(second)).ok_or(Refusal::FurrowOpen)?;
        if swap.length > divider.params.closing_length * membrane.rest_length {
            return Err(Refusal::FurrowOpen);
        }
        let (left, cut) = swap.cut(&outline);
        if !(is_simple(&left) && is_simple(&cut)) {
            return Err(Refusal::FurrowOpen);
        }
        self.check_lobes(organism, &divider.params, &left, &cut).map(|()| swap)
    }

    /// Checks that both rings are large enough, that every particle of cytoplasm is in exactly one of them, and that all of
    /// every prey is in the same.
    fn check_lobes(
        &self,
        organism: &Organism,
        params: &DivisionParams,
        left: &[Vec2],
        cut: &[Vec2],
    ) -> Result<(), Refusal> {
        let is_in = |lobe: &[Vec2], i: usize| contains_point(lobe, self.particles.position(i));
        let fluid = || organism.fluid_particles.iter().map(|&i| i as usize);
        let is_small = |lobe: &[Vec2]| {
            let inside = fluid().filter(|&i| is_in(lobe, i)).count();
            lobe.len() < params.least_nodes as usize || inside < params.least_particles as usize
        };
        if is_small(left) || is_small(cut) {
            return Err(Refusal::TooSmall);
        }
        if fluid().any(|i| is_in(left, i) == is_in(cut, i)) {
            return Err(Refusal::FurrowOpen);
        }
        let lies_between = |meal: &Meal| {
            let phagosome = organism.phagosomes.iter().find(|inner| inner.prey == meal.prey);
            let around = phagosome.into_iter().flat_map(|inner| &inner.ring).map(|&i| i as usize);
            let mut sides = self.discs_of(meal.prey).chain(around).map(|i| is_in(left, i));
            let first = sides.next();
            sides.any(|side| Some(side) != first)
        };
        let mut held =
            organism.engulfer.iter().flat_map(|engulfer| &engulfer.meals).filter(|meal| meal.phase.is_inside());
        if held.any(lies_between) { Err(Refusal::PreyInFurrow) } else { Ok(()) }
    }

    /// Takes a membrane one node nearer to the number that it wants, while no gate holds on to its nodes.
    fn turn_over(&mut self, id: OrganismId) {
        let room = (self.particles.live_count() as u64) < u64::from(self.config.max_particles);
        let Self { organisms, particles, .. } = self;
        let Some(organism) = organisms.get_mut(id).filter(|organism| Self::hindrance(organism).is_none()) else {
            return;
        };
        let count = organism.outline.len() as u32;
        let Some(wanted) = organism.divider.as_ref().and_then(|divider| divider.wanted_nodes) else { return };
        if count < wanted && room {
            insert_node(organism, particles);
        } else if count > wanted && organism.has_spare_node() {
            remove_node(organism, particles);
        } else if count == wanted {
            organism.divider.as_mut().into_iter().for_each(|divider| divider.wanted_nodes = None);
        }
    }
}

/// Direction in which an outline is longest: that of the larger eigenvalue of its second moments.
fn long_axis(outline: &[Vec2], centre: Vec2) -> Vec2 {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for &at in outline {
        let arm = at - centre;
        (xx, xy, yy) = (xx + arm.x * arm.x, xy + arm.x * arm.y, yy + arm.y * arm.y);
    }
    let half = 0.5 * (xx - yy);
    let root = (half * half + xy * xy).sqrt();
    // Of the two forms of the eigenvector, the one that does not cancel.
    let axis = if half >= 0.0 { Vec2::new(half + root, xy) } else { Vec2::new(xy, root - half) };
    direction_or(axis, Vec2::X)
}

/// The node of the outline on each side of the axis that is nearest to the line across it.
fn bottom_nodes(organism: &Organism, outline: &[Vec2], centre: Vec2, axis: Vec2) -> Option<[u32; 2]> {
    let nearest = |is_left: bool| {
        let on_side =
            outline.iter().zip(&organism.outline).filter(|(at, _)| (axis.perp_dot(**at - centre) > 0.0) == is_left);
        let mut best: Option<(f32, u32)> = None;
        for (&at, &node) in on_side {
            let distance = (at - centre).dot(axis).abs();
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, node));
            }
        }
        best.map(|(_, node)| node)
    };
    Some([nearest(true)?, nearest(false)?])
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
