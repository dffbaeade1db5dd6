//! Tests with damaged and forged snapshots.

use super::*;
use crate::{
    AccelerationGrid, AgarSpec, AmoeboidCellSpec, ChemicalSpec, CoccusSpec, Controller, Event, FieldKind,
    FluidBlockSpec, ForceField, Inputs, Intent, OrganismSpec, Placement, PlateletSpec, ProbeSpec, RedCellSpec, Region,
    RigidCellSpec, WorldConfig,
};
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;
use proptest::prelude::*;

fn specs() -> [OrganismSpec; 7] {
    [
        AgarSpec { radius: 0.8, ..AgarSpec::default() }.into(),
        RigidCellSpec { radii: Vec2::new(4.0, 2.5), ..RigidCellSpec::default() }.into(),
        ProbeSpec { radius: 1.5, ..ProbeSpec::default() }.into(),
        CoccusSpec::default().into(),
        PlateletSpec { radius: 2.0, ..PlateletSpec::default() }.into(),
        RedCellSpec { radius: 2.5, ..RedCellSpec::default() }.into(),
        FluidBlockSpec { size: Vec2::new(4.0, 3.0), ..FluidBlockSpec::default() }.into(),
    ]
}

/// Spawns one of each in two rows; what can move has a controller.
fn spawn_in_rows(world: &mut World, specs: &[OrganismSpec]) {
    let controllers = [
        Controller::wander([0.1, 0.2], 0.3),
        Controller::patrol(vec![Vec2::new(9.0, 9.0), Vec2::new(60.0, 40.0)], true),
        Controller::thrash(0.2, 0.5),
        Controller::ram(0.3, 0.3, 12.0),
    ];
    for (k, spec) in specs.iter().enumerate() {
        let controller = controllers[k % 4].clone();
        let at = Placement::at(8.0 + 9.0 * k as f32, if k % 2 == 0 { 40.0 } else { 12.0 });
        let at = if spec.can_move() { at.steered_by(controller) } else { at };
        world.spawn(spec, at).unwrap();
    }
}

/// A small world with all kinds of organisms and obstacles, after some steps.
fn menagerie() -> World {
    let mut world =
        World::new(WorldConfig { size: Vec2::new(80.0, 50.0), substeps: 6, ..WorldConfig::default() }).unwrap();
    let corners = vec![Vec2::ZERO, Vec2::new(3.0, 0.0), Vec2::new(0.0, 3.0)];
    for (k, shape) in shapes(corners).into_iter().enumerate() {
        let pose = Pose::new(Vec2::new(6.0 + 8.0 * k as f32, 3.0), 0.3);
        world.add_obstacle(Obstacle::new(shape, pose)).unwrap();
    }
    world.add_chemical(ChemicalSpec { initial: 0.5, spacing: 4.0, ..ChemicalSpec::default() }).unwrap();
    let cell = AmoeboidCellSpec { radii: Vec2::new(6.0, 6.0), ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&cell.into(), Placement::at(40.0, 25.0)).unwrap();
    let specs = specs();
    spawn_in_rows(&mut world, &specs);
    let prey = world.spawn(&specs[0], Placement::at(48.0, 25.0)).unwrap();
    let gone = world.spawn(&specs[4], Placement::at(70.0, 25.0)).unwrap();
    world.set_exempt(gone, prey, true).unwrap();
    world.set_exempt(cell, gone, true).unwrap();
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(Vec2::new(79.0, 25.0)).unwrap().digesting(true));
    let began = |world: &World| world.events().iter().any(|event| matches!(event, Event::IngestionBegan { .. }));
    assert!((0..200).any(|_| (world.step(&inputs), began(&world)).1));
    world.set_exempt(cell, prey, false).unwrap();
    world.remove(gone).unwrap();
    world.divide(cell).unwrap();
    (0..10).for_each(|_| world.step(&inputs));
    world
}

/// One obstacle of every shape that can be written.
fn shapes(corners: Vec<Vec2>) -> Vec<SharedShape> {
    let [a, b, c] = [corners[0], corners[1], corners[2]];
    let simple = [
        SharedShape::ball(1.0),
        SharedShape::cuboid(1.0, 2.0),
        SharedShape::round_cuboid(1.0, 2.0, 0.2),
        SharedShape::capsule(a, b, 0.5),
        SharedShape::segment(a, b),
        SharedShape::round_triangle(a, b, c, 0.1),
        SharedShape::triangle(a, b, c),
        SharedShape::convex_polyline(corners.clone()).unwrap(),
    ];
    let parts = simple.iter().zip(0_u8..).map(|(shape, k)| (Pose::translation(k.into(), 0.0), shape.clone()));
    let compound = SharedShape::compound(parts.collect());
    let polyline = SharedShape::polyline(corners, Some(vec![[0, 1], [1, 2]]));
    simple.into_iter().chain([polyline, compound]).collect()
}

/// Together they contain nearly all state that a world can have: a test in `layout.rs` checks this.
pub(super) fn worlds() -> [World; 2] {
    [menagerie(), busy::world()]
}

fn content(world: &World) -> Vec<u8> {
    WORLD.open(&world.to_snapshot().unwrap()).unwrap().to_vec()
}

/// Restores forged content; a world that is accepted must be usable without a panic.
fn forge(content: &[u8]) -> Result<World, SnapshotError> {
    let mut world = World::from_snapshot(&WORLD.seal(content))?;
    let digest = world.digest();
    let handles: Vec<_> = world.organisms().collect();
    let mut inputs = Inputs::new();
    handles.iter().for_each(|&id| inputs.set(id, Intent::toward(Vec2::ONE).unwrap().digesting(true)));
    for _ in 0..2 {
        world.step(&inputs);
        read_back(&world);
    }
    let _ = (world.census(), world.quality(), world.view().organisms().count());
    handles.into_iter().for_each(|id| drop(world.remove(id)));
    world.step(&inputs);
    read_back(&world);
    assert_eq!(World::from_snapshot(&WORLD.seal(content)).unwrap().digest(), digest);
    World::from_snapshot(&WORLD.seal(content))
}

/// What becomes of a world that was accepted is accepted.
fn read_back(world: &World) {
    let again = World::from_snapshot(&world.to_snapshot().unwrap());
    assert_eq!(again.map(|again| again.digest()), Ok(world.digest()));
}

#[test]
fn a_forged_grid_of_accelerations_is_refused() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let grid = AccelerationGrid::sampled(Vec2::ZERO, Vec2::ONE, [2, 2], |_| Vec2::splat(7.25)).unwrap();
    world.add_field(ForceField { region: Region::All, kind: FieldKind::Grid(grid) }).unwrap();
    let honest = content(&world);
    let node = honest.windows(4).position(|bytes| bytes == 7.25_f32.to_le_bytes()).unwrap();
    forge(&honest).unwrap();
    for value in [f32::NAN, f32::INFINITY, -2e6] {
        let mut forged = honest.clone();
        forged[node..node + 4].copy_from_slice(&value.to_le_bytes());
        forge(&forged).unwrap_err();
    }
    // Columns, rows and the number of nodes lie before the nodes.
    for k in 1..=3 {
        let mut forged = honest.clone();
        forged[node - k] += 1;
        forge(&forged).unwrap_err();
    }
}

#[test]
fn all_shapes_and_all_organisms_are_restored() {
    for world in worlds() {
        let restored = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
        assert_eq!(restored.digest(), world.digest());
        assert_eq!(restored.to_snapshot(), world.to_snapshot());
        assert_eq!(restored.obstacles().count(), world.obstacles().count());
    }
}

#[test]
fn a_shape_that_is_not_known_is_refused_when_writing() {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let heights = SharedShape::heightfield(vec![1.0, 2.0, 1.0], Vec2::splat(9.0));
    world.add_obstacle(Obstacle::new(SharedShape::ball(1.0), Pose::translation(9.0, 9.0))).unwrap();
    world.add_obstacle(Obstacle::new(heights, Pose::translation(30.0, 30.0))).unwrap();
    assert_eq!(world.to_snapshot(), Err(SnapshotError::UnknownShape { obstacle: 1 }));
}

#[test]
fn the_digest_covers_everything_that_is_written() {
    for (k, world) in worlds().into_iter().enumerate() {
        let (content, digest) = (content(&world), world.digest());
        let (mut accepted, mut tried) = (0, 0);
        // A prime stride reaches every byte of a number in each column.
        for at in (0..content.len()).step_by(127) {
            let mut changed = content.clone();
            changed[at] ^= 1;
            tried += 1;
            if let Ok(restored) = World::from_snapshot(&WORLD.seal(&changed)) {
                accepted += 1;
                assert_ne!(restored.digest(), digest, "world {k}, byte {at} of {}", content.len());
            }
        }
        assert!(2 * accepted > tried, "world {k}: only {accepted} of {tried} can be compared");
    }
}

#[test]
fn content_of_any_other_length_is_refused() {
    let content = content(&menagerie());
    for length in (0..content.len()).step_by(97) {
        let error = World::from_snapshot(&WORLD.seal(&content[..length])).unwrap_err();
        assert!(matches!(error, SnapshotError::Invalid { .. }), "{length}: {error}");
    }
    let longer = [&content[..], &[0]].concat();
    assert!(matches!(World::from_snapshot(&WORLD.seal(&longer)), Err(SnapshotError::Invalid { .. })));
}

#[test]
fn forged_numbers_never_panic() {
    let contents = worlds().map(|world| content(&world));
    let bytes =
        prop_oneof![any::<u8>().prop_map(|byte| vec![byte]), extreme().prop_map(|it| it.to_le_bytes().to_vec())];
    let changes = prop::collection::vec((any::<prop::sample::Index>(), bytes), 1..4);
    proptest!(ProptestConfig::with_cases(400), |(which in 0..2_usize, changes in changes)| {
        let mut forged = contents[which].clone();
        for (at, bytes) in changes {
            let at = at.index(forged.len() - bytes.len());
            forged[at..at + bytes.len()].copy_from_slice(&bytes);
        }
        let _ = forge(&forged);
    });
}

/// Numbers at the ends of ranges.
fn extreme() -> impl Strategy<Value = f32> {
    let numbers = vec![0.0, 1e-38, 1e-6, 0.1, 1.0, 3.0, 10.0, 999.0, 2e4, 5e4, 6e4, 1e5, 1e6, 9e8, 1e9, 1e30, f32::MAX];
    (prop::sample::select(numbers), any::<bool>())
        .prop_map(|(number, is_negative)| if is_negative { -number } else { number })
}

/// Steps a damaged world that is accepted, and reads what becomes of it.
fn goes_on(damage: impl Fn(&mut World)) -> World {
    let mut world = menagerie();
    damage(&mut world);
    let mut world = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
    for _ in 0..3 {
        world.step(&Inputs::new());
        read_back(&world);
    }
    world
}

#[test]
fn what_is_accepted_is_accepted_again_after_any_steps() {
    let late = goes_on(|w| w.step_index = crate::world::MOST_COUNTED);
    assert_eq!(late.step_index(), crate::world::MOST_COUNTED);
    goes_on(|w| (w.guard.wrong_side, w.guard.net_fired) = (crate::world::MOST_COUNTED, crate::world::MOST_COUNTED));
    let far = goes_on(|w| {
        let id = w.organisms().next().unwrap();
        let organism = w.organisms.get_mut(id).unwrap();
        organism.home = Vec2::new(-99_000.0, 99_000.0);
        let node = organism.outline[0] as usize;
        w.particles.x[node] = 50_000.0;
    });
    assert_eq!(far.census().quarantined, 1);
    goes_on(|w| {
        let id = w.organisms().next().unwrap();
        let engulfer = w.organisms.get_mut(id).unwrap().engulfer.as_mut().unwrap();
        engulfer.digests = true;
        (engulfer.pending_growth, engulfer.held_area, engulfer.fold_length) = (1e9, 1e9, 1e9);
        let prey = engulfer.meals[0].prey;
        w.organisms.get_mut(prey).unwrap().spawn_area = 1e9;
    });
}

#[test]
fn numbers_out_of_their_range_are_refused() {
    let refuse = |damage: &dyn Fn(&mut World), words: &str| {
        let mut world = menagerie();
        damage(&mut world);
        let error = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap_err().to_string();
        assert!(error.contains(words), "`{error}` instead of `{words}`");
    };
    let first = menagerie().organisms().next().unwrap();
    refuse(&|w| w.particles.vx[7] = f32::NAN, "velocity x is NaN");
    refuse(&|w| w.particles.inv_mass[7] = -1.0, "inverse mass is -1");
    refuse(&|w| w.organisms.get_mut(first).unwrap().spawn_scale = -3.4e38, "spawn scale is -3");
    refuse(&|w| w.organisms.get_mut(first).unwrap().home.x = 1e30, "home x is 1000000000000000");
    refuse(&|w| w.organisms.get_mut(first).unwrap().speed = 1001.0, "speed is 1001, must be 0 to 1000");
    refuse(&|w| w.organisms.get_mut(first).unwrap().is_quarantined = true, "in quarantine and not frozen");
    refuse(&|w| w.step_index = 1 << 53, "a counter is too large");
    let dead = |w: &World| w.blocks[0].particle(0, w.blocks[0].free_lane().unwrap()) as usize;
    refuse(
        &|w| {
            let i = dead(w);
            w.particles.vx[i] = 1.0;
        },
        "it has no owner, but mass, speed",
    );
    refuse(
        &|w| {
            let i = dead(w);
            w.particles.y[i] = 6e4;
        },
        "its place y is 6",
    );
    refuse(&|w| w.chemicals[0].fill(3.4e38), "chemicals[0]: the concentration in cell 0 is 34000000000");
    refuse(
        &|w| {
            let drop_of = w.fluids[0].particles[0] as usize;
            w.particles.radius[drop_of] = 100.0;
        },
        "radius is 100",
    );
}

#[test]
fn a_long_list_of_nothing_takes_no_memory() {
    // A list of 2^60 obstacles.
    let mut content = vec![0x80; 8];
    content.push(0x10);
    assert!(matches!(World::from_snapshot(&WORLD.seal(&content)), Err(SnapshotError::Invalid { .. })));
}
