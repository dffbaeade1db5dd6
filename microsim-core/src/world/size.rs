//! The size of the room, which may change while the world runs.

use super::World;
use super::change::WorldChange;
use crate::chemical::Chemical;
use crate::config::WorldConfig;
use crate::error::{Error, ErrorKind};
use crate::float_environment::with_default_float_environment;
use crate::organism::TOUCHING;
use crate::particle::CollisionGroups;
use glam::Vec2;

impl World {
    /// Sets the size of the room, see [`WorldConfig::size`]: its upper and its right side move at once, and push nothing. Wakes
    /// everything. What is new of the room holds chemicals in the concentration that they began with, and what is cut off is lost
    /// with its content; their grids are laid out anew, which smooths them a little.
    ///
    /// To press things together, move obstacles ([`World::move_obstacle`]), then make the room as small as what they enclose.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, Placement, World, WorldConfig, glam::Vec2};
    /// # let mut world = World::new(WorldConfig::default())?;
    /// let ball = world.spawn(&AgarSpec::default().into(), Placement::at(100.0, 30.0))?;
    /// assert_eq!(world.set_size(Vec2::new(80.0, 90.0)).unwrap_err().field(), "size");
    /// world.set_size(Vec2::new(101.0, 200.0))?;
    /// world.spawn(&AgarSpec::default().into(), Placement::at(50.0, 190.0))?;
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// When a side is not finite or out of its range, when the length between periodic sides would change, when something lies outside of the new walls, or beyond an open side farther than
    /// the new room is large, and when a chemical would have too many cells or spread too fast for them. Nothing is changed then.
    pub fn set_size(&mut self, size: Vec2) -> Result<(), Error> {
        with_default_float_environment(|| self.resize(size))?;
        self.changed(|| WorldChange::SetSize(size));
        Ok(())
    }

    fn resize(&mut self, size: Vec2) -> Result<(), Error> {
        let config = WorldConfig { size, ..self.config.clone() };
        config.validate()?;
        for (axis, field) in ["size.x", "size.y"].into_iter().enumerate() {
            if self.period().0[axis] > 0.0 && size[axis] != self.config.size[axis] {
                return Err(Error::unsupported(field, "a length that stays as it is between periodic sides"));
            }
        }
        self.check_room(&config)?;
        self.chemicals = self.resized_chemicals(&config)?;
        self.config = config;
        self.rebuild_walls();
        self.open_chemicals();
        self.sleep.wake_all();
        self.scratch.occupancy.clear();
        self.scratch.query_index.clear_obstacles();
        Ok(())
    }

    /// Checks that everything is inside of the walls of other settings, and nothing is farther beyond open sides than they allow.
    fn check_room(&self, config: &WorldConfig) -> Result<(), Error> {
        let ([_, wall], [low, high]) = (config.walls(), config.particle_bounds());
        let p = &self.particles;
        let lies_outside = |i: usize| {
            let (at, meets_walls) = (p.position(i), p.groups[i].meets(CollisionGroups::ALL));
            let inner = at + p.radius[i] * (1.0 - TOUCHING);
            let is_beyond = |axis: usize| inner[axis] > wall[axis] && config.size[axis] < self.config.size[axis];
            meets_walls && (is_beyond(0) || is_beyond(1)) || at.cmplt(low).any() || at.cmpgt(high).any()
        };
        let Some(outside) = p.live().find(|&i| lies_outside(i)) else { return Ok(()) };
        let owner = self.organisms.id_at(p.owner[outside]).and_then(|id| self.with_its_place(id));
        let accepted = format!("a room that holds {}", owner.unwrap_or_else(|| "everything".to_owned()));
        Err(Error::new(ErrorKind::OutsideWorld { accepted }, "size"))
    }

    fn resized_chemicals(&self, config: &WorldConfig) -> Result<Vec<Chemical>, Error> {
        let (mut resized, mut cells) = (Vec::new(), 0);
        for (k, chemical) in self.chemicals.iter().enumerate() {
            let within = |error: Error| error.within(&format!("chemicals[{k}]"));
            cells += chemical.spec().cells_beside(cells, config).map_err(within)?;
            resized.push(chemical.resized(config).map_err(within)?);
        }
        Ok(resized)
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        AgarSpec, AmoeboidCellSpec, ChemicalSpec, Controller, Inputs, Obstacle, OrganismSpec, Placement, QueryFilter,
        Wall, World, WorldConfig,
    };
    use crate::{Collider, CollisionGroups, Exchange};
    use glam::Vec2;
    use parry2d::math::Pose;
    use parry2d::shape::SharedShape;

    fn run(world: &mut World, steps: u32) {
        for _ in 0..steps {
            world.step(&Inputs::new());
            world.validate().unwrap();
        }
    }

    #[test]
    fn walls_stand_where_the_new_size_says_and_what_slept_wakes() {
        let config =
            WorldConfig { gravity: Vec2::new(10.0, 0.0), damping: 0.1, max_speed: 60.0, ..WorldConfig::default() };
        let mut world = World::new(config).unwrap();
        let ball = world.spawn(&AgarSpec::default().into(), Placement::at(158.0, 40.0)).unwrap();
        run(&mut world, 240);
        assert!(world.view().organism(ball).unwrap().is_at_rest());
        world.set_size(Vec2::new(200.0, 60.0)).unwrap();
        run(&mut world, 400);
        assert!((world.centroid(ball).unwrap().x - 199.0).abs() < 0.05, "it rolls on to the new wall");
        let hit = world.queries().cast_ray(Vec2::new(30.0, 30.0), Vec2::Y, 500.0, &QueryFilter::surfaces()).unwrap();
        assert_eq!((hit.collider, hit.distance), (Collider::Wall(Wall::Top), 30.0));
        assert_eq!(world.config().size, Vec2::new(200.0, 60.0));
    }

    #[test]
    fn a_room_too_small_is_refused_and_changes_nothing() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(100.0, 40.0)).unwrap();
        run(&mut world, 2);
        let before = world.digest();
        for (size, field) in
            [([90.0, 90.0], "size"), ([160.0, 41.0], "size"), ([f32::NAN, 90.0], "size.x"), ([160.0, 0.5], "size.y")]
        {
            let refused = world.set_size(size.into()).unwrap_err();
            assert_eq!((refused.field(), world.digest()), (field, before), "{refused}");
        }
        assert!(world.set_size(Vec2::new(90.0, 90.0)).unwrap_err().to_string().contains("amoeboid_cell at [100"));
        let (_, high) = world.view().organism(cell).unwrap().bounds();
        world.set_size(high).unwrap();
        run(&mut world, 60);
        assert_eq!(world.census().leaks, 0);
    }

    #[test]
    fn what_meets_no_wall_may_lie_outside_but_not_too_far() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let ball = OrganismSpec::from(AgarSpec::default());
        let ghost = world.spawn(&ball, Placement::at(150.0, 40.0).in_groups(CollisionGroups::NONE)).unwrap();
        world.set_size(Vec2::new(80.0, 90.0)).unwrap();
        run(&mut world, 10);
        assert_eq!(world.set_size(Vec2::new(70.0, 90.0)).unwrap_err().field(), "size");
        world.remove(ghost).unwrap();
        world.set_size(Vec2::new(70.0, 90.0)).unwrap();
    }

    #[test]
    fn chemicals_keep_their_content_and_grow_with_the_room() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let chemical = world.add_chemical(ChemicalSpec { decay: 0.0, ..ChemicalSpec::default() }).unwrap();
        let bar = Obstacle::new(SharedShape::cuboid(4.0, 4.0), Pose::translation(120.0, 60.0));
        world.add_obstacle(bar).unwrap();
        let ball = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0)).unwrap();
        world.set_exchange(ball, Exchange { chemical, secretion: 100.0, uptake: 0.0 }).unwrap();
        run(&mut world, 60);
        let amount = |world: &World| world.view().chemicals().next().unwrap().1.amount();
        let at = |world: &World| world.view().chemicals().next().unwrap().1.concentration(Vec2::new(33.0, 30.0));
        let before = (amount(&world), at(&world));
        for size in [[201.3, 133.0], [150.0, 80.0], [160.0, 90.0]] {
            world.set_size(size.into()).unwrap();
            world.validate().unwrap();
            assert!((amount(&world) / before.0 - 1.0).abs() < 1e-3, "{} after {}", amount(&world), before.0);
        }
        assert!((at(&world) / before.1 - 1.0).abs() < 0.1, "{} after {}", at(&world), before.1);
        run(&mut world, 10);
        let fine = ChemicalSpec { spacing: 0.2, diffusion: 1.0, ..ChemicalSpec::default() };
        world.add_chemical(fine).unwrap();
        assert_eq!(world.set_size(Vec2::new(1000.0, 400.0)).unwrap_err().field(), "chemicals[1].spacing");
    }

    #[test]
    fn who_wanders_stays_in_the_new_room() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let wander = Controller::wander([0.2, 0.5], 0.0);
        let cell = AmoeboidCellSpec { radii: Vec2::splat(6.0), ..AmoeboidCellSpec::default() };
        world.spawn(&cell.into(), Placement::at(20.0, 20.0).steered_by(wander)).unwrap();
        run(&mut world, 30);
        world.set_size(Vec2::new(60.0, 60.0)).unwrap();
        run(&mut world, 200);
        assert_eq!(world.census().leaks, 0);
    }
}
