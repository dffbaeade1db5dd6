//! What the player is shown: which cells can be taken in, what is about to be, what waits to be digested.

use super::prey_class;
use microsim_core::glam::Vec2;
use microsim_core::{Event, MealPhase, OrganismId, OrganismView, View, World};

/// Whether a rigid cell can be taken in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Readiness {
    /// Now.
    Ready,
    /// When the player has grown: it has this share of the size that is needed, below 1.
    TooLarge(f32),
    /// When the one place for such cells is free again.
    NoRoom,
}

/// A rigid cell and whether it can be taken in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreyTarget {
    /// The cell.
    pub prey: OrganismId,
    /// Its centre.
    pub at: Vec2,
    /// Half its length, units.
    pub half_extent: f32,
    /// Whether it can be taken in.
    pub readiness: Readiness,
}

/// Something that the player touches or holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldPrey {
    /// What it is.
    pub prey: OrganismId,
    /// Its centre.
    pub at: Vec2,
    /// Half its length, units.
    pub half_extent: f32,
    /// Where it stands.
    pub state: MealState,
}

/// Where something stands on its way into the player, and out of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MealState {
    /// Touched: share of the time that the touch has to last, 0 to 1.
    Touching(f32),
    /// Going in.
    Entering,
    /// Inside: share of it that is digested, 0 to 1.
    Inside(f32),
}

/// All hints of one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hints {
    /// Rigid cells that are free.
    pub targets: Vec<PreyTarget>,
    /// What the player touches or holds.
    pub held: Vec<HeldPrey>,
}

impl Hints {
    /// The hints for a player.
    #[must_use]
    pub fn of(view: View<'_>, player: OrganismId) -> Self {
        let Some(engulfer) = view.organism(player) else { return Self::default() };
        let free = |organism: &OrganismView<'_>| prey_class::is_soft(*organism) && organism.held_by().is_none();
        let targets = view.organisms().filter(free).filter_map(|prey| {
            let readiness = readiness(engulfer, prey)?;
            Some(PreyTarget { prey: prey.id(), at: prey.centroid(), half_extent: half_extent(prey), readiness })
        });
        let held = engulfer.meals().filter_map(|(prey, phase)| {
            let organism = view.organism(prey)?;
            let (at, half_extent) = (organism.centroid(), half_extent(organism));
            Some(HeldPrey { prey, at, half_extent, state: state(engulfer, phase) })
        });
        Self { targets: targets.collect(), held: held.collect() }
    }

    /// Whether holding the key would digest something.
    #[must_use]
    pub fn can_digest(&self) -> bool {
        self.held.iter().any(|held| matches!(held.state, MealState::Inside(_)))
    }
}

/// Where the last step brought what some cells took in, and half its length, units.
pub fn taken_in<'a>(world: &'a World, cells: &'a [OrganismId]) -> impl Iterator<Item = (Vec2, f32)> + 'a {
    let prey = world.events().iter().filter_map(|event| match event {
        Event::Ingested { engulfer, prey, .. } if cells.contains(engulfer) => world.view().organism(*prey),
        _ => None,
    });
    prey.map(|prey| (prey.centroid(), half_extent(prey)))
}

/// Whether the player can take a soft cell in; `None` if it takes in nothing at all.
#[must_use]
pub fn readiness(player: OrganismView<'_>, prey: OrganismView<'_>) -> Option<Readiness> {
    let needed = prey.spawn_area() * player.phagocytosis()?.size_ratio;
    let share = player.cytoplasm_area() / needed;
    Some(match share {
        _ if share < 1.0 => Readiness::TooLarge(share),
        _ if player.is_full() => Readiness::NoRoom,
        _ => Readiness::Ready,
    })
}

fn state(engulfer: OrganismView<'_>, phase: MealPhase) -> MealState {
    match phase {
        MealPhase::Touching(time) => {
            let needed = engulfer.phagocytosis().map_or(1.0, |params| params.hold_time.max(1e-3));
            MealState::Touching((time / needed).min(1.0))
        }
        MealPhase::Ingesting(_) => MealState::Entering,
        MealPhase::Ingested => MealState::Inside(0.0),
        MealPhase::Digesting(share) => MealState::Inside(share.min(1.0)),
    }
}

fn half_extent(organism: OrganismView<'_>) -> f32 {
    let (low, high) = organism.bounds();
    0.5 * (high - low).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::Stage;

    #[test]
    fn what_is_taken_in_is_seen_once_inside_the_cell_that_took_it_in() {
        let mut stage = Stage::builtin("absorb-agar").unwrap();
        let (eater, mut taken) = (stage.player().unwrap(), Vec::new());
        while stage.world().time() < 15.0 {
            stage.step();
            let (low, high) = stage.world().view().organism(eater).unwrap().bounds();
            taken.extend(taken_in(stage.world(), &[eater]).map(|(at, half)| {
                let is_inside = at.cmpgt(low).all() && at.cmplt(high).all();
                is_inside && half > 0.5 && half < 2.0
            }));
            assert_eq!(taken_in(stage.world(), &[]).count(), 0);
        }
        assert_eq!(taken, [true]);
    }
}
