//! The table of obstacles: handles, and the state of each that is not in its shape.

use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_record::{ObstacleRecord, PoseRecord, Surface, pose_of, record};
use crate::id::ObstacleId;
use crate::world::state::digest::Digest;
use glam::Vec2;
use parry2d::math::Pose;
use serde::{Deserialize, Serialize};

/// Places of the obstacles that were added, in the order of their indices. Those that were removed are reused.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct ObstacleTable {
    slots: Vec<Slot>,
    /// Empty slots, the last emptied last.
    free: Vec<u32>,
}

/// Place of an obstacle.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Slot {
    generation: u32,
    /// `None` after removal. In a box: a file cannot ask for much memory with many empty slots.
    state: Option<Box<State>>,
}

/// State of an obstacle.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct State {
    /// Of its shape, see [`digest`].
    shape: u64,
    pose: PoseRecord,
    surface: Surface,
    /// Where it is going.
    target: Option<PoseRecord>,
}

impl State {
    fn of(obstacle: &Obstacle) -> Box<Self> {
        let (pose, surface) = (record(&obstacle.pose), Surface::of(obstacle));
        Box::new(Self { shape: digest(obstacle), pose, surface, target: None })
    }
}

impl ObstacleTable {
    /// Number of places, empty ones included.
    #[cfg(feature = "snapshot")]
    pub(crate) fn len(&self) -> usize {
        self.slots.len()
    }

    /// Index of the place that the next obstacle gets.
    pub(super) fn next_index(&self) -> usize {
        self.free.last().map_or(self.slots.len(), |&index| index as usize)
    }

    /// Notes an obstacle that was added, at [`ObstacleTable::next_index`].
    pub(super) fn insert(&mut self, obstacle: &Obstacle) -> ObstacleId {
        let state = Some(State::of(obstacle));
        let index = self.free.pop().unwrap_or_else(|| {
            self.slots.push(Slot { generation: 0, state: None });
            self.slots.len() as u32 - 1
        });
        let slot = &mut self.slots[index as usize];
        slot.state = state;
        ObstacleId { index, generation: slot.generation }
    }

    /// Empties a place; the handle is stale from now on.
    pub(super) fn remove(&mut self, id: ObstacleId) {
        let slot = &mut self.slots[id.index as usize];
        slot.state = None;
        slot.generation = slot.generation.saturating_add(1);
        // A place whose generations are used up stays empty.
        if slot.generation < u32::MAX {
            self.free.push(id.index);
        }
    }

    /// Whether a handle names an obstacle.
    pub(super) fn contains(&self, id: ObstacleId) -> bool {
        let slot = self.slots.get(id.index as usize);
        slot.is_some_and(|slot| slot.generation == id.generation && slot.state.is_some())
    }

    /// Handle of the obstacle with this index.
    pub(crate) fn id_at(&self, index: u32) -> Option<ObstacleId> {
        let slot = self.slots.get(index as usize).filter(|slot| slot.state.is_some())?;
        Some(ObstacleId { index, generation: slot.generation })
    }

    /// Handles of all obstacles.
    pub(super) fn ids(&self) -> impl Iterator<Item = ObstacleId> + '_ {
        (0..self.slots.len() as u32).filter_map(|index| self.id_at(index))
    }

    /// Notes what an obstacle has become; it has no target any more.
    pub(super) fn replace(&mut self, id: ObstacleId, obstacle: &Obstacle) {
        self.slots[id.index as usize].state = Some(State::of(obstacle));
    }

    /// Notes where an obstacle is.
    pub(super) fn set_pose(&mut self, index: u32, pose: &Pose) {
        if let Some(state) = &mut self.slots[index as usize].state {
            state.pose = record(pose);
        }
    }

    /// Sets where an obstacle is going.
    pub(super) fn set_target(&mut self, index: u32, target: Option<&Pose>) {
        if let Some(state) = &mut self.slots[index as usize].state {
            state.target = target.map(record);
        }
    }

    /// Where an obstacle is going, if anywhere.
    pub(super) fn target(&self, index: u32) -> Option<Pose> {
        pose_of(self.slots[index as usize].state.as_ref()?.target?)
    }

    /// Indices of the obstacles that are going somewhere.
    pub(super) fn moving(&self) -> impl Iterator<Item = u32> + '_ {
        let is_moving = |slot: &Slot| slot.state.as_ref().is_some_and(|state| state.target.is_some());
        self.slots.iter().zip(0..).filter(move |(slot, _)| is_moving(slot)).map(|(_, index)| index)
    }

    /// Checks that empty places are listed once.
    ///
    /// # Errors
    /// Says what is wrong.
    pub(super) fn check_free(&self) -> Result<(), String> {
        let mut free = self.free.clone();
        free.sort_unstable();
        let is_empty = |slot: &Slot| slot.state.is_none() && slot.generation < u32::MAX;
        let empty = self.slots.iter().zip(0..).filter(|(slot, _)| is_empty(slot)).map(|(_, index)| index);
        if !empty.eq(free) {
            return Err("the free places of obstacles are not the empty ones".to_owned());
        }
        Ok(())
    }

    /// Checks that empty places are listed once, that targets are poses, and that these are the obstacles.
    ///
    /// # Errors
    /// Says what is wrong.
    pub(crate) fn check(&self, obstacles: &[Obstacle]) -> Result<(), String> {
        let (count, slots) = (obstacles.len(), self.slots.len());
        if count != slots {
            return Err(format!("{slots} places for {count} obstacles"));
        }
        self.check_free()?;
        for (k, (slot, obstacle)) in self.slots.iter().zip(obstacles).enumerate() {
            let Some(state) = &slot.state else { continue };
            let is_target =
                |target: PoseRecord| pose_of(target).is_some_and(|pose| super::check_pose("", &pose).is_ok());
            if !state.target.is_none_or(is_target) {
                return Err(format!("obstacle {k} has no place as its target"));
            }
            if Digest::of(state) != Digest::of(&State { target: state.target, ..*State::of(obstacle) }) {
                return Err(format!("obstacle {k} differs from its record"));
            }
        }
        Ok(())
    }
}

/// Digest of a shape: the numbers that it is made from, or for shapes without such a record what the step sees of it, its
/// surface from a grid of points around it.
fn digest(obstacle: &Obstacle) -> u64 {
    const POINTS: u8 = 8;
    let still = Obstacle::new(obstacle.shape.clone(), Pose::IDENTITY);
    if let Some(record) = ObstacleRecord::of(&still) {
        return Digest::of(&record);
    }
    let bounds = still.aabb();
    let extent = bounds.maxs - bounds.mins;
    let nearest = |k: u8| {
        let share = Vec2::new(f32::from(k % POINTS), f32::from(k / POINTS)) / f32::from(POINTS - 1);
        still.nearest(bounds.mins + extent * share)
    };
    let surface: Vec<(Vec2, bool)> = (0..POINTS * POINTS).map(nearest).collect();
    Digest::of(&surface)
}

#[cfg(test)]
mod tests {
    use super::*;
    use parry2d::shape::SharedShape;

    fn ball() -> Obstacle {
        Obstacle::new(SharedShape::ball(1.0), Pose::IDENTITY)
    }

    #[test]
    fn a_stale_handle_names_nothing_for_ever() {
        let mut table = ObstacleTable::default();
        let [a, b] = [table.insert(&ball()), table.insert(&ball())];
        table.remove(a);
        assert!(!table.contains(a) && table.contains(b) && table.id_at(0).is_none());
        let again = table.insert(&ball());
        assert_eq!((again.index, again.generation), (0, 1));
        assert!(!table.contains(a) && table.ids().eq([again, b]));
    }

    #[test]
    fn a_place_whose_generations_are_used_up_stays_empty() {
        let mut table = ObstacleTable::default();
        let id = table.insert(&ball());
        table.slots[0].generation = u32::MAX - 1;
        table.remove(ObstacleId { generation: u32::MAX - 1, ..id });
        assert_eq!(table.next_index(), 1);
        assert!(table.check(&[ball()]).is_ok());
    }
}
