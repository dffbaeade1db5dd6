//! Measures what pictures of the microscope cost on this machine: `cargo run --release -p microsim-game --example optics_cost`.

use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_game::microscope::{RenderQuality, Renderer};
use microsim_game::stage::Stage;
use std::time::Instant;

const FRAMES: u32 = 100;

fn main() {
    macroquad::Window::new("cost of optics", async {
        if let Err(problem) = measure() {
            eprintln!("{problem}");
        }
    });
}

fn measure() -> Result<(), String> {
    let stage = Stage::builtin("hunt").ok_or("no hunt")?;
    let mut renderer = Renderer::new()?;
    println!("ms: what is to be drawn, worked out by the processor, and the picture of it, by the graphics card");
    for pixels in [[640, 360], [1280, 720], [1920, 1080], [3840, 2160]] {
        let field = Field { centre: Vec2::new(60.0, 38.0), width: 106.667, pixels };
        for optics in Optics::ALL {
            let microscope = Microscope { optics, film: Film::CINE };
            for quality in [RenderQuality::Low, RenderQuality::Medium, RenderQuality::High] {
                let start = Instant::now();
                let recipe = renderer.recipe(stage.world().view(), field, microscope, quality)?;
                let worked_out = start.elapsed().as_secs_f32() * 1000.0;
                // Reading waits until all is done.
                renderer.draw(&recipe).get_texture_data();
                let start = Instant::now();
                for _ in 0..FRAMES {
                    renderer.draw(&recipe);
                }
                let submitted = start.elapsed().as_secs_f32() * 1000.0 / FRAMES as f32;
                renderer.draw(&recipe).get_texture_data();
                let each = start.elapsed().as_secs_f32() * 1000.0 / (FRAMES + 1) as f32;
                let [width, height] = pixels;
                let name = optics.name();
                println!(
                    "{width}x{height} {name} {quality:?}: {worked_out:.2} {each:.2}, of which submitted {submitted:.2}"
                );
            }
        }
    }
    Ok(())
}
