//! Discs of a body that are near another body, compared with one of its discs four at a time.

use crate::collision::disc_grid::Disc;
use glam::{Vec2, Vec4};

/// Number of lanes of a group.
const WIDTH: usize = 4;

/// Four discs side by side; unused lanes are near nothing.
#[derive(Clone, Copy, Debug)]
struct Group {
    x: Vec4,
    y: Vec4,
    swept_radius: Vec4,
}

impl Group {
    const EMPTY: Self = Self { x: Vec4::INFINITY, y: Vec4::INFINITY, swept_radius: Vec4::ZERO };
}

/// A list of discs.
#[derive(Debug, Default)]
pub(super) struct DiscList {
    discs: Vec<Disc>,
    groups: Vec<Group>,
}

impl DiscList {
    pub(super) fn is_empty(&self) -> bool {
        self.discs.is_empty()
    }

    pub(super) fn clear(&mut self) {
        self.discs.clear();
        self.groups.clear();
    }

    #[inline(always)]
    pub(super) fn push(&mut self, disc: Disc) {
        let lane = self.discs.len() % WIDTH;
        if lane == 0 {
            self.groups.push(Group::EMPTY);
        }
        if let Some(group) = self.groups.last_mut() {
            (group.x[lane], group.y[lane], group.swept_radius[lane]) = (disc.at.x, disc.at.y, disc.swept_radius);
        }
        self.discs.push(disc);
    }

    /// Calls `visit` for each disc, in their order, that may touch another one if both together move by `slack` less than the
    /// largest displacements: as [`Disc::is_within`] says, to the bit.
    #[inline(always)]
    pub(super) fn for_each_within(&self, disc: &Disc, slack: f32, mut visit: impl FnMut(&Disc)) {
        let Vec2 { x, y } = disc.at;
        for (group, discs) in self.groups.iter().zip(self.discs.chunks(WIDTH)) {
            let (x, y) = (group.x - x, group.y - y);
            let distance = (group.swept_radius + disc.swept_radius) - slack;
            let near = (x * x + y * y).cmplt(distance * distance).bitmask();
            if near != 0 {
                discs.iter().enumerate().filter(|(lane, _)| near >> lane & 1 == 1).for_each(|(_, other)| visit(other));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    #[test]
    fn four_at_a_time_are_those_of_one_at_a_time() {
        let (mut rng, mut list, mut near) = (Rng::new(5, 5), DiscList::default(), 0);
        for count in 0..2000 {
            let mut disc = |index| {
                let at = Vec2::new(rng.range(900.0, 904.0), rng.range(20.0, 24.0));
                Disc { at, swept_radius: rng.range(0.3, 1.5), index }
            };
            list.clear();
            let others: Vec<Disc> = (0..count % 11).map(&mut disc).collect();
            others.iter().for_each(|other| list.push(*other));
            let (one, slack, mut found) = (disc(99), 0.1, Vec::new());
            list.for_each_within(&one, slack, |other| found.push(other.index));
            let expected: Vec<u32> = others.iter().filter(|o| one.is_within(o, slack)).map(|o| o.index).collect();
            assert_eq!((&found, list.is_empty()), (&expected, count % 11 == 0));
            near += found.len();
        }
        assert!(near > 1000, "{near}");
    }
}
