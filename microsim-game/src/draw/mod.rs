//! Drawing: pictures in, triangles out. Everything goes through one canvas, in picture pixels.

mod amoeba;
mod atlas;
mod background;
pub(crate) mod canvas;
mod obstacle;
pub(crate) mod palette;
mod simple;
mod soft_body;

use crate::camera::Camera;
use crate::picture::{Picture, Shape};
use background::Background;
use canvas::Canvas;
use microsim_core::glam::Vec2;
use microsim_core::{Kind, World};

/// What is drawn in one frame.
#[derive(Debug)]
pub struct Frame<'a> {
    /// The organisms.
    pub picture: &'a Picture,
    /// For the obstacles and the room.
    pub world: &'a World,
    /// What is seen of them.
    pub camera: &'a Camera,
    /// For what moves in the scenery, s.
    pub time: f32,
}

/// Draws frames. Holds the textures.
#[derive(Debug)]
pub struct Painter {
    canvas: Canvas,
    background: Background,
}

/// Kinds from the bottom of the slide to its top: what is eaten lies below what eats it.
const LAYERS: [fn(Kind) -> bool; 4] = [
    |kind| kind == Kind::FluidBlock,
    |kind| matches!(kind, Kind::Platelet | Kind::RedCell),
    |kind| !matches!(kind, Kind::FluidBlock | Kind::Platelet | Kind::RedCell | Kind::AmoeboidCell),
    |kind| kind == Kind::AmoeboidCell,
];

impl Painter {
    /// Makes the textures. Needs an open window.
    #[must_use]
    pub fn new() -> Self {
        Self { canvas: Canvas::new(), background: Background::new() }
    }

    /// Draws a frame with the present camera.
    pub fn paint(&mut self, frame: &Frame<'_>) {
        let canvas = &mut self.canvas;
        self.background.draw(canvas, frame.camera, frame.time);
        obstacle::draw_all(canvas, frame.camera, frame.world);
        let seen: Vec<&Shape> = frame.picture.shapes.iter().filter(|shape| is_seen(frame, shape)).collect();
        // All halos below all bodies: they must not veil what a cell touches.
        seen.iter().for_each(|shape| draw_halo(canvas, frame, shape));
        for is_in_layer in LAYERS {
            let shapes = seen.iter().filter(|shape| is_in_layer(shape.kind));
            shapes.for_each(|shape| draw_shape(canvas, frame, shape));
        }
        obstacle::draw_walls(canvas, frame.camera);
        background::draw_film(canvas, frame.camera.screen());
        canvas.flush();
    }
}

impl Default for Painter {
    fn default() -> Self {
        Self::new()
    }
}

fn draw_halo(canvas: &mut Canvas, frame: &Frame<'_>, shape: &Shape) {
    match shape.kind {
        Kind::AmoeboidCell => amoeba::draw_halo(canvas, frame, shape),
        Kind::RigidCell | Kind::Platelet | Kind::RedCell => soft_body::draw_halo(canvas, frame, shape),
        Kind::FluidBlock => {}
        _ => simple::draw_halo(canvas, frame, shape),
    }
}

fn draw_shape(canvas: &mut Canvas, frame: &Frame<'_>, shape: &Shape) {
    match shape.kind {
        Kind::AmoeboidCell => amoeba::draw(canvas, frame, shape),
        Kind::RigidCell => soft_body::draw_rigid_cell(canvas, frame, shape),
        Kind::Platelet => soft_body::draw_platelet(canvas, frame, shape),
        Kind::RedCell => soft_body::draw_red_cell(canvas, frame, shape),
        Kind::Coccus | Kind::Bacillus => simple::draw_bacterium(canvas, frame, shape),
        Kind::Agar => simple::draw_agar(canvas, frame, shape),
        Kind::Probe => simple::draw_probe(canvas, frame, shape),
        Kind::FluidBlock => simple::draw_fluid(canvas, frame, shape),
        _ => simple::draw_discs(canvas, frame, shape),
    }
}

/// Whether any of it may lie in the picture.
fn is_seen(frame: &Frame<'_>, shape: &Shape) -> bool {
    let (camera, margin) = (frame.camera, 12.0);
    let (mut low, mut high) = (Vec2::MAX, Vec2::MIN);
    for (at, disc) in frame.picture.discs(shape) {
        low = low.min(at - disc.radius);
        high = high.max(at + disc.radius);
    }
    let (upper_left, lower_right) =
        (camera.to_screen(Vec2::new(low.x, high.y)), camera.to_screen(Vec2::new(high.x, low.y)));
    lower_right.cmpgt(Vec2::splat(-margin)).all() && upper_left.cmplt(camera.screen() + margin).all()
}
