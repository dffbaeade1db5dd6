//! Mechanics of an organism as a whole: mass, velocity, angle.

use super::OrganismView;
use crate::id::TemplateId;
use crate::organism::Storage;
use crate::particle::mass_properties::MassProperties;
use glam::Vec2;

impl<'a> OrganismView<'a> {
    /// Mass of what can move of it, fluid included.
    #[must_use]
    pub fn mass(self) -> f32 {
        self.properties().map_or(0.0, |(_, properties)| properties.mass)
    }

    /// Velocity of its centre of mass, units/s.
    #[must_use]
    pub fn velocity(self) -> Vec2 {
        self.properties().map_or(Vec2::ZERO, |(_, properties)| properties.velocity)
    }

    /// Centre of mass of what can move of it, units; its centroid if nothing can.
    #[must_use]
    pub fn centre_of_mass(self) -> Vec2 {
        let particles = &self.view.world.particles;
        self.properties().map_or_else(|| self.centroid(), |(_, properties)| properties.position(particles))
    }

    /// Angular velocity about its centre of mass, radians/s counter-clockwise; 0 for a single disc.
    #[must_use]
    pub fn angular_velocity(self) -> f32 {
        let particles = &self.view.world.particles;
        self.properties().map_or(0.0, |(list, properties)| properties.angular_velocity(particles, &list))
    }

    /// The angle by which it is turned from its template's frame, radians counter-clockwise within ±pi: the rotation that fits
    /// its nodes best. `None` for a single disc, and for what has no template.
    #[must_use]
    pub fn angle(self) -> Option<f32> {
        let world = self.view.world;
        let template = &world.templates[self.template()?.0 as usize];
        let (list, now) = self.properties()?;
        let places = template.nodes().iter().map(|node| node.position);
        let rotation = now.rotation(&world.particles, &list, places);
        (rotation != Vec2::ZERO).then(|| libm::atan2f(rotation.y, rotation.x))
    }

    /// The template of its body; `None` for membranes and for fluid on its own.
    #[must_use]
    pub fn template(self) -> Option<TemplateId> {
        match self.organism.body {
            Storage::Lane { block, .. } => Some(TemplateId(self.view.world.blocks[block as usize].template)),
            Storage::Loose { .. } => None,
        }
    }

    /// The name of its template; `None` if it has none.
    #[must_use]
    pub fn template_name(self) -> Option<&'a str> {
        let template = self.view.world.template(self.template()?)?;
        Some(template.name()).filter(|name| !name.is_empty())
    }

    fn properties(self) -> Option<(Vec<u32>, MassProperties)> {
        let list: Vec<u32> = self.organism.particles().collect();
        MassProperties::of(&self.view.world.particles, &list).map(|properties| (list, properties))
    }
}
