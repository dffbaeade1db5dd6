//! Pictures: one list of shapes made from a world, written as SVG or painted as PNG.

pub(crate) mod caption;
pub(crate) mod chemical;
mod obstacle;
mod organism;
mod palette;
pub(crate) mod png;
pub(crate) mod shape;
pub(crate) mod svg;

use microsim_core::glam::Vec2;
use microsim_core::{Kind, World};
use palette::{PAGE, ROOM, ROOM_EDGE, WALL};
use shape::{Colour, Item, Paint, Path, Stroke};

/// Margin around the room, as a share of its longer side; holds the scale bar.
const MARGIN: f32 = 0.035;

/// What is seen of a world, in its own units, y upwards.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    low: Vec2,
    high: Vec2,
    background: Colour,
    items: Vec<Item>,
}

/// Pixels of a drawing: scale and size.
#[derive(Clone, Copy, Debug)]
struct Frame {
    low: Vec2,
    high: Vec2,
    scale: f32,
    width: u32,
    height: u32,
}

impl Drawing {
    /// Pixels such that the longer side has `longest`.
    fn frame(&self, longest: u32) -> Frame {
        let size = self.high - self.low;
        let scale = longest as f32 / size.max_element();
        let pixels = |units: f32| ((units * scale).round() as u32).clamp(1, longest);
        Frame { low: self.low, high: self.high, scale, width: pixels(size.x), height: pixels(size.y) }
    }
}

impl Frame {
    /// Place of a point, y downwards.
    fn place(&self, point: Vec2) -> Vec2 {
        Vec2::new(point.x - self.low.x, self.high.y - point.y) * self.scale
    }
}

/// Draws everything that is in the world.
pub(crate) fn draw(world: &World) -> Drawing {
    let size = world.config().size;
    let margin = Vec2::splat(size.max_element() * MARGIN);
    let mut items = vec![room(size)];
    items.extend(chemical::draw(world));
    let mut views: Vec<_> = world.view().organisms().collect();
    views.sort_by_key(|view| layer(view.kind()));
    items.extend(views.iter().copied().filter_map(organism::halo));
    items.extend(world.obstacles().flat_map(obstacle::draw));
    items.extend(views.into_iter().flat_map(organism::draw));
    items.extend(walls(size));
    items.extend(caption::draw(size, margin.x, world.time()));
    items.retain(Item::is_finite);
    Drawing { low: -margin, high: size + margin, background: PAGE, items }
}

/// What lies lower is drawn first. Amoeboid cells lie above what they may have taken in: they are translucent.
fn layer(kind: Kind) -> u8 {
    match kind {
        Kind::FluidBlock => 0,
        Kind::Platelet => 1,
        Kind::Agar => 2,
        Kind::RigidCell => 4,
        Kind::AmoeboidCell => 5,
        Kind::Probe => 6,
        _ => 3,
    }
}

fn room(size: Vec2) -> Item {
    let paint = Paint::Radial { centre: size * 0.5, radius: size.length() * 0.5, inner: ROOM, outer: ROOM_EDGE };
    Item::filled(Path::polygon(&corners(size)), paint)
}

/// The line around the room lies outside of it, above a border that hides what obstacles have beyond the room.
fn walls(size: Vec2) -> [Item; 2] {
    let longest = size.max_element();
    let around = |width: f32, colour| {
        let half = Vec2::splat(width * 0.5);
        let outside = corners(size + half * 2.0).map(|corner| corner - half);
        Item::stroked(Path::polygon(&outside), Stroke::new(colour, width))
    };
    [around(longest * MARGIN * 2.0, PAGE), around(longest * 0.004, WALL)]
}

fn corners(size: Vec2) -> [Vec2; 4] {
    [Vec2::ZERO, Vec2::new(size.x, 0.0), size, Vec2::new(0.0, size.y)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::WorldConfig;

    #[test]
    fn the_room_fills_the_frame_but_for_the_margin() {
        let world = World::new(WorldConfig::default()).unwrap();
        let frame = draw(&world).frame(1600);
        assert_eq!(frame.width, 1600);
        assert!(frame.height < frame.width);
        let corner = frame.place(Vec2::new(0.0, world.config().size.y));
        assert!((corner.x - corner.y).abs() < 0.01 && corner.x > 0.0);
    }

    #[test]
    fn a_narrow_room_still_has_pixels() {
        let config = WorldConfig { size: Vec2::new(20_000.0, 1.0), ..WorldConfig::default() };
        let frame = draw(&World::new(config).unwrap()).frame(1600);
        assert!(frame.height >= 1 && frame.width == 1600);
    }
}
