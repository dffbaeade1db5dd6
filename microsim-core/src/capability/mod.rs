//! Capabilities: what an organism can do, as data that it carries, and the rules that need only these data. How it moves is in
//! [`crate::behavior`]; how it changes the world, in the rooms of the same names in `world/`.

pub(crate) mod controller;
pub(crate) mod crawl;
pub(crate) mod division;
pub(crate) mod exchange;
pub(crate) mod phagocytosis;
pub(crate) mod progress;

use crate::rng::Rng;
use crawl::Pseudopods;
use serde::{Deserialize, Serialize};

/// How an organism moves towards its goal, and what it remembers of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Locomotion {
    /// It does not.
    None,
    /// Its front body pulls it (thesis, 3.1.1). `front` is a position in the outline.
    FrontPull { front: u32 },
    /// Its membrane's front and rear drive it (thesis, 3.1.2). `front_centre` is a position in the outline, while it moves.
    Crawl { front_centre: Option<u32> },
    /// Somebody pulls all of it with finite force.
    Tow { max_acceleration: f32 },
    /// All of its particles are accelerated alike ([`crate::template::Propulsion`]).
    Propel { max_acceleration: f32 },
    /// Pseudopods of its membrane pull it.
    Protrude(Box<Pseudopods>),
}

impl Locomotion {
    /// Position in the outline of the body that leads, if there is one now.
    pub(crate) fn front(&self) -> Option<u32> {
        match self {
            Self::FrontPull { front } => Some(*front),
            _ => self.crawling_front(),
        }
    }

    /// The same of what crawls.
    pub(crate) fn crawling_front(&self) -> Option<u32> {
        match self {
            Self::Crawl { front_centre } => *front_centre,
            Self::Protrude(pseudopods) => pseudopods.front_centre,
            Self::None | Self::FrontPull { .. } | Self::Tow { .. } | Self::Propel { .. } => None,
        }
    }

    /// Its pseudopods, if it moves by them.
    pub(crate) fn pseudopods(&self) -> Option<&Pseudopods> {
        if let Self::Protrude(pseudopods) = self { Some(pseudopods) } else { None }
    }

    pub(crate) fn pseudopods_mut(&mut self) -> Option<&mut Pseudopods> {
        if let Self::Protrude(pseudopods) = self { Some(pseudopods) } else { None }
    }

    /// The same for a new organism with so many nodes in its outline, and the random numbers of its crawl.
    pub(crate) fn begun(mut self, rng: Rng, nodes: usize) -> Self {
        if let Some(pseudopods) = self.pseudopods_mut() {
            pseudopods.rng = rng;
            pseudopods.network.reset(nodes);
        }
        self
    }

    /// Stops a crawl; pseudopods stay where they are.
    pub(crate) fn stop(&mut self) {
        match self {
            Self::Crawl { front_centre } => *front_centre = None,
            Self::Protrude(pseudopods) => pseudopods.front_centre = None,
            Self::None | Self::FrontPull { .. } | Self::Tow { .. } | Self::Propel { .. } => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_led_by_a_body_has_a_front() {
        assert_eq!(Locomotion::None.front(), None);
        assert_eq!(Locomotion::Tow { max_acceleration: 1.0 }.front(), None);
        assert_eq!(Locomotion::FrontPull { front: 3 }.front(), Some(3));
        assert_eq!(Locomotion::Crawl { front_centre: None }.front(), None);
        assert_eq!(Locomotion::Crawl { front_centre: Some(2) }.front(), Some(2));
    }
}
