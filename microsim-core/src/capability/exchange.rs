//! What an organism gives to a chemical and takes from it.

use crate::error::{Error, in_range};
use crate::id::ChemicalId;
use serde::{Deserialize, Serialize};

/// An organism's source or sink of one chemical, spread evenly over its outline. While somebody holds it, it has none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exchange {
    /// The chemical.
    pub chemical: ChemicalId,
    /// Amount that it secretes, 1/s, 0 to 1 000 000.
    pub secretion: f32,
    /// Clearance: area that it frees of the chemical, square units/s, 0 to 1 000 000.
    pub uptake: f32,
}

impl Exchange {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        in_range("secretion", self.secretion, 0.0, 1e6)?;
        in_range("uptake", self.uptake, 0.0, 1e6)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_out_of_their_range_are_refused() {
        let is_sound = |secretion, uptake| Exchange { chemical: ChemicalId(0), secretion, uptake }.validate().is_ok();
        assert!(is_sound(0.0, 0.0) && is_sound(1e6, 1e6));
        assert!(!is_sound(-1.0, 0.0) && !is_sound(0.0, 2e6) && !is_sound(f32::NAN, 0.0));
    }
}
