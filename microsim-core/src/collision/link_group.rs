//! Neighbouring links of a ring as the search for discs sees them, eight side by side.

use super::aabb::Aabb;
use super::disc::Disc;
use crate::instruction_set;
use crate::particle::LANES;
use glam::{Vec2, Vec4};

/// A value for each link.
pub(super) type Lanes = [f32; LANES];

/// A node of a ring, and half the width of the link that begins there: its radius and half of the margin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub at: Vec2,
    pub half_width: f32,
}

/// Up to eight links; lanes without one are near nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkGroup {
    /// Place of the first one in its ring.
    pub first: u32,
    /// The box around all places within the half width of any of them, and some more: rounding takes nothing away that is near.
    pub aabb: Aabb,
    /// One end of each link, and from there to the other one, x and y.
    a: [Lanes; 2],
    along: [Lanes; 2],
    squared_length: Lanes,
    half_width: Lanes,
}

impl LinkGroup {
    /// The links between neighbours of up to nine nodes, of which the first one is in place `first`.
    pub(super) fn of(first: usize, nodes: &[Node]) -> Self {
        // Nothing is nearer than a width that is no number.
        let (none, mut half_width, mut aabb) = ([0.0; LANES], [f32::NAN; LANES], Aabb::EMPTY);
        let ([mut a_x, mut a_y], [mut along_x, mut along_y]) = ([none; 2], [none; 2]);
        for (link, l) in nodes.windows(2).zip(0..LANES) {
            let [a, b] = [link[0], link[1]];
            let along = b.at - a.at;
            (a_x[l], a_y[l], along_x[l], along_y[l], half_width[l]) = (a.at.x, a.at.y, along.x, along.y, a.half_width);
            aabb = aabb.union(Aabb::around(a.at, a.half_width)).union(Aabb::around(b.at, a.half_width));
        }
        let squared_length = each(|l| along_x[l] * along_x[l] + along_y[l] * along_y[l]);
        let (a, along, aabb) = ([a_x, a_y], [along_x, along_y], aabb.shrunk(0.0));
        Self { first: first as u32, aabb, a, along, squared_length, half_width }
    }

    /// Squared distances of the links that a disc may touch; of the others, infinity.
    #[inline(always)]
    pub(super) fn squared_distances(&self, disc: &Disc) -> Lanes {
        let Self { a: [a_x, a_y], along: [along_x, along_y], squared_length, half_width, .. } = self;
        let (from_x, from_y) = (each(|l| disc.at.x - a_x[l]), each(|l| disc.at.y - a_y[l]));
        let dot = each(|l| from_x[l] * along_x[l] + from_y[l] * along_y[l]);
        let fraction = each(|l| dot[l] / squared_length[l]);
        // By one comparison after the other, or else there would be branches. A link without length has no fraction.
        let fraction = each(|l| if fraction[l] > 0.0 { fraction[l] } else { 0.0 });
        let fraction = each(|l| if fraction[l] < 1.0 { fraction[l] } else { 1.0 });
        let (x, y) = (each(|l| from_x[l] - along_x[l] * fraction[l]), each(|l| from_y[l] - along_y[l] * fraction[l]));
        let squared = each(|l| x[l] * x[l] + y[l] * y[l]);
        let distance = each(|l| disc.swept_radius + half_width[l]);
        each(|l| if squared[l] < distance[l] * distance[l] { squared[l] } else { f32::INFINITY })
    }
}

/// Which of these are finite, one bit each. Not to be used in the kernel that makes them: it would keep the compiler from using
/// all lanes.
pub(super) fn finite(squared: &Lanes) -> u32 {
    let four = |k: usize| Vec4::from_slice(&squared[k..]).cmplt(Vec4::INFINITY).bitmask();
    four(0) | four(4) << 4
}

/// A value for each link.
#[inline(always)]
fn each(value: impl Fn(usize) -> f32) -> Lanes {
    instruction_set::each(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::segment::nearest_on_segment;
    use crate::rng::Rng;

    #[test]
    fn a_disc_is_near_the_links_that_it_may_touch() {
        let (mut rng, mut hits) = (Rng::new(2, 6), 0);
        let mut place = || Vec2::new(rng.range(0.0, 9.0), rng.range(0.0, 9.0));
        let nodes: Vec<Node> = (0..12).map(|_| Node { at: place(), half_width: 0.5 }).collect();
        let links: Vec<[Vec2; 2]> = nodes.windows(2).map(|link| [link[0].at, link[1].at]).collect();
        for _ in 0..1000 {
            let disc = Disc { at: place(), swept_radius: 0.7, index: 0 };
            for first in [0, 8] {
                let group = LinkGroup::of(first, &nodes[first..(first + LANES + 1).min(nodes.len())]);
                let near = finite(&group.squared_distances(&disc));
                for k in first..first + LANES {
                    let is_near = near >> (k - first) & 1 == 1;
                    let gap = |[a, b]: [Vec2; 2]| (disc.at - nearest_on_segment(a, b, disc.at)).length() - 1.2;
                    assert_eq!(is_near, k < links.len() && gap(links[k]) < 0.0, "link {k}");
                    assert!(!is_near || group.aabb.overlaps(disc.aabb()));
                    hits += u32::from(is_near);
                }
            }
        }
        assert!(hits > 1000, "{hits}");
    }
}
