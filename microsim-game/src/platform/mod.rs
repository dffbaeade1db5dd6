//! What a desktop and a browser do differently: time, arguments, files, what is kept, the window, sound, and where errors are read.
//! Both have the same functions, so nothing else asks which of the two it runs on.

#[cfg(not(target_arch = "wasm32"))]
mod native;
#[cfg(target_arch = "wasm32")]
mod web;

#[cfg(not(target_arch = "wasm32"))]
pub use native::*;
#[cfg(target_arch = "wasm32")]
pub use web::*;

/// Buttons of the screen, by the names of their actions and moves; only a page has some.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ScreenButtons {
    /// Those that are held.
    pub held: Vec<String>,
    /// Those that went down since they were last asked for.
    pub pressed: Vec<String>,
    /// The item of the shown menu that was pointed at since it was last asked for.
    pub item: Option<usize>,
}
