//! A desktop: files, a command line, standard error.

#[cfg(windows)]
mod console;
mod gamepads;
#[cfg(feature = "webrtc")]
mod helper;
#[cfg_attr(not(feature = "webrtc"), path = "no_mesh.rs")]
mod mesh;
#[cfg(feature = "webrtc")]
mod port;
mod room;
mod speaker;
mod storage;
#[cfg(feature = "webrtc")]
mod way;
mod window;

pub use gamepads::Gamepads;
pub use room::{open_room, room_key};
pub use speaker::Speaker;
pub use storage::Storage;
pub(crate) use window::run;

use super::ScreenButtons;
use macroquad::input::get_dropped_files;
use std::ffi::OsString;
use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::{Duration, Instant};
use std::{fs, io};

/// Longest file that is read, bytes.
const LONGEST: u64 = 1 << 28;

/// Whether the program can end of itself.
pub const CAN_QUIT: bool = true;
/// Whether menus are shown by more than their drawing.
pub const SHOWS_MENUS: bool = false;

/// The locale that messages are wanted in; empty if the system does not say.
#[must_use]
pub fn locale() -> String {
    let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
    ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().find_map(set).or_else(system_locale).unwrap_or_default()
}

/// The user's locale where the system itself knows it.
#[cfg(any(windows, target_os = "macos"))]
fn system_locale() -> Option<String> {
    sys_locale::get_locale()
}

#[cfg(not(any(windows, target_os = "macos")))]
fn system_locale() -> Option<String> {
    None
}

/// None: all texts are in the program.
#[must_use]
pub fn words(_: &str) -> Option<Vec<u8>> {
    None
}

/// Nothing: there is no page around the window.
pub fn show_language(_: &str) {}

/// The command line; the first word is the program's name. What is said about it goes to where it was written.
pub fn arguments() -> impl Iterator<Item = OsString> {
    #[cfg(windows)]
    console::attach();
    std::env::args_os()
}

/// Says what was asked for, on standard output.
pub fn answer(text: &str) {
    // Ignored: standard output may be closed.
    let _ = io::stdout().write_all(text.as_bytes());
}

/// Says why the program ends.
pub fn fail(problem: &str) {
    eprintln!("microsim-game: {}", clean(problem));
}

/// Says something to whoever started the program.
pub fn print(text: &str) {
    eprintln!("{}", clean(text));
}

/// Text without what controls a terminal, for it may have names from files in it: all lines but the first are indented, so that
/// no name passes for a line of its own.
fn clean(text: &str) -> String {
    let is_plain = |c: char| matches!(c, '"' | '\'' | '\\') || c.escape_debug().len() == 1;
    let shown = |c: char| match c {
        '\n' => "\n  ".to_owned(),
        c if is_plain(c) => c.to_string(),
        c => c.escape_unicode().to_string(),
    };
    text.chars().map(shown).collect()
}

/// Time since some moment; it never goes back.
#[must_use]
pub fn now() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Waits.
pub fn rest(time: Duration) {
    std::thread::sleep(time);
}

/// What is in a file that the player has named or dropped.
///
/// # Errors
/// When it cannot be read, is a device or a pipe, which may have no end, or is longer than 256 MB.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    // Before it is opened, which waits for ever where nobody writes to a pipe.
    if !fs::metadata(path)?.is_file() {
        return Err(ErrorKind::InvalidInput.into());
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(LONGEST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LONGEST {
        return Err(ErrorKind::FileTooLarge.into());
    }
    Ok(bytes)
}

/// Writes a file for the player.
///
/// # Errors
/// When it cannot be written.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    fs::write(path, bytes)
}

/// Writes a picture as a PNG for the player: rows from above, four bytes for each pixel.
///
/// # Errors
/// When it cannot be written.
pub fn write_picture(path: &Path, (width, height): (u32, u32), pixels: &[u8]) -> io::Result<()> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.write_header()?.write_image_data(pixels)?;
    write(path, &file)
}

/// Nothing: the player finds what is kept.
#[must_use]
pub fn hand_over(_: &str, _: &[u8]) -> bool {
    false
}

/// Files that were dropped on the window in this frame.
#[must_use]
pub fn dropped_files() -> Vec<PathBuf> {
    get_dropped_files().into_iter().filter_map(|file| file.path).collect()
}

/// None: there are keys.
#[must_use]
pub fn screen_buttons() -> ScreenButtons {
    ScreenButtons::default()
}

/// Nothing: there are no buttons on the screen to show or hide.
pub fn show_buttons(_: bool, _: &[&str]) {}

/// Nothing: only a page has a link to a scene with its seed.
pub fn offer_again(_: &str, _: u64) {}

/// Nothing: menus are drawn only.
pub fn show_menu(_: &str, _: &str) {}

/// Height at the lower edge that buttons cover, drawing units.
#[must_use]
pub fn covered_height() -> f32 {
    0.0
}

/// Whether every context of this version of OpenGL can draw into floats of 16 bits.
#[must_use]
pub fn has_float_targets(version: &str) -> bool {
    let is_small = ["OpenGL ES 2", "OpenGL ES 3.0", "OpenGL ES 3.1"].iter().any(|old| version.starts_with(old));
    !(is_small || version.starts_with('2') || version.contains("WebGL"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_contexts_draw_into_bytes() {
        assert!(
            has_float_targets("4.5 (Compatibility Profile) Mesa 22.3.6") && has_float_targets("OpenGL ES 3.2 Mesa")
        );
        assert!(["OpenGL ES 2.0", "WebGL 1.0", "2.1 Mesa"].iter().all(|version| !has_float_targets(version)));
    }

    #[test]
    fn nothing_that_is_said_controls_a_terminal() {
        let said = clean("a\u{1b}]52;c;eA==\u{7}\r\u{9b}2J\u{202e}\u{200b}\nµ \"b\" 'c' \\");
        let expected = "a\\u{1b}]52;c;eA==\\u{7}\\u{d}\\u{9b}2J\\u{202e}\\u{200b}\n  µ \"b\" 'c' \\";
        assert_eq!(said, expected);
    }

    #[test]
    fn a_written_picture_has_its_size() {
        let path = std::env::temp_dir().join(format!("microsim-picture-{}.png", std::process::id()));
        write_picture(&path, (3, 2), &[7; 24]).unwrap();
        let decoder = png::Decoder::new(File::open(&path).unwrap());
        let reader = decoder.read_info().unwrap();
        assert_eq!((reader.info().width, reader.info().height), (3, 2));
        fs::remove_file(path).unwrap();
        assert!(write_picture(Path::new("/nonexistent/a.png"), (1, 1), &[0; 4]).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn what_has_no_end_is_refused() {
        assert_eq!(read(Path::new("/dev/zero")).unwrap_err().kind(), ErrorKind::InvalidInput);
        assert_eq!(read(&std::env::temp_dir()).unwrap_err().kind(), ErrorKind::InvalidInput);
        assert!(read(Path::new("Cargo.toml")).is_ok_and(|text| text.starts_with(b"[package]")));
    }

    #[test]
    fn time_does_not_go_back() {
        let earlier = now();
        rest(Duration::from_millis(2));
        assert!(now() - earlier >= Duration::from_millis(2));
    }
}
