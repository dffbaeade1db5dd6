//! Capabilities: what an organism can do, as data that it carries, and the rules that need only these data. How it moves is in
//! [`crate::behavior`]; how it changes the world, in the rooms of the same names in `world/`.

use serde::{Deserialize, Serialize};

pub(crate) mod controller;
pub(crate) mod division;
pub(crate) mod exchange;
pub(crate) mod phagocytosis;
pub(crate) mod progress;

/// How an organism moves towards its goal, and what it remembers of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Locomotion {
    /// It does not.
    None,
    /// Its front body pulls it (seed, 3.1.1). `front` is a position in the outline.
    FrontPull { front: u32 },
    /// Its membrane's front and rear drive it (seed, 3.1.2). `front_centre` is a position in the outline, while it moves.
    Crawl { front_centre: Option<u32> },
    /// Somebody pulls all of it with finite force.
    Tow { max_acceleration: f32 },
    /// All of its particles are accelerated alike ([`crate::template::Propulsion`]).
    Propel { max_acceleration: f32 },
}
