//! What an organism may know of itself and of what is around it, and what it wants.

use crate::chemical::Chemical;
use crate::collision::obstacle::Obstacle;
use crate::geometry::period::Period;
use crate::geometry::ring::direction_or;
use crate::id::{ChemicalId, OrganismId};
use glam::Vec2;

/// Distance of a goal that stands for a direction, units.
const FAR: f32 = 1000.0;
/// Gap from which on an organism keeps from swimming or crawling into a wall, in its radii.
const WHISKERS: f32 = 0.35;
/// Share of its speed with which it then leaves the wall, so that it does not rub along.
const DETACH: f32 = 0.05;

/// Where an organism steers in a step, and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Steering {
    pub goal: Vec2,
    /// Speed, in units of its own; negative: away from the goal, with the rear ahead.
    pub relative_speed: f32,
    /// Whether a body that is towed as a whole takes this velocity at once, as it would at low Reynolds number, not by its
    /// acceleration.
    pub is_at_once: bool,
}

impl Steering {
    /// Steering to a point.
    pub(crate) fn to(goal: Vec2) -> Self {
        Self { goal, relative_speed: 1.0, is_at_once: false }
    }
}

/// What all organisms may sense.
#[derive(Clone, Debug)]
pub(crate) struct Environment<'a> {
    /// Upper right corner of the room.
    pub size: Vec2,
    pub period: Period,
    /// Time of a step, s.
    pub dt: f32,
    pub chemicals: &'a [Chemical],
    /// Walls among them.
    pub obstacles: &'a [Obstacle],
    /// Organisms that take others in, and those that can be taken in.
    pub others: &'a [Other],
}

/// An organism as others see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Other {
    pub id: OrganismId,
    pub at: Vec2,
    pub velocity: Vec2,
    /// Largest distance of its surface from its place, units.
    pub radius: f32,
    pub is_engulfer: bool,
    /// Whether it can be taken in, and nobody has.
    pub is_prey: bool,
}

/// What one organism knows in a step.
#[derive(Clone, Debug)]
pub(crate) struct Senses<'a> {
    pub me: OrganismId,
    /// Mean of its outline, or its one disc.
    pub at: Vec2,
    pub velocity: Vec2,
    /// Speed that it has when it moves, units/s.
    pub speed: f32,
    /// Distance of its surface from its place on average, units.
    pub radius: f32,
    /// Goals nearer than this are reached, units.
    pub arrival: f32,
    /// Centres of its outline, counter-clockwise.
    pub outline: &'a [Vec2],
    pub around: &'a Environment<'a>,
}

/// A wall next to an organism.
#[derive(Clone, Copy, Debug)]
struct SensedWall {
    /// Unit vector away from it.
    away: Vec2,
    /// Gap between it and the organism's surface, units.
    gap: f32,
}

impl Senses<'_> {
    /// Steering along a direction.
    pub(crate) fn along(&self, heading: Vec2) -> Steering {
        Steering::to(self.at + heading * FAR)
    }

    /// Steering with a velocity, in units of its own speed.
    pub(crate) fn with_velocity(&self, relative: Vec2) -> Steering {
        let relative_speed = relative.length();
        Steering { relative_speed, is_at_once: true, ..self.along(direction_or(relative, Vec2::X)) }
    }

    /// Concentration of a chemical at a point; nothing of one that is not there.
    pub(crate) fn concentration(&self, chemical: ChemicalId, at: Vec2) -> f32 {
        self.around.chemicals.get(chemical.0 as usize).map_or(0.0, |chemical| chemical.concentration(at))
    }

    /// The others that something is true of.
    pub(crate) fn others(&self, is_so: impl Fn(&Other) -> bool) -> impl Iterator<Item = &Other> {
        self.around.others.iter().filter(move |other| other.id != self.me && is_so(other))
    }

    /// The nearest of the others that something is true of.
    pub(crate) fn nearest(&self, is_so: impl Fn(&Other) -> bool) -> Option<&Other> {
        let distance = |other: &Other| (other.at - self.at).length_squared();
        self.others(is_so).reduce(|a, b| if distance(b) < distance(a) { b } else { a })
    }

    /// A direction without its component into walls nearby. One that is head-on becomes a direction along the wall.
    pub(crate) fn along_walls(&self, heading: Vec2) -> Vec2 {
        let mut direction = heading;
        for SensedWall { away, gap } in self.walls() {
            let into = -direction.dot(away);
            if gap < WHISKERS * self.radius && into > -DETACH {
                let side = if direction.perp_dot(away) > 0.0 { away.perp() } else { -away.perp() };
                let slide = direction_or(direction + away * into, side);
                direction = direction_or(slide + away * DETACH, side);
            }
        }
        direction
    }

    /// Along the longest extent of its outline; the longer beside its radius, the longer, and zero when it is round.
    pub(crate) fn axis(&self) -> Vec2 {
        let ways = self.outline.iter().map(|&node| node - self.at);
        let longest = ways.reduce(|a, b| if b.length_squared() > a.length_squared() { b } else { a });
        let longest = longest.unwrap_or(Vec2::ZERO);
        direction_or(longest, Vec2::ZERO) * (longest.length() / self.radius - 1.0)
    }

    /// The wall that a direction leads into soonest, if there is one next to it: the unit vector away from it.
    pub(crate) fn wall_ahead(&self, heading: Vec2) -> Option<Vec2> {
        let ahead = self.walls().filter(|wall| wall.gap < WHISKERS * self.radius && wall.away.dot(heading) < 0.0);
        let nearest = ahead.reduce(|a, b| if b.away.dot(heading) < a.away.dot(heading) { b } else { a });
        nearest.map(|wall| wall.away)
    }

    fn walls(&self) -> impl Iterator<Item = SensedWall> {
        self.around.obstacles.iter().filter(|obstacle| obstacle.is_solid()).filter_map(|obstacle| {
            let (surface, is_inside) = obstacle.nearest(self.at);
            let offset = self.at - surface;
            let away = direction_or(if is_inside { -offset } else { offset }, Vec2::Y);
            let extent = self.outline.iter().map(|&node| (self.at - node).dot(away));
            let extent = extent.fold(if self.outline.is_empty() { self.radius } else { 0.0 }, larger);
            (!is_inside).then(|| SensedWall { away, gap: offset.length() - extent })
        })
    }
}

pub(super) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ring::ellipse;
    use crate::{World, WorldConfig};

    /// What an ellipse of half axes 2 and 1 at a point makes of a heading, and its axis.
    fn along_walls_and_axis(at: Vec2, heading: Vec2) -> [Vec2; 2] {
        let world = World::new(WorldConfig { size: Vec2::splat(60.0), ..WorldConfig::default() }).unwrap();
        let (size, period) = (world.config().size, Period::NONE);
        let (chemicals, others, obstacles) = (&[], &[], &world.obstacles);
        let around = Environment { size, period, dt: 0.1, chemicals, obstacles, others };
        let outline: Vec<Vec2> = ellipse(Vec2::new(2.0, 1.0), 16).into_iter().map(|arm| at + arm).collect();
        let me = OrganismId { index: 0, generation: 0 };
        let (velocity, speed, radius, arrival) = (Vec2::ZERO, 1.0, 1.5, 0.25);
        let senses = Senses { me, at, velocity, speed, radius, arrival, outline: &outline, around: &around };
        [senses.along_walls(heading), senses.axis()]
    }

    #[test]
    fn a_wall_is_felt_from_a_third_of_the_radius_on() {
        let heading = Vec2::new(0.6, -0.8);
        let felt = |gap: f32| along_walls_and_axis(Vec2::new(30.0, 1.0 + gap), heading)[0];
        assert_eq!(felt(0.55), heading);
        let along = felt(0.5);
        assert!(along.x > 0.9 && along.y > 0.0, "{along}");
    }

    #[test]
    fn its_axis_is_the_longer_the_longer_it_is_beside_its_radius() {
        let [_, axis] = along_walls_and_axis(Vec2::new(30.0, 20.0), Vec2::X);
        assert!((axis.x.abs() - (2.0 / 1.5 - 1.0)).abs() < 1e-4 && axis.y.abs() < 1e-4, "{axis}");
    }
}
