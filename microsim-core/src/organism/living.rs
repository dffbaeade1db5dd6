//! The living organism: its state, and what follows from it alone.

use super::storage::Storage;
use crate::capability::Locomotion;
use crate::capability::controller::Controller;
use crate::capability::crawl::Pseudopods;
use crate::capability::division::{Divider, Furrow};
use crate::capability::exchange::Exchange;
use crate::capability::phagocytosis::{Engulfer, IngestionWay, Meal, MealPhase, Prey, PreyClass};
use crate::capability::progress::Progress;
use crate::id::OrganismId;
use crate::kind::Kind;
use crate::particle::Particles;
use crate::rng::Rng;
use crate::solver::fluid::{self, Fluid};
use crate::solver::membrane::{Flexibility, Membrane, MembraneContent};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::PI;

/// Rate at which stretching of a cell is damped, 1/s, times its number of particles of cytoplasm to the power of 3/4.
const STRETCH_DAMPING: f32 = 450.0;

/// Length of links, in rest lengths, up to which a membrane gives up nodes. Their number goes with the root of the content, but the
/// circle around the content has a rim besides: links of a smaller cell are longer.
const LONGEST_AT_REST: f32 = 1.1;

/// Largest area, length, time or count in the state of an organism.
pub(crate) const MOST: f32 = 1e9;
/// Most nodes that a membrane is on its way to.
pub(crate) const MOST_WANTED_NODES: u32 = (1 << 30) - 1;
/// Largest speed that an organism is capable of, units/s.
pub(crate) const MAX_SPEED: f32 = 1000.0;

/// A ring of membrane around prey inside a cell. Its nodes belong to the cell.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Phagosome {
    pub prey: OrganismId,
    /// Particles, counter-clockwise.
    pub ring: Vec<u32>,
    pub membrane: Membrane,
    /// Area that it has room for, square units.
    pub area: f32,
}

/// One living organism.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Organism {
    pub kind: Kind,
    pub body: Storage,
    /// Slots in its block; 0 for a loose body.
    pub slots: u32,
    /// Nodes of its outline, counter-clockwise.
    pub outline: Vec<u32>,
    /// Index of the fluid that it holds or consists of.
    pub fluid: Option<u32>,
    /// Its particles in that fluid, in the order in which they came.
    pub fluid_particles: Vec<u32>,
    pub locomotion: Locomotion,
    pub speed: f32,
    pub controller: Controller,
    pub rng: Rng,
    /// Area that it had when it was spawned, square units; changes only by scaling (thesis, 3.3.1). Of a cell with a membrane that
    /// is held: that which it had when its ingestion began.
    pub spawn_area: f32,
    /// Its size relative to its template when it was spawned.
    pub spawn_scale: f32,
    /// The size that it returns to, relative to its size when it was spawned.
    pub full_scale: f32,
    /// The capability to take others in.
    pub engulfer: Option<Engulfer>,
    /// The capability to be taken in. A cell with a membrane has it while it is held.
    pub prey: Option<Prey>,
    /// What cups have cut off its membrane, around prey inside.
    pub phagosomes: Vec<Phagosome>,
    /// The capability to divide and to fuse.
    pub divider: Option<Divider>,
    /// What it gives to chemicals and takes from them.
    pub exchanges: Vec<Exchange>,
    /// Where it wanted to go in the last step.
    pub goal: Option<Vec2>,
    /// Speed that it wanted then, in its own; negative: backwards.
    pub relative_speed: f32,
    /// Whether it gets anywhere.
    pub progress: Progress,
    /// Where it was spawned.
    pub home: Vec2,
    pub is_quarantined: bool,
    /// Share of gravity that acts on it.
    pub gravity_scale: f32,
    /// Damping of its motion as a whole besides that of the medium, 1/s.
    pub linear_damping: f32,
    /// Damping of its rotation as a whole, 1/s.
    pub angular_damping: f32,
    /// The embedder's: low and high half.
    pub user_data: [u64; 2],
}

/// Stands for a step that is not the present one.
impl Organism {
    /// Area of its full size, square units.
    pub(crate) fn full_area(&self) -> f32 {
        self.spawn_area * (self.full_scale * self.full_scale)
    }

    /// Particles of the outline, counter-clockwise.
    pub(crate) fn outline_particles(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        self.outline.iter().map(|&node| self.body.particle(node))
    }

    /// The first particle of its body, if it has one.
    pub(crate) fn first_node(&self) -> Option<u32> {
        match &self.body {
            Storage::Lane { first, .. } => Some(*first),
            Storage::Loose { particles, .. } => particles.first().copied(),
        }
    }

    /// Whether it has a damping of its own.
    pub(crate) fn is_damped(&self) -> bool {
        self.linear_damping > 0.0 || self.angular_damping > 0.0
    }

    /// Whether somebody has taken it in, or is about to.
    pub(crate) fn is_held(&self) -> bool {
        self.prey.is_some_and(|prey| prey.held_by.is_some())
    }

    /// Notes who has taken it in, if it is prey at all, or a cell.
    pub(crate) fn set_held_by(&mut self, holder: Option<OrganismId>) {
        self.prey = match self.is_cell() {
            true => holder.map(|_| Prey { class: PreyClass::Soft, held_by: holder }),
            false => self.prey.map(|prey| Prey { held_by: holder, ..prey }),
        };
    }

    /// Whether it has a membrane.
    pub(crate) fn is_cell(&self) -> bool {
        self.body.membrane().is_some()
    }

    /// What it is to somebody who takes prey in this way, if it can be taken in now. Cells are prey of those with a wide gate while
    /// they hold nothing themselves: what is inside lies in one membrane of another.
    pub(crate) fn class_for(&self, way: IngestionWay) -> Option<PreyClass> {
        if self.is_held() || self.is_quarantined {
            return None;
        }
        if !self.is_cell() {
            return self.prey.map(|prey| prey.class);
        }
        let holds_nothing = self.meals().iter().all(|meal| matches!(meal.phase, MealPhase::Touching(_)));
        let is_whole = self.furrow().is_none() && self.fluid.is_some();
        (way == IngestionWay::WideGate && holds_nothing && is_whole).then_some(PreyClass::Soft)
    }

    /// Area that a cell takes up at rest, square units: that of its cytoplasm and of its membrane around it.
    pub(crate) fn cell_area(&self, fluids: &[Fluid]) -> Option<f32> {
        let (membrane, fluid) = (self.body.membrane()?, self.fluid?);
        let content = fluid::rest_area(self.fluid_particles.len(), fluids[fluid as usize].params.spacing);
        let radius = (content / PI).sqrt() + membrane.rim + membrane.node_radius;
        Some(at_most(PI * radius * radius))
    }

    /// How much farther apart its cytoplasm is than at rest: more where it has spread.
    pub(crate) fn spread_length(&self) -> f32 {
        self.locomotion.pseudopods().map_or(1.0, |pseudopods| pseudopods.spread.sqrt())
    }

    /// Distance of its particles of cytoplasm.
    pub(crate) fn fluid_spacing(&self, fluids: &[Fluid]) -> Option<f32> {
        Some(fluids[self.fluid? as usize].params.spacing * self.spread_length())
    }

    /// Takes note of the command to digest; returns whether it may move.
    pub(crate) fn obey(&mut self, digests: bool) -> bool {
        let is_free = self.engulfer.as_mut().is_none_or(|engulfer| {
            engulfer.digests = digests;
            !engulfer.is_locked()
        });
        is_free && self.furrow().is_none()
    }

    /// Its furrow, if it is dividing.
    pub(crate) fn furrow(&self) -> Option<Furrow> {
        self.divider.as_ref().and_then(|divider| divider.furrow)
    }

    /// Whether it becomes round before its furrow begins to close: it has crawled until now.
    pub(crate) fn rounds_up(&self) -> bool {
        let waits = self.furrow().is_some_and(|furrow| furrow.elapsed == 0.0) && !self.is_quarantined;
        waits && self.body.membrane().is_some_and(Membrane::is_active)
    }

    /// Speed that it wants to move with, units/s; negative: backwards.
    pub(crate) fn present_speed(&self) -> f32 {
        self.relative_speed * self.own_speed()
    }

    /// Speed that it is capable of, units/s: less while it digests.
    pub(crate) fn own_speed(&self) -> f32 {
        let slowed = self.engulfer.as_ref().filter(|engulfer| engulfer.is_digesting());
        slowed.map_or(self.speed, |engulfer| self.speed * engulfer.params.digestion_speed)
    }

    /// Whether it is fluid that no membrane holds: what happens to it happens to its particles one by one.
    pub(crate) fn is_free_fluid(&self) -> bool {
        matches!(self.body, Storage::Loose { membrane: None, .. }) && !self.is_quarantined
    }

    /// Whether it is crawling in this step.
    pub(crate) fn crawls(&self) -> bool {
        self.locomotion.crawling_front().is_some()
    }

    /// Rate at which its stretching is damped, 1/s, if it is a cell at rest: it neither crawls nor divides, fuses or takes anything in.
    /// One and a half times the angular frequency with which a stretched cell would swing, which falls with the content `n` as `n^(-3/4)`.
    pub(crate) fn stretch_damping(&self) -> Option<f32> {
        let ingests = |meal: &Meal| matches!(meal.phase, MealPhase::Ingesting(_));
        let divides = |divider: &Divider| divider.furrow.is_some() || divider.lobes > 1.0;
        let is_busy = self.crawls() || self.divider.as_ref().is_some_and(divides) || self.meals().iter().any(ingests);
        let root = (self.fluid_particles.len() as f32).sqrt();
        (!is_busy && !self.is_quarantined && root > 0.0).then(|| STRETCH_DAMPING / (root * root.sqrt()))
    }

    /// Finds this step's tension of its membrane, if it has one.
    pub(crate) fn relax_membrane(&mut self, particles: &Particles, fluids: &[Fluid], dt: f32) {
        let (held_area, folds) =
            self.engulfer.as_ref().map_or((0.0, 0.0), |engulfer| (engulfer.held_area, engulfer.fold_length));
        let is_driven = self.crawls();
        let lobes = self.divider.as_ref().map_or(1.0, |divider| divider.lobes);
        let spacing = self.fluid_spacing(fluids);
        let (Storage::Loose { membrane: Some(membrane), .. }, Some(spacing)) = (&mut self.body, spacing) else {
            return;
        };
        let area = fluid::rest_area(self.fluid_particles.len(), spacing) + held_area;
        let content = MembraneContent { area, lobes, folds };
        let pseudopods = self.locomotion.pseudopods().filter(|pseudopods| pseudopods.protrudes());
        let stiffness = pseudopods.map_or(Vec::new(), Pseudopods::stiffness);
        let slack = pseudopods.map(|pseudopods| pseudopods.params.slack);
        let flexibility = Flexibility { slack, stiffness: &stiffness };
        membrane.relax(&self.outline, particles, content, is_driven, flexibility, dt);
        for phagosome in &mut self.phagosomes {
            let content = MembraneContent { area: phagosome.area, lobes: 1.0, folds: 0.0 };
            phagosome.membrane.relax(&phagosome.ring, particles, content, false, Flexibility::LEAST, dt);
        }
    }

    /// The prey that it touches or holds; empty for organisms that are no engulfers.
    pub(crate) fn meals(&self) -> &[Meal] {
        self.engulfer.as_ref().map_or(&[], |engulfer| &engulfer.meals)
    }

    /// Positions of its outline.
    pub(crate) fn outline_positions(&self, particles: &Particles) -> Vec<Vec2> {
        self.outline_particles().map(|i| particles.position(i as usize)).collect()
    }

    /// All membranes with their rings: its own, and those of its phagosomes.
    pub(crate) fn membranes(&self) -> impl Iterator<Item = (&Membrane, &[u32])> {
        let own = self.body.membrane().map(|membrane| (membrane, self.outline.as_slice()));
        own.into_iter().chain(self.phagosomes.iter().map(|inner| (&inner.membrane, inner.ring.as_slice())))
    }

    /// What its membrane goes round, in particles of cytoplasm; prey inside and growth to come count by their area.
    pub(crate) fn content(&self, fluids: &[Fluid]) -> f32 {
        let each = self.fluid.map_or(1.0, |fluid| fluid::rest_area(1, fluids[fluid as usize].params.spacing));
        let eaten = self.engulfer.as_ref().map_or(0.0, |engulfer| engulfer.held_area + engulfer.pending_growth);
        self.fluid_particles.len() as f32 + eaten / each
    }

    /// Remembers how many nodes its membrane has for its content, so that it can have as many again, unless it remembers a
    /// number already: that of a membrane on its way, or rounded to whole nodes, would grow with each division and fusion.
    pub(crate) fn record_nodes_per_root(&mut self, fluids: &[Fluid]) {
        if self.divider.as_ref().is_some_and(|divider| divider.nodes_per_root.is_none()) {
            self.set_nodes_per_root(self.outline.len() as u32, fluids);
        }
    }

    /// Takes nodes that it was given for more than its content asks for.
    pub(crate) fn add_wanted_nodes(&mut self, added: u32, fluids: &[Fluid]) {
        let Some(divider) = self.divider.as_mut().filter(|divider| divider.nodes_per_root.is_some()) else { return };
        divider.wanted_nodes = divider.wanted_nodes.map(|wanted| (wanted + added).min(MOST_WANTED_NODES));
        let nodes = divider.wanted_nodes.unwrap_or(self.outline.len() as u32);
        self.set_nodes_per_root((nodes as f32 / self.unfolding()) as u32, fluids);
    }

    fn set_nodes_per_root(&mut self, nodes: u32, fluids: &[Fluid]) {
        let nodes_per_root = nodes as f32 / self.content(fluids).sqrt();
        if let Some(divider) = &mut self.divider {
            divider.nodes_per_root = Some(at_most(nodes_per_root));
        }
    }

    /// Membrane over that at rest: folds of it open while pseudopods extend.
    fn unfolding(&self) -> f32 {
        let pseudopods = self.locomotion.pseudopods().filter(|pseudopods| pseudopods.protrudes());
        pseudopods.map_or(1.0, |pseudopods| 1.0 + pseudopods.params.slack)
    }

    /// Lets folds of its membrane open and close with its pseudopods, if it has any.
    pub(crate) fn unfold(&mut self, fluids: &[Fluid]) {
        if self.locomotion.pseudopods().is_some() {
            self.record_nodes_per_root(fluids);
            self.update_wanted_nodes(fluids);
        }
    }

    /// Sends its membrane on the way to the number of nodes that suits its content.
    pub(crate) fn update_wanted_nodes(&mut self, fluids: &[Fluid]) {
        let root = self.content(fluids).sqrt() * self.unfolding();
        if let Some(divider) = &mut self.divider {
            divider.wanted_nodes = divider.nodes_per_root.map(|per_root| wanted(per_root * root));
        }
    }

    /// Nodes that its membrane lacks to go round its cytoplasm once.
    pub(crate) fn missing_nodes(&self) -> u32 {
        let Some(membrane) = self.body.membrane() else { return 0 };
        let wanted = membrane.rest_perimeter() / membrane.rest_length;
        u32::from(wanted > self.outline.len() as f32 + 0.5)
    }

    /// Whether its membrane is so short that it goes round with a node less.
    pub(crate) fn has_spare_node(&self) -> bool {
        let fewest = self
            .body
            .membrane()
            .map_or(f32::INFINITY, |membrane| membrane.rest_perimeter() / (LONGEST_AT_REST * membrane.rest_length));
        fewest + 1.0 < self.outline.len() as f32
    }

    /// The particle of a node, see [`Organism::particles`].
    pub(crate) fn particle_of(&self, node: u32) -> Option<u32> {
        self.particles().nth(node as usize)
    }

    /// All its particles: those of the body by node, then the fluid.
    pub(crate) fn particles(&self) -> impl Iterator<Item = u32> + '_ {
        let loose: &[u32] = match &self.body {
            Storage::Lane { .. } => &[],
            Storage::Loose { particles, .. } => particles,
        };
        let in_lane = (0..self.slots).map(|slot| self.body.particle(slot));
        in_lane.chain(loose.iter().copied()).chain(self.fluid_particles.iter().copied())
    }
}

/// What is kept of a number that grows: at most [`MOST`].
pub(crate) fn at_most(value: f32) -> f32 {
    if value < MOST { value } else { MOST }
}

/// So many nodes, rounded.
fn wanted(nodes: f32) -> u32 {
    ((nodes + 0.5) as u32).min(MOST_WANTED_NODES)
}
