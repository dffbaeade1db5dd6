//! Whether what wants to move gets anywhere, and how what is stuck tries to get away.

use super::controller::senses::{Senses, Wish};
use crate::geometry::ring::{direction_or, rotate, unit_vector};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::PI;

/// It has got somewhere when it is so far from where it was, in its radii.
const SOMEWHERE: f32 = 1.0 / 3.0;
/// Time without that after which it is stuck: so many times the time to get there at its speed, and some more, s.
const PATIENCE: [f32; 2] = [1.4, 0.4];
/// What still goes its way with this share of its speed is not stuck.
const GOING: f32 = 0.3;
/// Time for which it tries one way out, the same way, and by how much longer each further try is.
const TRY: [f32; 2] = [1.3, 0.5];
const LONGER: f32 = 0.3;
/// It first goes back the way that it came, give or take this angle, radians.
const ASTRAY: f32 = 0.5;

/// Where an organism last got to, and its way out when it is stuck.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Progress {
    /// Where it last got somewhere, and where it was before.
    mark: Vec2,
    before: Vec2,
    /// Time since then for which it wanted to move, s.
    pub stalled: f32,
    /// Direction that it tries, and time for which it still does, s.
    escape: Option<(Vec2, f32)>,
    /// Ways out that it has tried.
    tries: u32,
}

impl Progress {
    /// Takes note of a step.
    pub(crate) fn note(&mut self, wants_to_move: bool, senses: &Senses<'_>) {
        let distance = SOMEWHERE * senses.radius;
        if (senses.at - self.mark).length_squared() > distance * distance {
            *self = Self { mark: senses.at, before: self.mark, stalled: 0.0, tries: 0, ..*self };
        } else if wants_to_move {
            self.stalled += senses.around.dt;
        }
    }

    /// The direction in which it tries to get away, if it is stuck: first back, then anywhere.
    pub(crate) fn way_out(&mut self, wish: Wish, senses: &Senses<'_>, rng: &mut Rng) -> Option<Vec2> {
        let ahead = direction_or((wish.goal - senses.at) * wish.pace, Vec2::ZERO);
        let is_going = senses.velocity.dot(ahead) > GOING * senses.speed;
        let needed = SOMEWHERE * senses.radius / senses.speed;
        let [due, length] = [PATIENCE, TRY].map(|[times, more]| times * needed + more);
        self.escape = match self.escape {
            Some((way, left)) if left > senses.around.dt => Some((way, left - senses.around.dt)),
            _ if self.stalled < due || is_going => None,
            _ => {
                let astray = if self.tries == 0 { ASTRAY } else { PI };
                let back = direction_or(self.before - senses.at, Vec2::X);
                let way = senses.along_walls(rotate(back, unit_vector(rng.range(-astray, astray))));
                self.tries += 1;
                Some((way, length * (1.0 + LONGER * (self.tries - 1) as f32)))
            }
        };
        self.escape.map(|(way, _)| way)
    }
}
