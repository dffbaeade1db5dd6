//! A room of the page's own server, by the browser's WebSocket.

use super::host;
use crate::network::relay;
use crate::network::transport::{Member, Notice, Transport};
use std::sync::atomic::{AtomicU32, Ordering};

/// Goes into a room of the server that the page is from; the browser lets it speak to no other.
///
/// # Errors
/// When the code is none. All else is told later, as [`Notice::Closed`].
pub fn open_room(_: &str, code: &str, key: &str) -> Result<Box<dyn Transport>, String> {
    static NUMBERS: AtomicU32 = AtomicU32::new(0);
    let way = relay::way(&relay::check_code(code)?, key);
    let number = NUMBERS.fetch_add(1, Ordering::Relaxed).to_string();
    host::tell("enter room", &number, way.as_bytes());
    Ok(Box::new(Room { number, is_open: true }))
}

/// A key that nobody can guess, the same until the tab is closed.
#[must_use]
pub fn room_key() -> String {
    host::ask("room key", "").and_then(|key| String::from_utf8(key).ok()).unwrap_or_default()
}

/// The page knows it by its number.
#[derive(Debug)]
struct Room {
    number: String,
    is_open: bool,
}

impl Transport for Room {
    fn poll(&mut self) -> Vec<Notice> {
        let mut notices = Vec::new();
        while self.is_open
            && let Some(frame) = host::ask("room", &self.number)
        {
            // The page makes no channels, or it would have taken it.
            if relay::is_of_channels(&frame) {
                continue;
            }
            let notice = relay::notice(&frame).unwrap_or_else(relay::cut);
            self.is_open = !matches!(notice, Notice::Closed(_));
            notices.push(notice);
        }
        notices
    }

    fn send(&mut self, to: Member, bytes: &[u8]) {
        if let Some(frame) = relay::frame(to, bytes) {
            host::tell("send", &self.number, &frame);
        }
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        host::tell("leave room", &self.number, &[]);
    }
}
