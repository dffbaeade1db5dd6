//! Lanes: one kernel for eight bodies of a block at once, or for one list of loose particles.
//!
//! ```text
//! slot a  |0 1 2 3 4 5 6 7|      L = 8: the same constraint of eight instances of a template; the inner loops over lanes
//! slot b  |0 1 2 3 4 5 6 7|             compile to vector instructions
//!         one constraint         L = 1: base 0, so that a slot is a particle index; the generic path, same arithmetic
//! ```
//!
//! The number of lanes is fixed in `particle/block_range.rs` and never taken from the CPU: results do not depend on it.

use crate::instruction_set::each;
use crate::particle::Columns;
pub(crate) use crate::particle::LANES;

/// Where the slots of a constraint list lie in the particle store, and how large each instance is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span<const L: usize> {
    /// Not a `usize`: then the compiler sees that [`Span::at`] cannot overflow, and checks less.
    pub base: u32,
    /// Factor on every length of the instance.
    pub scale: [f32; L],
}

impl Span<1> {
    /// Slots are particle indices.
    pub(crate) const LOOSE: Self = Self { base: 0, scale: [1.0] };
}

impl<const L: usize> Span<L> {
    #[inline(always)]
    pub(crate) fn at(&self, slot: u32) -> usize {
        self.base as usize + slot as usize * L
    }
}

/// The `L` entries of a column from `at` on.
#[inline(always)]
pub(crate) fn load<const L: usize>(column: &[f32], at: usize) -> [f32; L] {
    let mut lanes = [0.0; L];
    lanes.copy_from_slice(&column[at..at + L]);
    lanes
}

/// Sets the `L` entries of a column from `at` on.
#[inline(always)]
pub(crate) fn store<const L: usize>(column: &mut [f32], at: usize, values: [f32; L]) {
    column[at..at + L].copy_from_slice(&values);
}

/// Adds `amount` to the `L` entries of a column from `at` on.
#[inline(always)]
pub(crate) fn add<const L: usize>(column: &mut [f32], at: usize, amount: [f32; L]) {
    for (entry, amount) in column[at..at + L].iter_mut().zip(amount) {
        *entry += amount;
    }
}

/// Two slots and the vector from the first to the second, in each lane. It is left unnormalised: what moves the two
/// along it is divided by its length together with the rest of the multiplier, once.
pub(crate) struct Pair<const L: usize> {
    a: usize,
    b: usize,
    across_x: [f32; L],
    across_y: [f32; L],
    inv_mass_a: [f32; L],
    inv_mass_b: [f32; L],
    /// Squared length.
    pub(crate) squared: [f32; L],
}

impl<const L: usize> Pair<L> {
    #[inline(always)]
    pub(crate) fn load(particles: &Columns<'_>, a: usize, b: usize) -> Self {
        let [across_x, across_y] = particles.between_lanes::<L>(a, b);
        let squared = each(|l| across_x[l] * across_x[l] + across_y[l] * across_y[l]);
        let (inv_mass_a, inv_mass_b) = (load(particles.inv_mass, a), load(particles.inv_mass, b));
        Self { a, b, across_x, across_y, inv_mass_a, inv_mass_b, squared }
    }

    /// Distance of the two slots.
    #[inline(always)]
    pub(crate) fn length(&self, lane: usize) -> f32 {
        self.squared[lane].sqrt()
    }

    /// Whether the two slots are farther apart than a length in any lane.
    #[inline(always)]
    pub(crate) fn is_longer(&self, than: [f32; L]) -> bool {
        let mut longer = false;
        for (squared, than) in self.squared.iter().zip(&than) {
            longer |= *squared > than * than;
        }
        longer
    }

    /// Whether the two slots are nearer than a length in any lane.
    #[inline(always)]
    pub(crate) fn is_shorter(&self, than: [f32; L]) -> bool {
        let mut shorter = false;
        for (squared, than) in self.squared.iter().zip(&than) {
            shorter |= *squared < than * than;
        }
        shorter
    }

    /// Sum of the two inverse masses.
    #[inline(always)]
    pub(crate) fn weight(&self, lane: usize) -> f32 {
        self.inv_mass_a[lane] + self.inv_mass_b[lane]
    }

    /// How far the two slots have moved apart, along the line between them, since the substep began; times their distance.
    #[inline(always)]
    pub(crate) fn opening(&self, particles: &Columns<'_>) -> [f32; L] {
        let dx = self.parted(particles.x, particles.prev_x);
        let dy = self.parted(particles.y, particles.prev_y);
        each(|l| dx[l] * self.across_x[l] + dy[l] * self.across_y[l])
    }

    /// How far the two slots have moved apart in one coordinate.
    #[inline(always)]
    fn parted(&self, column: &[f32], prev: &[f32]) -> [f32; L] {
        let (a, b) = (load::<L>(column, self.a), load::<L>(column, self.b));
        let (a_prev, b_prev) = (load::<L>(prev, self.a), load::<L>(prev, self.b));
        each(|l| (b[l] - b_prev[l]) - (a[l] - a_prev[l]))
    }

    /// By how much the square of their distance has grown since the substep began.
    #[inline(always)]
    pub(crate) fn growth(&self, particles: &Columns<'_>) -> [f32; L] {
        let dx = self.parted(particles.x, particles.prev_x);
        let dy = self.parted(particles.y, particles.prev_y);
        each(|l| dx[l] * (2.0 * self.across_x[l] - dx[l]) + dy[l] * (2.0 * self.across_y[l] - dy[l]))
    }

    /// The two where they were when the substep began; where they are, in lanes where they have moved by half their distance or
    /// more against each other since.
    #[inline(always)]
    pub(crate) fn earlier(&self, particles: &Columns<'_>) -> Self {
        let dx = self.parted(particles.x, particles.prev_x);
        let dy = self.parted(particles.y, particles.prev_y);
        let (x, y) = (each::<L>(|l| self.across_x[l] - dx[l]), each::<L>(|l| self.across_y[l] - dy[l]));
        let moved = each::<L>(|l| dx[l] * dx[l] + dy[l] * dy[l]);
        let before = each::<L>(|l| x[l] * x[l] + y[l] * y[l]);
        let is_near = |l: usize| 4.0 * moved[l] < before[l];
        Self {
            across_x: each(|l| if is_near(l) { x[l] } else { self.across_x[l] }),
            across_y: each(|l| if is_near(l) { y[l] } else { self.across_y[l] }),
            squared: each(|l| if is_near(l) { before[l] } else { self.squared[l] }),
            ..*self
        }
    }

    /// Scalar product of the vectors of two pairs.
    #[inline(always)]
    pub(crate) fn dot(&self, other: &Self, lane: usize) -> f32 {
        self.across_x[lane] * other.across_x[lane] + self.across_y[lane] * other.across_y[lane]
    }

    /// Moves both slots apart by `share` of the vector between them, times their inverse masses (together if negative).
    #[inline(always)]
    pub(crate) fn push(&self, particles: &mut Columns<'_>, share: [f32; L]) {
        let mut shift = [[0.0; L]; 4];
        for l in 0..L {
            let (ma, mb) = (-share[l] * self.inv_mass_a[l], share[l] * self.inv_mass_b[l]);
            shift[0][l] = ma * self.across_x[l];
            shift[1][l] = ma * self.across_y[l];
            shift[2][l] = mb * self.across_x[l];
            shift[3][l] = mb * self.across_y[l];
        }
        add(particles.x, self.a, shift[0]);
        add(particles.y, self.a, shift[1]);
        add(particles.x, self.b, shift[2]);
        add(particles.y, self.b, shift[3]);
    }
}

/// Brings two slots to within a length of each other in the lanes where they are farther apart.
#[inline(always)]
pub(crate) fn pull_within<const L: usize>(
    [a, b]: [u32; 2],
    length: f32,
    alpha: f32,
    spans: &[Span<L>],
    particles: &mut Columns<'_>,
) {
    for span in spans {
        let pair = Pair::<L>::load(particles, span.at(a), span.at(b));
        let longest = each::<L>(|l| length * span.scale[l]);
        if pair.is_longer(longest) {
            let length = each::<L>(|l| pair.length(l));
            let error = each::<L>(|l| longest[l] - length[l]);
            let active = each::<L>(|l| if error[l] < 0.0 { error[l] } else { -0.0 });
            let share = each(|l| ratio(active[l], length[l] * (pair.weight(l) + alpha)));
            pair.push(particles, share);
        }
    }
}

/// `numerator / denominator`, or 0 where nothing can move.
#[inline(always)]
pub(crate) fn ratio(numerator: f32, denominator: f32) -> f32 {
    if denominator > 0.0 { numerator / denominator } else { 0.0 }
}
