//! What the page may ask of the program.
#![expect(unsafe_code, reason = "exported functions have names of their own")]

use crate::platform;
use crate::scene_source::SceneSource;
use crate::stage::Stage;

/// Digest of the scene that the page names after so many steps; 0 if there is no such scene.
#[unsafe(no_mangle)]
extern "C" fn microsim_digest(steps: u32) -> u64 {
    let Ok(mut stage) = Stage::open(&SceneSource::from(platform::asked().as_str()), &[]) else { return 0 };
    (0..steps).for_each(|_| stage.step());
    stage.world().digest()
}
