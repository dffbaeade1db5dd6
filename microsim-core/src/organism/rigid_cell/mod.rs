//! Rigid cell (thesis, 3.1.1): a soft body in one or two layers that keeps its shape, like a paramecium.
//!
//! ```text
//!      o---o---o        outer ring: rigid links, evenly spaced on an ellipse; one of its bodies is the front
//!     /|\ /|\ /|        respective bodies linked, and crosswise i <-> i+1
//!    o-+-o-+-o-+-o      inner ring, made the same way
//!     \  springs  /
//!          N            nucleus: more massive than all satellites together; springs to the innermost ring
//! ```

mod paramecium;

use super::blueprint::Blueprint;
use super::spec::{Spec, SpecTable};
use crate::capability::Locomotion;
use crate::capability::phagocytosis::PreyClass;
use crate::error::{Error, in_range};
use crate::geometry::ring::ellipse;
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{ImageLook, Look, PaintedLook};
use crate::solver::constraint::MinDistance;
use crate::spec_field::FieldValue::{Count, Number, Vector};
use crate::spec_field::{FieldVisitor, check, field, required};
use crate::template::{Node, Role, Template, TemplateBuilder};
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Nucleus mass over the mass of all satellites (thesis: "most of the mass").
const NUCLEUS_SHARE: f32 = 1.5;
/// Distance of the two layers, in satellite radii.
const LAYER_DISTANCE: f32 = 2.4;
/// Inverse stiffness of the links between the layers: a little give, so that the outline deforms slightly under load.
const LAYER_COMPLIANCE: f32 = 1e-6;

/// A soft body that keeps its shape.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RigidCellSpec {
    /// Semi-axes, units, 0.5 to 200 each, at most 1 : 8. It faces along the first.
    pub radii: Vec2,
    /// Satellites in each ring, 8 to 128, even: every body has an opposite.
    pub satellites: u32,
    /// Rings, 1 or 2. Two keep the nucleus in under loads that one does not stand.
    pub layers: u32,
    /// Inverse stiffness of the springs to the nucleus (length/force), 0 to 1.
    pub spring_compliance: f32,
    /// Damping time of these springs, s, 0 to 10.
    pub spring_damping: f32,
    /// Speed of its front when it moves, units/s, 0 to 1000.
    pub speed: f32,
}

impl Default for RigidCellSpec {
    fn default() -> Self {
        Self {
            radii: Vec2::new(7.0, 4.0),
            satellites: 28,
            layers: 2,
            spring_compliance: 1e-4,
            spring_damping: 0.02,
            speed: 8.0,
        }
    }
}

impl Spec for RigidCellSpec {
    fn table(&self) -> SpecTable {
        SpecTable {
            name: "rigid_cell",
            words: "Soft bodies of a fixed shape, such as paramecia.",
            entry_words: "A rigid cell of this name.",
        }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(
            required("radii", "Semi-axes, micrometres; it faces along the first."),
            Vector(&mut self.radii, [0.5, 200.0]),
        );
        visit(field("satellites", "Satellites in each ring, an even number."), Count(&mut self.satellites, [8, 128]));
        visit(field("layers", "Rings, 1 or 2."), Count(&mut self.layers, [1, 2]));
        visit(
            field("spring_compliance", "Inverse stiffness of the springs to the nucleus."),
            Number(&mut self.spring_compliance, [0.0, 1.0]),
        );
        visit(
            field("spring_damping", "Damping time of these springs, s."),
            Number(&mut self.spring_damping, [0.0, 10.0]),
        );
        visit(
            field("speed", "Speed of its front when it moves, micrometres/s."),
            Number(&mut self.speed, [0.0, 1000.0]),
        );
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        in_range("radii.y", self.radii.y, self.radii.x / 8.0, self.radii.x * 8.0)?;
        if !self.satellites.is_multiple_of(2) {
            return Err(Error::unsupported("satellites", "an even number"));
        }
        Ok(Blueprint {
            template: Some(self.template()?),
            scale: self.radii.x,
            locomotion: Locomotion::FrontPull { front: 0 },
            speed: self.speed,
            prey: Some(PreyClass::Soft),
            ..Blueprint::of(Kind::RigidCell, std::f32::consts::PI * self.radii.x * self.radii.y)
        })
    }

    fn look(&self) -> Look {
        Look {
            image: ImageLook::Round(&paramecium::LOOK),
            drawn: DrawnLook {
                form: Form::Ciliate,
                tint: Tint::hex([0xDDE5B8, 0xB4C27C, 0x66763A, 0x59692F]),
                layer: 4,
            },
            painted: PaintedLook { body: Vec3::new(0.8, 0.72, 0.44), rim: Vec3::new(0.45, 0.36, 0.18), mottle: 0.22 },
        }
    }
}

impl RigidCellSpec {
    /// The cell of first semi-axis 1.
    fn template(&self) -> Result<Template, Error> {
        let mut builder = Template::builder();
        let mut layer = Layer::outermost(self.radii / self.radii.x, self.satellites as usize);
        let mut ring = layer.add(&mut builder, Role::Membrane);
        builder.outline(&ring);
        if self.layers == 2 {
            layer = layer.inner();
            let inner = layer.add(&mut builder, Role::InnerRing);
            link_layers(&mut builder, &ring, &inner);
            ring = inner;
        }
        self.add_nucleus(&mut builder, &ring, &layer);
        builder.build()
    }

    fn add_nucleus(&self, builder: &mut TemplateBuilder, innermost: &[u32], layer: &Layer) {
        let satellites = (self.satellites * self.layers) as f32;
        let room = smaller(layer.radii.x, layer.radii.y);
        let radius = 0.45 * room;
        let nucleus = Node { role: Role::Nucleus, ..Node::disc(Vec2::ZERO, NUCLEUS_SHARE * satellites, radius) };
        let nucleus = builder.node(nucleus);
        let min_length = smaller(radius + layer.satellite_radius, 0.9 * room);
        for &a in innermost {
            builder.spring(a, nucleus, self.spring_compliance, self.spring_damping);
            builder.constraint(MinDistance { a, b: nucleus, min_length });
        }
    }
}

/// One ring of satellites on an ellipse.
struct Layer {
    /// Semi-axes of the satellites' centres.
    radii: Vec2,
    /// Half their distance, so that neighbours touch; less in a cell too slender for that.
    satellite_radius: f32,
    count: usize,
}

impl Layer {
    fn new(radii: Vec2, count: usize) -> Self {
        let points = ellipse(radii, count);
        let half_distance = 0.5 * (points[1] - points[0]).length();
        Self { radii, satellite_radius: smaller(half_distance, 0.3 * smaller(radii.x, radii.y)), count }
    }

    /// The ring whose discs reach out to an ellipse.
    fn outermost(reach: Vec2, count: usize) -> Self {
        Self::new(reach - Vec2::splat(Self::new(reach, count).satellite_radius), count)
    }

    /// The ring one layer further in.
    fn inner(&self) -> Self {
        let thickness = smaller(LAYER_DISTANCE * self.satellite_radius, 0.4 * smaller(self.radii.x, self.radii.y));
        Self::new(self.radii - Vec2::splat(thickness), self.count)
    }

    /// Adds its satellites and the rigid links between neighbours.
    fn add(&self, builder: &mut TemplateBuilder, role: Role) -> Vec<u32> {
        let satellite = |position| Node { role, ..Node::disc(position, 1.0, self.satellite_radius) };
        let ring: Vec<u32> =
            ellipse(self.radii, self.count).into_iter().map(|position| builder.node(satellite(position))).collect();
        builder.ring(&ring, 0.0);
        ring
    }
}

/// Binds respective bodies of two rings, and crosswise their neighbours.
fn link_layers(builder: &mut TemplateBuilder, outer: &[u32], inner: &[u32]) {
    let count = outer.len();
    for k in 0..count {
        let next = (k + 1) % count;
        builder.link(outer[k], inner[k], LAYER_COMPLIANCE);
        builder.link(outer[k], inner[next], LAYER_COMPLIANCE);
        builder.link(inner[k], outer[next], LAYER_COMPLIANCE);
    }
}

fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::polygon::signed_area;
    use crate::solver::constraint::{Constraint, Distance};

    fn template(layers: u32) -> Template {
        RigidCellSpec { layers, ..RigidCellSpec::default() }.blueprint().unwrap().template.unwrap()
    }

    fn slots(template: &Template, role: Role) -> Vec<u32> {
        let nodes = template.nodes().iter().enumerate();
        nodes.filter(|(_, node)| node.role == role).map(|(slot, _)| slot as u32).collect()
    }

    fn distances(template: &Template) -> impl Iterator<Item = &Distance> {
        template.constraints().iter().filter_map(|constraint| match constraint {
            Constraint::Distance(distance) => Some(distance),
            _ => None,
        })
    }

    fn has_link(template: &Template, a: u32, b: u32) -> bool {
        distances(template).any(|c| (c.a, c.b) == (a, b) || (c.b, c.a) == (a, b))
    }

    #[test]
    fn t05_nucleus_holds_most_of_the_mass() {
        for layers in [1, 2] {
            let template = template(layers);
            let nucleus = template.nodes()[slots(&template, Role::Nucleus)[0] as usize];
            let total: f32 = template.nodes().iter().map(|node| node.mass).sum();
            assert!(nucleus.mass > total - nucleus.mass && nucleus.position == Vec2::ZERO);
        }
    }

    #[test]
    fn t06_satellites_are_alike_and_evenly_spaced_on_the_ellipse() {
        let template = template(1);
        let ring: Vec<Vec2> = template.outline().iter().map(|&s| template.nodes()[s as usize].position).collect();
        let radii = ring.iter().fold(Vec2::ZERO, |far, p| far.max(p.abs()));
        let gaps: Vec<f32> = (0..ring.len()).map(|k| (ring[(k + 1) % ring.len()] - ring[k]).length()).collect();
        let mean = gaps.iter().sum::<f32>() / gaps.len() as f32;
        assert!(gaps.iter().all(|gap| (gap / mean - 1.0).abs() < 0.03), "{gaps:?}");
        assert!(ring.iter().all(|p| ((*p / radii).length() - 1.0).abs() < 0.02) && signed_area(&ring) > 0.0);
        let radius = template.nodes()[0].radius;
        assert!(template.outline().iter().all(|&s| template.nodes()[s as usize].radius == radius));
    }

    #[test]
    fn t07_nucleus_links_are_damped_springs() {
        let template = template(1);
        let nucleus = slots(&template, Role::Nucleus)[0];
        let springs: Vec<_> = distances(&template).filter(|c| c.b == nucleus).collect();
        assert_eq!(springs.len(), 28);
        assert!(springs.iter().all(|c| c.compliance > 0.0 && c.damping > 0.0));
    }

    #[test]
    fn t08_neighbours_are_linked_rigidly_in_a_closed_ring() {
        let template = template(2);
        for ring in [slots(&template, Role::Membrane), slots(&template, Role::InnerRing)] {
            let within =
                distances(&template).filter(|c| ring.contains(&c.a) && ring.contains(&c.b)).collect::<Vec<_>>();
            assert_eq!(within.len(), ring.len(), "as many links as satellites");
            assert!(within.iter().all(|c| c.compliance == 0.0));
            assert!((0..ring.len()).all(|k| has_link(&template, ring[k], ring[(k + 1) % ring.len()])));
        }
    }

    #[test]
    fn t09_layers_are_linked_respectively_and_crosswise() {
        let template = template(2);
        let (outer, inner) = (slots(&template, Role::Membrane), slots(&template, Role::InnerRing));
        assert_eq!(outer.len(), inner.len());
        for k in 0..outer.len() {
            let next = (k + 1) % outer.len();
            assert!(has_link(&template, outer[k], inner[k]));
            assert!(has_link(&template, outer[k], inner[next]) && has_link(&template, inner[k], outer[next]));
        }
    }

    #[test]
    fn odd_shapes_and_bad_numbers_are_refused_by_name() {
        let refuse = |spec: RigidCellSpec, field: &str| assert_eq!(spec.blueprint().unwrap_err().field(), field);
        let spec = RigidCellSpec::default;
        refuse(RigidCellSpec { radii: Vec2::new(f32::NAN, 1.0), ..spec() }, "radii.x");
        refuse(RigidCellSpec { radii: Vec2::new(50.0, 1.0), ..spec() }, "radii.y");
        refuse(RigidCellSpec { satellites: 9, ..spec() }, "satellites");
        refuse(RigidCellSpec { layers: 3, ..spec() }, "layers");
        for satellites in [8, 128] {
            for ratio in [0.15, 1.0, 7.0] {
                let radii = Vec2::new(10.0, 10.0 * ratio);
                let spec = RigidCellSpec { radii, satellites, ..spec() };
                let error = spec.blueprint().err();
                assert_eq!(error, None, "{satellites} satellites, ratio {ratio}");
            }
        }
    }
}
