//! Pictures of the microscope, made by the graphics card: carries out the core's recipes.
//!
//! ```no_run
//! # use microsim_core::microscope::{Field, Film, Microscope, Optics};
//! # use microsim_game::microscope::{RenderQuality, Renderer};
//! # fn frame(world: &microsim_core::World, field: Field) -> Result<(), String> {
//! let mut renderer = Renderer::new()?; // once, with an open window
//! let microscope = Microscope { optics: Optics::DIC, film: Film::CINE };
//! let recipe = renderer.recipe(world.view(), field, microscope, RenderQuality::High)?;
//! let picture = renderer.draw(&recipe);
//! renderer.show(&picture, 0.0, 0.0, 1280.0, 720.0);
//! # Ok(())
//! # }
//! ```

mod pipelines;
mod targets;

use crate::platform;
use macroquad::color::WHITE;
use macroquad::math::vec2;
use macroquad::miniquad::{BufferId, BufferSource, BufferType, BufferUsage, PassAction, RenderingBackend, TextureId};
use macroquad::texture::{DrawTextureParams, Texture2D, draw_texture_ex};
use macroquad::window::get_internal_gl;
use microsim_core::View;
use microsim_core::microscope::recipe::{
    Card, Draw, Map, PassContent, Precision, Program, RenderRecipe, RenderTarget, TextureInput, noise_table,
};
use microsim_core::microscope::{Field, Microscope};
use pipelines::Pipelines;
use std::fmt;
use targets::Targets;

/// How much of the machine pictures may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RenderQuality {
    /// A quarter of the pixels, and no blur: for graphics in software.
    Low,
    /// Half of the pixels.
    Medium,
    /// As it is meant.
    #[default]
    High,
}

impl RenderQuality {
    fn card(self, precision: Precision) -> Card {
        match self {
            Self::Low => Card { precision, detail: 0.5, is_soft: false },
            Self::Medium => Card { precision, detail: 0.7, is_soft: true },
            Self::High => Card { precision, ..Card::FULL },
        }
    }
}

/// Draws pictures; holds programs, textures and buffers.
pub struct Renderer {
    precision: Precision,
    pipelines: Pipelines,
    targets: Targets,
    noise: TextureId,
    maps: Vec<TextureId>,
    /// Corners of a whole target.
    square: Mesh,
    draws: Vec<Mesh>,
}

impl fmt::Debug for Renderer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Renderer").field("precision", &self.precision).finish_non_exhaustive()
    }
}

impl Renderer {
    /// Builds the programs. Needs an open window.
    ///
    /// # Errors
    /// What the graphics driver says of a program that it does not take.
    pub fn new() -> Result<Self, String> {
        let card = card();
        Self::with_precision(if platform::has_float_targets(&card.info().gl_version_string) {
            Precision::Float
        } else {
            Precision::Bytes
        })
    }

    /// The same with targets of a given kind.
    ///
    /// # Errors
    /// See [`Renderer::new`].
    pub fn with_precision(precision: Precision) -> Result<Self, String> {
        let card = card();
        let (side, bytes) = noise_table();
        let noise = targets::repeating(card, side, &bytes);
        let corners = [-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0_f32];
        let mut square = Mesh::empty(card);
        square.fill(card, &corners, &[0, 1, 2, 0, 2, 3]);
        let pipelines = Pipelines::new(card)?;
        Ok(Self {
            precision,
            pipelines,
            targets: Targets::default(),
            noise,
            maps: Vec::new(),
            square,
            draws: Vec::new(),
        })
    }

    /// What this renderer has to do for a picture of as many pixels as the field says.
    ///
    /// # Errors
    /// Which number of the field or the film is out of range.
    pub fn recipe(
        &self,
        view: View<'_>,
        field: Field,
        microscope: Microscope,
        quality: RenderQuality,
    ) -> Result<RenderRecipe, String> {
        microscope.recipe(view, field, quality.card(self.precision)).map_err(|error| error.to_string())
    }

    /// Shows a picture in the window, in macroquad's units.
    pub fn show(&self, picture: &Texture2D, left: f32, top: f32, width: f32, height: f32) {
        // The lowest row comes first.
        let params = DrawTextureParams { dest_size: Some(vec2(width, height)), flip_y: true, ..Default::default() };
        draw_texture_ex(picture, left, top, WHITE, params);
    }

    /// Draws a picture. The texture is the renderer's own and shows the next picture once that is drawn.
    pub fn draw(&mut self, recipe: &RenderRecipe) -> Texture2D {
        let card = card();
        self.upload(card, recipe);
        for pass in &recipe.passes {
            let is_float = pass.target.is_float() && self.precision == Precision::Float;
            let target = self.targets.prepare(card, pass.target, pass.size, is_float);
            card.begin_pass(Some(target), PassAction::Nothing);
            match &pass.content {
                PassContent::Draws(common) => {
                    for (draw, mesh) in recipe.draws.iter().zip(&self.draws) {
                        let uniforms = [common.as_slice(), &draw.uniforms].concat();
                        self.run(card, draw.program, draw.is_subtracted, *mesh, &uniforms, &draw.inputs);
                    }
                }
                PassContent::Screen { program, uniforms, inputs } => {
                    self.run(card, *program, false, self.square, uniforms, inputs);
                }
            }
            card.end_render_pass();
        }
        Texture2D::from_miniquad_texture(self.targets.texture(RenderTarget::Picture).unwrap_or(self.noise))
    }

    /// Hands the recipe's triangles and maps to the card.
    fn upload(&mut self, card: &mut dyn RenderingBackend, recipe: &RenderRecipe) {
        while self.draws.len() < recipe.draws.len() {
            self.draws.push(Mesh::empty(card));
        }
        for (draw, mesh) in recipe.draws.iter().zip(&mut self.draws) {
            let Draw { vertices, indices, .. } = draw;
            mesh.fill(card, vertices, indices);
        }
        for (k, Map { size, texels }) in recipe.maps.iter().enumerate() {
            // Resized rather than replaced, as targets are.
            match self.maps.get(k) {
                Some(&map) => card.texture_resize(map, size[0].into(), size[1].into(), Some(texels)),
                None => self.maps.push(targets::sharp(card, *size, texels)),
            }
        }
    }

    fn run(
        &self,
        card: &mut dyn RenderingBackend,
        program: Program,
        is_subtracted: bool,
        mesh: Mesh,
        uniforms: &[f32],
        inputs: &[TextureInput],
    ) {
        let Some(pipeline) = self.pipelines.of(program, is_subtracted) else { return };
        let textures: Option<Vec<TextureId>> = inputs.iter().map(|input| self.texture(*input)).collect();
        let Some(textures) = textures else { return };
        card.apply_pipeline(&pipeline);
        card.apply_bindings_from_slice(&[mesh.vertices], mesh.indices, &textures);
        card.apply_uniforms_from_bytes(uniforms.as_ptr().cast(), size_of_val(uniforms));
        card.draw(0, mesh.count, 1);
    }

    fn texture(&self, input: TextureInput) -> Option<TextureId> {
        match input {
            TextureInput::Noise => Some(self.noise),
            TextureInput::Target(target) => self.targets.texture(target),
            TextureInput::Map(k) => self.maps.get(k).copied(),
        }
    }
}

/// Triangles on the card.
#[derive(Clone, Copy)]
struct Mesh {
    vertices: BufferId,
    indices: BufferId,
    /// Bytes that there is room for.
    room: [usize; 2],
    count: i32,
}

impl Mesh {
    fn empty(card: &mut dyn RenderingBackend) -> Self {
        let [vertices, indices] = buffers(card, [64, 16]);
        Self { vertices, indices, room: [64, 16], count: 0 }
    }

    fn fill(&mut self, card: &mut dyn RenderingBackend, vertices: &[f32], indices: &[u16]) {
        let needed = [size_of_val(vertices), size_of_val(indices)];
        if needed[0] > self.room[0] || needed[1] > self.room[1] {
            [self.vertices, self.indices].into_iter().for_each(|buffer| card.delete_buffer(buffer));
            self.room = needed.map(usize::next_power_of_two);
            [self.vertices, self.indices] = buffers(card, self.room);
        }
        card.buffer_update(self.vertices, BufferSource::slice(vertices));
        card.buffer_update(self.indices, BufferSource::slice(indices));
        self.count = indices.len() as i32;
    }
}

/// Buffers of so many bytes for vertices and indices.
fn buffers(card: &mut dyn RenderingBackend, [vertices, indices]: [usize; 2]) -> [BufferId; 2] {
    [
        card.new_buffer(BufferType::VertexBuffer, BufferUsage::Stream, BufferSource::empty::<u8>(vertices)),
        card.new_buffer(BufferType::IndexBuffer, BufferUsage::Stream, BufferSource::empty::<u16>(indices / 2)),
    ]
}

/// The graphics card behind macroquad, after its pending commands.
#[expect(unsafe_code, reason = "macroquad has no other way to what lies below it")]
fn card() -> &'static mut dyn RenderingBackend {
    // SAFETY: macroquad runs on one thread, and of its context nothing is borrowed while a renderer uses what this returns:
    // no function here calls macroquad before it has let go of it.
    let mut gl = unsafe { get_internal_gl() };
    gl.flush();
    gl.quad_context
}
