//! What comes into a world by emitters, and what leaves it by drains and open sides, at the end of each step.

use super::World;
use super::change::WorldChange;
use crate::collider::Wall;
use crate::config::Side;
use crate::error::{Error, ErrorKind};
use crate::event::{Event, Outlet};
use crate::float_environment::with_default_float_environment;
use crate::force_field::Region;
use crate::id::{DrainId, EmitterId, OrganismId};
use crate::kind::Kind;
use crate::organism::{Blueprint, Placement};
use crate::rng::Rng;
use crate::supply::{Drain, Emitter, Recipe};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// Streams of random numbers from here on are for emitters; those of organisms lie below.
const STREAM: u64 = 5 << 60;
/// Places that are drawn for one in a circle.
const DRAWS: usize = 16;

/// An emitter, and what it still has to emit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct EmitterRecord {
    pub emitter: Emitter,
    /// How many it owes.
    pub owed: f32,
    pub rng: Rng,
}

/// Where an organism, or a particle of fluid, may be drained.
struct Place {
    at: Vec2,
    organism: OrganismId,
    kind: Kind,
    particle: Option<u32>,
}

impl World {
    /// Adds an emitter. At the end of each step it emits what is due, if there is room for it, with [`Event::Emitted`]:
    /// the moment to set a controller, user data, joints.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Drain, Recipe, Emitter, Inputs, Region, World, WorldConfig, glam::Vec2};
    /// # let mut world = World::new(WorldConfig { damping: 0.0, ..WorldConfig::default() })?;
    /// let inlet = Region::Box { low: Vec2::new(5.0, 5.0), high: Vec2::new(8.0, 85.0) };
    /// let ball = Recipe::Organism(AgarSpec::default().into());
    /// world.add_emitter(Emitter { velocity: Vec2::new(20.0, 0.0), ..Emitter::new(inlet, ball, 10.0) })?;
    /// let outlet = Region::Box { low: Vec2::new(100.0, 0.0), high: Vec2::new(160.0, 90.0) };
    /// world.add_drain(Drain { region: outlet, kind: None })?;
    /// (0..600).for_each(|_| world.step(&Inputs::new()));
    /// assert!((40..60).contains(&world.organisms().count())); // 10 a second, each for about 4.7 s
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Names the number that is out of its range, and a template that is not one of this world's.
    pub fn add_emitter(&mut self, emitter: Emitter) -> Result<EmitterId, Error> {
        with_default_float_environment(|| self.check_emitter(&emitter))?;
        let (index, generation) = self.emitters.next_handle();
        let rng = Rng::new(self.config.seed, STREAM ^ (u64::from(generation) << 32) ^ u64::from(index));
        let record = EmitterRecord { emitter: emitter.clone(), owed: 0.0, rng };
        let id = EmitterId::of(self.emitters.insert(Box::new(record)));
        self.changed(|| WorldChange::AddEmitter(Box::new(emitter)));
        Ok(id)
    }

    /// Replaces an emitter by another one, under the same handle: to change its rate, for example.
    ///
    /// # Errors
    /// As for [`World::add_emitter`], and when the handle is stale.
    pub fn set_emitter(&mut self, id: EmitterId, emitter: Emitter) -> Result<(), Error> {
        with_default_float_environment(|| self.check_emitter(&emitter))?;
        let record = self.emitters.get_mut(id.handle()).ok_or_else(|| Error::stale("emitter"))?;
        record.emitter = emitter.clone();
        self.changed(|| WorldChange::SetEmitter(id, Box::new(emitter)));
        Ok(())
    }

    /// Removes an emitter.
    ///
    /// # Errors
    /// When the handle is stale.
    pub fn remove_emitter(&mut self, id: EmitterId) -> Result<(), Error> {
        self.emitters.remove(id.handle()).ok_or_else(|| Error::stale("emitter"))?;
        self.changed(|| WorldChange::RemoveEmitter(id));
        Ok(())
    }

    /// All emitters, in a stable order.
    pub fn emitters(&self) -> impl Iterator<Item = (EmitterId, &Emitter)> {
        self.emitters.iter().map(|(handle, record)| (EmitterId::of(handle), &record.emitter))
    }

    /// Adds a drain. At the end of each step it takes what is in its region, but for prey that somebody holds: [`Event::Drained`].
    ///
    /// # Errors
    /// Names the number that is out of its range.
    pub fn add_drain(&mut self, drain: Drain) -> Result<DrainId, Error> {
        drain.validate()?;
        let id = DrainId::of(self.drains.insert(Box::new(drain)));
        self.changed(|| WorldChange::AddDrain(drain));
        Ok(id)
    }

    /// Replaces a drain by another one, under the same handle.
    ///
    /// # Errors
    /// Names the number that is out of its range, and a handle that is stale.
    pub fn set_drain(&mut self, id: DrainId, drain: Drain) -> Result<(), Error> {
        drain.validate()?;
        **self.drains.get_mut(id.handle()).ok_or_else(|| Error::stale("drain"))? = drain;
        self.changed(|| WorldChange::SetDrain(id, drain));
        Ok(())
    }

    /// Removes a drain.
    ///
    /// # Errors
    /// When the handle is stale.
    pub fn remove_drain(&mut self, id: DrainId) -> Result<(), Error> {
        self.drains.remove(id.handle()).ok_or_else(|| Error::stale("drain"))?;
        self.changed(|| WorldChange::RemoveDrain(id));
        Ok(())
    }

    /// All drains, in a stable order.
    pub fn drains(&self) -> impl Iterator<Item = (DrainId, &Drain)> {
        self.drains.iter().map(|(handle, drain)| (DrainId::of(handle), &**drain))
    }

    /// Takes what is in drains and beyond open sides, then emits what is due.
    pub(crate) fn supply(&mut self) {
        self.drain();
        for (wall, side) in Wall::ALL.into_iter().zip(self.config.sides.in_order()) {
            if side == Side::Open {
                self.take_beyond(wall);
            }
        }
        for index in 0..self.emitters.slot_count() as u32 {
            self.emit(index);
        }
    }

    /// Takes what is in drains: each looks only at what lies between its least and its largest x, so that many cost little. Only what
    /// some drain is for is sorted: that is most of the work.
    fn drain(&mut self) {
        let drains: Vec<_> = self.drains().map(|(id, drain)| (id, *drain)).collect();
        let mut places = if drains.is_empty() { Vec::new() } else { self.drainable() };
        places.retain(|place| drains.iter().any(|(_, drain)| place.is_a(drain.kind)));
        places.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
        let mut is_taken = vec![false; places.len()];
        let mut fluid = Vec::new();
        for (id, drain) in drains {
            let [low, high] = drain.region.bounds().map(|corner| corner.x);
            let from = places.partition_point(|place| place.at.x < low);
            let until = places.partition_point(|place| place.at.x <= high);
            let takes = |&k: &usize| !is_taken[k] && drain.region.contains(places[k].at) && places[k].is_a(drain.kind);
            let mut found: Vec<usize> = (from..until).filter(takes).collect();
            found.sort_unstable_by_key(|&k| (places[k].organism.index, places[k].particle));
            found.iter().for_each(|&k| is_taken[k] = true);
            for same in found.chunk_by(|&a, &b| places[a].organism == places[b].organism) {
                let Place { organism, particle, .. } = places[same[0]];
                let count = if particle.is_some() { same.len() as u32 } else { self.size_of(organism) };
                fluid.extend(same.iter().filter_map(|&k| Some((organism, places[k].particle?))));
                self.take(Outlet::Drain(id), organism, count, particle.is_none());
            }
        }
        fluid.sort_unstable_by_key(|&(organism, particle)| (organism.index, particle));
        for same in fluid.chunk_by(|a, b| a.0 == b.0) {
            let particles: Vec<u32> = same.iter().map(|&(_, particle)| particle).collect();
            self.remove_fluid(same[0].0, &particles);
        }
    }

    /// What drains may take: bodies by their centres, fluid without a membrane particle by particle, no prey that is held.
    fn drainable(&self) -> Vec<Place> {
        let mut places = Vec::new();
        for (id, organism) in self.organisms.iter().filter(|(_, organism)| !organism.is_held()) {
            let place = |at, particle| Place { at, organism: id, kind: organism.kind, particle };
            if organism.is_free_fluid() {
                let particles = organism.fluid_particles.iter();
                places.extend(particles.map(|&i| place(self.particles.position(i as usize), Some(i))));
            } else {
                places.extend(self.centroid(id).map(|at| place(at, None)));
            }
        }
        places
    }

    /// Takes the organisms that are wholly beyond an open side, and the particles of fluid that are.
    fn take_beyond(&mut self, side: Wall) {
        let size = self.config.size;
        let ids: Vec<OrganismId> = self.organisms().collect();
        for id in ids {
            let Some(organism) = self.organisms.get(id).filter(|organism| !organism.is_held()) else { continue };
            let is_gone = |i: &u32| is_beyond(self.particles.position(*i as usize), side, size);
            let is_fluid = organism.is_free_fluid();
            let gone: Vec<u32> = organism.particles().filter(is_gone).collect();
            if is_fluid || gone.len() as u32 == self.size_of(id) {
                self.take(Outlet::Side(side), id, gone.len() as u32, !is_fluid);
                if is_fluid {
                    self.remove_fluid(id, &gone);
                }
            }
        }
    }

    /// Number of its particles.
    fn size_of(&self, id: OrganismId) -> u32 {
        self.organisms.get(id).map_or(0, |organism| organism.particles().count() as u32)
    }

    /// Reports that an outlet takes so many particles of an organism, and removes it if that is all of it.
    fn take(&mut self, outlet: Outlet, organism: OrganismId, particles: u32, is_whole: bool) {
        let Some(kind) = self.kind(organism).filter(|_| particles > 0) else { return };
        if is_whole {
            // The handle is of an organism that lives.
            let _ = self.remove(organism);
        }
        self.events.push(Event::Drained { outlet, organism, kind, particles });
    }

    /// Removes particles of fluid, and the organism with the last of them.
    fn remove_fluid(&mut self, id: OrganismId, particles: &[u32]) {
        let mut gone = particles.to_vec();
        gone.sort_unstable();
        let Some(organism) = self.organisms.get_mut(id).filter(|_| !gone.is_empty()) else { return };
        if gone.len() == organism.fluid_particles.len() {
            // The handle is of an organism that lives.
            let _ = self.remove(id);
        } else {
            let stays = |i: &u32| gone.binary_search(i).is_err();
            organism.fluid_particles.retain(stays);
            if let Some(fluid) = organism.fluid {
                self.fluids[fluid as usize].particles.retain(stays);
            }
            self.lose_joints(|i| !stays(&i));
            gone.iter().for_each(|&i| self.particles.remove(i));
            self.scratch.query_index.clear();
        }
    }

    /// Checks an emitter, and that this world can emit what it emits.
    pub(in crate::world) fn check_emitter(&self, emitter: &Emitter) -> Result<(), Error> {
        emitter.validate()?;
        let blueprint = self.blueprint_of(&emitter.recipe)?;
        self.check_substeps(&blueprint)?;
        self.check_period(&blueprint, 1.0)?;
        self.check_kicks(&blueprint, 1.0, 0.0)
    }

    /// What a recipe amounts to in this world.
    pub(super) fn blueprint_of(&self, recipe: &Recipe) -> Result<Blueprint, Error> {
        match recipe {
            Recipe::Organism(spec) => spec.blueprint(),
            Recipe::Template(id) => {
                let template = self.templates.get(id.0 as usize).cloned();
                template
                    .map(|template| Blueprint::custom(*id, template))
                    .ok_or_else(|| Error::new(ErrorKind::Stale, "recipe.template"))
            }
        }
    }

    /// Emits what is due at an emitter, each at one place that is drawn.
    fn emit(&mut self, index: u32) {
        let (dt, size) = (self.config.dt, self.config.size);
        let Some(record) = self.emitters.at_mut(index) else { return };
        record.owed += record.emitter.rate * dt;
        if record.owed < 1.0 {
            return;
        }
        let placements = record.draw(size);
        let (recipe, velocity) = (record.emitter.recipe.clone(), record.emitter.velocity);
        let emitter = self.emitters.handle_at(index).map(EmitterId::of);
        let mut emitted = 0.0;
        let blueprint = self.blueprint_of(&recipe);
        for placement in placements {
            let spawned = blueprint.clone().and_then(|blueprint| self.spawn_blueprint(blueprint, placement));
            let (Ok(organism), Some(emitter)) = (spawned, emitter) else { continue };
            self.set_velocity(organism, velocity);
            self.events.push(Event::Emitted { emitter, organism });
            emitted += 1.0;
        }
        if let Some(record) = self.emitters.at_mut(index) {
            let owed = record.owed - emitted;
            record.owed = if owed > 1.0 { 1.0 } else { owed };
        }
        self.scratch.query_index.clear();
    }

    /// Gives all that can move of an organism a velocity, at most the speed limit.
    pub(super) fn set_velocity(&mut self, id: OrganismId, velocity: Vec2) {
        let velocity = velocity.clamp_length_max(self.config.speed_limit());
        for i in self.discs_of(id).collect::<Vec<_>>() {
            (self.particles.vx[i], self.particles.vy[i]) = (velocity.x, velocity.y);
        }
    }
}

impl Place {
    fn is_a(&self, kind: Option<Kind>) -> bool {
        kind.is_none_or(|kind| kind == self.kind)
    }
}

impl EmitterRecord {
    /// Places for as many as it owes.
    fn draw(&mut self, size: Vec2) -> Vec<Placement> {
        let Self { emitter, owed, rng } = self;
        let place = |_| {
            let at = draw_in(emitter.region, size, rng);
            let angle = emitter.angle.unwrap_or_else(|| rng.range(0.0, TAU));
            Placement::at(at.x, at.y).turned(angle)
        };
        (0..*owed as u32).map(place).collect()
    }
}

/// A point in a region, drawn at random.
fn draw_in(region: Region, size: Vec2, rng: &mut Rng) -> Vec2 {
    let mut in_box = |low: Vec2, high: Vec2| Vec2::new(rng.range(low.x, high.x), rng.range(low.y, high.y));
    match region {
        Region::All => in_box(Vec2::ZERO, size),
        Region::Box { low, high } => in_box(low, high),
        Region::Circle { centre, radius } => {
            let mut draws = (0..DRAWS).map(|_| in_box(Vec2::NEG_ONE, Vec2::ONE));
            centre + radius * draws.find(|draw| draw.length_squared() <= 1.0).unwrap_or(Vec2::ZERO)
        }
    }
}

/// Whether a point is outside the room beyond one of its sides.
fn is_beyond(at: Vec2, side: Wall, size: Vec2) -> bool {
    match side {
        Wall::Bottom => at.y < 0.0,
        Wall::Top => at.y > size.y,
        Wall::Left => at.x < 0.0,
        Wall::Right => at.x > size.x,
    }
}
