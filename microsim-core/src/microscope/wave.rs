//! The wave of light behind the specimen.

use super::glsl::Glsl;
use super::matter::Matter;
use crate::bare_text::bare_text;
use glam::Vec2;

/// Optical density of haemoglobin in green light where a red cell is thickest.
const GREEN_DENSITY: f32 = 0.42;

pub(super) const GLSL: Glsl =
    Glsl { source: bare_text!("wave.glsl", "//"), constants: &[("GREEN_DENSITY", &[GREEN_DENSITY])] };

/// The wave behind some matter, relative to the one behind nothing: amplitude and phase as a vector.
pub(super) fn behind(matter: Matter) -> Vec2 {
    let wave = Vec2::new(libm::cosf(matter.phase), libm::sinf(matter.phase));
    if matter.haemoglobin <= 0.0 { wave } else { wave * libm::expf(-0.5 * GREEN_DENSITY * matter.haemoglobin) }
}

/// What shines in fluorescence: nucleic acid and cytoplasm.
pub(super) fn emitted(matter: Matter) -> Vec2 {
    Vec2::new(matter.nucleus, matter.cytoplasm).clamp(Vec2::ZERO, Vec2::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_dried_in_a_smear_is_not_there_in_a_wet_mount() {
        let lack = Matter { haemoglobin: -2.0, ..Matter::phase(0.3) };
        assert_eq!(behind(lack), behind(Matter::phase(0.3)));
        assert!(behind(Matter { haemoglobin: 1.0, ..Matter::NONE }).length() < 0.9);
    }
}
