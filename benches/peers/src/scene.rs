//! What every engine is given: the platelet field, the fluid block and the crowd, in numbers, without any engine's terms.

pub(crate) mod crowd;

use microsim_core::Rng;
use microsim_core::glam::Vec2;
use std::f32::consts::{PI, TAU};

/// Time of one step, s.
pub(crate) const DT: f32 = 1.0 / 60.0;

/// Satellites in a platelet's ring.
pub(crate) const SATELLITES: usize = 28;
/// Discs of a platelet: nucleus, interlayer, satellites.
pub(crate) const DISCS: usize = 2 + SATELLITES;
/// Outer radius of a platelet.
pub(crate) const OUTER_RADIUS: f32 = 2.66;
/// Distance of neighbouring platelets: they nearly touch.
const PITCH: f32 = 5.6;
/// Each is shifted at random by up to this, which brings none into contact.
const JITTER: f32 = 0.12;
/// Free room around the field.
const MARGIN: f32 = 6.0;
/// Mass of nucleus and of interlayer, each, in satellites.
pub(crate) const CORE_MASS: f32 = 40.0;
/// Inverse stiffness of the spokes.
pub(crate) const SPOKE_COMPLIANCE: f32 = 2e-4;
/// Inverse stiffness with which a platelet returns to its anchor.
pub(crate) const ANCHOR_COMPLIANCE: f32 = 2e-2;
/// Longest way from the anchor, in outer radii.
pub(crate) const ROPE_LENGTH: f32 = 4.0;
/// Between all discs.
pub(crate) const FRICTION: f32 = 0.2;
/// Drag of the medium, 1/s.
pub(crate) const DAMPING: f32 = 0.5;
/// Share of critical damping of the spokes where an engine asks for one: about what implicit integration has at a substep
/// of 2 ms, so that none rings on.
pub(crate) const SPOKE_DAMPING_RATIO: f32 = 0.1;
/// Share of a satellite's radius that stays free between ring and interlayer.
const INTERLAYER_GAP: f32 = 0.1;

/// One pusher for each started hundred of platelets: the share of the field that is stirred does not depend on its size.
const PLATELETS_PER_PUSHER: usize = 100;

/// The disc that stirs: its drive is finite, so it pushes its way and gives way where it cannot.
pub(crate) struct Pusher;

impl Pusher {
    pub(crate) const RADIUS: f32 = 1.5 * OUTER_RADIUS;
    pub(crate) const MASS: f32 = 240.0;
    /// One platelet's diameter per second.
    pub(crate) const SPEED: f32 = 2.0 * OUTER_RADIUS;
    pub(crate) const MAX_ACCELERATION: f32 = 400.0;

    /// Force for one step: towards the goal at its speed, as far as its drive is able.
    pub(crate) fn force(at: Vec2, velocity: Vec2, goal: Vec2) -> Vec2 {
        let change = (goal - at).normalize_or_zero() * Self::SPEED - velocity;
        (change / DT).clamp_length_max(Self::MAX_ACCELERATION) * Self::MASS
    }
}

/// The way of a pusher: from the middle of its patch out onto a circle, and around.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweep {
    /// Of its circle.
    centre: Vec2,
    radius: f32,
}

impl Sweep {
    /// Next to its first platelets.
    pub(crate) fn start(self) -> Vec2 {
        self.centre + Vec2::X * 2.0
    }

    /// Where it heads for: this goes around at its own speed.
    fn goal(self, step: u64) -> Vec2 {
        self.centre + Vec2::from_angle(step as f32 * DT * Pusher::SPEED / self.radius) * self.radius
    }
}

/// A field of platelets and what stirs it.
#[derive(Clone, Debug)]
pub(crate) struct PlateletField {
    /// Of the walled room; its lower left corner is the origin.
    pub size: Vec2,
    pub centres: Vec<Vec2>,
    pub sweeps: Vec<Sweep>,
}

impl PlateletField {
    pub(crate) fn new(platelets: usize) -> Self {
        let pushers = platelets.div_ceil(PLATELETS_PER_PUSHER);
        let cells = platelets + 4 * pushers;
        let columns = (cells as f32).sqrt().ceil() as usize;
        let rows = cells.div_ceil(columns);
        let corner =
            |column: usize, row: usize| Vec2::splat(MARGIN) + Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * PITCH;
        let holes = holes(pushers, columns, rows);
        let is_free = |column: usize, row: usize| {
            holes.iter().any(|&(x, y)| (x..x + 2).contains(&column) && (y..y + 2).contains(&row))
        };
        let mut rng = Rng::new(1, 0);
        let centres = (0..rows)
            .flat_map(|row| (0..columns).map(move |column| (column, row)))
            .filter(|&(column, row)| !is_free(column, row))
            .take(platelets)
            .map(|(c, r)| corner(c, r) + Vec2::new(rng.range(-JITTER, JITTER), rng.range(-JITTER, JITTER)))
            .collect();
        let patch = PITCH * (cells as f32 / pushers as f32).sqrt();
        let sweep = |&(x, y): &(usize, usize)| Sweep { centre: corner(x, y) + 0.5 * PITCH, radius: 0.3 * patch };
        let size = Vec2::new(columns as f32, rows as f32) * PITCH + 2.0 * MARGIN;
        Self { size, centres, sweeps: holes.iter().map(sweep).collect() }
    }

    /// Where the pushers head for.
    pub(crate) fn goals(&self, step: u64) -> Vec<Vec2> {
        self.sweeps.iter().map(|sweep| sweep.goal(step)).collect()
    }

    /// Where they head for to leave everybody alone.
    pub(crate) fn parked(&self) -> Vec<Vec2> {
        self.sweeps.iter().map(|sweep| sweep.centre).collect()
    }
}

/// Lower left cells of the two-by-two holes in which pushers start: in the middles of equal patches.
fn holes(pushers: usize, columns: usize, rows: usize) -> Vec<(usize, usize)> {
    let across = (pushers as f32).sqrt().ceil() as usize;
    let lines = pushers.div_ceil(across);
    let middle = |k: usize, of: usize, cells: usize| (2 * k + 1) * cells / (2 * of) - 1;
    (0..pushers)
        .map(|k| {
            let in_line = if k / across + 1 < lines { across } else { pushers - k / across * across };
            (middle(k % across, in_line, columns), middle(k / across, lines, rows))
        })
        .collect()
}

/// Measures of a platelet that follow from its outer radius: neighbouring satellites touch.
pub(crate) struct Platelet;

impl Platelet {
    fn half_angle_sine() -> f32 {
        (PI / SATELLITES as f32).sin()
    }

    pub(crate) fn ring_radius() -> f32 {
        OUTER_RADIUS / (1.0 + Self::half_angle_sine())
    }

    pub(crate) fn satellite_radius() -> f32 {
        Self::ring_radius() * Self::half_angle_sine()
    }

    pub(crate) fn interlayer_radius() -> f32 {
        Self::ring_radius() - (1.0 + INTERLAYER_GAP) * Self::satellite_radius()
    }

    /// Centres of the satellites around the platelet's.
    pub(crate) fn ring() -> impl Iterator<Item = Vec2> {
        (0..SATELLITES).map(|k| Vec2::from_angle(TAU * k as f32 / SATELLITES as f32) * Self::ring_radius())
    }
}

/// A block of fluid at the left wall of a tank, on a hexagonal lattice at its rest density.
#[derive(Clone, Debug)]
pub(crate) struct FluidBlock {
    /// Of the tank; its lower left corner is the origin.
    pub tank: Vec2,
    /// Of the block, which stands in the tank's lower left corner.
    pub size: Vec2,
    pub points: Vec<Vec2>,
}

impl FluidBlock {
    /// Distance of neighbours at rest.
    pub(crate) const SPACING: f32 = 1.0;
    /// Downwards.
    pub(crate) const GRAVITY: f32 = 10.0;

    /// As many particles as fit a square lattice of about so many, the nearest square number.
    pub(crate) fn new(particles: usize) -> Self {
        let side = (particles as f32).sqrt().round() as usize;
        let rise = Self::SPACING * 0.75f32.sqrt();
        let point = |column: usize, row: usize| {
            let inset = if row.is_multiple_of(2) { 0.5 } else { 1.0 };
            Vec2::new((column as f32 + inset) * Self::SPACING, row as f32 * rise + 0.5 * Self::SPACING)
        };
        let points = (0..side).flat_map(|row| (0..side).map(move |column| point(column, row))).collect();
        // A tenth more in height, so that rounding takes no row.
        let size = Vec2::new((side as f32 + 0.5) * Self::SPACING, (side - 1) as f32 * rise + 1.1 * Self::SPACING);
        Self { tank: size * Vec2::new(1.25, 1.5), size, points }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn platelets_and_pushers_start_apart() {
        for count in [1, 90, 200, 800, 3300] {
            let field = PlateletField::new(count);
            assert_eq!(field.centres.len(), count);
            assert_eq!(field.sweeps.len(), count.div_ceil(100));
            for (k, a) in field.centres.iter().enumerate() {
                assert!(field.centres[..k].iter().all(|b| a.distance(*b) > 2.0 * OUTER_RADIUS));
                assert!(field.sweeps.iter().all(|s| a.distance(s.start()) > OUTER_RADIUS + Pusher::RADIUS));
                assert!(a.cmpgt(Vec2::splat(OUTER_RADIUS)).all() && a.cmplt(field.size - OUTER_RADIUS).all());
            }
        }
    }

    #[test]
    fn neighbouring_satellites_touch() {
        let ring: Vec<Vec2> = Platelet::ring().collect();
        assert!((ring[0].distance(ring[1]) - 2.0 * Platelet::satellite_radius()).abs() < 1e-5);
        assert!((Platelet::ring_radius() + Platelet::satellite_radius() - OUTER_RADIUS).abs() < 1e-5);
    }

    #[test]
    fn block_is_a_lattice_at_the_wall() {
        let block = FluidBlock::new(10_000);
        assert_eq!(block.points.len(), 10_000);
        assert!((block.points[0].distance(block.points[1]) - 1.0).abs() < 1e-6);
        assert!((block.points[0].distance(block.points[100]) - 1.0).abs() < 1e-5);
    }
}
