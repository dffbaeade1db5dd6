//! The walls of a world: four obstacles that it always has, before those that are added.

use crate::collision::obstacle::Obstacle;
use crate::config::{Side, WorldConfig};
use crate::particle::Material;
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;

/// Number of walls.
pub(crate) const WALLS: usize = 4;
/// Friction and restitution of walls.
const WALL_MATERIAL: Material = Material::DEFAULT;

/// Thick slabs around the room, overlapping at the corners: so thick that nothing gets past their middle in a step. In the order
/// of [`crate::Wall`].
pub(crate) fn walls(config: &WorldConfig) -> Vec<Obstacle> {
    let size = config.size;
    let thickness = size.x + size.y + 4.0 * config.max_displacement();
    let half = size * 0.5;
    let slab = |half_extents: Vec2, centre: Vec2| {
        let shape = SharedShape::cuboid(half_extents.x, half_extents.y);
        Obstacle { material: WALL_MATERIAL, ..Obstacle::new(shape, Pose::translation(centre.x, centre.y)) }
    };
    let (across, along) =
        (Vec2::new(half.x + thickness, 0.5 * thickness), Vec2::new(0.5 * thickness, half.y + thickness));
    let slabs = [
        slab(across, Vec2::new(half.x, -0.5 * thickness)),
        slab(across, Vec2::new(half.x, size.y + 0.5 * thickness)),
        slab(along, Vec2::new(-0.5 * thickness, half.y)),
        slab(along, Vec2::new(size.x + 0.5 * thickness, half.y)),
    ];
    let sides = slabs.into_iter().zip(config.sides.in_order());
    sides.map(|(slab, side)| Obstacle { is_enabled: side == Side::Wall, ..slab }).collect()
}
