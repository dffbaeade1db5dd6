//! Bodies of very different masses: momentum is kept, and light bodies hold together.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]

mod common;

use common::{room_with, run};
use microsim_core::glam::Vec2;
use microsim_core::{
    AmoeboidCellSpec, Controller, Inputs, Material, Node, OrganismId, Placement, PlateletSpec, ProbeSpec, RedCellSpec,
    Template, World, WorldConfig,
};

fn space() -> World {
    World::new(WorldConfig { damping: 0.0, gravity: Vec2::ZERO, sleeps: false, ..WorldConfig::default() }).unwrap()
}

fn disc(world: &mut World, mass: f32, restitution: f32, at: Vec2) -> OrganismId {
    let mut builder = Template::builder();
    builder.node(Node { material: Material { friction: 0.3, restitution }, ..Node::disc(Vec2::ZERO, mass, 1.0) });
    let template = world.add_template(builder.build().unwrap());
    world.spawn_template(template, Placement::at(at.x, at.y)).unwrap()
}

fn velocity(world: &World, id: OrganismId) -> Vec2 {
    world.view().organism(id).unwrap().particles().next().unwrap().velocity
}

#[test]
fn an_impact_keeps_momentum_at_every_ratio_of_masses() {
    for mass in [1.0, 10.0, 100.0, 1e3, 1e4] {
        for (restitution, aside) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.2), (1.0, 1.2)] {
            for (heavy_speed, light_speed) in [(6.0, 0.0), (0.0, -6.0), (3.0, -3.0)] {
                let mut world = space();
                let heavy = disc(&mut world, mass, restitution, Vec2::new(60.0, 45.0));
                let light = disc(&mut world, 1.0, restitution, Vec2::new(63.0, 45.0 + aside));
                world.push(heavy, Vec2::new(heavy_speed, 0.0)).unwrap();
                world.push(light, Vec2::new(light_speed, 0.0)).unwrap();
                let scale = mass * heavy_speed.abs() + light_speed.abs();
                let before = Vec2::new(mass * heavy_speed + light_speed, 0.0);
                run(&mut world, &Inputs::new(), 60);
                let after = velocity(&world, heavy) * mass + velocity(&world, light);
                let what =
                    format!("ratio {mass}, restitution {restitution}, aside {aside}, {heavy_speed} on {light_speed}");
                assert!((after - before).length() < 0.01 * scale, "{what}: {after} from {before}");
                assert!((velocity(&world, light).x - light_speed).abs() > 0.1, "{what}: they have met");
            }
        }
    }
}

#[test]
fn an_impact_on_linked_discs_keeps_momentum() {
    for substeps in [4, 8] {
        for mass in [1.0, 10.0, 29.0, 240.0, 1e3] {
            let config =
                WorldConfig { damping: 0.0, gravity: Vec2::ZERO, sleeps: false, substeps, ..WorldConfig::default() };
            let mut world = World::new(config).unwrap();
            let striker = disc(&mut world, mass, 0.0, Vec2::new(40.0, 45.6));
            let struck = world.spawn(&RedCellSpec::default().into(), Placement::at(46.0, 45.0)).unwrap();
            world.push(striker, Vec2::new(10.0, 0.0)).unwrap();
            let mut stretch: f32 = 0.0;
            for _ in 0..120 {
                run(&mut world, &Inputs::new(), 1);
                stretch = stretch.max(world.quality().edge_stretch_max);
            }
            let momentum = |id| {
                let view = world.view().organism(id).unwrap();
                view.velocity() * view.mass()
            };
            let kept = (momentum(striker) + momentum(struck)) / (10.0 * mass);
            assert!(momentum(struck).x > 1.0, "they have met");
            assert!((kept - Vec2::X).length() < 2e-3, "{substeps} substeps, mass {mass}: {kept}");
            assert!(stretch < 0.1, "{substeps} substeps, mass {mass}: stretch {stretch}");
        }
    }
}

/// The speed limit takes no momentum from a cell that becomes round in a hurry.
#[test]
fn a_cell_that_nothing_drives_stays_where_it_is() {
    for (radii, node_radius) in [((10.0, 5.2), 0.78), ((20.0, 6.0), 0.78), ((14.0, 14.0), 2.0), ((30.0, 30.0), 4.0)] {
        let spec = AmoeboidCellSpec { radii: Vec2::from(radii), node_radius, ..AmoeboidCellSpec::default() };
        let (mut world, cell) = room_with(spec, 80.0, 45.0);
        let centre = |world: &World| world.view().organism(cell).unwrap().centre_of_mass();
        let before = centre(&world);
        run(&mut world, &Inputs::new(), 600);
        let way = centre(&world).distance(before);
        assert!(way < 0.1, "{radii:?}, nodes of {node_radius}: {way}");
    }
}

#[test]
fn links_hold_under_a_probe_of_any_mass() {
    for mass in [30.0, 240.0, 2000.0] {
        let mut world = World::new(WorldConfig { sleeps: false, ..WorldConfig::default() }).unwrap();
        for k in 0..12u8 {
            let (column, row) = (f32::from(k % 4), f32::from(k / 4));
            world
                .spawn(&PlateletSpec::default().into(), Placement::at(130.0 + 8.0 * column, 37.0 + 8.0 * row))
                .unwrap();
        }
        let ram = Controller::patrol(vec![Vec2::new(150.0, 45.0)], false);
        let probe = ProbeSpec { mass, radius: 4.0, speed: 8.0, max_acceleration: 400.0 };
        world.spawn(&probe.into(), Placement::at(110.0, 45.0).steered_by(ram)).unwrap();
        let mut stretch: f32 = 0.0;
        for _ in 0..240 {
            run(&mut world, &Inputs::new(), 1);
            let edge = world.quality().edge_stretch_max;
            stretch = if edge > stretch { edge } else { stretch };
        }
        println!("mass {mass}: stretch {stretch}");
        assert!(stretch > 0.001 && stretch < 0.06, "mass {mass}: stretch {stretch}");
    }
}
