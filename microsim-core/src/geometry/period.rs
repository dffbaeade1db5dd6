//! Rooms that repeat along their axes, and the displacements of the images of something: copies of it, each a whole number of
//! periods away.

use glam::{IVec2, Vec2};

/// Most periods between something and an image of it.
const FARTHEST: f32 = 64.0;
/// Share of a period that rounding may take away.
const ROUNDING: f32 = 1e-5;

/// The lengths after which a room repeats, units; 0 along an axis on which it does not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Period(pub Vec2);

impl Period {
    /// Of a room that does not repeat.
    pub(crate) const NONE: Self = Self(Vec2::ZERO);

    pub(crate) fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// The shorter of its lengths; infinite without any.
    pub(crate) fn shortest(self) -> f32 {
        self.0
            .to_array()
            .into_iter()
            .filter(|&length| length > 0.0)
            .fold(f32::INFINITY, |a, b| if b < a { b } else { a })
    }

    /// The way to the nearest image of what is this way away.
    pub(crate) fn nearest(self, way: Vec2) -> Vec2 {
        way - self.whole(way)
    }

    /// The whole periods in a way: what it is longer than that to the nearest image.
    pub(crate) fn whole(self, way: Vec2) -> Vec2 {
        let along = |way: f32, length: f32| if length > 0.0 { (way / length).round() * length } else { 0.0 };
        Vec2::new(along(way.x, self.0.x), along(way.y, self.0.y))
    }

    /// The image of a point that is nearest to another one, or the point itself if it is outside of the room.
    pub(crate) fn nearest_image(self, of: Vec2, to: Vec2) -> Vec2 {
        let is_as_it_is = self.is_none() || self.into_room(of) != Vec2::ZERO;
        if is_as_it_is { of } else { to + self.nearest(of - to) }
    }

    /// The displacement to the image of a point that is in the room, whose lower left corner is the origin.
    pub(crate) fn into_room(self, at: Vec2) -> Vec2 {
        let along = |at: f32, length: f32| {
            let is_outside = length > 0.0 && (at < 0.0 || at > length);
            if is_outside { -(at / length).floor() * length } else { 0.0 }
        };
        Vec2::new(along(at.x, self.0.x), along(at.y, self.0.y))
    }

    /// The displacements by which the images of a box come to lie over another one, that of the box itself among them. Without a
    /// period there is only that, wherever the boxes are.
    pub(crate) fn shifts(self, [low, high]: [Vec2; 2], onto: [Vec2; 2]) -> Shifts {
        let along = |axis: usize| {
            let length = self.0[axis];
            let least = (onto[0][axis] - high[axis]) / length - ROUNDING;
            let most = (onto[1][axis] - low[axis]) / length + ROUNDING;
            let range = [least.ceil(), most.floor()].map(|k| k.clamp(-FARTHEST, FARTHEST) as i32);
            if length > 0.0 { range } else { [0, 0] }
        };
        let ([left, right], [bottom, top]) = (along(0), along(1));
        let least = IVec2::new(left, bottom);
        Shifts { period: self.0, least, most: IVec2::new(right, top), next: least }
    }

    /// The same without that of the box itself.
    pub(crate) fn image_shifts(self, of: [Vec2; 2], onto: [Vec2; 2]) -> impl Iterator<Item = Vec2> {
        self.shifts(of, onto).filter(|shift| *shift != Vec2::ZERO)
    }
}

/// Displacements by whole periods, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Shifts {
    period: Vec2,
    /// Periods along both axes.
    least: IVec2,
    most: IVec2,
    next: IVec2,
}

impl Iterator for Shifts {
    type Item = Vec2;

    fn next(&mut self) -> Option<Vec2> {
        if self.least.x > self.most.x || self.next.y > self.most.y {
            return None;
        }
        let shift = self.next.as_vec2() * self.period;
        self.next.x += 1;
        if self.next.x > self.most.x {
            self.next = IVec2::new(self.least.x, self.next.y + 1);
        }
        Some(shift)
    }
}

/// Whether a displacement leads right, or straight up: of two that are opposite to each other, one does.
pub(crate) fn leads_on(shift: Vec2) -> bool {
    shift.x > 0.0 || shift.x == 0.0 && shift.y > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: Period = Period(Vec2::new(10.0, 0.0));

    #[test]
    fn the_nearest_image_is_at_most_half_a_period_away() {
        for (way, nearest) in [(4.0, 4.0), (6.0, -4.0), (-7.0, 3.0), (25.0, -5.0), (10.0, 0.0)] {
            let found = PERIOD.nearest(Vec2::new(way, 99.0));
            assert!(
                (found.x - nearest).abs() < 1e-6 || (found.x + nearest).abs() < 1e-6 && nearest.abs() == 5.0,
                "{way}: {found}"
            );
            assert_eq!(found.y, 99.0);
        }
        assert_eq!(Period::NONE.nearest(Vec2::new(1e9, -3.0)), Vec2::new(1e9, -3.0));
    }

    #[test]
    fn a_point_comes_into_the_room_by_whole_periods() {
        for (at, shift) in [(-0.5, 10.0), (0.0, 0.0), (10.0, 0.0), (10.5, -10.0), (31.0, -30.0), (-11.0, 20.0)] {
            assert_eq!(PERIOD.into_room(Vec2::new(at, -4.0)), Vec2::new(shift, 0.0), "{at}");
        }
        assert_eq!(PERIOD.into_room(Vec2::NAN), Vec2::ZERO);
    }

    #[test]
    fn shifts_lead_to_all_images_over_a_box_and_to_no_others() {
        let found = |period: Period, low: f32, high: f32| {
            let of = [Vec2::new(low, 0.0), Vec2::new(high, 1.0)];
            period.shifts(of, [Vec2::ZERO, Vec2::new(10.0, 10.0)]).map(|shift| shift.to_array()).collect::<Vec<_>>()
        };
        assert_eq!(found(PERIOD, 3.0, 4.0), [[0.0, 0.0]]);
        assert_eq!(found(PERIOD, -1.0, 1.0), [[0.0, 0.0], [10.0, 0.0]]);
        assert_eq!(found(PERIOD, -12.0, -11.0), [[20.0, 0.0]]);
        assert_eq!(found(Period(Vec2::splat(10.0)), 9.5, 10.5).len(), 4, "its lower side is that of the room");
        assert_eq!(found(Period::NONE, 50.0, 60.0), [[0.0, 0.0]]);
        assert_eq!(found(PERIOD, f32::NAN, f32::NAN).len(), 1);
        let both: Vec<_> =
            PERIOD.image_shifts([Vec2::ZERO, Vec2::ONE], [Vec2::splat(-20.0), Vec2::splat(20.0)]).collect();
        assert_eq!(both.len(), 4);
        assert_eq!(both.iter().filter(|shift| leads_on(**shift)).count(), 2);
    }
}
