//! Amoeboid cell (thesis, 3.1.2): a filled chain.
//!
//! ```text
//!     o-o-o-o        membrane: a closed chain of equal discs that touch, evenly on an ellipse
//!    o . . . o       . cytoplasm: viscous fluid, its particles wider than any gap the chain can open
//!     o-o-o-o
//! ```

mod amoeba;
mod neutrophil;
mod outline;

use super::blueprint::{Blueprint, FluidPlan};
use super::spec::{Spec, SpecTable};
use crate::capability::Locomotion;
use crate::capability::crawl::presets::Crawl;
use crate::capability::crawl::{PseudopodParams, Pseudopods};
use crate::capability::division::DivisionParams;
use crate::capability::phagocytosis::PhagocytosisParams;
use crate::error::{Error, out_of_range};
use crate::geometry::polygon::{perimeter, signed_area};
use crate::geometry::ring::{GOLDEN_ANGLE, ellipse, unit_vector};
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{ImageLook, Look, PaintedLook};
use crate::particle::Material;
use crate::solver::fluid::{FluidParams, rest_area, settle};
use crate::spec_field::FieldValue::{Number, Table, Vector, Word};
use crate::spec_field::{FieldVisitor, check, field, required};
use crate::template::{Node, Role, Template};
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};
use std::f32::consts::PI;

/// Most nodes of a membrane.
pub(crate) const MAX_NODES: f32 = 4096.0;

/// Fewest particles of cytoplasm: with less the membrane has nothing to hug.
pub(crate) const LEAST_CYTOPLASM: usize = 7;

/// An ellipse with a semi-axis below this, in node radii, is nearly round: a narrower one becomes round in such a hurry that
/// cytoplasm is pushed through its membrane and put back, by which the cell moves.
const NARROW: f32 = 6.5;
/// Largest aspect of a narrow one.
const NEARLY_ROUND: f32 = 1.25;

/// Share of the spacing that is between an outline's membrane and its cytoplasm.
const CLEARANCE: f32 = 0.1;

/// Radius of a membrane node, units, above which a cell looks like an amoeba rather than a blood cell: its daughters have
/// the same.
const AMOEBA_NODE: f32 = 0.6;

/// A membrane filled with cytoplasm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AmoeboidCellSpec {
    /// Semi-axes at rest, units, each at least three node radii and at most 500; at least 6.5 node radii if one is more than 1.25
    /// times the other. The membrane encloses the area of their ellipse: the corners of its polygon lie a little outside.
    pub radii: Vec2,
    /// Corners of its outline when spawned, around it in either direction, units from its place, within ±500; none for the ellipse
    /// of `radii`. The membrane's nodes lie on it. It is as long as its membrane from then on, and rounds up as cells do.
    pub outline: Vec<Vec2>,
    /// Radius of a membrane node, units, 0.1 to 10. The thesis' 0.78 for cells of any size.
    pub node_radius: f32,
    /// Rest spacing of the cytoplasm in node radii, 1.2 to 3: particles are wider than half a gap (T17) and narrower than
    /// would keep the cell from deforming.
    pub cytoplasm_spacing: f32,
    /// Viscosity of the cytoplasm, 1/s, 0 to 1000 and at most 0.5 over the substep, see [`FluidParams::viscosity`].
    pub viscosity: f32,
    /// Speed of its front and rear when it moves, units/s, 0 to 1000.
    pub speed: f32,
    /// How it crawls.
    pub crawl: Crawl,
    /// Its pseudopods, where they are not those of the type of amoeba that `crawl` names.
    pub pseudopods: Option<PseudopodParams>,
    /// How it takes in and digests prey.
    pub phagocytosis: PhagocytosisParams,
    /// How it divides and fuses.
    pub division: DivisionParams,
}

impl Default for AmoeboidCellSpec {
    fn default() -> Self {
        Self {
            radii: Vec2::new(11.0, 11.0),
            outline: Vec::new(),
            node_radius: 0.78,
            cytoplasm_spacing: 1.65,
            viscosity: 25.0,
            speed: 8.0,
            crawl: Crawl::default(),
            pseudopods: None,
            phagocytosis: PhagocytosisParams::default(),
            division: DivisionParams::default(),
        }
    }
}

impl Spec for AmoeboidCellSpec {
    fn table(&self) -> SpecTable {
        SpecTable {
            name: "amoeboid_cell",
            words: "Cells of a membrane that is filled with cytoplasm.",
            entry_words: "An amoeboid cell of this name.",
        }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(
            field("node_radius", "Radius of a membrane node, micrometres."),
            Number(&mut self.node_radius, [0.1, 10.0]),
        );
        visit(
            required("radii", "Semi-axes at rest, micrometres."),
            Vector(&mut self.radii, [3.0 * self.node_radius, 500.0]),
        );
        visit(
            field("cytoplasm_spacing", "Rest spacing of the cytoplasm, in node radii."),
            Number(&mut self.cytoplasm_spacing, [1.2, 3.0]),
        );
        visit(field("viscosity", "Viscosity of the cytoplasm, 1/s."), Number(&mut self.viscosity, [0.0, 1000.0]));
        visit(
            field("speed", "Speed of its front and rear when it moves, micrometres/s."),
            Number(&mut self.speed, [0.0, 1000.0]),
        );
        let words = "How it crawls: with front and rear of a round cell, or with the pseudopods of a type of amoeba.";
        let mut crawl = self.crawl as usize;
        visit(field("crawl", words), Word(&mut crawl, &Crawl::WORDS));
        self.crawl = Crawl::ALL[crawl];
        let words = "Its pseudopods, where they are not those of its type.";
        let mut pseudopods = self.pseudopods();
        visit(field("pseudopods", words), Table(&mut |visit| pseudopods.fields(visit)));
        if pseudopods != self.pseudopods() {
            self.pseudopods = Some(pseudopods);
        }
        visit(
            field("phagocytosis", "How it takes in and digests prey."),
            Table(&mut |visit| self.phagocytosis.fields(visit)),
        );
        visit(field("division", "How it divides and fuses."), Table(&mut |visit| self.division.fields(visit)));
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        if self.crawl == Crawl::FrontAndRear && self.pseudopods.is_some() {
            return Err(Error::unsupported("pseudopods", "a type of amoeba as `crawl`"));
        }
        let chain = self.chain()?;
        let cytoplasm = self.cytoplasm(&chain);
        if cytoplasm.points.len() < LEAST_CYTOPLASM {
            let accepted = format!("large enough for {LEAST_CYTOPLASM} cytoplasm particles at this spacing");
            let field = if self.outline.is_empty() { "radii" } else { "outline" };
            return Err(out_of_range(field, cytoplasm.points.len() as f64, accepted));
        }
        Ok(Blueprint {
            rim: Some(self.rim(&chain, &cytoplasm)),
            fluid: Some(cytoplasm),
            template: Some(self.membrane(&chain)?),
            locomotion: self.locomotion(),
            speed: self.speed,
            engulfer: Some(self.phagocytosis),
            divider: Some(self.division),
            ..Blueprint::of(Kind::AmoeboidCell, self.area())
        })
    }

    fn look(&self) -> Look {
        Look {
            image: ImageLook::Amoeboid(
                |node_radius| if node_radius > AMOEBA_NODE { &amoeba::LOOK } else { &neutrophil::LOOK },
            ),
            drawn: DrawnLook {
                form: Form::Amoeboid,
                tint: Tint::hex([0xC9D3EA, 0x9FB0D8, 0x4C5F96, 0x53669F]),
                layer: 5,
            },
            painted: PaintedLook { body: Vec3::new(0.7, 0.82, 0.56), rim: Vec3::new(0.38, 0.55, 0.34), mottle: 0.0 },
        }
    }

    fn scale(&mut self, scale: f32) -> bool {
        self.radii *= scale;
        self.outline.iter_mut().for_each(|corner| *corner *= scale);
        true
    }
}

impl AmoeboidCellSpec {
    /// Its own pseudopods, or those of its type.
    fn pseudopods(&self) -> PseudopodParams {
        self.pseudopods.or(self.crawl.pseudopods()).unwrap_or_default()
    }

    fn locomotion(&self) -> Locomotion {
        match self.crawl {
            Crawl::FrontAndRear => Locomotion::Crawl { front_centre: None },
            _ => Locomotion::Protrude(Box::new(Pseudopods::new(self.pseudopods()))),
        }
    }

    fn area(&self) -> f32 {
        match self.outline.as_slice() {
            [] => PI * self.radii.x * self.radii.y,
            outline => signed_area(outline).abs(),
        }
    }

    /// Centres of the chain: as many as fit without a gap, around the area of the ellipse.
    fn chain(&self) -> Result<Vec<Vec2>, Error> {
        if !self.outline.is_empty() {
            return outline::chain(&self.outline, self.node_radius);
        }
        let (wide, narrow) = (self.radii.max_element(), self.radii.min_element());
        if narrow < NARROW * self.node_radius && wide > NEARLY_ROUND * narrow {
            let accepted =
                format!("at least {NARROW} node radii, or an ellipse of an aspect of at most {NEARLY_ROUND}");
            return Err(out_of_range("radii", f64::from(narrow), accepted));
        }
        let radii = self.radii - Vec2::splat(self.node_radius);
        let around = perimeter(&ellipse(radii, 256));
        let count = around / (2.0 * self.node_radius);
        if count > MAX_NODES {
            let accepted = format!("at most {MAX_NODES} membrane nodes (perimeter over 2 node radii)");
            return Err(out_of_range("radii", f64::from(count), accepted));
        }
        let corners = ellipse(radii, count as usize);
        // A polygon on an ellipse is smaller.
        let larger = (PI * radii.x * radii.y / signed_area(&corners)).sqrt();
        Ok(corners.into_iter().map(|corner| larger * corner).collect())
    }

    /// Radius of its membrane at rest less that of its content: a cell rounds up to the area that it is spawned with, except that
    /// the cytoplasm need not fill an outline.
    fn rim(&self, chain: &[Vec2], cytoplasm: &FluidPlan) -> f32 {
        let spacing = cytoplasm.params.spacing;
        let radius = |area: f32| (area / PI).sqrt();
        match self.outline.is_empty() {
            true => radius(signed_area(chain)) - radius(rest_area(cytoplasm.points.len(), spacing)),
            false => self.node_radius + CLEARANCE * spacing,
        }
    }

    fn membrane(&self, chain: &[Vec2]) -> Result<Template, Error> {
        let material = Material { friction: 0.05, restitution: 0.0 };
        let mut builder = Template::builder();
        let disc = |position| Node { role: Role::Membrane, material, ..Node::disc(position, 1.0, self.node_radius) };
        let ring: Vec<u32> = chain.iter().map(|&position| builder.node(disc(position))).collect();
        builder.outline(&ring);
        builder.build()
    }

    fn cytoplasm(&self, chain: &[Vec2]) -> FluidPlan {
        let spacing = self.cytoplasm_spacing * self.node_radius;
        let params = FluidParams { spacing, particle_mass: 1.0, viscosity: self.viscosity, ..FluidParams::default() };
        let points = if self.outline.is_empty() {
            self.ellipse_of(params)
        } else {
            outline::fill(chain, spacing, self.node_radius + 0.5 * spacing)
        };
        FluidPlan { params, points, is_enclosed: true }
    }

    /// Cytoplasm in an ellipse.
    fn ellipse_of(&self, params: FluidParams) -> Vec<Vec2> {
        let (spacing, radii) = (params.spacing, self.radii - Vec2::splat(self.node_radius));
        // The middle of a link is nearer to the centre than its ends.
        let sagitta = self.node_radius * self.node_radius / (2.0 * radii.min_element());
        let inside = radii - Vec2::splat(self.node_radius + sagitta);
        let count = (PI * inside.x * inside.y / rest_area(1, spacing)) as usize;
        let room = inside - Vec2::splat(0.5 * spacing);
        let mut points = even_fill(count, room);
        settle(&mut points, params, |at| {
            let share = (at / room).length();
            if share > 1.0 { at / share } else { at }
        });
        points
    }
}

/// Points of even density in an ellipse around the origin, as the florets of a sunflower (Vogel 1979, "A better way to construct
/// the sunflower head").
fn even_fill(count: usize, radii: Vec2) -> Vec<Vec2> {
    let place = |k: usize| ((k as f32 + 0.5) / count as f32).sqrt() * unit_vector(k as f32 * GOLDEN_ANGLE);
    (0..count).map(|k| radii * place(k)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::membrane::STRAIN_LIMIT;

    fn blueprint(spec: &AmoeboidCellSpec) -> (Template, FluidPlan) {
        let blueprint = spec.blueprint().unwrap();
        (blueprint.template.unwrap(), blueprint.fluid.unwrap())
    }

    #[test]
    fn t15_t16_chain_of_touching_equal_discs_of_the_same_radius_at_any_size() {
        for radii in [Vec2::new(6.0, 5.0), Vec2::new(15.0, 11.0), Vec2::new(40.0, 40.0)] {
            let (template, _) = blueprint(&AmoeboidCellSpec { radii, ..AmoeboidCellSpec::default() });
            let count = template.outline().len();
            let position = |k: usize| template.nodes()[k % count].position;
            assert!(template.nodes().iter().all(|node| node.radius == 0.78 && node.mass.is_finite()));
            for k in 0..count {
                let gap = (position(k + 1) - position(k)).length() - 2.0 * 0.78;
                assert!(gap.abs() < 0.1 * 0.78, "gap {gap} in a chain of {count}");
            }
        }
    }

    #[test]
    fn t17_cytoplasm_fills_most_of_the_cell_and_fits_through_no_gap() {
        let spec = AmoeboidCellSpec::default();
        let (template, fluid) = blueprint(&spec);
        let radius = 0.5 * fluid.params.spacing;
        let rest_length = (template.nodes()[1].position - template.nodes()[0].position).length();
        let widest = STRAIN_LIMIT * rest_length - 2.0 * spec.node_radius;
        assert!(radius > 0.5 * widest, "radius {radius}, widest gap {widest}");
        let cell = PI * (spec.radii.x - 2.0 * spec.node_radius).powi(2);
        let share = fluid.points.len() as f32 * 0.866 * fluid.params.spacing.powi(2) / cell;
        assert!((0.75..1.0).contains(&share), "fills {share} of the room");
        assert!(fluid.params.viscosity > 1.0 && fluid.params.viscosity < 100.0);
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let refuse = |spec: AmoeboidCellSpec, field: &str| assert_eq!(spec.blueprint().unwrap_err().field(), field);
        let spec = AmoeboidCellSpec::default;
        refuse(AmoeboidCellSpec { radii: Vec2::new(1.0, 10.0), ..spec() }, "radii.x");
        refuse(AmoeboidCellSpec { node_radius: f32::INFINITY, ..spec() }, "node_radius");
        refuse(AmoeboidCellSpec { radii: Vec2::new(8.0, 4.0), ..spec() }, "radii");
        refuse(AmoeboidCellSpec { radii: Vec2::splat(500.0), node_radius: 0.1, ..spec() }, "radii");
        refuse(AmoeboidCellSpec { radii: Vec2::splat(3.0), cytoplasm_spacing: 3.0, ..spec() }, "radii");
        refuse(AmoeboidCellSpec { cytoplasm_spacing: 0.1, ..spec() }, "cytoplasm_spacing");
        let pseudopods = Some(PseudopodParams { width: 0.7, ..PseudopodParams::NEUTROPHIL });
        refuse(AmoeboidCellSpec { pseudopods, crawl: Crawl::Neutrophil, ..spec() }, "pseudopods.width");
        refuse(AmoeboidCellSpec { pseudopods: Some(PseudopodParams::KERATOCYTE), ..spec() }, "pseudopods");
    }
}
