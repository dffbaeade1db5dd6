//! The part of a scene that a photo shows.

use crate::camera::Camera;

/// What a photo shows of a scene: at first what is seen of it.
#[derive(Clone, Debug, Default)]
pub(super) struct PhotoView(Option<Camera>);

impl PhotoView {
    /// Its camera for a scene that is seen by another one.
    pub(super) fn camera_from(&mut self, seen: &Camera) -> &Camera {
        let camera = self.0.get_or_insert_with(|| seen.clone());
        camera.resize(seen.screen());
        camera
    }

    /// Its camera, once there is a picture.
    pub(super) fn camera(&mut self) -> Option<&mut Camera> {
        self.0.as_mut()
    }
}
