//! Chemicals: concentrations on a grid over the room, which organisms add to, take from and sense.
//!
//! The diffusing half of Keller and Segel 1970 (J. Theor. Biol. 26, 399), `dc/dt = D lap c - k c + sources`; the other half
//! are the organisms. Nothing flows through the walls of the room or through obstacles.

mod diffusion;
mod resampling;
mod spec;

use crate::config::WorldConfig;
use crate::error::Error;
use crate::instruction_set::Dispatch;
use diffusion::DiffusionGrid;
use glam::Vec2;
use resampling::Resampling;
#[cfg(feature = "snapshot")]
use serde::Deserialize;
use serde::Serialize;
pub use spec::ChemicalSpec;

/// Highest concentration, amount per square unit: what would be more is lost, so that no sum is infinite.
const HIGHEST: f32 = 1e30;

/// A chemical in a room.
#[derive(Clone, Debug, Serialize)]
pub struct Chemical {
    spec: ChemicalSpec,
    #[serde(skip)]
    grid: DiffusionGrid,
    /// Rounds of diffusion in a step.
    #[serde(skip)]
    rounds: u32,
    /// Concentration in each cell, amount per square unit: rows from the lower left corner.
    values: Vec<f32>,
}

/// A [`Chemical`] as it is written; the rest follows from the world.
#[cfg(feature = "snapshot")]
#[derive(Debug, Deserialize)]
pub(crate) struct ChemicalRecord {
    pub spec: ChemicalSpec,
    values: Vec<f32>,
}

impl Chemical {
    /// Sets the concentrations that were read.
    ///
    /// # Errors
    /// See [`Chemical::check`].
    #[cfg(feature = "snapshot")]
    pub(crate) fn restore(&mut self, record: ChemicalRecord, config: &WorldConfig) -> Result<(), String> {
        self.values = record.values;
        self.check(config)
    }

    /// Checks that it fills the room: each cell has a concentration, and those that are closed none.
    ///
    /// # Errors
    /// Says what is wrong.
    pub(crate) fn check(&self, config: &WorldConfig) -> Result<(), String> {
        let (count, _) = self.spec.plan(config).map_err(|error| error.to_string())?;
        let (cells, values) = (&self.grid.is_open, &self.values);
        if self.grid.count != count || values.len() != cells.len() {
            return Err(format!("{} concentrations do not fill {count:?} cells", values.len()));
        }
        let is_sound = |value: f32, is_open| if is_open { (0.0..=HIGHEST).contains(&value) } else { value == 0.0 };
        let unsound = values.iter().zip(cells).position(|(&value, &is_open)| !is_sound(value, is_open));
        unsound.map_or(Ok(()), |cell| Err(format!("the concentration in cell {cell} is {}", values[cell])))
    }

    /// A chemical in a world of these settings.
    pub(crate) fn new(spec: ChemicalSpec, config: &WorldConfig) -> Result<Self, Error> {
        let (count, rounds) = spec.plan(config)?;
        let grid = DiffusionGrid::new(count, config.size);
        Ok(Self { spec, values: vec![spec.initial; count[0] * count[1]], grid, rounds })
    }

    /// The same in a room of another size with the same lower left corner, in which nothing is closed yet. What is there of the old
    /// room keeps its content, the rest begins as a new chemical does.
    pub(crate) fn resized(&self, config: &WorldConfig) -> Result<Self, Error> {
        let mut new = Self::new(self.spec, config)?;
        let (from, to, fill) = (&self.grid, &new.grid, self.spec.initial);
        let across = Resampling { from: from.cell.x, to: to.cell.x, count: to.count[0], fill };
        let rows = self.values.chunks_exact(from.count[0]).map(|row| across.of(row));
        let rows: Vec<Vec<f32>> = rows.collect();
        let upwards = Resampling { from: from.cell.y, to: to.cell.y, count: to.count[1], fill };
        for column in 0..to.count[0] {
            let old: Vec<f32> = rows.iter().map(|row| row[column]).collect();
            for (row, value) in upwards.of(&old).into_iter().enumerate() {
                new.values[row * to.count[0] + column] = value;
            }
        }
        Ok(new)
    }

    /// Opens all cells and faces of a room of this size. What was closed is empty.
    pub(crate) fn open(&mut self, size: Vec2) {
        self.grid = DiffusionGrid::new(self.grid.count, size);
    }

    /// Closes the cells that lie in an obstacle within a box, and the faces that it crosses. Walls thinner than half a cell may
    /// leak.
    pub(crate) fn close(&mut self, bounds: [Vec2; 2], is_inside: impl Fn(Vec2) -> bool) {
        self.grid.close(&mut self.values, bounds, is_inside);
    }

    /// One step: diffusion and decay.
    pub(crate) fn advance(&mut self, dt: f32, dispatch: Dispatch) {
        let h = dt / self.rounds as f32;
        for _ in 0..self.rounds {
            let (spread, keep) = (self.spec.diffusion * h, 1.0 / (1.0 + self.spec.decay * h));
            dispatch.run(
                #[inline(always)]
                || self.grid.diffuse(&mut self.values, spread, keep),
            );
        }
    }

    /// Adds an amount at a point.
    pub(crate) fn add(&mut self, at: Vec2, amount: f32) {
        let density = amount / self.grid.cell_area();
        for (cell, share) in self.grid.around(at) {
            let more = self.values[cell] + share * density;
            self.values[cell] = if more > HIGHEST { HIGHEST } else { more };
        }
    }

    /// Takes about the content of `area` square units at a point; implicit, so that nothing becomes negative.
    pub(crate) fn take(&mut self, at: Vec2, area: f32) {
        let cells = area / self.grid.cell_area();
        for (cell, share) in self.grid.around(at) {
            self.values[cell] /= 1.0 + share * cells;
        }
    }

    /// How it spreads.
    #[must_use]
    pub fn spec(&self) -> &ChemicalSpec {
        &self.spec
    }

    /// Columns and rows of its grid.
    #[must_use]
    pub fn cells(&self) -> [usize; 2] {
        self.grid.count
    }

    /// Width and height of a cell, units.
    #[must_use]
    pub fn cell_size(&self) -> Vec2 {
        self.grid.cell
    }

    /// Concentration in each cell, amount per square unit: rows from the lower left corner of the room.
    #[must_use]
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// Concentration at a point, amount per square unit, interpolated between the cells around it.
    #[must_use]
    pub fn concentration(&self, at: Vec2) -> f32 {
        self.grid.around(at).into_iter().map(|(cell, share)| share * self.values[cell]).sum()
    }

    /// How the concentration rises, amount per square unit and unit: a difference over two cells.
    #[must_use]
    pub fn gradient(&self, at: Vec2) -> Vec2 {
        let Vec2 { x, y } = self.grid.cell;
        let rise = |by: Vec2| self.concentration(at + by) - self.concentration(at - by);
        Vec2::new(rise(Vec2::new(x, 0.0)), rise(Vec2::new(0.0, y))) / (2.0 * self.grid.cell)
    }

    /// Amount in the room.
    #[must_use]
    pub fn amount(&self) -> f64 {
        self.values.iter().map(|&value| f64::from(value)).sum::<f64>() * f64::from(self.grid.cell_area())
    }
}

#[cfg(test)]
impl Chemical {
    /// Sets the concentration everywhere, whatever it is.
    pub(crate) fn fill(&mut self, concentration: f32) {
        self.values.fill(concentration);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const DT: f32 = 1.0 / 60.0;

    fn room(width: f32, height: f32) -> WorldConfig {
        WorldConfig { size: Vec2::new(width, height), dt: DT, ..WorldConfig::default() }
    }

    fn chemical(spec: ChemicalSpec) -> Chemical {
        Chemical::new(spec, &room(80.0, 60.0)).unwrap()
    }

    #[test]
    fn the_amount_is_the_inflow_less_the_decay() {
        let spec = ChemicalSpec { diffusion: 300.0, decay: 0.5, ..ChemicalSpec::default() };
        let mut chemical = chemical(spec);
        let (mut expected, keep) = (0.0, (1.0 + f64::from(0.5 * DT) / f64::from(chemical.rounds)).powi(-1));
        for _ in 0..3600 {
            chemical.add(Vec2::new(13.3, 41.7), 7.0 * DT);
            chemical.advance(DT, Dispatch::default());
            expected = (expected + 7.0 * f64::from(DT)) * keep.powi(chemical.rounds as i32);
        }
        assert!((chemical.amount() / expected - 1.0).abs() < 1e-4, "{} instead of {expected}", chemical.amount());
        assert!((chemical.amount() / (7.0 / 0.5) - 1.0).abs() < 0.01, "source over decay: {}", chemical.amount());
    }

    #[test]
    fn a_source_in_the_middle_gives_a_field_with_all_its_symmetries() {
        let spec = ChemicalSpec { spacing: 1.0, ..ChemicalSpec::default() };
        let mut chemical = Chemical::new(spec, &room(41.0, 41.0)).unwrap();
        for _ in 0..200 {
            chemical.add(Vec2::splat(20.5), DT);
            chemical.advance(DT, Dispatch::default());
        }
        let at = |x: usize, y: usize| chemical.values()[y * 41 + x].to_bits();
        for (x, y) in (0..41).flat_map(|x| (0..41).map(move |y| (x, y))) {
            let all = [at(x, y), at(40 - x, y), at(x, 40 - y), at(40 - x, 40 - y), at(y, x)];
            assert!(all.iter().all(|&bits| bits == all[0]), "cell {x}, {y}: {all:?}");
        }
    }

    /// The modified Bessel function of the second kind and order 0: the integral of exp(-x cosh t) from 0 to infinity.
    fn k0(x: f64) -> f64 {
        (0..4000).map(|k| (-x * (0.0025 * (f64::from(k) + 0.5)).cosh()).exp() * 0.0025).sum()
    }

    #[test]
    fn the_steady_field_of_a_point_source_is_a_bessel_function() {
        let spec = ChemicalSpec { diffusion: 100.0, decay: 1.0, spacing: 1.0, initial: 0.0 };
        let (centre, rate) = (Vec2::splat(80.5), 50.0);
        let mut chemical = Chemical::new(spec, &room(161.0, 161.0)).unwrap();
        for _ in 0..900 {
            chemical.add(centre, rate * DT);
            chemical.advance(DT, Dispatch::default());
        }
        let closed = |r: f32| f64::from(rate) / (std::f64::consts::TAU * 100.0) * k0(f64::from(r / spec.range()));
        for r in [6.0, 8.0, 16.0, 32.0] {
            let way = Vec2::new(0.6, 0.8);
            let (here, expected) = (chemical.concentration(centre + way * r), closed(r));
            assert!((f64::from(here) / expected - 1.0).abs() < 0.02, "{r} units away: {here} instead of {expected}");
            let slope = -f64::from(chemical.gradient(centre + way * r).dot(way));
            let expected = (closed(r - 1.0) - closed(r + 1.0)) / 2.0;
            assert!((slope / expected - 1.0).abs() < 0.03, "slope at {r}: {slope} instead of {expected}");
        }
    }

    #[test]
    fn chemicals_do_not_pass_through_obstacles() {
        let mut chemical = chemical(ChemicalSpec { diffusion: 100.0, decay: 0.0, ..ChemicalSpec::default() });
        chemical.close([Vec2::new(38.5, 0.0), Vec2::new(41.5, 60.0)], |at| (at.x - 40.0).abs() < 1.5);
        for _ in 0..600 {
            chemical.add(Vec2::new(20.0, 30.0), DT);
            chemical.advance(DT, Dispatch::default());
        }
        assert!((chemical.amount() - 10.0).abs() < 1e-2, "{}", chemical.amount());
        assert_eq!(chemical.concentration(Vec2::new(60.0, 30.0)), 0.0);
        let beside = chemical.concentration(Vec2::new(37.0, 30.0));
        assert!(beside > 0.0 && chemical.concentration(Vec2::new(38.4, 30.0)) >= 0.99 * beside, "the wall is no hole");
    }

    #[test]
    fn no_amount_makes_a_concentration_infinite() {
        let mut chemical = chemical(ChemicalSpec::default());
        for _ in 0..4 {
            chemical.add(Vec2::new(30.0, 30.0), f32::MAX);
            chemical.advance(DT, Dispatch::default());
            assert!(chemical.values().iter().all(|&value| (0.0..=HIGHEST).contains(&value)));
        }
    }

    #[test]
    fn taking_up_clears_a_share_and_never_more_than_there_is() {
        let mut chemical = chemical(ChemicalSpec { initial: 2.0, ..ChemicalSpec::default() });
        let before = chemical.amount();
        chemical.take(Vec2::new(30.0, 30.0), 0.01);
        assert!((before - chemical.amount() - 0.02).abs() < 2e-3, "area times concentration");
        chemical.take(Vec2::new(30.0, 30.0), 1e6);
        assert!(chemical.values().iter().all(|&value| (0.0..=2.0).contains(&value)));
    }

    proptest! {
        #[test]
        fn whatever_is_accepted_is_stable(
            diffusion in 0.0f32..1e5, decay in 0.0f32..100.0, spacing in 0.1f32..200.0, dt in 0.001f32..0.1,
        ) {
            let config = WorldConfig { dt, ..room(31.0, 17.0) };
            if let Ok(mut chemical) = Chemical::new(ChemicalSpec { diffusion, decay, spacing, initial: 1.0 }, &config) {
                chemical.add(Vec2::new(9.0, 4.0), 100.0);
                let mut highest = chemical.values().iter().copied().fold(0.0, f32::max);
                for _ in 0..20 {
                    chemical.advance(dt, Dispatch::default());
                    let now = chemical.values().iter().copied().fold(0.0, f32::max);
                    prop_assert!(chemical.values().iter().all(|&value| value >= 0.0) && now <= highest * 1.0001);
                    highest = now;
                }
            }
        }
    }
}
