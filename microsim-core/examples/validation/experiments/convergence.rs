//! How errors go with the substep.

use super::plot::{Curve, Plot};
use super::scene::exponent;
use super::{ALL, Experiment, Order, Outcome, Row};
use microsim_core::Error;

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "convergence",
    title: "Convergence in the step and in substeps",
    source: "Implicit Euler has order 1: Hairer and Wanner 1996, IV.3; what matters is `h = dt / substeps`: Macklin et al. 2019",
    words: "Every experiment that has an exact value and an error of discretisation. Errors are shares; those of amplitudes are `-ln` of \
            what is kept. The order is the slope of the line nearest to the logarithms of the error and of the substep `h`, over 2 to \
            64 substeps of 1/60 s and over steps of 1/15 to 1/240 s with 8 substeps where the section says nothing else. A chain is \
            solved by one sweep a substep, so its order says how fast sweeps converge too. What has no order says why in its section.",
    run: measure,
    order: Order::None("these are the orders"),
};

fn measure() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    let mut curves = Vec::new();
    for experiment in &ALL {
        let Order::Of(falling) = &experiment.order else { continue };
        let name = format!("{}: {}", experiment.title, falling.what);
        for (kind, errors) in [("substeps", falling.in_substeps()?), ("the step", falling.in_steps()?)] {
            if errors.len() < 3 {
                continue;
            }
            let what = format!("order in {kind}, {name}");
            outcome.rows.push(Row::between(what, falling.theory, falling.accepted, exponent(&errors)));
            if kind == "substeps" {
                curves.push(Curve::line(experiment.title, errors));
            }
        }
    }
    outcome.plot = Some(Plot { axes: ["substep, s", "error"], is_logarithmic: true, curves });
    Ok(outcome)
}
