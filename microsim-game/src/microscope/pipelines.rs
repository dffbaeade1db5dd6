//! The core's programs, built for the card.

use macroquad::miniquad::{
    BlendFactor, BlendState, BlendValue, BufferLayout, Equation, Pipeline, PipelineParams, RenderingBackend,
    ShaderMeta, ShaderSource, UniformBlockLayout, UniformDesc, UniformType, VertexAttribute, VertexFormat,
};
use microsim_core::microscope::recipe::{GlslSource, Program};
use std::collections::HashMap;

/// Each program, as it adds and as it takes away.
pub(super) struct Pipelines(HashMap<(Program, bool), Pipeline>);

impl Pipelines {
    pub(super) fn new(card: &mut dyn RenderingBackend) -> Result<Self, String> {
        let mut all = HashMap::new();
        for program in Program::all() {
            for is_subtracted in [false, true] {
                if !(program.covers() && is_subtracted) {
                    let pipeline = build(card, program, is_subtracted).map_err(|why| format!("{program:?}: {why}"))?;
                    all.insert((program, is_subtracted), pipeline);
                }
            }
        }
        Ok(Self(all))
    }

    pub(super) fn of(&self, program: Program, is_subtracted: bool) -> Option<Pipeline> {
        self.0.get(&(program, is_subtracted)).copied()
    }
}

fn build(card: &mut dyn RenderingBackend, program: Program, is_subtracted: bool) -> Result<Pipeline, String> {
    let GlslSource { vertex, fragment, attributes, uniforms, textures } = program.source();
    let described = uniforms.iter().map(|&(name, floats, count)| UniformDesc::new(name, number(floats)).array(count));
    let meta = ShaderMeta {
        uniforms: UniformBlockLayout { uniforms: described.collect() },
        images: textures.into_iter().map(str::to_owned).collect(),
    };
    let text = ShaderSource::Glsl { vertex: &vertex, fragment: &fragment };
    let shader = card.new_shader(text, meta).map_err(|error| error.to_string())?;
    let layout: Vec<VertexAttribute> =
        attributes.iter().map(|&(name, floats)| VertexAttribute::new(name, format(floats))).collect();
    let params = PipelineParams { color_blend: blend(program, is_subtracted), ..PipelineParams::default() };
    Ok(card.new_pipeline(&[BufferLayout::default()], &layout, shader, params))
}

fn blend(program: Program, is_subtracted: bool) -> Option<BlendState> {
    let sum = |equation| Some(BlendState::new(equation, BlendFactor::One, BlendFactor::One));
    let opacity = BlendValue::SourceAlpha;
    match (program.covers(), program.blends()) {
        (false, _) if is_subtracted => sum(Equation::ReverseSubtract),
        (false, _) => sum(Equation::Add),
        (true, true) => {
            Some(BlendState::new(Equation::Add, BlendFactor::Value(opacity), BlendFactor::OneMinusValue(opacity)))
        }
        (true, false) => None,
    }
}

fn number(floats: usize) -> UniformType {
    [UniformType::Float1, UniformType::Float2, UniformType::Float3, UniformType::Float4][floats - 1]
}

fn format(floats: usize) -> VertexFormat {
    [VertexFormat::Float1, VertexFormat::Float2, VertexFormat::Float3, VertexFormat::Float4][floats - 1]
}
