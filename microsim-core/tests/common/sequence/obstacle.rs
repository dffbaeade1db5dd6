//! Calls for obstacles, also with handles that are stale.

use super::{Outcome, Sequence};
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{Obstacle, ObstacleMotion};

impl Sequence<'_> {
    /// A call for obstacles, also with handles that are stale.
    pub(super) fn obstacle_call(&mut self) -> (&'static str, Outcome) {
        let which = self.choices.below(12);
        let count = self.obstacles.len();
        if which < 4 || count == 0 {
            return ("add_obstacle", self.add_obstacle());
        }
        let id = self.obstacles[self.choices.below(count)];
        let to = Pose::new(self.place(), self.choices.number(-3.0, 3.0));
        match which {
            4 => ("remove_obstacle", self.world.remove_obstacle(id)),
            5 => ("set_obstacle_pose", self.world.set_obstacle_pose(id, to)),
            6 => {
                let shape = self.obstacle_shape();
                ("set_obstacle_shape", self.world.set_obstacle_shape(id, shape))
            }
            7 => {
                let is_enabled = self.choices.flag();
                ("set_obstacle_enabled", self.world.set_obstacle_enabled(id, is_enabled))
            }
            _ => ("move_obstacle", self.world.move_obstacle(id, to)),
        }
    }

    fn add_obstacle(&mut self) -> Outcome {
        let at = self.place();
        let shape = self.obstacle_shape();
        let kind = self.choices.byte();
        let motion = [ObstacleMotion::Push, ObstacleMotion::Stop, ObstacleMotion::Fixed][usize::from(kind % 3)];
        let one_way = (kind % 5 == 1).then(|| Vec2::new(self.choices.number(-1.0, 1.0), 1.0));
        let added = Obstacle {
            motion,
            one_way,
            is_sensor: kind % 4 == 1,
            ..Obstacle::new(shape, Pose::translation(at.x, at.y))
        };
        self.world.add_obstacle(added).map(|id| self.obstacles.push(id))
    }

    fn obstacle_shape(&mut self) -> SharedShape {
        let (a, b) = (self.choices.range(0.5, 6.0), self.choices.range(0.5, 6.0));
        match self.choices.below(4) {
            0 => SharedShape::ball(a),
            1 => SharedShape::cuboid(a, b),
            2 => SharedShape::polyline(vec![Vec2::ZERO, Vec2::new(a, 0.0), Vec2::new(a, b)], None),
            _ => SharedShape::capsule(Vec2::ZERO, Vec2::new(a, b), 1.0),
        }
    }
}
