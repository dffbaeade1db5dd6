//! A constraint near a state of rest: one row, or two, of the Jacobian of all constraints.

use glam::Vec2;

/// The gradient of one `C`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JacobianRow {
    /// By node.
    pub gradient: Vec<(u32, Vec2)>,
    pub compliance: f32,
}

impl JacobianRow {
    /// Those of the distance of two nodes: along the line between them, or two of nodes in one place.
    pub(super) fn of_pair([a, b]: [u32; 2], compliance: f32, places: &[Vec2]) -> Vec<Self> {
        let between = places[b as usize] - places[a as usize];
        let normals = match between.try_normalize() {
            Some(normal) => vec![normal],
            None => vec![Vec2::X, Vec2::Y],
        };
        normals.into_iter().map(|normal| Self { gradient: vec![(a, -normal), (b, normal)], compliance }).collect()
    }
}
