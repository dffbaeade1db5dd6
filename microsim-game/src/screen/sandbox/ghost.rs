//! The ghost of what would be put in: its shape at the cursor, crossed out where it cannot be.

use crate::camera::Camera;
use crate::draw::canvas::Canvas;
use crate::draw::palette::{ALERT, HALO, INK, fade};
use microsim_core::glam::Vec2;
use microsim_core::{OrganismSpec, Placement, World, WorldConfig};

/// Half the width of a cross, pixels.
const CROSS: f32 = 9.0;

/// How it would lie, and whether it may.
#[derive(Debug, Default)]
pub(super) struct Ghost {
    /// A copy of the world, to try in.
    trial: Option<World>,
    /// Its discs, from where it is put in, and for which choice they are.
    shape: Vec<(Vec2, f32)>,
    choice: Option<usize>,
    seen: Option<(Vec2, bool)>,
}

impl Ghost {
    /// Tries to put something in at a point.
    pub(super) fn update(&mut self, world: &World, choice: usize, spec: &OrganismSpec, at: Vec2) {
        if self.choice.replace(choice) != Some(choice) {
            self.shape = shape(spec);
        }
        let trial = self.trial.get_or_insert_with(|| world.clone());
        trial.clone_from(world);
        self.seen = Some((at, trial.spawn(spec, Placement::at(at.x, at.y)).is_ok()));
    }

    /// Nothing is about to be put in.
    pub(super) fn hide(&mut self) {
        (self.trial, self.seen) = (None, None);
    }

    pub(super) fn draw(&self, canvas: &mut Canvas, camera: &Camera) {
        let Some((at, fits)) = self.seen else { return };
        let bright = if fits { HALO } else { ALERT };
        // A bright line on a dark one is seen on any ground.
        for (width, colour) in [(2.6, fade(INK, 0.7)), (1.0, fade(bright, 0.9))] {
            for (from, radius) in &self.shape {
                canvas.circle(camera.to_screen(at + *from), (radius * camera.scale()).max(2.0), width, colour);
            }
        }
        if !fits {
            let middle = camera.to_screen(at);
            for way in [Vec2::ONE, Vec2::new(1.0, -1.0)] {
                canvas.segment(middle - CROSS * way, middle + CROSS * way, 6.0, INK);
                canvas.segment(middle - CROSS * way, middle + CROSS * way, 3.0, ALERT);
            }
        }
    }
}

/// The discs of something in a room of its own, from where it was put in.
fn shape(spec: &OrganismSpec) -> Vec<(Vec2, f32)> {
    let config = WorldConfig::default();
    let middle = 0.5 * config.size;
    let Ok(mut room) = World::new(config) else { return Vec::new() };
    let id = room.spawn(spec, Placement::at(middle.x, middle.y)).ok();
    let organism = id.and_then(|id| room.view().organism(id));
    let discs = organism.into_iter().flat_map(|organism| organism.particles());
    discs.map(|disc| (disc.position - middle, disc.radius)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::AmoeboidCellSpec;

    #[test]
    fn it_is_crossed_out_where_there_is_no_room_and_changes_nothing() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let spec: OrganismSpec = AmoeboidCellSpec::default().into();
        world.spawn(&spec, Placement::at(60.0, 45.0)).unwrap();
        let (digest, mut ghost) = (world.digest(), Ghost::default());
        let camera = Camera::whole(world.config().size, Vec2::new(640.0, 360.0));
        let mut drawn = |at: Vec2| {
            ghost.update(&world, 4, &spec, at);
            let mut canvas = Canvas::bare();
            ghost.draw(&mut canvas, &camera);
            (canvas.corners().count(), canvas.count(ALERT), canvas.count(fade(HALO, 0.9)))
        };
        let (all, crossed, free) = drawn(Vec2::new(100.0, 45.0));
        assert!(all > 100 && crossed == 0 && free > 0, "{all} {crossed} {free}");
        for at in [Vec2::new(60.0, 45.0), Vec2::new(-5.0, 45.0)] {
            let (_, crossed, free) = drawn(at);
            assert!(crossed == 8 && free == 0, "{at}");
        }
        assert_eq!(world.digest(), digest);
        ghost.hide();
        let mut canvas = Canvas::bare();
        ghost.draw(&mut canvas, &camera);
        assert_eq!(canvas.corners().count(), 0);
    }
}
