//! Pictures: golden ones of each mode, and that no world and no field makes the renderer fail.
//!
//! `UPDATE_GOLDEN=1 cargo test -p microsim-core --features microscope --test microscope` writes the golden pictures:
//! 32 x 18 pixels, as text in the PPM format, which picture viewers show.
#![allow(clippy::disallowed_methods, reason = "tests measure; only stepping has to be bit-exact")]
#![cfg(feature = "microscope")]

use microsim_core::microscope::recipe::Card;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_core::parry2d::math::Pose;
use microsim_core::parry2d::shape::SharedShape;
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, CoccusSpec, Event, FluidBlockSpec, Inputs, Intent, Obstacle, OrganismSpec, Placement,
    PlateletSpec, ProbeSpec, RedCellSpec, RigidCellSpec, World, WorldConfig, glam::Vec2,
};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Size of a golden picture, and pixels that each of its pixels is the mean of, along each side.
const SIZE: [usize; 2] = [32, 18];
const SHRINK: usize = 8;
/// Largest difference of a golden pixel, and largest mean difference, of 255.
const TOLERANCE: f32 = 5.0;
const MEAN_TOLERANCE: f32 = 1.0;

const EVERYTHING: Field = Field { centre: Vec2::new(32.0, 18.0), width: 64.0, pixels: [256, 144] };

/// One of everything.
fn world() -> World {
    let mut world = World::new(WorldConfig { size: Vec2::new(62.0, 35.0), ..WorldConfig::default() }).unwrap();
    let mut put = |spec: OrganismSpec, x: f32, y: f32| _ = world.spawn(&spec, Placement::at(x, y)).unwrap();
    put(AmoeboidCellSpec { radii: Vec2::new(8.0, 7.0), node_radius: 0.45, ..Default::default() }.into(), 11.0, 24.0);
    put(RedCellSpec::default().into(), 24.0, 28.0);
    put(RedCellSpec { radius: 3.5, ..Default::default() }.into(), 25.0, 20.0);
    put(RigidCellSpec { radii: Vec2::new(10.0, 4.5), ..Default::default() }.into(), 42.0, 26.0);
    put(PlateletSpec { radius: 1.4, ..Default::default() }.into(), 8.0, 8.0);
    put(CoccusSpec::default().into(), 14.0, 8.0);
    put(AgarSpec::default().into(), 19.0, 9.0);
    put(ProbeSpec { radius: 2.0, ..Default::default() }.into(), 55.0, 8.0);
    put(FluidBlockSpec { size: Vec2::new(9.0, 6.0), ..Default::default() }.into(), 42.0, 10.0);
    world.add_obstacle(Obstacle::new(SharedShape::cuboid(3.0, 1.5), Pose::translation(28.0, 8.0))).unwrap();
    world
}

fn shoot(world: &World, optics: Optics, field: Field) -> Vec<u8> {
    let microscope = Microscope { optics, film: Film::DIGITAL };
    let rows = 0..field.pixels[1] as usize;
    microscope.expose(world, field).unwrap().rows(rows)
}

/// A picture made smaller, each channel 0 to 255.
fn shrunk(bytes: &[u8]) -> Vec<f32> {
    let [width, height] = SIZE;
    let mean = |k: usize| {
        let (x, y, channel) = (k / 3 % width, k / 3 / width, k % 3);
        let sum: u32 = (0..SHRINK * SHRINK)
            .map(|s| {
                let (x, y) = (x * SHRINK + s % SHRINK, y * SHRINK + s / SHRINK);
                u32::from(bytes[(y * width * SHRINK + x) * 3 + channel])
            })
            .sum();
        sum as f32 / (SHRINK * SHRINK) as f32
    };
    (0..width * height * 3).map(mean).collect()
}

fn golden_file(optics: Optics) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests", "golden", "microscope", &format!("{}.ppm", optics.name())].iter().collect()
}

fn as_text(picture: &[f32]) -> String {
    let mut text = format!("P3\n{} {}\n255\n", SIZE[0], SIZE[1]);
    for pixel in picture.chunks_exact(3) {
        writeln!(text, "{:.0} {:.0} {:.0}", pixel[0], pixel[1], pixel[2]).unwrap();
    }
    text
}

#[test]
fn each_mode_shows_its_golden_picture() {
    let world = world();
    for optics in Optics::ALL {
        let (file, now) = (golden_file(optics), shrunk(&shoot(&world, optics, EVERYTHING)));
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            std::fs::write(&file, as_text(&now)).unwrap();
        }
        let text = std::fs::read_to_string(&file).unwrap_or_default();
        let golden: Vec<f32> =
            text.lines().skip(3).flat_map(str::split_whitespace).map(|n| n.parse().unwrap()).collect();
        assert_eq!(golden.len(), now.len(), "{}", file.display());
        let apart: Vec<f32> = golden.iter().zip(&now).map(|(a, b)| (a - b).abs()).collect();
        let (most, mean) = (apart.iter().copied().fold(0.0, f32::max), apart.iter().sum::<f32>() / apart.len() as f32);
        let differs = format!("{}: {most:.1} at most, {mean:.2} on average; UPDATE_GOLDEN=1 writes it", optics.name());
        assert!(most <= TOLERANCE && mean <= MEAN_TOLERANCE, "{differs}");
    }
}

#[test]
fn modes_are_told_apart_and_known_by_name() {
    let world = world();
    let pictures = Optics::ALL.map(|optics| shoot(&world, optics, EVERYTHING));
    for (k, optics) in Optics::ALL.into_iter().enumerate() {
        assert_eq!(Optics::named(optics.name()), Some(optics));
        assert!(pictures[..k].iter().all(|other| *other != pictures[k]), "{}", optics.name());
    }
    assert_eq!(Optics::named("x-ray"), None);
}

#[test]
fn a_picture_is_the_same_in_any_portions() {
    let world = world();
    let field = Field { pixels: [256, 141], ..EVERYTHING };
    for (optics, film) in Optics::ALL.into_iter().flat_map(|optics| [(optics, Film::CINE), (optics, Film::PHOTO)]) {
        let exposure = Microscope { optics, film }.expose(&world, field).unwrap();
        let whole = exposure.rows(0..141);
        let parts: Vec<u8> =
            [0..1, 1..50, 50..140, 140..900].into_iter().flat_map(|rows| exposure.rows(rows)).collect();
        assert!(whole == parts, "{}", optics.name());
        assert!(exposure.rows(200..300).is_empty() && exposure.rows(9..9).is_empty());
    }
}

#[test]
fn a_colour_camera_changes_colours_and_loses_little() {
    let world = world();
    let shoot = |film| Microscope { optics: Optics::STAINED, film }.expose(&world, EVERYTHING).unwrap().rows(0..144);
    let plain = shoot(Film { has_mosaic: false, coding_quality: 0, ..Film::PHOTO });
    for film in [Film { coding_quality: 0, ..Film::PHOTO }, Film { has_mosaic: false, ..Film::PHOTO }] {
        let apart = shoot(film).iter().zip(&plain).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>();
        let mean = apart / plain.len() as f64;
        assert!((0.5..12.0).contains(&mean), "{mean}");
    }
}

#[test]
fn nothing_to_see_or_hardly_a_pixel_is_no_problem() {
    let empty = World::new(WorldConfig::default()).unwrap();
    let world = world();
    let fields = [
        Field { centre: Vec2::new(11.0, 24.0), width: 0.001, pixels: [40, 30] },
        Field { centre: Vec2::new(11.0, 24.0), width: 0.08, pixels: [1, 1] },
        Field { centre: Vec2::ZERO, width: 1e5, pixels: [1, 1] },
        Field { centre: Vec2::ZERO, width: 1e5, pixels: [64, 64] },
        Field { centre: Vec2::new(-1e5, 1e5), width: 30.0, pixels: [7, 300] },
        Field { centre: Vec2::new(24.0, 28.0), width: 200.0, pixels: [300, 1] },
    ];
    for optics in Optics::ALL {
        for field in fields {
            for world in [&empty, &world] {
                let bytes = shoot(world, optics, field);
                assert_eq!(bytes.len(), field.pixels.map(|n| n as usize).iter().product::<usize>() * 3);
            }
        }
    }
}

#[test]
fn absurd_sizes_and_films_are_refused_by_name() {
    let world = World::new(WorldConfig::default()).unwrap();
    let microscope = Microscope { optics: Optics::DIC, film: Film::CINE };
    let refused =
        |microscope: Microscope, field: Field| microscope.expose(&world, field).unwrap_err().field().to_owned();
    assert_eq!(refused(microscope, Field { pixels: [1 << 20, 1], ..EVERYTHING }), "pixels[0]");
    assert_eq!(refused(microscope, Field { width: -1.0, ..EVERYTHING }), "width");
    let film = Film { grain: f32::NAN, ..Film::CINE };
    assert_eq!(refused(Microscope { film, ..microscope }, EVERYTHING), "film.grain");
    for (film, name) in [
        (Film { blotches: 4.1, ..Film::CINE }, "film.blotches"),
        (Film { glare: -0.1, ..Film::CINE }, "film.glare"),
        (Film { gradient: 0.6, ..Film::CINE }, "film.gradient"),
        (Film { dust: 1.1, ..Film::CINE }, "film.dust"),
        (Film { sharpening: f32::NAN, ..Film::CINE }, "film.sharpening"),
        (Film { coding_quality: 101, ..Film::CINE }, "film.coding_quality"),
    ] {
        assert_eq!(refused(Microscope { film, ..microscope }, EVERYTHING), name);
    }
    let refused = |microscope: Microscope, field: Field, card: Card| {
        microscope.recipe(world.view(), field, card).unwrap_err().field().to_owned()
    };
    assert_eq!(refused(microscope, Field { width: -1.0, ..EVERYTHING }, Card::FULL), "width");
    assert_eq!(refused(Microscope { film, ..microscope }, EVERYTHING, Card::FULL), "film.grain");
    assert_eq!(refused(microscope, EVERYTHING, Card { detail: 0.0, ..Card::FULL }), "card.detail");
}

/// Largest change of a small patch between two pictures: 2 x 2 pixels, so that grain does not count.
fn largest_change(a: &[u8], b: &[u8], width: usize) -> f32 {
    let mean = |bytes: &[u8], x: usize, y: usize| {
        let at = |x: usize, y: usize| f32::from(bytes[(y * width + x) * 3]);
        (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)) / 4.0
    };
    let height = a.len() / 3 / width;
    let places = (0..height - 1).flat_map(|y| (0..width - 1).map(move |x| (x, y)));
    places.map(|(x, y)| (mean(a, x, y) - mean(b, x, y)).abs()).fold(0.0, f32::max)
}

#[test]
fn nothing_pops_or_flickers_while_a_cell_crawls() {
    let mut world = World::new(WorldConfig { size: Vec2::new(62.0, 35.0), ..WorldConfig::default() }).unwrap();
    let spec = AmoeboidCellSpec { radii: Vec2::splat(7.5), node_radius: 0.45, speed: 3.0, ..Default::default() };
    let cell = world.spawn(&spec.into(), Placement::at(15.0, 17.0)).unwrap();
    let mut inputs = Inputs::new();
    inputs.set(cell, Intent::toward(Vec2::new(60.0, 17.0)).unwrap());
    let film = Film { grain: 0.0, ..Film::DIGITAL };
    let microscope = Microscope { optics: Optics::PHASE_CONTRAST, film };
    let field = Field { centre: Vec2::new(20.0, 17.0), width: 40.0, pixels: [320, 180] };
    let mut last: Option<Vec<u8>> = None;
    // While it sets out, its front forms within a second.
    (0..60).for_each(|_| world.step(&inputs));
    for step in 60..180 {
        world.step(&inputs);
        let picture = microscope.expose(&world, field).unwrap().rows(0..180);
        if let Some(last) = &last {
            // In a sixtieth of a second nothing moves by more than 0.1 pixels per unit of speed; an edge that pops would
            // change a patch by 100 and more.
            let change = largest_change(last, &picture, 320);
            assert!(change < 45.0, "step {step}: {change}");
        }
        last = Some(picture);
    }
}

#[test]
fn what_rests_does_not_flicker() {
    let mut world = world();
    let still = Film { grain: 0.0, ..Film::DIGITAL };
    // The ground, and the inside of a red cell.
    let fields = [Vec2::new(34.0, 14.0), Vec2::new(24.0, 28.0)];
    let fields = fields.map(|centre| Field { centre, width: 4.0, pixels: [48, 27] });
    (0..120).for_each(|_| world.step(&Inputs::new()));
    let shoot_all = |world: &World| {
        let shots = Optics::ALL.into_iter().flat_map(|optics| fields.map(|field| (optics, field)));
        let shoot = |(optics, field)| Microscope { optics, film: still }.expose(world, field).unwrap().rows(0..27);
        shots.map(shoot).collect::<Vec<_>>()
    };
    let before = shoot_all(&world);
    (0..3).for_each(|_| world.step(&Inputs::new()));
    for (shot, (before, after)) in before.iter().zip(shoot_all(&world)).enumerate() {
        let apart: u32 = before.iter().zip(&after).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
        let mean = apart as f32 / after.len() as f32;
        assert!(mean < 0.5, "picture {shot}: {mean}");
    }
}

#[test]
fn nuclei_do_not_jump_when_daughters_part() {
    let mut world = World::new(WorldConfig { size: Vec2::new(62.0, 35.0), ..WorldConfig::default() }).unwrap();
    let spec = AmoeboidCellSpec { radii: Vec2::splat(7.5), node_radius: 0.7, ..Default::default() };
    let cell = world.spawn(&spec.into(), Placement::at(31.0, 17.0)).unwrap();
    world.divide(cell).unwrap();
    let microscope = Microscope { optics: Optics::FLUORESCENCE, film: Film { grain: 0.0, ..Film::DIGITAL } };
    let field = Field { centre: Vec2::new(31.0, 17.5), width: 48.0, pixels: [96, 70] };
    let mut last: Option<Vec<i32>> = None;
    for step in 0..2000 {
        world.step(&Inputs::new());
        // Nuclei alone are bright blue.
        let bytes = microscope.expose(&world, field).unwrap().rows(0..70);
        let blue: Vec<i32> = bytes.chunks_exact(3).map(|pixel| i32::from(pixel[2].saturating_sub(40))).collect();
        let last = last.replace(blue.clone()).unwrap_or_else(|| blue.clone());
        let apart: i32 = last.iter().zip(&blue).map(|(a, b)| (a - b).abs()).sum();
        // 2 if both were somewhere else at once.
        let share = apart as f32 / blue.iter().sum::<i32>() as f32;
        assert!(share < 0.5, "step {step}: {share}");
        if world.events().iter().any(|event| matches!(event, Event::Divided { .. })) {
            return;
        }
    }
    panic!("it never divides");
}
