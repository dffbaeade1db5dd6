//! Textures on the card, and those that are drawn into.

use macroquad::miniquad::{
    FilterMode, RenderPass, RenderingBackend, TextureAccess, TextureFormat, TextureId, TextureParams, TextureSource,
    TextureWrap,
};
use microsim_core::microscope::recipe::RenderTarget;
use std::collections::HashMap;

/// One for each target, as large as its last picture.
#[derive(Default)]
pub(super) struct Targets(HashMap<RenderTarget, TargetTexture>);

struct TargetTexture {
    size: [u32; 2],
    texture: TextureId,
    pass: RenderPass,
}

impl Targets {
    /// The pass that draws into a target.
    pub(super) fn prepare(
        &mut self,
        card: &mut dyn RenderingBackend,
        target: RenderTarget,
        size: [u32; 2],
        is_float: bool,
    ) -> RenderPass {
        let [width, height] = size;
        if let Some(held) = self.0.get_mut(&target) {
            if held.size != size {
                // Resized, because miniquad keeps a record of every texture, deleted or not.
                card.texture_resize(held.texture, width, height, None);
                held.size = size;
            }
            return held.pass;
        }
        let format = if is_float { TextureFormat::RGBA16F } else { TextureFormat::RGBA8 };
        let texture = card.new_render_texture(TextureParams { width, height, format, ..TextureParams::default() });
        let pass = card.new_render_pass(texture, None);
        self.0.insert(target, TargetTexture { size, texture, pass });
        pass
    }

    pub(super) fn texture(&self, target: RenderTarget) -> Option<TextureId> {
        self.0.get(&target).map(|held| held.texture)
    }
}

/// A square texture that goes on beyond its edges.
pub(super) fn repeating(card: &mut dyn RenderingBackend, side: u16, bytes: &[u8]) -> TextureId {
    texture(card, [side, side], bytes, FilterMode::Linear, TextureWrap::Repeat)
}

/// A texture that is not interpolated.
pub(super) fn sharp(card: &mut dyn RenderingBackend, size: [u16; 2], bytes: &[u8]) -> TextureId {
    texture(card, size, bytes, FilterMode::Nearest, TextureWrap::Clamp)
}

fn texture(
    card: &mut dyn RenderingBackend,
    size: [u16; 2],
    bytes: &[u8],
    filter: FilterMode,
    wrap: TextureWrap,
) -> TextureId {
    let [width, height] = size.map(u32::from);
    let params =
        TextureParams { width, height, wrap, min_filter: filter, mag_filter: filter, ..TextureParams::default() };
    card.new_texture(TextureAccess::Static, TextureSource::Bytes(bytes), params)
}
