//! Whether what wants to move gets anywhere, and how what is stuck tries to get away.

use super::controller::senses::{Senses, Wish};
use crate::geometry::ring::{direction_or, rotate, unit_vector};
use crate::rng::Rng;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::f32::consts::{FRAC_PI_2, PI};

/// It has got somewhere when it is so far from where it was, in its radii.
const SOMEWHERE: f32 = 0.5;
/// Time without that after which it is stuck, s: the time to get there at its speed, so many times, and a second.
const PATIENCE: f32 = 2.0;
const PAUSE: f32 = 0.7;
/// Time for which it tries one way out, s.
const TRY: f32 = 0.8;

/// Where an organism last got to, and its way out when it is stuck.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Progress {
    /// Where it last got somewhere.
    mark: Vec2,
    /// Time since then for which it wanted to move, s.
    pub stalled: f32,
    /// Direction that it tries, and time for which it still does, s.
    escape: Option<(Vec2, f32)>,
}

impl Progress {
    /// Takes note of a step.
    pub(crate) fn note(&mut self, wants_to_move: bool, senses: &Senses<'_>) {
        let distance = SOMEWHERE * senses.radius;
        if (senses.at - self.mark).length_squared() > distance * distance {
            (self.mark, self.stalled) = (senses.at, 0.0);
        } else if wants_to_move {
            self.stalled += senses.around.dt;
        }
    }

    /// What it does in place of what it wants while it is stuck: it turns away from what is ahead, to a random side.
    pub(crate) fn free(&mut self, wish: Wish, senses: &Senses<'_>, rng: &mut Rng) -> Wish {
        let due = PAUSE + PATIENCE * SOMEWHERE * senses.radius / senses.speed;
        self.escape = match self.escape {
            Some((way, left)) if left > senses.around.dt => Some((way, left - senses.around.dt)),
            _ if self.stalled < due => None,
            _ => {
                let angle = rng.range(FRAC_PI_2, PI);
                let side = if rng.unit() < 0.5 { angle } else { -angle };
                let ahead = direction_or((wish.goal - senses.at) * wish.pace, Vec2::X);
                Some((senses.along_walls(rotate(ahead, unit_vector(side))), TRY))
            }
        };
        self.escape.map_or(wish, |(way, _)| senses.along(way))
    }
}
