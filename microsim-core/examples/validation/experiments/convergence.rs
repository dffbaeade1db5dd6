//! How errors go with the substep.

use super::plot::{Curve, Plot};
use super::scene::{Stepping, exponent};
use super::{Experiment, Outcome, Row, catenary, free_fall, pendulum, spring};
use microsim_core::{Constraint, Error};

pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "convergence",
    title: "Convergence in the step and in substeps",
    source: "Implicit Euler has order 1: Hairer and Wanner 1996, IV.3; what matters is `h = dt / substeps`: Macklin et al. 2019",
    words: "Errors are shares; those of amplitudes are `-ln` of what is kept. The order is the slope of the error over the substep `h`, from 1/120 s to 1/3840 s. A chain is solved by one \
            sweep a substep, so its order says how fast sweeps converge too.",
    run: measure,
};

/// Errors of several substeps: the time of each, s, and its error.
fn errors(error: impl Fn(Stepping) -> Result<f64, Error>) -> Result<Vec<[f64; 2]>, Error> {
    let steppings = [2, 4, 8, 16, 32, 64].map(Stepping::of_substeps);
    steppings.into_iter().map(|stepping| Ok([stepping.substep(), error(stepping)?.abs()])).collect()
}

fn measure() -> Result<Outcome, Error> {
    let swing = |stepping: Stepping| {
        let angles = pendulum::swing(stepping, 0.1, 30.0)?;
        Ok(pendulum::amplitude_kept(&angles).ln())
    };
    let curves = [
        ("way of free fall", [0.9, 1.1], errors(|stepping| Ok(free_fall::fall(stepping)?[1] / 5.0 - 1.0))?),
        ("amplitude of a pendulum", [0.9, 1.1], errors(swing)?),
        (
            "amplitude of a spring",
            [0.9, 1.1],
            errors(|stepping| Ok(spring::amplitude_kept(Constraint::from, stepping, 3.0)?.ln()))?,
        ),
        ("length of a chain", [1.0, 2.2], errors(catenary::stretch)?),
    ];
    let mut outcome = Outcome::default();
    let mut drawn = Vec::new();
    for (name, accepted, points) in curves {
        let published = if accepted[1] > 2.0 { "1 to 2" } else { "1" };
        outcome.rows.push(Row::between(format!("order, {name}"), published, accepted, exponent(&points)));
        drawn.push(Curve::line(name, points));
    }
    let axes = ["substep, s", "relative error"];
    outcome.plot = Some(Plot { axes, is_logarithmic: true, curves: drawn });
    Ok(outcome)
}
