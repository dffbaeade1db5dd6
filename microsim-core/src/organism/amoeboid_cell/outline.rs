//! Cells of any simple outline: the membrane along it, and cytoplasm within, in the lattice of closest packing.

use super::MAX_NODES;
use crate::error::{Error, in_range, out_of_range};
use crate::geometry::polygon::{crosses_ray, is_simple, perimeter, signed_area};
use crate::geometry::segment::nearest_on_segment;
use glam::Vec2;

/// Most corners.
const MAX_CORNERS: usize = 1000;
/// Farthest that a corner is from the cell's place, units.
const FARTHEST: f32 = 500.0;
/// Nodes that are so many apart along the membrane, or more, must not overlap.
const NEIGHBOURS: usize = 3;
/// Height of a row of the lattice in its spacing: half the root of 3.
const ROW: f32 = 0.866_025_4;

fn check_corners(outline: &[Vec2]) -> Result<(), Error> {
    if outline.len() < 3 || outline.len() > MAX_CORNERS {
        return Err(out_of_range("outline", outline.len() as f64, format!("3 to {MAX_CORNERS} corners")));
    }
    for corner in outline {
        in_range("outline.x", corner.x, -FARTHEST, FARTHEST)?;
        in_range("outline.y", corner.y, -FARTHEST, FARTHEST)?;
    }
    if !is_simple(outline) {
        return Err(Error::unsupported("outline", "an outline that does not cross or touch itself"));
    }
    Ok(())
}

/// Nodes along an outline, counter-clockwise, as many as fit without a gap.
pub(super) fn chain(outline: &[Vec2], node_radius: f32) -> Result<Vec<Vec2>, Error> {
    check_corners(outline)?;
    let mut corners = outline.to_vec();
    if signed_area(&corners) < 0.0 {
        corners.reverse();
    }
    let around = perimeter(&corners);
    let count = around / (2.0 * node_radius);
    if count > MAX_NODES {
        let accepted = format!("at most {MAX_NODES} membrane nodes (perimeter over 2 node radii)");
        return Err(out_of_range("outline", f64::from(count), accepted));
    }
    let chain = divide(&corners, around, count as usize);
    let least = 2.0 * node_radius * (1.0 - 1.0 / 64.0);
    let count = chain.len();
    let overlaps = |k: usize| {
        let far = (k + NEIGHBOURS..count).filter(|j| k + count - j >= NEIGHBOURS);
        far.into_iter().any(|j| (chain[j] - chain[k]).length_squared() < least * least)
    };
    if (0..count).any(overlaps) || !is_simple(&chain) {
        return Err(Error::unsupported(
            "outline",
            "an outline with a node diameter between its sides everywhere, and no corners sharper than 40 degrees",
        ));
    }
    Ok(chain)
}

/// Points along a polygon at equal distances.
fn divide(corners: &[Vec2], around: f32, count: usize) -> Vec<Vec2> {
    let step = around / count as f32;
    let mut points = Vec::with_capacity(count);
    let mut walked = 0.0;
    for (k, &from) in corners.iter().enumerate() {
        let way = corners[(k + 1) % corners.len()] - from;
        let length = way.length();
        while points.len() < count && points.len() as f32 * step < walked + length {
            points.push(from + way * ((points.len() as f32 * step - walked) / length));
        }
        walked += length;
    }
    points
}

/// Points of the lattice that are inside a ring and at least `clearance` from it.
pub(super) fn fill(ring: &[Vec2], spacing: f32, clearance: f32) -> Vec<Vec2> {
    let bounds = |fold: fn(Vec2, Vec2) -> Vec2| ring.iter().copied().reduce(fold).unwrap_or_default();
    let (low, high) = (bounds(Vec2::min), bounds(Vec2::max));
    let (columns, rows) =
        (((high.x - low.x) / spacing) as usize + 1, ((high.y - low.y) / (ROW * spacing)) as usize + 1);
    let in_row = |row: usize| {
        let shift = if row.is_multiple_of(2) { 0.0 } else { 0.5 };
        let place = move |column: usize| low + spacing * Vec2::new(column as f32 + shift, ROW * row as f32);
        let links = links_near(ring, place(0).y, clearance);
        let is_clear = move |point: &Vec2| {
            let mut near = links.iter().map(|&(a, b)| (nearest_on_segment(a, b, *point) - *point).length_squared());
            links.iter().fold(false, |inside, &(a, b)| inside != crosses_ray(a, b, *point))
                && near.all(|squared| squared >= clearance * clearance)
        };
        (0..columns).map(place).filter(is_clear)
    };
    (0..rows).flat_map(in_row).collect()
}

/// Links of a ring that come nearer than `clearance` to a height, those that cross it among them.
fn links_near(ring: &[Vec2], y: f32, clearance: f32) -> Vec<(Vec2, Vec2)> {
    let links = (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()]));
    let [low, high] = [y - clearance, y + clearance];
    links.filter(|(a, b)| (a.y <= high || b.y <= high) && (a.y >= low || b.y >= low)).collect()
}

#[cfg(test)]
mod tests {
    use crate::{AmoeboidCellSpec, Inputs, Placement, World, WorldConfig};
    use glam::Vec2;

    /// A letter L, clockwise.
    fn angle() -> Vec<Vec2> {
        let corners = [[-12.0, -12.0], [-12.0, 14.0], [-2.0, 14.0], [-2.0, -2.0], [14.0, -2.0], [14.0, -12.0]];
        corners.map(Vec2::from).to_vec()
    }

    #[test]
    fn a_cell_has_the_outline_that_it_is_given_and_lives() {
        let spec = AmoeboidCellSpec { outline: angle(), ..AmoeboidCellSpec::default() };
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&spec.into(), Placement::at(60.0, 45.0)).unwrap();
        let outline: Vec<Vec2> = world.view().organism(cell).unwrap().outline().collect();
        let area = crate::geometry::signed_area(&outline);
        assert!((area / (26.0 * 10.0 + 16.0 * 10.0) - 1.0).abs() < 0.02, "counter-clockwise, of area {area}");
        world.validate().unwrap();
        for _ in 0..300 {
            world.step(&Inputs::new());
        }
        world.validate().unwrap();
        assert_eq!(world.census().leaks, 0);
        let after: Vec<Vec2> = world.view().organism(cell).unwrap().outline().collect();
        let after = crate::geometry::signed_area(&after);
        assert!((after / area - 1.0).abs() < 0.3, "{after} after {area}");
        world.divide(cell).unwrap();
    }

    #[test]
    fn outlines_that_cannot_be_a_membrane_are_refused() {
        let refuse = |outline: &[[f32; 2]], field: &str| {
            let outline = outline.iter().map(|&corner| Vec2::from(corner)).collect();
            let spec = AmoeboidCellSpec { outline, ..AmoeboidCellSpec::default() };
            let error = crate::OrganismSpec::from(spec).validate().unwrap_err();
            assert_eq!(error.field(), field, "{error}");
        };
        refuse(&[[0.0, 0.0], [9.0, 0.0]], "outline");
        refuse(&[[0.0, 0.0], [20.0, 20.0], [20.0, 0.0], [0.0, 20.0]], "outline");
        refuse(&[[0.0, 0.0], [f32::NAN, 0.0], [0.0, 9.0]], "outline.x");
        refuse(&[[0.0, 0.0], [40.0, 0.0], [40.0, 1.0], [0.0, 1.0]], "outline");
        refuse(&[[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0]], "outline");
    }
}
