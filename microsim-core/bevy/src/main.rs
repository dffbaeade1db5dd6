//! A cell among platelets in Bevy: hold the left mouse button to crawl towards the cursor.
//!
//! The world is a resource that takes fixed steps; drawing reads the moment between the last two.

use bevy::math::Vec2 as Place;
use bevy::prelude::*;
use microsim_core::prelude as microsim;
use microsim_core::prelude::{AmoeboidCellSpec, CoccusSpec, Intent, OrganismId, Placement, PlateletSpec};
use microsim_core::{Moment, Rng};

/// Pixels of a unit.
const SCALE: f32 = 8.0;

/// The world, what it looked like a step ago, and the cell that the mouse steers.
#[derive(Resource)]
struct Slide {
    world: microsim::World,
    before: Moment,
    cell: OrganismId,
    goal: Option<microsim::Vec2>,
}

fn main() -> Result<(), microsim::Error> {
    let slide = slide()?;
    let size = slide.world.config().size * SCALE;
    let window = Window { title: "microsim".into(), resolution: (size.x as u32, size.y as u32).into(), ..default() };
    let dt = f64::from(slide.world.config().dt);
    App::new()
        .add_plugins(DefaultPlugins.set(WindowPlugin { primary_window: Some(window), ..default() }))
        .insert_resource(Time::<Fixed>::from_seconds(dt))
        .insert_resource(ClearColor(Color::srgb(0.93, 0.92, 0.88)))
        .insert_resource(slide)
        .add_systems(Startup, |mut commands: Commands| _ = commands.spawn(Camera2d))
        .add_systems(FixedUpdate, step)
        .add_systems(Update, (steer, draw))
        .run();
    Ok(())
}

/// A cell, platelets in its way, and bacteria to eat.
fn slide() -> Result<Slide, microsim::Error> {
    let mut world = microsim::World::new(microsim::WorldConfig::default())?;
    let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(25.0, 45.0))?;
    let mut rng = Rng::new(7, 1);
    for k in 0..60 {
        let at = Placement::at(rng.range(40.0, 155.0), rng.range(5.0, 85.0));
        let spec = if k % 3 == 0 { CoccusSpec::default().into() } else { PlateletSpec::default().into() };
        // A place that is taken stays as it is.
        let _ = world.spawn(&spec, at);
    }
    Ok(Slide { before: world.moment(), world, cell, goal: None })
}

/// Takes the mouse's place in the world as the goal while its button is held.
fn steer(
    mut slide: ResMut<Slide>,
    buttons: Res<ButtonInput<MouseButton>>,
    window: Single<&Window>,
    camera: Single<(&Camera, &GlobalTransform)>,
) {
    let (camera, transform) = *camera;
    let cursor = window.cursor_position().filter(|_| buttons.pressed(MouseButton::Left));
    let place = cursor.and_then(|cursor| camera.viewport_to_world_2d(transform, cursor).ok());
    slide.goal = place.map(|place| from_screen(place, &slide.world));
}

fn step(mut slide: ResMut<Slide>) {
    let mut inputs = microsim::Inputs::new();
    if let Some(Ok(intent)) = slide.goal.map(Intent::toward) {
        inputs.set(slide.cell, intent);
    }
    slide.before = slide.world.moment();
    slide.world.step(&inputs);
}

/// The outlines of all organisms between the last two steps, and the discs of those that have none.
fn draw(slide: Res<Slide>, time: Res<Time<Fixed>>, mut gizmos: Gizmos) {
    let view = slide.world.view_since(&slide.before, time.overstep_fraction());
    let place = |at| to_screen(at, &slide.world);
    for organism in view.organisms() {
        let colour = if organism.id() == slide.cell { Color::srgb(0.1, 0.4, 0.7) } else { Color::srgb(0.45, 0.3, 0.3) };
        let surface = organism.surface();
        if surface.is_empty() {
            for disc in organism.particles() {
                gizmos.circle_2d(place(disc.position), disc.radius * SCALE, colour);
            }
        }
        gizmos.linestrip_2d(surface.iter().chain(surface.first()).map(|&at| place(at)), colour);
    }
}

/// Bevy has its origin in the middle of the window, and another version of glam: the two conversions.
fn to_screen(at: microsim::Vec2, world: &microsim::World) -> Place {
    Place::from(((at - 0.5 * world.config().size) * SCALE).to_array())
}

fn from_screen(at: Place, world: &microsim::World) -> microsim::Vec2 {
    microsim::Vec2::from(at.to_array()) / SCALE + 0.5 * world.config().size
}
