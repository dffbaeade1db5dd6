//! Running in a window, with a plain answer when there can be none.

use macroquad::conf::Conf;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

/// Opens a window, runs the program in it and returns when that ends.
///
/// # Errors
/// What the program itself reports, or that there is no window.
pub(crate) fn run(conf: Conf, program: impl Future<Output = Result<(), String>> + 'static) -> Result<(), String> {
    let is_open = Arc::new(AtomicBool::new(false));
    let outcome = Arc::new(Mutex::new(Ok(())));
    silence_panics_until(Arc::clone(&is_open));
    let (opened, ended) = (Arc::clone(&is_open), Arc::clone(&outcome));
    let program = async move {
        opened.store(true, Ordering::Relaxed);
        let result = program.await;
        if let Ok(mut ended) = ended.lock() {
            *ended = result;
        }
    };
    // Without a display miniquad panics, in places that depend on what is missing.
    let run = panic::catch_unwind(AssertUnwindSafe(|| macroquad::Window::from_config(conf, program)));
    match run {
        Err(cause) if is_open.load(Ordering::Relaxed) => panic::resume_unwind(cause),
        Ok(()) if is_open.load(Ordering::Relaxed) => {
            outcome.lock().map_or(Ok(()), |mut end| std::mem::replace(&mut *end, Ok(())))
        }
        _ => Err(NO_WINDOW.to_owned()),
    }
}

const NO_WINDOW: &str = "\
cannot open a window.
A display and OpenGL are needed. On Linux: is DISPLAY set, and are the libraries there?
  apt-get install libx11-6 libxi6 libxkbcommon0 libgl1 libgl1-mesa-dri
Without a screen, a virtual one will do:
  xvfb-run -a -s '-screen 0 1280x720x24' microsim-game demo --screenshot demo.png";

/// Keeps panics silent until the window is open: what is missing is said in plain words instead.
fn silence_panics_until(is_open: Arc<AtomicBool>) {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if is_open.load(Ordering::Relaxed) {
            usual(info);
        }
    }));
}
