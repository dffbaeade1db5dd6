//! What a player tells a cell in a frame, in five bytes.

use crate::rules::food_chain::Deed;
use microsim_core::Intent;
use microsim_core::glam::Vec2;
use serde::{Deserialize, Serialize};

/// Goals may lie so far outside the slide, in sizes of it: what steers by direction does not bend at the edge.
const MARGIN: f32 = 1.0;
/// Steps of a goal along each side of that.
const STEPS: f32 = 65535.0;
/// Bits of the last byte.
const GOES: u8 = 1;
const DIGESTS: u8 = 2;
const BOT: u8 = 4;
/// From this bit on, what it does in a food chain: takes the first, second or third change, divides or lunges.
const DEED: u32 = 3;
const CHANGES: u8 = 3;
const DIVIDE: u8 = 4;
const LUNGE: u8 = 5;

/// An intent as it is sent: all players act on these bytes, and so on the same numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Told([u8; 5]);

impl Told {
    /// In this frame a bot steers.
    pub const BOT: Self = Self([0, 0, 0, 0, BOT]);

    /// An intent on a slide of this size. A goal outside of what can be said is moved to its edge.
    #[must_use]
    pub fn new(intent: Intent, size: Vec2) -> Self {
        let digests = if intent.digests() { DIGESTS } else { 0 };
        let Some(goal) = intent.goal() else { return Self([0, 0, 0, 0, digests]) };
        let share = (goal / size + MARGIN) / (1.0 + 2.0 * MARGIN);
        let [x, y] = (share * STEPS + 0.5).to_array().map(|steps| (steps as u16).to_le_bytes());
        Self([x[0], x[1], y[0], y[1], digests | GOES])
    }

    /// The same with what is done once, in this frame.
    #[must_use]
    pub fn doing(mut self, deed: Option<Deed>) -> Self {
        let code = match deed {
            None => 0,
            Some(Deed::Choose(place)) => 1 + (place as u8).min(CHANGES - 1),
            Some(Deed::Divide) => DIVIDE,
            Some(Deed::Lunge) => LUNGE,
        };
        self.0[4] = self.0[4] & ((1 << DEED) - 1) | code << DEED;
        self
    }

    /// What is done in this frame.
    #[must_use]
    pub fn deed(self) -> Option<Deed> {
        match self.0[4] >> DEED {
            0 => None,
            code @ 1..=CHANGES => Some(Deed::Choose(usize::from(code) - 1)),
            DIVIDE => Some(Deed::Divide),
            _ => Some(Deed::Lunge),
        }
    }

    /// The intent, on a slide of this size.
    #[must_use]
    pub fn intent(self, size: Vec2) -> Intent {
        let Self([a, b, c, d, flags]) = self;
        let steps = Vec2::new(f32::from(u16::from_le_bytes([a, b])), f32::from(u16::from_le_bytes([c, d])));
        let goal = (steps / STEPS * (1.0 + 2.0 * MARGIN) - MARGIN) * size;
        let way = if flags & GOES == 0 { Ok(Intent::REST) } else { Intent::toward(goal) };
        way.unwrap_or(Intent::REST).digesting(flags & DIGESTS != 0)
    }

    /// Whether [`Told::new`] makes such bytes.
    pub(super) fn is_sound(self) -> bool {
        let Self([a, b, c, d, flags]) = self;
        let is_known = flags & BOT == 0 && flags >> DEED <= LUNGE;
        self == Self::BOT || is_known && (flags & GOES != 0 || [a, b, c, d] == [0; 4])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_intent_comes_back_within_a_hundredth_of_a_unit() {
        let size = Vec2::new(144.0, 81.0);
        for goal in [Vec2::ZERO, Vec2::new(144.0, 81.0), Vec2::new(31.7, 5.2), Vec2::new(-20.0, 100.0)] {
            let intent = Intent::toward(goal).unwrap().digesting(true);
            let told = Told::new(intent, size);
            let back = told.intent(size);
            assert!(told.is_sound() && back.digests() && (back.goal().unwrap() - goal).length() < 0.01);
            assert_eq!(Told::new(back, size).intent(size), back, "what was sent once does not drift");
        }
        let rest = Told::new(Intent::REST, size);
        assert!(rest.is_sound() && rest.intent(size) == Intent::REST.digesting(false));
    }

    #[test]
    fn a_deed_comes_back_beside_the_intent() {
        let size = Vec2::new(144.0, 81.0);
        let told = Told::new(Intent::toward(Vec2::ONE).unwrap().digesting(true), size);
        for deed in [None, Some(Deed::Divide), Some(Deed::Lunge)]
            .into_iter()
            .chain((0..3).map(|place| Some(Deed::Choose(place))))
        {
            let doing = told.doing(deed);
            assert!(doing.is_sound() && doing.deed() == deed && doing.intent(size) == told.intent(size));
            assert_eq!(doing.doing(None), told);
        }
        assert!(Told([0, 0, 0, 0, LUNGE << DEED]).is_sound());
        for flags in [(LUNGE + 1) << DEED, 31 << DEED, BOT | DIVIDE << DEED, BOT | 1 << DEED] {
            assert!(!Told([0, 0, 0, 0, flags]).is_sound(), "{flags}");
        }
    }

    #[test]
    fn bytes_that_say_nothing_are_known() {
        assert!(Told::BOT.is_sound() && !Told([0, 0, 0, 0, 5]).is_sound() && !Told([1, 0, 0, 0, DIGESTS]).is_sound());
        let far = Told::new(Intent::toward(Vec2::splat(1e5)).unwrap(), Vec2::ONE);
        assert_eq!(far.intent(Vec2::ONE).goal(), Some(Vec2::splat(2.0)));
    }
}
