//! Pictures: the drawing of a world on a page with a caption, written as SVG or painted as PNG.

pub(crate) mod caption;
pub(crate) mod png;
pub(crate) mod svg;

use microsim_core::World;
use microsim_core::drawing::palette::PAGE;
use microsim_core::drawing::shape::{Colour, Item};
use microsim_core::drawing::{self, DrawingLayer, MARGIN};
use microsim_core::glam::Vec2;

/// A page with a world on it, in the world's units, y upwards.
#[derive(Clone, Debug)]
pub(crate) struct PicturePage {
    low: Vec2,
    high: Vec2,
    background: Colour,
    items: Vec<Item>,
}

/// From the world to pixels: scale and size.
#[derive(Clone, Copy, Debug)]
struct Viewport {
    low: Vec2,
    high: Vec2,
    scale: f32,
    width: u32,
    height: u32,
}

impl PicturePage {
    /// Width and height in pixels if its longer side has `longest`.
    pub(crate) fn pixels(&self, longest: u32) -> [usize; 2] {
        let viewport = self.viewport(longest);
        [viewport.width as usize, viewport.height as usize]
    }

    /// Pixels such that the longer side has `longest`.
    fn viewport(&self, longest: u32) -> Viewport {
        let size = self.high - self.low;
        let scale = longest as f32 / size.max_element();
        let pixels = |units: f32| ((units * scale).round() as u32).clamp(1, longest);
        Viewport { low: self.low, high: self.high, scale, width: pixels(size.x), height: pixels(size.y) }
    }
}

impl Viewport {
    /// Place of a point, y downwards.
    fn place(&self, point: Vec2) -> Vec2 {
        Vec2::new(point.x - self.low.x, self.high.y - point.y) * self.scale
    }
}

/// Draws everything that is in the world, with a margin around the room that holds the caption.
pub(crate) fn draw(world: &World) -> PicturePage {
    let size = world.config().size;
    let margin = Vec2::splat(size.max_element() * MARGIN);
    let mut items = drawing::draw(world.view(), [Vec2::MIN, Vec2::MAX], &DrawingLayer::ALL);
    items.extend(caption::draw(size, margin.x, world.time()));
    PicturePage { low: -margin, high: size + margin, background: PAGE, items }
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::WorldConfig;

    #[test]
    fn the_room_fills_the_page_but_for_the_margin() {
        let world = World::new(WorldConfig::default()).unwrap();
        let viewport = draw(&world).viewport(1600);
        assert_eq!(viewport.width, 1600);
        assert!(viewport.height < viewport.width);
        let corner = viewport.place(Vec2::new(0.0, world.config().size.y));
        assert!((corner.x - corner.y).abs() < 0.01 && corner.x > 0.0);
    }

    #[test]
    fn a_narrow_room_still_has_pixels() {
        let config = WorldConfig { size: Vec2::new(20_000.0, 1.0), ..WorldConfig::default() };
        let viewport = draw(&World::new(config).unwrap()).viewport(1600);
        assert!(viewport.height >= 1 && viewport.width == 1600);
    }
}
