//! Particle fluid: position-based (Macklin, Mueller 2013, "Position Based Fluids"), or granular as a cheap mode.
//!
//! With `q = |x_i - x_j| / H`, `W = (1 - q)^3` and `rho_0` the density of a hexagonal lattice at the rest spacing:
//! `C_i = sum_j W_ij / rho_0 - 1 <= 0`, `lambda_i = -C_i / (sum_k |grad_k C_i|^2 + eps)` (eqs. 1, 9 and 11 there, without
//! cohesion), `dx_i = s sum_j (lambda_i + lambda_j) grad W_ij / rho_0` (eq. 12). One kernel for density and gradient keeps
//! the projection exact; its slope at `q = 0` keeps particles from clustering. Viscosity is XSPH (eq. 17).
//!
//! Particles are sorted by cell every substep and each gathers from its neighbours, so no order of writing matters.

use crate::collision::grid::Grid;
use crate::error::{Error, in_range};
use crate::particle::Particles;
use glam::Vec2;
use std::ops::Range;

/// Kernel radius in units of the rest spacing.
const SUPPORT: f32 = 2.0;
/// Softens the multiplier where a particle has few neighbours; dimensionless (times 1 / H^2).
const RELAXATION: f32 = 0.5;
/// Share of the correction that is applied: neighbours correct the same error at once.
const UNDER_RELAXATION: f32 = 0.7;
/// Particles never get nearer than this share of the rest spacing ...
const MIN_SPACING: f32 = 0.85;
/// ... of which this share is corrected per substep, on each side.
const MIN_SPACING_SHARE: f32 = 0.25;

/// How the particles of a fluid keep apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FluidMode {
    /// Incompressible: a density constraint on each particle.
    Density,
    /// Grains: particles only keep from overlapping. Several times cheaper, piles up like sand.
    Granular,
}

/// A kind of fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FluidParams {
    /// Distance of neighbours at rest, units, 0.05 to 100. The particles' radius is half of it.
    pub spacing: f32,
    /// Mass of a particle, 0.001 to 1000.
    pub particle_mass: f32,
    /// Share of the velocity difference to the neighbours that is lost per substep, 0 to 1.
    pub viscosity: f32,
    /// How particles keep apart.
    pub mode: FluidMode,
}

impl Default for FluidParams {
    fn default() -> Self {
        Self { spacing: 1.0, particle_mass: 1.0, viscosity: 0.05, mode: FluidMode::Density }
    }
}

impl FluidParams {
    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        in_range("spacing", self.spacing, 0.05, 100.0)?;
        in_range("particle_mass", self.particle_mass, 0.001, 1000.0)?;
        in_range("viscosity", self.viscosity, 0.0, 1.0)
    }
}

/// All particles of one fluid, wherever they are.
#[derive(Clone, Debug)]
pub(crate) struct Fluid {
    pub params: FluidParams,
    /// Whether a membrane of its own holds it.
    pub is_enclosed: bool,
    /// Indices into the particle store, in the order in which they were added.
    pub particles: Vec<u32>,
    rest_density: f32,
    sorted: Sorted,
}

/// Scratch columns in cell order.
#[derive(Clone, Debug, Default)]
struct Sorted {
    grid: Grid,
    x: Vec<f32>,
    y: Vec<f32>,
    multiplier: Vec<f32>,
    shift: Vec<Vec2>,
    velocity: Vec<Vec2>,
}

impl Fluid {
    pub(crate) fn new(params: FluidParams, is_enclosed: bool) -> Self {
        let rest_density = lattice_density();
        Self { params, is_enclosed, particles: Vec::new(), rest_density, sorted: Sorted::default() }
    }

    fn support(&self) -> f32 {
        SUPPORT * self.params.spacing
    }

    /// One iteration of the density constraint (or of the grains' contacts).
    pub(crate) fn project(&mut self, particles: &mut Particles) {
        if self.particles.is_empty() {
            return;
        }
        self.sort(particles);
        match self.params.mode {
            FluidMode::Density => {
                self.find_multipliers();
                self.find_density_shifts();
            }
            FluidMode::Granular => self.find_granular_shifts(),
        }
        let Sorted { grid, x, y, shift, .. } = &mut self.sorted;
        for (k, &i) in grid.entries().iter().enumerate() {
            x[k] += shift[k].x;
            y[k] += shift[k].y;
            particles.x[i as usize] += shift[k].x;
            particles.y[i as usize] += shift[k].y;
        }
    }

    /// Draws the velocity of each particle towards its neighbours' mean.
    pub(crate) fn apply_viscosity(&mut self, particles: &mut Particles) {
        let viscosity = self.params.viscosity;
        if viscosity <= 0.0 || self.particles.is_empty() {
            return;
        }
        let inverse_support = 1.0 / self.support();
        let Sorted { grid, x, y, shift, velocity, .. } = &mut self.sorted;
        velocity.clear();
        velocity.extend(grid.entries().iter().map(|&i| particles.velocity(i as usize)));
        for_each_neighbourhood(grid, x, y, |k, (xk, yk), ranges| {
            let (mut pull, mut weight) = (Vec2::ZERO, 1.0);
            for_each_neighbour(k, (xk, yk), x, y, ranges, inverse_support, |j, _, _, q| {
                let kernel = (1.0 - q) * (1.0 - q) * (1.0 - q);
                pull += (velocity[j] - velocity[k]) * kernel;
                weight += kernel;
            });
            shift[k] = pull * (viscosity / weight);
        });
        for (k, &i) in grid.entries().iter().enumerate() {
            particles.vx[i as usize] += shift[k].x;
            particles.vy[i as usize] += shift[k].y;
        }
    }

    fn sort(&mut self, particles: &Particles) {
        let support = self.support();
        let (mut low, mut high) = (Vec2::splat(f32::INFINITY), Vec2::splat(f32::NEG_INFINITY));
        for &i in &self.particles {
            low = low.min(particles.position(i as usize));
            high = high.max(particles.position(i as usize));
        }
        let Sorted { grid, x, y, multiplier, shift, .. } = &mut self.sorted;
        grid.fill(low, high, support, &self.particles, |i| particles.position(i as usize));
        x.clear();
        x.extend(grid.entries().iter().map(|&i| particles.position(i as usize).x));
        y.clear();
        y.extend(grid.entries().iter().map(|&i| particles.position(i as usize).y));
        multiplier.resize(self.particles.len(), 0.0);
        shift.resize(self.particles.len(), Vec2::ZERO);
    }

    fn find_multipliers(&mut self) {
        let (inverse_support, inverse_density) = (1.0 / self.support(), 1.0 / self.rest_density);
        let slope = 3.0 * inverse_support * inverse_density;
        let Sorted { grid, x, y, multiplier, .. } = &mut self.sorted;
        for_each_neighbourhood(grid, x, y, |k, at, ranges| {
            let (mut density, mut gradient, mut squared) = (1.0, Vec2::ZERO, 0.0);
            for_each_neighbour(k, at, x, y, ranges, inverse_support, |_, normal, _, q| {
                let rise = (1.0 - q) * (1.0 - q);
                density += rise * (1.0 - q);
                gradient += normal * (rise * slope);
                squared += rise * slope * (rise * slope);
            });
            let error = density * inverse_density - 1.0;
            let softening = RELAXATION * inverse_support * inverse_support;
            multiplier[k] = if error > 0.0 { error / (squared + gradient.length_squared() + softening) } else { 0.0 };
        });
    }

    fn find_density_shifts(&mut self) {
        let inverse_support = 1.0 / self.support();
        let slope = UNDER_RELAXATION * 3.0 * inverse_support / self.rest_density;
        let nearest = MIN_SPACING * self.params.spacing;
        let Sorted { grid, x, y, multiplier, shift, .. } = &mut self.sorted;
        for_each_neighbourhood(grid, x, y, |k, at, ranges| {
            let mut sum = Vec2::ZERO;
            for_each_neighbour(k, at, x, y, ranges, inverse_support, |j, normal, distance, q| {
                let mut along = (multiplier[k] + multiplier[j]) * (1.0 - q) * (1.0 - q) * slope;
                if distance < nearest {
                    along += MIN_SPACING_SHARE * (nearest - distance);
                }
                sum += normal * along;
            });
            shift[k] = sum;
        });
    }

    fn find_granular_shifts(&mut self) {
        let (inverse_support, spacing) = (1.0 / self.support(), self.params.spacing);
        let Sorted { grid, x, y, shift, .. } = &mut self.sorted;
        for_each_neighbourhood(grid, x, y, |k, at, ranges| {
            let (mut sum, mut touching) = (Vec2::ZERO, 0.0);
            for_each_neighbour(k, at, x, y, ranges, inverse_support, |_, normal, distance, _| {
                if distance < spacing {
                    sum += normal * (0.5 * (spacing - distance));
                    touching += 1.0;
                }
            });
            // Averaged over the contacts and over-relaxed (Macklin et al. 2014, section 4.1).
            shift[k] = if touching > 1.0 { sum * (1.5 / touching) } else { sum };
        });
    }

    /// Mean of `max(0, rho / rho_0 - 1)` over the particles.
    pub(crate) fn mean_compression(&mut self, particles: &Particles) -> f32 {
        if self.particles.is_empty() {
            return 0.0;
        }
        self.sort(particles);
        let (inverse_support, inverse_density) = (1.0 / self.support(), 1.0 / self.rest_density);
        let Sorted { grid, x, y, .. } = &self.sorted;
        let mut sum = 0.0;
        for_each_neighbourhood(grid, x, y, |k, at, ranges| {
            let mut density = 1.0;
            for_each_neighbour(k, at, x, y, ranges, inverse_support, |_, _, _, q| {
                density += (1.0 - q) * (1.0 - q) * (1.0 - q);
            });
            let error = density * inverse_density - 1.0;
            sum += if error > 0.0 { error } else { 0.0 };
        });
        sum / self.particles.len() as f32
    }
}

/// Area that a number of particles take up at rest: each has its share of a hexagonal lattice.
pub(crate) fn rest_area(count: usize, spacing: f32) -> f32 {
    count as f32 * spacing * spacing * 0.75f32.sqrt()
}

/// Kernel sum at a point of a hexagonal lattice of unit spacing.
fn lattice_density() -> f32 {
    let mut density = 0.0;
    for row in -3i32..=3 {
        for column in -4i32..=4 {
            let x = column as f32 + 0.5 * (row & 1) as f32;
            let y = row as f32 * 0.75f32.sqrt();
            let q = (x * x + y * y).sqrt() / SUPPORT;
            density += if q < 1.0 { (1.0 - q) * (1.0 - q) * (1.0 - q) } else { 0.0 };
        }
    }
    density
}

/// Calls `visit(k, (x_k, y_k), candidates)` for each sorted entry, with the three rows of cells around it.
fn for_each_neighbourhood(
    grid: &Grid,
    x: &[f32],
    y: &[f32],
    mut visit: impl FnMut(usize, (f32, f32), &[Range<usize>; 3]),
) {
    for row in 0..grid.rows() {
        for column in 0..grid.columns() {
            let columns = column.saturating_sub(1)..column + 2;
            let below = if row > 0 { grid.row_range(row - 1, columns.clone()) } else { 0..0 };
            let ranges = [below, grid.row_range(row, columns.clone()), grid.row_range(row + 1, columns)];
            for k in grid.row_range(row, column..column + 1) {
                visit(k, (x[k], y[k]), &ranges);
            }
        }
    }
}

/// Calls `visit(j, n, r, q)` for each entry nearer than the support, `n` the unit vector from it.
#[inline(always)]
fn for_each_neighbour(
    k: usize,
    (xk, yk): (f32, f32),
    x: &[f32],
    y: &[f32],
    ranges: &[Range<usize>; 3],
    inverse_support: f32,
    mut visit: impl FnMut(usize, Vec2, f32, f32),
) {
    for range in ranges {
        for j in range.clone() {
            let away = Vec2::new(xk - x[j], yk - y[j]);
            let distance = away.length();
            let q = distance * inverse_support;
            if q < 1.0 && j != k {
                let normal = if distance > 1e-6 { away / distance } else { fallback(k, j) };
                visit(j, normal, distance, q);
            }
        }
    }
}

/// Opposite directions for two particles in the same place.
fn fallback(k: usize, j: usize) -> Vec2 {
    if k < j { Vec2::X } else { Vec2::NEG_X }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;
    use crate::solver::testing::disc;

    fn block(mode: FluidMode, spacing: f32) -> (Fluid, Particles) {
        let mut fluid = Fluid::new(FluidParams { mode, ..FluidParams::default() }, false);
        let mut particles = Particles::default();
        let mut rng = Rng::new(1, 1);
        for k in 0..200 {
            let jitter = Vec2::new(rng.range(-0.1, 0.1), rng.range(-0.1, 0.1));
            let at = Vec2::new((k % 20) as f32, (k / 20) as f32) * spacing + jitter;
            fluid.particles.push(particles.insert(&disc(at, 1.0)));
        }
        (fluid, particles)
    }

    fn centre(particles: &Particles) -> Vec2 {
        particles.live().map(|i| particles.position(i)).sum::<Vec2>() / particles.len() as f32
    }

    #[test]
    fn compressed_fluid_expands_to_its_rest_density_about_its_centre() {
        let (mut fluid, mut particles) = block(FluidMode::Density, 0.7);
        let (before, start) = (fluid.mean_compression(&particles), centre(&particles));
        for _ in 0..60 {
            fluid.project(&mut particles);
        }
        let after = fluid.mean_compression(&particles);
        assert!(before > 0.4 && after < 0.02, "compression {before} -> {after}");
        assert!((centre(&particles) - start).length() < 1e-3, "momentum");
    }

    #[test]
    fn fluid_at_rest_density_or_below_stays() {
        let (mut fluid, mut particles) = block(FluidMode::Density, 1.3);
        let before = particles.clone();
        fluid.project(&mut particles);
        assert!((0..200).all(|i| (particles.position(i) - before.position(i)).length() < 1e-6));
    }

    #[test]
    fn grains_separate_to_their_spacing() {
        let (mut fluid, mut particles) = block(FluidMode::Granular, 0.8);
        for _ in 0..200 {
            fluid.project(&mut particles);
        }
        for i in 0..200 {
            for j in 0..i {
                let gap = (particles.position(i) - particles.position(j)).length();
                assert!(gap > 0.93, "grains {i} and {j} at {gap}");
            }
        }
    }

    #[test]
    fn viscosity_evens_out_velocities_and_keeps_their_mean_nearly() {
        let (mut fluid, mut particles) = block(FluidMode::Density, 0.9);
        let mut rng = Rng::new(5, 5);
        for i in 0..200 {
            particles.vx[i] = rng.range(-1.0, 1.0);
        }
        let spread = |p: &Particles| p.vx.iter().map(|v| v * v).sum::<f32>();
        fluid.params.viscosity = 0.5;
        let before = spread(&particles);
        fluid.project(&mut particles);
        (0..10).for_each(|_| fluid.apply_viscosity(&mut particles));
        assert!(spread(&particles) < 0.1 * before);
    }

    #[test]
    fn particles_in_one_place_come_apart() {
        let mut fluid = Fluid::new(FluidParams::default(), false);
        let mut particles = Particles::default();
        for _ in 0..4 {
            fluid.particles.push(particles.insert(&disc(Vec2::ONE, 1.0)));
        }
        for _ in 0..20 {
            fluid.project(&mut particles);
        }
        let spread = (0..4).map(|i| (particles.position(i) - Vec2::ONE).length()).sum::<f32>();
        assert!(spread > 0.1 && spread.is_finite(), "spread {spread}");
    }
}
