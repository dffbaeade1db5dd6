//! The front of a crawling cell.

use crate::microscope::maths::{larger, smoothstep};
use crate::template::Role;
use crate::world::view::OrganismView;
use glam::Vec2;

/// Speed of which a cell's front is half as strong as it can be by speed alone, micrometres/s.
const CRAWLING: f32 = 12.0;
/// Strength of a front over the skewness of the cell's outline; a cell with a slender tail has about 0.12.
const SKEWED: f32 = 8.0;

/// Where a cell heads, from how it moves and is shaped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Front {
    /// Unit vector; any at rest.
    pub direction: Vec2,
    /// 0 at rest to 1.
    pub strength: f32,
    /// How slender the tail is, 0 to 1.
    pub tail: f32,
    /// Farthest that the cell reaches along `way` and against it, from its centre.
    pub ahead: f32,
    pub behind: f32,
}

impl Front {
    pub(super) fn of(organism: OrganismView<'_>, outline: &[Vec2], centre: Vec2, radius: f32) -> Self {
        let cytoplasm = || organism.particles().filter(|particle| particle.role == Role::Cytoplasm);
        let velocity = cytoplasm().map(|p| p.velocity).sum::<Vec2>() / larger(cytoplasm().count() as f32, 1.0);
        let cubed = |&p: &Vec2| (p - centre) * ((p - centre).length_squared() / (radius * radius * radius));
        let skew = outline.iter().map(cubed).sum::<Vec2>() / outline.len() as f32;
        // A narrow tail lies far out, and the front is opposite. The shape counts most: it cannot change at once, while
        // the velocity does when a cell changes its goal.
        let polarity = velocity / (velocity.length() + CRAWLING) * 0.5 - skew * SKEWED;
        let direction = polarity.try_normalize().unwrap_or(Vec2::X);
        let farthest = |direction: Vec2| outline.iter().map(|&p| (p - centre).dot(direction)).fold(0.0, larger);
        Self {
            direction,
            strength: smoothstep(0.1, 0.6, polarity.length()),
            tail: smoothstep(0.05, 0.12, skew.length()),
            ahead: farthest(direction),
            behind: farthest(-direction),
        }
    }
}
