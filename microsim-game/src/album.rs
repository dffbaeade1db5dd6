//! Small pictures of scenarios, drawn of their first moments and kept.

use crate::camera::Camera;
use crate::convert;
use crate::draw::SceneFrame;
use crate::scene_source::SceneSource;
use crate::scenery::{Effort, Scenery, Sight};
use crate::shot;
use crate::stage::Stage;
use crate::viewer::{FIRST_HEIGHT, first_view};
use macroquad::camera::set_default_camera;
use macroquad::color::WHITE;
use macroquad::texture::{DrawTextureParams, RenderTarget, draw_texture_ex, render_target};
use microsim_core::View;
use microsim_core::glam::Vec2;

/// Size of a picture, pixels.
const SIZE: (u32, u32) = (256, 144);

/// The pictures.
#[derive(Debug, Default)]
pub struct Album {
    /// None for what cannot be opened.
    pictures: Vec<(SceneSource, Option<RenderTarget>)>,
}

impl Album {
    /// Draws the picture of the first one of these that has none. Not while another picture is drawn.
    pub fn add_one<'a>(&mut self, mut wanted: impl Iterator<Item = &'a SceneSource>, scenery: &mut Scenery) {
        let is_new = |source: &&SceneSource| self.pictures.iter().all(|(known, _)| known != *source);
        if let Some(source) = wanted.find(is_new) {
            let stage = Stage::open(source, &[]).ok();
            self.pictures.push((source.clone(), stage.map(|stage| picture(&stage, scenery))));
        }
    }

    /// Forgets the picture of a file, which may have changed.
    pub fn forget(&mut self, source: &SceneSource) {
        self.pictures.retain(|(known, _)| known != source);
    }

    /// Forgets all: graphics that were lost come back without what was drawn.
    pub fn clear(&mut self) {
        self.pictures.clear();
    }

    /// Shows a picture, if it is drawn, as high as this and with its right edge at a point: its upper right corner.
    pub fn show(&self, source: &SceneSource, corner: Vec2, height: f32) {
        let found = self.pictures.iter().find(|(known, _)| known == source);
        if let Some(target) = found.and_then(|(_, target)| target.as_ref()) {
            let size = Vec2::new(height * SIZE.0 as f32 / SIZE.1 as f32, height);
            let params = DrawTextureParams { dest_size: Some(convert::pair(size)), flip_y: true, ..Default::default() };
            draw_texture_ex(&target.texture, corner.x - size.x, corner.y, WHITE, params);
        }
    }
}

/// What is seen of a scene when it is opened.
fn picture(stage: &Stage, scenery: &mut Scenery) -> RenderTarget {
    let size = Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
    let camera = first_view(stage.world(), stage.player(), FIRST_HEIGHT, size);
    take(stage.world().view(), &camera, Sight::Drawn, scenery)
}

/// A picture of what a camera sees, in its size. Not while another picture is drawn.
pub fn take(view: View<'_>, camera: &Camera, sight: Sight, scenery: &mut Scenery) -> RenderTarget {
    let size = camera.screen();
    let target = render_target(size.x as u32, size.y as u32);
    shot::draw_into(&target, size);
    scenery.paint(&SceneFrame { view, camera, time: 0.0 }, sight, Effort::High);
    set_default_camera();
    target
}
