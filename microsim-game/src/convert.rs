//! The only place where the core's vectors meet macroquad's: the two come from different versions of glam.

use macroquad::color::Color;
use macroquad::models::Vertex;
use microsim_core::glam::Vec2;

/// A vertex of a flat mesh.
#[must_use]
pub fn vertex(position: Vec2, uv: Vec2, colour: Color) -> Vertex {
    Vertex::new(position.x, position.y, 0.0, uv.x, uv.y, colour)
}

/// A point that macroquad gives as a pair.
#[must_use]
pub fn point((x, y): (f32, f32)) -> Vec2 {
    Vec2::new(x, y)
}

/// A vector as macroquad's.
#[must_use]
pub fn pair(vector: Vec2) -> macroquad::math::Vec2 {
    macroquad::math::Vec2::from(vector.to_array())
}
