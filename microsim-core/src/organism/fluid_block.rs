//! Fluid block: free fluid that fills a rectangle when it is spawned.

use super::blueprint::{Blueprint, FluidPlan};
use super::spec::{Spec, SpecTable};
use crate::error::{Error, out_of_range};
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form, Tint};
use crate::look::{ImageLook, Look, Matter, PaintedLook};
use crate::solver::fluid::FluidParams;
use crate::spec_field::FieldValue::Vector;
use crate::spec_field::{FieldVisitor, check, required};
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// A rectangle of fluid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FluidBlockSpec {
    /// Width and height, units, 0.1 to 20 000 each.
    pub size: Vec2,
    /// The fluid. Blocks of equal fluid mix.
    pub fluid: FluidParams,
}

impl Default for FluidBlockSpec {
    fn default() -> Self {
        Self { size: Vec2::splat(20.0), fluid: FluidParams::default() }
    }
}

/// Points of a hexagonal lattice in a rectangle around the origin, inset by half a spacing.
pub(crate) fn hexagonal_fill(size: Vec2, spacing: f32) -> Vec<Vec2> {
    let rise = spacing * 0.75f32.sqrt();
    let rows = ((size.y - spacing) / rise) as i64 + 1;
    let mut points = Vec::new();
    for row in 0..rows {
        let inset = if row % 2 == 0 { 0.5 } else { 1.0 };
        let columns = ((size.x - (inset + 0.5) * spacing) / spacing) as i64 + 1;
        for column in 0..columns {
            let corner = Vec2::new((column as f32 + inset) * spacing, row as f32 * rise + 0.5 * spacing);
            points.push(corner - size * 0.5);
        }
    }
    points
}

impl Spec for FluidBlockSpec {
    fn table(&self) -> SpecTable {
        SpecTable { name: "fluid", words: "Blocks of free fluid.", entry_words: "A fluid of this name." }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(
            required("size", "Width and height, micrometres."),
            Vector(&mut self.size, [self.fluid.spacing, 20_000.0]),
        );
        self.fluid.fields(visit);
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        self.fluid.validate().map_err(|error| error.within("fluid"))?;
        check(self.clone(), Self::fields)?;
        let spacing = f64::from(self.fluid.spacing);
        let about = f64::from(self.size.x) * f64::from(self.size.y) / (spacing * spacing) * 1.2;
        if about > 4e6 {
            return Err(out_of_range(
                "size",
                about,
                "at most 4000000 particles (spacing squared x 0.87 each)".to_owned(),
            ));
        }
        Ok(Blueprint {
            fluid: Some(FluidPlan {
                params: self.fluid,
                points: hexagonal_fill(self.size, self.fluid.spacing),
                is_enclosed: false,
            }),
            ..Blueprint::of(Kind::FluidBlock, self.size.x * self.size.y)
        })
    }

    /// A little denser than the medium; each particle is a soft drop that runs into its neighbours.
    fn look(&self) -> Look {
        Look {
            image: ImageLook::Drops(&Matter { phase: 0.5, haemoglobin: 0.0, cytoplasm: 0.4, nucleus: 0.0 }),
            drawn: DrawnLook { form: Form::Drops, tint: Tint::hex([0x9CCBE3, 0x6CAFD1, 0x4A91B6, 0x4A91B6]), layer: 0 },
            painted: PaintedLook { body: Vec3::new(0.55, 0.62, 0.7), rim: Vec3::new(0.3, 0.35, 0.42), mottle: 0.05 },
        }
    }

    fn scale(&mut self, scale: f32) -> bool {
        self.size *= scale;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fill_keeps_its_spacing_and_stays_inside() {
        let points = hexagonal_fill(Vec2::new(10.0, 6.0), 1.0);
        assert!((55..=72).contains(&points.len()), "{} points", points.len());
        for (k, a) in points.iter().enumerate() {
            assert!(a.x.abs() <= 4.5 + 1e-4 && a.y.abs() <= 2.5 + 1e-4, "{a}");
            assert!(points[..k].iter().all(|b| (*a - *b).length() > 0.99));
        }
    }

    #[test]
    fn absurd_sizes_are_refused() {
        let spec = FluidBlockSpec { size: Vec2::splat(19_000.0), ..FluidBlockSpec::default() };
        assert_eq!(spec.blueprint().unwrap_err().field(), "size");
        let spec = FluidBlockSpec { size: Vec2::splat(0.5), ..FluidBlockSpec::default() };
        assert_eq!(spec.blueprint().unwrap_err().field(), "size.x");
    }
}
