//! The only place where the core's vectors meet Bevy's: the two come from different versions of glam.

use microsim_core::glam;

/// A vector of Bevy as the core's.
pub(crate) fn core(vector: bevy::math::Vec2) -> glam::Vec2 {
    glam::Vec2::from(vector.to_array())
}

/// A vector of the core as Bevy's.
pub(crate) fn scene(vector: glam::Vec2) -> bevy::math::Vec2 {
    bevy::math::Vec2::from(vector.to_array())
}
