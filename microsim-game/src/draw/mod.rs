//! The drawn view: the core's drawing of a world in, triangles out. Everything goes through one canvas, in picture
//! pixels.

mod atlas;
mod background;
pub(crate) mod canvas;
mod cell;
mod frame;
mod item;
pub(crate) mod palette;
mod plain;

pub use frame::SceneFrame;

use background::Background;
use canvas::Canvas;
use macroquad::window::clear_background;
use microsim_core::drawing::{self, DrawingLayer};
use microsim_core::glam::Vec2;

/// Draws frames. Holds the textures.
#[derive(Debug)]
pub struct Painter {
    canvas: Canvas,
    background: Background,
}

/// The layers that are painted; chemicals are part of the debug view.
const LAYERS: [DrawingLayer; 4] =
    [DrawingLayer::Halos, DrawingLayer::Obstacles, DrawingLayer::Organisms, DrawingLayer::Walls];
/// How far beyond the picture halos and hairs reach into it, pixels.
const REACH: f32 = 12.0;

impl Painter {
    /// Makes the textures. Needs an open window.
    #[must_use]
    pub fn new() -> Self {
        Self { canvas: Canvas::new(), background: Background::new() }
    }

    /// Draws a frame with the present camera.
    pub fn paint(&mut self, frame: &SceneFrame<'_>) {
        clear_background(palette::scene(palette::SLIDE));
        let canvas = &mut self.canvas;
        self.background.draw(canvas, frame.camera, frame.time);
        paint_world(canvas, frame);
        background::draw_film(canvas, frame.camera.screen());
        canvas.flush();
    }
}

impl Default for Painter {
    fn default() -> Self {
        Self::new()
    }
}

fn paint_world(canvas: &mut Canvas, frame: &SceneFrame<'_>) {
    let (camera, reach) = (frame.camera, Vec2::splat(REACH));
    let (upper_left, lower_right) = (camera.to_room(-reach), camera.to_room(camera.screen() + reach));
    let window = [Vec2::new(upper_left.x, lower_right.y), Vec2::new(lower_right.x, upper_left.y)];
    drawing::draw(frame.view, window, &LAYERS).iter().for_each(|item| item::paint(canvas, frame, item));
}

#[cfg(test)]
mod tests {
    use super::atlas::Tile;
    use super::palette::scene;
    use super::*;
    use crate::camera::Camera;
    use microsim_core::drawing::palette::GROWN;
    use microsim_core::{
        AmoeboidCellSpec, OrganismId, OrganismSpec, Placement, RigidCellSpec, Role, World, WorldConfig,
    };

    fn world_with(spec: impl Into<OrganismSpec>) -> (World, OrganismId) {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let id = world.spawn(&spec.into(), Placement::at(60.0, 40.0)).unwrap();
        (world, id)
    }

    fn camera(world: &World) -> Camera {
        Camera::whole(world.config().size, Vec2::new(1280.0, 720.0))
    }

    /// What is drawn of a world.
    fn drawn(world: &World) -> Canvas {
        let (mut canvas, camera) = (Canvas::bare(), camera(world));
        let frame = SceneFrame { view: world.view(), camera: &camera, time: 0.0 };
        paint_world(&mut canvas, &frame);
        canvas
    }

    #[test]
    fn t51_soft_bodies_are_a_textured_fan_from_the_nucleus_over_the_surface() {
        let (world, id) = world_with(RigidCellSpec::default());
        let (canvas, camera, cell) = (drawn(&world), camera(&world), world.view().organism(id).unwrap());
        let (low, high) = (Tile::Cell.at(Vec2::NEG_ONE), Tile::Cell.at(Vec2::ONE));
        let of_texture = |uv: Vec2| uv.cmpge(low).all() && uv.cmple(high).all();
        let fan: Vec<Vec2> = canvas.corners().filter(|(_, uv, _)| of_texture(*uv)).map(|(at, ..)| at).collect();
        let surface = cell.surface();
        assert_eq!(fan.len(), surface.len() + 2, "a hub, and the first corner again at the end");
        assert_eq!(fan[0], camera.to_screen(cell.nucleus().unwrap().position));
        assert!(fan[1..].iter().zip(&surface).all(|(drawn, at)| *drawn == camera.to_screen(*at)));
    }

    #[test]
    fn t53_the_nucleus_is_a_sprite_of_its_own() {
        let (world, id) = world_with(RigidCellSpec::default());
        let (canvas, camera) = (drawn(&world), camera(&world));
        let nucleus = world.view().organism(id).unwrap().nucleus().unwrap();
        let (at, reach) = (camera.to_screen(nucleus.position), nucleus.radius * camera.scale());
        for corner in [Vec2::NEG_ONE, Vec2::ONE] {
            let is_corner = |(place, uv, _): &(Vec2, Vec2, _)| {
                (*place - at - corner * reach).length() < 1e-2 && *uv == Tile::Disc.at(corner)
            };
            assert!(canvas.corners().any(|drawn| is_corner(&drawn)));
        }
    }

    #[test]
    fn t54_t55_amoeboid_cells_are_a_filled_outline_with_a_soft_spot_for_each_particle() {
        let (world, id) = world_with(AmoeboidCellSpec::default());
        let (canvas, cell) = (drawn(&world), world.view().organism(id).unwrap());
        assert_eq!(canvas.count(scene(cell.drawn_look().tint.outer.faded(0.62))), cell.outline().len());
        let particles = cell.particles().filter(|particle| particle.role == Role::Cytoplasm).count();
        assert_eq!(canvas.count(scene(cell.drawn_look().tint.detail.faded(0.2))), 4 * particles);
    }

    #[test]
    fn t56_the_background_drifts_and_lies_deeper_than_the_scene() {
        let (world, _) = world_with(RigidCellSpec::default());
        let size = world.config().size;
        let places = |centre: Vec2, time: f32| {
            let mut canvas = Canvas::bare();
            let camera = Camera::around(centre, 40.0, size, Vec2::new(1280.0, 720.0));
            Background::new().draw(&mut canvas, &camera, time);
            canvas.corners().map(|(at, ..)| at).collect::<Vec<_>>()
        };
        let before = places(0.5 * size, 0.0);
        assert!(before.len() > 40 && before != places(0.5 * size, 2.0));
        // As far as a thing in the scene moves, pixels.
        let scene = 720.0 / 40.0 * 0.5;
        let moved = places(0.5 * size + Vec2::new(0.5, 0.0), 0.0);
        let is_slower = |from: &&Vec2| {
            let shift = |to: &Vec2| (from.x - to.x) / scene;
            moved.iter().any(|to| (from.y - to.y).abs() < 0.1 && (0.5..=1.01).contains(&shift(to)))
        };
        assert!(before.iter().filter(is_slower).count() > before.len() * 9 / 10);
    }

    #[test]
    fn t72_new_particles_have_another_colour_than_the_first_ones() {
        let (mut world, id) = world_with(AmoeboidCellSpec::default());
        assert_eq!(drawn(&world).count(scene(GROWN.faded(0.2))), 0);
        world.grow(id, 2, 30).unwrap();
        (0..240).for_each(|_| world.step(&microsim_core::Inputs::new()));
        let cell = world.view().organism(id).unwrap();
        let of = |role| cell.particles().filter(|particle| particle.role == role).count();
        let canvas = drawn(&world);
        assert!(of(Role::GrownCytoplasm) > 0);
        assert_eq!(canvas.count(scene(GROWN.faded(0.2))), 4 * of(Role::GrownCytoplasm));
        assert_eq!(canvas.count(scene(cell.drawn_look().tint.detail.faded(0.2))), 4 * of(Role::Cytoplasm));
        let [new, old] = [scene(GROWN), scene(cell.drawn_look().tint.detail)];
        let apart = [new.r - old.r, new.g - old.g, new.b - old.b].map(f32::abs);
        assert!(apart.iter().sum::<f32>() > 0.2, "{apart:?}");
    }
}
