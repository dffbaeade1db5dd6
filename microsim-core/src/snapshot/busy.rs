//! A busy world for tests of snapshots: organisms that eat, divide, fuse, sense and sleep.

use crate::capability::phagocytosis::MealPhase;
use crate::{
    AccelerationGrid, AgarSpec, AmoeboidCellSpec, AvoidanceParams, Bend, BrownianParams, ChemicalId, ChemicalSpec,
    ChemotaxisParams, CoccusSpec, Collider, ConservativeDistance, ContactPoint, ContactReporting, Controller, Crawl,
    Distance, Drain, Emitter, EmitterId, Event, Exchange, FieldKind, FleeParams, FluidBlockSpec, ForceField, Half,
    Inputs, Intent, JointEnd, JointId, JointKind, JointSpec, Kind, LinkDrag, Node, Obstacle, ObstacleId,
    ObstacleMotion, OrganismId, OrganismSpec, Outlet, PersistentWalkParams, Placement, Propulsion, PseudopodParams,
    PursueParams, Recipe, Refusal, Region, RigidCellSpec, Rope, RunAndTumbleParams, Template, Wall, World, WorldConfig,
    YieldingDistance,
};
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;

/// A world with meals in every phase, a furrow, orders, all controllers, an exchange, free places and every kind of event.
pub(super) fn world() -> World {
    let mut world = World::new(WorldConfig { substeps: 6, ..WorldConfig::default() }).unwrap();
    let chemical = world.add_chemical(ChemicalSpec { initial: 0.5, spacing: 10.0, ..ChemicalSpec::default() }).unwrap();
    let [sensor, platform] = obstacles(&mut world);
    world.set_contact_reporting(Some(ContactReporting { hit_speed: Some(0.0) })).unwrap();
    steer(&mut world, chemical);
    cage(&mut world, chemical);
    roped(&mut world);
    blow(&mut world);
    let cells = [(24.0, 30.0), (64.0, 30.0), (104.0, 30.0), (140.0, 30.0)].map(|(x, y)| cell(&mut world, x, y));
    let [eater, taker, toucher, divider] = cells;
    crawl(&mut world);
    dine(&mut world, cells);
    world.set_exchange(eater, Exchange { chemical, secretion: 1.0, uptake: 2.0 }).unwrap();
    world.divide_along(toucher, Vec2::X).unwrap();
    world.fuse(taker, divider).unwrap();
    divide(&mut world);
    let joint = join(&mut world, toucher, divider, platform);
    world.events = events(eater, divider, sensor, joint);
    let of_supplies = supply(&mut world, eater);
    world.events.extend(of_supplies);
    let partners = colliders(divider, sensor);
    let reports = &mut world.contact_reports;
    reports.points = partners.map(|partner| contact(eater, partner)).to_vec();
    reports.surfaces = partners.map(|partner| (eater, partner)).to_vec();
    reports.hits.clone_from(&reports.surfaces);
    world.move_obstacle(platform, Pose::translation(9.0, 4.0)).unwrap();
    let gone = cell(&mut world, 24.0, 55.0);
    world.remove(gone).unwrap();
    world
}

/// A cell that is large enough for a cup.
fn cell(world: &mut World, x: f32, y: f32) -> OrganismId {
    let spec = AmoeboidCellSpec { radii: Vec2::splat(10.0), ..AmoeboidCellSpec::default() };
    world.spawn(&spec.into(), Placement::at(x, y)).unwrap()
}

/// A cell that crawls by pseudopods.
fn crawl(world: &mut World) {
    let spec = AmoeboidCellSpec { radii: Vec2::splat(5.0), crawl: Crawl::Neutrophil, ..AmoeboidCellSpec::default() };
    let way = Controller::patrol(vec![Vec2::new(150.0, 10.0)], false);
    world.spawn(&spec.into(), Placement::at(150.0, 60.0).steered_by(way)).unwrap();
}

/// One small organism for each controller.
fn steer(world: &mut World, chemical: ChemicalId) {
    let run = RunAndTumbleParams { chemical: Some(chemical), ..RunAndTumbleParams::default() };
    let controllers = [
        Controller::wander([0.1, 0.2], 0.0),
        Controller::patrol(vec![Vec2::splat(9.0), Vec2::splat(60.0)], true),
        Controller::thrash(0.2, 0.5),
        Controller::ram(0.3, 0.3, 12.0),
        Controller::persistent_walk(PersistentWalkParams::default()),
        Controller::run_and_tumble(run),
        Controller::brownian(BrownianParams::default()),
        Controller::avoidance(AvoidanceParams::default()),
        Controller::flee(FleeParams::default(), Controller::Still),
        Controller::pursue(PursueParams::default(), Controller::Still),
    ];
    let place = |k: usize| Placement::at(10.0 + 10.0 * k as f32, 70.0);
    let mut spawn = |(k, controller): (usize, Controller)| {
        world.spawn(&CoccusSpec::default().into(), place(k).steered_by(controller)).unwrap()
    };
    let ids: Vec<_> = controllers.into_iter().enumerate().map(&mut spawn).collect();
    world.set_exempt(ids[0], ids[1], true).unwrap();
}

/// An organism that senses a chemical and is stuck.
fn cage(world: &mut World, chemical: ChemicalId) {
    let [a, b] = [Vec2::new(4.3, 2.8), Vec2::new(4.3, -2.8)];
    let bars = SharedShape::polyline(vec![a, b, -a, -b], Some(vec![[0, 1], [1, 2], [2, 3], [3, 0]]));
    world.add_obstacle(Obstacle::new(bars, Pose::translation(140.0, 75.0))).unwrap();
    let nose = ChemotaxisParams { threshold: 0.0, ..ChemotaxisParams::towards(chemical) };
    let spec = RigidCellSpec { radii: Vec2::new(4.0, 2.5), ..RigidCellSpec::default() };
    world.spawn(&spec.into(), Placement::at(140.0, 75.0).steered_by(Controller::chemotaxis(nose))).unwrap();
}

/// A joint of each kind, and a free place; returns the last one's handle.
fn join(world: &mut World, one: OrganismId, other: OrganismId, obstacle: ObstacleId) -> JointId {
    let (length, max_force, frequency, damping_ratio) = (10.0, 1.0, 1.0, 1.0);
    let kinds = [
        JointKind::Pin,
        JointKind::Distance { length },
        JointKind::Weld,
        JointKind::Rope { max_length: 90.0 },
        JointKind::Spring { length, frequency, damping_ratio },
        JointKind::mouse(max_force),
        JointKind::LengthMotor { length, max_force },
        JointKind::SpeedMotor { speed: 1.0, max_force },
    ];
    let on_obstacle = JointEnd::Obstacle { obstacle, at: Vec2::X };
    let ends = [JointEnd::Centre(other), JointEnd::Point(Vec2::splat(50.0)), on_obstacle];
    let node = JointEnd::Node { organism: one, node: 0 };
    // Each kind of end on either side.
    let spec = |(k, kind): (usize, JointKind)| {
        let (a, b) = if k < 4 { (node, ends[k % 3]) } else { (ends[k % 3], node) };
        JointSpec::new(a, b, kind)
    };
    let joints: Vec<_> = kinds.into_iter().enumerate().map(|it| world.add_joint(spec(it)).unwrap()).collect();
    let gone = world.add_joint(spec((0, JointKind::Weld))).unwrap();
    world.remove_joint(gone).unwrap();
    joints[7]
}

/// A force field of each kind, a region of each, and a free place.
fn blow(world: &mut World) {
    let centre = Vec2::splat(40.0);
    let kinds = [
        FieldKind::Uniform { acceleration: Vec2::ZERO },
        FieldKind::Radial { centre, acceleration: 0.0 },
        FieldKind::Vortex { centre, acceleration: 0.0 },
        FieldKind::Thermal { mobility: 0.0 },
        FieldKind::Grid(AccelerationGrid::sampled(Vec2::ZERO, centre, [3, 2], |at| 1e-3 * at).unwrap()),
    ];
    let circle = Region::Circle { centre, radius: 5.0 };
    let regions = [Region::All, circle, Region::Box { low: Vec2::ZERO, high: centre }, circle, Region::All];
    let calm = kinds[0].clone();
    let fields = kinds.into_iter().zip(regions).map(|(kind, region)| ForceField { region, kind });
    let fields: Vec<_> = fields.map(|field| world.add_field(field).unwrap()).collect();
    let gone = world.add_field(ForceField { region: regions[0], kind: calm }).unwrap();
    world.remove_field(gone).unwrap();
    assert_eq!(fields.len(), world.fields().count());
}

/// Emitters of all that can be emitted; the first of them.
fn emitters(world: &mut World) -> EmitterId {
    let template = world.add_template({
        let mut builder = Template::builder();
        builder.node(Node::disc(Vec2::ZERO, 1.0, 0.5));
        builder.build().unwrap()
    });
    let region = Region::Box { low: Vec2::new(2.0, 80.0), high: Vec2::new(20.0, 88.0) };
    let angle = [[-9.0, -9.0], [9.0, -9.0], [0.0, 9.0]].map(Vec2::from).to_vec();
    let pseudopods = Some(PseudopodParams::default());
    let amoeba =
        AmoeboidCellSpec { outline: angle, crawl: Crawl::Neutrophil, pseudopods, ..AmoeboidCellSpec::default() };
    let specs = OrganismSpec::defaults().into_iter().chain([amoeba.into()]).map(Recipe::Organism);
    let emitters = specs.chain([Recipe::Template(template)]).map(|recipe| {
        let emitter = Emitter { angle: Some(0.0), ..Emitter::new(region, recipe, 0.5) };
        world.add_emitter(emitter).unwrap()
    });
    emitters.collect::<Vec<_>>()[0]
}

/// Emitters, drains, and free places among both; returns their events.
fn supply(world: &mut World, organism: OrganismId) -> [Event; 3] {
    let emitter = emitters(world);
    let corner = Region::Circle { centre: Vec2::ZERO, radius: 1.0 };
    let disc = Emitter::new(corner, Recipe::Organism(AgarSpec::default().into()), 0.0);
    world.add_emitter(disc.clone()).unwrap();
    let gone = world.add_emitter(disc).unwrap();
    world.remove_emitter(gone).unwrap();
    let strip = Region::Box { low: Vec2::ZERO, high: Vec2::new(0.1, 9.0) };
    let drains = [(corner, None), (strip, Some(Kind::Coccus))];
    let drains = drains.map(|(region, kind)| world.add_drain(Drain { region, kind }).unwrap());
    world.remove_drain(drains[0]).unwrap();
    world.add_drain(Drain { region: corner, kind: None }).unwrap();
    let gone = world.add_drain(Drain { region: corner, kind: None }).unwrap();
    world.remove_drain(gone).unwrap();
    let outlets = [Outlet::Drain(drains[1]), Outlet::Side(Wall::Left)];
    let drained = outlets.map(|outlet| Event::Drained { outlet, organism, kind: Kind::Agar, particles: 1 });
    [drained[0], drained[1], Event::Emitted { emitter, organism }]
}

/// A custom body, with a muscle.
fn roped(world: &mut World) {
    let mut builder = Template::builder();
    builder.name("rope");
    let [a, b] = [0.0, 2.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    let channel = builder.channel([1.0, 0.5]);
    builder.muscle(channel, Rope { a, b, max_length: 3.0 });
    let c = builder.node(Node::disc(Vec2::new(4.0, 0.0), 1.0, 0.5));
    builder.constraint(Bend::new([a, b, c], 0.0, 1.0));
    let spring = ConservativeDistance { a: b, b: c, rest_length: 1.0, compliance: 1.0, damping: 0.1 };
    let yielding = Distance { a: b, b: c, rest_length: 2.0, compliance: 1.0, damping: 0.1 };
    builder.constraint(spring).constraint(YieldingDistance { breaking_strain: 2.0, ..yielding.into() });
    builder.constraint(LinkDrag { a, b, along: 1.0, across: 2.0 });
    builder.propulsion(Propulsion { speed: 5.0, max_acceleration: 50.0 });
    let template = world.add_template(builder.build().unwrap());
    world.spawn_template(template, Placement::at(120.0, 75.0).damped(1.0, 2.0)).unwrap();
}

/// A body that is about to divide, and a template that also follows goals.
fn divide(world: &mut World) {
    let mut builder = Template::builder();
    [0.0, 1.0].into_iter().for_each(|x| _ = builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.4)));
    builder.cut([Half::of([0]).scaled(0.5), Half::of([1]).scaled(0.5)]);
    let template = world.add_template(builder.clone().build().unwrap());
    let body = world.spawn_template(template, Placement::at(110.0, 84.0)).unwrap();
    world.divide(body).unwrap();
    builder.propulsion(Propulsion { speed: 5.0, max_acceleration: 50.0 });
    world.add_template(builder.build().unwrap());
}

/// Lets cells eat until the first one digests, the second one ingests, the third one touches and the last one divides.
fn dine(world: &mut World, [eater, taker, toucher, divider]: [OrganismId; 4]) {
    let agar = AgarSpec::default().into();
    let mut inputs = Inputs::new();
    let serve = |world: &mut World, inputs: &mut Inputs, cell: OrganismId| {
        let at = world.centroid(cell).unwrap();
        world.spawn(&agar, Placement::at(at.x + 13.0, at.y)).unwrap();
        inputs.set(cell, Intent::toward(at + 40.0 * Vec2::X).unwrap());
    };
    serve(world, &mut inputs, eater);
    step_until(world, &inputs, |world| phase(world, eater) == Some(MealPhase::Ingested));
    serve(world, &mut inputs, taker);
    world.divide(divider).unwrap();
    step_until(world, &inputs, |world| matches!(phase(world, taker), Some(MealPhase::Ingesting(_))));
    serve(world, &mut inputs, toucher);
    inputs.set(eater, Intent::REST.digesting(true));
    step_until(world, &inputs, |world| matches!(phase(world, toucher), Some(MealPhase::Touching(_))));
}

fn step_until(world: &mut World, inputs: &Inputs, is_so: impl Fn(&World) -> bool) {
    assert!((0..400).any(|_| (world.step(inputs), is_so(world)).1));
}

fn phase(world: &World, cell: OrganismId) -> Option<MealPhase> {
    world.organisms.get(cell)?.engulfer.as_ref()?.meals.first().map(|meal| meal.phase)
}

/// A sensor with fluid in it, a one-way platform, and a place that is free again.
fn obstacles(world: &mut World) -> [ObstacleId; 2] {
    let block = FluidBlockSpec { size: Vec2::splat(2.0), ..FluidBlockSpec::default() };
    world.spawn(&block.into(), Placement::at(150.0, 84.0)).unwrap();
    let ball = |x, y| Obstacle::new(SharedShape::ball(2.0), Pose::translation(x, y));
    let sensor = world.add_obstacle(Obstacle { is_sensor: true, ..ball(150.0, 84.0) }).unwrap();
    let platform = Obstacle { motion: ObstacleMotion::Push, one_way: Some(Vec2::Y), ..ball(4.0, 4.0) };
    let platform = world.add_obstacle(platform).unwrap();
    let still = world.add_obstacle(Obstacle { motion: ObstacleMotion::Stop, ..ball(4.0, 86.0) }).unwrap();
    // The place of one of them is used again.
    let gone = [4.0, 9.0].map(|y| world.add_obstacle(ball(150.0, y)).unwrap());
    gone.into_iter().for_each(|id| world.remove_obstacle(id).unwrap());
    world.set_obstacle_enabled(still, false).unwrap();
    [sensor, platform]
}

/// One of each kind.
fn colliders(organism: OrganismId, obstacle: ObstacleId) -> [Collider; 3] {
    [Collider::Organism(organism), Collider::Obstacle(obstacle), Collider::Wall(Wall::Top)]
}

fn contact(organism: OrganismId, partner: Collider) -> ContactPoint {
    let (point, normal) = (Vec2::ONE, Vec2::X);
    ContactPoint { organism, partner, node: 1, partner_node: Some(2), point, normal, speed: 3.0, impulse: 4.0 }
}

/// One of each kind.
fn events(a: OrganismId, b: OrganismId, obstacle: ObstacleId, joint: JointId) -> Vec<Event> {
    let between = [Some(a), Some(b)];
    let reason = Refusal::FurrowOpen;
    let of_contacts = colliders(b, obstacle).into_iter().flat_map(|collider| {
        let (began, ended) = (Event::TouchBegan { organism: a, collider }, Event::TouchEnded { organism: a, collider });
        [began, ended, Event::Hit { contact: contact(a, collider) }]
    });
    let of_sensors = [None, Some(1)].into_iter().flat_map(|particle| {
        let entered = Event::SensorEntered { sensor: obstacle, organism: a, particle };
        [entered, Event::SensorLeft { sensor: obstacle, organism: a, particle }]
    });
    let others = [
        Event::ContactBegan { a, b },
        Event::ContactEnded { a, b },
        Event::FrontSwitched { organism: a },
        Event::IngestionBegan { engulfer: a, prey: b },
        Event::Ingested { engulfer: a, prey: b },
        Event::Released { engulfer: a, prey: b },
        Event::Consumed { engulfer: a, prey: b, kind: Kind::Agar },
        Event::DivisionBegan { organism: a },
        Event::DivisionRefused { organism: a, reason },
        Event::DivisionAbandoned { organism: a, reason },
        Event::Divided { parent: a, daughter: b },
        Event::FusionRefused { organism: a, with: b, reason },
        Event::Fused { into: a, from: b },
        Event::JointBroken { joint, between },
        Event::JointEnded { joint, between },
        Event::Quarantined { organism: a },
        Event::ObstacleBlocked { obstacle },
        Event::LinkTorn { organism: a, nodes: [0, 1] },
    ];
    others.into_iter().chain(of_contacts).chain(of_sensors).collect()
}
