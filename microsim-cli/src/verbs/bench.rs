//! `bench`: the time of steps and their phases, and the errors of the constraints.

use crate::console::{Console, print_json};
use crate::failure::Failure;
use crate::interrupt;
use crate::prepared::prepare;
use crate::scenario_args::ScenarioArgs;
use crate::summary::{RunReport, Table, mean, median};
use crate::tally::Tally;
use crate::value_parser::whole;
use indicatif::ProgressBar;
use microsim_core::scenario::{Built, Script};
use microsim_core::{Inputs, Phase, Quality, World};
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Times, events and quality are those of the measured steps. Leaks and improper absorptions are the\n\
largest counts seen in any step, the warm-up included. Measures are taken outside the time that is measured."
)]
pub(crate) struct BenchArgs {
    #[command(flatten)]
    pub scenario: ScenarioArgs,
    /// Number of measured steps; without it, the scenario's duration
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(1..))]
    pub steps: Option<u64>,
    /// Number of steps before the measured ones
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole, default_value_t = 60)]
    pub warmup: u64,
    /// Print one JSON object instead of the table
    #[arg(long)]
    pub json: bool,
}

/// The report of a benchmark: that of a run, and more.
#[derive(Debug, Serialize)]
struct BenchReport {
    #[serde(flatten)]
    run: RunReport,
    warmup: u64,
    substeps: u32,
    /// Median time per step, ms.
    phases: BTreeMap<&'static str, f64>,
    quality: QualityReport,
}

/// The worst over the measured steps, but for the means and the anchors.
#[derive(Debug, Serialize)]
struct QualityReport {
    ring_error_mean: f64,
    ring_error_max: f32,
    penetration_max: f32,
    edge_stretch_max: f32,
    /// At the end.
    anchor_offset_max: f32,
    fluid_compression_mean: f64,
    membrane_stretch_max: f32,
    voids_mean: f64,
    voids_max: f32,
    /// Radians.
    excess_turning_mean: f64,
    excess_turning_max: f32,
    /// Over the steps in which a cell crawls.
    width_ratio_mean: f64,
    speed_kept_mean: f64,
}

/// Measures a scenario.
pub(crate) fn bench(args: &BenchArgs, console: &Console) -> Result<(), Failure> {
    let prepared = prepare(&args.scenario)?;
    interrupt::listen();
    let Built { mut world, mut script, .. } = prepared.built.clone();
    let steps = args.steps.unwrap_or_else(|| prepared.steps_in(None));
    let bar = console.progress(args.warmup.saturating_add(steps), "step");
    let mut stopwatch = Stopwatch::default();
    let warmup = measure(&mut world, &mut script, args.warmup, &bar, &mut stopwatch, |_| {});
    stopwatch = Stopwatch::default();
    let mut qualities = Vec::new();
    let see = |world: &World| qualities.push(world.quality());
    let mut tally = measure(&mut world, &mut script, steps, &bar, &mut stopwatch, see);
    bar.finish_and_clear();
    tally.leaks = tally.leaks.max(warmup.leaks);
    tally.improper_absorptions = tally.improper_absorptions.max(warmup.improper_absorptions);
    let report = BenchReport {
        run: RunReport::new(&prepared, &world, tally),
        warmup: warmup.steps,
        substeps: world.config().substeps,
        phases: stopwatch.medians(),
        quality: QualityReport::of(&qualities),
    };
    if args.json { print_json(&report) } else { report.table().print() }?;
    if report.run.interrupted { Err(Failure::Interrupted) } else { Ok(()) }
}

/// Takes so many steps and shows `see` the world after each.
fn measure(
    world: &mut World,
    script: &mut Script,
    steps: u64,
    bar: &ProgressBar,
    stopwatch: &mut Stopwatch,
    mut see: impl FnMut(&World),
) -> Tally {
    let start = Instant::now();
    let mut tally = Tally::default();
    while tally.steps < steps && !interrupt::is_asked() {
        let inputs = script.before_step(world);
        let took = stopwatch.step(world, inputs);
        tally.add(world, took);
        bar.set_position(world.step_index());
        see(world);
    }
    tally.is_interrupted = tally.steps < steps;
    tally.wall = start.elapsed();
    tally
}

/// Times of every phase of every step, ms.
#[derive(Debug, Default)]
struct Stopwatch {
    phases: [Vec<f64>; Phase::ALL.len()],
}

impl Stopwatch {
    fn step(&mut self, world: &mut World, inputs: &Inputs) -> Duration {
        let mut spent = [Duration::ZERO; Phase::ALL.len()];
        let start = Instant::now();
        let mut last = start;
        world.step_observed(inputs, |phase| {
            let now = Instant::now();
            spent[phase as usize] += now - last;
            last = now;
        });
        let took = start.elapsed();
        for (times, spent) in self.phases.iter_mut().zip(spent) {
            times.push(spent.as_secs_f64() * 1e3);
        }
        took
    }

    fn medians(&self) -> BTreeMap<&'static str, f64> {
        let named = Phase::ALL.iter().zip(&self.phases);
        named.map(|(phase, times)| (phase.name(), median(times))).collect()
    }
}

impl QualityReport {
    fn of(steps: &[Quality]) -> Self {
        let worst = |value: fn(&Quality) -> f32| steps.iter().map(value).fold(0.0, f32::max);
        let values = |value: fn(&Quality) -> f32| steps.iter().map(move |q| f64::from(value(q)));
        let average = |value| mean(&values(value).collect::<Vec<_>>());
        let while_crawling = |value| mean(&values(value).filter(|&x| x != 0.0).collect::<Vec<_>>());
        Self {
            ring_error_mean: average(|q| q.ring_error_mean),
            ring_error_max: worst(|q| q.ring_error_max),
            penetration_max: worst(|q| q.penetration_max),
            edge_stretch_max: worst(|q| q.edge_stretch_max),
            anchor_offset_max: steps.last().map_or(0.0, |q| q.anchor_offset_max),
            fluid_compression_mean: average(|q| q.fluid_compression_mean),
            membrane_stretch_max: worst(|q| q.membrane_stretch_max),
            voids_mean: average(|q| q.voids_max),
            voids_max: worst(|q| q.voids_max),
            excess_turning_mean: average(|q| q.excess_turning_max),
            excess_turning_max: worst(|q| q.excess_turning_max),
            width_ratio_mean: while_crawling(|q| q.width_ratio_mean),
            speed_kept_mean: while_crawling(|q| q.speed_kept_mean),
        }
    }
}

impl BenchReport {
    fn table(&self) -> Table {
        let mut table = self.run.table();
        table.row("substeps", self.substeps);
        for phase in Phase::ALL {
            let time = self.phases.get(phase.name()).copied().unwrap_or_default();
            table.row(&format!("  {}", phase.name()), format!("{time:8.3} ms"));
        }
        let quality = &self.quality;
        let mut percent = |name: &str, share: f64| table.row(name, format!("{:8.3} %", share * 100.0));
        percent("ring error, mean", quality.ring_error_mean);
        percent("ring error, max", quality.ring_error_max.into());
        percent("penetration, max", quality.penetration_max.into());
        percent("edge stretch, max", quality.edge_stretch_max.into());
        percent("anchor offset at the end", quality.anchor_offset_max.into());
        percent("fluid compression, mean", quality.fluid_compression_mean);
        percent("membrane stretch, max", quality.membrane_stretch_max.into());
        percent("voids, mean", quality.voids_mean);
        percent("voids, max", quality.voids_max.into());
        percent("speed kept, mean", quality.speed_kept_mean);
        table.row("excess turning, mean", format!("{:8.3} rad", quality.excess_turning_mean));
        table.row("excess turning, max", format!("{:8.3} rad", quality.excess_turning_max));
        table.row("front to rear width, mean", format!("{:8.3}", quality.width_ratio_mean));
        table
    }
}
