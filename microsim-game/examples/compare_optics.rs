//! Draws one frame in each kind of optics twice, by the graphics card and by the core's reference, and fails where they
//! differ: `cargo run -p microsim-game --example compare_optics [FOLDER]`. Pictures go to the folder, the card's on the left.

use macroquad::texture::Texture2D;
use microsim_core::World;
use microsim_core::glam::Vec2;
use microsim_core::microscope::recipe::Precision;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_game::microscope::{RenderQuality, Renderer};
use microsim_game::stage::Stage;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const SIZE: [u32; 2] = [480, 270];
/// Pixels of the border that are not compared: there the card does not know what is beyond.
const BORDER: usize = 8;

/// How far apart pictures may be, of 255: on average, and at all but one pixel in a thousand.
struct Tolerance {
    mean: f32,
    most: f32,
}

const FLOAT: Tolerance = Tolerance { mean: 1.3, most: 12.0 };
const BYTES: Tolerance = Tolerance { mean: 5.0, most: 30.0 };

/// What is looked at: a scenario, a time in seconds, where, and a width.
struct Shot(&'static str, f64, Vec2, f32);

/// Blood; a ciliate; an amoeba between obstacles; free fluid and walls.
const SHOTS: [Shot; 4] = [
    Shot("hunt", 2.0, Vec2::new(44.0, 37.0), 50.0),
    Shot("pond", 0.5, Vec2::new(110.0, 120.0), 130.0),
    Shot("squeeze", 3.0, Vec2::new(60.0, 45.0), 100.0),
    Shot("dam-break", 1.0, Vec2::new(30.0, 25.0), 80.0),
];

/// Without grain, so that every difference counts.
const CLEAN: Film = Film { grain: 0.0, ..Film::DIGITAL };

fn main() -> ExitCode {
    let outcome = std::rc::Rc::new(std::cell::Cell::new(false));
    let passed = std::rc::Rc::clone(&outcome);
    macroquad::Window::new("compare optics", async move {
        let folder = std::env::args().nth(1).map(PathBuf::from);
        match compare_all(folder.as_deref()) {
            Ok(all_agree) => passed.set(all_agree),
            Err(problem) => eprintln!("{problem}"),
        }
    });
    if outcome.get() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn compare_all(folder: Option<&Path>) -> Result<bool, String> {
    let stages = SHOTS.iter().map(|shot| stage_at(shot.0, shot.1)).collect::<Result<Vec<Stage>, String>>()?;
    let mut all_agree = true;
    for (precision, tolerance) in [(Precision::Float, FLOAT), (Precision::Bytes, BYTES)] {
        let mut renderer = Renderer::with_precision(precision)?;
        for (Shot(name, _, centre, width), stage) in SHOTS.iter().zip(&stages) {
            let field = Field { centre: *centre, width: *width, pixels: SIZE };
            let films: &[Film] = if *name == SHOTS[0].0 { &[CLEAN, Film::CINE] } else { &[CLEAN] };
            let all = Optics::ALL.into_iter();
            for microscope in all.flat_map(|optics| films.iter().map(move |&film| Microscope { optics, film })) {
                let [picture, reference] = both(&mut renderer, stage.world(), field, microscope)?;
                let [mean, most] = difference(&picture, &reference);
                let agree = mean <= tolerance.mean && most <= tolerance.most;
                all_agree &= agree;
                let film = if microscope.film == CLEAN { "clean" } else { "cine" };
                let label = format!("{name}-{}-{precision:?}-{film}", microscope.optics.name());
                let verdict = if agree { "ok    " } else { "FAILED" };
                println!("{verdict} {label}: {mean:.2} on average, {most:.0} at most");
                if let Some(folder) = folder {
                    write(&folder.join(label + ".png"), &picture, &reference).map_err(|error| error.to_string())?;
                }
            }
        }
    }
    Ok(all_agree)
}

/// The card's picture and the reference.
fn both(renderer: &mut Renderer, world: &World, field: Field, microscope: Microscope) -> Result<[Vec<u8>; 2], String> {
    let reference = microscope.expose(world, field).map_err(|error| error.to_string())?;
    let recipe = renderer.recipe(world.view(), field, microscope, RenderQuality::High)?;
    Ok([pixels(&renderer.draw(&recipe)), reference.rows(0..SIZE[1] as usize)])
}

fn stage_at(name: &str, time: f64) -> Result<Stage, String> {
    let mut stage = Stage::builtin(name).ok_or(name)?;
    while stage.world().time() < time {
        stage.step();
    }
    Ok(stage)
}

/// Red, green and blue, the upper row first.
fn pixels(picture: &Texture2D) -> Vec<u8> {
    let image = picture.get_texture_data();
    let rows = image.bytes.chunks_exact(SIZE[0] as usize * 4).rev();
    rows.flat_map(|row| row.chunks_exact(4)).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

fn difference(a: &[u8], b: &[u8]) -> [f32; 2] {
    let [width, height] = SIZE.map(|side| side as usize);
    let row = |y: usize| (y * width + BORDER) * 3..((y + 1) * width - BORDER) * 3;
    let inner = (BORDER..height - BORDER).flat_map(row);
    let mut apart: Vec<f32> = inner.map(|k| f32::from(a[k].abs_diff(b[k]))).collect();
    apart.sort_unstable_by(f32::total_cmp);
    [apart.iter().sum::<f32>() / apart.len() as f32, apart[apart.len() - 1 - apart.len() / 1000]]
}

/// Both side by side.
fn write(path: &Path, left: &[u8], right: &[u8]) -> std::io::Result<()> {
    let row = SIZE[0] as usize * 3;
    let rows = left.chunks_exact(row).zip(right.chunks_exact(row));
    let both: Vec<u8> = rows.flat_map(|(a, b)| [a, b].concat()).collect();
    let mut encoder = png::Encoder::new(std::io::BufWriter::new(std::fs::File::create(path)?), SIZE[0] * 2, SIZE[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Fast);
    encoder.write_header()?.write_image_data(&both)?;
    Ok(())
}
