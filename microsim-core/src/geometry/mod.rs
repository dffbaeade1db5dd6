//! Plane geometry: polygons, rings of points and triangulation.
//!
//! Pure functions on slices of [`glam::Vec2`]. Polygons are closed (the last vertex joins the first) and need not be convex;
//! +y points up, so counter-clockwise is the positive direction. Results have the same bits on every platform: only
//! `+ - * /`, `sqrt`, comparisons and `libm` are used. No input makes a function panic, NaN included.

pub(crate) mod coverage;
pub mod outline;
pub(crate) mod period;
pub mod polygon;
pub mod ring;
pub mod segment;
pub mod triangulate;

pub use outline::{excess_turning, quarter_widths};
pub use polygon::{centroid, contains_point, is_simple, perimeter, signed_area};
pub use ring::{direction_or, ellipse, nearest_index, rotate, unit_vector};
pub use segment::nearest_on_segment;
pub use triangulate::triangulate;

#[cfg(test)]
pub(crate) mod arbitrary {
    //! Random polygons for the property tests of this module.

    use core::f32::consts::TAU;
    use glam::Vec2;
    use proptest::prelude::*;

    /// A counter-clockwise simple polygon, possibly concave, star-shaped around its centre.
    ///
    /// The jitter stays below 0.4 of a slot: a larger one could open a gap of more than half a
    /// turn between two of three vertices, and the centre would then lie outside.
    pub(crate) fn star_polygon() -> impl Strategy<Value = Vec<Vec2>> {
        let spoke = (0.5f32..10.0, 0.0f32..0.4);
        let centre = (-20.0f32..20.0, -20.0f32..20.0);
        (prop::collection::vec(spoke, 3..40), centre)
            .prop_map(|(spokes, (x, y))| place_spokes(&spokes, Vec2::new(x, y)))
    }

    /// A counter-clockwise convex polygon that is never thin: vertices on a circle.
    pub(super) fn convex_polygon() -> impl Strategy<Value = Vec<Vec2>> {
        let centre = (-20.0f32..20.0, -20.0f32..20.0);
        (0.5f32..10.0, prop::collection::vec(0.0f32..0.4, 3..40), centre).prop_map(|(radius, jitter, (x, y))| {
            let spokes: Vec<_> = jitter.into_iter().map(|jitter| (radius, jitter)).collect();
            place_spokes(&spokes, Vec2::new(x, y))
        })
    }

    /// Points in no particular order: as a polygon they mostly cross themselves.
    pub(super) fn tangled_polygon() -> impl Strategy<Value = Vec<Vec2>> {
        let point = (-10.0f32..10.0, -10.0f32..10.0).prop_map(|(x, y)| Vec2::new(x, y));
        prop::collection::vec(point, 0..30)
    }

    fn place_spokes(spokes: &[(f32, f32)], centre: Vec2) -> Vec<Vec2> {
        let slot = TAU / spokes.len() as f32;
        let place = |(index, &(radius, jitter)): (usize, &(f32, f32))| {
            centre + super::unit_vector((index as f32 + jitter) * slot) * radius
        };
        spokes.iter().enumerate().map(place).collect()
    }
}
