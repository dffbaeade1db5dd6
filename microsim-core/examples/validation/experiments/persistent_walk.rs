//! Persistent random walk of bodies.

use super::diffusion::{mean_squared_displacement, tracks};
use super::{Experiment, Outcome, Row};
use microsim_core::{BacillusSpec, Controller, Error, PersistentWalkParams};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "persistent_walk",
    title: "Persistent walk (Fürth)",
    source: "Fürth 1920, Z. Phys. 2, 244; of cells: Gail and Boone 1970, Biophys. J. 10, 980: \
             `2 S² P (t - P (1 - exp(-t / P)))`",
    words: "900 bacilli in a world, far from each other, after they have got going for 2 s.",
    run: measure,
};

fn measure() -> Result<Outcome, Error> {
    let mut rows = Vec::new();
    for [persistence, speed] in [[2.0, 3.0], [0.3, 10.0f32]] {
        let walk = Controller::persistent_walk(PersistentWalkParams { persistence });
        let spec = BacillusSpec { speed, ..BacillusSpec::default() };
        let tracks = tracks(&spec.into(), &walk, 2.0 + 40.1 * persistence)?;
        for periods in [0.5, 1.0, 2.0, 5.0, 10.0f32] {
            let [p, s, t] = [persistence, speed, periods * persistence].map(f64::from);
            let expected = 2.0 * s * s * p * (t - p * (1.0 - (-t / p).exp()));
            let ours = mean_squared_displacement(&tracks, 2.0, periods * persistence);
            let what = format!("mean squared displacement after {periods} P, P {persistence} s, S {speed} µm/s, µm²");
            rows.push(Row::near(what, expected, 0.05, ours));
        }
    }
    Ok(Outcome { rows, ..Outcome::default() })
}
