//! Particle fluid: position-based (Macklin, Mueller 2013, "Position Based Fluids"), or granular as a cheap mode.
//!
//! With `q = |x_i - x_j| / H`, `W = (1 - q)^3` and `rho_0` the density of a hexagonal lattice at the rest spacing:
//! `C_i = sum_j W_ij / rho_0 - 1 <= 0`, `lambda_i = -C_i / (sum_k |grad_k C_i|^2 + eps)` (eqs. 1, 9 and 11 there, without
//! cohesion), `dx_i = s sum_j (lambda_i + lambda_j) grad W_ij / rho_0` (eq. 12). One kernel for density and gradient keeps
//! the projection exact; its slope at `q = 0` keeps particles from clustering. Viscosity is XSPH (eq. 17).
//!
//! Once per step particles are sorted by cell ([`neighbours`]); in each substep each of them gathers from its neighbours,
//! eight side by side, so no order of writing matters ([`density`], [`granular`]).

mod density;
mod granular;
mod neighbours;
mod settle;

use crate::error::Error;
use crate::geometry::period::Period;
use crate::instruction_set::Dispatch;
use crate::parallel;
use crate::particle::{DisjointPositions, Particles};
use crate::spec_field::FieldValue::{Number, Word};
use crate::spec_field::{FieldVisitor, check, field};
use density::{SUPPORT, Sums};
use glam::Vec2;
use neighbours::{Group, Lanes, Neighbour, Place, Sorted};
use serde::{Deserialize, Serialize};
pub(crate) use settle::settle;

/// Groups that are worked on at a time, a fixed number whatever the number of threads.
const PORTION: usize = 64;
/// Fluids that are worked on at a time, likewise: most are those of cells, and small.
const FLUIDS: usize = 16;

/// How the particles of a fluid keep apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FluidMode {
    /// Incompressible: a density constraint on each particle.
    Density,
    /// Grains: particles keep from overlapping, with friction. Several times cheaper, piles up like sand.
    Granular,
}

/// A kind of fluid. Neighbours are found once per step: what comes nearer than the support radius within a step, because
/// it moves by more than its spacing against others, is seen from the next one on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FluidParams {
    /// Distance of neighbours at rest, units, 0.05 to 100. The particles' radius is half of it.
    pub spacing: f32,
    /// Mass of a particle, 0.001 to 1000.
    pub particle_mass: f32,
    /// Rate at which velocity differences between neighbours decay, 1/s, 0 to 1000, and at most 0.5 over the substep: 240 by
    /// default.
    pub viscosity: f32,
    /// How particles keep apart.
    pub mode: FluidMode,
    /// Coulomb friction coefficient of grains, on each other and on surfaces, 0 to 10. A fluid of constant density has none.
    pub friction: f32,
}

impl Default for FluidParams {
    fn default() -> Self {
        Self { spacing: 1.0, particle_mass: 1.0, viscosity: 10.0, mode: FluidMode::Density, friction: 0.5 }
    }
}

impl FluidParams {
    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        check(*self, Self::fields)
    }

    /// Friction of its particles on surfaces.
    pub(crate) fn surface_friction(&self) -> f32 {
        if self.mode == FluidMode::Granular { self.friction } else { 0.0 }
    }

    pub(crate) fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        const MODES: [FluidMode; 2] = [FluidMode::Density, FluidMode::Granular];
        let words = "Distance of neighbours at rest, micrometres.";
        visit(field("spacing", words), Number(&mut self.spacing, [0.05, 100.0]));
        visit(field("particle_mass", "Mass of a particle."), Number(&mut self.particle_mass, [0.001, 1000.0]));
        let words = "Rate at which velocity differences between neighbours decay, 1/s.";
        visit(field("viscosity", words), Number(&mut self.viscosity, [0.0, 1000.0]));
        let words = "How particles keep apart: as a fluid of constant density, or as grains.";
        let mut mode = self.mode as usize;
        visit(field("mode", words), Word(&mut mode, &["density", "granular"]));
        self.mode = MODES[mode];
        let words = "Coulomb friction coefficient of grains, on each other and on surfaces.";
        visit(field("friction", words), Number(&mut self.friction, [0.0, 10.0]));
    }
}

/// All particles of one fluid, wherever they are.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Fluid {
    pub params: FluidParams,
    /// Whether a membrane of its own holds it.
    pub is_enclosed: bool,
    /// Indices into the particle store, in the order in which they were added.
    pub particles: Vec<u32>,
}

/// Scratch of the projection of fluids; valid for one step.
#[derive(Debug)]
pub(crate) struct Workspace {
    rest_density: f32,
    /// Factor on the spacing of each fluid in this step.
    scales: Vec<f32>,
    /// Of each fluid, found once per step.
    sorted: Vec<Sorted>,
    /// Of each portion of fluids.
    scratch: Vec<Scratch>,
}

/// What the projection of one fluid finds.
#[derive(Debug, Default)]
struct Scratch {
    neighbours: Vec<Neighbour>,
    /// Of each group's members from each of its candidates.
    distances: Vec<Lanes>,
    /// Of each group.
    sums: Vec<Sums>,
}

impl Default for Workspace {
    fn default() -> Self {
        Self { rest_density: density::lattice_density(), scales: Vec::new(), sorted: Vec::new(), scratch: Vec::new() }
    }
}

impl Fluid {
    pub(crate) fn new(params: FluidParams, is_enclosed: bool) -> Self {
        Self { params, is_enclosed, particles: Vec::new() }
    }

    /// Distance at which the kernel becomes 0, where its spacing is `scale` times that at rest.
    fn support_radius(&self, scale: f32) -> f32 {
        let spacing = self.params.spacing * scale;
        match self.params.mode {
            FluidMode::Density => SUPPORT * spacing,
            FluidMode::Granular => spacing,
        }
    }

    /// How much farther neighbours are looked for, in units of the support radius, because they move until the next search.
    /// At the border of its support the weight of the density's kernel is next to nothing; grains are hard.
    fn margin(&self) -> f32 {
        match self.params.mode {
            FluidMode::Density => 0.0,
            FluidMode::Granular => 0.25,
        }
    }

    /// Mean of `max(0, rho / rho_0 - 1)` over the particles, where their spacing is `scale` times that at rest.
    pub(crate) fn mean_compression(&self, scale: f32, particles: &Particles, period: Period) -> f32 {
        let mut sorted = Sorted::default();
        let support_radius = SUPPORT * self.params.spacing * scale;
        sorted.sort(&self.particles, particles, [Vec2::ZERO; 2], [support_radius, 0.0], period);
        let place = |i| Place { origin: particles.origin(i), offset: particles.offset(i), moved: Vec2::ZERO };
        sorted.read(place, support_radius);
        let (rest_density, mut sum) = (density::lattice_density(), 0.0);
        let mut distances = vec![Lanes::default(); sorted.candidates()];
        for group in &sorted.groups {
            let distances = &mut distances[group.candidates()];
            let compression = density::sum(group, &sorted.neighbours, distances).compression(rest_density);
            let is_own = |l: &usize| !sorted.is_image(group.members.start + l);
            sum += (0..group.members.len()).filter(is_own).map(|l| compression[l]).sum::<f32>();
        }
        if self.particles.is_empty() { 0.0 } else { sum / self.particles.len() as f32 }
    }
}

impl Workspace {
    /// Begins a step of so many fluids. Some have a spacing of their own: given are their indices, and factors on that at rest.
    pub(crate) fn scale(&mut self, fluids: usize, scales: impl Iterator<Item = (u32, f32)>) {
        self.scales.clear();
        self.scales.resize(fluids, 1.0);
        scales.for_each(|(fluid, scale)| self.scales[fluid as usize] = scale);
    }

    /// Finds the neighbours of all particles for the step that begins, between walls of which these are the lower left and the upper
    /// right corner, in a room of this period.
    pub(crate) fn find_neighbours(
        &mut self,
        fluids: &[Fluid],
        particles: &Particles,
        walls: [Vec2; 2],
        period: Period,
    ) {
        self.sorted.resize_with(fluids.len(), Sorted::default);
        self.scales.resize(fluids.len(), 1.0);
        let portions =
            fluids.chunks(FLUIDS).zip(self.scales.chunks(FLUIDS)).zip(self.sorted.chunks_mut(FLUIDS)).collect();
        parallel::for_each(portions, |((fluids, scales), sorted): ((&[Fluid], &[f32]), &mut [Sorted])| {
            for ((fluid, &scale), sorted) in fluids.iter().zip(scales).zip(sorted) {
                sorted.sort(&fluid.particles, particles, walls, [fluid.support_radius(scale), fluid.margin()], period);
            }
        });
    }

    /// One iteration of all fluids' density constraints (or of their grains' contacts), and the viscosity of a substep of
    /// `h`. No particle is in two of them.
    pub(crate) fn project(&mut self, fluids: &[Fluid], particles: &mut Particles, h: f32, dispatch: Dispatch) {
        let Self { rest_density, scales, sorted, scratch } = self;
        scratch.resize_with(fluids.len().div_ceil(FLUIDS), Scratch::default);
        let fluids = fluids.chunks(FLUIDS).zip(scales.chunks(FLUIDS));
        let portions = fluids.zip(sorted.chunks_mut(FLUIDS)).zip(scratch).collect();
        #[expect(unsafe_code, reason = "fluids are disjoint, but their particles do not lie side by side")]
        // SAFETY: a fluid is in one portion, and no particle is in two fluids.
        let positions = unsafe { DisjointPositions::new(particles.position_cells()) };
        type Portion<'a> = (((&'a [Fluid], &'a [f32]), &'a mut [Sorted]), &'a mut Scratch);
        parallel::for_each(portions, |(((fluids, scales), sorted), scratch): Portion<'_>| {
            let p = positions.cells().even();
            let place = |i| Place { origin: p.origin(i), offset: p.offset(i), moved: p.moved(i) };
            for ((fluid, &scale), sorted) in fluids.iter().zip(scales).zip(sorted) {
                let support_radius = fluid.support_radius(scale);
                // One after the other in the same memory, which is in the cache.
                std::mem::swap(&mut sorted.neighbours, &mut scratch.neighbours);
                sorted.read(place, support_radius);
                find_shifts(fluid, sorted, scratch, [*rest_density, h], dispatch);
                std::mem::swap(&mut sorted.neighbours, &mut scratch.neighbours);
                sorted.hold_images();
                sorted.shift(support_radius, p);
            }
        });
    }
}

/// Finds how far the particles of a fluid are moved in a substep of `h`.
fn find_shifts(
    fluid: &Fluid,
    sorted: &mut Sorted,
    Scratch { distances, sums, .. }: &mut Scratch,
    [rest_density, h]: [f32; 2],
    dispatch: Dispatch,
) {
    sums.resize(sorted.groups.len(), Sums::default());
    let viscosity = fluid.params.viscosity * h;
    if fluid.params.mode == FluidMode::Granular {
        find_shares(sorted, sums, dispatch);
        // Enclosed grains are those of a cell that is filled before it is spawned.
        find_granular_shifts(sorted, [viscosity, fluid.params.friction], !fluid.is_enclosed, dispatch);
        return;
    }
    distances.resize(sorted.candidates(), Lanes::default());
    find_multipliers(sorted, distances, sums, [rest_density, density::relaxation(h)], dispatch);
    let viscosity = [viscosity, rest_density];
    // A least spacing closes voids in a membrane, but free fluid boils on it when substeps are few.
    if fluid.is_enclosed {
        let share = density::spacing_share(h);
        find_density_shifts(sorted, distances, sums, viscosity, density::keep_spacing(share), dispatch);
    } else {
        find_density_shifts(sorted, distances, sums, viscosity, density::keep_no_spacing, dispatch);
    }
}

fn find_multipliers(
    sorted: &mut Sorted,
    distances: &mut [Lanes],
    sums: &mut [Sums],
    [rest_density, relaxation]: [f32; 2],
    dispatch: Dispatch,
) {
    let Sorted { groups, neighbours, walls, .. } = sorted;
    let (mut portions, mut rest) = (Vec::new(), distances);
    for (groups, sums) in groups.chunks(PORTION).zip(sums.chunks_mut(PORTION)) {
        let candidates = groups.iter().map(|group| group.candidates().len()).sum();
        let (distances, others) = rest.split_at_mut(candidates);
        portions.push((groups, sums, distances));
        rest = others;
    }
    parallel::for_each(portions, |(groups, sums, mut distances): (&[Group], &mut [Sums], &mut [Lanes])| {
        dispatch.run(
            #[inline(always)]
            || {
                for (group, sums) in groups.iter().zip(sums) {
                    let (own, others) = distances.split_at_mut(group.candidates().len());
                    distances = others;
                    *sums = density::sum(group, neighbours, own);
                    sums.add_walls(group, neighbours, walls);
                    sums.find_multipliers(rest_density, relaxation);
                }
            },
        );
    });
    tell_neighbours(sorted, sums);
}

fn find_shares(sorted: &mut Sorted, sums: &mut [Sums], dispatch: Dispatch) {
    let Sorted { groups, neighbours, .. } = sorted;
    for_each_group(
        groups,
        sums,
        dispatch,
        #[inline(always)]
        |_, group, sums| sums.multiplier = granular::shares(group, neighbours),
    );
    tell_neighbours(sorted, sums);
}

/// Writes what was found for each particle where its neighbours read it.
fn tell_neighbours(sorted: &mut Sorted, sums: &[Sums]) {
    let Sorted { groups, neighbours, .. } = sorted;
    for (group, sums) in groups.iter().zip(sums) {
        for (neighbour, multiplier) in neighbours[group.members.clone()].iter_mut().zip(sums.multiplier) {
            neighbour.multiplier = multiplier;
        }
    }
    sorted.tell_images();
}

fn find_density_shifts(
    Sorted { groups, neighbours, shifts, .. }: &mut Sorted,
    distances: &[Lanes],
    sums: &[Sums],
    viscosity: [f32; 2],
    added: impl Fn(f32, f32) -> f32 + Copy + Sync + Send,
    dispatch: Dispatch,
) {
    for_each_group(
        groups,
        shifts,
        dispatch,
        #[inline(always)]
        |k, group, shifts| {
            let distances = &distances[group.candidates()];
            *shifts = density::shifts(group, neighbours, distances, &sums[k], viscosity, added);
        },
    );
}

fn find_granular_shifts(
    Sorted { groups, neighbours, shifts, .. }: &mut Sorted,
    viscosity_and_friction: [f32; 2],
    keeps_momentum: bool,
    dispatch: Dispatch,
) {
    for_each_group(
        groups,
        shifts,
        dispatch,
        #[inline(always)]
        |_, group, shifts| {
            *shifts = granular::shifts(group, neighbours, viscosity_and_friction, keeps_momentum);
        },
    );
}

/// Finds something for each group. The kernel gets a group, its place, and what is to be written.
fn for_each_group<T: Send>(
    groups: &[Group],
    found: &mut [T],
    dispatch: Dispatch,
    kernel: impl Fn(usize, &Group, &mut T) + Send + Sync,
) {
    let portions = groups.chunks(PORTION).zip(found.chunks_mut(PORTION)).zip((0..).step_by(PORTION)).collect();
    parallel::for_each(portions, |((groups, found), first): ((&[Group], &mut [T]), usize)| {
        dispatch.run(
            #[inline(always)]
            || {
                for ((group, found), k) in groups.iter().zip(found).zip(first..) {
                    kernel(k, group, found);
                }
            },
        );
    });
}

/// Area that a number of particles take up at rest: each has its share of a hexagonal lattice.
pub(crate) fn rest_area(count: usize, spacing: f32) -> f32 {
    count as f32 * spacing * spacing * 0.75f32.sqrt()
}

#[cfg(test)]
mod tests;
