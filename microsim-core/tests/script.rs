//! Commands and checks in scenario files, and the built-in scenarios that have them.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]
#![cfg(feature = "scenario")]

use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::scenario::{Built, Scenario, Violation, builtin};
use microsim_core::{
    AgarSpec, Collider, ContactPoint, Emitter, EmitterId, Event, JointEnd, JointId, JointKind, JointSpec, Kind,
    Obstacle, ObstacleId, OrganismId, Outlet, Recipe, Refusal, Region, Wall, World, WorldConfig,
};

const FILE: &str = "schema = 1\n[world]\nsize = [100.0, 60.0]\n[amoeboid_cell.c]\nradii = [8.0, 8.0]\n\
    [agar.a]\nradius = 1.5\n[wander.w]\ninterval = [0.1, 0.2]\n\
    [[spawn]]\nof = 'c'\nat = [30, 30]\nname = 'cell'\ncontroller = 'w'\n[[spawn]]\nof = 'a'\nat = [60, 30]\nname = 'prey'\n";

fn built(more: &str) -> Built {
    built_with(&[], more)
}

fn built_with(overrides: &[(String, String)], more: &str) -> Built {
    let scenario = Scenario::parse(&format!("{FILE}{more}"), overrides);
    scenario.and_then(|scenario| scenario.build()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Takes so many steps; returns what broke first.
fn play(built: &mut Built, steps: u32) -> Option<Violation> {
    let Built { world, script, checks, .. } = built;
    let mut broken = None;
    for _ in 0..steps {
        let inputs = script.before_step(world);
        world.step(inputs);
        broken = broken.or(checks.after_step(world).first().copied());
    }
    broken
}

fn cell(built: &Built) -> OrganismId {
    built.named.iter().find(|(name, _)| name == "cell").unwrap().1
}

fn nodes(built: &Built) -> usize {
    built.world.view().organism(cell(built)).unwrap().outline().len()
}

fn at(built: &Built) -> Vec2 {
    built.world.centroid(cell(built)).unwrap()
}

#[test]
fn a_command_is_done_once_in_its_step_or_repeated_as_long_as_it_says() {
    let mut once = built("[[command]]\nof = 'cell'\nat = 0.5\ngrow = { nodes = 2 }\n");
    let before = nodes(&once);
    play(&mut once, 30);
    assert_eq!(nodes(&once), before);
    play(&mut once, 1);
    assert_eq!(nodes(&once), before + 2);
    play(&mut once, 60);
    assert_eq!(nodes(&once), before + 2);

    let repeated = "[[command]]\nof = 'cell'\nat = 0.5\nevery = 0.25\nuntil = 1.0\ngrow = { nodes = 1 }\n";
    let mut repeated = built(repeated);
    let counts: Vec<usize> = (0..5).map(|_| (play(&mut repeated, 18), nodes(&repeated) - before).1).collect();
    assert_eq!(counts, [0, 1, 2, 3, 3], "after 0.3, 0.6, 0.9, 1.2 and 1.5 s; done at 0.5, 0.75 and 1 s");
    assert!(repeated.script.refusals().is_empty());
}

#[test]
fn goals_hold_until_the_next_one_and_come_before_controllers() {
    let mut built = built(
        "[[command]]\nof = 'cell'\ngoal = [30, 1000]\n[[command]]\nof = 'cell'\nat = 1.0\nrest = true\n\
         [[command]]\nof = 'cell'\nat = 4.0\ngoal = [30, -1000]\n",
    );
    let start = at(&built);
    play(&mut built, 60);
    let up = at(&built);
    assert!(up.y > start.y + 4.0 && (up.x - start.x).abs() < 1.0, "{start} to {up}");
    play(&mut built, 120);
    let slowed = at(&built);
    play(&mut built, 60);
    let rested = at(&built);
    assert!((rested - slowed).length() < 2.5, "{up}, {slowed}, {rested}");
    play(&mut built, 90);
    assert!(at(&built).y < rested.y - 4.0, "{rested} to {}", at(&built));
}

#[test]
fn a_follower_takes_its_prey_in_and_rests_then_and_digests_on_command() {
    let more = "[[command]]\nof = 'cell'\nfollow = 'prey'\n[[command]]\nof = 'cell'\nat = 8.0\ndigest = true\n\
                [[command]]\nof = 'cell'\nat = 14.0\nfollow = 'prey'\n\
                [invariants]\nleaks = 0\nimproper_absorptions = 0\ningested = [0, 1]\n\
                [[expect]]\nmeasure = 'ingested'\nby = 7.0\nmin = 1\n[[expect]]\nmeasure = 'consumed'\nby = 12.0\nmin = 1\n";
    // Large enough for a cup around this prey.
    let mut built = built_with(&[("amoeboid_cell.c.radii".to_owned(), "[11.0, 11.0]".to_owned())], more);
    assert_eq!(play(&mut built, 7 * 60), None);
    let there = at(&built);
    for k in 0..6 {
        eprintln!("DBG {k} {} {:?} meals", at(&built), built.world.events());
        play(&mut built, 10);
    }
    // It glides on: only its membrane feels the drag.
    assert!((at(&built) - there).length() < 1.0);
    assert_eq!(play(&mut built, 7 * 60), None);
    assert!(built.script.refusals().is_empty(), "nobody is left to follow, but the cell is there to be told");
}

#[test]
fn what_is_no_longer_there_cannot_be_told_anything() {
    let more = "[[command]]\nof = 'cell'\nevery = 0.1\nuntil = 5.0\ngoal = [90, 30]\n";
    let mut built = built(more);
    play(&mut built, 60);
    let lost = cell(&built);
    built.world.remove(lost).unwrap();
    play(&mut built, 60);
    let [refusal] = built.script.refusals() else { panic!("{:?}", built.script.refusals()) };
    assert_eq!((refusal.command.as_str(), refusal.step), ("command.0", 60));
}

#[test]
fn invariants_are_ranges_of_measures_and_counts() {
    let broken = |more: &str, steps| play(&mut built(more), steps).map(|violation| violation.to_string());
    assert_eq!(broken("[invariants]\nleaks = 0\norganisms = [2, 2]\nspeed_kept_mean = [-1, 2]\n", 30), None);
    let after_first = "organisms is 2 after step 1 (0.02 s), accepted: 3 to 4";
    assert_eq!(broken("[invariants]\norganisms = [3, 4]\n", 5).as_deref(), Some(after_first));
    let follow = "[[command]]\nof = 'cell'\nfollow = 'prey'\n[invariants]\ncontact_began = 0\n";
    let contact = broken(follow, 400).unwrap();
    assert!(contact.starts_with("contact_began is 1 after step "), "{contact}");
    let violation = play(&mut built("[[expect]]\nmeasure = 'ingested'\nby = 0.5\nmin = 1\n"), 60).unwrap();
    assert_eq!((violation.measure, violation.step, violation.accepted), ("ingested", 30, [1.0, f64::INFINITY]));
}

fn contact(organism: OrganismId, partner: Collider) -> ContactPoint {
    ContactPoint {
        organism,
        partner,
        node: 0,
        partner_node: None,
        point: Vec2::ZERO,
        normal: Vec2::X,
        speed: 1.0,
        impulse: 1.0,
    }
}

fn every_kind_of_event(id: OrganismId, joint: JointId, obstacle: ObstacleId) -> [Event; 25] {
    let (kind, reason) = (Kind::Agar, Refusal::Dividing);
    let collider = Collider::Obstacle(obstacle);
    [
        Event::ContactBegan { a: id, b: id },
        Event::ContactEnded { a: id, b: id },
        Event::FrontSwitched { organism: id },
        Event::IngestionBegan { engulfer: id, prey: id },
        Event::Ingested { engulfer: id, prey: id },
        Event::Released { engulfer: id, prey: id },
        Event::Consumed { engulfer: id, prey: id, kind },
        Event::DivisionBegan { organism: id },
        Event::DivisionRefused { organism: id, reason },
        Event::DivisionAbandoned { organism: id, reason },
        Event::Divided { parent: id, daughter: id },
        Event::FusionRefused { organism: id, with: id, reason },
        Event::Fused { into: id, from: id },
        Event::JointBroken { joint, between: [Some(id), None] },
        Event::JointEnded { joint, between: [Some(id), None] },
        Event::Quarantined { organism: id },
        Event::ObstacleBlocked { obstacle },
        Event::SensorEntered { sensor: obstacle, organism: id, particle: None },
        Event::SensorLeft { sensor: obstacle, organism: id, particle: None },
        Event::TouchBegan { organism: id, collider },
        Event::TouchEnded { organism: id, collider },
        Event::Hit { contact: contact(id, collider) },
        Event::Emitted { emitter: an_emitter(), organism: id },
        Event::Drained { outlet: Outlet::Side(Wall::Top), organism: id, kind, particles: 1 },
        Event::LinkTorn { organism: id, nodes: [0, 1] },
    ]
}

#[test]
fn every_kind_of_event_has_its_name_in_the_list() {
    let mut run = built("");
    let id = cell(&run);
    let ends = [JointEnd::Centre(id), JointEnd::Point(Vec2::ZERO)];
    let joint = run.world.add_joint(JointSpec::new(ends[0], ends[1], JointKind::Weld)).unwrap();
    let ball = Obstacle::new(SharedShape::ball(1.0), Pose::IDENTITY);
    let obstacle = World::new(WorldConfig::default()).unwrap().add_obstacle(ball).unwrap();
    assert_eq!(every_kind_of_event(id, joint, obstacle).map(|event| event.name()), Event::NAMES);
}

fn an_emitter() -> EmitterId {
    let recipe = Recipe::Organism(AgarSpec::default().into());
    World::new(WorldConfig::default()).unwrap().add_emitter(Emitter::new(Region::All, recipe, 1.0)).unwrap()
}

/// Plays a built-in scenario for so many seconds with each of some seeds and expects nothing to break.
fn assert_keeps_its_checks(name: &str, seconds: u32, seeds: std::ops::Range<u64>) {
    let mut scenario = Scenario::parse(builtin(name).unwrap().text, &[]).unwrap();
    for seed in seeds {
        scenario.set_seed(seed);
        let mut built = scenario.build().unwrap_or_else(|errors| panic!("{name}, seed {seed}: {errors}"));
        let broken = play(&mut built, seconds * 60);
        assert!(broken.is_none(), "{name}, seed {seed}: {}", broken.unwrap());
        assert!(built.script.refusals().is_empty(), "{name}, seed {seed}: {:?}", built.script.refusals());
    }
}

#[test]
fn prey_is_absorbed_from_any_direction_among_platelets() {
    assert_keeps_its_checks("absorb-agar", 15, 0..3);
    assert_keeps_its_checks("absorb-rigid", 15, 0..3);
}

#[test]
fn a_cell_grows_by_what_it_digests() {
    let mut scenario = Scenario::parse(builtin("grow").unwrap().text, &[]).unwrap();
    scenario.set_seed(3);
    let mut built = scenario.build().unwrap();
    let cytoplasm = |built: &Built| built.world.view().organism(cell(built)).unwrap().particles().count();
    let before = cytoplasm(&built);
    assert_eq!(play(&mut built, 40 * 60), None);
    assert!(cytoplasm(&built) > before + 15, "{before} to {}", cytoplasm(&built));
}

#[test]
fn a_cell_gets_through_a_gap_of_half_its_diameter() {
    assert_keeps_its_checks("squeeze", 25, 0..1);
}

#[test]
fn a_cell_divides_its_halves_are_told_apart_and_fuse() {
    assert_keeps_its_checks("divide", 32, 0..2);
}

#[test]
fn without_protection_the_stress_of_leaks_leaks() {
    // Bursts of the scenario's own size do not open every membrane within five seconds.
    let unprotected = [("world.protects_membranes", "false"), ("growth", "48")];
    let unprotected = unprotected.map(|(name, value)| (name.to_owned(), value.to_owned()));
    let mut scenario = Scenario::parse(builtin("leak-stress").unwrap().text, &unprotected).unwrap();
    for seed in 0..3 {
        scenario.set_seed(seed);
        let mut built = scenario.build().unwrap();
        assert!(play(&mut built, 300).is_some(), "seed {seed}: the scenario fails");
        assert!(built.world.census().leaks > 0, "seed {seed}: because it leaks");
    }
}

#[test]
fn the_stress_scenarios_hold_for_a_while() {
    assert_keeps_its_checks("leak-stress", 10, 0..1);
    assert_keeps_its_checks("ram-stress", 10, 0..1);
}
