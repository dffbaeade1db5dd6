//! Images of what reaches over a periodic side.

use super::shape::{Geometry, Item};
use crate::{Side, WorldConfig};
use glam::Vec2;

/// The displacements of images of what lies in a box that are seen in the room: by its length where the box reaches over a periodic
/// side.
pub(super) fn shifts(config: &WorldConfig, [low, high]: [Vec2; 2]) -> Vec<Vec2> {
    let is_periodic = [config.sides.left, config.sides.bottom].map(|side| side == Side::Periodic);
    let along = |axis: usize| {
        let length = config.size[axis];
        let over = [(low[axis] < 0.0, length), (high[axis] > length, -length)];
        let over = over.into_iter().filter(move |(reaches, _)| is_periodic[axis] && *reaches).map(|(_, shift)| shift);
        std::iter::once(0.0).chain(over)
    };
    let all = along(1).flat_map(|y| along(0).map(move |x| Vec2::new(x, y)));
    all.filter(|shift| *shift != Vec2::ZERO).collect()
}

/// Adds images of all items from one on; of discs, those that are seen in a room of this size.
pub(super) fn add(first: usize, shifts: impl IntoIterator<Item = Vec2>, size: Vec2, items: &mut Vec<Item>) {
    let end = items.len();
    for shift in shifts {
        for k in first..end {
            let mut image = items[k].clone().moved(shift);
            if let Geometry::Discs(discs) = &mut image.geometry {
                // Those of a fluid are all around the room.
                discs.retain(|&(at, radius)| (at + radius).cmpge(Vec2::ZERO).all() && (at - radius).cmple(size).all());
            }
            items.push(image);
        }
    }
}
