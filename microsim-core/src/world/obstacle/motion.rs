//! Kinematic obstacles: their targets, and their paths through a step.

use super::{WALLS, check_pose};
use crate::collision::obstacle::ObstacleMotion;
use crate::collision::obstacle_path::{ObstaclePath, extent};
use crate::collision::obstacle_record::record;
use crate::error::{Error, out_of_range};
use crate::event::Event;
use crate::id::ObstacleId;
use crate::world::World;
use crate::world::change::WorldChange;
use parry2d::math::Pose;

/// Extent of a shape, units, above which it has no end, and a turn no longest way.
const LARGEST_TURNED: f32 = 1e6;

impl World {
    /// Gives a kinematic obstacle a target, which it reaches by the end of the next step: on a straight line, turning at a
    /// nearly constant rate, so that contacts feel the velocity of its surface and friction carries what rides on it. No point
    /// of it gets faster than [`crate::WorldConfig::max_speed`]; what is farther away takes several steps.
    ///
    /// A body that is caught between it and something that does not give way is not crushed: the obstacle moves back, and
    /// then goes on or stops, see [`ObstacleMotion`]. It comes to an end with [`Event::ObstacleBlocked`] if it stops.
    ///
    /// ```
    /// use microsim_core::prelude::*;
    ///
    /// let mut world = World::new(WorldConfig { gravity: Vec2::new(0.0, -10.0), ..WorldConfig::default() })?;
    /// let bar = Obstacle::new(SharedShape::cuboid(10.0, 1.0), Pose::translation(40.0, 10.0));
    /// let lift = world.add_obstacle(Obstacle { motion: ObstacleMotion::Push, ..bar })?;
    /// let rider = world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 12.0))?;
    /// for step in 0..120 {
    ///     world.move_obstacle(lift, Pose::translation(40.0, 10.0 + 0.05 * step as f32))?;
    ///     world.step(&Inputs::new());
    /// }
    /// assert!((world.centroid(rider).unwrap().y - 18.0).abs() < 0.2);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// When the handle is stale, the obstacle is fixed or disabled, the target is not finite, or more than a quarter turn away, a
    /// half-space is to turn, or the obstacle would be outside of a room with periodic sides, or turn in one that it is too long for.
    pub fn move_obstacle(&mut self, id: ObstacleId, target: Pose) -> Result<(), Error> {
        let obstacle = self.known_obstacle(id)?;
        if obstacle.motion == ObstacleMotion::Fixed {
            return Err(Error::unsupported(
                "motion",
                "an obstacle that pushes or stops: a fixed one can be put elsewhere",
            ));
        }
        if !obstacle.is_enabled {
            return Err(Error::unsupported("is_enabled", "an obstacle that is enabled"));
        }
        check_pose("target", &target)?;
        let (a, b) = (obstacle.pose.rotation, target.rotation);
        let cosine = a.re * b.re + a.im * b.im;
        if cosine < 0.0 {
            let accepted = "at most a quarter turn from where it is, a cosine of 0 to 1".to_owned();
            return Err(out_of_range("target.rotation", cosine.into(), accepted));
        }
        if a != b && extent(obstacle) > LARGEST_TURNED {
            return Err(Error::unsupported("target.rotation", "its own, for a shape without an end"));
        }
        self.check_target_period(obstacle, &target)?;
        self.obstacle_table.set_target(id.index, Some(&target));
        self.changed(|| WorldChange::MoveObstacle(id, record(&target)));
        Ok(())
    }

    /// Where an obstacle is going; `None` if it rests, or for a stale handle.
    #[must_use]
    pub fn obstacle_target(&self, id: ObstacleId) -> Option<Pose> {
        self.obstacle(id).and_then(|_| self.obstacle_table.target(id.index))
    }

    /// Plans the paths of the step that begins.
    pub(crate) fn plan_obstacle_paths(&mut self) {
        let Self { config, obstacle_table, obstacles, scratch, .. } = self;
        scratch.obstacle_paths.clear();
        let path = |index: u32| {
            let at = index + WALLS as u32;
            let target = obstacle_table.target(index)?;
            Some(ObstaclePath::new(at, &obstacles[at as usize], target, config.max_displacement(), config.substeps))
        };
        scratch.obstacle_paths.extend(obstacle_table.moving().filter_map(path));
        if !scratch.obstacle_paths.is_empty() {
            scratch.query_index.clear_obstacles();
        }
    }

    /// Moves obstacles as far as they come in a substep.
    pub(crate) fn advance_obstacles(&mut self) {
        for path in &mut self.scratch.obstacle_paths {
            path.advance();
            self.obstacles[path.obstacle as usize].pose = path.pose();
        }
    }

    /// Leaves obstacles where they have come to; those that are at their target, or stopped, forget it.
    pub(crate) fn conclude_obstacle_paths(&mut self) {
        for path in &mut self.scratch.obstacle_paths {
            path.finish();
            let (at, index) = (path.obstacle as usize, path.obstacle - WALLS as u32);
            self.obstacles[at].pose = path.pose();
            self.obstacle_table.set_pose(index, &path.pose());
            let is_stopped = path.is_blocked && self.obstacles[at].motion == ObstacleMotion::Stop;
            if path.is_done() || is_stopped {
                self.obstacle_table.set_target(index, None);
            }
            if let Some(obstacle) = self.obstacle_table.id_at(index).filter(|_| is_stopped) {
                self.events.push(Event::ObstacleBlocked { obstacle });
            }
        }
    }
}
