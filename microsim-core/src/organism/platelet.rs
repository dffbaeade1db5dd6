//! Platelet (thesis, 3.1.4): a soft obstacle that returns to its place.
//!
//! ```text
//!      o o o          o  satellites: one rigid ring, a spring to the nucleus each
//!    o  ___  o        ( ) interlayer: almost reaches the ring and holds it out; concentric with the nucleus
//!   o  / N \  o ~~~ x     N  nucleus, x  anchor: a contracting rope leads to it
//!    o  ---  o
//!      o o o
//! ```

use super::blueprint::Blueprint;
use super::spec::{Spec, SpecTable};
use crate::error::Error;
use crate::geometry::ring::{ellipse, touching_ring};
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{
    ImageLook, Inclusion, Look, Matter, OutlineLook, PaintedLook, Profile, RoundLook, SpotShape, Texture,
};
use crate::particle::CollisionGroups;
use crate::solver::constraint::{Anchor, Distance, MinDistance};
use crate::spec_field::FieldValue::{Count, Number};
use crate::spec_field::{FieldVisitor, check, field, required};
use crate::template::{Node, Role, Template, TemplateBuilder};
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Share of a satellite's radius that stays free between ring and interlayer.
const INTERLAYER_GAP: f32 = 0.1;

/// Satellites `i` and `i + 2` stay this many links apart, so that a ring under load does not fold.
const FOLD_LIMIT: f32 = 1.6;

/// A soft obstacle on a rope.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlateletSpec {
    /// Outer radius, units, 0.2 to 100.
    pub radius: f32,
    /// Satellites in the ring, 8 to 64. With nucleus and interlayer, 18 to 28 give the thesis' 20 to 30 bodies.
    pub satellites: u32,
    /// Mass of the nucleus and of the interlayer, each, in satellites, 1 to 1000.
    pub core_mass: f32,
    /// Inverse stiffness of the spokes (length/force), 0 to 1.
    pub spoke_compliance: f32,
    /// Inverse stiffness with which the rope contracts, 0 to 10. Larger lets cells push through more easily.
    pub anchor_compliance: f32,
    /// Longest that the rope gets, in radii, 0 to 100.
    pub rope_length: f32,
}

impl Default for PlateletSpec {
    fn default() -> Self {
        Self {
            radius: 2.5,
            satellites: 28,
            core_mass: 40.0,
            spoke_compliance: 2e-4,
            anchor_compliance: 5e-3,
            rope_length: 4.0,
        }
    }
}

impl Spec for PlateletSpec {
    fn table(&self) -> SpecTable {
        SpecTable {
            name: "platelet",
            words: "Soft obstacles that return to their places.",
            entry_words: "A platelet of this name.",
        }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(required("radius", "Outer radius, micrometres."), Number(&mut self.radius, [0.2, 100.0]));
        visit(field("satellites", "Satellites in the ring."), Count(&mut self.satellites, [8, 64]));
        visit(
            field("core_mass", "Mass of the nucleus and of the interlayer, each, in satellites."),
            Number(&mut self.core_mass, [1.0, 1000.0]),
        );
        visit(
            field("spoke_compliance", "Inverse stiffness of the spokes."),
            Number(&mut self.spoke_compliance, [0.0, 1.0]),
        );
        visit(
            field(
                "anchor_compliance",
                "Inverse stiffness with which its rope contracts: larger lets cells push through.",
            ),
            Number(&mut self.anchor_compliance, [0.0, 10.0]),
        );
        visit(
            field("rope_length", "Longest that the rope gets, in radii."),
            Number(&mut self.rope_length, [0.0, 100.0]),
        );
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        Ok(Blueprint {
            template: Some(self.template()?),
            scale: self.radius,
            ..Blueprint::of(Kind::Platelet, std::f32::consts::PI * self.radius * self.radius)
        })
    }

    /// A thin irregular plate with granules in the middle, which take basic dyes.
    fn look(&self) -> Look {
        Look {
            image: ImageLook::Round(&RoundLook {
                profile: Profile::Dome(0.9),
                matter: Matter { phase: 0.34, haemoglobin: 0.0, cytoplasm: 0.20, nucleus: 0.10 },
                variation: 0.35,
                texture: Texture { amount: 0.09, size: 0.8 },
                outline: OutlineLook {
                    median: 0.76,
                    size: 0.22,
                    waves: [0.12, 0.045],
                    decay: 2.1,
                    spread: 0.6,
                    spikes: [0, 2],
                    ..OutlineLook::EVEN
                },
                inclusions: &[GRANULOMERE, LUMPS, GRANULES, RUFFLES],
                filopodia: 3,
                ..RoundLook::PLAIN
            }),
            drawn: DrawnLook {
                form: Form::Platelet,
                tint: Tint::hex([0xF3D3CD, 0xDE9F98, 0xA65E5C, 0x9C4F52]),
                layer: 1,
            },
            painted: PaintedLook { body: Vec3::new(0.82, 0.66, 0.7), rim: Vec3::new(0.58, 0.38, 0.46), mottle: 0.12 },
        }
    }
}

/// The thick middle.
const GRANULOMERE: Inclusion = Inclusion {
    count: [2, 3],
    radius: [0.40, 0.62],
    place: [0.0, 0.22],
    matter: Matter { phase: 0.12, haemoglobin: 0.0, cytoplasm: 0.12, nucleus: 0.13 },
    shape: SpotShape::Bump,
    grains: [0, 0],
};

/// What it is uneven by.
const LUMPS: Inclusion = Inclusion {
    count: [3, 9],
    radius: [0.12, 0.30],
    place: [0.0, 0.55],
    matter: Matter { phase: 0.06, haemoglobin: 0.0, cytoplasm: 0.10, nucleus: 0.13 },
    shape: SpotShape::Bump,
    grains: [0, 0],
};

const GRANULES: Inclusion = Inclusion {
    count: [16, 40],
    radius: [0.04, 0.10],
    place: [0.0, 0.62],
    matter: Matter { phase: 0.10, haemoglobin: 0.0, cytoplasm: 0.25, nucleus: 0.28 },
    shape: SpotShape::Bump,
    grains: [0, 0],
};

/// Folds of the thin sheet near its edge.
const RUFFLES: Inclusion = Inclusion {
    count: [4, 12],
    radius: [0.06, 0.20],
    place: [0.70, 0.96],
    matter: Matter { phase: 0.08, haemoglobin: 0.0, cytoplasm: 0.07, nucleus: 0.0 },
    shape: SpotShape::Bump,
    grains: [0, 0],
};

impl PlateletSpec {
    /// The platelet of outer radius 1.
    fn template(&self) -> Result<Template, Error> {
        let [ring_radius, satellite_radius] = touching_ring(self.satellites as usize);
        let mut builder = Template::builder();
        let core = Core::add(&mut builder, self.core_mass, ring_radius - (1.0 + INTERLAYER_GAP) * satellite_radius);
        let satellite = |position| Node { role: Role::Membrane, ..Node::disc(position, 1.0, satellite_radius) };
        let points = ellipse(Vec2::splat(ring_radius), self.satellites as usize);
        let ring: Vec<u32> = points.into_iter().map(|at| builder.node(satellite(at))).collect();
        builder.ring(&ring, 0.0).outline(&ring);
        let held_out = ring_radius - INTERLAYER_GAP * satellite_radius;
        let straightest = FOLD_LIMIT * 2.0 * satellite_radius;
        for (k, &a) in ring.iter().enumerate() {
            let b = ring[(k + 2) % ring.len()];
            builder.constraint(MinDistance { a, b, min_length: straightest });
        }
        for &a in &ring {
            let compliance = self.spoke_compliance;
            builder.constraint(Distance { a, b: core.nucleus, rest_length: ring_radius, compliance, damping: 0.0 });
            builder.constraint(MinDistance { a, b: core.interlayer, min_length: held_out });
        }
        builder.constraint(Anchor {
            node: core.nucleus,
            anchor: core.anchor,
            rest_length: 0.0,
            max_length: self.rope_length,
            compliance: self.anchor_compliance,
        });
        builder.build()
    }
}

/// What lies at the centre.
struct Core {
    nucleus: u32,
    interlayer: u32,
    anchor: u32,
}

impl Core {
    fn add(builder: &mut TemplateBuilder, mass: f32, interlayer_radius: f32) -> Self {
        let inside = |radius, role| Node { role, ..Node::disc(Vec2::ZERO, mass, radius) };
        let nucleus = Node { groups: CollisionGroups::NONE, ..inside(0.4, Role::Nucleus) };
        let nucleus = builder.node(nucleus);
        let interlayer = builder.node(inside(interlayer_radius, Role::Interlayer));
        let anchor = builder.node(Node::fixed(Vec2::ZERO));
        builder.link(nucleus, interlayer, 0.0);
        Self { nucleus, interlayer, anchor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::constraint::Constraint;

    fn template() -> Template {
        PlateletSpec::default().blueprint().unwrap().template.unwrap()
    }

    #[test]
    fn t48_has_twenty_to_thirty_dynamic_bodies() {
        for satellites in [18, 28] {
            let spec = PlateletSpec { satellites, ..PlateletSpec::default() };
            let template = spec.blueprint().unwrap().template.unwrap();
            let dynamic = template.nodes().iter().filter(|node| node.mass.is_finite()).count();
            assert!((20..=30).contains(&dynamic), "{dynamic} bodies");
        }
    }

    #[test]
    fn t45_ring_nucleus_and_interlayer() {
        let template = template();
        let with = |role| template.nodes().iter().filter(move |node| node.role == role).collect::<Vec<_>>();
        let (satellites, nucleus, interlayer) = (with(Role::Membrane), with(Role::Nucleus), with(Role::Interlayer));
        assert_eq!((satellites.len(), nucleus.len(), interlayer.len()), (28, 1, 1));
        assert_eq!(nucleus[0].position, interlayer[0].position, "concentric");
        assert!(!nucleus[0].groups.meets(interlayer[0].groups), "no collision with the nucleus");
        let ring_radius = satellites[0].position.length();
        let gap = ring_radius - satellites[0].radius - interlayer[0].radius;
        assert!(gap > 0.0 && gap < 0.2 * satellites[0].radius, "almost reaches the satellites, gap {gap}");
        let limits = template.constraints().iter().filter(|c| matches!(c, Constraint::MinDistance(_)));
        assert_eq!(limits.count(), 28 + 28, "held out, and kept from folding");
        assert!((template.extent() - 1.0).abs() < 1e-5);
    }

    #[test]
    fn t46_nucleus_hangs_on_a_static_anchor_by_a_contracting_rope() {
        let template = template();
        let anchor = |constraint: &Constraint| match constraint {
            Constraint::Anchor(anchor) => Some(*anchor),
            _ => None,
        };
        let anchor = template.constraints().iter().find_map(anchor).unwrap();
        let post = template.nodes()[anchor.anchor as usize];
        assert_eq!(template.nodes()[anchor.node as usize].role, Role::Nucleus);
        assert!(post.mass.is_infinite() && post.groups == CollisionGroups::NONE);
        assert!(anchor.rest_length == 0.0 && anchor.max_length == 4.0 && anchor.compliance > 0.0);
    }
}
