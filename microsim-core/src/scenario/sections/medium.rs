//! The medium, of which the molecules kick what is small: the table `[medium]`.

use crate::scenario::reader::Fields;
use crate::{FieldKind, ForceField, Region};
use std::f32::consts::PI;

/// Boltzmann's constant, cubic micrometres times mPa per kelvin: 1.380649e-23 J/K.
const BOLTZMANN: f32 = 1.380_649e-2;
/// 0 degrees Celsius, K.
const FREEZING: f32 = 273.15;

/// Reads the table; `None` where there is none, or where nothing moves.
pub(crate) fn read(root: &mut Fields<'_>) -> Option<ForceField> {
    let is_there = root.has("medium");
    let mut medium = root.table("medium");
    let temperature = medium.number("temperature", 20.0, [0.0, 100.0]);
    let viscosity = medium.number("viscosity", 1.0, [0.01, 1e6]);
    let time_lapse = medium.number("time_lapse", 1.0, [0.0, 1000.0]);
    medium.finish();
    // Stokes and Einstein, in micrometres, mPa s and s.
    let mobility = time_lapse * BOLTZMANN * (temperature + FREEZING) / (6.0 * PI * viscosity);
    let field = ForceField { region: Region::All, kind: FieldKind::Thermal { mobility } };
    (is_there && mobility > 0.0).then_some(field)
}
