//! Gamepads of a desktop: on Linux those that the kernel reports, elsewhere by the system's own way. Where there are none nothing
//! is said of it.

#[cfg(target_os = "linux")]
mod evdev;
#[cfg(any(windows, target_os = "macos"))]
mod system;

#[cfg(target_os = "linux")]
pub use evdev::Gamepads;
#[cfg(any(windows, target_os = "macos"))]
pub use system::Gamepads;
