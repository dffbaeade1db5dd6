//! A world made from state that was read: derived parts are made anew, and everything is checked that stepping takes for
//! granted. What passes here may be nonsense, but cannot make a step panic.

use super::{Guard, World};
use crate::capability::Locomotion;
use crate::chemical;
use crate::collision::filter::Exemptions;
use crate::collision::obstacle::Obstacle;
use crate::config::WorldConfig;
use crate::error::Error;
use crate::event::Event;
use crate::organism::ring_surgery::LEAST_NODES;
use crate::organism::table::Organisms;
use crate::organism::{Body, Organism, Phagosome};
use crate::particle::{NO_OWNER, Particles};
use crate::solver::block::Block;
use crate::solver::fluid::Fluid;
use crate::solver::lanes::LANES;
use crate::template::Template;
use crate::world::touching::Touching;
use serde::Deserialize;

/// More than any run counts, and far from overflow.
const MOST: u64 = 1 << 53;
const MOST_NODES: u32 = 1 << 30;
/// Stands for the owner of a lane that is empty, to tell it from a free index.
const EMPTY_LANE: u32 = NO_OWNER - 1;

/// What [`World`] writes, field by field.
#[derive(Debug, Deserialize)]
pub(crate) struct State {
    step_index: u64,
    config: WorldConfig,
    particles: Particles,
    organisms: Organisms,
    templates: Vec<Template>,
    blocks: Vec<Block>,
    fluids: Vec<Fluid>,
    chemicals: Vec<chemical::Record>,
    exemptions: Exemptions,
    touching: Touching,
    events: Vec<Event>,
    guard: Guard,
    obstacle_digests: Vec<u64>,
}

impl World {
    /// The world of this state with these obstacles.
    ///
    /// # Errors
    /// Says which part of the state cannot be one of a world.
    pub(crate) fn restore(state: State, obstacles: Vec<Obstacle>) -> Result<Self, String> {
        let mut world = Self::new(state.config).map_err(|error| error.within("config").to_string())?;
        for (k, obstacle) in obstacles.into_iter().enumerate() {
            world.add_obstacle(obstacle).map_err(|error| error.within(&format!("obstacles[{k}]")).to_string())?;
        }
        ensure(world.obstacle_digests == state.obstacle_digests, || "obstacles: not what they were")?;
        for (k, record) in state.chemicals.into_iter().enumerate() {
            let added = world.add_chemical(record.spec).map_err(|error| error.to_string()).map(drop);
            let filled = added.and_then(|()| world.chemicals[k].take_over(record));
            filled.map_err(|flaw| format!("chemicals[{k}]: {flaw}"))?;
        }
        world.step_index = state.step_index;
        world.particles = state.particles;
        world.organisms = state.organisms;
        world.templates = state.templates;
        world.blocks = state.blocks;
        world.fluids = state.fluids;
        world.exemptions = state.exemptions;
        world.touching = state.touching;
        world.events = state.events;
        world.guard = state.guard;
        world.particles.complete()?;
        world.organisms.complete();
        world.check_structure()?;
        // Measures look at the pairs that the last step found; until the next one these stand for them.
        if world.step_index > 0 {
            crate::step::find_pairs(&mut world);
        }
        Ok(world)
    }

    /// Checks that every index names something, that every particle has one owner, and that numbers are in their ranges.
    fn check_structure(&self) -> Result<(), String> {
        let Guard { wrong_side, net_fired } = self.guard;
        let is_counter = |count: u64| count < MOST;
        ensure([self.step_index, wrong_side, net_fired].into_iter().all(is_counter), || "a counter is too large")?;
        self.check_slots()?;
        let mut owned = vec![NO_OWNER; self.particles.len()];
        self.check_blocks(&mut owned)?;
        for (id, organism) in self.organisms.iter() {
            let checked = self.check_organism(organism).and_then(|()| self.claim(id.index, organism, &mut owned));
            checked.map_err(|flaw| format!("organisms[{}].{flaw}", id.index))?;
        }
        self.check_fluids()?;
        self.check_particles(&owned)
    }

    /// Checks that exactly the empty slots of organisms are free, each once.
    fn check_slots(&self) -> Result<(), String> {
        let mut free = self.organisms.free_slots().to_vec();
        free.sort_unstable();
        let empty = (0..self.organisms.slot_count()).filter(|&index| self.organisms.id_at(index).is_none());
        ensure(empty.eq(free), || "organisms.free: not the empty slots")
    }

    /// Checks blocks and notes who lives in their lanes.
    fn check_blocks(&self, owned: &mut [u32]) -> Result<(), String> {
        let mut end = 0;
        for (k, block) in self.blocks.iter().enumerate() {
            let template = self.templates.get(block.template as usize);
            let slots = template.map_or(0, |template| template.nodes().len());
            let (first, after) = (block.base as usize, block.base as usize + slots * LANES);
            let fits = slots > 0 && slots == block.slots as usize && first >= end && after <= owned.len();
            ensure(fits, || format!("blocks[{k}]: its template does not fit where it lies"))?;
            let is_scale = |scale: &f32| scale.is_finite() && *scale > 0.0;
            ensure(block.scale.iter().all(is_scale), || format!("blocks[{k}].scale: not positive"))?;
            for (lane, &owner) in block.owner.iter().enumerate() {
                let holder = self.organisms.id_at(owner).and_then(|id| self.organisms.get(id));
                let place = holder.and_then(|organism| match organism.body {
                    Body::Lane { block, first } => Some((block as usize, first)),
                    Body::Loose { .. } => None,
                });
                let is_home = place == Some((k, block.particle(0, lane)));
                ensure(owner == NO_OWNER || is_home, || format!("blocks[{k}].owner[{lane}]: lives elsewhere"))?;
                let owner = if owner == NO_OWNER { EMPTY_LANE } else { owner };
                (0..block.slots).for_each(|slot| owned[block.particle(slot, lane) as usize] = owner);
            }
            end = after;
        }
        Ok(())
    }

    /// Checks what an organism says of itself.
    fn check_organism(&self, organism: &Organism) -> Result<(), String> {
        let (nodes, membrane) = (organism.outline.len(), organism.body.membrane());
        let in_outline = |k: u32| (k as usize) < nodes;
        let can_move = match organism.locomotion {
            Locomotion::None | Locomotion::Tow { .. } => true,
            Locomotion::FrontPull { front } => in_outline(front),
            Locomotion::Crawl { front_centre } => membrane.is_some() && front_centre.is_none_or(in_outline),
        };
        ensure(can_move, || "locomotion: not possible with this outline")?;
        let needs_membrane =
            organism.engulfer.is_some() || organism.divider.is_some() || !organism.phagosomes.is_empty();
        ensure(membrane.is_some() || !needs_membrane, || "body: lacks a membrane")?;
        ensure(membrane.is_none() || nodes >= LEAST_NODES, || "outline: too few nodes")?;
        let is_ring = |inner: &Phagosome| inner.ring.len() >= LEAST_NODES;
        ensure(organism.phagosomes.iter().all(is_ring), || "phagosomes: too few nodes")?;
        ensure(organism.fluid.is_none_or(|fluid| (fluid as usize) < self.fluids.len()), || "fluid: does not exist")?;
        let wanted = organism.divider.as_ref().and_then(|divider| divider.wanted_nodes);
        ensure(wanted.is_none_or(|nodes| nodes < MOST_NODES), || "divider.wanted_nodes: too many")?;
        let in_words = |error: Error, field: &str| error.within(field).to_string();
        organism.controller.validate().map_err(|error| in_words(error, "controller"))?;
        let suits = self.check_controller(&organism.controller, &organism.locomotion, nodes > 0);
        suits.map_err(|error| error.to_string())?;
        for exchange in &organism.exchanges {
            let is_known = self.check_chemical(exchange.chemical, "chemical").and_then(|()| exchange.validate());
            is_known.map_err(|error| in_words(error, "exchanges"))?;
        }
        let engulfer = organism.engulfer.as_ref().map_or(Ok(()), |engulfer| engulfer.params.validate());
        engulfer.map_err(|error| in_words(error, "engulfer"))?;
        let divider = organism.divider.as_ref().map_or(Ok(()), |divider| divider.params.validate());
        divider.map_err(|error| in_words(error, "divider"))
    }

    /// Notes the particles of an organism, which nobody may own yet, and checks those that it names.
    fn claim(&self, index: u32, organism: &Organism, owned: &mut [u32]) -> Result<(), String> {
        let loose: &[u32] = match &organism.body {
            Body::Lane { block, first } => {
                let block = self.blocks.get(*block as usize).filter(|block| block.slots == organism.slots);
                let is_home = |block: &Block| {
                    let lane = block.owner.iter().position(|&owner| owner == index);
                    lane.is_some_and(|lane| block.particle(0, lane) == *first)
                };
                ensure(block.is_some_and(is_home), || "body: not in its block")?;
                let in_slots = organism.outline.iter().all(|&slot| slot < organism.slots);
                ensure(in_slots, || "outline: names a slot that does not exist")?;
                &[]
            }
            Body::Loose { particles, .. } => {
                ensure(organism.slots == 0, || "slots: of a body that is in no block")?;
                particles
            }
        };
        for &i in loose.iter().chain(&organism.fluid_particles) {
            let place = owned.get_mut(i as usize).filter(|place| **place == NO_OWNER);
            *place.ok_or_else(|| format!("particles: {i} does not exist or is somebody's"))? = index;
        }
        let are_own = |ring: &[u32]| {
            let mut known = ring.to_vec();
            known.sort_unstable();
            known.dedup();
            known.len() == ring.len() && ring.iter().all(|&i| owned.get(i as usize) == Some(&index))
        };
        ensure(are_own(&organism.outline_particles().collect::<Vec<_>>()), || "outline: not of its own particles")?;
        ensure(
            organism.phagosomes.iter().all(|inner| are_own(&inner.ring)),
            || "phagosomes: not of its own particles",
        )?;
        let gates = organism.engulfer.iter().flat_map(|engulfer| engulfer.meals.iter().flat_map(|meal| &meal.gate));
        let furrow = organism.furrow().map_or([0; 2], |furrow| furrow.nodes);
        let mut named = gates.chain(if owned.is_empty() { &[] } else { &furrow[..] });
        ensure(named.all(|&i| (i as usize) < owned.len()), || "engulfer, divider: name a particle that does not exist")
    }

    fn check_fluids(&self) -> Result<(), String> {
        let p = &self.particles;
        let mut is_known = vec![false; p.len()];
        for (k, fluid) in self.fluids.iter().enumerate() {
            fluid.params.validate().map_err(|error| error.within(&format!("fluids[{k}]")).to_string())?;
            for &i in &fluid.particles {
                let is_in_it = p.fluid.get(i as usize) == Some(&(k as u32 + 1)) && p.is_live(i as usize);
                let is_new = is_in_it && !std::mem::replace(&mut is_known[i as usize], true);
                ensure(is_new, || format!("fluids[{k}].particles: {i} is not in it, or is twice"))?;
            }
        }
        Ok(())
    }

    fn check_particles(&self, owned: &[u32]) -> Result<(), String> {
        let p = &self.particles;
        for (i, &owner) in owned.iter().enumerate() {
            let owner = if owner == EMPTY_LANE { NO_OWNER } else { owner };
            let next = p.next_in_ring[i];
            let is_sound = p.owner[i] == owner
                && (next == NO_OWNER || (next as usize) < owned.len())
                && p.fluid[i] as usize <= self.fluids.len();
            ensure(is_sound, || format!("particles[{i}]: owner, next_in_ring or fluid names nothing"))?;
        }
        let mut is_known = vec![false; p.len()];
        for &i in p.free_indices() {
            let is_free = owned.get(i as usize) == Some(&NO_OWNER);
            let is_new = is_free && !std::mem::replace(&mut is_known[i as usize], true);
            ensure(is_new, || format!("particles.free: {i} is not free, or is twice"))?;
        }
        Ok(())
    }
}

fn ensure<T: Into<String>>(holds: bool, flaw: impl FnOnce() -> T) -> Result<(), String> {
    if holds { Ok(()) } else { Err(flaw().into()) }
}
