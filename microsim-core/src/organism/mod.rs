//! Organisms: recipes over the generic solver, one file each. A spec is plain data; its [`Blueprint`] says what particles,
//! constraints and locomotion it amounts to.

pub(crate) mod agar;
pub(crate) mod bacillus;
pub(crate) mod coccus;
pub(crate) mod filled_chain;
pub(crate) mod fluid_block;
pub(crate) mod platelet;
pub(crate) mod probe;
pub(crate) mod red_cell;
pub(crate) mod ring_surgery;
pub(crate) mod soft_body;
pub(crate) mod table;

use crate::capability::Locomotion;
use crate::capability::controller::Controller;
use crate::capability::division::{Divider, DivisionParams, Furrow};
use crate::capability::exchange::Exchange;
use crate::capability::phagocytosis::{Engulfer, Meal, PhagocytosisParams, Prey, PreyClass};
use crate::capability::progress::Progress;
use crate::error::{Error, in_range};
use crate::geometry::ring::{rotate, unit_vector};
use crate::id::OrganismId;
use crate::kind::Kind;
use crate::particle::Particles;
use crate::rng::Rng;
use crate::solver::block::Block;
use crate::solver::fluid::{self, Fluid, FluidParams};
use crate::solver::lanes::LANES;
use crate::solver::membrane::{Membrane, MembraneContent};
use crate::template::Template;
use glam::Vec2;
use parry2d::bounding_volume::Aabb;
use serde::{Deserialize, Serialize};

/// Any organism, as plain data.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum OrganismSpec {
    /// See [`soft_body::RigidCellSpec`].
    RigidCell(soft_body::RigidCellSpec),
    /// See [`filled_chain::AmoeboidCellSpec`].
    AmoeboidCell(filled_chain::AmoeboidCellSpec),
    /// See [`platelet::PlateletSpec`].
    Platelet(platelet::PlateletSpec),
    /// See [`agar::AgarSpec`].
    Agar(agar::AgarSpec),
    /// See [`probe::ProbeSpec`].
    Probe(probe::ProbeSpec),
    /// See [`fluid_block::FluidBlockSpec`].
    FluidBlock(fluid_block::FluidBlockSpec),
    /// See [`red_cell::RedCellSpec`].
    RedCell(red_cell::RedCellSpec),
    /// See [`coccus::CoccusSpec`].
    Coccus(coccus::CoccusSpec),
    /// See [`bacillus::BacillusSpec`].
    Bacillus(bacillus::BacillusSpec),
}

impl OrganismSpec {
    /// What it amounts to in particles and constraints.
    pub(crate) fn blueprint(&self) -> Result<Blueprint, Error> {
        match self {
            Self::RigidCell(spec) => spec.blueprint(),
            Self::AmoeboidCell(spec) => spec.blueprint(),
            Self::Platelet(spec) => spec.blueprint(),
            Self::Agar(spec) => spec.blueprint(),
            Self::Probe(spec) => spec.blueprint(),
            Self::FluidBlock(spec) => spec.blueprint(),
            Self::RedCell(spec) => spec.blueprint(),
            Self::Coccus(spec) => spec.blueprint(),
            Self::Bacillus(spec) => spec.blueprint(),
        }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.blueprint().map(drop)
    }

    /// Whether it moves by itself, so that a controller or an input can steer it.
    #[must_use]
    pub fn can_move(&self) -> bool {
        self.blueprint().is_ok_and(|blueprint| blueprint.locomotion != Locomotion::None)
    }

    /// Number of particles that it takes.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn particle_count(&self) -> Result<usize, Error> {
        self.blueprint().map(|blueprint| blueprint.particle_count())
    }

    /// Farthest that it reaches from its place, units.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn extent(&self) -> Result<f32, Error> {
        self.blueprint().map(|blueprint| blueprint.extent())
    }
}

/// Where and how an organism is put into the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Its centre, units from the room's lower left corner.
    pub at: Vec2,
    /// Its direction, radians counter-clockwise from the x axis, within ±1000.
    pub angle: f32,
    /// Size relative to what its spec or template says, 0.01 to 100.
    pub scale: f32,
    /// What steers it when no input does.
    pub controller: Controller,
}

impl Placement {
    /// At this place, unturned, in its own size, steered by inputs only.
    #[must_use]
    pub fn at(x: f32, y: f32) -> Self {
        Self { at: Vec2::new(x, y), angle: 0.0, scale: 1.0, controller: Controller::Still }
    }

    /// The same with another controller.
    #[must_use]
    pub fn steered_by(mut self, controller: Controller) -> Self {
        self.controller = controller;
        self
    }

    /// The same, turned to `angle` radians.
    #[must_use]
    pub fn turned(mut self, angle: f32) -> Self {
        self.angle = angle;
        self
    }

    /// The same in another size.
    #[must_use]
    pub fn scaled(mut self, scale: f32) -> Self {
        self.scale = scale;
        self
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        in_range("at.x", self.at.x, -1e5, 1e5)?;
        in_range("at.y", self.at.y, -1e5, 1e5)?;
        in_range("angle", self.angle, -1000.0, 1000.0)?;
        in_range("scale", self.scale, 0.01, 100.0)?;
        self.controller.validate().map_err(|error| error.within("controller"))
    }

    /// Takes a point of the organism's own frame into the world's directions, relative to `origin`.
    pub(crate) fn place(&self, point: Vec2, scale: f32, origin: Vec2) -> Vec2 {
        (self.at - origin) + rotate(point * scale, unit_vector(self.angle))
    }
}

/// What a spec amounts to.
#[derive(Clone, Debug)]
pub(crate) struct Blueprint {
    pub kind: Kind,
    /// Its discs and constraints; none for fluid on its own.
    pub template: Option<Template>,
    /// Size of the organism relative to the template: templates of equal shape are shared by all sizes ...
    pub scale: f32,
    /// ... and masses.
    pub mass: f32,
    /// Its outline is a membrane, which may grow, rather than a ring that the template's constraints hold together.
    pub has_membrane: bool,
    pub fluid: Option<FluidPlan>,
    pub locomotion: Locomotion,
    /// Speed when it moves, units/s.
    pub speed: f32,
    /// Area when spawned, square units (seed, 3.3.1: of the initial ellipse).
    pub area: f32,
    pub engulfer: Option<PhagocytosisParams>,
    pub prey: Option<PreyClass>,
    pub divider: Option<DivisionParams>,
}

/// Fluid that comes with an organism.
#[derive(Clone, Debug)]
pub(crate) struct FluidPlan {
    pub params: FluidParams,
    /// Places in the organism's own frame.
    pub points: Vec<Vec2>,
    /// Whether it is held by a membrane of its own rather than mixing with other fluid of its kind.
    pub is_enclosed: bool,
}

impl Blueprint {
    pub(crate) fn particle_count(&self) -> usize {
        let nodes = self.template.as_ref().map_or(0, |template| template.nodes().len());
        nodes + self.fluid.as_ref().map_or(0, |fluid| fluid.points.len())
    }

    fn extent(&self) -> f32 {
        let body = self.template.as_ref().map_or(0.0, |template| template.extent() * self.scale);
        self.fluid
            .iter()
            .flat_map(|fluid| fluid.points.iter().map(|p| p.length() + 0.5 * fluid.params.spacing))
            .fold(body, |far, reach| if reach > far { reach } else { far })
    }
}

/// Where the particles of an organism lie in the store.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Body {
    /// In one lane of a block. `first` is the particle of slot 0.
    Lane { block: u32, first: u32 },
    /// At indices of their own: a membrane, or nothing but fluid.
    Loose { particles: Vec<u32>, membrane: Option<Membrane> },
}

impl Body {
    /// Particle of a node: a slot of a lane, or already an index.
    pub(crate) fn particle(&self, node: u32) -> u32 {
        match self {
            Self::Lane { first, .. } => first + node * LANES as u32,
            Self::Loose { .. } => node,
        }
    }

    /// Its block, and its lane there.
    pub(crate) fn lane(&self, blocks: &[Block]) -> Option<(u32, usize)> {
        match *self {
            Self::Lane { block, first } => Some((block, (first - blocks[block as usize].base) as usize)),
            Self::Loose { .. } => None,
        }
    }

    pub(crate) fn membrane_mut(&mut self) -> Option<&mut Membrane> {
        match self {
            Self::Lane { .. } => None,
            Self::Loose { membrane, .. } => membrane.as_mut(),
        }
    }

    pub(crate) fn membrane(&self) -> Option<&Membrane> {
        match self {
            Self::Lane { .. } => None,
            Self::Loose { membrane, .. } => membrane.as_ref(),
        }
    }
}

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
    pub body: Body,
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
    /// Area that it had when it was spawned, square units; changes only by scaling (seed, 3.3.1).
    pub spawn_area: f32,
    /// Its size relative to its template when it was spawned.
    pub spawn_scale: f32,
    /// The capability to take others in.
    pub engulfer: Option<Engulfer>,
    /// The capability to be taken in.
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
    /// The step in which it was spawned, and the box around it then: spares the search of what it overlaps.
    #[serde(skip, default = "long_ago")]
    pub spawned: (u64, Aabb),
    pub is_quarantined: bool,
}

/// Stands for a step that is not the present one.
fn long_ago() -> (u64, Aabb) {
    (u64::MAX, Aabb::new_invalid())
}

impl Organism {
    /// Particles of the outline, counter-clockwise.
    pub(crate) fn outline_particles(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        self.outline.iter().map(|&node| self.body.particle(node))
    }

    /// The first particle of its body, if it has one.
    pub(crate) fn first_node(&self) -> Option<u32> {
        match &self.body {
            Body::Lane { first, .. } => Some(*first),
            Body::Loose { particles, .. } => particles.first().copied(),
        }
    }

    /// Whether somebody has taken it in, or is about to.
    pub(crate) fn is_held(&self) -> bool {
        self.prey.is_some_and(|prey| prey.held_by.is_some())
    }

    /// Notes who has taken it in, if it is prey at all.
    pub(crate) fn set_held_by(&mut self, holder: Option<OrganismId>) {
        self.prey = self.prey.map(|prey| Prey { held_by: holder, ..prey });
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

    /// Speed that it wants to move with, units/s; negative: backwards.
    pub(crate) fn present_speed(&self) -> f32 {
        self.relative_speed * self.own_speed()
    }

    /// Speed that it is capable of, units/s: less while it digests.
    pub(crate) fn own_speed(&self) -> f32 {
        let slowed = self.engulfer.as_ref().filter(|engulfer| engulfer.is_digesting());
        slowed.map_or(self.speed, |engulfer| self.speed * engulfer.params.digestion_speed)
    }

    /// Whether it is crawling in this step.
    pub(crate) fn crawls(&self) -> bool {
        matches!(self.locomotion, Locomotion::Crawl { front_centre: Some(_) })
    }

    /// Finds this step's tension of its membrane, if it has one.
    pub(crate) fn relax_membrane(&mut self, particles: &Particles, fluids: &[Fluid], dt: f32) {
        let (held_area, folds) =
            self.engulfer.as_ref().map_or((0.0, 0.0), |engulfer| (engulfer.held_area, engulfer.fold_length));
        let is_driven = self.crawls();
        let lobes = self.divider.as_ref().map_or(1.0, |divider| divider.lobes);
        let (Body::Loose { membrane: Some(membrane), .. }, Some(fluid)) = (&mut self.body, self.fluid) else { return };
        let spacing = fluids[fluid as usize].params.spacing;
        let area = fluid::rest_area(self.fluid_particles.len(), spacing) + held_area;
        let content = MembraneContent { area, spacing, lobes, folds };
        membrane.relax(&self.outline, particles, content, is_driven, dt);
        for phagosome in &mut self.phagosomes {
            let content = MembraneContent { area: phagosome.area, spacing: 0.0, lobes: 1.0, folds: 0.0 };
            phagosome.membrane.relax(&phagosome.ring, particles, content, false, dt);
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
        divider.wanted_nodes = divider.wanted_nodes.map(|wanted| wanted + added);
        let nodes = divider.wanted_nodes.unwrap_or(self.outline.len() as u32);
        self.set_nodes_per_root(nodes, fluids);
    }

    fn set_nodes_per_root(&mut self, nodes: u32, fluids: &[Fluid]) {
        let nodes_per_root = nodes as f32 / self.content(fluids).sqrt();
        self.divider.iter_mut().for_each(|divider| divider.nodes_per_root = Some(nodes_per_root));
    }

    /// Sends its membrane on the way to the number of nodes that suits its content.
    pub(crate) fn update_wanted_nodes(&mut self, fluids: &[Fluid]) {
        let root = self.content(fluids).sqrt();
        if let Some(divider) = &mut self.divider {
            divider.wanted_nodes = divider.nodes_per_root.map(|per_root| (per_root * root + 0.5) as u32);
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
        let wanted = self.body.membrane().map_or(f32::INFINITY, |m| m.rest_perimeter() / m.rest_length);
        wanted < self.outline.len() as f32 - 0.5
    }

    /// All its particles: those of the body by node, then the fluid.
    pub(crate) fn particles(&self) -> impl Iterator<Item = u32> + '_ {
        let loose: &[u32] = match &self.body {
            Body::Lane { .. } => &[],
            Body::Loose { particles, .. } => particles,
        };
        let in_lane = (0..self.slots).map(|slot| self.body.particle(slot));
        in_lane.chain(loose.iter().copied()).chain(self.fluid_particles.iter().copied())
    }
}
