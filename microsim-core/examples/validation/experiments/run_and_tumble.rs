//! Run and tumble of bodies.

use super::diffusion::{mean_squared_displacement, tracks};
use super::plot::{Curve, Plot};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::{BacillusSpec, Controller, Error, RunAndTumbleParams};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "run_and_tumble",
    title: "Run and tumble (Berg)",
    source: "Berg and Brown 1972, Nature 239, 500 (runs of 0.86 s, tumbles of 0.14 s, turns of 68 ± 36°); Lovely and \
             Dahlquist 1975, J. Theor. Biol. 50, 477: `D = v² tau² / (2 (1 - a) (tau + T))` in the plane",
    words: "900 bacilli in a world, far from each other, for two minutes in windows of 10 s; `v` is the speed that is asked for. \
            A window is 10 runs long, so 2 % of the theory's value is not reached yet.",
    run: measure,
    order: Order::None("statistical. Times of controllers are whole steps, and at least three of them"),
};

fn measure() -> Result<Outcome, Error> {
    let params = RunAndTumbleParams::default();
    let spec = BacillusSpec::default();
    let [run, tumble, mean, deviation] = [params.run, params.tumble, params.turn[0], params.turn[1]].map(f64::from);
    let cosine = mean.cos() * (-0.5 * deviation * deviation).exp();
    let expected = f64::from(spec.speed).powi(2) * run * run / (2.0 * (1.0 - cosine) * (run + tumble));
    let tracks = tracks(&spec.into(), &Controller::run_and_tumble(params), 122.5, 30)?;
    let [short, long] = [5.0, 10.0].map(|time| mean_squared_displacement(&tracks, 2.0, time));
    let points =
        [0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0f32].map(|t| [t.into(), mean_squared_displacement(&tracks, 2.0, t)]);
    let law = |t: f64| 4.0 * expected * t;
    let rows = vec![Row::near("effective diffusion coefficient, µm²/s", expected, 0.05, (long - short) / (4.0 * 5.0))];
    let curves =
        vec![Curve::line("4 D t", vec![[0.25, law(0.25)], [20.0, law(20.0)]]), Curve::dots("ours", points.to_vec())];
    let plot = Plot { axes: ["time, s", "mean squared displacement, µm²"], is_logarithmic: true, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
