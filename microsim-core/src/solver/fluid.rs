//! Particle fluid: position-based (Macklin, Mueller 2013, "Position Based Fluids"), or granular as a cheap mode.
//!
//! With `q = |x_i - x_j| / H`, `W = (1 - q)^3` and `rho_0` the density of a hexagonal lattice at the rest spacing:
//! `C_i = sum_j W_ij / rho_0 - 1 <= 0`, `lambda_i = -C_i / (sum_k |grad_k C_i|^2 + eps)` (eqs. 1, 9 and 11 there, without
//! cohesion), `dx_i = s sum_j (lambda_i + lambda_j) grad W_ij / rho_0` (eq. 12). One kernel for density and gradient keeps
//! the projection exact; its slope at `q = 0` keeps particles from clustering. Viscosity is XSPH (eq. 17).
//!
//! Once per step, and again when something has moved too far since, particles are sorted by cell and each one's possible
//! neighbours are listed; in the substeps each gathers from its list, so no order of writing matters.

use crate::collision::grid::Grid;
use crate::error::{Error, in_range};
use crate::particle::Particles;
use glam::Vec2;

/// Kernel radius in units of the rest spacing.
const SUPPORT: f32 = 2.0;
/// Softens the multiplier where a particle has few neighbours; dimensionless (times 1 / H^2).
const RELAXATION: f32 = 0.5;
/// Neighbours are listed this much beyond the support, in units of the rest spacing.
const MARGIN: f32 = 0.4;
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
    /// Rate at which velocity differences between neighbours decay, 1/s, 0 to 1000.
    pub viscosity: f32,
    /// How particles keep apart.
    pub mode: FluidMode,
}

impl Default for FluidParams {
    fn default() -> Self {
        Self { spacing: 1.0, particle_mass: 1.0, viscosity: 10.0, mode: FluidMode::Density }
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
        in_range("viscosity", self.viscosity, 0.0, 1000.0)
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
    /// First of each entry's possible neighbours in `neighbours`, and one past the last one's.
    starts: Vec<u32>,
    neighbours: Vec<u32>,
    /// Where the entries were when neighbours were listed.
    listed_at: Vec<Vec2>,
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

    /// Sorts the particles and lists those within the support of each other, with a margin for their motion.
    pub(crate) fn find_neighbours(&mut self, particles: &Particles) {
        if self.particles.is_empty() {
            return;
        }
        let (mut low, mut high) = (Vec2::splat(f32::INFINITY), Vec2::splat(f32::NEG_INFINITY));
        for &i in &self.particles {
            low = low.min(particles.position(i as usize));
            high = high.max(particles.position(i as usize));
        }
        let cutoff = self.support() + MARGIN * self.params.spacing;
        self.sorted.grid.fill(low, high, cutoff, &self.particles, |i| particles.position(i as usize));
        self.sorted.gather(particles);
        self.sorted.list_neighbours(cutoff);
    }

    /// Takes over the particles' positions; lists neighbours anew if one has used up its half of the margin.
    fn refresh(&mut self, particles: &Particles) {
        self.sorted.gather(particles);
        let half = 0.5 * MARGIN * self.params.spacing;
        if self.sorted.farthest_squared() > half * half {
            self.find_neighbours(particles);
        }
    }

    /// One iteration of the density constraint (or of the grains' contacts).
    pub(crate) fn project(&mut self, particles: &mut Particles) {
        if self.particles.is_empty() {
            return;
        }
        self.refresh(particles);
        match self.params.mode {
            FluidMode::Density => {
                self.find_multipliers();
                self.find_density_shifts();
            }
            FluidMode::Granular => self.find_granular_shifts(),
        }
        for (&i, shift) in self.sorted.grid.entries().iter().zip(&self.sorted.shift) {
            particles.x[i as usize] += shift.x;
            particles.y[i as usize] += shift.y;
        }
    }

    /// Draws the velocity of each particle towards its neighbours' mean, for a whole step of `dt`.
    pub(crate) fn apply_viscosity(&mut self, particles: &mut Particles, dt: f32) {
        let share = self.params.viscosity * dt / (1.0 + self.params.viscosity * dt);
        if share <= 0.0 || self.particles.is_empty() {
            return;
        }
        let support = self.support();
        self.refresh(particles);
        let Sorted { grid, velocity, .. } = &mut self.sorted;
        velocity.clear();
        velocity.extend(grid.entries().iter().map(|&i| particles.velocity(i as usize)));
        let sorted = &self.sorted;
        for (k, &i) in sorted.grid.entries().iter().enumerate() {
            let (mut pull, mut weight) = (Vec2::ZERO, 1.0);
            sorted.for_each_neighbour(k, support, |j, _, _, q| {
                let kernel = (1.0 - q) * (1.0 - q) * (1.0 - q);
                pull += (sorted.velocity[j] - sorted.velocity[k]) * kernel;
                weight += kernel;
            });
            let change = pull * (share / weight);
            particles.vx[i as usize] += change.x;
            particles.vy[i as usize] += change.y;
        }
    }

    fn find_multipliers(&mut self) {
        let (support, inverse_density) = (self.support(), 1.0 / self.rest_density);
        let slope = 3.0 * inverse_density / support;
        let softening = RELAXATION / (support * support);
        let mut multiplier = std::mem::take(&mut self.sorted.multiplier);
        for (k, multiplier) in multiplier.iter_mut().enumerate() {
            let (mut density, mut gradient, mut squared) = (1.0, Vec2::ZERO, 0.0);
            self.sorted.for_each_neighbour(k, support, |_, normal, _, q| {
                let rise = (1.0 - q) * (1.0 - q);
                density += rise * (1.0 - q);
                gradient += normal * (rise * slope);
                squared += rise * slope * (rise * slope);
            });
            let error = density * inverse_density - 1.0;
            *multiplier = if error > 0.0 { error / (squared + gradient.length_squared() + softening) } else { 0.0 };
        }
        self.sorted.multiplier = multiplier;
    }

    fn find_density_shifts(&mut self) {
        let support = self.support();
        let slope = UNDER_RELAXATION * 3.0 / (support * self.rest_density);
        let nearest = MIN_SPACING * self.params.spacing;
        let mut shift = std::mem::take(&mut self.sorted.shift);
        let sorted = &self.sorted;
        for (k, shift) in shift.iter_mut().enumerate() {
            let mut sum = Vec2::ZERO;
            sorted.for_each_neighbour(k, support, |j, normal, distance, q| {
                let mut along = (sorted.multiplier[k] + sorted.multiplier[j]) * (1.0 - q) * (1.0 - q) * slope;
                if distance < nearest {
                    along += MIN_SPACING_SHARE * (nearest - distance);
                }
                sum += normal * along;
            });
            *shift = sum;
        }
        self.sorted.shift = shift;
    }

    fn find_granular_shifts(&mut self) {
        let spacing = self.params.spacing;
        let mut shift = std::mem::take(&mut self.sorted.shift);
        for (k, shift) in shift.iter_mut().enumerate() {
            let (mut sum, mut touching) = (Vec2::ZERO, 0.0);
            self.sorted.for_each_neighbour(k, spacing, |_, normal, distance, _| {
                sum += normal * (0.5 * (spacing - distance));
                touching += 1.0;
            });
            // Averaged over the contacts and over-relaxed (Macklin et al. 2014, section 4.1).
            *shift = if touching > 1.0 { sum * (1.5 / touching) } else { sum };
        }
        self.sorted.shift = shift;
    }

    /// Mean of `max(0, rho / rho_0 - 1)` over the particles.
    pub(crate) fn mean_compression(&mut self, particles: &Particles) -> f32 {
        self.find_neighbours(particles);
        let (support, inverse_density) = (self.support(), 1.0 / self.rest_density);
        let mut sum = 0.0;
        for k in 0..self.particles.len() {
            let mut density = 1.0;
            self.sorted.for_each_neighbour(k, support, |_, _, _, q| density += (1.0 - q) * (1.0 - q) * (1.0 - q));
            let error = density * inverse_density - 1.0;
            sum += if error > 0.0 { error } else { 0.0 };
        }
        if self.particles.is_empty() { 0.0 } else { sum / self.particles.len() as f32 }
    }
}

impl Sorted {
    /// Takes over the particles' present positions.
    fn gather(&mut self, particles: &Particles) {
        let entries = self.grid.entries();
        self.x.clear();
        self.x.extend(entries.iter().map(|&i| particles.position(i as usize).x));
        self.y.clear();
        self.y.extend(entries.iter().map(|&i| particles.position(i as usize).y));
        self.multiplier.resize(entries.len(), 0.0);
        self.shift.resize(entries.len(), Vec2::ZERO);
    }

    /// Squared distance that the fastest has moved since neighbours were listed.
    fn farthest_squared(&self) -> f32 {
        let now = self.x.iter().zip(&self.y);
        let moved = now.zip(&self.listed_at).map(|((&x, &y), at)| (Vec2::new(x, y) - at).length_squared());
        moved.fold(0.0, |far, squared| if squared > far { squared } else { far })
    }

    fn list_neighbours(&mut self, cutoff: f32) {
        let Self { grid, starts, neighbours, listed_at, x, y, .. } = self;
        listed_at.clear();
        listed_at.extend(x.iter().zip(y.iter()).map(|(&x, &y)| Vec2::new(x, y)));
        starts.clear();
        neighbours.clear();
        starts.push(0);
        for row in 0..grid.rows() {
            for column in 0..grid.columns() {
                let columns = column.saturating_sub(1)..column + 2;
                let below = if row > 0 { grid.row_range(row - 1, columns.clone()) } else { 0..0 };
                let ranges = [below, grid.row_range(row, columns.clone()), grid.row_range(row + 1, columns)];
                for k in grid.row_range(row, column..column + 1) {
                    for j in ranges.iter().cloned().flatten() {
                        let (dx, dy) = (x[j] - x[k], y[j] - y[k]);
                        if dx * dx + dy * dy < cutoff * cutoff && j != k {
                            neighbours.push(j as u32);
                        }
                    }
                    starts.push(neighbours.len() as u32);
                }
            }
        }
    }

    /// Calls `visit(j, n, r, q)` for each entry nearer to entry `k` than `support`: `n` is the unit vector from it to
    /// `k`, `r` the distance and `q` its share of the support.
    #[inline(always)]
    fn for_each_neighbour(&self, k: usize, support: f32, mut visit: impl FnMut(usize, Vec2, f32, f32)) {
        let (xk, yk, inverse) = (self.x[k], self.y[k], 1.0 / support);
        for &j in &self.neighbours[self.starts[k] as usize..self.starts[k + 1] as usize] {
            let j = j as usize;
            let away = Vec2::new(xk - self.x[j], yk - self.y[j]);
            let squared = away.length_squared();
            if squared < support * support {
                let distance = squared.sqrt();
                let normal = if distance > 1e-6 { away / distance } else { fallback(k, j) };
                visit(j, normal, distance, distance * inverse);
            }
        }
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
            fluid.find_neighbours(&particles);
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
        fluid.find_neighbours(&particles);
        fluid.project(&mut particles);
        assert!((0..200).all(|i| (particles.position(i) - before.position(i)).length() < 1e-6));
    }

    #[test]
    fn grains_separate_to_their_spacing() {
        let (mut fluid, mut particles) = block(FluidMode::Granular, 0.8);
        for _ in 0..200 {
            fluid.find_neighbours(&particles);
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
        fluid.params.viscosity = 60.0;
        let before = spread(&particles);
        fluid.find_neighbours(&particles);
        fluid.project(&mut particles);
        (0..10).for_each(|_| fluid.apply_viscosity(&mut particles, 1.0 / 60.0));
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
            fluid.find_neighbours(&particles);
            fluid.project(&mut particles);
        }
        let spread = (0..4).map(|i| (particles.position(i) - Vec2::ONE).length()).sum::<f32>();
        assert!(spread > 0.1 && spread.is_finite(), "spread {spread}");
    }
}
