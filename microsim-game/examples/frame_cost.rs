//! Measures what a frame costs without any graphics card or window: steps, and working out what the microscope has to draw:
//! `cargo run --release -p microsim-game --example frame_cost`.

use microsim_core::microscope::recipe::Card;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_core::{Intent, glam::Vec2};
use microsim_game::stage::Stage;
use std::time::Instant;

const FRAMES: usize = 200;
/// Height of what is seen, units, and size of the picture.
const VIEW: f32 = 60.0;
const PIXELS: [u32; 2] = [1280, 720];

fn main() -> Result<(), String> {
    println!("ms, least and median of {FRAMES} frames");
    for name in ["demo", "hunt", "game"] {
        let mut stage = Stage::builtin(name).ok_or(name)?;
        let goal =
            Intent::toward(stage.world().config().size * Vec2::new(0.9, 0.5)).map_err(|error| error.to_string())?;
        stage.steer(goal);
        let modes = [Optics::PHASE_CONTRAST, Optics::DIC, Optics::CLASSIC];
        let (mut steps, mut recipes) = (Vec::new(), modes.map(|_| Vec::new()));
        for _ in 0..FRAMES {
            let before = stage.world().moment();
            steps.push(milliseconds(|| stage.step()));
            let view = stage.world().view_since(&before, 0.5);
            let centre =
                stage.player().and_then(|id| view.organism(id)).map_or(Vec2::splat(40.0), |cell| cell.centroid());
            let field = Field { centre, width: VIEW * PIXELS[0] as f32 / PIXELS[1] as f32, pixels: PIXELS };
            for (optics, times) in modes.into_iter().zip(&mut recipes) {
                let microscope = Microscope { optics, film: Film::DIGITAL };
                times.push(milliseconds(|| drop(microscope.recipe(view, field, Card::FULL))));
            }
        }
        print!("{name}: step {}", summary(steps));
        modes.iter().zip(recipes).for_each(|(optics, times)| print!(", {} {}", optics.name(), summary(times)));
        println!();
    }
    Ok(())
}

fn milliseconds(work: impl FnOnce()) -> f64 {
    let began = Instant::now();
    work();
    began.elapsed().as_secs_f64() * 1000.0
}

fn summary(mut times: Vec<f64>) -> String {
    times.sort_by(f64::total_cmp);
    format!("{:.2} {:.2}", times[0], times[times.len() / 2])
}
