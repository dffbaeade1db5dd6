//! Things on the slide, as triangles.

use super::program::Program;
use super::texture::{Map, TextureInput};
use glam::Vec2;

/// Most vertices of one draw: its indices have 16 bits.
const MOST_VERTICES: usize = 60_000;
/// Triangles of four corners in turn.
pub(in crate::microscope) const QUAD: [u16; 6] = [0, 1, 2, 0, 2, 3];

/// Some triangles of one program.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// How.
    pub program: Program,
    /// Whether what is drawn is taken from the target instead of added to it. [`Program::covers`] says which programs do
    /// neither.
    pub is_subtracted: bool,
    /// Numbers of each vertex in turn, in the order of [`super::GlslSource::attributes`].
    pub vertices: Vec<f32>,
    /// Three for each triangle.
    pub indices: Vec<u16>,
    /// Its own, after those that all share.
    pub uniforms: Vec<f32>,
    /// In the order of [`super::GlslSource::textures`].
    pub inputs: Vec<TextureInput>,
}

/// Collects what there is to draw.
#[derive(Clone, Debug)]
pub(in crate::microscope) struct DrawList {
    bounds: (Vec2, Vec2),
    pixel: f32,
    pub draws: Vec<Draw>,
    pub maps: Vec<Map>,
}

impl DrawList {
    pub(in crate::microscope) fn new(bounds: (Vec2, Vec2), pixel: f32) -> Self {
        Self { bounds, pixel, draws: Vec::new(), maps: Vec::new() }
    }

    /// Lower left and upper right corner of what can be seen, micrometres.
    pub(in crate::microscope) fn bounds(&self) -> (Vec2, Vec2) {
        self.bounds
    }

    /// Side of the smallest pixel that is drawn on, micrometres.
    pub(in crate::microscope) fn pixel(&self) -> f32 {
        self.pixel
    }

    /// Whether something around a place may be seen.
    pub(in crate::microscope) fn sees(&self, place: Vec2, radius: f32) -> bool {
        let (low, high) = self.bounds;
        let beyond = Vec2::splat(radius + 2.0 * self.pixel);
        place.cmpgt(low - beyond).all() && place.cmplt(high + beyond).all()
    }

    /// Adds triangles to those of the same program.
    pub(in crate::microscope) fn add(
        &mut self,
        program: Program,
        is_subtracted: bool,
        vertices: &[f32],
        indices: impl IntoIterator<Item = u16>,
    ) {
        let stride = program.floats_per_vertex();
        let has_room = |draw: &Draw| {
            let count = (draw.vertices.len() + vertices.len()) / stride;
            draw.program == program && draw.is_subtracted == is_subtracted && count <= MOST_VERTICES
        };
        let place = self.draws.iter().rposition(has_room).unwrap_or_else(|| {
            self.draws.push(Draw::of(program, is_subtracted));
            self.draws.len() - 1
        });
        let draw = &mut self.draws[place];
        let first = (draw.vertices.len() / stride) as u16;
        draw.vertices.extend_from_slice(vertices);
        draw.indices.extend(indices.into_iter().map(|index| first + index));
    }

    /// Adds triangles with uniforms of their own, and with a map and the uniforms that say where it lies.
    pub(in crate::microscope) fn add_apart(
        &mut self,
        program: Program,
        vertices: &[f32],
        indices: Vec<u16>,
        uniforms: Vec<f32>,
        map: Option<(Map, [f32; 7])>,
    ) {
        let mut draw = Draw { vertices: vertices.to_vec(), indices, ..Draw::of(program, false) };
        if let Some((map, place)) = map {
            draw.inputs.push(TextureInput::Map(self.maps.len()));
            draw.uniforms.extend(place);
            self.maps.push(map);
        }
        draw.uniforms.extend(uniforms);
        self.draws.push(draw);
    }
}

impl Draw {
    fn of(program: Program, is_subtracted: bool) -> Self {
        let inputs = vec![TextureInput::Noise];
        Self { program, is_subtracted, vertices: Vec::new(), indices: Vec::new(), uniforms: Vec::new(), inputs }
    }
}

/// The four corners of a box, for [`QUAD`].
pub(in crate::microscope) fn box_corners(low: Vec2, high: Vec2) -> Vec<f32> {
    vec![low.x, low.y, high.x, low.y, high.x, high.y, low.x, high.y]
}
