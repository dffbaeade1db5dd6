//! The brake: when the hand lets go, the cell is steered backwards until it stands, instead of gliding on for a second.

use microsim_core::glam::Vec2;
use microsim_core::{Intent, OrganismView};

/// Longest time for which it brakes, steps.
const LONGEST: u32 = 20;
/// Speed along its way below which a cell stands, units/s.
const STANDING: f32 = 1.0;
/// Distance of the goal behind it, units: speed does not depend on it.
const BEHIND: f32 = 20.0;

/// What the brake remembers of how a cell was steered last.
#[derive(Clone, Copy, Debug, Default)]
pub struct Brake {
    way: Vec2,
    steps: u32,
}

impl Brake {
    /// Where a cell was steered last: of length 1, or 0 before.
    pub fn heading(&self) -> Vec2 {
        self.way
    }

    /// Where a cell goes in the next step: where it is steered, or against its motion for a moment after that.
    pub fn intent(&mut self, cell: OrganismView<'_>, goal: Option<Vec2>) -> Intent {
        let at = cell.centroid();
        if let Some(goal) = goal {
            *self = Self { way: (goal - at).normalize_or_zero(), steps: LONGEST };
            return toward(goal);
        }
        if self.steps == 0 || mean_velocity(cell).dot(self.way) < STANDING {
            self.steps = 0;
            return Intent::REST;
        }
        self.steps -= 1;
        toward(at - BEHIND * self.way)
    }
}

fn toward(goal: Vec2) -> Intent {
    Intent::toward(goal).unwrap_or(Intent::REST)
}

fn mean_velocity(cell: OrganismView<'_>) -> Vec2 {
    let (sum, count) = cell.particles().fold((Vec2::ZERO, 0.0_f32), |(sum, count), p| (sum + p.velocity, count + 1.0));
    sum / count.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::scenario::Scenario;
    use microsim_core::{Inputs, OrganismId, World};

    const ROOM: &str = "schema = 1\n[world]\nsize = [200.0, 60.0]\ndamping = 1.5\nmax_speed = 24.0\n\
                        [amoeboid_cell.cell]\nradii = [7.0, 7.0]\nspeed = 13.0\n\
                        [[spawn]]\nof = \"cell\"\nplayer = true\nat = [40.0, 30.0]\n";

    fn step(world: &mut World, cell: OrganismId, intent: Intent) {
        let mut inputs = Inputs::new();
        inputs.set(cell, intent);
        world.step(&inputs);
    }

    /// How far a cell glides after it is let go at full speed, units, and how far back it goes then.
    fn glide(brakes: bool) -> (f32, f32) {
        let built = Scenario::parse(ROOM, &[]).unwrap().build().unwrap();
        let (mut world, cell) = (built.world, built.player.unwrap());
        let mut brake = Brake::default();
        let goal = Vec2::new(190.0, 30.0);
        for _ in 0..60 {
            let intent = brake.intent(world.view().organism(cell).unwrap(), Some(goal));
            step(&mut world, cell, intent);
        }
        let (start, mut farthest) = (world.centroid(cell).unwrap().x, f32::MIN);
        for _ in 0..90 {
            let intent = brake.intent(world.view().organism(cell).unwrap(), None);
            step(&mut world, cell, if brakes { intent } else { Intent::REST });
            farthest = farthest.max(world.centroid(cell).unwrap().x);
        }
        (farthest - start, farthest - world.centroid(cell).unwrap().x)
    }

    #[test]
    fn a_cell_that_is_let_go_stands_soon_and_does_not_turn_back() {
        let (free, _) = glide(false);
        let (braked, back) = glide(true);
        assert!(braked < 0.5 * free && back < 0.8, "glides {free} units, with the brake {braked}, and {back} back");
    }
}
