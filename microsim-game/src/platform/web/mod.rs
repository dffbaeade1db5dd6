//! A page in a browser: the address in place of a command line, downloads, values in its own storage.

mod gamepads;
mod host;
mod room;
mod speaker;
mod storage;

pub use gamepads::Gamepads;
pub use room::{open_room, room_key};
pub use speaker::Speaker;
pub use storage::Storage;

use super::ScreenButtons;
use macroquad::conf::Conf;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{io, panic};

/// Whether the program can end of itself: a page is closed.
pub const CAN_QUIT: bool = false;
/// Whether menus are shown by more than their drawing.
pub const SHOWS_MENUS: bool = true;

/// The command line that the page's address stands for; the first word is the program's name.
pub fn arguments() -> impl Iterator<Item = OsString> {
    lines("arguments").into_iter().map(OsString::from)
}

/// The language that the browser prefers.
#[must_use]
pub fn locale() -> String {
    lines("locale").concat()
}

/// The texts of a language, once the page has fetched them.
#[must_use]
pub fn words(code: &str) -> Option<Vec<u8>> {
    host::ask("words", code)
}

/// Says in which language the page is.
pub fn show_language(code: &str) {
    host::tell("language", code, &[]);
}

/// Shows what the address asks for.
pub fn answer(text: &str) {
    fail(text);
}

/// Shows on the page why the program ends.
pub fn fail(problem: &str) {
    host::tell("fail", "", problem.as_bytes());
}

/// Writes to the browser's console.
pub fn print(text: &str) {
    host::tell("print", "", text.as_bytes());
}

/// Time since the page began; it never goes back.
#[must_use]
pub fn now() -> Duration {
    Duration::from_nanos((host::now() * 1e6) as u64)
}

/// Nothing: a page waits for the screen.
pub fn rest(_: Duration) {}

/// What is in a file that the player has picked or dropped, or that came with the address.
///
/// # Errors
/// When there is none of this name.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    host::ask("file", &path.to_string_lossy()).ok_or(io::ErrorKind::NotFound.into())
}

/// Gives the player a file, as a download.
///
/// # Errors
/// When the page does not take it.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let is_taken = host::tell("download", &path.to_string_lossy(), bytes);
    is_taken.then_some(()).ok_or(io::ErrorKind::Other.into())
}

/// Gives the player a picture, as a PNG: rows from above, four bytes for each pixel. The browser makes the file.
///
/// # Errors
/// When the page does not take it.
pub fn write_picture(path: &Path, (width, _): (u32, u32), pixels: &[u8]) -> io::Result<()> {
    let is_taken = host::tell("picture", &format!("{width} {}", path.to_string_lossy()), pixels);
    is_taken.then_some(()).ok_or(io::ErrorKind::Other.into())
}

/// Gives the player a file that is kept as well: only this page finds what it keeps. Returns whether it did.
pub fn hand_over(name: &str, bytes: &[u8]) -> bool {
    write(Path::new(name), bytes).is_ok()
}

/// Files that were picked or dropped since they were last asked for.
#[must_use]
pub fn dropped_files() -> Vec<PathBuf> {
    lines("dropped").into_iter().map(PathBuf::from).collect()
}

/// What the buttons of the page say.
#[must_use]
pub fn screen_buttons() -> ScreenButtons {
    let item = lines("item").concat().parse().ok();
    ScreenButtons { held: lines("held"), pressed: lines("pressed"), item }
}

/// Shows the page's buttons, on devices that have no keys, or hides them; those for digestion and division only if named.
pub fn show_buttons(are_wanted: bool, named: &[&str]) {
    let order = if are_wanted { "show buttons" } else { "hide buttons" };
    host::tell(order, &named.join(" "), &[]);
}

/// From now on the page's menu has a link to a scene with its seed.
pub fn offer_again(scene: &str, seed: u64) {
    host::tell("offer", &format!("scenario={scene}&play&seed={seed}"), &[]);
}

/// Puts the menu that is drawn into the page too, where screen readers find it: the screen's name, empty for a scene, and the
/// menu's lines.
pub fn show_menu(screen: &str, lines: &str) {
    host::tell("show menu", screen, lines.as_bytes());
}

/// Height at the lower edge that buttons cover, drawing units; 0 if there are none.
#[must_use]
pub fn covered_height() -> f32 {
    lines("covered height").concat().parse().unwrap_or(0.0)
}

/// Whether the page's context can draw into floats of 16 bits; its version does not say.
#[must_use]
pub fn has_float_targets(_: &str) -> bool {
    host::ask("float targets", "").is_some()
}

/// Has the page call the program for every frame.
///
/// # Errors
/// None: the program's own are shown on the page.
pub(crate) fn run(conf: Conf, program: impl Future<Output = Result<(), String>> + 'static) -> Result<(), String> {
    panic::set_hook(Box::new(|info| fail(&info.to_string())));
    macroquad::Window::from_config(conf, async move {
        if let Err(problem) = program.await {
            fail(&problem);
        }
    });
    Ok(())
}

/// A text that the page has for the asking.
pub(crate) fn asked() -> String {
    lines("asked").concat()
}

fn lines(what: &str) -> Vec<String> {
    let text = host::ask(what, "").and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default();
    text.split('\n').filter(|line| !line.is_empty()).map(str::to_owned).collect()
}
