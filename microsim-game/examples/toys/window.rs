//! The window of the toys: a loop of fixed steps, and plain drawing.

use super::{Act, Keys};
use macroquad::input::{KeyCode, is_key_down};
use macroquad::prelude::{Camera2D, Color, Conf, Vec2 as Pair};
use macroquad::{camera, shapes, texture, time, window};
use microsim_core::drawing::shape::{Colour, Geometry, Item, Paint};
use microsim_core::drawing::{DrawingLayer, draw};
use microsim_core::geometry::triangulate;
use microsim_core::prelude::*;
use microsim_game::convert::pair;

/// Frames before a picture is written: half a minute.
const FRAMES: u32 = 1800;
/// Most steps for a frame: what is slower than that runs in slow motion.
const MOST_STEPS: u32 = 4;

/// Opens a window on a world; with the name of a file, writes a picture there of the world after half a minute, and ends.
pub(crate) fn run(title: &str, world: World, act: Act, picture: Option<String>) {
    let size = world.config().size;
    let conf = Conf {
        window_title: title.to_owned(),
        window_width: 960,
        window_height: (960.0 * size.y / size.x) as i32,
        ..Conf::default()
    };
    macroquad::Window::from_config(conf, async move {
        if let Err(error) = play(world, act, picture).await {
            eprintln!("{error}");
        }
    });
}

async fn play(mut world: World, mut act: Act, picture: Option<String>) -> Result<(), Error> {
    let (mut inputs, mut before, mut owed) = (Inputs::new(), world.moment(), 0.0);
    for frame in 0.. {
        owed += if picture.is_some() { world.config().dt } else { time::get_frame_time() };
        owed = owed.min(MOST_STEPS as f32 * world.config().dt);
        while owed >= world.config().dt {
            before = world.moment();
            act(&mut world, &mut inputs, keys())?;
            world.step(&inputs);
            owed -= world.config().dt;
        }
        if picture.is_some() && frame < FRAMES {
            continue;
        }
        paint(world.view_since(&before, owed / world.config().dt));
        if let Some(file) = picture {
            texture::get_screen_data().export_png(&file);
            return Ok(());
        }
        window::next_frame().await;
    }
    Ok(())
}

fn keys() -> Keys {
    let jump = is_key_down(KeyCode::Space) || is_key_down(KeyCode::Up);
    Keys { left: is_key_down(KeyCode::Left), right: is_key_down(KeyCode::Right), jump }
}

/// The room upright and whole, obstacles, organisms and joints.
fn paint(view: View<'_>) {
    let size = view.world().config().size;
    let zoom = Pair::new(2.0 / size.x, -2.0 / size.y);
    camera::set_camera(&Camera2D { target: pair(0.5 * size), zoom, ..Camera2D::default() });
    let layers = [DrawingLayer::Room, DrawingLayer::Obstacles, DrawingLayer::Organisms];
    draw(view, [Vec2::ZERO, size], &layers).iter().for_each(item);
    for joint in view.world().joints() {
        line(&joint.ends, false, 0.2, Color::new(0.3, 0.3, 0.3, 1.0));
    }
}

fn item(item: &Item) {
    let fill = item.fill.map(|paint| match paint {
        Paint::Flat(colour) | Paint::Radial { outer: colour, .. } => rgba(colour),
    });
    let stroke = item.stroke.map(|stroke| (stroke.width, rgba(stroke.colour)));
    let path = |points: &[Vec2], is_closed: bool| {
        fill.filter(|_| is_closed).into_iter().for_each(|colour| area(points, colour));
        stroke.into_iter().for_each(|(width, colour)| line(points, is_closed, width, colour));
    };
    match &item.geometry {
        Geometry::Discs(discs) => {
            for &(at, radius) in discs {
                let colour = fill.or(stroke.map(|(_, colour)| colour)).unwrap_or_default();
                shapes::draw_circle(at.x, at.y, radius, colour);
            }
        }
        Geometry::Outline(points) => path(points, true),
        Geometry::Curve(points) => path(points, false),
        Geometry::Polygons(paths) => paths.iter().for_each(|points| path(points, true)),
        Geometry::Lines(paths) => paths.iter().for_each(|points| path(points, false)),
    }
}

fn area(points: &[Vec2], colour: Color) {
    for corners in triangulate(points) {
        let [a, b, c] = corners.map(|k| pair(points[k as usize]));
        shapes::draw_triangle(a, b, c, colour);
    }
}

fn line(points: &[Vec2], is_closed: bool, width: f32, colour: Color) {
    let next = points.iter().skip(1).chain(points.first().filter(|_| is_closed));
    for (a, b) in points.iter().zip(next) {
        shapes::draw_line(a.x, a.y, b.x, b.y, width, colour);
    }
}

fn rgba(Colour { red, green, blue, alpha }: Colour) -> Color {
    Color::from_rgba(red, green, blue, (alpha * 255.0) as u8)
}
