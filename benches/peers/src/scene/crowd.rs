//! The crowd: amoeboid cells, each a ring of discs around cytoplasm, that are driven about and jostle. They are the cells of
//! the library's scenario `crowd`, without its platelets.

use super::DT;
use microsim_core::glam::Vec2;
use microsim_core::{AmoeboidCellSpec, Placement, Rng, Role, World, WorldConfig};

/// Outer radius of a cell at the start, that of the scenario.
pub(crate) const CELL_RADIUS: f32 = 7.55;
/// Radius of a ring's disc, the thesis' (3.1.2).
pub(crate) const DISC_RADIUS: f32 = 0.78;
/// Distance of neighbours in the cytoplasm at rest, disc radii.
pub(crate) const SPACING_RATIO: f32 = 1.65;
/// The same in units.
pub(crate) const SPACING: f32 = SPACING_RATIO * DISC_RADIUS;
/// Of the discs of rings; cytoplasm has none.
pub(crate) const FRICTION: f32 = 0.05;
/// Velocity that front and rear are given, units/s.
pub(crate) const SPEED: f32 = 8.0;
/// Of the discs of rings, units/s. The thesis asks for such a limit, against leaks.
pub(crate) const MAX_SPEED: f32 = 20.0;

/// Distance of neighbouring cells at the start: they cover some 55 % of the room, so nobody goes far alone.
const PITCH: f32 = 18.0;
/// Each is shifted at random by up to this, which brings none into contact.
const JITTER: f32 = 1.0;
/// Free room around the field.
const MARGIN: f32 = 2.0;
/// Shortest and longest time for which a cell keeps its direction, s, those of the scenario's controller.
const KEPT: (f32, f32) = (2.0, 6.0);
/// Time for which there are directions, s: longer than any run.
const LONGEST_RUN: f32 = 60.0;
/// Half-width of front and rear, as a share of the ring: each is a quarter of it.
const HALF_WIDTH: f32 = 1.0 / 8.0;

/// Places around a cell's centre.
#[derive(Clone, Debug)]
pub(crate) struct CellShape {
    /// Discs of the ring in order, counter-clockwise; neighbours touch.
    pub ring: Vec<Vec2>,
    /// Evenly spread and settled.
    pub cytoplasm: Vec<Vec2>,
}

impl CellShape {
    /// As the library spawns it.
    fn of_library() -> Self {
        let centre = Vec2::splat(2.0 * CELL_RADIUS);
        let config = WorldConfig { size: 2.0 * centre, ..WorldConfig::default() };
        let mut world = World::new(config).expect("the configuration is valid");
        let cell = world.spawn(&cell_spec().into(), Placement::at(centre.x, centre.y)).expect("the cell fits the room");
        let view = world.view().organism(cell).expect("it was just spawned");
        let ring = view.outline().map(|at| at - centre).collect();
        let is_inside = |particle: &microsim_core::ParticleView| particle.role == Role::Cytoplasm;
        let cytoplasm = view.particles().filter(is_inside).map(|particle| particle.position - centre).collect();
        Self { ring, cytoplasm }
    }

    /// Discs and particles of one cell.
    pub(crate) fn bodies(&self) -> usize {
        self.ring.len() + self.cytoplasm.len()
    }

    /// Length of a link of the ring at rest.
    pub(crate) fn link(&self) -> f32 {
        self.ring[0].distance(self.ring[1])
    }
}

/// The cell in the library's terms; what is not named here is the library's default.
pub(crate) fn cell_spec() -> AmoeboidCellSpec {
    AmoeboidCellSpec {
        radii: Vec2::splat(CELL_RADIUS),
        node_radius: DISC_RADIUS,
        cytoplasm_spacing: SPACING_RATIO,
        speed: SPEED,
        ..AmoeboidCellSpec::default()
    }
}

/// Directions of one cell, unit vectors, each with the step from which it holds.
type Course = Vec<(u64, Vec2)>;

/// Cells, and where they are driven.
#[derive(Clone, Debug)]
pub(crate) struct Crowd {
    /// Of the walled room; its lower left corner is the origin.
    pub size: Vec2,
    pub centres: Vec<Vec2>,
    pub cell: CellShape,
    courses: Vec<Course>,
}

impl Crowd {
    pub(crate) fn new(cells: usize) -> Self {
        let columns = (cells as f32).sqrt().ceil() as usize;
        let rows = cells.div_ceil(columns);
        let mut rng = Rng::new(1, 0);
        let place = |k: usize| Vec2::new((k % columns) as f32 + 0.5, (k / columns) as f32 + 0.5) * PITCH + MARGIN;
        let shifted = |k| place(k) + Vec2::new(rng.range(-JITTER, JITTER), rng.range(-JITTER, JITTER));
        Self {
            size: Vec2::new(columns as f32, rows as f32) * PITCH + 2.0 * MARGIN,
            centres: (0..cells).map(shifted).collect(),
            cell: CellShape::of_library(),
            courses: (0..cells).map(|k| course(&mut Rng::new(2, k as u64))).collect(),
        }
    }

    /// Where each cell is driven in this step.
    pub(crate) fn directions(&self, step: u64) -> Vec<Vec2> {
        let now = |course: &Course| course[course.partition_point(|&(from, _)| from <= step) - 1].1;
        self.courses.iter().map(now).collect()
    }
}

fn course(rng: &mut Rng) -> Course {
    let (mut course, mut from) = (Course::new(), 0.0);
    while from < LONGEST_RUN {
        let direction = Vec2::from_angle(rng.range(0.0, std::f32::consts::TAU));
        course.push(((from / DT) as u64, direction));
        from += rng.range(KEPT.0, KEPT.1);
    }
    course
}

/// The thesis' drive of a cell (3.1.2) for engines that have none: discs of the ring, and the velocities that are set in
/// them. The quarter ahead goes in the direction, the opposite quarter towards the middle, the wings follow.
pub(crate) fn drive(ring: &[Vec2], direction: Vec2) -> impl Iterator<Item = (usize, Vec2)> {
    let count = ring.len();
    let along = |k: &usize| ring[*k].dot(direction);
    let front = (0..count).max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or(0);
    let middle = ring.iter().sum::<Vec2>() / count as f32;
    let half_width = (count as f32 * HALF_WIDTH) as usize;
    (0..count).filter_map(move |k| {
        let ahead = (k + count - front) % count;
        let from_front = ahead.min(count - ahead);
        if from_front <= half_width {
            Some((k, direction * SPEED))
        } else if from_front + half_width >= count / 2 {
            Some((k, (middle - ring[k]).normalize_or_zero() * SPEED))
        } else {
            None
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_start_apart_in_the_room() {
        for count in [1, 10, 50, 1000] {
            let crowd = Crowd::new(count);
            assert_eq!(crowd.centres.len(), count);
            for (k, a) in crowd.centres.iter().enumerate() {
                assert!(crowd.centres[..k].iter().all(|b| a.distance(*b) > 2.0 * CELL_RADIUS));
                assert!(a.cmpgt(Vec2::splat(CELL_RADIUS)).all() && a.cmplt(crowd.size - CELL_RADIUS).all());
            }
        }
    }

    #[test]
    fn ring_is_closed_and_around_the_cytoplasm() {
        let cell = CellShape::of_library();
        let count = cell.ring.len();
        for k in 0..count {
            assert!((cell.ring[k].distance(cell.ring[(k + 1) % count]) - cell.link()).abs() < 1e-4);
        }
        assert!((cell.link() / (2.0 * DISC_RADIUS) - 1.0).abs() < 0.05, "neighbours touch: {}", cell.link());
        assert!(cell.cytoplasm.iter().all(|p| p.length() < CELL_RADIUS - 2.0 * DISC_RADIUS));
        assert_eq!((count, cell.bodies()), (27, 104));
    }

    #[test]
    fn front_goes_ahead_and_rear_to_the_middle() {
        let cell = CellShape::of_library();
        let driven: Vec<(usize, Vec2)> = drive(&cell.ring, Vec2::X).collect();
        assert!((12..=16).contains(&driven.len()), "about half of the ring: {}", driven.len());
        for (k, velocity) in driven {
            assert!(velocity.x > 0.6 * SPEED && velocity.length() < 1.01 * SPEED);
            assert!(cell.ring[k].x.abs() > 0.4 * CELL_RADIUS);
        }
    }

    #[test]
    fn directions_change_at_their_times() {
        let crowd = Crowd::new(20);
        let changes = (1..1200).filter(|&step| crowd.directions(step) != crowd.directions(step - 1)).count();
        assert!((50..=200).contains(&changes), "20 cells, 20 s: {changes}");
        assert!(crowd.directions(0).iter().all(|direction| (direction.length() - 1.0).abs() < 1e-5));
    }
}
