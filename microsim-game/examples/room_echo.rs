//! A member of a room that sends back what it is sent: `room_echo SERVER CODE`. For the tests of the page.

use microsim_game::network::transport::Notice;
use microsim_game::platform::open_room;
use std::thread;
use std::time::Duration;

fn main() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [server, code] = &arguments[..] else { return Err("room_echo SERVER CODE".to_owned()) };
    let mut room = open_room(server, code, "")?;
    loop {
        for notice in room.poll() {
            match notice {
                Notice::Message { from, bytes } => room.send(from, &bytes),
                Notice::Closed(reason) => return Err(reason),
                _ => {}
            }
        }
        thread::sleep(Duration::from_millis(1));
    }
}
