//! Orders of convergence: how the error of an experiment goes with the substep.

use super::plot::number;
use super::scene::{Stepping, exponent};
use microsim_core::Error;

/// What becomes of an experiment's error in shorter substeps.
pub(crate) enum Order {
    /// It falls by a power of the substep.
    Of(Falling),
    /// There is no order, because of this.
    None(&'static str),
}

/// An error that falls with the substep.
pub(crate) struct Falling {
    /// What has it.
    pub what: &'static str,
    pub error: fn(Stepping) -> Result<f64, Error>,
    /// Numbers of substeps of 1/60 s.
    pub substeps: &'static [u32],
    /// Steps, 1 / s, each with 8 substeps.
    pub steps: &'static [u16],
    /// Least and largest order that agrees.
    pub accepted: [f64; 2],
    /// The order by theory.
    pub theory: &'static str,
}

impl Falling {
    /// An error of order 1 over many substeps and steps.
    pub(crate) const fn first(what: &'static str, error: fn(Stepping) -> Result<f64, Error>) -> Self {
        Self {
            what,
            error,
            substeps: &[2, 4, 8, 16, 32, 64],
            steps: &[15, 30, 60, 120, 240],
            accepted: [0.9, 1.1],
            theory: "1",
        }
    }

    /// Substep and error, of more and more substeps.
    pub(crate) fn in_substeps(&self) -> Result<Vec<[f64; 2]>, Error> {
        self.errors(self.substeps.iter().map(|&substeps| Stepping::of_substeps(substeps)))
    }

    /// Substep and error, of shorter and shorter steps.
    pub(crate) fn in_steps(&self) -> Result<Vec<[f64; 2]>, Error> {
        self.errors(self.steps.iter().map(|&rate| Stepping { dt: 1.0 / f32::from(rate), ..Stepping::DEFAULT }))
    }

    fn errors(&self, steppings: impl Iterator<Item = Stepping>) -> Result<Vec<[f64; 2]>, Error> {
        steppings.map(|stepping| Ok([stepping.substep(), (self.error)(stepping)?.abs()])).collect()
    }
}

impl Order {
    /// The orders that are measured, or why there are none.
    pub(crate) fn words(&self) -> Result<String, Error> {
        let falling = match self {
            Self::Of(falling) => falling,
            Self::None(why) => return Ok(format!("none: {why}")),
        };
        let Falling { what, substeps, steps, .. } = falling;
        let mut words = format!("of the error of {what}: ");
        if let [few, .., many] = substeps {
            let order = number(exponent(&falling.in_substeps()?));
            words += &format!("{order} in substeps ({few} to {many} of 1/60 s), ");
        }
        if let [slow, .., fast] = steps {
            let order = number(exponent(&falling.in_steps()?));
            words += &format!("{order} in the step (1/{slow} to 1/{fast} s, 8 substeps)");
        }
        Ok(words)
    }
}
