//! The one texture, painted by rules: everything drawn shares it, so that everything drawn is one batch.

use microsim_core::Rng;
use microsim_core::glam::Vec2;

/// Side of a tile, pixels.
pub(crate) const SIDE: usize = 256;
const TILES: usize = 5;
/// Pixels that are kept free around a tile, so that neighbours do not bleed in.
pub(crate) const GUARD: f32 = 2.0;

/// Size of the texture, pixels.
pub(crate) const WIDTH: u16 = (SIDE * TILES) as u16;
pub(crate) const HEIGHT: u16 = SIDE as u16;

/// A square picture of the atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tile {
    /// A disc with a sharp edge.
    Disc,
    /// A spot that fades out to its rim.
    Soft,
    /// The inside of a rigid cell, front to the right.
    Cell,
    /// A disc that is thinner in its middle.
    Platelet,
    /// Grain of the film, as much darker as lighter.
    Grain,
}

impl Tile {
    /// Texture coordinates of a point of the tile, -1 to 1 on both axes, y down.
    pub(crate) fn at(self, point: Vec2) -> Vec2 {
        let middle = Vec2::new((self as usize as f32 + 0.5) * SIDE as f32, 0.5 * SIDE as f32);
        let half_side = 0.5 * SIDE as f32 - GUARD;
        (middle + point * half_side) / Vec2::new(f32::from(WIDTH), f32::from(HEIGHT))
    }
}

/// Texture coordinates of plain white.
pub(crate) fn plain() -> Vec2 {
    Tile::Disc.at(Vec2::ZERO)
}

/// The texture, four bytes per pixel.
pub(crate) fn pixels() -> Vec<u8> {
    let mut bytes = vec![0; SIDE * TILES * SIDE * 4];
    let spots = Spots::scattered(210);
    let mut grain = Rng::new(7, 0);
    for y in 0..SIDE {
        for (tile, paint) in [disc, soft, cell, platelet].iter().enumerate() {
            for x in 0..SIDE {
                let to_tile = |k: usize| (k as f32 + 0.5 - 0.5 * SIDE as f32) / (0.5 * SIDE as f32 - GUARD);
                let (shade, alpha) = paint(Vec2::new(to_tile(x), to_tile(y)), &spots);
                put(&mut bytes, tile * SIDE + x, y, shade, alpha);
            }
        }
        for x in 0..SIDE {
            let sum = grain.unit() + grain.unit() + grain.unit() - 1.5;
            let shade = if sum > 0.0 { 1.0 } else { 0.0 };
            put(&mut bytes, (TILES - 1) * SIDE + x, y, shade, sum.abs());
        }
    }
    bytes
}

fn put(bytes: &mut [u8], x: usize, y: usize, shade: f32, alpha: f32) {
    let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    let at = (y * SIDE * TILES + x) * 4;
    bytes[at..at + 4].copy_from_slice(&[byte(shade), byte(shade), byte(shade), byte(alpha)]);
}

fn disc(point: Vec2, _: &Spots) -> (f32, f32) {
    let edge = 0.5 * SIDE as f32 * (0.985 - point.length());
    (1.0, edge / 2.5 + 0.5)
}

fn soft(point: Vec2, _: &Spots) -> (f32, f32) {
    let rest = (1.0 - point.length_squared()).max(0.0);
    (1.0, rest * rest)
}

/// Granules and vacuoles in a body that is thick in the middle and has a striped skin.
fn cell(point: Vec2, spots: &Spots) -> (f32, f32) {
    let r = point.length();
    let dome = 0.80 - 0.16 * r * r * r * r;
    let skin = 0.025 * (point.y * 46.0 + 2.0 * point.x * point.x).sin() * smooth(0.2, 0.9, r);
    // The groove that leads to the mouth, from the front to the middle.
    let from_groove = point.y - 0.38 * point.x + 0.16;
    let groove = 0.12 * (-(from_groove * from_groove) / 0.012).exp() * smooth(-0.25, 0.1, point.x);
    let rim = 0.14 * smooth(0.90, 0.95, r) - 0.26 * smooth(0.95, 0.99, r);
    (dome + skin - groove + rim + spots.shade(point), 1.0)
}

fn platelet(point: Vec2, _: &Spots) -> (f32, f32) {
    let r = point.length();
    let dent = 0.16 * (-(r * r) / 0.16).exp();
    let ring = -0.14 * (-(r - 0.66) * (r - 0.66) / 0.035).exp();
    let rim = 0.10 * smooth(0.82, 0.93, r) - 0.24 * smooth(0.93, 1.0, r);
    (0.84 + dent + ring + rim, 1.0)
}

fn smooth(from: f32, to: f32, value: f32) -> f32 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Dark and bright spots in a disc of radius 1.
struct Spots(Vec<(Vec2, f32, f32)>);

impl Spots {
    fn scattered(count: usize) -> Self {
        let mut dice = Rng::new(3, 0);
        let spot = |k: usize, dice: &mut Rng| {
            let (angle, far) = (dice.unit() * std::f32::consts::TAU, 0.86 * dice.unit().sqrt());
            // A few big vacuoles, many granules.
            let radius = if k < 9 { 0.08 + 0.05 * dice.unit() } else { 0.014 + 0.03 * dice.unit() };
            let shade = if k < 9 { 0.10 } else { 0.30 * (dice.unit() - 0.62) };
            (Vec2::from_angle(angle) * far, radius, shade)
        };
        Self((0..count).map(|k| spot(k, &mut dice)).collect())
    }

    fn shade(&self, point: Vec2) -> f32 {
        let near = self.0.iter().filter(|(at, radius, _)| (point - *at).length_squared() < 2.3 * radius * radius);
        near.map(|&(at, radius, shade)| {
            let q = (point - at).length() / radius;
            // A dark line around what is bright inside.
            let line = if shade > 0.0 { -0.9 * shade * (-(q - 1.05) * (q - 1.05) / 0.03).exp() } else { 0.0 };
            shade * (1.0 - smooth(0.6, 1.1, q)) + line
        })
        .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_lie_in_the_texture_and_apart() {
        let tiles = [Tile::Disc, Tile::Soft, Tile::Cell, Tile::Platelet, Tile::Grain];
        for (k, tile) in tiles.into_iter().enumerate() {
            let (low, high) = (tile.at(Vec2::splat(-1.0)), tile.at(Vec2::ONE));
            assert!(low.x > k as f32 / TILES as f32 && high.x < (k + 1) as f32 / TILES as f32);
            assert!(low.y > 0.0 && high.y < 1.0);
        }
    }

    #[test]
    fn the_texture_has_its_size_and_plain_is_white() {
        let pixels = pixels();
        assert_eq!(pixels.len(), usize::from(WIDTH) * usize::from(HEIGHT) * 4);
        let at = plain() * Vec2::new(f32::from(WIDTH), f32::from(HEIGHT));
        let k = (at.y as usize * usize::from(WIDTH) + at.x as usize) * 4;
        assert_eq!(pixels[k..k + 4], [255; 4]);
        assert_eq!(pixels[3], 0, "a corner of the disc is not clear");
    }
}
