//! The program: a loop of input, screens and a drawn frame.

use crate::input::script::InputScript;
use crate::input::{Action, Input};
use crate::input_device::Device;
use crate::platform;
use crate::scene_source::SceneSource;
use crate::screen::context::{AppContext, Asked};
use crate::screen::stack::Stack;
use crate::screen::{MainScreen, Next};
use crate::shot::Shot;
use crate::timings::Timings;
use crate::ui::menu::Menu;
use crate::viewer::Pace;
use crate::words::{self, Key};
use macroquad::window::{clear_background, next_frame, screen_dpi_scale, screen_height, screen_width, set_fullscreen};
use microsim_core::glam::Vec2;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Time of a frame whose length must not depend on the machine, s.
const EXACT_FRAME: f32 = 1.0 / 60.0;
/// Shortest frame, s: where nothing waits for the screen, the loop would run hot.
const SHORTEST_FRAME: f32 = 1.0 / 250.0;

/// Time after a change between window and full screen in which the keyboard is lost without a pause, s.
const RESIZING_TIME: f32 = 1.0;

/// How the program runs.
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// Input to play back instead of reading mouse and keyboard.
    pub script: Option<InputScript>,
    /// Frames after which to exit.
    pub frames: Option<u32>,
    /// Picture of the last frame.
    pub screenshot: Option<PathBuf>,
    /// Size of that picture, pixels.
    pub size: (u32, u32),
    /// How pictures are made, in place of what the settings say.
    pub asked: Asked,
    /// Whether to say how long everything took.
    pub timings: bool,
}

impl RunOptions {
    /// Whether every frame must come out the same on every machine, and is exactly one step.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.screenshot.is_some() || self.script.is_some()
    }
}

/// The running program.
#[derive(Debug)]
pub struct App {
    screens: Stack,
    context: AppContext,
    device: Device,
    options: RunOptions,
    shot: Shot,
    frame: u32,
    is_full: bool,
    /// When the window was last asked to fill the screen or not to, s: it may lose the keyboard over that.
    resized: f32,
    /// When this frame began.
    began: Duration,
    /// Time since the program began, s: frames of a window that is open for days are short beside it.
    clock: f64,
    /// What input and steps took in the last frame, s.
    updating: f32,
    timings: Timings,
    /// The screen and the menu that were shown last by other means than their drawing.
    shown_menu: [String; 2],
}

impl App {
    /// The program. Needs an open window.
    #[must_use]
    pub fn new(first: MainScreen, mut context: AppContext, options: RunOptions) -> Self {
        context.pen.fit(view_size(&options), context.settings.text_factor());
        context.pace.is_exact = options.is_exact();
        context.asked = options.asked;
        context.choose_language();
        let screens = Stack::new(first, &mut context);
        let (device, shot, timings) = (Device::new(), Shot::default(), Timings::default());
        let began = platform::now();
        Self {
            screens,
            context,
            device,
            options,
            shot,
            frame: 0,
            is_full: false,
            resized: f32::NEG_INFINITY,
            began,
            clock: 0.0,
            updating: 0.0,
            timings,
            shown_menu: Default::default(),
        }
    }

    /// Runs until the player leaves or all frames have been shown.
    ///
    /// # Errors
    /// When a planned picture cannot be written.
    pub async fn run(mut self) -> Result<(), String> {
        loop {
            let input = self.begin_frame();
            if !self.update(&input) {
                break;
            }
            let updated = platform::now();
            self.updating = (updated - self.began).as_secs_f32();
            self.frame += 1;
            let is_last = self.options.frames.is_some_and(|frames| self.frame >= frames);
            self.show(is_last)?;
            let drawn = platform::now();
            if is_last {
                break;
            }
            next_frame().await;
            let submitting = self.context.scenery.take_submitting();
            let waited = platform::now() - drawn;
            self.timings.add([updated - self.began, drawn - updated, waited], submitting);
            self.rest();
        }
        if self.options.timings {
            platform::print(&self.timings.to_string());
        }
        Ok(())
    }

    fn begin_frame(&mut self) -> Input {
        let is_exact = self.options.is_exact();
        let last = std::mem::replace(&mut self.began, platform::now());
        let elapsed = if is_exact { EXACT_FRAME } else { (self.began - last).as_secs_f32() };
        let context = &mut self.context;
        context.pace = Pace { elapsed, is_exact };
        self.clock += f64::from(elapsed);
        context.time = self.clock as f32;
        context.choose_language();
        // Time of the steps does not count: less detail would not shorten it.
        let drawing = Pace { elapsed: (elapsed - self.updating).max(0.0), ..context.pace };
        if let Some(news) = context.scenery.pass(drawing, context.effort(), context.sight()) {
            context.tell(news);
        }
        let screen = view_size(&self.options);
        if screen.min_element() >= 1.0 {
            context.pen.fit(screen, context.settings.text_factor());
        }
        // Read even with a script: unread events pile up.
        let input = self.device.read(&context.settings.keys, self.screens.is_scene());
        let mut input = match &mut self.options.script {
            Some(script) => script.input(self.frame, context.pen.screen()),
            None => input,
        };
        // A page tells the loss of its graphics so, too.
        if input.has_lost_focus {
            context.album.clear();
        }
        input.has_lost_focus &= !is_of_resizing(context.time - self.resized);
        input
    }

    /// Returns whether the program goes on.
    fn update(&mut self, input: &Input) -> bool {
        if !self.screens.waits_for_key() {
            self.press(input);
        }
        self.screens.update(input, &mut self.context);
        self.context.pass_sound();
        if self.screens.is_empty() {
            return false;
        }
        self.show_buttons();
        if platform::SHOWS_MENUS {
            self.show_menu();
        }
        if let Some(screen) = self.open_dropped(input) {
            self.screens.go(Next::Show(screen), &mut self.context);
        }
        let context = &mut self.context;
        if !self.options.is_exact() && context.settings.full_screen != self.is_full {
            self.is_full = context.settings.full_screen;
            self.resized = context.time;
            set_fullscreen(self.is_full);
        }
        true
    }

    fn show_buttons(&self) {
        let digests = self.context.settings.hold_to_digest.then_some("digest");
        let deeds = ["divide", "lunge"].into_iter().zip(self.screens.deeds());
        let deeds = deeds.filter(|(_, is_possible)| *is_possible).map(|(name, _)| name);
        let named: Vec<&str> = digests.into_iter().chain(deeds).collect();
        platform::show_buttons(self.screens.is_scene(), &named);
    }

    /// Shows the menu by other means than its drawing, where it has changed.
    fn show_menu(&mut self) {
        let screen = if self.screens.is_scene() { String::new() } else { self.screens.name() };
        let shown = [screen, self.screens.menu().map(Menu::lines).unwrap_or_default()];
        if self.shown_menu != shown {
            platform::show_menu(&shown[0], &shown[1]);
            self.shown_menu = shown;
        }
    }

    /// Keys that do the same on every screen.
    fn press(&mut self, input: &Input) {
        let context = &mut self.context;
        context.wants_picture |= input.presses(Action::Screenshot);
        if input.presses(Action::Optics) {
            context.change_sight(false);
        }
        if input.presses(Action::FullScreen) {
            context.settings.full_screen ^= true;
            context.save_settings();
        }
    }

    /// Opens scenario files that are dropped on the window, games as games. The first is shown, unless that would end a round; the others
    /// come into the list of simulations.
    fn open_dropped(&mut self, input: &Input) -> Option<MainScreen> {
        let sources: Vec<SceneSource> = input.dropped.iter().rev().cloned().map(SceneSource::File).collect();
        let mut opened: Vec<_> = sources.iter().filter_map(|file| Some((file, self.context.open(file)?))).collect();
        let are_good = opened.len() == sources.len();
        let is_at_stake = self.screens.is_at_stake();
        let shown = opened.pop_if(|_| !is_at_stake).map(|(_, screen)| screen);
        match opened.as_slice() {
            // The message about a bad file stays.
            _ if !are_good => {}
            [] => {}
            [(source, _)] => {
                self.context.tell(words::text_with(Key::FileAdded, &[("file", (&source.to_string()).into())]));
            }
            more => self.context.tell(words::text_with(Key::FilesAdded, &[("count", (more.len() as u32).into())])),
        }
        shown
    }

    /// Draws the frame to the window, and into a file if one is wanted.
    fn show(&mut self, is_last: bool) -> Result<(), String> {
        if let Some(path) = self.options.screenshot.clone().filter(|_| is_last) {
            let taken = self.take(&path, self.options.size);
            return taken.map_err(|error| words::of_file(Key::FileUnwritable, &path, &error));
        }
        if std::mem::take(&mut self.context.wants_picture) {
            let path = free_path(&format!("microsim-{}", self.screens.name()));
            let size = if self.options.is_exact() { self.options.size } else { physical_size() };
            let taken = self.take(&path, size);
            self.context.tell(match taken {
                Ok(()) => {
                    let path = path.canonicalize().unwrap_or(path);
                    words::text_with(Key::FileWritten, &[("file", (&path.display().to_string()).into())])
                }
                Err(error) => words::of_file(Key::FileUnwritable, &path, &error),
            });
        } else if self.options.screenshot.is_none() {
            // Frames before a planned picture are not shown.
            self.draw(false);
        }
        Ok(())
    }

    fn take(&mut self, path: &Path, size: (u32, u32)) -> std::io::Result<()> {
        let view = self.context.pen.screen();
        self.shot.begin(size, view);
        self.draw(true);
        self.shot.finish(path, view)
    }

    /// Draws the topmost screen over the scene that it belongs to, and the message, which is no part of a photo.
    fn draw(&mut self, is_picture: bool) {
        clear_background(crate::draw::palette::INK);
        self.screens.draw(&mut self.context);
        if !(is_picture && self.context.is_photo()) {
            self.context.draw_message();
        }
        self.context.pen.flush();
    }

    fn rest(&self) {
        let elapsed = self.context.pace.elapsed;
        if !self.options.is_exact() && elapsed < SHORTEST_FRAME {
            platform::rest(Duration::from_secs_f32(SHORTEST_FRAME - elapsed));
        }
    }
}

/// Whether the keyboard is lost because the window was resized so long before, s.
fn is_of_resizing(since: f32) -> bool {
    since < RESIZING_TIME
}

/// Where a picture of this name goes, so that none that is there is lost. Scenarios may have any name.
fn free_path(name: &str) -> PathBuf {
    let name = name.replace(|letter: char| !letter.is_alphanumeric() && !"-_.".contains(letter), "-");
    let numbered = (2..).map(|number| PathBuf::from(format!("{name}-{number}.png")));
    let mut paths = [PathBuf::from(format!("{name}.png"))].into_iter().chain(numbered);
    paths.find(|path| !path.exists()).unwrap_or_else(|| PathBuf::from(format!("{name}.png")))
}

/// Drawing units: those of the window, or the pixels of the planned picture.
fn view_size(options: &RunOptions) -> Vec2 {
    if options.is_exact() {
        Vec2::new(options.size.0 as f32, options.size.1 as f32)
    } else {
        Vec2::new(screen_width(), screen_height())
    }
}

fn physical_size() -> (u32, u32) {
    let scale = screen_dpi_scale();
    let side = |units: f32| ((units * scale) as u32).max(1);
    (side(screen_width()), side(screen_height()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_screen_does_not_leave_it_paused_but_another_window_does() {
        assert!(is_of_resizing(0.0) && is_of_resizing(0.9));
        assert!(!is_of_resizing(1.1) && !is_of_resizing(f32::INFINITY));
    }
}
