//! What is drawn in one frame.

use crate::camera::Camera;
use microsim_core::View;

/// What is drawn in one frame.
#[derive(Debug)]
pub struct SceneFrame<'a> {
    /// The world at one moment.
    pub view: View<'a>,
    /// What is seen of it.
    pub camera: &'a Camera,
    /// For what moves in the scenery, s.
    pub time: f32,
}
