//! Gravity and damping that are an organism's own.

use super::World;
use super::change::WorldChange;
use crate::config::WorldConfig;
use crate::error::{Error, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::particle::Particles;
use crate::particle::mass_properties::MassProperties;
use crate::particle::sleep::Sleep;
use crate::solver::force::Force;

impl World {
    /// Sets how strongly gravity acts on an organism: 1 as on others, 0 not at all, negative upwards; within ±100. Cells that
    /// divide pass it on.
    ///
    /// # Errors
    /// When the handle is stale, or the scale is not finite or out of its range.
    pub fn set_gravity_scale(&mut self, id: OrganismId, scale: f32) -> Result<(), Error> {
        self.organism_or_stale(id, "organism")?;
        in_range("scale", scale, -100.0, 100.0)?;
        self.organisms.set_gravity_scale(id, scale);
        self.wake_up(id);
        self.wake_up_touching(id);
        self.changed(|| WorldChange::SetGravityScale(id, scale));
        Ok(())
    }

    /// Sets the damping of an organism's motion as a whole besides that of the medium ([`WorldConfig::damping`]), 1/s, 0 to 100, and
    /// at most 0.05 over the substep: the velocity of its centre of mass falls to exp(-damping t) of itself, and what changes its form
    /// or turns it is not damped. Cells that divide pass it on.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Inputs, Placement, World, WorldConfig, glam::Vec2};
    /// # let mut world = World::new(WorldConfig { damping: 0.0, ..WorldConfig::default() })?;
    /// let [leaf, stone] = [30.0, 60.0].map(|y| world.spawn(&AgarSpec::default().into(), Placement::at(30.0, y)));
    /// let (leaf, stone) = (leaf?, stone?);
    /// [leaf, stone].into_iter().try_for_each(|id| world.push(id, Vec2::new(10.0, 0.0)))?;
    /// world.set_linear_damping(leaf, 2.0)?;
    /// (0..60).for_each(|_| world.step(&Inputs::new()));
    /// let [leaf, stone] = [leaf, stone].map(|id| world.view().organism(id).unwrap().velocity().x);
    /// assert!((leaf / stone - 0.136).abs() < 0.002);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the handle is stale, or the damping is not finite or out of its range.
    pub fn set_linear_damping(&mut self, id: OrganismId, damping: f32) -> Result<(), Error> {
        let organism = self.organisms.get(id).ok_or_else(|| Error::stale("organism"))?;
        let angular = organism.angular_damping;
        with_default_float_environment(|| {
            self.config.check_damping("damping", damping)?;
            self.check_kicks_at_damping(organism, damping)
        })?;
        self.organisms.set_damping(id, [damping, angular]);
        self.changed(|| WorldChange::SetLinearDamping(id, damping));
        Ok(())
    }

    /// Sets the damping of an organism's rotation about its centre of mass, 1/s, within the same range: its angular velocity falls to
    /// exp(-damping t) of itself. Cells that divide pass it on.
    ///
    /// # Errors
    /// When the handle is stale, the damping is not finite or out of its range, or it is of fluid in a room with periodic sides.
    pub fn set_angular_damping(&mut self, id: OrganismId, damping: f32) -> Result<(), Error> {
        let organism = self.organisms.get(id).ok_or_else(|| Error::stale("organism"))?;
        let linear = organism.linear_damping;
        with_default_float_environment(|| self.config.check_damping("damping", damping))?;
        if damping != 0.0 && organism.is_free_fluid() && !self.period().is_none() {
            return Err(Error::unsupported("damping", "0 for fluid in a room with periodic sides"));
        }
        self.organisms.set_damping(id, [linear, damping]);
        self.changed(|| WorldChange::SetAngularDamping(id, damping));
        Ok(())
    }

    /// Adds the forces by which gravity on some organisms differs from that on others; what sleeps has none.
    pub(crate) fn scale_gravity(&mut self) {
        let Self { organisms, particles, sleep, blocks, scratch, config, .. } = self;
        for organism in organisms.with_gravity_scale() {
            let lane = organism.body.lane(blocks);
            if !lane.is_some_and(|(block, _)| sleep.is_asleep(block)) {
                let acceleration = config.gravity * (organism.gravity_scale - 1.0);
                let list: Vec<u32> = organism.particles().collect();
                lane.into_iter().for_each(|lane| keep_falling(organism, &list, lane, config, particles, sleep));
                scratch.forces.add(&list, Force { acceleration, ..Force::default() });
            }
        }
    }

    /// Hands the damping of single organisms to the solver for a step; what sleeps has none.
    pub(crate) fn damp_organisms(&mut self) {
        let Self { organisms, particles, sleep, blocks, scratch, config, .. } = self;
        for organism in organisms.with_damping() {
            let lane = organism.body.lane(blocks);
            if !lane.is_some_and(|(block, _)| sleep.is_asleep(block)) {
                let list: Vec<u32> = organism.particles().collect();
                lane.into_iter().for_each(|lane| keep_falling(organism, &list, lane, config, particles, sleep));
                scratch.forces.damp(list, [organism.linear_damping, organism.angular_damping]);
            }
        }
    }
}

/// Keeps awake what is slower than the sleep speed because it falls slowly.
fn keep_falling(
    organism: &Organism,
    list: &[u32],
    (block, lane): (u32, usize),
    config: &WorldConfig,
    particles: &Particles,
    sleep: &mut Sleep,
) {
    let slowest = 0.25 * config.fall_speed(organism.gravity_scale, organism.linear_damping);
    let speed = MassProperties::of(particles, list).map_or(0.0, |body| body.velocity.length());
    if 0.0 < slowest && slowest < speed {
        sleep.wake_up(block, lane);
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Actuation, AgarSpec, BrownianParams, CoccusSpec, Controller, Inputs, Node, OrganismId, Placement, Template,
        World, WorldConfig,
    };
    use glam::Vec2;

    fn room(gravity: f32, damping: f32) -> World {
        let gravity = Vec2::new(0.0, -gravity);
        let size = Vec2::splat(400.0);
        World::new(WorldConfig { size, gravity, damping, ..WorldConfig::default() }).unwrap()
    }

    fn dumbbell(world: &mut World, placement: Placement) -> OrganismId {
        let mut builder = Template::builder();
        let [a, b] = [-2.0, 2.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
        builder.link(a, b, 0.0);
        let template = world.add_template(builder.build().unwrap());
        world.spawn_template(template, placement).unwrap()
    }

    /// Velocity and angular velocity a second after a throw.
    fn thrown(linear: f32, angular: f32) -> [f32; 2] {
        let mut world = room(0.0, 0.0);
        let body = dumbbell(&mut world, Placement::at(200.0, 200.0).damped(linear, angular));
        let mut throw = Inputs::new();
        let impulse = Vec2::new(16.0, 0.0);
        throw.actuate(body, Actuation { impulse, torque: 8.0 * 60.0, ..Actuation::default() }).unwrap();
        world.step(&throw);
        let (before, at) = (world.clone(), |world: &World| {
            let body = world.view().organism(body).unwrap();
            [body.velocity().x, body.angular_velocity()]
        });
        (0..60).for_each(|_| world.step(&Inputs::new()));
        let ([v, w], [v0, w0]) = (at(&world), at(&before));
        assert!(v0 > 4.0 && w0 > 0.5, "{v0} {w0}");
        [v / v0, w / w0]
    }

    #[test]
    fn motion_and_rotation_fall_each_by_its_own_damping() {
        let close = |[v, w]: [f32; 2], expected: [f32; 2]| {
            assert!((v - expected[0]).abs() < 0.003 && (w - expected[1]).abs() < 0.003, "{v} {w}, not {expected:?}");
        };
        close(thrown(0.0, 0.0), [1.0, 1.0]);
        close(thrown(1.0, 0.0), [0.3679, 1.0]);
        close(thrown(0.0, 2.0), [1.0, 0.1353]);
        close(thrown(2.0, 1.0), [0.1353, 0.3679]);
    }

    #[test]
    fn what_falls_slowly_by_its_own_damping_does_not_fall_asleep_and_what_lies_does() {
        let after = |y: f32| {
            let mut world = room(0.1, 0.0);
            let ball = AgarSpec::default().into();
            let ball = world.spawn(&ball, Placement::at(200.0, y).damped(20.0, 0.0)).unwrap();
            (0..1200).for_each(|_| world.step(&Inputs::new()));
            (y - world.centroid(ball).unwrap().y, world.view().organism(ball).unwrap().is_at_rest())
        };
        let (fallen, is_at_rest) = after(200.0);
        // 0.1 / 20 units/s for 20 s, and a share of damping times substep more, as with that of the medium.
        assert!((fallen / 0.1 - 1.0 - 20.0 / 480.0).abs() < 0.01 && !is_at_rest, "{fallen}");
        assert!(after(1.0).1);
    }

    #[test]
    fn who_follows_a_law_of_motion_follows_it_with_damping_too() {
        let spread = |own: f32| {
            let mut world = room(0.0, 0.5);
            let walk = Controller::brownian(BrownianParams { diffusion: 2.0, ..BrownianParams::default() });
            let place = |k: u32| Placement::at(10.0 + 16.0 * (k % 24) as f32, 10.0 + 16.0 * (k / 24) as f32);
            let coccus = CoccusSpec { radius: 0.4, ..CoccusSpec::default() }.into();
            let spawn = |k: u32| world.spawn(&coccus, place(k).steered_by(walk.clone()).damped(own, own)).unwrap();
            let walkers: Vec<_> = (0..480).map(spawn).collect();
            let from: Vec<Vec2> = walkers.iter().map(|&id| world.centroid(id).unwrap()).collect();
            (0..60).for_each(|_| world.step(&Inputs::new()));
            let squares =
                walkers.iter().zip(&from).map(|(&id, &at)| (world.centroid(id).unwrap() - at).length_squared());
            squares.sum::<f32>() / walkers.len() as f32
        };
        let (free, damped) = (spread(0.0), spread(20.0));
        assert!((damped / free - 1.0).abs() < 0.02, "{damped} instead of {free}");
    }

    #[test]
    fn dampings_that_cannot_be_are_refused() {
        let mut world = room(0.0, 0.0);
        let body = dumbbell(&mut world, Placement::at(40.0, 40.0));
        for damping in [-1.0, f32::NAN, 25.0, 101.0] {
            assert_eq!(world.set_linear_damping(body, damping).unwrap_err().field(), "damping");
            assert_eq!(world.set_angular_damping(body, damping).unwrap_err().field(), "damping");
            let ball = AgarSpec::default().into();
            let refused = world.spawn(&ball, Placement::at(80.0, 40.0).damped(damping, 0.0)).unwrap_err();
            assert_eq!(refused.field(), "linear_damping");
            let refused = world.spawn(&ball, Placement::at(80.0, 40.0).damped(0.0, damping)).unwrap_err();
            assert_eq!(refused.field(), "angular_damping");
        }
        world.set_linear_damping(body, 3.0).unwrap();
        world.set_angular_damping(body, 4.0).unwrap();
        let view = world.view().organism(body).unwrap();
        assert_eq!((view.linear_damping(), view.angular_damping()), (3.0, 4.0));
        world.validate().unwrap();
    }
}
