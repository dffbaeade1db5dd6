//! Obstacles: the four walls, and those that are added. They can be moved, replaced, disabled and removed.
//!
//! What an obstacle carries, pushes or lets through is a matter of contacts (`solver/obstacle.rs`); how it moves within a step
//! is in [`motion`], what is inside a sensor in [`sensor`], and handles are in [`table`].

pub(crate) mod motion;
pub(crate) mod sensor;
pub(crate) mod table;
mod walls;

use super::World;
use super::change::WorldChange;
use super::chemical::keep_out;
use crate::collision::obstacle::Obstacle;
use crate::collision::obstacle_record::ObstacleRecord;
use crate::error::{Error, ErrorKind, in_range, out_of_range};
use crate::float_environment::with_default_float_environment;
use crate::id::ObstacleId;
use crate::particle::{CollisionGroups, Material};
use glam::Vec2;
use parry2d::math::Pose;
use parry2d::shape::SharedShape;
pub(crate) use walls::{WALLS, walls};

impl World {
    /// Adds an obstacle: any `parry2d` shape. No disc gets through it, however thin it is.
    ///
    /// # Errors
    /// When the pose is not finite, the shape's box is not finite, a material number is out of range, a one-way platform has no
    /// direction, the obstacle would overlap an organism, or it is outside of a room with periodic sides or longer than two of it.
    /// Nothing is changed then.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<ObstacleId, Error> {
        let record = ObstacleRecord::of(&obstacle).map(Box::new);
        let id = with_default_float_environment(|| self.insert_obstacle(obstacle))?;
        self.changed(|| record.map_or(WorldChange::Unrecordable, WorldChange::AddObstacle));
        Ok(id)
    }

    fn insert_obstacle(&mut self, obstacle: Obstacle) -> Result<ObstacleId, Error> {
        check(&obstacle)?;
        self.check_clear(&obstacle)?;
        for chemical in self.chemicals.iter_mut().filter(|_| obstacle.stops_chemicals()) {
            keep_out(chemical, &obstacle);
        }
        if obstacle.is_sensor {
            self.wake_up_near(&obstacle);
        }
        self.scratch.query_index.clear_obstacles();
        let at = WALLS + self.obstacle_table.next_index();
        let id = self.obstacle_table.insert(&obstacle);
        if at < self.obstacles.len() {
            self.obstacles[at] = obstacle;
        } else {
            self.obstacles.push(obstacle);
        }
        Ok(id)
    }

    /// Handles of the obstacles that were added, in a stable order.
    pub fn obstacles(&self) -> impl Iterator<Item = ObstacleId> + '_ {
        self.obstacle_table.ids()
    }

    /// An obstacle; `None` for a stale handle.
    #[must_use]
    pub fn obstacle(&self, id: ObstacleId) -> Option<&Obstacle> {
        self.obstacle_table.contains(id).then(|| &self.obstacles[WALLS + id.index as usize])
    }

    /// Removes an obstacle. What rested on it wakes up.
    ///
    /// # Errors
    /// When the handle is stale.
    pub fn remove_obstacle(&mut self, id: ObstacleId) -> Result<(), Error> {
        self.known_obstacle(id)?;
        with_default_float_environment(|| self.put(id, nothing()));
        self.obstacle_table.remove(id);
        self.changed(|| WorldChange::RemoveObstacle(id));
        Ok(())
    }

    /// Puts an obstacle somewhere else at once, without pushing anything; a target is forgotten. To let it move and push, see
    /// [`World::move_obstacle`].
    ///
    /// # Errors
    /// When the handle is stale, the pose is not finite, or the obstacle would overlap an organism. Nothing is changed then.
    pub fn set_obstacle_pose(&mut self, id: ObstacleId, pose: Pose) -> Result<(), Error> {
        with_default_float_environment(|| self.change_obstacle(id, |obstacle| obstacle.pose = pose))
    }

    /// Gives an obstacle another shape; a target is forgotten.
    ///
    /// # Errors
    /// When the handle is stale, the shape's box is not finite, or the obstacle would overlap an organism. Nothing is changed
    /// then.
    pub fn set_obstacle_shape(&mut self, id: ObstacleId, shape: SharedShape) -> Result<(), Error> {
        with_default_float_environment(|| self.change_obstacle(id, |obstacle| obstacle.shape = shape))
    }

    /// Lets an obstacle be there, or as if it were not; a target is forgotten.
    ///
    /// # Errors
    /// When the handle is stale, or the obstacle would overlap an organism. Nothing is changed then.
    pub fn set_obstacle_enabled(&mut self, id: ObstacleId, is_enabled: bool) -> Result<(), Error> {
        with_default_float_environment(|| self.change_obstacle(id, |obstacle| obstacle.is_enabled = is_enabled))
    }

    pub(in crate::world) fn change_obstacle(
        &mut self,
        id: ObstacleId,
        change: impl FnOnce(&mut Obstacle),
    ) -> Result<(), Error> {
        let mut obstacle = self.known_obstacle(id)?.clone();
        change(&mut obstacle);
        check(&obstacle)?;
        self.check_clear(&obstacle)?;
        let record = ObstacleRecord::of(&obstacle).map(Box::new);
        self.obstacle_table.replace(id, &obstacle);
        self.put(id, obstacle);
        let set = |record| WorldChange::SetObstacle(id, record);
        self.changed(|| record.map_or(WorldChange::Unrecordable, set));
        Ok(())
    }

    /// Puts an obstacle in the place of another one, and wakes what is near either.
    fn put(&mut self, id: ObstacleId, obstacle: Obstacle) {
        self.scratch.query_index.clear_obstacles();
        self.wake_up_near(&obstacle);
        let place = &mut self.obstacles[WALLS + id.index as usize];
        let before = std::mem::replace(place, obstacle);
        let shut = before.stops_chemicals() || place.stops_chemicals();
        self.wake_up_near(&before);
        self.wake_up_joined_to(id);
        if shut {
            self.open_chemicals();
        }
    }

    /// Puts the walls where the settings say.
    pub(in crate::world) fn rebuild_walls(&mut self) {
        for (wall, rebuilt) in self.obstacles.iter_mut().zip(walls(&self.config)) {
            *wall = rebuilt;
        }
    }

    /// Lets chemicals into all of the room but its present obstacles.
    pub(in crate::world) fn open_chemicals(&mut self) {
        let Self { chemicals, obstacles, config, .. } = self;
        for chemical in chemicals {
            chemical.open(config.size);
            let shut = obstacles.iter().skip(WALLS).filter(|obstacle| obstacle.stops_chemicals());
            shut.for_each(|obstacle| keep_out(chemical, obstacle));
        }
    }

    /// Takes over the obstacles that were read, in the order of their places.
    ///
    /// # Errors
    /// Says what is wrong with them.
    #[cfg(feature = "snapshot")]
    pub(in crate::world) fn restore_obstacles(
        &mut self,
        table: table::ObstacleTable,
        obstacles: Vec<Obstacle>,
    ) -> Result<(), String> {
        table.check_free()?;
        let (mut read, mut count) = (obstacles.into_iter(), 0);
        for index in 0..table.len() as u32 {
            let is_there = table.id_at(index).is_some();
            let obstacle = if is_there { read.next().ok_or("obstacles: some are missing")? } else { nothing() };
            check(&obstacle).map_err(|error| error.within(&format!("obstacles[{count}]")).to_string())?;
            if is_there {
                let checked = self.check_read_obstacle_period(&obstacle, table.target(index));
                checked.map_err(|error| error.within(&format!("obstacles[{count}]")).to_string())?;
            }
            count += usize::from(is_there);
            self.obstacles.push(obstacle);
        }
        if read.next().is_some() {
            return Err("obstacles: more than there are places".to_owned());
        }
        self.obstacle_table = table;
        self.obstacle_table.check(&self.obstacles[WALLS..])
    }

    fn known_obstacle(&self, id: ObstacleId) -> Result<&Obstacle, Error> {
        self.obstacle(id).ok_or_else(|| Error::new(ErrorKind::Stale, "obstacle"))
    }

    /// Checks that an obstacle overlaps no organism.
    fn check_clear(&self, obstacle: &Obstacle) -> Result<(), Error> {
        self.check_obstacle_period(obstacle)?;
        let overlapped = if obstacle.is_solid() { self.overlapped_by(obstacle) } else { None };
        overlapped.map_or(Ok(()), |with| Err(Error::new(ErrorKind::Overlap { with }, "pose")))
    }

    /// The obstacles that were added and can be touched.
    pub(crate) fn solid_obstacles(&self) -> impl Iterator<Item = &Obstacle> {
        self.obstacles.iter().skip(WALLS).filter(|obstacle| obstacle.is_solid())
    }
}

/// Checks all of an obstacle but its place among organisms.
fn check(obstacle: &Obstacle) -> Result<(), Error> {
    let Material { friction, restitution } = obstacle.material;
    in_range("material.friction", friction, 0.0, 10.0)?;
    in_range("material.restitution", restitution, 0.0, 1.0)?;
    check_pose("pose", &obstacle.pose)?;
    let bounds = obstacle.aabb();
    if !(bounds.mins.is_finite() && bounds.maxs.is_finite()) {
        return Err(Error::unsupported("shape", "a shape with a finite bounding box"));
    }
    if !bounds.mins.cmple(bounds.maxs).all() {
        return Err(Error::unsupported("shape", "a shape whose sizes are not negative"));
    }
    let normal = obstacle.one_way.unwrap_or(Vec2::Y);
    in_range("one_way.x", normal.x, -1e5, 1e5)?;
    in_range("one_way.y", normal.y, -1e5, 1e5)?;
    if normal.length() < 1e-3 {
        return Err(out_of_range("one_way", normal.length().into(), "a length of at least 0.001".to_owned()));
    }
    Ok(())
}

/// Checks that a pose is near the room and its rotation is one.
pub(in crate::world) fn check_pose(field: &str, pose: &Pose) -> Result<(), Error> {
    in_range(&format!("{field}.translation.x"), pose.translation.x, -1e5, 1e5)?;
    in_range(&format!("{field}.translation.y"), pose.translation.y, -1e5, 1e5)?;
    let (re, im) = (pose.rotation.re, pose.rotation.im);
    in_range(&format!("{field}.rotation"), re * re + im * im, 0.999, 1.001)
}

/// What is in the place of an obstacle that was removed.
pub(crate) fn nothing() -> Obstacle {
    let groups = CollisionGroups::NONE;
    Obstacle { groups, is_enabled: false, ..Obstacle::new(SharedShape::ball(0.0), Pose::IDENTITY) }
}
