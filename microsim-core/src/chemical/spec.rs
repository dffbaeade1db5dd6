//! What a chemical is: how fast it spreads and decays, and which numbers are accepted.

use super::diffusion;
use crate::config::WorldConfig;
use crate::error::{Error, in_range, out_of_range};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Most cells of one grid.
const MAX_CELLS: usize = 1_000_000;
/// Most cells of all grids of a world.
const MAX_CELLS_TOGETHER: usize = 4_000_000;
/// Largest decay times step: with more the amount that a source keeps up is more than 2 % too small.
const MOST_DECAY: f32 = 0.05;

/// How a chemical spreads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChemicalSpec {
    /// Diffusion coefficient, square units/s, 0 to 100 000, and at most what 256 rounds of diffusion in a step carry: about
    /// 40 `spacing`² over the time of a step.
    pub diffusion: f32,
    /// Share that decays in a second where little of it does, 1/s, 0 to 100, and at most 0.05 in a step: 3 with the usual step of 1/60 s.
    pub decay: f32,
    /// Side of a cell of the grid, units, 0.1 to 1000; made a little smaller or larger so that cells fill the room.
    pub spacing: f32,
    /// Concentration everywhere to begin with, amount per square unit, 0 to 1 000 000.
    pub initial: f32,
}

impl Default for ChemicalSpec {
    fn default() -> Self {
        Self { diffusion: 100.0, decay: 0.05, spacing: 2.0, initial: 0.0 }
    }
}

impl ChemicalSpec {
    /// Distance over which the concentration around a source falls to about a third: the root of diffusion over decay,
    /// units.
    #[must_use]
    pub fn range(&self) -> f32 {
        (self.diffusion / self.decay).sqrt()
    }

    /// Checks every field for a world of these settings.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self, config: &WorldConfig) -> Result<(), Error> {
        self.plan(config).map(drop)
    }

    /// Checks every field for a world of these settings in which other chemicals have so many cells; returns its own number of them.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub(crate) fn cells_beside(&self, others: usize, config: &WorldConfig) -> Result<usize, Error> {
        let ([columns, rows], _) = self.plan(config)?;
        let left = MAX_CELLS_TOGETHER.saturating_sub(others);
        let accepted =
            || format!("so large that {left} cells fill the room: {MAX_CELLS_TOGETHER} for all chemicals together");
        let fits = columns * rows <= left;
        fits.then_some(columns * rows).ok_or_else(|| out_of_range("spacing", self.spacing.into(), accepted()))
    }

    /// Columns and rows of its grid, and the rounds of diffusion that a step takes.
    pub(super) fn plan(&self, config: &WorldConfig) -> Result<([usize; 2], u32), Error> {
        in_range("diffusion", self.diffusion, 0.0, 1e5)?;
        in_range("decay", self.decay, 0.0, 100.0)?;
        self.check_decay(config.dt)?;
        in_range("spacing", self.spacing, 0.1, 1000.0)?;
        in_range("initial", self.initial, 0.0, 1e6)?;
        let count = config.size.to_array().map(|side| ((side / self.spacing + 0.5) as usize).max(1));
        if count[0] * count[1] > MAX_CELLS {
            let accepted = format!("so large that {MAX_CELLS} cells fill the room");
            return Err(out_of_range("spacing", self.spacing.into(), accepted));
        }
        let cell = config.size / Vec2::from(count.map(|count| count as f32));
        let rounds = diffusion::rounds(cell, self.diffusion, config.dt).map_err(|most| {
            let accepted = format!("0 to {most} with this spacing and time step");
            out_of_range("diffusion", self.diffusion.into(), accepted)
        })?;
        Ok((count, rounds))
    }

    fn check_decay(&self, dt: f32) -> Result<(), Error> {
        let most = MOST_DECAY / dt;
        let accepted = || out_of_range("decay", self.decay.into(), format!("0 to {most:.1} with a step of {dt} s"));
        (self.decay <= most).then_some(()).ok_or_else(accepted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let refuse = |spec: ChemicalSpec, field: &str| {
            assert_eq!(spec.validate(&room(80.0, 60.0)).unwrap_err().field(), field);
        };
        let spec = ChemicalSpec::default;
        refuse(ChemicalSpec { diffusion: -1.0, ..spec() }, "diffusion");
        refuse(ChemicalSpec { diffusion: 1e5, spacing: 0.5, ..spec() }, "diffusion");
        refuse(ChemicalSpec { decay: f32::NAN, ..spec() }, "decay");
        refuse(ChemicalSpec { decay: 3.1, ..spec() }, "decay");
        assert!(ChemicalSpec { decay: 2.9, ..spec() }.validate(&room(80.0, 60.0)).is_ok());
        refuse(ChemicalSpec { spacing: 0.0, ..spec() }, "spacing");
        let fine = ChemicalSpec { spacing: 0.1, ..spec() };
        assert_eq!(fine.validate(&room(2e4, 2e4)).unwrap_err().field(), "spacing");
        refuse(ChemicalSpec { initial: f32::INFINITY, ..spec() }, "initial");
    }

    #[test]
    fn chemicals_share_a_number_of_cells() {
        let spec = ChemicalSpec { spacing: 1.0, ..ChemicalSpec::default() };
        assert_eq!(spec.cells_beside(3_000_000, &room(1000.0, 1000.0)), Ok(1_000_000));
        let refused = spec.cells_beside(3_000_001, &room(1000.0, 1000.0)).unwrap_err();
        assert!(refused.to_string().contains("`spacing` is 1, accepted: so large that 999999 cells"), "{refused}");
        assert!(spec.cells_beside(usize::MAX, &room(1.0, 1.0)).is_err());
    }

    fn room(width: f32, height: f32) -> WorldConfig {
        WorldConfig { size: Vec2::new(width, height), ..WorldConfig::default() }
    }
}
