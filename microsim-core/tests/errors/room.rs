//! What the refusals are tried on.

use microsim_core::glam::Vec2;
use microsim_core::parry2d::math::Pose;
use microsim_core::parry2d::shape::SharedShape;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, ChemicalId, ChemicalSpec, CoccusSpec, Drain, DrainId, Emitter, EmitterId, Error,
    FieldId, FieldKind, ForceField, Inputs, JointEnd, JointId, JointKind, JointSpec, Node, Obstacle, ObstacleId,
    ObstacleMotion, OrganismId, OrganismSpec, Placement, Recipe, Region, RigidCellSpec, Template, TemplateBuilder,
    TemplateId, World, WorldConfig,
};

/// A world with one organism of three kinds in it, and a handle that is stale.
pub(crate) struct Room {
    pub(crate) world: World,
    pub(crate) cell: OrganismId,
    pub(crate) agar: OrganismId,
    pub(crate) stale: OrganismId,
}

impl Room {
    pub(crate) fn new() -> Self {
        let mut world = World::new(WorldConfig { max_particles: 1500, ..WorldConfig::default() }).unwrap();
        let agar = AgarSpec::default().into();
        let stale = world.spawn(&agar, Placement::at(30.0, 30.0)).unwrap();
        world.remove(stale).unwrap();
        let agar = world.spawn(&agar, Placement::at(30.0, 30.0)).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
        world.add_obstacle(Obstacle::new(SharedShape::ball(4.0), Pose::translation(120.0, 45.0))).unwrap();
        Self { world, cell, agar, stale }
    }

    pub(crate) fn spawn(&mut self, spec: impl Into<OrganismSpec>, placement: Placement) -> Error {
        self.world.spawn(&spec.into(), placement).unwrap_err()
    }

    /// What spawning a small thing here is refused for.
    pub(crate) fn spawn_at(&mut self, x: f32, y: f32) -> Error {
        self.spawn(AgarSpec::default(), Placement::at(x, y))
    }

    /// A template that is too large for this room.
    pub(crate) fn spawn_wide(&mut self) -> Error {
        let mut builder = Template::builder();
        (0..2).for_each(|k| _ = builder.node(Node::disc(Vec2::X * 500.0 * k as f32, 1.0, 1.0)));
        let id = self.world.add_template(builder.build().unwrap());
        self.world.spawn_template(id, Placement::at(20.0, 20.0)).unwrap_err()
    }

    /// What is wrong with inputs.
    pub(crate) fn refuse(&self, tell: fn(&mut Inputs, &Self)) -> Error {
        let mut inputs = Inputs::new();
        tell(&mut inputs, self);
        self.world.check_inputs(&inputs).unwrap_err()
    }

    /// A joint of the agar with the corner.
    pub(crate) fn joint(&self, kind: JointKind) -> JointSpec {
        JointSpec::new(JointEnd::Centre(self.agar), JointEnd::Point(Vec2::ZERO), kind)
    }

    pub(crate) fn stale_joint(&mut self) -> JointId {
        let joint = self.world.add_joint(self.joint(JointKind::Weld)).unwrap();
        self.world.remove_joint(joint).unwrap();
        joint
    }

    pub(crate) fn stale_field(&mut self) -> FieldId {
        let field = self.world.add_field(circle(1.0)).unwrap();
        self.world.remove_field(field).unwrap();
        field
    }

    pub(crate) fn stale_emitter(&mut self) -> EmitterId {
        let id = self.world.add_emitter(emitter(1.0)).unwrap();
        self.world.remove_emitter(id).unwrap();
        id
    }

    pub(crate) fn stale_drain(&mut self) -> DrainId {
        let id = self.world.add_drain(drain(1.0)).unwrap();
        self.world.remove_drain(id).unwrap();
        id
    }

    pub(crate) fn chemical(&mut self) -> ChemicalId {
        self.world.add_chemical(ChemicalSpec::default()).unwrap()
    }

    /// Handle of an obstacle that is gone.
    pub(crate) fn stale_obstacle(&mut self) -> ObstacleId {
        let id = self.world.add_obstacle(ball(9.0)).unwrap();
        self.world.remove_obstacle(id).unwrap();
        id
    }

    pub(crate) fn kinematic(&mut self, is_enabled: bool) -> ObstacleId {
        let obstacle = Obstacle { motion: ObstacleMotion::Push, is_enabled, ..ball(9.0) };
        self.world.add_obstacle(obstacle).unwrap()
    }

    /// The error of spawning a template of one disc.
    pub(crate) fn spawn_single(&mut self, placement: Placement) -> Error {
        let id = single(&mut self.world);
        self.world.spawn_template(id, placement).unwrap_err()
    }
}

pub(crate) fn circle(radius: f32) -> ForceField {
    let (region, acceleration) = (Region::Circle { centre: Vec2::ONE, radius }, Vec2::X);
    ForceField { region, kind: FieldKind::Uniform { acceleration } }
}

pub(crate) fn emitter(rate: f32) -> Emitter {
    Emitter::new(Region::All, Recipe::Organism(CoccusSpec::default().into()), rate)
}

pub(crate) fn drain(radius: f32) -> Drain {
    Drain { region: Region::Circle { centre: Vec2::ONE, radius }, kind: None }
}

/// A template of one disc.
pub(crate) fn single(world: &mut World) -> TemplateId {
    let mut builder = Template::builder();
    builder.node(Node::disc(Vec2::ZERO, 1.0, 1.0));
    world.add_template(builder.build().unwrap())
}

pub(crate) fn obstacle(shape: SharedShape, x: f32) -> Obstacle {
    Obstacle::new(shape, Pose::translation(x, 10.0))
}

pub(crate) fn ball(x: f32) -> Obstacle {
    obstacle(SharedShape::ball(1.0), x)
}

pub(crate) fn spec_error(spec: impl Into<OrganismSpec>) -> Error {
    spec.into().validate().unwrap_err()
}

/// A cell with a front that has no opposite.
pub(crate) fn odd_cell() -> OrganismSpec {
    RigidCellSpec { satellites: 9, ..RigidCellSpec::default() }.into()
}

/// Building two discs and something else.
pub(crate) fn build(change: fn(&mut TemplateBuilder)) -> Error {
    let mut builder = Template::builder();
    (0..2).for_each(|k| _ = builder.node(Node::disc(Vec2::X * k as f32, 1.0, 0.5)));
    change(&mut builder);
    builder.build().unwrap_err()
}
