//! Measures what pictures of the microscope cost on this machine: `cargo run --release -p microsim-game --example optics_cost`.

use microsim_core::glam::Vec2;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_game::microscope::{RenderQuality, Renderer};
use microsim_game::stage::Stage;
use std::time::Instant;

const FRAMES: u32 = 10;

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
    for pixels in [[640, 360], [1280, 720]] {
        let field = Field { centre: Vec2::new(60.0, 38.0), width: 106.667, pixels };
        for optics in [Optics::PHASE_CONTRAST, Optics::DIC, Optics::STAINED, Optics::CLASSIC] {
            let microscope = Microscope { optics, film: Film::CINE };
            for quality in [RenderQuality::Low, RenderQuality::Medium, RenderQuality::High] {
                let mut draw = || {
                    let recipe = renderer.recipe(stage.world().view(), field, microscope, quality)?;
                    Ok::<_, String>(renderer.draw(&recipe))
                };
                draw()?.get_texture_data();
                let start = Instant::now();
                for _ in 0..FRAMES {
                    draw()?;
                }
                // Reading waits until all is done.
                draw()?.get_texture_data();
                let each = start.elapsed().as_secs_f32() * 1000.0 / (FRAMES + 1) as f32;
                println!("{}x{} {} {quality:?}: {each:.1} ms", pixels[0], pixels[1], optics.name());
            }
        }
    }
    Ok(())
}
