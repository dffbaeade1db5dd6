//! A smooth curve along the nodes of an outline.

use glam::Vec2;

/// Points of the curve per node.
const PER_NODE: usize = 4;

/// A closed cubic B-spline through the neighbourhood of the nodes: no corners where nodes are.
pub(super) fn smooth(nodes: &[Vec2]) -> Vec<Vec2> {
    let count = nodes.len();
    let point = |k: usize| {
        let (node, t) = (k / PER_NODE, (k % PER_NODE) as f32 / PER_NODE as f32);
        let p = |offset: usize| nodes[(node + count + offset - 1) % count];
        let (t2, t3) = (t * t, t * t * t);
        let weights =
            [1.0 - 3.0 * t + 3.0 * t2 - t3, 4.0 - 6.0 * t2 + 3.0 * t3, 1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3, t3];
        weights.iter().enumerate().map(|(offset, weight)| p(offset) * (weight / 6.0)).sum()
    };
    (0..count * PER_NODE).map(point).collect()
}
