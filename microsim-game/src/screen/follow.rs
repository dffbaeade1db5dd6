//! The camera follows a cell, and steps back as it grows.

use super::context::AppContext;
use crate::camera::Camera;
use crate::input::Input;
use crate::rules::round::Round;
use crate::viewer::{Viewer, first_view};
use microsim_core::OrganismId;
use microsim_core::glam::Vec2;

/// Units that are seen from bottom to top at first.
const VIEW: f32 = 62.0;
/// The picture grows with this power of the cell's area, at this rate, 1/s.
const POWER: f32 = 0.3;
const RATE: f32 = 1.5;
/// What is left of the picture's height when it is brought closer.
const NUDGE: f32 = 0.95;

#[derive(Debug)]
pub(super) struct Follow {
    /// Area of the cell at the beginning, and what the camera has made of its growth.
    first_area: f32,
    grown: f32,
}

impl Follow {
    /// Follows a cell as it is now; and the camera for that.
    pub(super) fn new(round: &Round, cell: OrganismId, screen: Vec2) -> (Self, Camera) {
        let world = round.world();
        let first_area = world.view().organism(cell).map_or(1.0, |cell| cell.cytoplasm_area());
        (Self { first_area, grown: 1.0 }, first_view(world, Some(cell), VIEW, screen))
    }

    /// Brings the camera closer at once, as at a large meal; it goes back by itself.
    pub(super) fn nudge(&mut self, viewer: &mut Viewer, screen: Vec2) {
        viewer.camera.zoom(1.0 / NUDGE, 0.5 * screen);
        self.grown *= NUDGE;
    }

    /// Moves the camera in a frame; it looks ahead to the cursor if the mouse steers.
    pub(super) fn look(
        &mut self,
        viewer: &mut Viewer,
        (round, cell): (&Round, OrganismId),
        (input, is_steering): (&Input, bool),
        context: &AppContext,
    ) {
        let area = round.world().view().organism(cell).map(|cell| cell.cytoplasm_area());
        let wanted = area.map_or(1.0, |area| (area / self.first_area).max(0.1).powf(POWER));
        let step = self.grown + (wanted - self.grown) * (1.0 - (-RATE * context.pace.elapsed).exp());
        viewer.camera.zoom(self.grown / step, 0.5 * context.pen.screen());
        self.grown = step;
        let at = viewer.place_of(round.world(), Some(cell));
        let looks_ahead = is_steering && !round.is_replay() && context.motion().is_some();
        viewer.look(input.zoom(), input.wheel, at, looks_ahead.then_some(input.cursor), context.pace.elapsed);
    }
}
