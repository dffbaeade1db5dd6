//! Reports of contacts: points, begin and end with obstacles and walls, hits.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::run;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Collider, ContactPoint, ContactReporting, Event, Inputs, Node, Obstacle, OrganismId,
    Placement, PlateletSpec, Template, Wall, World, WorldConfig,
};

fn room(gravity: f32, hit_speed: f32) -> World {
    let config = WorldConfig { gravity: Vec2::new(0.0, gravity), damping: 0.0, ..WorldConfig::default() };
    let mut world = World::new(config).unwrap();
    world.set_contact_reporting(Some(ContactReporting { hit_speed: Some(hit_speed) })).unwrap();
    world
}

/// A disc of radius 1 and mass 2.
fn ball(world: &mut World, x: f32, y: f32, restitution: f32) -> OrganismId {
    let mut builder = Template::builder();
    let node = Node::disc(Vec2::ZERO, 2.0, 1.0);
    builder.node(Node { material: microsim_core::Material { restitution, friction: 0.0 }, ..node });
    let template = world.add_template(builder.build().unwrap());
    world.spawn_template(template, Placement::at(x, y)).unwrap()
}

fn step(world: &mut World) -> Vec<Event> {
    world.step(&Inputs::new());
    world.events().to_vec()
}

fn hits(events: &[Event]) -> Vec<ContactPoint> {
    events.iter().filter_map(|event| if let Event::Hit { contact } = event { Some(*contact) } else { None }).collect()
}

#[test]
fn a_ball_that_falls_on_the_floor_hits_it_once_with_its_momentum() {
    for restitution in [0.0, 0.5] {
        let mut world = room(-10.0, 6.0);
        let id = ball(&mut world, 50.0, 6.0, restitution);
        let floor = Collider::Wall(Wall::Bottom);
        let (mut hit, mut began, mut ended, mut impulse) = (Vec::new(), 0, 0, 0.0);
        for _ in 0..70 {
            let events = step(&mut world);
            hit.extend(hits(&events));
            impulse += world.contacts_of(id).map(|contact| contact.impulse).sum::<f32>();
            began += events.iter().filter(|e| **e == Event::TouchBegan { organism: id, collider: floor }).count();
            ended += events.iter().filter(|e| **e == Event::TouchEnded { organism: id, collider: floor }).count();
        }
        let [hit] = hit[..] else { panic!("{hit:?}") };
        assert_eq!((hit.organism, hit.partner, hit.partner_node), (id, floor, None));
        assert!((hit.speed - 10.0).abs() < 0.2 && (hit.normal - Vec2::Y).length() < 1e-5, "{hit:?}");
        // The rest of the time it lies on the floor: all of gravity has been taken up.
        let momentum = 2.0 * 10.0 * 70.0 / 60.0;
        let rising = 2.0 * world.view().organism(id).unwrap().particles().next().unwrap().velocity.y;
        assert!((impulse - momentum - rising).abs() < 0.2, "{restitution}: {impulse}");
        assert!((hit.point - Vec2::new(50.0, 0.0)).length() < 0.1, "{}", hit.point);
        assert_eq!((began, ended), (1, usize::from(restitution > 0.0)));
    }
}

#[test]
fn a_body_at_rest_presses_with_its_weight() {
    let mut world = room(-10.0, 5.0);
    let id = ball(&mut world, 50.0, 1.0, 0.0);
    let shelf = Obstacle::new(SharedShape::cuboid(5.0, 1.0), Pose::translation(80.0, 20.0));
    let shelf = world.add_obstacle(shelf).unwrap();
    let other = ball(&mut world, 80.0, 22.0, 0.0);
    for _ in 0..20 {
        step(&mut world);
        for (ball, on) in [(id, Collider::Wall(Wall::Bottom)), (other, Collider::Obstacle(shelf))] {
            let contacts: Vec<_> = world.contacts_of(ball).collect();
            let [contact] = contacts[..] else { panic!("{contacts:?}") };
            assert_eq!(contact.partner, on);
            assert!((contact.impulse - 2.0 * 10.0 / 60.0).abs() < 0.05, "{}", contact.impulse);
        }
    }
    world.remove_obstacle(shelf).unwrap();
    let ended = Event::TouchEnded { organism: other, collider: Collider::Obstacle(shelf) };
    assert!(step(&mut world).contains(&ended) && !step(&mut world).contains(&ended));
}

#[test]
fn both_sides_of_a_contact_feel_the_same() {
    let mut world = room(0.0, 1.0);
    let [a, b] = [40.0, 44.0].map(|x| ball(&mut world, x, 40.0, 0.0));
    world.push(b, Vec2::new(-6.0, 0.0)).unwrap();
    let hit = (0..60).find_map(|_| hits(&step(&mut world)).first().copied()).unwrap();
    let after = |world: &mut World| (step(world), world.contacts_of(a).map(|contact| contact.impulse).sum::<f32>()).1;
    let mut later = world.clone();
    assert!((hit.speed - 6.0).abs() < 0.1 && (hit.impulse + after(&mut later) - 6.0).abs() < 0.2, "{hit:?}");
    assert!(hits(later.events()).is_empty(), "a hit is reported once");
    let (felt, other) = (world.contacts_of(a).next().unwrap(), world.contacts_of(b).next().unwrap());
    assert_eq!((felt.organism, felt.partner), (a, Collider::Organism(b)));
    assert_eq!((other.organism, other.partner), (b, Collider::Organism(a)));
    assert_eq!((felt.node, felt.normal, felt.impulse), (other.partner_node.unwrap(), -other.normal, other.impulse));
    assert!(felt.normal.x < -0.99, "from the partner to the organism: {}", felt.normal);
}

#[test]
fn a_membrane_reports_what_touches_it() {
    let mut world = room(0.0, 1.0);
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 45.0)).unwrap();
    let disc = world.spawn(&AgarSpec::default().into(), Placement::at(90.0, 45.0)).unwrap();
    world.push(disc, Vec2::new(-15.0, 0.0)).unwrap();
    let hit = (0..200).find_map(|_| hits(&step(&mut world)).first().copied()).unwrap();
    assert_eq!((hit.organism, hit.partner), (cell, Collider::Organism(disc)));
    assert!(hit.speed > 10.0 && hit.impulse > 0.0 && world.contacts_of(disc).count() > 0);
}

#[test]
fn what_falls_asleep_on_a_shelf_touches_it_until_it_goes() {
    let mut world = room(-10.0, 5.0);
    let shelf = Obstacle::new(SharedShape::cuboid(5.0, 1.0), Pose::translation(80.0, 20.0));
    let shelf = world.add_obstacle(shelf).unwrap();
    let id = ball(&mut world, 80.0, 22.0, 0.0);
    let (mut began, mut ended) = (0, 0);
    let mut watch = |world: &mut World, steps: u32| {
        for _ in 0..steps {
            let events = step(world);
            began += events.iter().filter(|event| matches!(event, Event::TouchBegan { .. })).count();
            ended += events.iter().filter(|event| matches!(event, Event::TouchEnded { .. })).count();
        }
        (began, ended)
    };
    assert_eq!(watch(&mut world, 200), (1, 0));
    assert!(world.contacts_of(id).next().is_none(), "it sleeps");
    world.set_obstacle_enabled(shelf, false).unwrap();
    assert_eq!(watch(&mut world, 10), (1, 1));
}

#[test]
fn reports_change_nothing_but_what_is_reported() {
    let fill = |is_on: bool| {
        let mut world = room(-10.0, 5.0);
        if !is_on {
            world.set_contact_reporting(None).unwrap();
        }
        for k in 0..20 {
            let at = Placement::at(20.0 + 6.0 * k as f32, 20.0 + (k % 3) as f32);
            world.spawn(&PlateletSpec::default().into(), at).unwrap();
            ball(&mut world, 20.0 + 6.0 * k as f32, 27.0, 0.3);
        }
        let seen = (0..120).map(|_| (step(&mut world), world.contacts().len()).1).sum::<usize>();
        (world, seen)
    };
    let ((on, seen), (off, unseen)) = (fill(true), fill(false));
    let places = |world: &World| world.organisms().map(|id| world.centroid(id).unwrap()).collect::<Vec<_>>();
    assert_eq!(places(&on), places(&off));
    assert!(seen > 300 && unseen == 0, "{seen} {unseen}");
    let clone = on.clone();
    assert_eq!((clone.contacts(), clone.digest()), (on.contacts(), on.digest()));
}

#[cfg(feature = "snapshot")]
#[test]
fn a_snapshot_keeps_the_contacts_of_the_last_step() {
    let mut world = room(-10.0, 5.0);
    ball(&mut world, 50.0, 1.0, 0.0);
    run(&mut world, &Inputs::new(), 5);
    let mut read = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
    assert_eq!((read.contacts(), read.contact_reporting()), (world.contacts(), world.contact_reporting()));
    [&mut read, &mut world].into_iter().for_each(|world| world.step(&Inputs::new()));
    assert_eq!(read.first_difference(&world), None);
}
