//! Neighbouring links of a ring as the search for discs sees them, eight side by side.

use super::aabb::Aabb;
use super::disc_grid::Disc;
use crate::instruction_set::{self, Dispatch};
use crate::particle::LANES;
use glam::Vec2;

/// A value for each link.
type Lanes = [f32; LANES];

/// Up to eight links; lanes without one are near nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkGroup {
    /// Place of the first one in its ring.
    pub first: u32,
    /// The box around all places within the half width of any of them, and some more: rounding takes nothing away that is near.
    pub aabb: Aabb,
    /// Both ends of each link, and the box of the link, x and y.
    a: [Lanes; 2],
    b: [Lanes; 2],
    low: [Lanes; 2],
    high: [Lanes; 2],
    /// Radius of the nodes and half of the margin.
    half_width: Lanes,
}

impl LinkGroup {
    /// Up to eight links from the one in place `first` on, each by its ends and its half width.
    pub(super) fn of(first: usize, links: impl Iterator<Item = ([Vec2; 2], f32)>) -> Self {
        let none = [[0.0; LANES]; 2];
        let (low, high) = ([[f32::INFINITY; LANES]; 2], [[f32::NEG_INFINITY; LANES]; 2]);
        let (aabb, half_width) = (Aabb::EMPTY, [0.0; LANES]);
        let mut group = Self { first: first as u32, aabb, a: none, b: none, low, high, half_width };
        for (lane, (ends, half_width)) in links.take(LANES).enumerate() {
            group.set(lane, ends, half_width);
        }
        group
    }

    fn set(&mut self, lane: usize, [a, b]: [Vec2; 2], half_width: f32) {
        let aabb = Aabb::new(a.min(b) - half_width, a.max(b) + half_width).shrunk(0.0);
        let columns = [&mut self.a, &mut self.b, &mut self.low, &mut self.high];
        for (column, Vec2 { x, y }) in columns.into_iter().zip([a, b, aabb.low(), aabb.high()]) {
            (column[0][lane], column[1][lane]) = (x, y);
        }
        self.half_width[lane] = half_width;
        self.aabb = self.aabb.union(aabb);
    }

    /// Which of the links a disc may touch, one bit each.
    #[inline(always)]
    pub(super) fn near(&self, disc: &Disc, dispatch: Dispatch) -> u32 {
        // Bits are made outside of the kernel: inside they would keep the compiler from using all lanes.
        let near = dispatch.run(
            #[inline(always)]
            || self.squared_distances(disc),
        );
        let bits: [u32; LANES] = std::array::from_fn(|l| if near[l] < f32::INFINITY { 1 << l } else { 0 });
        bits.iter().fold(0, |all, bit| all | bit)
    }

    /// Squared distances of the links that a disc may touch; of the others, infinity.
    #[inline(always)]
    fn squared_distances(&self, disc: &Disc) -> Lanes {
        let (at, low, high) = (disc.at, disc.aabb().low(), disc.aabb().high());
        let Self { a: [a_x, a_y], b: [b_x, b_y], half_width, .. } = self;
        let (along_x, along_y) = (each(|l| b_x[l] - a_x[l]), each(|l| b_y[l] - a_y[l]));
        let (from_x, from_y) = (each(|l| at.x - a_x[l]), each(|l| at.y - a_y[l]));
        let dot = each(|l| from_x[l] * along_x[l] + from_y[l] * along_y[l]);
        let squared_length = each(|l| along_x[l] * along_x[l] + along_y[l] * along_y[l]);
        // As in `nearest_on_segment`; chosen by one comparison after the other, or else there would be branches.
        let fraction = each(|l| dot[l] / squared_length[l]);
        let (inner_x, inner_y) =
            (each(|l| a_x[l] + along_x[l] * fraction[l]), each(|l| a_y[l] + along_y[l] * fraction[l]));
        let before_x = each(|l| if fraction[l] > 0.0 { inner_x[l] } else { a_x[l] });
        let before_y = each(|l| if fraction[l] > 0.0 { inner_y[l] } else { a_y[l] });
        let nearest_x = each(|l| if fraction[l] >= 1.0 { b_x[l] } else { before_x[l] });
        let nearest_y = each(|l| if fraction[l] >= 1.0 { b_y[l] } else { before_y[l] });
        let (x, y) = (each(|l| at.x - nearest_x[l]), each(|l| at.y - nearest_y[l]));
        let squared = each(|l| x[l] * x[l] + y[l] * y[l]);
        let distance = each(|l| disc.swept_radius + half_width[l]);
        let none = f32::INFINITY;
        let near = each(|l| if squared[l] < distance[l] * distance[l] { squared[l] } else { none });
        let near = each(|l| if low.x <= self.high[0][l] { near[l] } else { none });
        let near = each(|l| if low.y <= self.high[1][l] { near[l] } else { none });
        let near = each(|l| if high.x >= self.low[0][l] { near[l] } else { none });
        each(|l| if high.y >= self.low[1][l] { near[l] } else { none })
    }
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
        let links: Vec<[Vec2; 2]> = (0..11).map(|_| [place(), place()]).collect();
        for _ in 0..1000 {
            let disc = Disc { at: place(), swept_radius: 0.7, index: 0 };
            for first in [0, 8] {
                let group = LinkGroup::of(first, links[first..].iter().map(|ends| (*ends, 0.5)));
                let near = group.near(&disc, Dispatch::default());
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
