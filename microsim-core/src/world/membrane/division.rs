//! Division: a [furrow](super::furrow) closes around the equator of a cell, two links are swapped, one ring becomes two, and
//! each lobe keeps its content.

use crate::capability::division::Order;
use crate::capability::phagocytosis::{Engulfer, Meal};
use crate::error::Error;
use crate::event::Event;
use crate::float_environment::with_default_float_environment;
use crate::geometry::polygon::{centroid, contains_point};
use crate::geometry::ring::direction_or;
use crate::id::OrganismId;
use crate::organism::ring_surgery::{Swap, set_outline};
use crate::organism::{Organism, Phagosome, Storage};
use crate::rng::Rng;
use crate::world::World;
use glam::Vec2;

/// One side of a divided cell: a ring and its content.
struct Lobe {
    outline: Vec<u32>,
    fluid_particles: Vec<u32>,
    meals: Vec<Meal>,
    phagosomes: Vec<Phagosome>,
    centre: Vec2,
    /// Share of the cell's cytoplasm.
    share: f32,
}

impl World {
    /// Tells an amoeboid cell to divide across its longest axis. In the next step [`Event::DivisionBegan`] happens, or
    /// [`Event::DivisionRefused`] says why not; the cell rests until [`Event::Divided`] or [`Event::DivisionAbandoned`].
    /// One that has crawled in the last 1.5 s becomes round before its furrow begins to close.
    ///
    /// Cytoplasm is conserved. The membrane gets the nodes that two cells need, some 1.41 times as many.
    ///
    /// A body whose template has a cut ([`crate::TemplateBuilder::cut`]) is two at the end of the next step: [`Event::Divided`], or
    /// [`Event::DivisionRefused`] when there is no room any more. The first half keeps its handle; both have its controller,
    /// collision groups, gravity scale, damping, exchanges and user data. Joints of its nodes end, those of its centre stay with the
    /// first half. A half may overlap others, and the other half, by up to 0.5 of the sum of two radii, or 0.02 if it or the other
    /// one has an outline, and obstacles by 0.02 of a radius.
    ///
    /// # Errors
    /// When the handle is stale, or the organism is neither an amoeboid cell nor a body whose template has a cut. Of such a body:
    /// when it is frozen; when a half goes on with a template that this world has not, with nodes that cannot move, or that its
    /// controller cannot steer; when a half has too much or too little mass, is too large, would lie beyond a wall or overlap too
    /// much; when a thermal field would kick it beyond the speed limit; or when the world would hold too many particles.
    pub fn divide(&mut self, id: OrganismId) -> Result<(), Error> {
        let is_body = |organism: &Organism| organism.body.membrane().is_none() && organism.divider.is_some();
        if self.organisms.get(id).is_some_and(is_body) {
            with_default_float_environment(|| self.plan_cut(id))?;
        }
        self.give_order(id, Order::Divide { axis: None })
    }

    /// The same, with one lobe to each side along `axis`.
    ///
    /// # Errors
    /// When the handle is stale, the organism is no amoeboid cell, or the axis is zero or not finite.
    pub fn divide_along(&mut self, id: OrganismId, axis: Vec2) -> Result<(), Error> {
        let axis = with_default_float_environment(|| direction_or(axis, Vec2::ZERO));
        if axis == Vec2::ZERO {
            return Err(Error::unsupported("axis", "a finite vector that is not zero"));
        }
        self.give_order(id, Order::Divide { axis: Some(axis) })
    }

    pub(super) fn begin_division(&mut self, id: OrganismId, axis: Option<Vec2>) {
        let Some(organism) = self.organisms.get(id) else { return };
        match self.plan_furrow(organism, axis) {
            Ok(furrow) => {
                let Self { organisms, fluids, .. } = self;
                let Some(organism) = organisms.get_mut(id) else { return };
                organism.record_nodes_per_root(fluids);
                let Some(divider) = organism.divider.as_mut() else { return };
                divider.furrow = Some(furrow);
                divider.wanted_nodes = None;
                self.events.push(Event::DivisionBegan { organism: id });
            }
            Err(reason) => self.events.push(Event::DivisionRefused { organism: id, reason }),
        }
    }

    /// Splits a cell: the lobe that is cut off becomes an organism with the same properties, but a handle and random numbers
    /// of its own.
    pub(in crate::world) fn split(&mut self, id: OrganismId, swap: &Swap) {
        let Some(parent) = self.organisms.get(id) else { return };
        let (kept, cut) = swap.cut(&parent.outline);
        let (kept, cut) = (self.lobe(parent, kept), self.lobe(parent, cut));
        let mut daughter = parent.clone();
        let daughter_id = self.organisms.next_id();
        daughter.rng = Rng::new(self.config.seed, daughter_id.stream());
        if let Some(pseudopods) = daughter.locomotion.pseudopods_mut() {
            pseudopods.rng = Rng::new(self.config.seed, daughter_id.crawl_stream());
        }
        daughter.home = cut.centre;
        daughter.engulfer = daughter.engulfer.map(|engulfer| Engulfer::new(engulfer.params));
        daughter.fluid = daughter.fluid.map(|fluid| {
            let fluid = &self.fluids[fluid as usize];
            let (params, is_enclosed) = (fluid.params, fluid.is_enclosed);
            self.fluid_for(params, is_enclosed) as u32
        });
        let fluid = self.organisms.get(id).and_then(|parent| parent.fluid);
        self.exemptions.inherit(id.index, daughter_id.index);
        self.organisms.insert(daughter);
        self.move_cytoplasm(&cut.fluid_particles, fluid, daughter_id);
        self.move_meals(&cut.meals, id, daughter_id);
        self.reduce_to_lobe(id, kept);
        self.reduce_to_lobe(daughter_id, cut);
        self.events.push(Event::Divided { parent: id, daughter: daughter_id });
    }

    /// A ring of a cell with its content.
    fn lobe(&self, cell: &Organism, outline: Vec<u32>) -> Lobe {
        let ring: Vec<Vec2> = outline.iter().map(|&i| self.particles.position(i as usize)).collect();
        let is_inside = |i: u32| contains_point(&ring, self.particles.position(i as usize));
        let fluid_particles: Vec<u32> = cell.fluid_particles.iter().copied().filter(|&i| is_inside(i)).collect();
        let holds = |meal: &&Meal| self.discs_of(meal.prey).next().is_some_and(|i| is_inside(i as u32));
        let meals = cell.meals().iter().filter(|meal| meal.phase.is_inside());
        let meals: Vec<Meal> = meals.filter(holds).cloned().collect();
        let is_of_meal = |inner: &&Phagosome| meals.iter().any(|meal| meal.prey == inner.prey);
        Lobe {
            phagosomes: cell.phagosomes.iter().filter(is_of_meal).cloned().collect(),
            share: fluid_particles.len() as f32 / cell.fluid_particles.len() as f32,
            centre: centroid(&ring).unwrap_or(cell.home),
            outline,
            fluid_particles,
            meals,
        }
    }

    /// Reduces a divided cell to one of its lobes, at rest.
    fn reduce_to_lobe(&mut self, id: OrganismId, lobe: Lobe) {
        let Self { organisms, particles, fluids, .. } = self;
        let Some(organism) = organisms.get_mut(id) else { return };
        let before = organism.outline.len();
        if let Storage::Loose { particles: body, membrane: Some(membrane) } = &mut organism.body {
            *membrane = membrane.resized(before, lobe.outline.len());
            *body = lobe.outline.iter().chain(lobe.phagosomes.iter().flat_map(|inner| &inner.ring)).copied().collect();
            body.iter().for_each(|&node| particles.owner[node as usize] = id.index);
        }
        organism.phagosomes = lobe.phagosomes;
        organism.fluid_particles = lobe.fluid_particles;
        organism.spawn_area *= lobe.share;
        organism.locomotion.stop();
        organism.goal = None;
        set_outline(organism, lobe.outline, particles);
        if let Some(divider) = &mut organism.divider {
            divider.end();
        }
        organism.update_wanted_nodes(fluids);
    }
}
