//! Force fields of a world, and whom they keep awake.

use super::World;
use super::change::WorldChange;
use crate::error::Error;
use crate::force_field::{FieldKind, ForceField};
use crate::id::FieldId;
use crate::organism::Storage;
use crate::particle::mass_properties::MassProperties;
use crate::rng::Rng;
use glam::Vec2;
use std::f32::consts::PI;

/// Odd factor that spreads the number of a step over 64 bits.
const SCRAMBLE: u64 = 0x9e37_79b9_7f4a_7c15;

impl World {
    /// Adds a force field. It acts on every particle in its region, beside gravity; bodies in it stay awake.
    ///
    /// ```
    /// # use microsim_core::{AgarSpec, FieldKind, ForceField, Inputs, Placement, Region, World, WorldConfig, glam::Vec2};
    /// # let mut world = World::new(WorldConfig::default())?;
    /// let ball = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
    /// let region = Region::Circle { centre: Vec2::new(30.0, 30.0), radius: 10.0 };
    /// let wind = world.add_field(ForceField { region, kind: FieldKind::Uniform { acceleration: Vec2::new(9.0, 0.0) } })?;
    /// (0..60).for_each(|_| world.step(&Inputs::new()));
    /// assert!(world.centroid(ball).unwrap().x > 33.0);
    /// world.remove_field(wind)?;
    /// # Ok::<(), microsim_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Names the number that is out of its range.
    pub fn add_field(&mut self, field: ForceField) -> Result<FieldId, Error> {
        field.validate()?;
        let id = FieldId::of(self.fields.insert(Box::new(field)));
        self.changed(|| WorldChange::AddField(field));
        Ok(id)
    }

    /// Replaces a force field by another one, under the same handle.
    ///
    /// # Errors
    /// Names the number that is out of its range, and a handle that is stale.
    pub fn set_field(&mut self, id: FieldId, field: ForceField) -> Result<(), Error> {
        field.validate()?;
        **self.fields.get_mut(id.handle()).ok_or_else(|| Error::stale("field"))? = field;
        self.changed(|| WorldChange::SetField(id, field));
        Ok(())
    }

    /// Removes a force field.
    ///
    /// # Errors
    /// When the handle is stale.
    pub fn remove_field(&mut self, id: FieldId) -> Result<(), Error> {
        self.fields.remove(id.handle()).ok_or_else(|| Error::stale("field"))?;
        self.changed(|| WorldChange::RemoveField(id));
        Ok(())
    }

    /// All force fields, in a stable order.
    pub fn fields(&self) -> impl Iterator<Item = (FieldId, &ForceField)> {
        self.fields.iter().map(|(handle, field)| (FieldId::of(handle), &**field))
    }

    /// Acceleration by all force fields at a point, without gravity, units/s2.
    #[must_use]
    pub fn field_at(&self, point: Vec2) -> Vec2 {
        self.fields.iter().map(|(_, field)| field.acceleration_at(point)).sum()
    }

    /// Wakes the bodies on which a field acts.
    pub(crate) fn wake_up_in_fields(&mut self) {
        if self.fields.is_empty() {
            return;
        }
        for index in 0..self.blocks.len() {
            let (block, steps) = (&self.blocks[index], self.config.steps_to_sleep());
            let is_in_field = |lane| {
                (0..block.slots).any(|slot| {
                    let i = block.particle(slot, lane) as usize;
                    let acts_at = |at| self.field_at(at) != Vec2::ZERO || self.mobility_at(at) > 0.0;
                    self.particles.inv_mass[i] > 0.0 && acts_at(self.particles.position(i))
                })
            };
            if self.sleep.is_at_rest(index as u32, steps)
                && let Some(lane) = (0..block.owner.len()).find(|&lane| is_in_field(lane))
            {
                self.sleep.wake_up(index as u32, lane);
            }
        }
    }

    /// Kicks the bodies in thermal fields, once per step. A kick `v` moves a body by `v (1 + g h) / g` in all, with a damping of
    /// `g`, its own included, and substeps of `h`; its variance is such that the kicks of a second add up to `2 D` along each axis.
    pub(crate) fn kick_bodies(&mut self) {
        if !self.fields.iter().any(|(_, field)| matches!(field.kind, FieldKind::Thermal { .. })) {
            return;
        }
        let Self { config, fields, organisms, particles, sleep, step_index, .. } = self;
        let step = u64::wrapping_mul(*step_index + 1, SCRAMBLE);
        let (g, h) = (config.damping, config.substep());
        // Of a body whose own damping comes before that of the medium in each substep.
        let kick_by = |own: f32| (g + own + g * own * h) * (2.0 * config.dt).sqrt() / (1.0 + g * h);
        for (id, organism) in organisms.iter() {
            let sleeps = matches!(organism.body, Storage::Lane { block, .. } if sleep.is_asleep(block));
            if sleeps || organism.slots == 0 || organism.goal.is_some() || organism.is_held() || organism.is_quarantined
            {
                continue;
            }
            let list: Vec<u32> = organism.particles().collect();
            let Some(body) = MassProperties::of(particles, &list) else { continue };
            let at = body.position(particles);
            let mobility: f32 = fields.iter().map(|(_, field)| field.mobility_at(at)).sum();
            let radius = (organism.full_area().abs() / PI).sqrt();
            if mobility <= 0.0 || radius <= 0.0 {
                continue;
            }
            let root = (mobility / radius).sqrt();
            let [kick, spin] = [organism.linear_damping, organism.angular_damping].map(|own| kick_by(own) * root);
            let mut rng = Rng::new(config.seed ^ step, id.thermal_stream());
            let velocity = Vec2::new(rng.normal(), rng.normal()) * kick;
            let turn = 0.75_f32.sqrt() * spin * rng.normal() / radius;
            for i in list.into_iter().map(|i| i as usize).filter(|&i| particles.inv_mass[i] > 0.0) {
                let change = velocity + body.arm(particles, i).perp() * turn;
                particles.vx[i] += change.x;
                particles.vy[i] += change.y;
            }
        }
    }

    /// Mobility by all thermal fields at a point.
    fn mobility_at(&self, point: Vec2) -> f32 {
        self.fields.iter().map(|(_, field)| field.mobility_at(point)).sum()
    }

    /// Accelerates what is in fields for a substep of `h` seconds.
    pub(crate) fn apply_fields(&mut self, h: f32) {
        if self.fields.iter().all(|(_, field)| matches!(field.kind, FieldKind::Thermal { .. })) {
            return;
        }
        for i in 0..self.particles.len() {
            if self.particles.inv_mass[i] > 0.0 {
                let change = self.field_at(self.particles.position(i)) * h;
                self.particles.vx[i] += change.x;
                self.particles.vy[i] += change.y;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        AgarSpec, FieldKind, ForceField, Inputs, Node, OrganismId, Placement, RedCellSpec, Region, Template, World,
        WorldConfig,
    };
    use glam::Vec2;

    /// Many balls that do not collide, one of them a red cell, in a warm room.
    fn warm(mobility: f32, damping: f32) -> (World, Vec<OrganismId>) {
        let size = Vec2::splat(400.0);
        let mut world = World::new(WorldConfig { size, damping, ..WorldConfig::default() }).unwrap();
        let kind = FieldKind::Thermal { mobility };
        world.add_field(ForceField { region: Region::All, kind }).unwrap();
        let place = |k: u32| Placement::at(20.0 + 9.0 * (k % 40) as f32, 20.0 + 9.0 * (k / 40) as f32);
        let ball = AgarSpec { radius: 0.5, ..AgarSpec::default() };
        let balls = (0..1500).map(|k| world.spawn(&ball.clone().into(), place(k)).unwrap()).collect();
        (world, balls)
    }

    #[test]
    fn bodies_diffuse_by_their_radius_once_drag_has_acted() {
        let (mut world, balls) = warm(0.1, 4.0);
        let start: Vec<Vec2> = balls.iter().map(|&id| world.centroid(id).unwrap()).collect();
        let time = 6.0;
        (0..360).for_each(|_| world.step(&Inputs::new()));
        let squares = balls.iter().zip(&start).map(|(&id, &at)| (world.centroid(id).unwrap() - at).length_squared());
        let measured = squares.sum::<f32>() / balls.len() as f32;
        // Of an Ornstein-Uhlenbeck walk from rest: 4 D (t - (3 - 4 e + e^2) / 2 g) with e = exp(-g t).
        let expected = 4.0 * (0.1 / 0.5) * (time - 1.5 / 4.0);
        assert!((measured / expected - 1.0).abs() < 0.06, "{measured} instead of {expected}");
    }

    #[test]
    fn kicks_hang_on_the_step_alone_and_nothing_without_drag_is_kicked() {
        let (mut world, balls) = warm(0.1, 0.0);
        let before = world.centroid(balls[0]);
        (0..30).for_each(|_| world.step(&Inputs::new()));
        assert_eq!(world.centroid(balls[0]), before);
        let mut cell = World::new(WorldConfig { damping: 3.0, ..WorldConfig::default() }).unwrap();
        cell.add_field(ForceField { region: Region::All, kind: FieldKind::Thermal { mobility: 0.2 } }).unwrap();
        let id = cell.spawn(&RedCellSpec::default().into(), Placement::at(40.0, 40.0)).unwrap();
        (0..120).for_each(|_| cell.step(&Inputs::new()));
        assert!(!cell.view().organism(id).unwrap().is_at_rest());
        let mut twin = cell.clone();
        (0..60).for_each(|_| [&mut cell, &mut twin].into_iter().for_each(|world| world.step(&Inputs::new())));
        assert_eq!(cell.digest(), twin.digest());
    }

    #[test]
    fn a_sleeper_around_a_thermal_region_is_not_kicked() {
        let mut builder = Template::builder();
        let [a, b] = [-4.0, 4.0].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 0.5)));
        // Wound clockwise, so that its area is negative.
        let c = builder.node(Node::disc(Vec2::new(0.0, 6.0), 1.0, 0.5));
        builder.link(a, b, 0.0).link(b, c, 0.0).link(c, a, 0.0).outline(&[a, c, b]);
        let template = builder.build().unwrap();
        let at_rest = |region: Region| {
            let mut world = World::new(WorldConfig { damping: 3.0, ..WorldConfig::default() }).unwrap();
            let template = world.add_template(template.clone());
            let body = world.spawn_template(template, Placement::at(40.0, 40.0)).unwrap();
            (0..120).for_each(|_| world.step(&Inputs::new()));
            world.add_field(ForceField { region, kind: FieldKind::Thermal { mobility: 5.0 } }).unwrap();
            (0..10).for_each(|_| world.step(&Inputs::new()));
            world.validate().unwrap();
            let body = world.view().organism(body).unwrap();
            (body.velocity() == Vec2::ZERO, body.is_quarantined())
        };
        let middle = Region::Circle { centre: Vec2::new(40.0, 42.0), radius: 0.5 };
        assert_eq!([middle, Region::All].map(at_rest), [(true, false), (false, false)]);
    }
}
