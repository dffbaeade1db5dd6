//! Finding a place for every organism, from the seed alone.

use super::nearby::Nearby;
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
    let mut taken = Taken::new(obstacles);
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
    let [linear, angular] = group.damping;
    let placement = Placement { angle, scale, controller, groups: group.groups, ..Placement::at(at.x, at.y) };
    let placement = placement.damped(linear, angular);
    Placed { spec, placement, extent }
}

/// What is taken: circles around organisms, by what they collide with, and obstacles.
#[derive(Clone)]
struct Taken<'a> {
    circles: BTreeMap<[u32; 2], Nearby<(Vec2, f32)>>,
    obstacles: Nearby<&'a Obstacle>,
}

impl<'a> Taken<'a> {
    fn new(obstacles: &'a [Obstacle]) -> Self {
        let mut taken = Self { circles: BTreeMap::new(), obstacles: Nearby::default() };
        for obstacle in obstacles {
            let bounds = obstacle.aabb();
            taken.obstacles.add(bounds.center(), 0.5 * (bounds.maxs - bounds.mins).length(), obstacle);
        }
        taken
    }

    fn add(&mut self, placed: &Placed) {
        let CollisionGroups { memberships, filter } = placed.placement.groups;
        let circles = self.circles.entry([memberships, filter]).or_default();
        circles.add(placed.placement.at, placed.extent, (placed.placement.at, placed.extent));
    }

    fn is_free(&self, at: Vec2, radius: f32, groups: CollisionGroups) -> bool {
        let others = self
            .circles
            .iter()
            .filter(|&(&[memberships, filter], _)| CollisionGroups { memberships, filter }.meets(groups));
        let mut circles = others.flat_map(|(_, circles)| circles.around(at, radius));
        let blocked = |obstacle: &&Obstacle| obstacle.shape.distance_to_point(&obstacle.pose, at, true) < radius;
        circles.all(|&(other, other_radius)| (other - at).length() >= other_radius + radius)
            && !self.obstacles.around(at, radius).any(blocked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    /// Obstacles of all kinds, and a large cell and pellets of many sizes, some in tiers.
    const CROWD: &str = r#"
        schema = 1
        world = { size = [200.0, 100.0] }
        agar.pellet.radius = 1.0
        spawn = [
            { of = "pellet", scale = [0.01, 0.5] },
            { of = "pellet", scale = [0.5, 3.0], tier = 1 },
            { of = "pellet", scale = [10.0, 30.0], tier = 2 },
        ]
        disc = [{ at = [20.0, 20.0], radius = 6.0 }, { at = [60.0, 50.0], radius = 0.01 }]
        wall = [{ from = [0.0, 90.0], to = [200.0, 80.0], thickness = 0.5 }]
        block = [{ at = [150.0, 20.0], size = [60.0, 4.0], angle = 20.0 }]
        polygon = [{ points = [[100, 40], [130, 42], [120, 70], [115, 55]] }]
    "#;

    #[test]
    fn a_place_is_free_if_it_is_when_all_is_looked_at() {
        let file = Scenario::parse(CROWD, &[]).unwrap().file;
        let (mut rng, mut taken, mut all) = (Rng::new(1, 1), Taken::new(&file.obstacles), Vec::<Placed>::new());
        let mut counts = [0, 0];
        for k in 0..6000 {
            let group = &file.groups[k % 3];
            let at = Vec2::new(rng.range(-5.0, 205.0), rng.range(-5.0, 105.0));
            let (scale, angle) = draw(group, &mut rng);
            let placed = place(group, at, scale, angle);
            let radius = placed.extent + if k % 2 == 0 { 0.3 } else { 0.0 };
            let is_apart = |other: &Placed| {
                let meets = other.placement.groups.meets(group.groups);
                !meets || (other.placement.at - at).length() >= other.extent + radius
            };
            let blocks = |obstacle: &Obstacle| obstacle.shape.distance_to_point(&obstacle.pose, at, true) < radius;
            let is_free = all.iter().all(is_apart) && !file.obstacles.iter().any(blocks);
            assert_eq!(taken.is_free(at, radius, group.groups), is_free, "{at}, radius {radius}");
            counts[usize::from(is_free)] += 1;
            if is_free {
                taken.add(&placed);
                all.push(placed);
            }
        }
        assert!(counts.into_iter().all(|count| count > 500), "{counts:?}");
    }
}
