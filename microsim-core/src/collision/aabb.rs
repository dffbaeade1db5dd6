//! Axis-aligned bounding boxes that are quick to compare: most of a pair search asks whether two of them overlap.

use crate::instruction_set::each;
use crate::particle::LANES;
use glam::{Vec2, Vec4, Vec4Swizzles};

/// Some units in the last place.
const ROUNDING: f32 = 1e-6;

/// A box, as `(-low, high)`: two overlap if four sums are positive, which is one comparison of four lanes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Aabb(Vec4);

impl Aabb {
    /// Holds nothing; its union with another box is that one.
    pub(super) const EMPTY: Self = Self(Vec4::NEG_INFINITY);

    pub(super) fn new(low: Vec2, high: Vec2) -> Self {
        Self(Vec4::new(-low.x, -low.y, high.x, high.y))
    }

    /// The box around a disc.
    #[inline(always)]
    pub(super) fn around(centre: Vec2, radius: f32) -> Self {
        Self(Vec4::new(-centre.x, -centre.y, centre.x, centre.y) + radius)
    }

    pub(super) fn low(self) -> Vec2 {
        -self.0.xy()
    }

    pub(super) fn high(self) -> Vec2 {
        self.0.zw()
    }

    /// The box elsewhere.
    pub(super) fn moved(self, by: Vec2) -> Self {
        Self(self.0 + Vec4::new(-by.x, -by.y, by.x, by.y))
    }

    pub(super) fn centre(self) -> Vec2 {
        (self.low() + self.high()) * 0.5
    }

    /// The box without a rim of this width, or with a little of it: rounding takes nothing away that is inside.
    #[inline(always)]
    pub(super) fn shrunk(self, rim: f32) -> Self {
        Self(self.0 - rim + self.0.abs() * ROUNDING)
    }

    /// The larger one of width and height.
    pub(super) fn extent(self) -> f32 {
        let Vec2 { x, y } = self.high() - self.low();
        if x > y { x } else { y }
    }

    /// The box around both.
    #[inline(always)]
    pub(super) fn union(self, other: Self) -> Self {
        Self(Vec4::select(other.0.cmpgt(self.0), other.0, self.0))
    }

    #[inline(always)]
    pub(super) fn overlaps(self, other: Self) -> bool {
        self.0.cmpge(-other.0.zwxy()).all()
    }
}

/// A box for each lane of a block, which grows disc by disc; as in [`Aabb`].
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneBoxes([[f32; LANES]; 4]);

impl LaneBoxes {
    /// Without any disc.
    pub(super) const EMPTY: Self = Self([[f32::NEG_INFINITY; LANES]; 4]);

    /// Adds a disc to each lane in which the radius is a number.
    #[inline(always)]
    pub(super) fn add(&mut self, x: [f32; LANES], y: [f32; LANES], radius: [f32; LANES]) {
        let [low_x, low_y, high_x, high_y] = &mut self.0;
        *low_x = each(|l| larger(-(x[l] - radius[l]), low_x[l]));
        *low_y = each(|l| larger(-(y[l] - radius[l]), low_y[l]));
        *high_x = each(|l| larger(x[l] + radius[l], high_x[l]));
        *high_y = each(|l| larger(y[l] + radius[l], high_y[l]));
    }

    /// Whether there is no disc in a lane.
    pub(super) fn is_empty(&self, lane: usize) -> bool {
        self.0[0][lane] == f32::NEG_INFINITY
    }

    /// The box of one lane.
    pub(super) fn aabb(&self, lane: usize) -> Aabb {
        Aabb(self.0.map(|side| side[lane]).into())
    }
}

/// The larger one of two numbers, or the second one if the first is none.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_overlap_where_they_share_a_point() {
        let unit = Aabb::new(Vec2::ZERO, Vec2::ONE);
        let at = |x: f32, y: f32| Aabb::new(Vec2::new(x, y), Vec2::new(x + 2.0, y + 2.0));
        for (other, expected) in [
            (at(0.2, 0.2), true),
            (at(1.0, -2.0), true),
            (at(1.1, 0.0), false),
            (at(0.0, 1.1), false),
            (at(-2.1, 0.0), false),
            (at(0.0, -2.1), false),
            (Aabb::EMPTY, false),
        ] {
            assert_eq!((unit.overlaps(other), other.overlaps(unit)), (expected, expected), "{other:?}");
        }
    }

    #[test]
    fn the_box_around_boxes_is_no_larger_than_it_must_be() {
        let both = Aabb::new(Vec2::ZERO, Vec2::ONE).union(Aabb::new(Vec2::new(-1.0, 0.5), Vec2::new(0.5, 3.0)));
        let all = Aabb::EMPTY.union(both);
        assert_eq!((all.low(), all.high()), (Vec2::new(-1.0, 0.0), Vec2::new(1.0, 3.0)));
        assert_eq!((all.centre(), all.extent()), (Vec2::new(0.0, 1.5), 3.0));
    }

    #[test]
    fn boxes_of_lanes_are_those_of_their_discs() {
        let mut boxes = LaneBoxes::EMPTY;
        let lanes = |first: f32| std::array::from_fn::<f32, LANES, _>(|l| first + 0.7 * l as f32);
        let mut radius = lanes(0.1);
        radius[5] = f32::NAN;
        boxes.add(lanes(1.0), lanes(-3.0), radius);
        radius = lanes(0.2);
        (radius[2], radius[5]) = (f32::NAN, f32::NAN);
        boxes.add(lanes(-2.0), lanes(0.3), radius);
        boxes.add(lanes(7.0), lanes(9.0), [f32::NAN; LANES]);
        for l in 0..LANES {
            let aabb = |x: f32, y: f32, r: f32| Aabb::new(Vec2::new(x - r, y - r), Vec2::new(x + r, y + r));
            let first = aabb(lanes(1.0)[l], lanes(-3.0)[l], lanes(0.1)[l]);
            let second = aabb(lanes(-2.0)[l], lanes(0.3)[l], lanes(0.2)[l]);
            let expected = match l {
                2 => first,
                5 => Aabb::EMPTY,
                _ => first.union(second),
            };
            assert_eq!((boxes.aabb(l).0, boxes.is_empty(l)), (expected.0, l == 5), "lane {l}");
        }
    }

    #[test]
    fn a_box_without_its_rim_keeps_all_that_is_inside() {
        let inner = Aabb::new(Vec2::new(-2.0, 0.0), Vec2::new(100.0, 4.0)).shrunk(0.5);
        let (low, high) = (Vec2::new(-1.5, 0.5), Vec2::new(99.5, 3.5));
        assert!(inner.low().cmple(low).all() && inner.high().cmpge(high).all());
        assert!((inner.low() - low).length() < 1e-3 && (inner.high() - high).length() < 1e-3, "{inner:?}");
    }
}
