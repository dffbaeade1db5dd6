//! What the program does between steps: one call after the other, some of them in each step.

use super::Commanded;
use microsim_core::glam::Vec2;
use microsim_core::parry2d::{math::Pose, shape::SharedShape};
use microsim_core::{
    AgarSpec, CoccusSpec, Collider, CollisionGroups, Controller, Emitter, Error, FieldKind, ForceField, JointKind,
    JointSpec, Obstacle, OrganismSpec, Placement, QueryFilter, Recipe, Region,
};

impl Commanded {
    pub(super) fn call(&mut self, step: u64) -> Result<(), Error> {
        self.move_obstacles(step)?;
        self.look(step)?;
        self.change_obstacles(step)?;
        self.change_joints(step)?;
        self.change_organisms(step)?;
        self.change_environment(step)
    }

    /// The lift goes up and down, the piston to and fro.
    fn move_obstacles(&mut self, step: u64) -> Result<(), Error> {
        let there = |period: u64| (step % (2 * period)).min(2 * period - step % (2 * period)) as f32;
        self.world.move_obstacle(self.lift, Pose::translation(125.0, 4.0 + 0.1 * there(40)))?;
        self.world.move_obstacle(self.piston, Pose::translation(140.0 + 0.2 * there(25), 4.0))
    }

    /// What queries find decides on a push.
    fn look(&mut self, step: u64) -> Result<(), Error> {
        if step % 10 != 3 {
            return Ok(());
        }
        let (queries, all) = (self.world.queries(), QueryFilter::default());
        let ray = queries.cast_ray(Vec2::new(118.0, 20.0), Vec2::new(1.0, 0.4), 200.0, &all);
        let cast = queries.cast_disc(Vec2::new(118.0, 90.0), Vec2::new(0.3, -1.0), 100.0, 1.5, &all);
        let near = queries.nearest(Vec2::new(112.0, 70.0), 50.0, &QueryFilter::organisms());
        let count = queries.overlap_disc(Vec2::new(60.0, 60.0), 8.0, &all).len();
        let found = [ray.map(|hit| (hit.collider, hit.normal)), cast.map(|hit| (hit.collider, hit.normal))];
        let found = found.into_iter().flatten().chain(near.map(|near| (near.collider, Vec2::Y)));
        let pushes: Vec<_> = found.collect();
        for (collider, normal) in pushes {
            if let Collider::Organism(id) = collider {
                self.world.push(id, normal * (1.0 + count as f32))?;
            }
        }
        Ok(())
    }

    fn change_obstacles(&mut self, step: u64) -> Result<(), Error> {
        let world = &mut self.world;
        match step {
            4 => world.set_obstacle_shape(self.door, SharedShape::cuboid(1.5, 5.0)),
            8 => world.set_obstacle_enabled(self.door, false),
            12 => world.set_obstacle_pose(self.door, Pose::translation(172.0, 8.0)),
            16 => world.set_obstacle_enabled(self.door, true),
            20 => world.add_obstacle(Obstacle::new(SharedShape::ball(2.0), Pose::translation(230.0, 8.0))).map(drop),
            36 => world.remove_obstacle(self.door),
            _ => Ok(()),
        }
    }

    fn change_joints(&mut self, step: u64) -> Result<(), Error> {
        let (motor, rope, weld) = (self.joints[12], self.joints[1], self.joints[2]);
        match step {
            6 => {
                let Some(view) = self.world.joint(motor) else { return Ok(()) };
                let kind = JointKind::SpeedMotor { speed: -3.0, max_force: 100.0 };
                self.world.set_joint(motor, JointSpec { kind, ..view.spec })
            }
            14 => self.world.remove_joint(rope),
            22 => {
                let Some(view) = self.world.joint(weld) else { return Ok(()) };
                self.world.set_joint(weld, view.spec.breaking_at(5.0))
            }
            _ => Ok(()),
        }
    }

    fn change_organisms(&mut self, step: u64) -> Result<(), Error> {
        let (slimes, balls, world) = (&mut self.slimes, &self.balls, &mut self.world);
        let id = slimes[30 + step as usize % 60];
        match step {
            1 => world.push(balls[17], Vec2::new(0.0, 20.0)),
            2 => world.set_mass(self.rod, 1.5),
            3 => world.divide(self.rod),
            5 => world.set_gravity_scale(id, -0.5),
            7 => world.spawn(&AgarSpec::default().into(), Placement::at(215.0, 8.0)).map(drop),
            9 => world.remove(id),
            11 => world.set_scale(id, 1.2),
            13 => {
                let at = world.centroid(id).unwrap_or_default();
                let coccus = OrganismSpec::from(CoccusSpec::default());
                world.replace(id, &coccus.into(), Placement::at(at.x, at.y)).map(drop)
            }
            15 => world.set_collision_groups(id, CollisionGroups { memberships: 2, filter: !2 }),
            17 => world.set_exempt(slimes[20], slimes[21], true),
            19 => world.set_controller(self.swimmer, Controller::wander([0.2, 0.4], 0.1)),
            21 => world.set_speed(self.swimmer, 9.0),
            23 => world.set_user_data(id, u128::from(step) << 70),
            25 => world.grow(self.cell, 1, 4),
            27 => world.shrink(self.cell, 2),
            29 => world.divide_along(self.cell, Vec2::X),
            31 => world.set_linear_damping(id, 2.0),
            33 => world.set_angular_damping(id, 3.0),
            _ => Ok(()),
        }
    }

    fn change_environment(&mut self, step: u64) -> Result<(), Error> {
        let world = &mut self.world;
        let calm = ForceField { region: Region::All, kind: FieldKind::Uniform { acceleration: Vec2::new(1.0, 0.5) } };
        match step {
            18 => world.set_gravity(Vec2::new(2.0, -8.0)),
            24 => world.set_damping(0.8),
            26 => world.set_max_speed(50.0),
            28 => world.set_field(self.wind, calm),
            30 => world.remove_field(self.wind),
            32 => {
                let region = Region::Circle { centre: Vec2::new(94.0, 84.0), radius: 8.0 };
                let ball = Recipe::Organism(AgarSpec::default().into());
                world.set_emitter(self.inlet, Emitter { angle: Some(1.0), ..Emitter::new(region, ball, 60.0) })
            }
            34 => world.set_contact_reporting(None),
            38 => world.set_size(Vec2::new(244.0, 121.0)),
            _ => Ok(()),
        }
    }
}
