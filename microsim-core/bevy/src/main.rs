//! A world of microsim in Bevy: the arrow keys, or the left mouse button, steer a cell.
//!
//! The core steps in `FixedUpdate`, and each frame draws the moment between the last two steps as one mesh.

mod convert;
mod picture;

use bevy::camera::ScalingMode;
use bevy::prelude::*;
use bevy::sprite_render::AlphaMode2d;
use convert::{core, scene};
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, Error, Inputs, Intent, Moment, OrganismId, Placement, PlateletSpec, WorldConfig,
};

/// How far ahead of the cell the arrow keys set its goal, units.
const AHEAD: f32 = 20.0;

/// A world, the cell that is steered, and what it is told.
#[derive(Resource)]
struct Slide {
    world: microsim_core::World,
    cell: OrganismId,
    inputs: Inputs,
    /// Before the last step.
    before: Moment,
}

fn main() -> Result<(), Error> {
    let slide = slide()?;
    let config = slide.world.config().clone();
    let (background, step) = (Color::srgb_u8(0xd8, 0xde, 0xd8), Time::<Fixed>::from_seconds(f64::from(config.dt)));
    App::new()
        .add_plugins(DefaultPlugins)
        .insert_resource(ClearColor(background))
        .insert_resource(step)
        .insert_resource(slide)
        .add_systems(Startup, setup)
        .add_systems(Update, steer)
        .add_systems(FixedUpdate, advance)
        .add_systems(PostUpdate, paint)
        .run();
    Ok(())
}

/// A cell among platelets and food.
fn slide() -> Result<Slide, Error> {
    let mut world = microsim_core::World::new(WorldConfig::default())?;
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(30.0, 45.0))?;
    for k in 0..60u8 {
        let (row, column) = (f32::from(k / 10), f32::from(k % 10));
        let (x, y) = (60.0 + 9.0 * column, 15.0 + 12.0 * row);
        world.spawn(&PlateletSpec::default().into(), Placement::at(x, y))?;
        world.spawn(&AgarSpec::default().into(), Placement::at(x + 4.5, y + 6.0))?;
    }
    Ok(Slide { cell, inputs: Inputs::new(), before: world.moment(), world })
}

fn setup(
    mut commands: Commands,
    slide: Res<Slide>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<ColorMaterial>>,
) {
    let size = slide.world.config().size;
    let scaling_mode = ScalingMode::AutoMin { min_width: size.x, min_height: size.y };
    let projection = OrthographicProjection { scaling_mode, ..OrthographicProjection::default_2d() };
    let centre = Transform::from_translation(scene(0.5 * size).extend(0.0));
    commands.spawn((Camera2d, Projection::Orthographic(projection), centre));
    let material = ColorMaterial { alpha_mode: AlphaMode2d::Blend, ..ColorMaterial::default() };
    let mesh = picture::mesh(slide.world.view());
    commands.spawn((Mesh2d(meshes.add(mesh)), MeshMaterial2d(materials.add(material))));
}

/// Tells the cell where to go: towards the cursor while the button is down, or as the arrow keys say.
fn steer(
    mut slide: ResMut<Slide>,
    keys: Res<ButtonInput<KeyCode>>,
    buttons: Res<ButtonInput<MouseButton>>,
    window: Single<&Window>,
    camera: Single<(&Camera, &GlobalTransform)>,
) {
    let (camera, place) = *camera;
    let cursor = window.cursor_position().filter(|_| buttons.pressed(MouseButton::Left));
    let at = cursor.and_then(|at| camera.viewport_to_world_2d(place, at).ok()).map(core);
    let axis = |less, more| f32::from(keys.pressed(more)) - f32::from(keys.pressed(less));
    let way = Vec2::new(axis(KeyCode::ArrowLeft, KeyCode::ArrowRight), axis(KeyCode::ArrowDown, KeyCode::ArrowUp));
    let Slide { world, cell, inputs, .. } = &mut *slide;
    let ahead = world.centroid(*cell).filter(|_| way != Vec2::ZERO).map(|centre| centre + core(AHEAD * way));
    // A goal is refused only if it is no number.
    let intent = at.or(ahead).and_then(|goal| Intent::toward(goal).ok());
    inputs.set(*cell, intent.unwrap_or(Intent::REST));
}

fn advance(mut slide: ResMut<Slide>) {
    let Slide { world, inputs, before, .. } = &mut *slide;
    *before = world.moment();
    world.step(inputs);
}

fn paint(slide: Res<Slide>, time: Res<Time<Fixed>>, shown: Single<&Mesh2d>, mut meshes: ResMut<Assets<Mesh>>) {
    if let Some(mut mesh) = meshes.get_mut(&shown.0) {
        *mesh = picture::mesh(slide.world.view_since(&slide.before, time.overstep_fraction()));
    }
}
