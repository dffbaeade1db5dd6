//! Measures of a world: the [`census`], the [`quality`] of constraints, [`membrane_quality`], and each measure by its name, as
//! scenarios and output files use it.

pub(crate) mod census;
pub(crate) mod membrane_quality;
pub(crate) mod quality;

use crate::world::World;

/// One measure of a world, with its name.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    name: &'static str,
    of: fn(&World) -> f64,
}

impl Measure {
    /// All measures. The names are those of the fields of [`crate::Census`] and [`crate::Quality`].
    pub const ALL: &'static [Self] = &[
        Self::new("organisms", |world| world.organisms.len() as f64),
        Self::new("bodies", |world| world.bodies() as f64),
        Self::new("particles", |world| world.particles.live_count() as f64),
        Self::new("leaks", |world| world.leaks() as f64),
        Self::new("improper_absorptions", |world| world.improper_absorptions() as f64),
        Self::new("partial_absorptions", |world| world.partial_absorptions() as f64),
        Self::new("wrong_side", |world| world.guard.wrong_side as f64),
        Self::new("net_fired", |world| world.guard.net_fired as f64),
        Self::new("quarantined", |world| world.quarantined() as f64),
        Self::new("ring_error_mean", |world| world.ring_error_mean().into()),
        Self::new("ring_error_max", |world| world.ring_error_max().into()),
        Self::new("penetration_max", |world| world.penetration_max().into()),
        Self::new("edge_stretch_max", |world| world.edge_stretch_max().into()),
        Self::new("anchor_offset_max", |world| world.anchor_offset_max().into()),
        Self::new("fluid_compression_mean", |world| world.fluid_compression_mean().into()),
        Self::new("membrane_stretch_max", |world| world.membrane_stretch_max().into()),
        Self::new("voids_max", |world| world.voids_max().into()),
        Self::new("excess_turning_max", |world| world.excess_turning_max().into()),
        Self::new("width_ratio_mean", |world| world.width_ratio_mean().into()),
        Self::new("speed_kept_mean", |world| world.speed_kept_mean().into()),
        Self::new("ingestion_time_max", |world| world.ingestion_time_max().into()),
        Self::new("stalled_max", |world| world.stalled_max().into()),
    ];

    const fn new(name: &'static str, of: fn(&World) -> f64) -> Self {
        Self { name, of }
    }

    /// The measure of this name, if there is one.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|measure| measure.name == name)
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.name
    }

    /// Measures a world as it is now.
    #[must_use]
    pub fn of(self, world: &World) -> f64 {
        (self.of)(world)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AmoeboidCellSpec, Inputs, Placement, WorldConfig};
    use std::collections::BTreeSet;

    #[test]
    fn names_are_distinct_and_found() {
        let names: BTreeSet<_> = Measure::ALL.iter().map(|measure| measure.name()).collect();
        assert_eq!(names.len(), Measure::ALL.len());
        assert!(names.iter().all(|name| Measure::named(name).is_some_and(|measure| measure.name() == *name)));
        assert!(Measure::named("leak").is_none());
    }

    #[test]
    fn each_measure_equals_its_field_of_census_or_quality() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(50.0, 45.0)).unwrap();
        (0..5).for_each(|_| world.step(&Inputs::new()));
        // The fields as `Debug` prints them: `name: value`.
        let fields = format!("{:?} {:?}", world.census(), world.quality());
        for measure in Measure::ALL {
            let (_, after) =
                fields.split_once(&format!(" {}: ", measure.name())).unwrap_or_else(|| panic!("{measure:?}"));
            let value: f64 = after.split([',', ' ']).next().unwrap().parse().unwrap();
            assert!((measure.of(&world) - value).abs() < 1e-6 * value.abs().max(1.0), "{measure:?}: {value}");
        }
    }
}
