//! What there is besides organisms: uneven glass, dust, and things far out of focus. It fills the plane; nothing of it
//! is stored.

use super::spot::Spot;
use super::thread::Thread;
use crate::bare_text::bare_text;
use crate::geometry::{rotate, unit_vector};
use crate::look::SpotShape;
use crate::microscope::glsl::Glsl;
use crate::microscope::maths::{larger, smaller, smoothstep};
use crate::microscope::matter::{Matter, MatterRaster};
use crate::microscope::noise::{HashRng, hash, octaves, shift_of, wobble};
use crate::microscope::recipe::{DrawList, Program, QUAD};
use glam::{IVec2, Vec2};

/// Logarithm of what slides have of these on average, and its spread.
const DIRTY: [f32; 2] = [-0.45, 0.85];
/// Side of the cells in which single specks are strewn, micrometres, and specks in each on average.
const DUST_CELL: f32 = 5.0;
const DUST: f32 = 0.65;
/// The same for clumps of debris. Where they are thick and where they are rare changes over a distance.
const CLUMP_CELL: f32 = 12.0;
const CLUMPS: f32 = 3.6;
const PATCHES: f32 = 34.0;
/// Grains of a clump: a share of `1 / n` has more than `n`, by this power, up to the most.
const GRAINS_POWER: f32 = 0.95;
const MOST_GRAINS: usize = 70;
/// Median radius of a grain, micrometres, and delay, radians; grains of large clumps are fainter by this power of their number.
const GRAIN: f32 = 0.13;
const GRAIN_DENSE: f32 = 0.10;
const LOOSE: f32 = 0.2;
/// Of this many grains last added to a clump one is where the next grows.
const TIPS: usize = 5;
/// The same for what is out of focus.
const FAR_CELL: f32 = 26.0;
const FAR: f32 = 0.9;
/// The same for fibres, and the points of each.
const FIBRE_CELL: f32 = 60.0;
const FIBRES: f32 = 0.35;
const FIBRE_POINTS: usize = 14;
/// Median distance of these, micrometres, and the standard deviation of its logarithm.
const FIBRE_STEP: f32 = 0.5;
const FIBRE_SPREAD: f32 = 0.8;
/// The same for scratches of the glass, and their longest, micrometres.
const SCRATCH_CELL: f32 = 60.0;
const SCRATCHES: f32 = 0.35;
const LONGEST_SCRATCH: f32 = 55.0;
/// The same for streaks, which all run about one way: where a fluid dried, or where the slide was wiped.
const STREAK_CELL: f32 = 110.0;
const STREAKS: f32 = 1.1;
const LONGEST_STREAK: f32 = 100.0;
/// Points of the line that a scratch or a streak is.
const LINE_POINTS: usize = 6;
/// Share of the camera's movement that things out of focus seem to make.
const PARALLAX: f32 = 0.15;
/// What of a thing out of focus takes up dye, for each radian of its delay.
const FAR_DYED: f32 = 1.3;
/// Pixels from and to which dust fades because it is too small to be seen, and those where the other things are,
/// micrometres.
const DUST_FADES: [f32; 2] = [0.5, 1.0];
const FAR_ENDS: f32 = 2.0;
/// Strength and size of the glass's unevenness, radians and micrometres.
const FINE: f32 = 0.007;
const FINE_SIZE: f32 = 1.2;
const COARSE: f32 = 0.035;
const COARSE_SIZE: f32 = 15.0;

pub(in crate::microscope) const GLSL: Glsl = Glsl {
    source: bare_text!("background.glsl", "//"),
    constants: &[
        ("FINE", &[FINE]),
        ("FINE_SIZE", &[FINE_SIZE]),
        ("COARSE", &[COARSE]),
        ("COARSE_SIZE", &[COARSE_SIZE]),
    ],
};

/// The background of one picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct BackgroundMatter {
    pub seed: u32,
    pub time: f32,
    /// What the camera looks at.
    pub camera: Vec2,
}

impl BackgroundMatter {
    pub(super) fn draw(&self, raster: &mut MatterRaster) {
        let grid = raster.grid;
        // Features below a pixel would alias.
        let fine = FINE * smoothstep(1.2, 0.3, grid.pixel);
        let coarse = COARSE * smoothstep(15.0, 4.0, grid.pixel);
        for y in 0..grid.rows {
            for x in 0..grid.columns {
                let place = grid.place(x, y);
                let slow = if coarse > 0.0 { coarse * octaves(place / COARSE_SIZE, 3, self.seed) } else { 0.0 };
                let quick = if fine > 0.0 { fine * octaves(place / FINE_SIZE, 3, self.seed ^ 9) } else { 0.0 };
                raster.matter[y * grid.columns + x].phase += slow + quick;
            }
        }
        let (spots, threads) = self.things(grid.bounds(), grid.pixel);
        spots.iter().for_each(|spot| spot.draw(raster));
        threads.iter().for_each(|thread| thread.draw(raster));
    }

    /// Its triangles, for [`GLSL`].
    pub(super) fn draw_on(&self, draws: &mut DrawList, bias: [f32; 4]) {
        let mut uniforms = bias.to_vec();
        uniforms.extend([shift_of(self.seed), shift_of(self.seed ^ 9)].concat());
        let corners = [-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0];
        draws.add_apart(Program::Background, &corners, QUAD.to_vec(), uniforms, None);
        let (spots, threads) = self.things(draws.bounds(), draws.pixel());
        spots.iter().for_each(|spot| spot.draw_on(draws));
        threads.iter().for_each(|thread| thread.draw_on(draws));
    }

    /// Debris, and what is out of focus, in a box.
    fn things(&self, bounds: (Vec2, Vec2), pixel: f32) -> (Vec<Spot>, Vec<Thread>) {
        let (mut spots, mut threads) = (Vec::new(), Vec::new());
        let strength = smoothstep(DUST_FADES[1], DUST_FADES[0], pixel);
        // Some slides are clean.
        let mut rng = HashRng::new(self.seed ^ 20);
        let mut dirty = |expected: f32| expected * libm::expf(DIRTY[0] + DIRTY[1] * rng.normal());
        let (dust, clumps, far) = (dirty(DUST), dirty(CLUMPS), dirty(FAR));
        if strength > 0.0 {
            strewn(bounds, Vec2::ZERO, [DUST_CELL, dust], self.seed ^ 21, |at, rng| {
                self.speck(at, strength, rng, &mut spots);
            });
            strewn(bounds, Vec2::ZERO, [CLUMP_CELL, clumps], self.seed ^ 23, |at, rng| {
                self.clump(at, strength, rng, &mut spots);
            });
            strewn(bounds, Vec2::ZERO, [FIBRE_CELL, FIBRES], self.seed ^ 24, |at, rng| {
                threads.extend(fibre(at, strength, rng));
            });
            strewn(bounds, Vec2::ZERO, [SCRATCH_CELL, SCRATCHES], self.seed ^ 26, |at, rng| {
                threads.extend(scratch(at, strength, rng));
            });
            let along = HashRng::new(self.seed ^ 27).direction();
            strewn(bounds, Vec2::ZERO, [STREAK_CELL, STREAKS], self.seed ^ 28, |at, rng| {
                threads.extend(streak(at, along, strength, rng));
            });
        }
        if pixel < FAR_ENDS {
            let shift = self.camera * PARALLAX;
            strewn(bounds, shift, [FAR_CELL, far], self.seed ^ 22, |at, rng| self.far(at, rng, &mut spots));
        }
        (spots, threads)
    }

    /// A speck of dust: mostly tiny, some denser than the medium and some less, few of them round.
    fn speck(&self, at: Vec2, strength: f32, rng: &mut HashRng, spots: &mut Vec<Spot>) {
        let size = rng.unit();
        let radius = 0.07 + 0.3 * size * size * size;
        let sign = if rng.unit() < 0.75 { strength } else { -strength };
        let matter = Matter { nucleus: 0.04 * sign, ..Matter::phase(sign * rng.range([0.04, 0.22])) };
        let chirp = if rng.unit() < 0.08 { rng.range([2.5, 7.0]) } else { 0.0 };
        let grains = if chirp > 0.0 { 1 } else { 1 + rng.bits() % 3 };
        let mut at = at;
        for _ in 0..grains {
            let spot = Spot { at, radius: radius * rng.range([0.5, 1.0]), matter, shape: SpotShape::Bump };
            spots.push(if chirp > 0.0 { spot.out_of_focus(chirp) } else { spot });
            at += rng.direction() * radius;
        }
    }

    /// Grains that grew on each other, more or less along one way, all of a kind, in focus or out of it.
    fn clump(&self, at: Vec2, strength: f32, rng: &mut HashRng, spots: &mut Vec<Spot>) {
        let share = smoothstep(-0.5, 0.6, octaves(at / PATCHES, 2, self.seed ^ 25));
        let count = smaller(1.6 * share * grains(rng.unit()), MOST_GRAINS as f32);
        let size = GRAIN * libm::expf(0.5 * rng.normal());
        let dense = GRAIN_DENSE * libm::expf(0.6 * rng.normal() - LOOSE * libm::logf(1.0 + count)) * strength;
        let along = rng.direction() * (1.6 * rng.unit());
        let dyed = if rng.unit() < 0.22 { dense } else { 0.08 * dense };
        let matter = Matter { phase: dense, haemoglobin: 0.35 * dyed, cytoplasm: 0.0, nucleus: 0.7 * dyed };
        let chirp = if rng.unit() < 0.12 { rng.range([2.5, 8.0]) } else { 0.0 };
        let mut tips = [at; TIPS];
        for k in 0..count as usize {
            let from = tips[rng.bits() as usize % TIPS];
            let at = from + (rng.direction() + along).normalize_or_zero() * (size * rng.range([0.6, 1.9]));
            tips[k % TIPS] = at;
            let radius = size * libm::expf(0.5 * rng.normal());
            let matter = matter * rng.range([0.2, 1.3]);
            spots.push(if chirp == 0.0 {
                Spot { at, radius, matter, shape: SpotShape::Bump }
            } else {
                // The same matter over a wider disc.
                Spot { at, radius: radius + 0.16 * chirp, matter: matter * 0.3, shape: SpotShape::Defocused(chirp) }
            });
        }
    }

    /// A cell or a clump above or below the plane of focus: rings of its parts, which drift slowly.
    fn far(&self, at: Vec2, rng: &mut HashRng, spots: &mut Vec<Spot>) {
        let seed = rng.bits();
        let drift = Vec2::new(wobble(self.time / 25.0, seed), wobble(self.time / 25.0, seed ^ 1)) * 3.0;
        let radius = rng.range([1.6, 4.5]);
        let shape = if rng.unit() < 0.4 { SpotShape::Bump } else { SpotShape::Defocused(rng.range([3.0, 7.5])) };
        // Some are clumps, others rows.
        let along = rng.direction() * (1.2 * rng.unit());
        let mut at = at + drift;
        for _ in 0..1 + rng.bits() % 4 {
            let dense = rng.range([0.03, 0.11]);
            let matter = Matter { cytoplasm: FAR_DYED * dense, ..Matter::phase(dense) };
            spots.push(Spot { at, radius: radius * rng.range([0.6, 1.1]), matter, shape });
            at += (rng.direction() + along) * (0.4 * radius);
        }
    }
}

/// Grains of a clump, of a number from 0 to 1.
fn grains(share: f32) -> f32 {
    libm::powf(larger(share, 1e-3), -GRAINS_POWER)
}

/// A fibre that wanders over the glass, with strands that part from its end, in focus or not.
fn fibre(at: Vec2, strength: f32, rng: &mut HashRng) -> Vec<Thread> {
    let step = FIBRE_STEP * libm::expf(FIBRE_SPREAD * rng.normal());
    let bend = 0.28 * rng.normal();
    let blur = if rng.unit() < 0.35 { rng.range([2.0, 5.0]) } else { 1.0 };
    let radius = 0.09 * libm::expf(0.35 * rng.normal()) * blur;
    let dense = strength * rng.range([0.03, 0.15]) / blur;
    let matter = Matter { nucleus: 0.15 * dense, ..Matter::phase(dense) };
    let trunk = wander(at, rng.direction() * step, bend, rng);
    let parts = Thread::curve(&trunk, |_| radius, matter).collect::<Vec<_>>();
    let mut threads: Vec<Thread> =
        parts.into_iter().map(|part| Thread { matter: part.matter * rng.range([0.1, 1.4]), ..part }).collect();
    for _ in 0..rng.bits() % 3 {
        let from = FIBRE_POINTS - 2 - rng.bits() as usize % (FIBRE_POINTS / 2);
        let way = rotate(trunk[from + 1] - trunk[from], unit_vector(0.5 * rng.normal()));
        let strand = wander(trunk[from], way * rng.range([0.2, 0.5]), bend, rng);
        threads.extend(Thread::curve(&strand, |_| 0.7 * radius, matter * 0.6));
    }
    threads
}

/// Points on a way that bends this much at each step, more or less.
fn wander(at: Vec2, step: Vec2, bend: f32, rng: &mut HashRng) -> [Vec2; FIBRE_POINTS] {
    let (mut at, mut step) = (at, step);
    std::array::from_fn(|_| {
        at += step;
        step = rotate(step, unit_vector(bend + 0.3 * rng.normal()));
        at
    })
}

/// A scratch: thin, bent a little, deeper here and shallower there.
fn scratch(at: Vec2, strength: f32, rng: &mut HashRng) -> Vec<Thread> {
    let radius = rng.range([0.05, 0.16]);
    let length = LONGEST_SCRATCH * libm::expf(0.8 * rng.normal() - 1.4);
    let deep = strength * rng.range([-0.16, 0.10]);
    let turn = 0.13 * rng.normal();
    line(at, rng.direction() * smaller(length, LONGEST_SCRATCH), [turn, 0.05], radius, deep, rng)
}

/// A streak: broad, soft and faint.
fn streak(at: Vec2, along: Vec2, strength: f32, rng: &mut HashRng) -> Vec<Thread> {
    let direction = rotate(along, unit_vector(0.12 * rng.normal()));
    let radius = 0.9 * libm::expf(0.7 * rng.normal());
    let dense = strength * rng.range([-0.05, 0.06]);
    line(at, direction * rng.range([0.3 * LONGEST_STREAK, LONGEST_STREAK]), [0.0, 0.04], radius, dense, rng)
}

/// A line that turns by an angle at each of its points, more or less, in parts of different depth.
fn line(at: Vec2, way: Vec2, [turn, uneven]: [f32; 2], radius: f32, phase: f32, rng: &mut HashRng) -> Vec<Thread> {
    let (mut at, mut step) = (at, way / (LINE_POINTS - 1) as f32);
    let mut point = || {
        let point = at;
        at += step;
        step = rotate(step, unit_vector(turn + uneven * rng.normal()));
        point
    };
    let points: [Vec2; LINE_POINTS] = std::array::from_fn(|_| point());
    let parts = Thread::curve(&points, |_| radius, Matter::phase(phase)).collect::<Vec<_>>();
    parts.into_iter().map(|part| Thread { matter: part.matter * rng.range([0.0, 1.0]), ..part }).collect()
}

/// Visits the things in the cells of an endless square grid that a box touches, so many in each on average; `shift` moves
/// the grid.
pub(super) fn strewn(
    (low, high): (Vec2, Vec2),
    shift: Vec2,
    [cell, expected]: [f32; 2],
    seed: u32,
    mut visit: impl FnMut(Vec2, &mut HashRng),
) {
    let [first, last] = [low, high].map(|corner| ((corner - shift) / cell).floor().as_ivec2());
    for j in first.y - 1..=last.y + 1 {
        for i in first.x - 1..=last.x + 1 {
            let mut rng = HashRng::new(hash(IVec2::new(i, j), seed));
            let count = (2.0 * expected * rng.unit() + 0.5) as u32;
            for _ in 0..count {
                let at = (Vec2::new(i as f32, j as f32) + Vec2::new(rng.unit(), rng.unit())) * cell + shift;
                visit(at, &mut rng);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_debris_is_tiny_and_little_of_it_large() {
        let background = BackgroundMatter { seed: 1, time: 0.0, camera: Vec2::ZERO };
        let clumps: Vec<usize> = (0..4000)
            .map(|seed| {
                let mut spots = Vec::new();
                let at = Vec2::new((seed % 64) as f32, (seed / 64) as f32) * 9.0;
                background.clump(at, 1.0, &mut HashRng::new(seed), &mut spots);
                spots.len()
            })
            .collect();
        let more_than = |grains: usize| clumps.iter().filter(|&&count| count > grains).count();
        // A power law: four times as large, about a quarter as many.
        let numbers = [1, 7, 31].map(more_than);
        assert!(numbers.windows(2).all(|pair| (3..7).contains(&(pair[0] / pair[1].max(1)))), "{numbers:?}");
        assert!(clumps.iter().all(|&count| count <= MOST_GRAINS));
    }

    #[test]
    fn fibres_are_bent_and_of_many_lengths() {
        let trunks: Vec<Vec<Thread>> = (0..100).map(|seed| fibre(Vec2::ZERO, 1.0, &mut HashRng::new(seed))).collect();
        let points = |fibre: &Vec<Thread>| [fibre[0].from, fibre[FIBRE_POINTS - 2].to];
        let step = |fibre: &Vec<Thread>| (fibre[0].to - fibre[0].from).length();
        let mut steps: Vec<f32> = trunks.iter().map(step).collect();
        steps.sort_by(f32::total_cmp);
        assert!(steps[90] > 3.0 * steps[10], "{} {}", steps[10], steps[90]);
        let is_straight = |fibre: &&Vec<Thread>| {
            let [from, to] = points(fibre);
            (to - from).length() > 0.95 * step(fibre) * (FIBRE_POINTS - 1) as f32
        };
        assert!(trunks.iter().filter(is_straight).count() < 25);
        let frayed = trunks.iter().filter(|fibre| fibre.len() > FIBRE_POINTS - 1).count();
        assert!((40..90).contains(&frayed), "{frayed}");
    }
}
