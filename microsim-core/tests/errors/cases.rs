//! A line for each kind of error that each function can give.

use super::Case;
use super::room::{Room, ball, build, circle, drain, emitter, obstacle, odd_cell, single, spec_error};
use microsim_core::glam::Vec2;
use microsim_core::parry2d::math::Pose;
use microsim_core::parry2d::shape::SharedShape;
use microsim_core::{
    AccelerationGrid, Actuation, AgarSpec, AmoeboidCellSpec, Anchor, Area, BacillusSpec, ChemicalSpec, CoccusSpec,
    CollisionGroups, ContactReporting, Controller, Distance, Emitter, Exchange, FleeParams, FluidBlockSpec,
    FluidParams, Half, Inputs, Intent, JointEnd, JointKind, JointSpec, LinkDrag, MinDistance, Node, Obstacle,
    OrganismSpec, PhagocytosisParams, Placement, PlateletSpec, ProbeSpec, Recipe, RedCellSpec, RigidCellSpec, Rope,
    Template, World, WorldConfig, YieldingDistance,
};

const SPRING: Distance = Distance { a: 0, b: 1, rest_length: 1.0, compliance: 1e-3, damping: 0.0 };

/// Controllers one in another, one too many.
fn nested() -> Controller {
    (0..8).fold(Controller::Still, |inner, _| Controller::flee(FleeParams::default(), inner))
}

const AT: fn(f32, f32) -> Placement = Placement::at;

#[rustfmt::skip]
pub(crate) const CASES: &[Case] = &[
    ("WorldConfig::validate", "OutOfRange", "dt", |_| WorldConfig { dt: 0.0, ..WorldConfig::default() }.validate().unwrap_err()),
    ("World::new", "OutOfRange", "substeps", |_| World::new(WorldConfig { substeps: 0, ..WorldConfig::default() }).unwrap_err()),
    ("Intent::toward", "OutOfRange", "goal.x", |_| Intent::toward(Vec2::NAN).unwrap_err()),
    ("Controller::validate", "OutOfRange", "rest", |_| Controller::wander([1.0, 2.0], 2.0).validate().unwrap_err()),
    ("Controller::validate", "BadReference", "through", |_| Controller::patrol(vec![], true).validate().unwrap_err()),
    ("Controller::validate", "Unsupported", "otherwise", |_| nested().validate().unwrap_err()),
    ("FluidParams::validate", "OutOfRange", "spacing", |_| FluidParams { spacing: 0.0, ..FluidParams::default() }.validate().unwrap_err()),
    ("TemplateBuilder::build", "OutOfRange", "nodes[2].radius", |_| build(|b| _ = b.node(Node::disc(Vec2::ZERO, 1.0, -1.0)))),
    ("TemplateBuilder::build", "OutOfRange", "constraints[0].damping", |_| build(|b| _ = b.constraint(Distance { a: 0, b: 1, rest_length: 1.0, compliance: 0.0, damping: f32::NAN }))),
    ("TemplateBuilder::build", "OutOfRange", "constraints[0].rest_area", |_| build(|b| {
        b.node(Node::disc(Vec2::Y, 1.0, 0.5));
        b.constraint(Area { ring: vec![0, 1, 2], rest_area: 0.0, compliance: 0.0, is_upper_bound: false });
    })),
    ("TemplateBuilder::build", "BadReference", "nodes", |_| Template::builder().build().unwrap_err()),
    ("TemplateBuilder::build", "BadReference", "constraints[0].a", |_| build(|b| _ = b.link(0, 9, 0.0))),
    ("TemplateBuilder::build", "BadReference", "constraints[0].a", |_| build(|b| _ = b.constraint(Rope { a: 1, b: 1, max_length: 1.0 }))),
    ("TemplateBuilder::build", "BadReference", "constraints[0].a", |_| build(|b| _ = b.constraint(MinDistance { a: 0, b: 2, min_length: 1.0 }))),
    ("TemplateBuilder::build", "BadReference", "constraints[0].node", |_| build(|b| _ = b.constraint(Anchor { node: 5, anchor: 0, rest_length: 0.0, max_length: 1.0, compliance: 0.0 }))),
    ("TemplateBuilder::build", "BadReference", "outline", |_| build(|b| _ = b.outline(&[0, 1]))),
    ("OrganismSpec::validate", "OutOfRange", "radius", |_| spec_error(AgarSpec { radius: 0.0, ..AgarSpec::default() })),
    ("OrganismSpec::validate", "OutOfRange", "density", |_| spec_error(CoccusSpec { density: -1.0, ..CoccusSpec::default() })),
    ("OrganismSpec::validate", "OutOfRange", "satellites", |_| spec_error(PlateletSpec { satellites: 7, ..PlateletSpec::default() })),
    ("OrganismSpec::validate", "OutOfRange", "mass", |_| spec_error(ProbeSpec { mass: f32::NAN, ..ProbeSpec::default() })),
    ("OrganismSpec::validate", "OutOfRange", "chord_damping", |_| spec_error(RedCellSpec { chord_damping: 11.0, ..RedCellSpec::default() })),
    ("OrganismSpec::validate", "OutOfRange", "layers", |_| spec_error(RigidCellSpec { layers: 3, ..RigidCellSpec::default() })),
    ("OrganismSpec::validate", "Unsupported", "satellites", |_| odd_cell().validate().unwrap_err()),
    ("OrganismSpec::validate", "OutOfRange", "size.y", |_| spec_error(FluidBlockSpec { size: Vec2::X * 5.0, ..FluidBlockSpec::default() })),
    ("OrganismSpec::validate", "OutOfRange", "node_radius", |_| spec_error(AmoeboidCellSpec { node_radius: 0.0, ..AmoeboidCellSpec::default() })),
    ("OrganismSpec::particle_count", "OutOfRange", "radius", |_| OrganismSpec::from(AgarSpec { radius: -1.0, ..AgarSpec::default() }).particle_count().unwrap_err()),
    ("OrganismSpec::particle_count", "Unsupported", "satellites", |_| odd_cell().particle_count().unwrap_err()),
    ("OrganismSpec::extent", "Unsupported", "satellites", |_| odd_cell().extent().unwrap_err()),
    ("OrganismSpec::validate", "OutOfRange", "speed", |_| spec_error(BacillusSpec { speed: -1.0, ..BacillusSpec::default() })),
    ("OrganismSpec::extent", "OutOfRange", "radius", |_| OrganismSpec::from(AgarSpec { radius: -1.0, ..AgarSpec::default() }).extent().unwrap_err()),
    ("World::spawn", "OutOfRange", "radius", |r| r.spawn(AgarSpec { radius: 0.0, ..AgarSpec::default() }, AT(9.0, 9.0))),
    ("World::spawn", "OutOfRange", "angle", |r| r.spawn(AgarSpec::default(), AT(9.0, 9.0).turned(f32::INFINITY))),
    ("World::spawn", "BadReference", "controller.through", |r| r.spawn(AgarSpec::default(), AT(9.0, 9.0).steered_by(Controller::patrol(vec![], true)))),
    ("World::spawn", "Unsupported", "scale", |r| r.spawn(AmoeboidCellSpec::default(), AT(30.0, 60.0).scaled(2.0))),
    ("World::spawn", "OutsideWorld", "at", |r| r.spawn_at(-5.0, 9.0)),
    ("World::spawn", "Overlap", "at", |r| r.spawn_at(30.5, 30.0)),
    ("World::spawn", "Overlap", "at", |r| r.spawn_at(120.0, 45.0)),
    ("World::spawn", "TooMany", "particles", |r| r.spawn(FluidBlockSpec { size: Vec2::splat(60.0), ..FluidBlockSpec::default() }, AT(40.0, 40.0))),
    ("World::spawn_template", "Stale", "template", |r| {
        let id = single(&mut r.world);
        World::new(WorldConfig::default()).unwrap().spawn_template(id, AT(9.0, 9.0)).unwrap_err()
    }),
    ("World::spawn_template", "OutOfRange", "scale", |r| r.spawn_single(AT(9.0, 9.0).scaled(0.0))),
    ("World::spawn_template", "BadReference", "controller.through", |r| r.spawn_single(AT(9.0, 9.0).steered_by(Controller::patrol(vec![], true)))),
    ("World::spawn_template", "Unsupported", "controller", |r| r.spawn_single(AT(9.0, 9.0).steered_by(Controller::thrash(1.0, 0.5)))),
    ("World::spawn_template", "OutsideWorld", "at", Room::spawn_wide),
    ("World::spawn_template", "Overlap", "at", |r| r.spawn_single(AT(30.0, 30.0))),
    ("World::spawn_template", "TooMany", "particles", |_| {
        let mut full = World::new(WorldConfig { max_particles: 1, ..WorldConfig::default() }).unwrap();
        full.spawn(&AgarSpec::default().into(), AT(9.0, 9.0)).unwrap();
        let id = single(&mut full);
        full.spawn_template(id, AT(20.0, 9.0)).unwrap_err()
    }),
    ("World::remove", "Stale", "organism", |r| r.world.remove(r.stale).unwrap_err()),
    ("World::grow", "Stale", "organism", |r| r.world.grow(r.stale, 1, 1).unwrap_err()),
    ("World::grow", "Unsupported", "organism", |r| r.world.grow(r.agar, 1, 1).unwrap_err()),
    ("World::grow", "OutOfRange", "particles", |r| r.world.grow(r.cell, 0, 600).unwrap_err()),
    ("World::grow", "OutOfRange", "nodes", |r| r.world.grow(r.cell, 200, 0).unwrap_err()),
    ("World::grow", "TooMany", "particles", |r| r.world.grow(r.cell, 0, u32::MAX).unwrap_err()),
    ("World::shrink", "Stale", "organism", |r| r.world.shrink(r.stale, 1).unwrap_err()),
    ("World::shrink", "Unsupported", "organism", |r| r.world.shrink(r.agar, 1).unwrap_err()),
    ("World::shrink", "OutOfRange", "particles", |r| r.world.shrink(r.cell, u32::MAX).unwrap_err()),
    ("World::set_speed", "Stale", "organism", |r| r.world.set_speed(r.stale, 1.0).unwrap_err()),
    ("World::set_speed", "OutOfRange", "speed", |r| r.world.set_speed(r.cell, -1.0).unwrap_err()),
    ("World::set_phagocytosis", "Stale", "organism", |r| r.world.set_phagocytosis(r.stale, PhagocytosisParams::default()).unwrap_err()),
    ("World::set_phagocytosis", "Unsupported", "organism", |r| r.world.set_phagocytosis(r.agar, PhagocytosisParams::default()).unwrap_err()),
    ("World::set_phagocytosis", "OutOfRange", "size_ratio", |r| { let params = PhagocytosisParams { size_ratio: -1.0, ..PhagocytosisParams::default() }; r.world.set_phagocytosis(r.cell, params).unwrap_err() }),
    ("World::divide", "Stale", "organism", |r| r.world.divide(r.stale).unwrap_err()),
    ("World::divide", "Unsupported", "organism", |r| r.world.divide(r.agar).unwrap_err()),
    ("World::divide_along", "Stale", "organism", |r| r.world.divide_along(r.stale, Vec2::X).unwrap_err()),
    ("World::divide_along", "Unsupported", "organism", |r| r.world.divide_along(r.agar, Vec2::X).unwrap_err()),
    ("World::divide_along", "Unsupported", "axis", |r| r.world.divide_along(r.cell, Vec2::ZERO).unwrap_err()),
    ("World::divide_along", "Unsupported", "axis", |r| r.world.divide_along(r.cell, Vec2::NAN).unwrap_err()),
    ("World::fuse", "Stale", "organism", |r| r.world.fuse(r.stale, r.cell).unwrap_err()),
    ("World::fuse", "Stale", "b", |r| r.world.fuse(r.cell, r.stale).unwrap_err()),
    ("World::fuse", "Unsupported", "organism", |r| r.world.fuse(r.agar, r.cell).unwrap_err()),
    ("World::set_exempt", "Stale", "a", |r| r.world.set_exempt(r.stale, r.cell, true).unwrap_err()),
    ("World::set_exempt", "Stale", "b", |r| r.world.set_exempt(r.cell, r.stale, true).unwrap_err()),
    ("World::set_exempt", "Unsupported", "b", |r| r.world.set_exempt(r.cell, r.cell, true).unwrap_err()),
    ("ChemicalSpec::validate", "OutOfRange", "decay", |r| ChemicalSpec { decay: -1.0, ..ChemicalSpec::default() }.validate(r.world.config()).unwrap_err()),
    ("World::add_chemical", "OutOfRange", "spacing", |r| r.world.add_chemical(ChemicalSpec { spacing: 0.0, ..ChemicalSpec::default() }).unwrap_err()),
    ("World::set_controller", "Stale", "organism", |r| r.world.set_controller(r.stale, Controller::Still).unwrap_err()),
    ("World::set_controller", "OutOfRange", "controller.interval", |r| r.world.set_controller(r.cell, Controller::thrash(0.0, 0.5)).unwrap_err()),
    ("World::set_controller", "BadReference", "controller.through", |r| r.world.set_controller(r.cell, Controller::patrol(vec![], true)).unwrap_err()),
    ("World::set_controller", "Unsupported", "controller.otherwise", |r| r.world.set_controller(r.cell, nested()).unwrap_err()),
    ("World::set_controller", "Unsupported", "controller", |r| r.world.set_controller(r.agar, Controller::thrash(1.0, 0.5)).unwrap_err()),
    ("World::set_exchange", "OutOfRange", "uptake", |r| { let chemical = r.chemical(); r.world.set_exchange(r.cell, Exchange { chemical, secretion: 0.0, uptake: -1.0 }).unwrap_err() }),
    ("World::set_exchange", "Stale", "organism", |r| { let chemical = r.chemical(); r.world.set_exchange(r.stale, Exchange { chemical, secretion: 0.0, uptake: 0.0 }).unwrap_err() }),
    ("World::set_exchange", "BadReference", "chemical", |r| {
        let chemical = Room::new().chemical();
        r.world.set_exchange(r.cell, Exchange { chemical, secretion: 0.0, uptake: 0.0 }).unwrap_err()
    }),
    ("World::push", "Stale", "organism", |r| r.world.push(r.stale, Vec2::X).unwrap_err()),
    ("World::push", "OutOfRange", "velocity.y", |r| r.world.push(r.cell, Vec2::new(0.0, f32::NAN)).unwrap_err()),
    ("World::add_obstacle", "OutOfRange", "pose.translation.x", |r| r.world.add_obstacle(obstacle(SharedShape::ball(1.0), f32::NAN)).unwrap_err()),
    ("World::add_obstacle", "Unsupported", "shape", |r| r.world.add_obstacle(obstacle(SharedShape::ball(f32::NAN), 9.0)).unwrap_err()),
    ("Actuation::validate", "OutOfRange", "torque", |_| Actuation::torque(f32::NAN).validate().unwrap_err()),
    ("Inputs::actuate", "OutOfRange", "force.x", |r| Inputs::new().actuate(r.cell, Actuation::force(Vec2::NAN)).unwrap_err()),
    ("Inputs::actuate_node", "OutOfRange", "impulse.y", |r| Inputs::new().actuate_node(r.cell, 0, Actuation::impulse(Vec2::Y * 2e9)).unwrap_err()),
    ("Inputs::actuate_node", "Unsupported", "torque", |r| Inputs::new().actuate_node(r.cell, 0, Actuation::torque(1.0)).unwrap_err()),
    ("Inputs::activate", "OutOfRange", "activation", |r| Inputs::new().activate(r.cell, 0, -0.5).unwrap_err()),
    ("World::check_inputs", "Stale", "intent.organism", |r| r.refuse(|inputs, r| inputs.set(r.stale, Intent::REST))),
    ("World::check_inputs", "Unsupported", "intent.goal", |r| r.refuse(|inputs, r| inputs.set(r.agar, Intent::toward(Vec2::ZERO).unwrap()))),
    ("World::check_inputs", "BadReference", "actuation.node", |r| r.refuse(|inputs, r| inputs.actuate_node(r.agar, 1, Actuation::force(Vec2::X)).unwrap())),
    ("World::check_inputs", "BadReference", "activation.channel", |r| r.refuse(|inputs, r| inputs.activate(r.agar, 0, 1.0).unwrap())),
    ("TemplateBuilder::build", "BadReference", "muscles", |_| build(|b| _ = b.muscle(0, Rope { a: 0, b: 1, max_length: 1.0 }))),
    ("TemplateBuilder::build", "OutOfRange", "channels[0].active", |_| build(|b| _ = b.channel([1.0, 0.0]))),
    ("TemplateBuilder::build", "OutOfRange", "constraints[0].breaking_strain", |_| build(|b| _ = b.constraint(YieldingDistance { breaking_strain: 0.0, ..SPRING.into() }))),
    ("TemplateBuilder::build", "OutOfRange", "constraints[0].across", |_| build(|b| _ = b.constraint(LinkDrag { a: 0, b: 1, along: 1.0, across: f32::NAN }))),
    ("TemplateBuilder::build", "OutOfRange", "constraints[0].along", |_| build(|b| _ = b.constraint(LinkDrag { a: 0, b: 1, along: -1.0, across: 1.0 }))),
    ("JointSpec::validate", "OutOfRange", "kind.max_force", |r| r.joint(JointKind::mouse(-1.0)).validate().unwrap_err()),
    ("World::add_joint", "OutOfRange", "kind.length", |r| r.world.add_joint(r.joint(JointKind::Distance { length: f32::NAN })).unwrap_err()),
    ("World::add_joint", "Stale", "a.organism", |r| r.world.add_joint(JointSpec { a: JointEnd::Centre(r.stale), ..r.joint(JointKind::Pin) }).unwrap_err()),
    ("World::add_joint", "BadReference", "a.node", |r| r.world.add_joint(JointSpec { a: JointEnd::Node { organism: r.agar, node: 1 }, ..r.joint(JointKind::Pin) }).unwrap_err()),
    ("World::add_joint", "Unsupported", "b", |r| r.world.add_joint(JointSpec { a: JointEnd::Point(Vec2::ONE), ..r.joint(JointKind::Pin) }).unwrap_err()),
    ("World::set_joint", "Stale", "joint", |r| { let joint = r.stale_joint(); r.world.set_joint(joint, r.joint(JointKind::Pin)).unwrap_err() }),
    ("World::remove_joint", "Stale", "joint", |r| { let joint = r.stale_joint(); r.world.remove_joint(joint).unwrap_err() }),
    ("AccelerationGrid::new", "OutOfRange", "nodes", |_| AccelerationGrid::new(Vec2::ZERO, Vec2::ONE, [2, 2], Vec::new()).unwrap_err()),
    ("AccelerationGrid::sampled", "OutOfRange", "nodes[0].x", |_| AccelerationGrid::sampled(Vec2::ZERO, Vec2::ONE, [2, 2], |_| Vec2::NAN).unwrap_err()),
    ("ForceField::validate", "OutOfRange", "region.radius", |_| circle(-1.0).validate().unwrap_err()),
    ("World::add_field", "OutOfRange", "region.radius", |r| r.world.add_field(circle(f32::NAN)).unwrap_err()),
    ("World::set_field", "Stale", "field", |r| { let field = r.stale_field(); r.world.set_field(field, circle(1.0)).unwrap_err() }),
    ("World::remove_field", "Stale", "field", |r| { let field = r.stale_field(); r.world.remove_field(field).unwrap_err() }),
    ("World::set_scale", "Stale", "organism", |r| r.world.set_scale(r.stale, 1.0).unwrap_err()),
    ("World::set_scale", "Unsupported", "organism", |r| r.world.set_scale(r.cell, 1.0).unwrap_err()),
    ("World::set_scale", "OutOfRange", "scale", |r| r.world.set_scale(r.agar, 11.0).unwrap_err()),
    ("World::set_mass", "Stale", "organism", |r| r.world.set_mass(r.stale, 1.0).unwrap_err()),
    ("World::set_mass", "Unsupported", "organism", |r| r.world.set_mass(r.cell, 1.0).unwrap_err()),
    ("World::set_mass", "OutOfRange", "mass", |r| r.world.set_mass(r.agar, 0.0).unwrap_err()),
    ("TemplateBuilder::build", "BadReference", "cut", |_| build(|b| _ = b.cut([Half::of([0]), Half::of([7])]))),
    ("World::replace", "Stale", "organism", |r| r.world.replace(r.stale, &emitter(1.0).recipe, AT(9.0, 9.0)).unwrap_err()),
    ("World::replace", "OutsideWorld", "at", |r| r.world.replace(r.agar, &emitter(1.0).recipe, AT(-9.0, 9.0)).unwrap_err()),
    ("Emitter::validate", "OutOfRange", "rate", |_| emitter(f32::NAN).validate().unwrap_err()),
    ("Emitter::validate", "OutOfRange", "recipe.radius", |_| Emitter { recipe: Recipe::Organism(CoccusSpec { radius: -1.0, ..CoccusSpec::default() }.into()), ..emitter(1.0) }.validate().unwrap_err()),
    ("World::add_emitter", "OutOfRange", "rate", |r| r.world.add_emitter(emitter(-1.0)).unwrap_err()),
    ("World::add_emitter", "Stale", "recipe.template", |r| {
        let template = single(&mut r.world);
        let emitter = Emitter { recipe: Recipe::Template(template), ..emitter(1.0) };
        World::new(WorldConfig::default()).unwrap().add_emitter(emitter).unwrap_err()
    }),
    ("World::set_emitter", "Stale", "emitter", |r| { let id = r.stale_emitter(); r.world.set_emitter(id, emitter(1.0)).unwrap_err() }),
    ("World::remove_emitter", "Stale", "emitter", |r| { let id = r.stale_emitter(); r.world.remove_emitter(id).unwrap_err() }),
    ("Drain::validate", "OutOfRange", "region.radius", |_| drain(-1.0).validate().unwrap_err()),
    ("World::add_drain", "OutOfRange", "region.radius", |r| r.world.add_drain(drain(f32::NAN)).unwrap_err()),
    ("World::set_drain", "Stale", "drain", |r| { let id = r.stale_drain(); r.world.set_drain(id, drain(1.0)).unwrap_err() }),
    ("World::remove_drain", "Stale", "drain", |r| { let id = r.stale_drain(); r.world.remove_drain(id).unwrap_err() }),
    ("World::set_gravity", "OutOfRange", "gravity.y", |r| r.world.set_gravity(Vec2::new(0.0, 2000.0)).unwrap_err()),
    ("World::set_damping", "OutOfRange", "damping", |r| r.world.set_damping(-1.0).unwrap_err()),
    ("World::set_max_speed", "OutOfRange", "max_speed", |r| r.world.set_max_speed(0.0).unwrap_err()),
    ("World::set_gravity_scale", "Stale", "organism", |r| r.world.set_gravity_scale(r.stale, 1.0).unwrap_err()),
    ("World::set_gravity_scale", "OutOfRange", "scale", |r| r.world.set_gravity_scale(r.cell, f32::NAN).unwrap_err()),
    ("World::set_linear_damping", "Stale", "organism", |r| r.world.set_linear_damping(r.stale, 1.0).unwrap_err()),
    ("World::set_linear_damping", "OutOfRange", "damping", |r| r.world.set_linear_damping(r.cell, 30.0).unwrap_err()),
    ("World::set_angular_damping", "Stale", "organism", |r| r.world.set_angular_damping(r.stale, 1.0).unwrap_err()),
    ("World::set_angular_damping", "OutOfRange", "damping", |r| r.world.set_angular_damping(r.cell, f32::NAN).unwrap_err()),
    ("World::spawn", "OutOfRange", "linear_damping", |r| r.world.spawn(&AgarSpec::default().into(), AT(9.0, 9.0).damped(-1.0, 0.0)).unwrap_err()),
    ("World::set_size", "OutOfRange", "size.x", |r| r.world.set_size(Vec2::new(0.5, 90.0)).unwrap_err()),
    ("World::set_size", "OutsideWorld", "size", |r| r.world.set_size(Vec2::splat(5.0)).unwrap_err()),
    ("TemplateBuilder::build", "Unsupported", "name", |_| build(|b| _ = b.name("a\nb"))),
    ("World::set_user_data", "Stale", "organism", |r| r.world.set_user_data(r.stale, 1).unwrap_err()),
    ("World::set_collision_groups", "Stale", "organism", |r| r.world.set_collision_groups(r.stale, CollisionGroups::ALL).unwrap_err()),
    ("World::set_collision_groups", "Unsupported", "organism", |r| r.world.set_collision_groups(r.cell, CollisionGroups::ALL).unwrap_err()),
    ("World::add_obstacle", "Overlap", "pose", |r| r.world.add_obstacle(obstacle(SharedShape::ball(40.0), 40.0)).unwrap_err()),
    ("World::add_obstacle", "OutOfRange", "one_way", |r| r.world.add_obstacle(Obstacle { one_way: Some(Vec2::ZERO), ..ball(9.0) }).unwrap_err()),
    ("World::add_obstacle", "OutOfRange", "pose.rotation", |r| {
        let mut skew = ball(9.0);
        skew.pose.rotation.re = 0.5;
        r.world.add_obstacle(skew).unwrap_err()
    }),
    ("World::set_contact_reporting", "OutOfRange", "hit_speed", |r| r.world.set_contact_reporting(Some(ContactReporting { hit_speed: Some(-1.0) })).unwrap_err()),
    ("World::remove_obstacle", "Stale", "obstacle", |r| { let stale = r.stale_obstacle(); r.world.remove_obstacle(stale).unwrap_err() }),
    ("World::set_obstacle_pose", "Stale", "obstacle", |r| { let stale = r.stale_obstacle(); r.world.set_obstacle_pose(stale, Pose::IDENTITY).unwrap_err() }),
    ("World::set_obstacle_pose", "Overlap", "pose", |r| {
        let (id, to) = (r.world.add_obstacle(ball(9.0)).unwrap(), r.world.centroid(r.cell).unwrap());
        r.world.set_obstacle_pose(id, Pose::translation(to.x, to.y)).unwrap_err()
    }),
    ("World::set_obstacle_shape", "Stale", "obstacle", |r| { let stale = r.stale_obstacle(); r.world.set_obstacle_shape(stale, SharedShape::ball(1.0)).unwrap_err() }),
    ("World::set_obstacle_shape", "Overlap", "pose", |r| { let id = r.world.add_obstacle(ball(9.0)).unwrap(); r.world.set_obstacle_shape(id, SharedShape::ball(90.0)).unwrap_err() }),
    ("World::set_obstacle_enabled", "Stale", "obstacle", |r| { let stale = r.stale_obstacle(); r.world.set_obstacle_enabled(stale, true).unwrap_err() }),
    ("World::set_obstacle_enabled", "Overlap", "pose", |r| {
        let id = r.world.add_obstacle(Obstacle { is_enabled: false, ..obstacle(SharedShape::ball(90.0), 9.0) }).unwrap();
        r.world.set_obstacle_enabled(id, true).unwrap_err()
    }),
    ("World::move_obstacle", "Stale", "obstacle", |r| { let stale = r.stale_obstacle(); r.world.move_obstacle(stale, Pose::IDENTITY).unwrap_err() }),
    ("World::move_obstacle", "Unsupported", "motion", |r| { let id = r.world.add_obstacle(ball(9.0)).unwrap(); r.world.move_obstacle(id, Pose::IDENTITY).unwrap_err() }),
    ("World::move_obstacle", "Unsupported", "is_enabled", |r| { let id = r.kinematic(false); r.world.move_obstacle(id, Pose::IDENTITY).unwrap_err() }),
    ("World::move_obstacle", "OutOfRange", "target.translation.y", |r| { let id = r.kinematic(true); r.world.move_obstacle(id, Pose::translation(0.0, f32::NAN)).unwrap_err() }),
    ("World::move_obstacle", "OutOfRange", "target.rotation", |r| { let id = r.kinematic(true); r.world.move_obstacle(id, Pose::rotation(2.0)).unwrap_err() }),
];
