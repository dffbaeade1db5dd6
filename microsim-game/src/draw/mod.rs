//! Drawing: a view in, triangles out. Everything goes through one canvas, in picture pixels.

mod amoeba;
mod atlas;
mod background;
pub(crate) mod canvas;
mod obstacle;
pub(crate) mod palette;
mod simple;
mod soft_body;

use crate::camera::Camera;
use background::Background;
use canvas::Canvas;
use macroquad::window::clear_background;
use microsim_core::glam::Vec2;
use microsim_core::{Kind, OrganismView, View};

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
    pub fn paint(&mut self, frame: &SceneFrame<'_>) {
        clear_background(palette::SLIDE);
        let canvas = &mut self.canvas;
        self.background.draw(canvas, frame.camera, frame.time);
        obstacle::draw_all(canvas, frame.camera, frame.view.world());
        let seen: Vec<OrganismView<'_>> = frame.view.organisms().filter(|&organism| is_seen(frame, organism)).collect();
        // All halos below all bodies: they must not veil what a cell touches.
        seen.iter().for_each(|&organism| draw_halo(canvas, frame, organism));
        for is_in_layer in LAYERS {
            let organisms = seen.iter().filter(|organism| is_in_layer(organism.kind()));
            organisms.for_each(|&organism| draw_organism(canvas, frame, organism));
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

fn draw_halo(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    match organism.kind() {
        Kind::AmoeboidCell => amoeba::draw_halo(canvas, frame, organism),
        Kind::RigidCell | Kind::Platelet | Kind::RedCell => soft_body::draw_halo(canvas, frame, organism),
        Kind::FluidBlock => {}
        _ => simple::draw_halo(canvas, frame, organism),
    }
}

fn draw_organism(canvas: &mut Canvas, frame: &SceneFrame<'_>, organism: OrganismView<'_>) {
    match organism.kind() {
        Kind::AmoeboidCell => amoeba::draw(canvas, frame, organism),
        Kind::RigidCell => soft_body::draw_rigid_cell(canvas, frame, organism),
        Kind::Platelet => soft_body::draw_platelet(canvas, frame, organism),
        Kind::RedCell => soft_body::draw_red_cell(canvas, frame, organism),
        Kind::Coccus | Kind::Bacillus => simple::draw_bacterium(canvas, frame, organism),
        Kind::Agar => simple::draw_agar(canvas, frame, organism),
        Kind::Probe => simple::draw_probe(canvas, frame, organism),
        Kind::FluidBlock => simple::draw_fluid(canvas, frame, organism),
        _ => simple::draw_discs(canvas, frame, organism),
    }
}

/// Whether any of it may lie in the picture.
fn is_seen(frame: &SceneFrame<'_>, organism: OrganismView<'_>) -> bool {
    let (camera, margin, (low, high)) = (frame.camera, 12.0, organism.bounds());
    let (upper_left, lower_right) =
        (camera.to_screen(Vec2::new(low.x, high.y)), camera.to_screen(Vec2::new(high.x, low.y)));
    lower_right.cmpgt(Vec2::splat(-margin)).all() && upper_left.cmplt(camera.screen() + margin).all()
}

#[cfg(test)]
mod tests {
    use super::atlas::Tile;
    use super::palette::{CELL_BODY, CYTOPLASM, GROWN, fade};
    use super::*;
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

    /// What is drawn of an organism.
    fn drawn(world: &World, id: OrganismId) -> Canvas {
        let (mut canvas, camera) = (Canvas::bare(), camera(world));
        let frame = SceneFrame { view: world.view(), camera: &camera, time: 0.0 };
        draw_organism(&mut canvas, &frame, frame.view.organism(id).unwrap());
        canvas
    }

    #[test]
    fn t51_soft_bodies_are_a_textured_fan_from_the_nucleus_over_the_surface() {
        let (world, id) = world_with(RigidCellSpec::default());
        let (canvas, camera, cell) = (drawn(&world, id), camera(&world), world.view().organism(id).unwrap());
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
        let (canvas, camera) = (drawn(&world, id), camera(&world));
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
        let (canvas, cell) = (drawn(&world, id), world.view().organism(id).unwrap());
        assert_eq!(canvas.count(fade(CELL_BODY, 0.80)), cell.outline().len());
        let particles = cell.particles().filter(|particle| particle.role == Role::Cytoplasm).count();
        assert_eq!(canvas.count(fade(CYTOPLASM, 0.42)), 4 * particles);
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
        assert_eq!(drawn(&world, id).count(fade(GROWN, 0.42)), 0);
        world.grow(id, 2, 30).unwrap();
        (0..240).for_each(|_| world.step(&microsim_core::Inputs::new()));
        let cell = world.view().organism(id).unwrap();
        let of = |role| cell.particles().filter(|particle| particle.role == role).count();
        let canvas = drawn(&world, id);
        assert!(of(Role::GrownCytoplasm) > 0);
        assert_eq!(canvas.count(fade(GROWN, 0.42)), 4 * of(Role::GrownCytoplasm));
        assert_eq!(canvas.count(fade(CYTOPLASM, 0.42)), 4 * of(Role::Cytoplasm));
        let apart = [GROWN.r - CYTOPLASM.r, GROWN.g - CYTOPLASM.g, GROWN.b - CYTOPLASM.b].map(f32::abs);
        assert!(apart.iter().sum::<f32>() > 0.2, "{apart:?}");
    }
}
