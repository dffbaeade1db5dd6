//! Random sequences of calls of the public API, spelt by bytes: for property tests and for fuzzing.
//!
//! Whatever the bytes are, no call panics, the world is valid after each, a call that is refused has changed nothing, and
//! what was stepped from a clone or read from a snapshot can be had again.
#![allow(dead_code, reason = "each user needs its part")]

mod choices;

use choices::Choices;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    Actuation, ChemicalId, ChemicalSpec, Collider, CollisionGroups, Error, Exchange, FieldId, FieldKind, ForceField,
    Inputs, InstructionSet, Intent, JointEnd, JointId, JointKind, JointSpec, Measure, Node, Obstacle, ObstacleId,
    ObstacleMotion, OrganismId, Propulsion, QueryFilter, Region, Rope, Template, TemplateId, World,
};

/// Most calls and steps of a sequence.
const CALLS: usize = 60;
const STEPS: u32 = 120;
type Outcome = Result<(), Error>;

/// What a sequence did.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub calls: u32,
    pub refusals: u32,
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
    obstacles: Vec<ObstacleId>,
    templates: Vec<TemplateId>,
    chemicals: Vec<ChemicalId>,
    joints: Vec<JointId>,
    fields: Vec<FieldId>,
    inputs: Inputs,
    tally: Tally,
}

/// Carries out what the bytes spell.
///
/// # Errors
/// What is wrong with the world, and after which call.
pub(crate) fn run(bytes: &[u8]) -> Result<Tally, String> {
    let mut choices = Choices(bytes);
    let Ok(world) = World::new(choices.config()) else { return Ok(Tally::default()) };
    let mut sequence = Sequence {
        choices,
        saved: world.clone(),
        digest_saved: world.digest(),
        world,
        handles: Vec::new(),
        obstacles: Vec::new(),
        templates: Vec::new(),
        chemicals: Vec::new(),
        joints: Vec::new(),
        fields: Vec::new(),
        inputs: Inputs::new(),
        tally: Tally::default(),
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

impl Sequence<'_> {
    /// One call, and its name.
    fn call(&mut self) -> (&'static str, Outcome) {
        match self.choices.below(34) {
            0..=6 => ("spawn", self.spawn()),
            7..=12 => ("step", self.step()),
            13..=15 => ("input", self.with_handle(Self::input)),
            16 => ("divide", self.with_handle(Self::divide)),
            17 => ("fuse", self.with_two_handles(|sequence, a, b| sequence.world.fuse(a, b))),
            18 => ("grow", self.with_handle(Self::grow)),
            19 => ("remove", self.with_handle(|sequence, id| sequence.world.remove(id))),
            20 => ("set_exempt", self.with_two_handles(Self::set_exempt)),
            21 => self.obstacle_call(),
            22 => ("spawn_template", self.spawn_template()),
            23 => ("clone", self.save_or_restore()),
            24 => ("queries", self.ask()),
            25 => ("push", self.with_handle(Self::push)),
            26 => ("set_exchange", self.with_handle(Self::set_exchange)),
            27..=28 => ("actuate", self.with_handle(Self::actuate)),
            29..=30 => ("joint", self.with_two_handles(Self::change_joint)),
            31 => ("field", self.change_field()),
            32 => ("setting", self.with_handle(Self::change_setting)),
            _ => match self.choices.below(8) {
                which @ 0..=3 => ("set_instruction_set", self.set_instruction_set(which % 2 == 1)),
                4..=5 => ("snapshot", self.write_and_read()),
                _ => ("set_controller", self.with_handle(Self::set_controller)),
            },
        }
    }

    fn handle(&mut self) -> Option<OrganismId> {
        let count = self.handles.len();
        (count > 0).then(|| self.handles[self.choices.below(count)])
    }

    /// A call for one of the handles, if there is any.
    fn with_handle(&mut self, call: fn(&mut Self, OrganismId) -> Outcome) -> Outcome {
        self.handle().map_or(Ok(()), |id| call(self, id))
    }

    fn with_two_handles(&mut self, call: fn(&mut Self, OrganismId, OrganismId) -> Outcome) -> Outcome {
        self.handle().zip(self.handle()).map_or(Ok(()), |(a, b)| call(self, a, b))
    }

    fn place(&mut self) -> Vec2 {
        self.choices.place(self.world.config().size)
    }

    fn spawn(&mut self) -> Outcome {
        let (spec, placement) = (self.choices.spec(), self.choices.placement(self.world.config().size));
        self.world.spawn(&spec, placement).map(|id| self.handles.push(id))
    }

    fn step(&mut self) -> Outcome {
        for _ in 0..1 + self.choices.below(12) {
            if self.tally.steps < STEPS {
                self.world.step(&self.inputs);
                self.tally.steps += 1;
            }
        }
        Ok(())
    }

    fn input(&mut self, id: OrganismId) -> Outcome {
        let place = match self.choices.below(4) {
            0 => self.place(),
            // After somebody: that is how meals come about.
            _ => self.handle().and_then(|other| self.world.centroid(other)).unwrap_or(Vec2::ZERO),
        };
        let digests = self.choices.flag();
        let intent = Intent::toward(place)?.digesting(digests);
        self.inputs.set(id, if self.choices.byte() < 20 { Intent::REST } else { intent });
        Ok(())
    }

    fn divide(&mut self, id: OrganismId) -> Outcome {
        if self.choices.flag() {
            return self.world.divide(id);
        }
        let axis = Vec2::new(self.choices.number(-1.0, 1.0), self.choices.number(-1.0, 1.0));
        self.world.divide_along(id, axis)
    }

    fn grow(&mut self, id: OrganismId) -> Outcome {
        let (nodes, particles) = (self.choices.below(6) as u32, self.choices.byte() as u32);
        self.world.grow(id, nodes, particles)
    }

    fn set_exempt(&mut self, a: OrganismId, b: OrganismId) -> Outcome {
        let is_exempt = self.choices.flag();
        self.world.set_exempt(a, b, is_exempt)
    }

    fn push(&mut self, id: OrganismId) -> Outcome {
        let velocity = Vec2::new(self.choices.number(-50.0, 50.0), self.choices.number(-50.0, 50.0));
        self.world.push(id, velocity)
    }

    fn vector(&mut self, most: f32) -> Vec2 {
        Vec2::new(self.choices.number(-most, most), self.choices.number(-most, most))
    }

    fn actuate(&mut self, id: OrganismId) -> Outcome {
        let node = self.choices.below(40) as u32;
        let (force, impulse) = (Actuation::force(self.vector(500.0)), Actuation::impulse(self.vector(50.0)));
        let target = Actuation::target(self.place());
        match self.choices.below(7) {
            0 => self.inputs.actuate(id, force),
            1 => self.inputs.actuate(id, impulse),
            2 => self.inputs.actuate(id, Actuation::torque(self.choices.number(-500.0, 500.0))),
            3 => self.inputs.actuate(id, target),
            4 => self.inputs.actuate_node(id, node, force),
            5 => self.inputs.activate(id, node % 3, self.choices.number(0.0, 1.1)),
            _ => {
                self.inputs.clear();
                self.world.check_inputs(&self.inputs)
            }
        }
    }

    fn joint_end(&mut self, id: OrganismId) -> JointEnd {
        match self.choices.below(3) {
            0 => JointEnd::Centre(id),
            1 => {
                let (at, obstacle) = (self.place(), self.obstacles.last().filter(|_| id.index() % 2 == 1));
                obstacle.map_or(JointEnd::Point(at), |&obstacle| JointEnd::Obstacle { obstacle, at })
            }
            _ => JointEnd::Node { organism: id, node: self.choices.below(60) as u32 },
        }
    }

    fn joint(&mut self, a: OrganismId, b: OrganismId) -> JointSpec {
        let (a, b, c) = (self.joint_end(a), self.joint_end(b), &mut self.choices);
        let (length, max_force) = (c.number(0.0, 20.0), c.number(0.0, 1000.0));
        let (frequency, damping_ratio) = (c.number(0.1, 20.0), c.number(0.0, 2.0));
        let kind = match c.below(8) {
            0 => JointKind::Pin,
            1 => JointKind::Distance { length },
            2 => JointKind::Rope { max_length: length },
            3 => JointKind::Spring { length, frequency, damping_ratio },
            4 => JointKind::Mouse { frequency, damping_ratio, max_force },
            5 => JointKind::LengthMotor { length, max_force },
            6 => JointKind::SpeedMotor { speed: c.number(-30.0, 30.0), max_force },
            _ => JointKind::Weld,
        };
        let spec = JointSpec::new(a, b, kind);
        if c.flag() { spec.breaking_at(c.number(0.0, 1000.0)) } else { spec }
    }

    fn change_joint(&mut self, a: OrganismId, b: OrganismId) -> Outcome {
        let (spec, count) = (self.joint(a, b), self.joints.len());
        match self.choices.below(4) {
            0 if count > 0 => self.world.remove_joint(self.joints[self.choices.below(count)]),
            1 if count > 0 => self.world.set_joint(self.joints[self.choices.below(count)], spec),
            _ => self.world.add_joint(spec).map(|joint| self.joints.push(joint)),
        }
    }

    fn change_field(&mut self) -> Outcome {
        let (centre, acceleration, count) = (self.place(), self.choices.number(-200.0, 200.0), self.fields.len());
        let kind = match self.choices.below(3) {
            0 => FieldKind::Uniform { acceleration: self.vector(100.0) },
            1 => FieldKind::Radial { centre, acceleration },
            _ => FieldKind::Vortex { centre, acceleration },
        };
        let region = match self.choices.below(3) {
            0 => Region::All,
            1 => Region::Circle { centre, radius: self.choices.number(0.0, 40.0) },
            _ => Region::Box { low: self.place(), high: centre },
        };
        let field = ForceField { region, kind };
        match self.choices.below(4) {
            0 if count > 0 => self.world.remove_field(self.fields[self.choices.below(count)]),
            1 if count > 0 => self.world.set_field(self.fields[self.choices.below(count)], field),
            _ => self.world.add_field(field).map(|field| self.fields.push(field)),
        }
    }

    fn change_setting(&mut self, id: OrganismId) -> Outcome {
        let groups = CollisionGroups { memberships: self.choices.byte().into(), filter: self.choices.byte().into() };
        let gravity = self.vector(30.0);
        match self.choices.below(6) {
            0 => self.world.set_gravity(gravity),
            1 => self.world.set_damping(self.choices.number(0.0, 3.0)),
            2 => self.world.set_max_speed(self.choices.number(5.0, 30.0)),
            3 => self.world.set_gravity_scale(id, self.choices.number(-2.0, 3.0)),
            4 => self.world.set_collision_groups(id, groups),
            _ => self.world.set_user_data(id, u128::from(self.choices.byte()) << 90),
        }
    }

    fn set_exchange(&mut self, id: OrganismId) -> Outcome {
        if self.chemicals.len() < 2 && self.choices.flag() {
            let spec = ChemicalSpec { diffusion: self.choices.number(0.0, 200.0), ..ChemicalSpec::default() };
            // A kept world that is returned to may not have it.
            return self.world.add_chemical(spec).map(|chemical| self.chemicals.push(chemical));
        }
        let Some(&chemical) = self.chemicals.first() else { return Ok(()) };
        let (secretion, uptake) = (self.choices.number(0.0, 100.0), self.choices.number(0.0, 100.0));
        self.world.set_exchange(id, Exchange { chemical, secretion, uptake })
    }

    /// A call for obstacles, also with handles that are stale.
    fn obstacle_call(&mut self) -> (&'static str, Outcome) {
        let which = self.choices.below(12);
        let count = self.obstacles.len();
        if which < 4 || count == 0 {
            return ("add_obstacle", self.add_obstacle());
        }
        let id = self.obstacles[self.choices.below(count)];
        let to = Pose::new(self.place(), self.choices.number(-3.0, 3.0));
        match which {
            4 => ("remove_obstacle", self.world.remove_obstacle(id)),
            5 => ("set_obstacle_pose", self.world.set_obstacle_pose(id, to)),
            6 => {
                let shape = self.obstacle_shape();
                ("set_obstacle_shape", self.world.set_obstacle_shape(id, shape))
            }
            7 => {
                let is_enabled = self.choices.flag();
                ("set_obstacle_enabled", self.world.set_obstacle_enabled(id, is_enabled))
            }
            _ => ("move_obstacle", self.world.move_obstacle(id, to)),
        }
    }

    fn add_obstacle(&mut self) -> Outcome {
        let at = self.place();
        let shape = self.obstacle_shape();
        let kind = self.choices.byte();
        let motion = [ObstacleMotion::Push, ObstacleMotion::Stop, ObstacleMotion::Fixed][usize::from(kind % 3)];
        let one_way = (kind % 5 == 1).then(|| Vec2::new(self.choices.number(-1.0, 1.0), 1.0));
        let added = Obstacle {
            motion,
            one_way,
            is_sensor: kind % 4 == 1,
            ..Obstacle::new(shape, Pose::translation(at.x, at.y))
        };
        self.world.add_obstacle(added).map(|id| self.obstacles.push(id))
    }

    fn obstacle_shape(&mut self) -> SharedShape {
        let (a, b) = (self.choices.range(0.5, 6.0), self.choices.range(0.5, 6.0));
        match self.choices.below(4) {
            0 => SharedShape::ball(a),
            1 => SharedShape::cuboid(a, b),
            2 => SharedShape::polyline(vec![Vec2::ZERO, Vec2::new(a, 0.0), Vec2::new(a, b)], None),
            _ => SharedShape::capsule(Vec2::ZERO, Vec2::new(a, b), 1.0),
        }
    }

    fn spawn_template(&mut self) -> Outcome {
        if self.templates.is_empty() || self.choices.byte() < 80 {
            let template = self.template()?;
            self.templates.push(self.world.add_template(template));
            return Ok(());
        }
        let which = self.choices.below(self.templates.len());
        let (template, placement) = (self.templates[which], self.choices.placement(self.world.config().size));
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
        if c.flag() {
            let channel = builder.channel([c.number(0.5, 1.5), c.number(0.5, 1.5)]);
            builder.muscle(channel, Rope { a: 0, b: c.below(3) as u32, max_length: c.number(1.0, 4.0) });
            builder.propulsion(Propulsion { speed: c.number(1.0, 20.0), max_acceleration: c.number(1.0, 100.0) });
        }
        builder.build()
    }

    /// Keeps the world as it is, or returns to the one that was kept: either way what was put in the place of another world
    /// answers as its original does, and goes on as it.
    fn save_or_restore(&mut self) -> Outcome {
        let is_saved = self.choices.flag();
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
    fn ask(&mut self) -> Outcome {
        let (a, b) = (self.place(), self.place());
        let radius = self.choices.number(0.0, 10.0);
        let world = &self.world;
        let found = world.organisms_at(a).count() + world.organisms_in_circle(a, radius).count();
        let boxed = world.organisms_in_box(a, b).count();
        assert!(found <= 2 * world.organisms().count() && boxed <= world.organisms().count());
        self.query(a, b, radius);
        let world = &self.world;
        for &id in &self.handles {
            let is_alive = world.kind(id).is_some();
            assert_eq!(is_alive, world.view().organism(id).is_some());
            assert_eq!(is_alive, world.centroid(id).is_some());
            assert!(is_alive || world.membrane_quality(id).is_none());
        }
        assert!(Measure::ALL.iter().all(|measure| measure.of(world).is_finite()));
        Ok(())
    }

    /// All queries agree with each other.
    fn query(&self, a: Vec2, b: Vec2, radius: f32) {
        let (queries, all) = (self.world.queries(), QueryFilter { sensors: true, ..QueryFilter::default() });
        let is_known = |collider: Collider| match collider {
            Collider::Organism(id) => self.world.kind(id).is_some(),
            Collider::Obstacle(id) => self.world.obstacle(id).is_some(),
            Collider::Wall(_) => true,
        };
        let hits = queries.cast_ray_all(a, b - a, 10.0 * radius, &all);
        let first = queries.cast_ray(a, b - a, 10.0 * radius, &all);
        assert_eq!(hits.first().map(|hit| hit.distance), first.map(|hit| hit.distance));
        assert!(hits.iter().all(|hit| is_known(hit.collider)));
        let cast = queries.cast_disc(a, b - a, 10.0 * radius, radius, &all);
        let is_sooner = !radius.is_finite()
            || first.is_none_or(|first| cast.is_some_and(|cast| cast.distance <= first.distance + 0.01));
        assert!(is_sooner, "a disc of {radius} from {a} to {b}: {cast:?}, a ray {first:?}");
        let boxed = queries.overlap_box(a, b, &all);
        let near = [queries.overlap_disc(a, radius, &all), boxed, queries.overlap_polygon(&[a, b, a + b], &all)];
        assert!(near.iter().flatten().all(|&collider| is_known(collider)));
        let nearest = queries.nearest(a, radius, &all);
        assert!(nearest.is_none_or(|nearest| nearest.distance <= radius));
        let fresh = self.world.clone();
        let fresh = fresh.queries();
        assert_eq!(fresh.cast_ray_all(a, b - a, 10.0 * radius, &all), hits, "what was kept is out of date");
        assert_eq!(fresh.nearest(a, radius, &all), nearest, "what was kept is out of date");
    }

    /// Goes on with what is read of what the world is written as.
    fn write_and_read(&mut self) -> Outcome {
        let bytes = self.world.to_snapshot().expect("all obstacles have a record");
        let mut read = World::from_snapshot(&bytes).expect("what was written can be read");
        assert_eq!(read.digest(), self.world.digest(), "what was read is not what was written");
        [&mut read, &mut self.world].into_iter().for_each(|world| world.step(&self.inputs));
        assert_eq!(read.digest(), self.world.digest(), "what was read goes on otherwise");
        self.world = read;
        Ok(())
    }

    fn set_controller(&mut self, id: OrganismId) -> Outcome {
        let controller = self.choices.controller(self.chemicals.first().copied());
        self.world.set_controller(id, controller)
    }

    fn set_instruction_set(&mut self, best: bool) -> Outcome {
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
