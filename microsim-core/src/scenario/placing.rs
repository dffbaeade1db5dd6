//! Finding a place for every organism, from the seed alone.

use super::reader::ReadContext;
use super::sections::group::{Angle, Group, Positions};
use crate::CollisionGroups;
use crate::collision::obstacle::Obstacle;
use crate::organism::{OrganismSpec, Placement};
use crate::rng::Rng;
use glam::Vec2;
use std::collections::BTreeMap;
use std::f32::consts::TAU;

/// Random places that are tried for one organism.
const TRIES: u32 = 2000;
/// Layouts that are tried.
const LAYOUTS: usize = 20;
/// Streams of random numbers from here on are for placing; those of the world's organisms lie below.
const STREAM: u64 = 1 << 62;

/// One organism that is ready to be spawned.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub spec: OrganismSpec,
    pub placement: Placement,
    /// Farthest that it reaches from its place, units.
    extent: f32,
}

/// Finds places for all organisms that are there from the beginning, group by group. Fixed places count before random
/// ones do, wherever they stand in the file, so that random placement never takes a place that is asked for. When one
/// finds none, all random ones are placed again.
pub(super) fn place_all(
    groups: &[Group],
    obstacles: &[Obstacle],
    seed: u64,
    context: &ReadContext<'_>,
) -> Vec<Vec<Placed>> {
    let rng = |index: usize| Rng::new(seed, STREAM + index as u64);
    let fixed: Vec<Vec<Placed>> = groups.iter().enumerate().map(|(index, group)| fixed(group, rng(index))).collect();
    if groups.iter().all(|group| group.random_count() == 0) {
        return fixed;
    }
    let extents = groups.iter().map(|group| group.prototype.extent(group.scale[1]));
    let largest = extents.fold(0.0, |largest, extent| if extent > largest { extent } else { largest });
    let mut taken = Taken::new(largest, obstacles);
    fixed.iter().flatten().for_each(|placed| taken.add(placed));
    let mut lay_out = |layout: usize| {
        let (mut placed, mut taken) = (fixed.clone(), taken.clone());
        for (index, group) in groups.iter().enumerate() {
            placed[index].extend(random(group, rng(layout * groups.len() + index), &mut taken));
        }
        placed
    };
    let is_complete = |placed: &Vec<Vec<Placed>>| !groups.iter().zip(placed).any(is_short);
    if let Some(placed) = (0..LAYOUTS).map(&mut lay_out).find(is_complete) {
        return placed;
    }
    let placed = lay_out(0);
    groups.iter().zip(&placed).filter(|pair| is_short(*pair)).for_each(|short| refuse_short(short, context));
    placed
}

fn is_short((group, placed): (&Group, &Vec<Placed>)) -> bool {
    placed.len() < group.random_count()
}

fn refuse_short((group, placed): (&Group, &Vec<Placed>), context: &ReadContext<'_>) {
    let (found, count) = (placed.len(), group.random_count());
    let message = format!("only {found} of {count} found a free place in {TRIES} tries each");
    let accepted = format!("about {found} at most here; more with a larger room or a smaller `gap` or `scale`");
    context.refuse(&group.count_path(context), message, accepted);
}

/// Those of a group whose places are given.
fn fixed(group: &Group, mut rng: Rng) -> Vec<Placed> {
    let places: Vec<Vec2> = match &group.positions {
        _ if group.from > 0.0 => Vec::new(),
        Positions::At(at) => vec![*at],
        Positions::Grid(grid) => grid.places(&mut rng).collect(),
        Positions::Random { .. } => Vec::new(),
    };
    let put = |at| {
        let (scale, angle) = draw(group, &mut rng);
        place(group, at, scale, angle)
    };
    places.into_iter().map(put).collect()
}

/// As many of a group whose places are random as find a free one, by rejection.
fn random(group: &Group, mut rng: Rng, taken: &mut Taken<'_>) -> Vec<Placed> {
    let mut placed = Vec::new();
    let Positions::Random { within: [low, high], gap, .. } = group.positions else { return placed };
    for _ in 0..group.random_count() {
        let (scale, angle) = draw(group, &mut rng);
        let radius = group.prototype.extent(scale);
        let (low, high) = (low + radius, high - radius);
        let mut tries = (0..TRIES).map(|_| Vec2::new(rng.range(low.x, high.x), rng.range(low.y, high.y)));
        let Some(at) = tries.find(|&at| taken.is_free(at, radius + gap, group.groups)) else {
            return placed;
        };
        placed.push(place(group, at, scale, angle));
        taken.add(&placed[placed.len() - 1]);
    }
    placed
}

/// Scale and angle of the next organism.
pub(super) fn draw(group: &Group, rng: &mut Rng) -> (f32, f32) {
    let [smallest, largest] = group.scale;
    let scale = if smallest < largest { rng.range(smallest, largest) } else { smallest };
    let angle = match group.angle {
        Angle::Radians(angle) => angle,
        Angle::Random => rng.range(0.0, TAU),
    };
    (scale, angle)
}

pub(super) fn place(group: &Group, at: Vec2, scale: f32, angle: f32) -> Placed {
    let extent = group.prototype.extent(scale);
    let (spec, scale) = group.prototype.scaled(scale);
    let controller = group.controller.clone();
    let placement = Placement { angle, scale, controller, groups: group.groups, ..Placement::at(at.x, at.y) };
    Placed { spec, placement, extent }
}

/// Circles that are taken, in cells of a square grid so that few are looked at.
#[derive(Clone)]
struct Taken<'a> {
    cell: f32,
    largest_radius: f32,
    circles: BTreeMap<[i32; 2], Vec<(Vec2, f32, CollisionGroups)>>,
    obstacles: &'a [Obstacle],
}

impl<'a> Taken<'a> {
    fn new(largest_radius: f32, obstacles: &'a [Obstacle]) -> Self {
        Self { cell: 2.0 * largest_radius + 0.1, largest_radius, circles: BTreeMap::new(), obstacles }
    }

    fn cell_of(&self, at: Vec2) -> [i32; 2] {
        (at / self.cell).floor().as_ivec2().to_array()
    }

    fn add(&mut self, placed: &Placed) {
        let at = placed.placement.at;
        self.circles.entry(self.cell_of(at)).or_default().push((at, placed.extent, placed.placement.groups));
    }

    fn is_free(&self, at: Vec2, radius: f32, groups: CollisionGroups) -> bool {
        let blocked = |obstacle: &Obstacle| obstacle.shape.distance_to_point(&obstacle.pose, at, true) < radius;
        let [left, bottom] = self.cell_of(at - (radius + self.largest_radius));
        let [right, top] = self.cell_of(at + (radius + self.largest_radius));
        let cells = (left..=right).flat_map(|i| (bottom..=top).map(move |j| [i, j]));
        let mut circles = cells.filter_map(|cell| self.circles.get(&cell)).flatten();
        let is_apart = |&(other, other_radius, others): &(Vec2, f32, CollisionGroups)| {
            !others.meets(groups) || (other - at).length() >= other_radius + radius
        };
        circles.all(is_apart) && !self.obstacles.iter().any(blocked)
    }
}
