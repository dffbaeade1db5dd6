//! Pictures of evenly spaced moments of a run, on one sheet.

use crate::draw;
use crate::draw::png::Picture;
use microsim_core::World;

/// Pictures on the sheet, start and end included.
const MOMENTS: u64 = 6;
/// Longer side of each, pixels.
const TILE: u32 = 400;

/// Small pictures of evenly spaced moments.
#[derive(Debug)]
pub(crate) struct Moments {
    steps: Vec<u64>,
    pictures: Vec<Picture>,
}

impl Moments {
    /// The moments of a run of `steps` steps.
    pub(crate) fn new(steps: u64) -> Self {
        let last = MOMENTS - 1;
        let at = |k: u64| (u128::from(k) * u128::from(steps) / u128::from(last)) as u64;
        let mut chosen: Vec<u64> = (0..=last).map(at).collect();
        chosen.dedup();
        Self { steps: chosen, pictures: Vec::new() }
    }

    /// Takes the picture, if this is a moment for it, and returns it.
    pub(crate) fn look_at(&mut self, world: &World) -> Option<&Picture> {
        if !self.steps.contains(&world.step_index()) {
            return None;
        }
        self.pictures.push(Picture::of(&draw::draw(world), TILE));
        self.pictures.last()
    }

    /// The moments up to a step.
    pub(crate) fn until(&self, step: u64) -> impl Iterator<Item = u64> {
        self.steps.clone().into_iter().filter(move |moment| *moment <= step)
    }

    /// A picture that was taken before.
    pub(crate) fn add(&mut self, picture: Picture) {
        self.pictures.push(picture);
    }

    /// All of them, row by row.
    pub(crate) fn sheet(&self) -> Picture {
        Picture::sheet(&self.pictures)
    }
}

#[cfg(test)]
mod tests {
    use super::Moments;

    #[test]
    fn moments_are_evenly_spaced_and_distinct() {
        assert_eq!(Moments::new(100).steps, [0, 20, 40, 60, 80, 100]);
        assert_eq!(Moments::new(2).steps, [0, 1, 2]);
        assert_eq!(Moments::new(0).steps, [0]);
        assert_eq!(Moments::new(u64::MAX).steps.last(), Some(&u64::MAX));
    }
}
