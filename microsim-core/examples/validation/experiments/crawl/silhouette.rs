//! Shapes of outlines: area, solidity, overlap.

use microsim_core::glam::Vec2;

/// Places across the square in which outlines are compared.
const SAMPLES: usize = 64;

/// An outline in its own frame: around its centroid, not rotated.
pub(crate) struct Silhouette {
    pub centre: Vec2,
    pub area: f64,
    /// Its area over that of its convex hull.
    pub solidity: f64,
    /// Which places of a square of half-width `reach` around its centroid are inside.
    inside: Vec<bool>,
}

impl Silhouette {
    pub(crate) fn of(outline: &[Vec2], reach: f32) -> Self {
        let (area, centre) = area_and_centroid(outline);
        let own: Vec<Vec2> = outline.iter().map(|&at| at - centre).collect();
        let solidity = area / area_and_centroid(&convex_hull(own.clone())).0;
        Self { centre, area, solidity, inside: raster(&own, reach) }
    }

    /// Area of the intersection over that of the union with another one.
    pub(crate) fn overlap(&self, other: &Self) -> f64 {
        let count = |meets: fn(bool, bool) -> bool| {
            self.inside.iter().zip(&other.inside).filter(|&(&a, &b)| meets(a, b)).count() as f64
        };
        count(|a, b| a && b) / count(|a, b| a || b)
    }
}

fn area_and_centroid(polygon: &[Vec2]) -> (f64, Vec2) {
    let (mut area, mut moment) = (0.0, Vec2::ZERO);
    let first = polygon[0];
    for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let cross = (*a - first).perp_dot(*b - first);
        area += 0.5 * f64::from(cross);
        moment += (*a - first + *b - first) * cross;
    }
    (area, first + moment / (6.0 * area as f32))
}

/// Convex hull, counter-clockwise (Andrew 1979).
fn convex_hull(mut points: Vec<Vec2>) -> Vec<Vec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for at in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(at - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(at);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

fn raster(polygon: &[Vec2], reach: f32) -> Vec<bool> {
    let place = |k: usize| ((k as f32 + 0.5) / SAMPLES as f32 * 2.0 - 1.0) * reach;
    let mut inside = Vec::with_capacity(SAMPLES * SAMPLES);
    for y in (0..SAMPLES).map(place) {
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1)).filter(|(a, b)| (a.y > y) != (b.y > y));
        let crossings: Vec<f32> = edges.map(|(a, b)| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)).collect();
        let is_inside = |x: f32| crossings.iter().filter(|&&crossing| crossing > x).count() % 2 == 1;
        inside.extend((0..SAMPLES).map(|k| is_inside(place(k))));
    }
    inside
}
