//! Neighbouring links of a ring as the search for discs sees them, eight side by side.

use super::aabb::Aabb;
use super::disc_grid::Disc;
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

    /// Which of the links a disc may touch.
    #[inline(always)]
    pub(super) fn near(&self, disc: &Disc) -> [bool; LANES] {
        let (at, low, high) = (disc.at, disc.aabb().low(), disc.aabb().high());
        let mut near = [false; LANES];
        for (l, near) in near.iter_mut().enumerate() {
            let (along_x, along_y) = (self.b[0][l] - self.a[0][l], self.b[1][l] - self.a[1][l]);
            let (from_x, from_y) = (at.x - self.a[0][l], at.y - self.a[1][l]);
            // As in `nearest_on_segment`.
            let fraction = (from_x * along_x + from_y * along_y) / (along_x * along_x + along_y * along_y);
            let nearest = |a: f32, b: f32, along: f32| {
                let before = if fraction > 0.0 { a + along * fraction } else { a };
                if fraction >= 1.0 { b } else { before }
            };
            let x = at.x - nearest(self.a[0][l], self.b[0][l], along_x);
            let y = at.y - nearest(self.a[1][l], self.b[1][l], along_y);
            let distance = disc.swept_radius + self.half_width[l];
            *near = (x * x + y * y < distance * distance)
                & (low.x <= self.high[0][l])
                & (low.y <= self.high[1][l])
                & (high.x >= self.low[0][l])
                & (high.y >= self.low[1][l]);
        }
        near
    }
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
                for (is_near, k) in group.near(&disc).into_iter().zip(first..) {
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
