//! Force fields of a world, and whom they keep awake.

use super::World;
use super::change::WorldChange;
use crate::error::Error;
use crate::force_field::{FieldKind, ForceField};
use crate::id::FieldId;
use glam::Vec2;

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
    /// Names the number that is out of its range; in a thermal field for some body here, see [`FieldKind::Thermal`].
    pub fn add_field(&mut self, field: ForceField) -> Result<FieldId, Error> {
        field.validate()?;
        self.check_field(None, &field)?;
        let id = FieldId::of(self.fields.insert(Box::new(field.clone())));
        self.changed(|| WorldChange::AddField(field));
        Ok(id)
    }

    /// Replaces a force field by another one, under the same handle.
    ///
    /// # Errors
    /// As for [`World::add_field`], and when the handle is stale.
    pub fn set_field(&mut self, id: FieldId, field: ForceField) -> Result<(), Error> {
        field.validate()?;
        self.check_field(Some(id), &field)?;
        (**self.fields.get_mut(id.handle()).ok_or_else(|| Error::stale("field"))?).clone_from(&field);
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

    /// Acceleration by all force fields at a point, without gravity, units/s2. Beyond a periodic side it is that at the image in the
    /// room.
    #[must_use]
    pub fn field_at(&self, point: Vec2) -> Vec2 {
        let point = self.in_room(point);
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
    use super::*;
    use crate::{AgarSpec, Placement, Region, WorldConfig};

    #[test]
    fn a_field_accelerates_what_can_move_and_nothing_else() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        world.spawn(&AgarSpec::default().into(), Placement::at(40.0, 45.0)).unwrap();
        let kind = FieldKind::Uniform { acceleration: Vec2::new(8.0, 0.0) };
        world.add_field(ForceField { region: Region::All, kind }).unwrap();
        world.apply_fields(0.25);
        let velocity = |inv_mass: f32| if inv_mass > 0.0 { Vec2::new(2.0, 0.0) } else { Vec2::ZERO };
        let p = &world.particles;
        assert!(p.len() > 1, "empty lanes of its block");
        assert!((0..p.len()).all(|i| p.velocity(i) == velocity(p.inv_mass[i])));
    }
}
