//! Settings that change while the world runs: the world's own, and those of single organisms.

use super::World;
use super::change::WorldChange;
use crate::capability::phagocytosis::PhagocytosisParams;
use crate::config::WorldConfig;
use crate::error::{Error, ErrorKind, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use crate::organism::{Blueprint, MAX_SPEED, Organism, Storage};
use crate::particle::CollisionGroups;
use crate::solver::fluid::{FluidMode, FluidParams};
use glam::Vec2;

impl World {
    /// Sets the acceleration on everything, see [`WorldConfig::gravity`]. Wakes everything.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Inputs, Placement, World, WorldConfig, glam::Vec2};
    /// # let mut world = World::new(WorldConfig::default())?;
    /// let balloon = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
    /// world.set_gravity(Vec2::new(0.0, -10.0))?;
    /// world.set_gravity_scale(balloon, -0.5)?;
    /// (0..60).for_each(|_| world.step(&Inputs::new()));
    /// assert!(world.centroid(balloon).unwrap().y > 31.0);
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// When a component is not finite or out of its range.
    pub fn set_gravity(&mut self, gravity: Vec2) -> Result<(), Error> {
        self.change_config(|config| config.gravity = gravity)?;
        self.sleep.wake_all();
        self.changed(|| WorldChange::SetGravity(gravity));
        Ok(())
    }

    /// Sets the drag of the medium, see [`WorldConfig::damping`]. Wakes nothing: what rests has no drag.
    ///
    /// # Errors
    /// When it is not finite or out of its range, or a thermal field would kick a body beyond the speed limit.
    pub fn set_damping(&mut self, damping: f32) -> Result<(), Error> {
        self.change_config(|config| config.damping = damping)?;
        self.changed(|| WorldChange::SetDamping(damping));
        Ok(())
    }

    /// Sets the speed limit, see [`WorldConfig::max_speed`]. What is faster is slowed down at once. Wakes nothing.
    ///
    /// # Errors
    /// When it is not finite or out of its range, or an organism that walks at random or is in a thermal field could not follow
    /// its law.
    pub fn set_max_speed(&mut self, max_speed: f32) -> Result<(), Error> {
        self.change_config(|config| config.max_speed = max_speed)?;
        with_default_float_environment(|| self.enforce_speed_limit());
        self.changed(|| WorldChange::SetMaxSpeed(max_speed));
        Ok(())
    }

    fn enforce_speed_limit(&mut self) {
        // Walls are as thick as the limit asks for.
        self.rebuild_walls();
        let limit = self.config.speed_limit();
        for i in 0..self.particles.len() {
            let Vec2 { x, y } = self.particles.velocity(i).clamp_length_max(limit);
            (self.particles.vx[i], self.particles.vy[i]) = (x, y);
        }
    }

    fn change_config(&mut self, change: impl FnOnce(&mut WorldConfig)) -> Result<(), Error> {
        let mut config = self.config.clone();
        change(&mut config);
        config.validate()?;
        let mut organisms = self.organisms.iter().map(|(_, organism)| organism);
        organisms.try_for_each(|o| o.controller.check_body(&o.locomotion, o.speed, &config))?;
        self.check_all_kicks(&config)?;
        self.config = config;
        Ok(())
    }

    /// Sets the speed with which an organism moves to its goals, units/s, 0 to 1000. Cells that divide pass it on.
    ///
    /// # Errors
    /// When the handle is stale, the speed is out of its range, or the organism's controller could not follow its law with it.
    pub fn set_speed(&mut self, id: OrganismId, speed: f32) -> Result<(), Error> {
        in_range("speed", speed, 0.0, MAX_SPEED)?;
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::stale("organism"))?;
        organism.controller.check_body(&organism.locomotion, speed, &self.config)?;
        organism.speed = speed;
        self.changed(|| WorldChange::SetSpeed(id, speed));
        Ok(())
    }

    /// Sets how a cell takes in and digests from now on; what is going in goes on in the way in which it began. Cells that
    /// divide pass it on.
    ///
    /// # Errors
    /// When the handle is stale, the organism takes in nothing, or a field is out of its range.
    pub fn set_phagocytosis(&mut self, id: OrganismId, params: PhagocytosisParams) -> Result<(), Error> {
        params.validate()?;
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::stale("organism"))?;
        let engulfer = organism.engulfer.as_mut();
        engulfer.ok_or_else(|| Error::unsupported("organism", "an organism that takes in prey"))?.params = params;
        self.changed(|| WorldChange::SetPhagocytosis(id, Box::new(params)));
        Ok(())
    }

    /// Sets a number of the embedder's own, which the library keeps and writes but never reads. Cells that divide pass it on.
    ///
    /// # Errors
    /// When the handle is stale.
    pub fn set_user_data(&mut self, id: OrganismId, data: u128) -> Result<(), Error> {
        let organism = self.organisms.get_mut(id).ok_or_else(|| Error::stale("organism"))?;
        let halves = [data as u64, (data >> 64) as u64];
        organism.user_data = halves;
        self.changed(|| WorldChange::SetUserData(id, halves));
        Ok(())
    }

    /// Sets what the discs of an organism collide with, but for nodes that its template lets collide with nothing.
    ///
    /// # Errors
    /// When the handle is stale, or the organism is frozen, has a membrane, which holds what is inside, is held by such a one, or
    /// lies outside of walls that it would collide with.
    pub fn set_collision_groups(&mut self, id: OrganismId, groups: CollisionGroups) -> Result<(), Error> {
        self.organism_or_stale(id, "organism")?;
        let Some(organism) = self.organisms.get(id) else { return Ok(()) };
        if organism.is_quarantined || organism.body.membrane().is_some() {
            return Err(Error::unsupported("organism", "an organism without a membrane that is not frozen"));
        }
        if organism.is_held() && !groups.meets(CollisionGroups::ALL) {
            return Err(Error::unsupported("groups", "groups that meet all for what a cell holds"));
        }
        let discs = self.colliding_discs(organism);
        let (p, size) = (&self.particles, self.config.size);
        let repeats = self.period().0.cmpgt(Vec2::ZERO);
        let is_inside = |i: usize| (p.position(i).cmpge(Vec2::ZERO) & p.position(i).cmple(size) | repeats).all();
        if groups.meets(CollisionGroups::ALL) && !discs.iter().all(|&i| is_inside(i)) {
            let accepted = format!("an organism within 0 to {} by 0 to {}", size.x, size.y);
            return Err(Error::new(ErrorKind::OutsideWorld { accepted }, "organism"));
        }
        discs.into_iter().for_each(|i| self.particles.groups[i] = groups);
        self.wake_up(id);
        self.wake_up_touching(id);
        self.changed(|| WorldChange::SetCollisionGroups(id, groups));
        Ok(())
    }

    /// The particles of an organism, without the nodes that its template lets collide with nothing.
    fn colliding_discs(&self, organism: &Organism) -> Vec<usize> {
        let template = match organism.body {
            Storage::Lane { block, .. } => self.templates.get(self.blocks[block as usize].template as usize),
            Storage::Loose { .. } => None,
        };
        let nodes = template.map_or(&[][..], |template| template.nodes());
        let collides = |k: usize| nodes.get(k).is_none_or(|node| node.groups != CollisionGroups::NONE);
        organism.particles().enumerate().filter(|&(k, _)| collides(k)).map(|(_, i)| i as usize).collect()
    }

    /// Checks that substeps are short enough for what it is made of.
    pub(super) fn check_substeps(&self, blueprint: &Blueprint) -> Result<(), Error> {
        if blueprint.rim.is_some() {
            self.config.check_membranes()?;
        }
        blueprint.fluid.as_ref().map_or(Ok(()), |plan| self.check_fluid(&plan.params))
    }

    pub(super) fn check_fluid(&self, params: &FluidParams) -> Result<(), Error> {
        if params.mode == FluidMode::Granular {
            self.config.check_grains()?;
        }
        self.check_fluid_period(params)?;
        self.config.check_viscosity(params.viscosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AgarSpec, AmoeboidCellSpec, Inputs, Placement};

    fn room() -> World {
        World::new(WorldConfig { gravity: Vec2::new(0.0, -10.0), damping: 0.0, ..WorldConfig::default() }).unwrap()
    }

    fn agar(world: &mut World, x: f32, y: f32) -> OrganismId {
        world.spawn(&AgarSpec::default().into(), Placement::at(x, y)).unwrap()
    }

    fn run(world: &mut World, steps: u32) {
        (0..steps).for_each(|_| world.step(&Inputs::new()));
    }

    fn height(world: &World, id: OrganismId) -> f32 {
        world.centroid(id).unwrap().y
    }

    #[test]
    fn gravity_turns_and_wakes_and_its_scale_is_an_organisms_own() {
        let mut world = room();
        let [plain, light, up] = [20.0, 40.0, 60.0].map(|x| agar(&mut world, x, 45.0));
        world.set_gravity_scale(light, 0.0).unwrap();
        world.set_gravity_scale(up, -1.0).unwrap();
        run(&mut world, 60);
        let moved = [plain, light, up].map(|id| height(&world, id) - 45.0);
        assert!((moved[0] + 5.0).abs() < 0.05 && moved[1] == 0.0 && (moved[2] - 5.0).abs() < 0.05, "{moved:?}");
        world.set_gravity(Vec2::ZERO).unwrap();
        world.set_damping(20.0).unwrap();
        run(&mut world, 120);
        assert!(world.view().organism(plain).unwrap().is_at_rest());
        world.set_gravity(Vec2::new(0.0, 900.0)).unwrap();
        let before = height(&world, plain);
        run(&mut world, 10);
        assert!(height(&world, plain) > before + 0.5);
        assert_eq!(world.set_gravity(Vec2::NAN).unwrap_err().field(), "gravity.x");
        assert_eq!(world.set_damping(-1.0).unwrap_err().field(), "damping");
        assert_eq!(world.set_gravity_scale(up, 101.0).unwrap_err().field(), "scale");
    }

    #[test]
    fn a_lower_speed_limit_holds_at_once_and_walls_hold_a_higher_one() {
        let mut world = room();
        let ball = agar(&mut world, 20.0, 45.0);
        world.push(ball, Vec2::new(20.0, 0.0)).unwrap();
        world.set_max_speed(5.0).unwrap();
        assert!(world.view().organism(ball).unwrap().velocity().length() < 5.01);
        world.validate().unwrap();
        world.set_max_speed(1000.0).unwrap();
        world.push(ball, Vec2::new(1000.0, -1000.0)).unwrap();
        for _ in 0..20 {
            run(&mut world, 1);
            world.validate().unwrap();
        }
        assert_eq!(world.set_max_speed(0.0).unwrap_err().field(), "max_speed");
    }

    #[test]
    fn a_speed_limit_that_a_random_walk_cannot_have_is_refused() {
        use crate::{BacillusSpec, Controller};
        let mut world = room();
        let walk = Controller::run_and_tumble(crate::RunAndTumbleParams::default());
        let spec = BacillusSpec { speed: 18.0, ..BacillusSpec::default() };
        let id = world.spawn(&spec.into(), Placement { controller: walk, ..Placement::at(30.0, 30.0) }).unwrap();
        assert_eq!(world.set_max_speed(12.0).unwrap_err().field(), "speed");
        assert_eq!(*world.config(), *room().config());
        world.set_controller(id, Controller::Still).unwrap();
        world.set_max_speed(12.0).unwrap();
        world.validate().unwrap();
    }

    #[test]
    fn groups_let_organisms_pass_each_other_and_a_membrane_keeps_its_own() {
        let mut world = room();
        let [low, high] = [1.2, 6.0].map(|y| agar(&mut world, 20.0, y));
        world.set_collision_groups(high, CollisionGroups { memberships: 2, filter: 1 << 31 }).unwrap();
        world.set_collision_groups(low, CollisionGroups { memberships: 1, filter: !2 }).unwrap();
        run(&mut world, 120);
        assert!((height(&world, low) - height(&world, high)).abs() < 0.1, "both lie on the floor");
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 20.0)).unwrap();
        assert_eq!(world.set_collision_groups(cell, CollisionGroups::NONE).unwrap_err().field(), "organism");
        world.set_collision_groups(high, CollisionGroups::NONE).unwrap();
        run(&mut world, 60);
        assert!(height(&world, high) < -2.0, "nothing holds it");
        assert_eq!(world.set_collision_groups(high, CollisionGroups::ALL).unwrap_err().field(), "organism");
    }

    #[test]
    fn bodies_of_different_tiers_lie_over_each_other_and_meet_what_is_in_none() {
        use crate::RedCellSpec;
        let mut world = World::new(WorldConfig::default()).unwrap();
        let tier = |tier| CollisionGroups::in_tier(tier).unwrap();
        let at = |x: f32, groups| Placement::at(x, 40.0).in_groups(groups);
        let [low, high] = [(30.0, tier(0)), (33.0, tier(1))]
            .map(|(x, groups)| world.spawn(&RedCellSpec::default().into(), at(x, groups)).unwrap());
        for groups in [tier(0), CollisionGroups::ALL] {
            assert!(world.spawn(&RedCellSpec::default().into(), at(35.0, groups)).is_err());
        }
        let refused = world.spawn(&AmoeboidCellSpec::default().into(), at(80.0, tier(0))).unwrap_err();
        assert_eq!(refused.field(), "groups");
        world.push(low, Vec2::new(4.0, 0.0)).unwrap();
        run(&mut world, 120);
        assert_eq!(world.centroid(high), Some(Vec2::new(33.0, 40.0)), "nothing touched it");
        assert!(world.centroid(low).unwrap().x > 33.0);
        assert_eq!([low, high].map(|id| world.view().organism(id).unwrap().tier()), [Some(0), Some(1)]);
        let wall = world.spawn(&RedCellSpec::default().into(), at(60.0, CollisionGroups::ALL)).unwrap();
        world.push(low, Vec2::new(20.0, 0.0)).unwrap();
        run(&mut world, 240);
        assert!(world.centroid(wall).unwrap().x > 60.1 && world.view().organism(wall).unwrap().tier().is_none());
    }

    #[test]
    fn user_data_are_kept_to_the_bit() {
        let mut world = room();
        let ball = agar(&mut world, 20.0, 45.0);
        let data = u128::MAX - (7 << 70);
        world.set_user_data(ball, data).unwrap();
        assert_eq!(world.clone().view().organism(ball).unwrap().user_data(), data);
        #[cfg(feature = "snapshot")]
        {
            let read = World::from_snapshot(&world.to_snapshot().unwrap()).unwrap();
            assert_eq!(read.view().organism(ball).unwrap().user_data(), data);
        }
        world.remove(ball).unwrap();
        assert_eq!(world.set_user_data(ball, 0).unwrap_err().field(), "organism");
    }

    #[test]
    fn a_cell_changes_its_speed_and_its_way_of_eating() {
        use crate::{Intent, PhagocytosisParams};
        let way = |speed: f32| {
            let mut world = World::new(WorldConfig::default()).unwrap();
            let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(40.0, 45.0)).unwrap();
            world.set_speed(cell, speed).unwrap();
            let inputs = Inputs::from(vec![(cell, Intent::toward(Vec2::new(150.0, 45.0)).unwrap())]);
            (0..90).for_each(|_| world.step(&inputs));
            world.centroid(cell).unwrap().x - 40.0
        };
        assert!(way(12.0) > 1.7 * way(6.0), "{} {}", way(12.0), way(6.0));
        let mut world = room();
        let ball = agar(&mut world, 20.0, 45.0);
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 45.0)).unwrap();
        let params = PhagocytosisParams { hold_time: 0.1, ..PhagocytosisParams::default() };
        world.set_phagocytosis(cell, params).unwrap();
        assert_eq!(world.view().organism(cell).unwrap().phagocytosis().unwrap().hold_time, 0.1);
        assert_eq!(world.set_phagocytosis(ball, params).unwrap_err().field(), "organism");
        let bad = PhagocytosisParams { hold_time: -1.0, ..params };
        assert_eq!(world.set_phagocytosis(cell, bad).unwrap_err().field(), "hold_time");
        assert_eq!(world.set_speed(cell, f32::NAN).unwrap_err().field(), "speed");
        world.remove(ball).unwrap();
        assert_eq!(world.set_speed(ball, 1.0).unwrap_err().field(), "organism");
    }

    #[test]
    fn fields_act_in_their_region_and_wake_who_is_there() {
        use crate::{FieldKind, ForceField, Region};
        let mut world = World::new(WorldConfig { damping: 0.0, ..WorldConfig::default() }).unwrap();
        let [inside, outside] = [20.0, 80.0].map(|x| agar(&mut world, x, 45.0));
        run(&mut world, 60);
        assert!(world.view().organism(inside).unwrap().is_at_rest());
        let region = Region::Circle { centre: Vec2::new(20.0, 45.0), radius: 15.0 };
        let wind = ForceField { region, kind: FieldKind::Uniform { acceleration: Vec2::new(6.0, 0.0) } };
        let field = world.add_field(wind.clone()).unwrap();
        run(&mut world, 60);
        let moved = [inside, outside].map(|id| world.view().organism(id).unwrap().velocity().x);
        assert!((moved[0] - 6.0).abs() < 0.06 && moved[1] == 0.0, "{moved:?}");
        assert_eq!(world.fields().collect::<Vec<_>>(), [(field, &wind)]);
        world.remove_field(field).unwrap();
        run(&mut world, 60);
        assert!((world.view().organism(inside).unwrap().velocity().x - 6.0).abs() < 0.06);
        assert_eq!(world.set_field(field, wind).unwrap_err().field(), "field");
    }
}
