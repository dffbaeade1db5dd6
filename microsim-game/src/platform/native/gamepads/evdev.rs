//! Gamepads on Linux: the kernel's event devices.

use crate::input::gamepad::{Gamepad, PadButton};
use crate::platform::now;
use evdev::{AbsoluteAxisCode as Axis, Device, EventSummary, InputEvent, KeyCode};
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::time::Duration;

/// Where the devices are, and how their names begin.
const FOLDER: &str = "/dev/input";
const PREFIX: &str = "event";
/// Time between two looks for new ones.
const INTERVAL: Duration = Duration::from_secs(2);

/// All gamepads that may be read.
#[derive(Debug, Default)]
pub struct Gamepads {
    /// Devices that were looked at, gamepads or not. Those that may not be read are looked at again: rights come after names.
    known: BTreeSet<PathBuf>,
    open: Vec<(PathBuf, Device, PadState)>,
    next_look: Duration,
}

impl Gamepads {
    /// What they say now.
    pub fn read(&mut self) -> Vec<Gamepad> {
        if now() >= self.next_look {
            self.next_look = now() + INTERVAL;
            self.look();
        }
        let known = &mut self.known;
        self.open.retain_mut(|(path, device, state)| {
            let is_there = state.drain(device);
            if !is_there {
                known.remove(path);
            }
            is_there
        });
        self.open.iter().map(|(_, _, state)| state.pad.clone()).collect()
    }

    fn look(&mut self) {
        let entries = std::fs::read_dir(FOLDER).into_iter().flatten().flatten();
        let is_event = |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(PREFIX));
        let there: BTreeSet<PathBuf> = entries.map(|entry| entry.path()).filter(is_event).collect();
        self.known.retain(|path| there.contains(path));
        let new: Vec<PathBuf> = there.difference(&self.known).cloned().collect();
        for path in new {
            let Ok(device) = Device::open(&path) else { continue };
            self.known.insert(path.clone());
            if is_gamepad(&device) && device.set_nonblocking(true).is_ok() {
                let state = PadState::of(&device);
                self.open.push((path, device, state));
            }
        }
    }
}

fn is_gamepad(device: &Device) -> bool {
    device.supported_keys().is_some_and(|keys| keys.contains(KeyCode::BTN_SOUTH))
        && device.supported_absolute_axes().is_some_and(|axes| axes.contains(Axis::ABS_X))
}

/// What one gamepad said so far.
#[derive(Debug, Default)]
struct PadState {
    pad: Gamepad,
    /// Least and greatest values of the stick's axes.
    ranges: [[i32; 2]; 2],
}

impl PadState {
    fn of(device: &Device) -> Self {
        let mut state = Self::default();
        for (axis, info) in device.get_absinfo().into_iter().flatten() {
            if let Some(range) = state.ranges.get_mut(usize::from(axis.0)) {
                *range = [info.minimum(), info.maximum()];
            }
            state.note(EventSummary::AbsoluteAxis(
                evdev::AbsoluteAxisEvent::new(axis, info.value()),
                axis,
                info.value(),
            ));
        }
        state
    }

    /// Notes what the device has reported since; whether it is still there.
    fn drain(&mut self, device: &mut Device) -> bool {
        loop {
            match device.fetch_events() {
                Ok(events) => events.for_each(|event: InputEvent| self.note(event.destructure())),
                Err(error) => return error.kind() == ErrorKind::WouldBlock,
            }
        }
    }

    fn note(&mut self, event: EventSummary) {
        match event {
            EventSummary::AbsoluteAxis(_, Axis::ABS_X, value) => self.pad.stick.x = self.share(0, value),
            EventSummary::AbsoluteAxis(_, Axis::ABS_Y, value) => self.pad.stick.y = self.share(1, value),
            EventSummary::AbsoluteAxis(_, Axis::ABS_HAT0X, value) => {
                self.set(PadButton::Left, value < 0);
                self.set(PadButton::Right, value > 0);
            }
            EventSummary::AbsoluteAxis(_, Axis::ABS_HAT0Y, value) => {
                self.set(PadButton::Up, value < 0);
                self.set(PadButton::Down, value > 0);
            }
            EventSummary::Key(_, code, value) => {
                if let Some(button) = button(code) {
                    self.set(button, value != 0);
                }
            }
            _ => {}
        }
    }

    /// A value of an axis as -1 to 1.
    fn share(&self, axis: usize, value: i32) -> f32 {
        let [least, most] = self.ranges[axis].map(|limit| limit as f32);
        if most > least { (2.0 * (value as f32 - least) / (most - least) - 1.0).clamp(-1.0, 1.0) } else { 0.0 }
    }

    fn set(&mut self, button: PadButton, is_down: bool) {
        self.pad.down.retain(|other| *other != button);
        if is_down {
            self.pad.down.push(button);
        }
    }
}

fn button(code: KeyCode) -> Option<PadButton> {
    Some(match code {
        KeyCode::BTN_SOUTH => PadButton::South,
        KeyCode::BTN_EAST => PadButton::East,
        KeyCode::BTN_WEST | KeyCode::BTN_NORTH => PadButton::West,
        KeyCode::BTN_START => PadButton::Start,
        KeyCode::BTN_DPAD_UP => PadButton::Up,
        KeyCode::BTN_DPAD_DOWN => PadButton::Down,
        KeyCode::BTN_DPAD_LEFT => PadButton::Left,
        KeyCode::BTN_DPAD_RIGHT => PadButton::Right,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use microsim_core::glam::Vec2;

    /// Events as the kernel's driver `xpad` reports them: type, code, value. Reports end with 0, 0, 0.
    const STREAM: [[i32; 3]; 14] = [
        [3, 0x00, 16384],
        [3, 0x01, -32768],
        [0, 0, 0],
        [1, 0x130, 1],
        [3, 0x11, -1],
        [0, 0, 0],
        [1, 0x130, 0],
        [1, 0x13b, 1],
        [3, 0x11, 1],
        [3, 0x10, 1],
        [3, 0x02, 255], // A trigger, which means nothing.
        [0, 0, 0],
        [1, 0x220, 1],
        [0, 0, 0],
    ];

    #[test]
    fn a_stream_of_the_kernels_events_becomes_stick_and_buttons() {
        let mut state = PadState { ranges: [[-32768, 32767]; 2], ..PadState::default() };
        let mut reports = Vec::new();
        for [sort, code, value] in STREAM {
            state.note(InputEvent::new(sort as u16, code as u16, value).destructure());
            if sort == 0 {
                reports.push(state.pad.clone());
            }
        }
        use PadButton::{Down, Right, South, Start, Up};
        assert!((reports[0].stick - Vec2::new(0.5, -1.0)).length() < 1e-3 && reports[0].down.is_empty());
        assert_eq!(reports[1].down, [South, Up]);
        assert_eq!(reports[2].down, [Start, Down, Right]);
        assert_eq!(reports[3].down, [Start, Down, Right, Up]);
    }

    #[test]
    fn an_axis_without_a_range_rests_and_one_of_bytes_has_its_middle_at_half() {
        let mut state = PadState::default();
        assert_eq!(state.share(0, 255), 0.0);
        state.ranges = [[0, 255]; 2];
        assert!(state.share(1, 128).abs() < 0.01 && state.share(1, 0) == -1.0 && state.share(1, 300) == 1.0);
    }

    #[test]
    #[ignore = "makes a device: needs the right to write /dev/uinput and to read /dev/input"]
    fn a_device_of_our_own_is_read() {
        let mut device = virtual_pad().expect("/dev/uinput");
        let mut pads = Gamepads::default();
        let mut found = Vec::new();
        for _ in 0..60 {
            pads.next_look = Duration::ZERO;
            found = pads.read();
            if !found.is_empty() {
                break;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        assert!(!found.is_empty(), "it may be made, but not read");
        device.emit(&[InputEvent::new(1, 0x130, 1), InputEvent::new(3, 0, 32767)]).unwrap();
        std::thread::sleep(Duration::from_millis(50));
        assert!(pads.read().iter().any(|pad| pad.down == [PadButton::South] && pad.stick.x > 0.99));
    }

    fn virtual_pad() -> Option<evdev::uinput::VirtualDevice> {
        let axis = |axis| {
            let info = evdev::AbsInfo::new(0, -32768, 32767, 16, 128, 1);
            evdev::UinputAbsSetup::new(axis, info)
        };
        let keys: evdev::AttributeSet<KeyCode> = [KeyCode::BTN_SOUTH, KeyCode::BTN_START].into_iter().collect();
        let builder = evdev::uinput::VirtualDevice::builder().ok()?.name("microsim test pad");
        let builder = builder.with_keys(&keys).ok()?.with_absolute_axis(&axis(Axis::ABS_X)).ok()?;
        builder.with_absolute_axis(&axis(Axis::ABS_Y)).ok()?.build().ok()
    }
}
