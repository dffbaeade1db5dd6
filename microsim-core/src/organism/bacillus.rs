//! Bacillus: a rod-shaped bacterium, such as *Escherichia coli*: three discs in a line that are moved as a whole, the first ahead.
//!
//! ```text
//!     (o)(o)(o)->      1.5 radii apart, rigidly linked
//! ```

use super::blueprint::Blueprint;
use super::coccus::{PAINTED, TINT};
use super::spec::{Spec, SpecTable};
use crate::capability::Locomotion;
use crate::capability::phagocytosis::PreyClass;
use crate::error::Error;
use crate::kind::Kind;
use crate::look::drawn::{DrawnLook, Form};
use crate::look::{ImageLook, Look, Matter};
use crate::spec_field::FieldValue::Number;
use crate::spec_field::{FieldVisitor, check, field, required};
use crate::template::{Node, Template};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Distance of neighbouring discs, in radii: with their ends, a rod 2.5 times as long as wide.
const SPACING: f32 = 1.5;
/// Largest acceleration by its flagella, units/s2: it is light, so a push stops it at once.
const THRUST: f32 = 200.0;

/// A rod-shaped bacterium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BacillusSpec {
    /// Half its width, units, 0.1 to 20. *Escherichia coli*: 0.4.
    pub radius: f32,
    /// Mass per square unit, 0.01 to 100.
    pub density: f32,
    /// Speed with which it swims, units/s, 0 to 1000. *Escherichia coli*: 14.
    pub speed: f32,
}

impl Default for BacillusSpec {
    fn default() -> Self {
        Self { radius: 0.4, density: 1.0, speed: 14.0 }
    }
}

impl Spec for BacillusSpec {
    fn table(&self) -> SpecTable {
        SpecTable { name: "bacillus", words: "Rod-shaped bacteria.", entry_words: "A bacillus of this name." }
    }

    fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        visit(required("radius", "Half its width, micrometres."), Number(&mut self.radius, [0.1, 20.0]));
        visit(field("density", "Mass per square micrometre."), Number(&mut self.density, [0.01, 100.0]));
        visit(field("speed", "Speed with which it swims, micrometres/s."), Number(&mut self.speed, [0.0, 1000.0]));
    }

    fn blueprint(&self) -> Result<Blueprint, Error> {
        check(self.clone(), Self::fields)?;
        let area = (std::f32::consts::PI + 4.0 * SPACING) * self.radius * self.radius;
        Ok(Blueprint {
            template: Some(template()?),
            scale: self.radius,
            mass: area * self.density / 3.0,
            locomotion: Locomotion::Tow { max_acceleration: THRUST },
            speed: self.speed,
            prey: Some(PreyClass::Bacterium),
            ..Blueprint::of(Kind::Bacillus, area)
        })
    }

    /// A dense rod.
    fn look(&self) -> Look {
        Look {
            image: ImageLook::Rod(&Matter { phase: 0.40, haemoglobin: 0.0, cytoplasm: 0.5, nucleus: 0.9 }),
            drawn: DrawnLook { form: Form::Beads, tint: TINT, layer: 3 },
            painted: PAINTED,
        }
    }
}

/// The rod of radius 1.
fn template() -> Result<Template, Error> {
    let mut builder = Template::builder();
    let [head, middle, tail] = [SPACING, 0.0, -SPACING].map(|x| builder.node(Node::disc(Vec2::new(x, 0.0), 1.0, 1.0)));
    builder.link(head, middle, 0.0).link(middle, tail, 0.0).link(head, tail, 0.0);
    builder.build()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        AmoeboidCellSpec, Controller, Event, Inputs, Intent, Placement, RunAndTumbleParams, World, WorldConfig,
    };

    #[test]
    fn it_swims_along_its_length() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let ahead = Controller::patrol(vec![Vec2::new(140.0, 45.0)], false);
        let placement = Placement::at(20.0, 45.0).turned(2.0).steered_by(ahead);
        let id = world.spawn(&BacillusSpec::default().into(), placement).unwrap();
        (0..240).for_each(|_| world.step(&Inputs::new()));
        let discs: Vec<Vec2> = world.view().organism(id).unwrap().particles().map(|p| p.position).collect();
        assert!(discs[0].x > 60.0, "it gets on: {discs:?}");
        let rod = discs[0] - discs[2];
        assert!((rod.length() - 1.2).abs() < 0.02 && rod.x > 1.1, "a rod that points ahead: {rod}");
    }

    #[test]
    fn it_runs_and_tumbles_and_is_taken_in_whole() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 45.0)).unwrap();
        let tumbling = Controller::run_and_tumble(RunAndTumbleParams::default());
        let slow = BacillusSpec { speed: 1.0, ..BacillusSpec::default() };
        let prey = world.spawn(&slow.into(), Placement::at(75.0, 45.0).steered_by(tumbling)).unwrap();
        let mut inputs = Inputs::new();
        let is_in = |event: &Event| *event == Event::Ingested { engulfer: cell, prey };
        let taken = (0..900).any(|_| {
            let goal = world.centroid(prey).unwrap();
            inputs.set(cell, Intent::toward(goal).unwrap());
            world.step(&inputs);
            let census = world.census();
            assert_eq!((census.leaks, census.improper_absorptions, census.partial_absorptions), (0, 0, 0));
            world.events().iter().any(is_in)
        });
        assert!(taken, "not taken in");
    }

    #[test]
    fn bad_numbers_are_refused_by_name() {
        let refuse = |spec: BacillusSpec, field: &str| assert_eq!(spec.blueprint().unwrap_err().field(), field);
        refuse(BacillusSpec { radius: 0.0, ..BacillusSpec::default() }, "radius");
        refuse(BacillusSpec { density: f32::NAN, ..BacillusSpec::default() }, "density");
        refuse(BacillusSpec { speed: -1.0, ..BacillusSpec::default() }, "speed");
    }
}
