//! Each kind of damage is found, and named.

use crate::capability::crawl::Pseudopods;
use crate::capability::division::{Divider, Order};
use crate::particle::sleep::Sleep;
use crate::world::joint::JointRecord;
use crate::world::supply::EmitterRecord;
use crate::{
    AgarSpec, AmoeboidCellSpec, Chemical, ChemicalId, ChemicalSpec, CoccusSpec, Crawl, Distance, Drain, Emitter,
    Exchange, FieldKind, FluidBlockSpec, ForceField, Half, Inputs, JointEnd, JointKind, JointSpec, Node, Placement,
    PlateletSpec, Recipe, Region, Template, World, WorldConfig, YieldingDistance, glam::Vec2,
};

/// One of each storage: a membrane with cytoplasm, two lanes of blocks, free fluid, a chemical.
fn room() -> World {
    let mut world = World::new(WorldConfig::default()).unwrap();
    world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 45.0)).unwrap();
    world.spawn(&PlateletSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
    world.spawn(&AgarSpec::default().into(), Placement::at(100.0, 45.0)).unwrap();
    world.add_chemical(ChemicalSpec { initial: 1.0, ..ChemicalSpec::default() }).unwrap();
    world.spawn(&FluidBlockSpec::default().into(), Placement::at(130.0, 45.0)).unwrap();
    (0..3).for_each(|_| world.step(&Inputs::new()));
    world
}

#[test]
fn a_sound_world_is_sound() {
    assert_eq!(room().validate(), Ok(()));
    assert_eq!(World::new(WorldConfig::default()).unwrap().validate(), Ok(()));
}

/// Damages a sound world and expects these words in what validation says.
fn finds(damage: impl Fn(&mut World), words: &str) {
    let mut world = room();
    damage(&mut world);
    let violation = world.validate().expect_err(words).to_string();
    assert!(violation.contains(words), "`{violation}` instead of `{words}`");
}

#[test]
fn damage_to_the_store_is_found() {
    finds(|w| w.config.dt = f32::NAN, "`dt` is NaN");
    finds(|w| w.config.substeps = 1, "with amoeboid cells: substeps of");
    finds(|w| w.particles.x.truncate(3), "column");
    finds(|w| w.particles.x[0] = f32::NAN, "amoeboid_cell 0 (generation 0): particle 0: x is NaN");
    finds(|w| w.particles.vy[3] = f32::INFINITY, "velocity y is inf");
    finds(|w| w.particles.prev_x[3] = 1e9, "previous x");
    finds(|w| w.particles.origin_x[3] += 0.001, "must be a multiple of 0.00390625");
    finds(|w| w.particles.radius[2] = -1.0, "radius is -1");
    finds(|w| w.particles.inv_mass[2] = f32::NAN, "inverse mass");
    finds(|w| w.particles.inv_mass[2] = 1e-38, "inverse mass");
    finds(|w| w.particles.role[2] = 200, "role 200");
    finds(|w| w.particles.fluid[2] = 9, "fluid 9");
    finds(|w| w.particles.x[2] -= 80.0, "outside the room");
    finds(|w| w.particles.owner[2] = 77, "its owner is 77");
    finds(|w| _ = w.particles.extend(1), "neither in use nor free");
    finds(|w| w.blocks[0].owner[1] = 1, "lane 1 of block 0");
    finds(|w| w.blocks[0].template = 9, "template 9");
    finds(|w| w.blocks[0].base = 1 << 20, "block 0 lies");
    finds(|w| w.blocks[0].scale[0] = 0.0, "scale of lane 0");
    finds(|w| w.sleep = Sleep::default(), "2 blocks, but sleep counters of 0");
    finds(|w| _ = w.fluids[0].particles.pop(), "fluid 0 has Some");
    finds(|w| w.fluids[0].params.spacing = 0.0, "spacing");
    finds(|w| w.obstacles.push(crate::world::obstacle::nothing()), "places for");
}

#[test]
fn damage_to_pseudopods_is_found() {
    let finds = |damage: fn(&mut Pseudopods), words: &str| {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let spec = AmoeboidCellSpec { crawl: Crawl::Neutrophil, ..AmoeboidCellSpec::default() };
        let cell = world.spawn(&spec.into(), Placement::at(80.0, 45.0)).unwrap();
        assert_eq!(world.validate(), Ok(()));
        damage(world.organisms.get_mut(cell).unwrap().locomotion.pseudopods_mut().unwrap());
        let violation = world.validate().expect_err(words).to_string();
        assert!(violation.contains(words), "`{violation}` instead of `{words}`");
    };
    finds(|it| it.network.reset(5), "it cannot move so");
    finds(|it| it.front_centre = Some(500), "it cannot move so");
    finds(|it| it.push = Vec2::splat(2.0), "it cannot move so");
    finds(|it| it.side = 0.5, "it cannot move so");
    finds(|it| it.params.life = f32::NAN, "`pseudopods.life`");
}

#[test]
fn damage_to_chemicals_is_found() {
    finds(|w| w.chemicals[0].add(Vec2::ZERO, f32::NAN), "chemical 0: the concentration in cell 0 is NaN");
    finds(|w| w.chemicals[0].add(Vec2::ZERO, -50.0), "chemical 0: the concentration in cell 0 is -");
    let narrow = WorldConfig { size: Vec2::splat(40.0), ..WorldConfig::default() };
    finds(
        |w| w.chemicals[0] = Chemical::new(ChemicalSpec::default(), &narrow).unwrap(),
        "chemical 0: 400 concentrations do not fill",
    );
    finds(
        |w| {
            let id = w.organisms().next().unwrap();
            let unknown = Exchange { chemical: ChemicalId(7), secretion: 1.0, uptake: 0.0 };
            w.organisms.get_mut(id).unwrap().exchanges.push(unknown);
        },
        "`exchanges.chemical`",
    );
}

#[test]
fn damage_to_organisms_is_found() {
    finds(
        |w| {
            let platelet = w.organisms().nth(1).unwrap();
            w.organisms.get_mut(platelet).unwrap().fluid = Some(0);
        },
        "a body in lanes has fluid",
    );
    let cell = |w: &World| w.organisms().next().unwrap();
    let organism = |w: &mut World, change: &dyn Fn(&mut crate::organism::Organism)| {
        let id = cell(w);
        change(w.organisms.get_mut(id).unwrap());
    };
    finds(|w| organism(w, &|o| o.outline.swap(0, 1)), "follows it in its ring");
    finds(|w| organism(w, &|o| _ = o.outline.pop()), "nodes, of which its rings have");
    finds(|w| organism(w, &|o| o.fluid = Some(7)), "fluid");
    finds(|w| organism(w, &|o| o.speed = f32::NAN), "speed is NaN");
    finds(|w| organism(w, &|o| o.rng.increment = 8), "random numbers is even");
    finds(|w| organism(w, &|o| o.goal = Some(Vec2::NAN)), "goal");
    finds(|w| organism(w, &|o| o.is_quarantined = true), "not frozen");
    finds(|w| organism(w, &|o| o.divider.as_mut().unwrap().lobes = 9.0), "lobes is 9");
    finds(|w| w.particles.next_in_ring[0] = 5, "linked to another");
    finds(|w| w.exemptions.set(0, 9, true), "0 and 9 are exempt");
    finds(|w| w.exemptions.open_gate(&[1], 2), "gates open for");
}

#[test]
fn damage_to_joints_is_found() {
    let joint = |w: &mut World, change: &dyn Fn(&mut JointRecord)| {
        let organism = w.organisms().next().unwrap();
        let ends = [JointEnd::Node { organism, node: 0 }, JointEnd::Point(Vec2::ZERO)];
        let id = w.add_joint(JointSpec::new(ends[0], ends[1], JointKind::Weld)).unwrap();
        change(w.joints.get_mut(id.handle()).unwrap());
    };
    finds(|w| joint(w, &|joint| joint.length = f32::NAN), "length of joint 0 is NaN");
    finds(|w| joint(w, &|joint| joint.particles[0] = Some(1 << 20)), "joint 0 holds a particle");
    finds(|w| joint(w, &|joint| joint.particles[1] = Some(0)), "joint 0 holds a particle");
    finds(|w| joint(w, &|joint| joint.spec.break_force = -1.0), "joints[0]: `break_force`");
}

#[test]
fn damage_to_fields_emitters_and_drains_is_found() {
    let wind = |acceleration| ForceField { region: Region::All, kind: FieldKind::Uniform { acceleration } };
    finds(
        |w| {
            let id = w.add_field(wind(Vec2::ZERO)).unwrap();
            **w.fields.get_mut(id.handle()).unwrap() = wind(Vec2::NAN);
        },
        "fields[0]: `kind.acceleration.x`",
    );
    let emitter = Emitter::new(Region::All, Recipe::Organism(CoccusSpec::default().into()), 1.0);
    let emitting = |w: &mut World, change: &dyn Fn(&mut EmitterRecord)| {
        let id = w.add_emitter(emitter.clone()).unwrap();
        change(w.emitters.get_mut(id.handle()).unwrap());
    };
    finds(|w| emitting(w, &|it| it.emitter.rate = -1.0), "emitters[0]: `rate`");
    finds(|w| emitting(w, &|it| it.owed = f32::NAN), "debt of emitter 0 is NaN");
    finds(|w| emitting(w, &|it| it.rng.increment = 0), "emitter 0's random numbers is even");
    finds(
        |w| {
            let id = w.add_drain(Drain { region: Region::All, kind: None }).unwrap();
            w.drains.get_mut(id.handle()).unwrap().region = Region::Circle { centre: Vec2::NAN, radius: 1.0 };
        },
        "drains[0]: `region.centre.x`",
    );
}

#[test]
fn damage_to_muscles_and_gravity_scales_is_found() {
    finds(|w| w.blocks[0].length_state.push([1.0; 8]), "has not the channels and links of its template");
    finds(
        |w| {
            let id = w.organisms().next().unwrap();
            w.organisms.get_mut(id).unwrap().gravity_scale = f32::NAN;
        },
        "gravity scale is NaN",
    );
}

#[test]
fn damage_to_plastic_strains_is_found() {
    let mut builder = Template::builder();
    [0.0, 2.0].into_iter().for_each(|x| _ = builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
    let spring = Distance { a: 0, b: 1, rest_length: 2.0, compliance: 1e-3, damping: 0.0 };
    builder.constraint(YieldingDistance { max_plastic_strain: 0.5, ..spring.into() });
    let mut world = World::new(WorldConfig::default()).unwrap();
    let template = world.add_template(builder.build().unwrap());
    world.spawn_template(template, Placement::at(40.0, 45.0)).unwrap();
    for (plastic, is_sound) in [(0.5, true), (-0.5, true), (-1.0, true), (0.6, false), (-0.6, false), (f32::NAN, false)]
    {
        world.blocks[0].length_state[0][0] = plastic;
        let violation = world.validate().err().map(|it| it.to_string()).unwrap_or_default();
        assert_eq!(violation.is_empty(), is_sound, "{plastic}: {violation}");
        assert!(is_sound || violation.contains("plastic strain"), "{violation}");
    }
}

#[test]
fn damage_to_dampings_and_kinds_is_found() {
    let first = |w: &mut World, change: fn(&mut crate::organism::Organism)| {
        let id = w.organisms().next().unwrap();
        change(w.organisms.get_mut(id).unwrap());
    };
    finds(|w| first(w, |it| it.linear_damping = f32::NAN), "`linear_damping` is NaN");
    finds(|w| first(w, |it| it.angular_damping = 99.0), "`angular_damping` is 99");
    let of_no_template = crate::Kind::try_from(256 * 70 + 6).unwrap();
    let id = room().organisms().next().unwrap();
    finds(|w| w.organisms.get_mut(id).unwrap().kind = of_no_template, "it has not template 70");
}

#[test]
fn damage_to_bodies_that_divide_is_found() {
    let damaged = |change: fn(&mut Option<Divider>)| {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let mut builder = Template::builder();
        (0..2u8).for_each(|k| _ = builder.node(Node::disc(Vec2::new(f32::from(k), 0.0), 1.0, 0.4)));
        builder.cut([Half::of([0]), Half::of([1])]);
        let template = world.add_template(builder.build().unwrap());
        let id = world.spawn_template(template, Placement::at(50.0, 50.0)).unwrap();
        assert_eq!(world.validate(), Ok(()));
        change(&mut world.organisms.get_mut(id).unwrap().divider);
        world.validate().unwrap_err().to_string()
    };
    let changes: [fn(&mut Option<Divider>); 4] = [
        |divider| *divider = None,
        |divider| divider.as_mut().unwrap().lobes = 2.0,
        |divider| divider.as_mut().unwrap().wanted_nodes = Some(9),
        |divider| divider.as_mut().unwrap().order = Some(Order::Divide { axis: Some(Vec2::X) }),
    ];
    for change in changes {
        let found = damaged(change);
        assert!(found.contains("it does not divide as its template says"), "{found}");
    }
}

#[test]
fn tangled_and_leaking_membranes_are_found() {
    let move_node = |w: &mut World, k: usize, by: f32| {
        let id = w.organisms().next().unwrap();
        let node = w.organisms.get(id).unwrap().outline[k] as usize;
        w.particles.x[node] += by;
    };
    // Node 0 is at the right end: far to the left it crosses the other side.
    finds(|w| move_node(w, 0, -30.0), "crosses itself");
    finds(
        |w| {
            let id = w.organisms().next().unwrap();
            let drop_of = w.organisms.get(id).unwrap().fluid_particles[5] as usize;
            w.particles.x[drop_of] += 12.0;
        },
        "has leaked out of its membrane",
    );
}

#[test]
fn a_violation_names_organism_and_particle() {
    let mut world = room();
    world.particles.vx[4] = f32::NAN;
    let violation = world.validate().unwrap_err();
    assert_eq!((violation.organism(), violation.particle()), (world.organisms().next(), Some(4)));
}
