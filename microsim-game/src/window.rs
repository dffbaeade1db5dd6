//! The window.

use crate::platform;
use macroquad::miniquad::conf::{Conf, Platform, WebGLVersion};

/// Vertices and indices of one draw call. Each call keeps a buffer of this size, so bigger is not better.
pub(crate) const CALL_VERTICES: usize = 16_384;
pub(crate) const CALL_INDICES: usize = 49_152;

/// Opens a window and runs `start` on it. Returns when that ends; in a browser at once.
///
/// # Errors
/// What the program itself reports, or that there is no window.
pub(crate) fn open(
    title: &str,
    (width, height): (u32, u32),
    start: impl AsyncFnOnce() -> Result<(), String> + 'static,
) -> Result<(), String> {
    let conf = macroquad::conf::Conf {
        miniquad_conf: Conf {
            window_title: title.to_owned(),
            window_width: width as i32,
            window_height: height as i32,
            high_dpi: true,
            platform: Platform { swap_interval: Some(1), webgl_version: WebGLVersion::WebGL2, ..Platform::default() },
            ..Conf::default()
        },
        draw_call_vertex_capacity: CALL_VERTICES,
        draw_call_index_capacity: CALL_INDICES,
        ..macroquad::conf::Conf::default()
    };
    platform::run(conf, async move { start().await })
}
