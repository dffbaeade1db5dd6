//! The table of obstacles: handles, and the state of each that is not in its shape.

use crate::arena::Arena;
use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_record::{ObstacleRecord, PoseRecord, Surface, pose_of, record};
use crate::id::ObstacleId;
use crate::world::state::digest::Digest;
use glam::Vec2;
use parry2d::math::Pose;
use serde::{Deserialize, Serialize};

/// What is known of the obstacles that were added, in the order of their indices.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct ObstacleTable {
    arena: Arena<Box<State>>,
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
        self.arena.slot_count()
    }

    /// Index of the place that the next obstacle gets.
    pub(super) fn next_index(&self) -> usize {
        self.arena.next_handle().0 as usize
    }

    /// Notes an obstacle that was added, at [`ObstacleTable::next_index`].
    pub(super) fn insert(&mut self, obstacle: &Obstacle) -> ObstacleId {
        ObstacleId::of(self.arena.insert(State::of(obstacle)))
    }

    /// Empties a place; the handle is stale from now on.
    pub(super) fn remove(&mut self, id: ObstacleId) {
        self.arena.remove(id.handle());
    }

    /// Whether a handle names an obstacle.
    pub(super) fn contains(&self, id: ObstacleId) -> bool {
        self.arena.get(id.handle()).is_some()
    }

    /// Handle of the obstacle with this index.
    pub(crate) fn id_at(&self, index: u32) -> Option<ObstacleId> {
        self.arena.handle_at(index).map(ObstacleId::of)
    }

    /// Handles of all obstacles.
    pub(super) fn ids(&self) -> impl Iterator<Item = ObstacleId> + '_ {
        self.arena.iter().map(|(handle, _)| ObstacleId::of(handle))
    }

    /// Notes what an obstacle has become; it has no target any more.
    pub(super) fn replace(&mut self, id: ObstacleId, obstacle: &Obstacle) {
        if let Some(state) = self.arena.get_mut(id.handle()) {
            *state = State::of(obstacle);
        }
    }

    /// Notes where an obstacle is.
    pub(super) fn set_pose(&mut self, index: u32, pose: &Pose) {
        if let Some(state) = self.arena.at_mut(index) {
            state.pose = record(pose);
        }
    }

    /// Sets where an obstacle is going.
    pub(super) fn set_target(&mut self, index: u32, target: Option<&Pose>) {
        if let Some(state) = self.arena.at_mut(index) {
            state.target = target.map(record);
        }
    }

    /// Where an obstacle is going, if anywhere.
    pub(super) fn target(&self, index: u32) -> Option<Pose> {
        pose_of(self.arena.at(index)?.target?)
    }

    /// Indices of the obstacles that are going somewhere.
    pub(super) fn moving(&self) -> impl Iterator<Item = u32> + '_ {
        self.arena.iter().filter(|(_, state)| state.target.is_some()).map(|((index, _), _)| index)
    }

    /// Checks that empty places are listed once.
    ///
    /// # Errors
    /// Says what is wrong.
    pub(super) fn check_free(&self) -> Result<(), String> {
        let error = || "the free places of obstacles are not the empty ones".to_owned();
        self.arena.is_sound().then_some(()).ok_or_else(error)
    }

    /// Checks that empty places are listed once, that targets are poses, and that these are the obstacles.
    ///
    /// # Errors
    /// Says what is wrong.
    pub(crate) fn check(&self, obstacles: &[Obstacle]) -> Result<(), String> {
        let (count, slots) = (obstacles.len(), self.arena.slot_count());
        if count != slots {
            return Err(format!("{slots} places for {count} obstacles"));
        }
        self.check_free()?;
        for ((k, _), state) in self.arena.iter() {
            let obstacle = &obstacles[k as usize];
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
    use crate::{World, WorldConfig};
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

    #[cfg(feature = "snapshot")]
    #[test]
    fn what_is_wrong_with_obstacles_that_are_read_is_said_of_the_right_one() {
        let mut table = ObstacleTable::default();
        (0..3).for_each(|_| _ = table.insert(&ball()));
        let mut obstacles = vec![ball(); 3];
        obstacles[2].material.friction = -1.0;
        let refused = World::new(WorldConfig::default()).unwrap().restore_obstacles(table, obstacles).unwrap_err();
        assert!(refused.contains("obstacles[2].material.friction"), "{refused}");
    }
}
