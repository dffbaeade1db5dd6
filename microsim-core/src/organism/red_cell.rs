//! Red blood cell: a biconcave disc seen from above, soft but hard to stretch.
//!
//! ```text
//!       o - o - o        satellites: one ring, links that hardly stretch
//!     o           o      area: kept, so that it gives way on one side by bulging on the other
//!    o      +      o     + nothing: neither nucleus nor spokes
//!     o           o      chords over 3 satellites: soft; they round it off again (bending)
//!       o - o - o
//! ```
//!
//! The membrane of a real one resists a change of area about 10 000 times more than shear (Evans and Skalak 1980), which
//! is why it squeezes through anything without bursting.

use super::blueprint::Blueprint;
use super::spec::{Spec, SpecTable};
use crate::error::Error;
use crate::geometry::ring::{ellipse, touching_ring};
use crate::geometry::signed_area;
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{ImageLook, Look, Matter, OutlineLook, PaintedLook, Profile, RoundLook, Texture, WAVE};
use crate::particle::Material;
use crate::solver::constraint::{Area, Distance, MinDistance};
use crate::spec_field::FieldValue::{Count, Number};
use crate::spec_field::{FieldVisitor, check, field, required};
use crate::template::{Node, Role, Template};
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Satellites that a chord skips, and the share of its rest length that it never goes below: no fold in the ring.
const CHORD: usize = 3;
const FOLD_LIMIT: f32 = 0.55;

/// A red blood cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RedCellSpec {
    /// Radius at rest, units, 0.5 to 100. A human one: 3.75.
    pub radius: f32,
    /// Satellites in the ring, 12 to 64.
    pub satellites: u32,
    /// Mass of the whole cell, 0.01 to 100 000.
    pub mass: f32,
    /// Inverse stiffness of the chords (length/force), 0 to 10. Larger is limper.
    pub chord_compliance: f32,
    /// Damping time of the chords, s, 0 to 10: how slowly it springs back.
    pub chord_damping: f32,
    /// Inverse stiffness of the area, 0 to 1.
    pub area_compliance: f32,
}

impl Default for RedCellSpec {
    fn default() -> Self {
        Self {
            radius: 3.75,
            satellites: 24,
            mass: 6.0,
            chord_compliance: 2e-3,
            chord_damping: 0.05,
            area_compliance: 1e-4,
        }
    }
}

impl Spec for RedCellSpec {
    fn table(&self) -> SpecTable {
        SpecTable {
            name: "red_cell",
            words: "Soft rings that keep their area.",
            entry_words: "A red cell of this name.",
        }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(
            required("radius", "Radius at rest, micrometres; a human one has 3.75."),
            Number(&mut self.radius, [0.5, 100.0]),
        );
        visit(field("satellites", "Satellites in the ring."), Count(&mut self.satellites, [12, 64]));
        visit(field("mass", "Mass of the whole cell."), Number(&mut self.mass, [0.01, 1e5]));
        visit(
            field("chord_compliance", "Inverse stiffness of the chords: larger is limper."),
            Number(&mut self.chord_compliance, [0.0, 10.0]),
        );
        visit(
            field("chord_damping", "Damping time of the chords, s: how slowly it springs back."),
            Number(&mut self.chord_damping, [0.0, 10.0]),
        );
        visit(
            field("area_compliance", "Inverse stiffness of the area."),
            Number(&mut self.area_compliance, [0.0, 1.0]),
        );
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        Ok(Blueprint {
            template: Some(self.template()?),
            scale: self.radius,
            mass: self.mass,
            ..Blueprint::of(Kind::RedCell, std::f32::consts::PI * self.radius * self.radius)
        })
    }

    /// A biconcave disc full of haemoglobin.
    fn look(&self) -> Look {
        Look {
            image: ImageLook::Round(&RoundLook {
                profile: Profile::Biconcave { c0: [0.81, 1.75], c2: 7.83, c4: 4.39 },
                matter: Matter { phase: 0.033 * WAVE * 2.56, haemoglobin: 1.0, cytoplasm: 0.0, nucleus: 0.0 },
                variation: 0.12,
                texture: Texture { amount: 0.05, size: 0.9 },
                outline: OutlineLook {
                    median: 1.0,
                    size: 0.08,
                    waves: [0.055, 0.021],
                    decay: 2.0,
                    spread: 0.7,
                    ovals: 0.10,
                    tails: 0.04,
                    bites: 0.07,
                    spikes: [0, 0],
                },
                ..RoundLook::PLAIN
            }),
            drawn: DrawnLook {
                form: Form::RedCell,
                tint: Tint::hex([0xEBB3AC, 0xD07A73, 0x94413F, 0x94413F]),
                layer: 1,
            },
            painted: PaintedLook { body: Vec3::new(0.85, 0.5, 0.46), rim: Vec3::new(0.66, 0.24, 0.24), mottle: 0.06 },
        }
    }
}

impl RedCellSpec {
    /// The cell of outer radius 1 and mass 1.
    fn template(&self) -> Result<Template, Error> {
        let count = self.satellites as usize;
        let [ring_radius, satellite_radius] = touching_ring(count);
        let points = ellipse(Vec2::splat(ring_radius), count);
        // Slippery, as in plasma.
        let material = Material { friction: 0.02, restitution: 0.0 };
        let disc = |at| Node::disc(at, 1.0 / count as f32, satellite_radius);
        let mut builder = Template::builder();
        let node = |at| Node { role: Role::Membrane, material, ..disc(at) };
        let ring: Vec<u32> = points.iter().map(|&at| builder.node(node(at))).collect();
        builder.ring(&ring, 1e-6).outline(&ring);
        for (k, &a) in ring.iter().enumerate() {
            let (other, b) = (points[(k + CHORD) % count], ring[(k + CHORD) % count]);
            let rest_length = (other - points[k]).length();
            let (compliance, damping) = (self.chord_compliance, self.chord_damping);
            builder.constraint(Distance { a, b, rest_length, compliance, damping });
            builder.constraint(MinDistance { a, b, min_length: FOLD_LIMIT * rest_length });
        }
        let rest_area = signed_area(&points);
        builder.constraint(Area { ring, rest_area, compliance: self.area_compliance, is_upper_bound: false });
        builder.build()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Constraint, Inputs, Intent, Placement, ProbeSpec, World, WorldConfig};

    #[test]
    fn it_is_a_ring_with_an_area_and_nothing_in_the_middle() {
        let template = RedCellSpec::default().blueprint().unwrap().template.unwrap();
        assert_eq!((template.nodes().len(), template.outline().len()), (24, 24));
        let areas = template.constraints().iter().filter(|c| matches!(c, Constraint::Area(_)));
        assert_eq!(areas.count(), 1);
        assert!((template.extent() - 1.0).abs() < 1e-5);
        assert!((template.nodes().iter().map(|node| node.mass).sum::<f32>() - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_probe_dents_it_without_changing_its_area_and_it_rounds_off_again() {
        let mut world = World::new(WorldConfig { size: Vec2::new(40.0, 20.0), ..WorldConfig::default() }).unwrap();
        let cell = world.spawn(&RedCellSpec::default().into(), Placement::at(36.0, 10.0)).unwrap();
        let needle = ProbeSpec { radius: 1.5, mass: 60.0, speed: 5.0, max_acceleration: 400.0 };
        let needle = world.spawn(&needle.into(), Placement::at(25.0, 10.0)).unwrap();
        let outline = |world: &World| world.view().organism(cell).unwrap().outline().collect::<Vec<_>>();
        let slimness = |outline: &[Vec2]| {
            let centre = crate::geometry::centroid(outline).unwrap();
            let extent = |axis: fn(Vec2) -> f32| outline.iter().map(|&p| axis(p - centre).abs()).fold(0.0, f32::max);
            extent(|p| p.y) / extent(|p| p.x)
        };
        let (area, mut dented) = (signed_area(&outline(&world)), 1.0_f32);
        let mut push = Inputs::new();
        push.set(needle, Intent::toward(Vec2::new(33.0, 10.0)).unwrap());
        for _ in 0..180 {
            world.step(&push);
            let outline = outline(&world);
            dented = dented.max(slimness(&outline));
            assert!((signed_area(&outline) / area - 1.0).abs() < 0.05);
        }
        assert!(dented > 1.15, "{dented}: squeezed against the wall");
        let mut retreat = Inputs::new();
        retreat.set(needle, Intent::toward(Vec2::new(5.0, 10.0)).unwrap());
        (0..360).for_each(|_| world.step(&retreat));
        assert!((slimness(&outline(&world)) - 1.0).abs() < 0.06, "round again");
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let refuse = |spec: RedCellSpec, field: &str| assert_eq!(spec.blueprint().unwrap_err().field(), field);
        refuse(RedCellSpec { radius: 0.0, ..RedCellSpec::default() }, "radius");
        refuse(RedCellSpec { satellites: 4, ..RedCellSpec::default() }, "satellites");
        refuse(RedCellSpec { area_compliance: f32::NAN, ..RedCellSpec::default() }, "area_compliance");
    }
}
