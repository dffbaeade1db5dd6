//! Pictures of evenly spaced moments of a run, on one sheet.

use crate::draw;
use crate::draw::png::Picture;
use crate::failure::Failure;
use crate::read;
use microsim_core::World;
use std::path::Path;

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

    /// The pictures of a stopped run, up to the step of its world.
    pub(crate) fn take_up(&mut self, folder: &Path, world: &World) -> Result<(), Failure> {
        let size = draw::draw(world).pixels(TILE);
        for moment in self.until(world.step_index()).collect::<Vec<_>>() {
            let path = folder.join(moment_name(moment));
            let raw = read::whole(&path).map_err(|error| Failure::file("read", &path, &error))?;
            let broken = || Failure::Message(format!("{}: no picture; run the scenario again", path.display()));
            self.pictures.push(Picture::from_raw(&raw).filter(|picture| picture.size() == size).ok_or_else(broken)?);
        }
        Ok(())
    }

    /// All of them, row by row.
    pub(crate) fn sheet(&self) -> Picture {
        Picture::sheet(&self.pictures)
    }
}

/// Where the picture of a moment waits for the sheet.
pub(super) fn moment_name(step: u64) -> String {
    format!(".moment-{step:08}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepared::apart;

    #[test]
    fn pictures_of_a_stopped_run_are_those_of_its_world() {
        let world = apart("").built.world;
        let folder = std::env::temp_dir().join(format!("microsim-moments-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let right = Picture::of(&draw::draw(&world), TILE).to_raw();
        let other = Picture::new(1, 1, vec![7; 3]).to_raw();
        for (raw, is_taken) in [(&right[..], true), (&other, false), (&[0; 8], false)] {
            std::fs::write(folder.join(moment_name(0)), raw).unwrap();
            assert_eq!(Moments::new(100).take_up(&folder, &world).is_ok(), is_taken, "{} bytes", raw.len());
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn moments_are_evenly_spaced_and_distinct() {
        assert_eq!(Moments::new(100).steps, [0, 20, 40, 60, 80, 100]);
        assert_eq!(Moments::new(2).steps, [0, 1, 2]);
        assert_eq!(Moments::new(0).steps, [0]);
        assert_eq!(Moments::new(u64::MAX).steps.last(), Some(&u64::MAX));
    }
}
