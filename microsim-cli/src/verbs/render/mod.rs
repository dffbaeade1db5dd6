//! `render`: pictures and movies of a scenario or a replay as a microscope would show them.

mod animation;
mod options;
mod overlay;
mod photograph;
mod projector;

use options::{FilmStock, OpticsList, Size, ViewSpec};

use crate::console::Console;
use crate::draw::png::Picture;
use crate::failure::Failure;
use crate::interrupt;
use crate::output::Outputs;
use crate::prepared::Prepared;
use crate::scenario_args::ScenarioArgs;
use crate::value_parser::duration;
use crate::world_file::lost;
use animation::{Movie, PictureFormat};
use indicatif::ProgressBar;
use microsim_core::World;
use microsim_core::microscope::{Field, Film, Microscope, Optics};
use microsim_core::replay::{Ending, Replay};
use projector::Projector;
use std::path::Path;

/// Frames per second of a movie for which nothing else is said.
const FPS: f64 = 24.0;
/// Most frames of one movie.
const MOST_FRAMES: f64 = 100_000.0;
/// Most pixels of the pictures of one contact sheet, which is made in memory.
const MOST_SHEET: u64 = 1 << 28;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "NAME|FILE may also be a replay that `run --record` has written, with a name that ends in .replay.\n\
The ending of the file name chooses the format: .png is a still; .gif, .apng and .mp4 are movies (an mp4 needs ffmpeg).\n\
Several moments or optics in one .png make a contact sheet. Equal scenario, seed and options give equal bytes,\n\
whatever the number of threads.\n\
Optics: phase-contrast, negative-phase-contrast, dic, dark-field, bright-field, stained, fluorescence, classic."
)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    pub scenario: ScenarioArgs,
    /// The picture or movie to write
    #[arg(short, long, value_name = "FILE")]
    pub output: std::path::PathBuf,
    /// Simulated time of a still, s; without it, the scenario's duration or the replay's end
    #[arg(long, value_name = "S", value_parser = duration, conflicts_with_all = ["from", "to", "fps"])]
    pub at: Option<f64>,
    /// Simulated time of the first frame, s
    #[arg(long, value_name = "S", value_parser = duration)]
    pub from: Option<f64>,
    /// Simulated time of the last frame, s; without it, the scenario's duration
    #[arg(long, value_name = "S", value_parser = duration)]
    pub to: Option<f64>,
    /// Frames per second of simulated time, 24 by default
    #[arg(long, value_name = "N", value_parser = options::frame_rate)]
    pub fps: Option<f64>,
    /// Contrast method; several with commas, or all
    #[arg(long, value_name = "MODE", default_value = "phase-contrast")]
    pub optics: OpticsList,
    /// Film with grain and flicker, a digital camera, or a photo as stored
    #[arg(long, value_enum, default_value_t = FilmStock::Cine)]
    pub film: FilmStock,
    /// Width and height, pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720")]
    pub size: Size,
    /// Field of view: X,Y,WIDTH in micrometres, or follow:NAME,WIDTH (width optional) of an organism; else the room
    #[arg(long, value_name = "VIEW", allow_hyphen_values = true)]
    pub view: Option<ViewSpec>,
    /// Pictures side by side in a contact sheet
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub columns: Option<u32>,
    /// Threads to compute pictures on; without it, one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
    /// Shade where chemicals are: each shade is half of the next
    #[arg(long)]
    pub chemicals: bool,
    /// Leave the scale bar out
    #[arg(long)]
    pub no_scale_bar: bool,
}

/// Renders a still, a sheet or a movie.
pub(crate) fn render(args: &RenderArgs, console: &Console) -> Result<(), Failure> {
    let format = PictureFormat::of(&args.output)?;
    let (prepared, replay) = projector::open(&args.scenario)?;
    let plan = RenderPlan::of(args, &prepared, replay.as_ref())?;
    plan.check(format)?;
    interrupt::listen();
    let mut projector = Projector::new(&prepared, replay.as_ref(), Path::new(&args.scenario.scenario))?;
    plan.view.field(projector.world(), &prepared, plan.size)?;
    let bar = console.progress(plan.last_step(projector.world()), "step");
    let shots = plan.moments.iter().flat_map(|&moment| plan.optics.iter().map(move |&optics| (moment, optics)));
    let mut pictures = shots.map(|(moment, optics)| {
        plan.run_to(moment, &mut projector, &bar)?;
        plan.shoot(projector.world(), optics, &prepared)
    });
    if format == PictureFormat::Png {
        let mut pictures = pictures.collect::<Result<Vec<_>, _>>()?;
        let columns = args.columns.map_or(plan.columns(), |columns| columns as usize);
        let picture =
            if plan.is_sheet(format) { Picture::sheet_in(&pictures, columns) } else { pictures.swap_remove(0) };
        let (outputs, name) = Outputs::beside(&args.output)?;
        outputs.write(&name, &picture.encoded()?)?;
    } else {
        let movie = Movie { size: plan.size, fps: plan.fps, frames: plan.moments.len() as u32 };
        movie.write(format, &args.output, &mut pictures)?;
    }
    bar.finish_and_clear();
    console.note(&format!("wrote {}", args.output.display()));
    replay.map_or(Ok(()), |replay| report_ending(&replay, Path::new(&args.scenario.scenario), console))
}

/// Says what of a replay is lost, which is a failure if it is damaged.
fn report_ending(replay: &Replay, path: &Path, console: &Console) -> Result<(), Failure> {
    match (lost(replay, path), replay.ending()) {
        (Some(text), Ending::Damaged { .. }) => return Err(Failure::Message(text)),
        (Some(text), _) => console.note(&text),
        (None, _) => {}
    }
    Ok(())
}

/// The pictures to render.
struct RenderPlan {
    moments: Vec<f64>,
    fps: f64,
    optics: Vec<Optics>,
    film: Film,
    size: Size,
    view: ViewSpec,
    threads: usize,
    has_scale_bar: bool,
    shows_chemicals: bool,
}

impl RenderPlan {
    fn of(args: &RenderArgs, prepared: &Prepared, replay: Option<&Replay>) -> Result<Self, Failure> {
        let fps = args.fps.unwrap_or(FPS);
        let dt = f64::from(prepared.scenario.config().dt);
        let end = replay.map_or(f64::from(prepared.scenario.duration()), |replay| replay.steps() as f64 * dt);
        let moments = match (args.from, args.to) {
            (None, None) => vec![args.at.unwrap_or(end)],
            (from, to) => {
                let (from, to) = (from.unwrap_or(0.0), to.unwrap_or(end));
                moments(from, to, fps)?
            }
        };
        let film = Film { rate: if moments.len() > 1 { fps as f32 } else { Film::CINE.rate }, ..args.film.film() };
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        Ok(Self {
            moments,
            fps,
            optics: args.optics.0.clone(),
            film,
            size: args.size,
            view: args.view.clone().unwrap_or(ViewSpec::Room),
            threads: args.threads.map_or(threads, usize::from),
            has_scale_bar: !args.no_scale_bar,
            shows_chemicals: args.chemicals,
        })
    }

    /// Whether the file can hold the pictures.
    fn check(&self, format: PictureFormat) -> Result<(), Failure> {
        if format != PictureFormat::Png && self.optics.len() > 1 {
            return Err(Failure::Message(
                "a movie shows one kind of optics, accepted: one, or -o SHEET.png".to_owned(),
            ));
        }
        if self.is_sheet(format) && self.size.pixels().saturating_mul(self.pictures() as u64) > MOST_SHEET {
            let accepted = format!("at most {MOST_SHEET} pixels in all");
            return Err(Failure::Message(format!("a sheet of {} pictures, accepted: {accepted}", self.pictures())));
        }
        Ok(())
    }

    /// A sheet is a PNG like a still.
    fn is_sheet(&self, format: PictureFormat) -> bool {
        format == PictureFormat::Png && self.pictures() > 1
    }

    fn pictures(&self) -> usize {
        self.moments.len() * self.optics.len()
    }

    /// Pictures side by side: a row for each moment if there are several kinds of optics.
    fn columns(&self) -> usize {
        match (self.moments.len(), self.optics.len()) {
            (1, 1) => 1,
            (1, 2..=4) | (_, 1) => 4.min(self.pictures()),
            (1, _) => 2,
            (_, optics) => optics,
        }
    }

    fn last_step(&self, world: &World) -> u64 {
        step_at(world, self.moments.last().copied().unwrap_or(0.0))
    }

    /// Runs the world, with its scenario's commands or as recorded, up to a moment.
    fn run_to(&self, moment: f64, projector: &mut Projector, bar: &ProgressBar) -> Result<(), Failure> {
        while projector.world().step_index() < step_at(projector.world(), moment) {
            projector.step()?;
            bar.set_position(projector.world().step_index());
            stop_if_asked()?;
        }
        stop_if_asked()
    }

    fn shoot(&self, world: &World, optics: Optics, prepared: &Prepared) -> Result<Picture, Failure> {
        let field: Field = self.view.field(world, prepared, self.size)?;
        let microscope = Microscope { optics, film: self.film };
        let exposure = microscope.expose(world, field);
        let exposure = exposure.map_err(|error| Failure::Message(format!("cannot render: {error}")))?;
        let picture = photograph::develop(&exposure, self.threads);
        let picture = if self.shows_chemicals { overlay::with_chemicals(picture, &field, world) } else { picture };
        Ok(if self.has_scale_bar { overlay::with_scale_bar(picture, &field, optics) } else { picture })
    }
}

fn step_at(world: &World, moment: f64) -> u64 {
    (moment / f64::from(world.config().dt)).round() as u64
}

fn stop_if_asked() -> Result<(), Failure> {
    if interrupt::is_asked() { Err(Failure::Interrupted) } else { Ok(()) }
}

/// Moments from one time to another, `fps` per second.
fn moments(from: f64, to: f64, fps: f64) -> Result<Vec<f64>, Failure> {
    let count = ((to - from) * fps + 1e-6).floor() + 1.0;
    if !(to >= from && count <= MOST_FRAMES) {
        let accepted = format!("--to at or after --from, and at most {MOST_FRAMES} frames");
        return Err(Failure::Message(format!("--from {from} --to {to}: accepted: {accepted}")));
    }
    Ok((0..count as u64).map(|k| from + k as f64 / fps).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_include_both_ends() {
        assert_eq!(moments(1.0, 2.0, 4.0).ok(), Some(vec![1.0, 1.25, 1.5, 1.75, 2.0]));
        assert_eq!(moments(0.0, 10.0, 0.3).unwrap().len(), 4);
        assert_eq!(moments(3.0, 3.0, 24.0).ok(), Some(vec![3.0]));
        assert!(moments(2.0, 1.0, 24.0).is_err() && moments(0.0, 1e9, 1000.0).is_err());
    }
}
