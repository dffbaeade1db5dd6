//! Discs as the search for pairs sees them: one, and four of a body that are compared with a box or with another disc at a time.

use super::aabb::Aabb;
use glam::{Vec2, Vec4};

/// Number of discs in a group.
pub(super) const WIDTH: usize = 4;

/// What the search for pairs has to know of a particle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Disc {
    /// Its place in the room.
    pub at: Vec2,
    /// Its radius and the largest displacement of a step.
    pub swept_radius: f32,
    /// Which particle it is.
    pub index: u32,
}

/// Four discs side by side. Where there is none that collides with anything, the radius is no number, so that it is near nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiscGroup {
    pub x: [f32; WIDTH],
    pub y: [f32; WIDTH],
    pub swept_radius: [f32; WIDTH],
}

impl DiscGroup {
    pub(super) const EMPTY: Self = Self { x: [0.0; WIDTH], y: [0.0; WIDTH], swept_radius: [f32::NAN; WIDTH] };

    /// One disc.
    pub(super) fn of(disc: Disc) -> Self {
        let mut group = Self::EMPTY;
        (group.x[0], group.y[0], group.swept_radius[0]) = (disc.at.x, disc.at.y, disc.swept_radius);
        group
    }

    /// The disc of a lane, of this particle.
    #[inline(always)]
    pub(super) fn disc(&self, lane: usize, index: u32) -> Disc {
        let lane = lane % WIDTH;
        Disc { at: Vec2::new(self.x[lane], self.y[lane]), swept_radius: self.swept_radius[lane], index }
    }

    /// Which discs have boxes that overlap a box, one bit each: as those of [`Disc::aabb`] do, to the bit.
    #[inline(always)]
    pub(super) fn in_box(&self, aabb: Aabb) -> u32 {
        let [x, y, radius] = self.vectors();
        let (low, high) = (aabb.low(), aabb.high());
        let along_x = (radius - x).cmpge(Vec4::splat(-high.x)) & (radius + x).cmpge(Vec4::splat(low.x));
        let along_y = (radius - y).cmpge(Vec4::splat(-high.y)) & (radius + y).cmpge(Vec4::splat(low.y));
        (along_x & along_y).bitmask()
    }

    /// Which discs may touch another one if both together move by `slack` less than the largest displacements, one bit each: as
    /// [`Disc::is_within`] says, to the bit.
    #[inline(always)]
    pub(super) fn within(&self, disc: &Disc, slack: f32) -> u32 {
        let [x, y, radius] = self.vectors();
        let (x, y, distance) = (x - disc.at.x, y - disc.at.y, (radius + disc.swept_radius) - slack);
        (x * x + y * y).cmplt(distance * distance).bitmask()
    }

    #[inline(always)]
    fn vectors(&self) -> [Vec4; 3] {
        [self.x, self.y, self.swept_radius].map(Vec4::from_array)
    }
}

impl Disc {
    /// The box around all places that it can get to in the step.
    #[inline(always)]
    pub(super) fn aabb(&self) -> Aabb {
        Aabb::around(self.at, self.swept_radius)
    }

    /// An image of it.
    pub(super) fn moved(self, by: Vec2) -> Self {
        Self { at: self.at + by, ..self }
    }

    /// Whether the two may touch during the step.
    #[inline(always)]
    pub(super) fn is_near(&self, other: &Self) -> bool {
        self.is_within(other, 0.0)
    }

    /// The same if both together move by `slack` less than the largest displacements.
    #[inline(always)]
    pub(super) fn is_within(&self, other: &Self, slack: f32) -> bool {
        let distance = self.swept_radius + other.swept_radius - slack;
        (other.at - self.at).length_squared() < distance * distance
    }
}

/// The places of the bits that are set.
#[inline(always)]
pub(super) fn lanes(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        lane
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    #[test]
    fn four_at_a_time_are_those_of_one_at_a_time() {
        let (mut rng, mut near, mut inside) = (Rng::new(5, 5), 0, 0);
        for count in 0..2000 {
            let mut disc = |index| {
                let at = Vec2::new(rng.range(900.0, 904.0), rng.range(20.0, 24.0));
                Disc { at, swept_radius: rng.range(0.3, 1.5), index }
            };
            let (mut group, others) = (DiscGroup::EMPTY, (0..count % 5).map(&mut disc).collect::<Vec<_>>());
            for (other, l) in others.iter().zip(0..) {
                (group.x[l], group.y[l], group.swept_radius[l]) = (other.at.x, other.at.y, other.swept_radius);
            }
            let (one, slack) = (disc(99), 0.1);
            let of = |bits| lanes(bits).map(|l| group.disc(l, l as u32)).collect::<Vec<_>>();
            let expected = |is: &dyn Fn(&Disc) -> bool| others.iter().copied().filter(is).collect::<Vec<_>>();
            let within = of(group.within(&one, slack));
            assert_eq!(format!("{within:?}"), format!("{:?}", expected(&|other| one.is_within(other, slack))));
            let in_box = of(group.in_box(one.aabb()));
            assert_eq!(format!("{in_box:?}"), format!("{:?}", expected(&|other| other.aabb().overlaps(one.aabb()))));
            (near, inside) = (near + within.len(), inside + in_box.len());
        }
        assert!(near > 1000 && inside > near, "{near} {inside}");
    }
}
