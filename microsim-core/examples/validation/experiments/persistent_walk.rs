//! Persistent random walk of bodies.

use super::diffusion::{mean_squared_displacement, tracks};
use super::plot::{Curve, Plot};
use super::{Experiment, Order, Outcome, Row};
use microsim_core::{AmoeboidCellSpec, BacillusSpec, Controller, Error, PersistentWalkParams};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "persistent_walk",
    title: "Persistent walk (Fürth)",
    source: "Fürth 1920, Z. Phys. 2, 244; of cells: Gail and Boone 1970, Biophys. J. 10, 980: \
             `2 S² P (t - P (1 - exp(-t / P)))`",
    words: "900 bacilli in a world, far from each other, after they have got going for 2 s: bodies that are moved as a whole follow \
            their controller. A cell that crawls does not, or only after a while: of 16 amoeboid cells of radius 11 the rows say by how \
            much it differs. For them the walk is a model of behaviour: cells of radius 8 to 16 at 3 to 14 µm/s follow it within 20 % where \
            they move by 0.75 of their radius in `P`, and keep their direction longer below.",
    run: measure,
    order: Order::None("statistical. Times of controllers are whole steps, and at least three of them"),
};

/// Mean squared displacement of a walk with this persistence, s, and speed after a time.
fn law(persistence: f64, speed: f64, time: f64) -> f64 {
    2.0 * speed * speed * persistence * (time - persistence * (1.0 - (-time / persistence).exp()))
}

/// The same of cells that crawl.
fn of_amoeboid_cells() -> Result<Vec<Row>, Error> {
    let spec = AmoeboidCellSpec::default();
    let mut rows = Vec::new();
    for persistence in [1.0, 4.0f32] {
        let walk = Controller::persistent_walk(PersistentWalkParams { persistence });
        let tracks = tracks(&spec.clone().into(), &walk, 2.0 + 20.1 * persistence, 4)?;
        for periods in [1.0, 4.0f32] {
            let [p, s, t] = [persistence, spec.speed, periods * persistence].map(f64::from);
            let what = format!(
                "mean squared displacement of amoeboid cells after {periods} P, P {persistence} s, S {s} µm/s, µm²"
            );
            let ours = mean_squared_displacement(&tracks, 2.0, periods * persistence);
            rows.push(Row::near(what, law(p, s, t), 0.15, ours));
        }
    }
    Ok(rows)
}

fn measure() -> Result<Outcome, Error> {
    let (mut rows, mut curves) = (Vec::new(), Vec::new());
    for [persistence, speed] in [[2.0, 3.0], [0.3, 10.0f32]] {
        let walk = Controller::persistent_walk(PersistentWalkParams { persistence });
        let spec = BacillusSpec { speed, ..BacillusSpec::default() };
        let tracks = tracks(&spec.into(), &walk, 2.0 + 40.1 * persistence, 30)?;
        let mut measured = Vec::new();
        for periods in [0.5, 1.0, 2.0, 5.0, 10.0f32] {
            let [p, s, t] = [persistence, speed, periods * persistence].map(f64::from);
            let expected = law(p, s, t);
            let ours = mean_squared_displacement(&tracks, 2.0, periods * persistence);
            measured.push([t, ours]);
            let what = format!("mean squared displacement after {periods} P, P {persistence} s, S {speed} µm/s, µm²");
            rows.push(Row::near(what, expected, 0.05, ours));
        }
        let [p, s] = [persistence, speed].map(f64::from);
        let times = (1..=48).map(|k| 0.25 * p * f64::from(k));
        curves.push(Curve::line(
            format!("Fürth, P {persistence} s, S {speed} µm/s"),
            times.map(|t| [t, law(p, s, t)]).collect(),
        ));
        curves.push(Curve::dots(format!("ours, P {persistence} s"), measured));
    }
    rows.extend(of_amoeboid_cells()?);
    let plot = Plot { axes: ["time, s", "mean squared displacement, µm²"], is_logarithmic: true, curves };
    Ok(Outcome { rows, plot: Some(plot), ..Outcome::default() })
}
