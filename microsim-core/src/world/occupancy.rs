//! Where organisms are while none of them moves: their boxes in cells of the room, so that filling a world takes as long as
//! there are organisms to put into it.

use super::World;
use crate::collision::obstacle::Obstacle;
use crate::organism::{Organism, TOUCHING};
use crate::particle::Particle;
use glam::Vec2;
use parry2d::bounding_volume::{Aabb, BoundingVolume};

/// Mean number of boxes in a cell above which the grid is refined.
const CROWDED: usize = 4;

/// Boxes of organisms, made for the first one that is spawned after a step and forgotten in the next step.
#[derive(Debug, Default)]
pub(crate) struct Occupancy {
    /// Slots of organisms with the boxes around them. One of an organism that was removed does no harm.
    boxes: Vec<(u32, Aabb)>,
    /// Boxes in each cell, row by row.
    cells: Vec<Vec<u32>>,
    columns: usize,
    rows: usize,
    /// Size of a cell, units.
    cell: Vec2,
}

impl Occupancy {
    /// Forgets everything, because organisms move or change.
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }

    fn add(&mut self, slot: u32, aabb: Aabb, room: Vec2) {
        self.boxes.push((slot, aabb));
        if self.boxes.len() > CROWDED * self.cells.len() {
            self.divide(room);
        } else {
            self.enter(self.boxes.len() - 1);
        }
    }

    /// Divides the room into about as many cells as there are boxes.
    fn divide(&mut self, room: Vec2) {
        let side = (room.x * room.y / self.boxes.len() as f32).sqrt();
        [self.columns, self.rows] = [room.x, room.y].map(|length| (length / side) as usize + 1);
        self.cell = room / Vec2::new(self.columns as f32, self.rows as f32);
        self.cells.clear();
        self.cells.resize(self.columns * self.rows, Vec::new());
        (0..self.boxes.len()).for_each(|k| self.enter(k));
    }

    fn enter(&mut self, k: usize) {
        for cell in self.cells_in(&self.boxes[k].1) {
            self.cells[cell].push(k as u32);
        }
    }

    /// The cells that a box reaches into; the cells at the border also hold what lies beyond.
    fn cells_in(&self, aabb: &Aabb) -> impl Iterator<Item = usize> + use<> {
        let (columns, rows) = (self.columns, self.rows);
        let within = |low: f32, high: f32, cell: f32, count: usize| {
            let place = |at: f32| ((at / cell) as usize).min(count.saturating_sub(1));
            place(low)..(place(high) + 1).min(count)
        };
        let columns_in = within(aabb.mins.x, aabb.maxs.x, self.cell.x, columns);
        let rows_in = within(aabb.mins.y, aabb.maxs.y, self.cell.y, rows);
        rows_in.flat_map(move |row| columns_in.clone().map(move |column| row * columns + column))
    }

    /// Slots of organisms whose boxes overlap this one, some of them several times.
    fn near<'a>(&'a self, aabb: &'a Aabb) -> impl Iterator<Item = u32> + 'a {
        let boxes = self.cells_in(aabb).flat_map(|cell| &self.cells[cell]).map(|&k| &self.boxes[k as usize]);
        boxes.filter(|(_, other)| other.intersects(aabb)).map(|(slot, _)| *slot)
    }
}

impl World {
    /// Describes an obstacle, or an organism that `meets` discs and the box around them, if there is one. Of images of the discs too.
    pub(super) fn first_hit(
        &mut self,
        planned: &[Particle],
        meets: impl Fn(&Self, &Organism, &[Particle], &Aabb) -> bool,
    ) -> Option<String> {
        let bounds = bounds_of(discs(planned));
        for shift in self.shifts_over_all([bounds.mins, bounds.maxs]) {
            let planned: Vec<Particle> = planned.iter().map(|disc| disc.moved(shift)).collect();
            let bounds = Aabb { mins: bounds.mins + shift, maxs: bounds.maxs + shift };
            let mut near = self.obstacles_near(&bounds).into_iter();
            if near.any(|obstacle| planned.iter().any(|disc| is_blocked(obstacle, disc))) {
                return Some("an obstacle".to_owned());
            }
            if let Some(hit) = self.first_near(&bounds, |world, organism| meets(world, organism, &planned, &bounds)) {
                return self.with_its_place(self.organisms.id_at(hit)?);
            }
        }
        None
    }

    /// The first organism of those near a box that `meets`.
    pub(super) fn first_near(&mut self, aabb: &Aabb, meets: impl Fn(&Self, &Organism) -> bool) -> Option<u32> {
        if self.scratch.occupancy.boxes.is_empty() {
            self.note_all();
        }
        let meets = |slot: &u32| {
            let organism = self.organisms.id_at(*slot).and_then(|id| self.organisms.get(id));
            organism.is_some_and(|organism| meets(self, organism))
        };
        self.scratch.occupancy.near(aabb).filter(meets).min()
    }

    /// Lower left and upper right corner of the box around all organisms.
    #[cold]
    pub(super) fn occupied(&mut self) -> [Vec2; 2] {
        if self.scratch.occupancy.boxes.is_empty() {
            self.note_all();
        }
        let boxes = self.scratch.occupancy.boxes.iter();
        let all = boxes.fold(Aabb::new_invalid(), |all, (_, aabb)| all.merged(aabb));
        [all.mins, all.maxs]
    }

    /// Notes where a new organism is, if the others are noted.
    pub(super) fn note_place(&mut self, slot: u32, aabb: Aabb) {
        if !self.scratch.occupancy.boxes.is_empty() {
            self.scratch.occupancy.add(slot, aabb, self.config.size);
        }
    }

    fn note_all(&mut self) {
        let Self { organisms, particles, scratch, config, .. } = self;
        for (id, organism) in organisms.iter() {
            let discs = organism.particles().map(|i| (particles.position(i as usize), particles.radius[i as usize]));
            scratch.occupancy.add(id.index, bounds_of(discs), config.size);
        }
    }
}

/// Whether a disc overlaps an obstacle.
pub(super) fn is_blocked(obstacle: &Obstacle, disc: &Particle) -> bool {
    let (surface, is_inside) = obstacle.nearest(disc.position());
    let gap = (disc.position() - surface).length();
    disc.groups.meets(obstacle.groups) && (is_inside || gap < disc.radius * (1.0 - TOUCHING))
}

/// Places and radii of planned particles.
pub(super) fn discs(planned: &[Particle]) -> impl Iterator<Item = (Vec2, f32)> {
    planned.iter().map(|disc| (disc.position(), disc.radius))
}

/// Axis-aligned box around discs.
pub(super) fn bounds_of(discs: impl Iterator<Item = (Vec2, f32)>) -> Aabb {
    let mut bounds = Aabb::new_invalid();
    for (at, radius) in discs {
        bounds.take_point(at - radius);
        bounds.take_point(at + radius);
    }
    bounds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;
    use crate::{AgarSpec, CollisionGroups, Inputs, OrganismSpec, Placement, RigidCellSpec, WorldConfig};

    const ROOM: Vec2 = Vec2::new(300.0, 40.0);

    fn filled(count: u32, half: impl Fn(&mut Rng) -> f32) -> Occupancy {
        let (mut rng, mut occupancy) = (Rng::new(1, 1), Occupancy::default());
        for slot in 0..count {
            let at = Vec2::new(rng.range(-20.0, 320.0), rng.range(-5.0, 45.0));
            let half = Vec2::splat(half(&mut rng));
            occupancy.add(slot, Aabb::new(at - half, at + half), ROOM);
        }
        occupancy
    }

    #[test]
    fn finds_what_brute_force_finds() {
        let occupancy = filled(500, |rng| rng.range(0.1, 9.0));
        for (_, aabb) in &occupancy.boxes {
            let mut found: Vec<u32> = occupancy.near(aabb).collect();
            found.sort_unstable();
            found.dedup();
            let all = occupancy.boxes.iter().filter(|(_, other)| other.intersects(aabb)).map(|(slot, _)| *slot);
            assert_eq!(found, all.collect::<Vec<_>>());
        }
        for broken in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let aabb = Aabb { mins: Vec2::splat(broken), maxs: Vec2::splat(broken) };
            let mut occupancy = filled(10, |_| 1.0);
            occupancy.add(10, aabb, ROOM);
            assert!(occupancy.near(&aabb).all(|slot| slot <= 10));
        }
    }

    #[test]
    fn looks_at_as_many_boxes_for_each_organism_however_many_there_are() {
        let looks = |count: u32| {
            let occupancy = filled(count, |_| 3.0 / (count as f32).sqrt());
            let all = |aabb| occupancy.cells_in(aabb).map(|cell| occupancy.cells[cell].len()).sum::<usize>();
            occupancy.boxes.iter().map(|(_, aabb)| all(aabb)).sum::<usize>() / count as usize
        };
        assert!([100, 1_000, 10_000, 100_000].map(looks).into_iter().all(|each| (1..40).contains(&each)));
    }

    #[test]
    fn a_place_is_taken_where_something_is_now() {
        let config = WorldConfig { damping: 0.0, ..WorldConfig::default() };
        let mut world = World::new(config.clone()).unwrap();
        let pellet: OrganismSpec = AgarSpec::default().into();
        let at = |x: f32| Placement::at(x, 45.0);
        let first = world.spawn(&pellet, at(30.0)).unwrap();
        assert!(world.spawn(&pellet, at(30.5)).is_err());
        world.push(first, Vec2::new(15.0, 0.0)).unwrap();
        (0..60).for_each(|_| world.step(&Inputs::new()));
        let there = world.centroid(first).unwrap().x;
        assert!(there > 40.0 && world.spawn(&pellet, at(there)).is_err());
        let second = world.spawn(&pellet, at(30.0)).unwrap();
        assert!(world.spawn(&RigidCellSpec::default().into(), at(30.0)).is_err());
        world.remove(second).unwrap();
        world.spawn(&pellet, at(30.0)).unwrap();
        // Another world in its place.
        let mut other = World::new(config).unwrap();
        other.spawn(&pellet, at(80.0)).unwrap();
        (0..60).for_each(|_| other.step(&Inputs::new()));
        assert!(world.spawn(&pellet, at(80.0)).is_ok());
        world.clone_from(&other);
        assert!(world.spawn(&pellet, at(80.0)).is_err() && world.spawn(&pellet, at(30.0)).is_ok());
    }

    #[test]
    fn what_collides_with_nobody_does_not_hide_the_others() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let pellet: OrganismSpec = AgarSpec::default().into();
        world.spawn(&pellet, Placement::at(30.0, 45.0)).unwrap();
        world.step(&Inputs::new());
        let ghost = Placement::at(60.0, 45.0).in_groups(CollisionGroups::NONE);
        world.spawn(&pellet, ghost).unwrap();
        assert!(world.spawn(&pellet, Placement::at(30.0, 45.0)).is_err());
    }
}
