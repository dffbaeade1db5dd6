//! Random sequences of calls of the public API, spelt by bytes: for property tests and for fuzzing.
//!
//! Whatever the bytes are, no call panics, the world is valid after each, a call that is refused has changed nothing, and
//! what was stepped from a clone or read from a snapshot can be had again.
#![allow(dead_code, reason = "each user needs its part")]

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, AvoidanceParams, BacillusSpec, BrownianParams, ChemicalId, ChemicalSpec,
    ChemotaxisParams, CoccusSpec, Controller, Error, Exchange, FleeParams, FluidBlockSpec, FluidMode, FluidParams,
    IngestionWay, Inputs, InstructionSet, Intent, Measure, Node, Obstacle, OrganismId, OrganismSpec,
    PersistentWalkParams, Placement, PlateletSpec, ProbeSpec, PursueParams, RedCellSpec, RigidCellSpec,
    RunAndTumbleParams, Template, TemplateId, World, WorldConfig,
};

/// Most calls and steps of a sequence.
const CALLS: usize = 60;
const STEPS: u32 = 120;
/// Numbers of which few are legal everywhere.
const NUMBERS: [f32; 16] =
    [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1.5, 7.0, 1e-3, 1e-9, 30.0, 1e6, 1e30, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// Bytes as choices; zeros when they are used up.
struct Choices<'a>(&'a [u8]);

impl Choices<'_> {
    fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    /// In `low..high`.
    fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * f32::from(self.byte()) / 256.0
    }

    /// A number in `low..high`, or once in a while any.
    fn number(&mut self, low: f32, high: f32) -> f32 {
        if self.byte() < 8 { NUMBERS[self.below(NUMBERS.len())] } else { self.range(low, high) }
    }

    fn is_so(&mut self) -> bool {
        self.byte() % 2 == 1
    }
}

/// What a sequence did.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    /// Calls that were done.
    pub calls: u32,
    /// Calls that were refused.
    pub refusals: u32,
    /// Steps.
    pub steps: u32,
    /// Most organisms at a time.
    pub organisms: usize,
}

/// A world, everything that was ever in it, and what is told to it.
struct Sequence<'a> {
    choices: Choices<'a>,
    world: World,
    saved: World,
    /// Digest of `saved` when it was saved.
    digest_saved: u64,
    handles: Vec<OrganismId>,
    templates: Vec<TemplateId>,
    chemicals: Vec<ChemicalId>,
    inputs: Inputs,
    tally: Tally,
}

/// Carries out what the bytes spell.
///
/// # Errors
/// What is wrong with the world, and after which call.
pub(crate) fn run(bytes: &[u8]) -> Result<Tally, String> {
    let mut choices = Choices(bytes);
    let config = config(&mut choices);
    let Ok(world) = World::new(config) else { return Ok(Tally::default()) };
    let (handles, templates, tally) = (Vec::new(), Vec::new(), Tally::default());
    let mut sequence = Sequence {
        choices,
        saved: world.clone(),
        digest_saved: world.digest(),
        world,
        handles,
        templates,
        chemicals: Vec::new(),
        inputs: Inputs::new(),
        tally,
    };
    for _ in 0..CALLS {
        if sequence.choices.0.is_empty() {
            break;
        }
        let before = sequence.world.digest();
        let (name, outcome) = sequence.call();
        let Tally { calls, .. } = sequence.tally;
        sequence.tally.calls += 1;
        sequence.world.validate().map_err(|violation| format!("after call {calls}, {name}: {violation}"))?;
        if outcome.is_err() {
            sequence.tally.refusals += 1;
            if before != sequence.world.digest() {
                return Err(format!("call {calls}, {name}, was refused and has changed the world: {outcome:?}"));
            }
        }
        if sequence.saved.digest() != sequence.digest_saved {
            return Err(format!("call {calls}, {name}, has changed a clone"));
        }
        sequence.tally.organisms = sequence.tally.organisms.max(sequence.world.organisms().count());
    }
    Ok(sequence.tally)
}

fn config(choices: &mut Choices<'_>) -> WorldConfig {
    WorldConfig {
        size: Vec2::new(choices.number(30.0, 90.0), choices.number(30.0, 60.0)),
        // With one substep a membrane may cross itself under load, see `WorldConfig::substeps`.
        substeps: [8, 4, 2, 0][choices.below(13) / 4],
        gravity: Vec2::new(0.0, if choices.byte() < 200 { 0.0 } else { choices.number(-30.0, 5.0) }),
        seed: u64::from(choices.byte()),
        protects_membranes: choices.byte() < 230,
        max_particles: if choices.byte() < 230 { 2500 } else { 150 },
        ..WorldConfig::default()
    }
}

impl Sequence<'_> {
    /// One call, and its name.
    fn call(&mut self) -> (&'static str, Result<(), Error>) {
        match self.choices.below(28) {
            0..=6 => ("spawn", self.spawn()),
            7..=12 => ("step", self.step()),
            13..=15 => ("input", self.input()),
            16 => ("divide", self.divide()),
            17 => ("fuse", self.fuse()),
            18 => ("grow", self.grow()),
            19 => ("remove", self.remove()),
            20 => ("set_exempt", self.set_exempt()),
            21 => ("add_obstacle", self.add_obstacle()),
            22 => ("spawn_template", self.spawn_template()),
            23 => ("clone", self.save_or_restore()),
            24 => ("queries", self.ask()),
            25 => ("push", self.push()),
            26 => ("set_exchange", self.set_exchange()),
            _ => match self.choices.below(8) {
                which @ 0..=3 => ("set_instruction_set", self.set_instruction_set(which % 2 == 1)),
                4..=5 => ("snapshot", self.write_and_read()),
                _ => ("set_controller", self.set_controller()),
            },
        }
    }

    fn handle(&mut self) -> Option<OrganismId> {
        let count = self.handles.len();
        (count > 0).then(|| self.handles[self.choices.below(count)])
    }

    fn place(&mut self) -> Vec2 {
        let size = self.world.config().size;
        Vec2::new(self.choices.number(0.0, size.x), self.choices.number(0.0, size.y))
    }

    fn spawn(&mut self) -> Result<(), Error> {
        let (spec, placement) = (self.spec(), self.placement());
        self.world.spawn(&spec, placement).map(|id| self.handles.push(id))
    }

    fn placement(&mut self) -> Placement {
        let at = self.place();
        let c = &mut self.choices;
        let controller = match c.below(12) {
            5.. => Controller::Still,
            1 => Controller::wander([c.number(0.1, 0.5), c.number(0.5, 1.0)], c.number(0.0, 1.0)),
            2 => Controller::thrash(c.number(0.05, 1.0), c.number(0.0, 1.0)),
            3 => Controller::ram(c.number(0.1, 1.0), c.number(0.1, 1.0), c.number(5.0, 20.0)),
            0 | 4 => {
                Controller::patrol((0..c.below(4)).map(|_| Vec2::new(c.number(0.0, 60.0), 20.0)).collect(), c.is_so())
            }
        };
        let scale = if c.byte() < 220 { 1.0 } else { c.number(0.5, 2.0) };
        Placement::at(at.x, at.y).turned(c.number(-4.0, 4.0)).scaled(scale).steered_by(controller)
    }

    fn spec(&mut self) -> OrganismSpec {
        let c = &mut self.choices;
        match c.below(9) {
            0 => AgarSpec { radius: c.number(0.3, 2.0), density: c.number(0.5, 2.0) }.into(),
            1 => CoccusSpec { radius: c.number(0.3, 1.5), speed: c.number(0.0, 20.0), ..CoccusSpec::default() }.into(),
            2 => PlateletSpec { radius: c.number(1.0, 4.0), satellites: c.byte().into(), ..PlateletSpec::default() }
                .into(),
            3 => ProbeSpec { radius: c.number(0.5, 4.0), mass: c.number(0.1, 100.0), ..ProbeSpec::default() }.into(),
            4 => RedCellSpec {
                radius: c.number(2.0, 5.0),
                area_compliance: c.number(0.0, 0.1),
                ..RedCellSpec::default()
            }
            .into(),
            5 => RigidCellSpec {
                radii: Vec2::new(c.number(2.0, 8.0), c.number(1.5, 5.0)),
                satellites: 8 + u32::from(c.byte() % 32),
                layers: 1 + u32::from(c.byte() % 2),
                speed: c.number(0.0, 20.0),
                ..RigidCellSpec::default()
            }
            .into(),
            6 => FluidBlockSpec {
                size: Vec2::new(c.number(2.0, 15.0), c.number(2.0, 10.0)),
                fluid: FluidParams {
                    spacing: c.number(0.7, 1.5),
                    mode: if c.is_so() { FluidMode::Density } else { FluidMode::Granular },
                    ..FluidParams::default()
                },
            }
            .into(),
            7 => BacillusSpec { speed: c.number(0.0, 20.0), ..BacillusSpec::default() }.into(),
            _ => self.amoeboid_cell().into(),
        }
    }

    fn amoeboid_cell(&mut self) -> AmoeboidCellSpec {
        let c = &mut self.choices;
        let mut spec = AmoeboidCellSpec { speed: c.number(2.0, 20.0), ..AmoeboidCellSpec::default() };
        let radius = c.number(4.0, 14.0);
        spec.radii = Vec2::new(radius, radius * c.range(0.7, 1.4));
        spec.phagocytosis.way = if c.is_so() { IngestionWay::Cup } else { IngestionWay::Gate };
        spec.phagocytosis.hold_time = c.number(0.0, 0.3);
        spec.phagocytosis.time_limit = c.number(0.2, 2.0);
        spec.phagocytosis.digestion_time = [c.number(0.05, 0.5), c.number(0.05, 1.0), c.number(0.05, 1.0)];
        spec.division.time_limit = c.number(0.5, 5.0);
        spec.division.furrow_speed = c.number(1.0, 20.0);
        spec
    }

    fn step(&mut self) -> Result<(), Error> {
        for _ in 0..1 + self.choices.below(12) {
            if self.tally.steps < STEPS {
                self.world.step(&self.inputs);
                self.tally.steps += 1;
            }
        }
        Ok(())
    }

    fn input(&mut self) -> Result<(), Error> {
        let Some(id) = self.handle() else { return Ok(()) };
        let place = match self.choices.below(4) {
            0 => self.place(),
            // After somebody: that is how meals come about.
            _ => self.handle().and_then(|other| self.world.centroid(other)).unwrap_or(Vec2::ZERO),
        };
        let digests = self.choices.is_so();
        let intent = Intent::toward(place)?.digesting(digests);
        self.inputs.set(id, if self.choices.byte() < 20 { Intent::REST } else { intent });
        Ok(())
    }

    fn divide(&mut self) -> Result<(), Error> {
        let Some(id) = self.handle() else { return Ok(()) };
        if self.choices.is_so() {
            return self.world.divide(id);
        }
        let axis = Vec2::new(self.choices.number(-1.0, 1.0), self.choices.number(-1.0, 1.0));
        self.world.divide_along(id, axis)
    }

    fn fuse(&mut self) -> Result<(), Error> {
        let Some((a, b)) = self.handle().zip(self.handle()) else { return Ok(()) };
        self.world.fuse(a, b)
    }

    fn grow(&mut self) -> Result<(), Error> {
        let Some(id) = self.handle() else { return Ok(()) };
        let (nodes, particles) = (self.choices.below(6) as u32, self.choices.byte() as u32);
        self.world.grow(id, nodes, particles)
    }

    fn remove(&mut self) -> Result<(), Error> {
        let Some(id) = self.handle() else { return Ok(()) };
        self.world.remove(id)
    }

    fn set_exempt(&mut self) -> Result<(), Error> {
        let Some((a, b)) = self.handle().zip(self.handle()) else { return Ok(()) };
        let is_exempt = self.choices.is_so();
        self.world.set_exempt(a, b, is_exempt)
    }

    fn push(&mut self) -> Result<(), Error> {
        let Some(id) = self.handle() else { return Ok(()) };
        let velocity = Vec2::new(self.choices.number(-50.0, 50.0), self.choices.number(-50.0, 50.0));
        self.world.push(id, velocity)
    }

    fn set_exchange(&mut self) -> Result<(), Error> {
        let (Some(id), count) = (self.handle(), self.chemicals.len()) else { return Ok(()) };
        if count < 2 && self.choices.is_so() {
            let spec = ChemicalSpec { diffusion: self.choices.number(0.0, 200.0), ..ChemicalSpec::default() };
            // A kept world that is returned to may not have it.
            return self.world.add_chemical(spec).map(|chemical| self.chemicals.push(chemical));
        }
        let Some(&chemical) = self.chemicals.first() else { return Ok(()) };
        let (secretion, uptake) = (self.choices.number(0.0, 100.0), self.choices.number(0.0, 100.0));
        self.world.set_exchange(id, Exchange { chemical, secretion, uptake })
    }

    fn add_obstacle(&mut self) -> Result<(), Error> {
        let at = self.place();
        let (a, b) = (self.choices.range(0.5, 6.0), self.choices.range(0.5, 6.0));
        let shape = match self.choices.below(3) {
            0 => SharedShape::ball(a),
            1 => SharedShape::cuboid(a, b),
            _ => SharedShape::capsule(Vec2::ZERO, Vec2::new(a, b), 1.0),
        };
        self.world.add_obstacle(Obstacle::new(shape, Pose::translation(at.x, at.y))).map(drop)
    }

    fn spawn_template(&mut self) -> Result<(), Error> {
        if self.templates.is_empty() || self.choices.byte() < 80 {
            let template = self.template()?;
            self.templates.push(self.world.add_template(template));
            return Ok(());
        }
        let which = self.choices.below(self.templates.len());
        let (template, placement) = (self.templates[which], self.placement());
        self.world.spawn_template(template, placement).map(|id| self.handles.push(id))
    }

    fn template(&mut self) -> Result<Template, Error> {
        let mut builder = Template::builder();
        let c = &mut self.choices;
        let count = 1 + c.below(6) as u32;
        for _ in 0..count {
            let at = Vec2::new(c.number(-3.0, 3.0), c.number(-3.0, 3.0));
            builder.node(Node::disc(at, c.number(0.1, 10.0), c.number(0.1, 1.0)));
        }
        for _ in 0..c.below(6) {
            builder.spring(c.below(7) as u32, c.below(7) as u32, c.number(0.0, 1e-3), c.number(0.0, 1.0));
        }
        builder.build()
    }

    /// Keeps the world as it is, or returns to the one that was kept: either way what was put in the place of another world
    /// answers as its original does, and goes on as it.
    fn save_or_restore(&mut self) -> Result<(), Error> {
        let is_saved = self.choices.is_so();
        let Self { world, saved, .. } = self;
        let (from, into) = if is_saved { (&*world, saved) } else { (&*saved, world) };
        into.clone_from(from);
        assert_eq!(answers(into), answers(from), "a clone in the place of another world answers otherwise");
        let mut clones = [from.clone(), into.clone()];
        self.digest_saved = into.digest();
        clones.iter_mut().for_each(|clone| clone.step(&self.inputs));
        assert_eq!(clones[0].digest(), clones[1].digest(), "a clone in the place of another world goes on otherwise");
        Ok(())
    }

    /// Asks everything, also with handles that are stale and numbers that make no sense.
    fn ask(&mut self) -> Result<(), Error> {
        let (a, b) = (self.place(), self.place());
        let radius = self.choices.number(0.0, 10.0);
        let world = &self.world;
        let found = world.organisms_at(a).count() + world.organisms_in_circle(a, radius).count();
        let boxed = world.organisms_in_box(a, b).count();
        assert!(found <= 2 * world.organisms().count() && boxed <= world.organisms().count());
        let hit = world.cast_ray(a, b - a, radius);
        assert!(hit.is_none_or(|hit| world.kind(hit.organism).is_some()));
        for &id in &self.handles {
            let is_alive = world.kind(id).is_some();
            assert_eq!(is_alive, world.view().organism(id).is_some());
            assert_eq!(is_alive, world.centroid(id).is_some());
            assert!(is_alive || world.membrane_quality(id).is_none());
        }
        assert!(Measure::ALL.iter().all(|measure| measure.of(world).is_finite()));
        Ok(())
    }

    /// Goes on with what is read of what the world is written as.
    fn write_and_read(&mut self) -> Result<(), Error> {
        let bytes = self.world.to_snapshot().expect("all obstacles have a record");
        let mut read = World::from_snapshot(&bytes).expect("what was written can be read");
        assert_eq!(read.digest(), self.world.digest(), "what was read is not what was written");
        [&mut read, &mut self.world].into_iter().for_each(|world| world.step(&self.inputs));
        assert_eq!(read.digest(), self.world.digest(), "what was read goes on otherwise");
        self.world = read;
        Ok(())
    }

    fn set_controller(&mut self) -> Result<(), Error> {
        let (Some(id), chemical) = (self.handle(), self.chemicals.first().copied()) else { return Ok(()) };
        let c = &mut self.choices;
        let seconds = [c.number(0.05, 0.5), c.number(0.5, 1.0)];
        let controller = match (c.below(8), chemical) {
            (0, _) => Controller::persistent_walk(PersistentWalkParams { persistence: seconds[0] }),
            (1, _) => Controller::brownian(BrownianParams { diffusion: c.number(0.1, 50.0), interval: seconds[0] }),
            (2, _) => Controller::avoidance(AvoidanceParams { back: seconds, ..AvoidanceParams::default() }),
            (3, _) => Controller::run_and_tumble(RunAndTumbleParams {
                run: seconds[0],
                tumble: seconds[1],
                chemical,
                ..RunAndTumbleParams::default()
            }),
            (4, _) => {
                Controller::flee(FleeParams { within: c.number(1.0, 30.0), ..FleeParams::default() }, Controller::Still)
            }
            (5, _) => Controller::pursue(
                PursueParams { within: c.number(1.0, 30.0), ..PursueParams::default() },
                Controller::Still,
            ),
            (6, Some(chemical)) => Controller::chemotaxis(ChemotaxisParams {
                noise: c.number(0.0, 1.0),
                interval: seconds[0],
                ..ChemotaxisParams::towards(chemical)
            }),
            _ => Controller::wander(seconds, 0.5),
        };
        self.world.set_controller(id, controller)
    }

    fn set_instruction_set(&mut self, best: bool) -> Result<(), Error> {
        let set = if best { InstructionSet::Best } else { InstructionSet::Baseline };
        self.world.set_instruction_set(set);
        Ok(())
    }
}

/// What depends on the last step's search, and some of the rest.
fn answers(world: &World) -> (u64, Vec<u64>, Vec<[Vec2; 2]>) {
    let measures = Measure::ALL.iter().map(|measure| measure.of(world).to_bits()).collect();
    (world.digest(), measures, world.view().contacts().collect())
}
