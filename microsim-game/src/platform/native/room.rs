//! A room of a server, by WebSocket.

use super::mesh::Mesh;
use crate::network::relay;
use crate::network::transport::{LONGEST_MESSAGE, Member, Notice, Transport};
use crate::words::{self, Key};
use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::io::{self, ErrorKind};
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;
use std::time::Duration;
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, Message, WebSocket, client};

/// Port of a server unless another is named.
const PORT: u16 = 8080;
/// Longest time for each step of a connection.
const TIMEOUT: Duration = Duration::from_secs(10);
/// Most messages that are taken at once, so that no server holds a frame.
const MOST: usize = 512;
/// Bytes that wait to be sent; what is more is lost.
const LONGEST_QUEUE: usize = 1 << 20;

/// Goes into a room, with the key by which a place is given back after a cut, if any. `server` is `HOST`, `HOST:PORT`, or the address of its page.
///
/// # Errors
/// When the address or the code is none. All else is told later, as [`Notice::Closed`].
pub fn open_room(server: &str, code: &str, key: &str) -> Result<Box<dyn Transport>, String> {
    let (host, way) = (host(server)?, relay::way(&relay::check_code(code)?, key));
    let (sender, connected) = channel();
    let connect = move || {
        // Nobody receives it when the room has been left meanwhile.
        let _ = sender.send(connect(&host, &way));
    };
    thread::Builder::new().name("room".to_owned()).spawn(connect).map_err(|error| error.to_string())?;
    Ok(Box::new(Room { state: State::Connecting(connected), mesh: None }))
}

/// A key that nobody can guess.
#[must_use]
pub fn room_key() -> String {
    // The standard library seeds each by chance of the system.
    let chance = || RandomState::new().build_hasher().finish();
    format!("{:016x}{:016x}", chance(), chance())
}

/// `HOST:PORT` of an address.
fn host(server: &str) -> Result<String, String> {
    let server = server.trim();
    let rest = ["ws://", "http://"].iter().find_map(|way| server.strip_prefix(way)).unwrap_or(server);
    if rest.contains("://") {
        return Err("a window speaks to http:// and ws:// only".to_owned());
    }
    let host = rest.split(['/', '?', '#']).next().unwrap_or_default();
    let is_host = |c: char| c.is_ascii_alphanumeric() || ".-_:[]".contains(c);
    if host.is_empty() || !host.chars().all(is_host) {
        return Err("an address is HOST or HOST:PORT".to_owned());
    }
    let has_port = host.rsplit_once(':').is_some_and(|(_, port)| !port.contains(']'));
    Ok(if has_port { host.to_owned() } else { format!("{host}:{PORT}") })
}

/// Why there is no connection. The language is that of another thread, which puts it into words.
#[derive(Debug)]
struct Failure {
    key: Key,
    host: String,
    error: ErrorKind,
}

impl Failure {
    fn told(&self) -> String {
        words::text_with(self.key, &[("host", (&self.host).into()), ("error", words::of_error(self.error).into())])
    }
}

fn connect(host: &str, way: &str) -> Result<WebSocket<TcpStream>, Failure> {
    let failure = |key, error| Failure { key, host: host.to_owned(), error };
    let unreachable = |error: io::Error| failure(Key::RoomUnreachable, error.kind());
    let stream = reach(host).map_err(unreachable)?;
    let config = WebSocketConfig::default()
        .max_message_size(Some(LONGEST_MESSAGE + 1))
        .max_frame_size(Some(LONGEST_MESSAGE + 1))
        .max_write_buffer_size(LONGEST_QUEUE);
    let connected = client::client_with_config(format!("ws://{host}/room/{way}"), stream, Some(config));
    let (socket, _) = connected.map_err(|_| failure(Key::RoomNone, ErrorKind::Other))?;
    socket.get_ref().set_nonblocking(true).map_err(unreachable)?;
    Ok(socket)
}

fn reach(host: &str) -> io::Result<TcpStream> {
    let mut failed = ErrorKind::NotFound.into();
    for address in host.to_socket_addrs().map_err(|_| ErrorKind::NotFound)? {
        match TcpStream::connect_timeout(&address, TIMEOUT) {
            Ok(stream) => {
                stream.set_nodelay(true)?;
                stream.set_read_timeout(Some(TIMEOUT))?;
                stream.set_write_timeout(Some(TIMEOUT))?;
                return Ok(stream);
            }
            Err(error) => failed = error,
        }
    }
    Err(failed)
}

#[derive(Debug)]
struct Room {
    state: State,
    mesh: Option<Mesh>,
}

#[derive(Debug)]
enum State {
    Connecting(Receiver<Result<WebSocket<TcpStream>, Failure>>),
    Open(Box<WebSocket<TcpStream>>),
    Closed,
}

impl Room {
    /// Takes the connection when it is there; what the game is told when there will be none.
    fn take_connection(&mut self) -> Option<Notice> {
        let State::Connecting(way) = &self.state else { return None };
        match way.try_recv() {
            Ok(Ok(socket)) => {
                self.mesh = socket.get_ref().local_addr().ok().and_then(|own| Mesh::new(own.ip()));
                self.state = State::Open(Box::new(socket));
                None
            }
            Ok(Err(failure)) => Some(Notice::Closed(failure.told())),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(relay::cut()),
        }
    }

    /// What comes next, if something has come by now: a notice, or nothing that the game is told.
    fn next(&mut self) -> Option<Option<Notice>> {
        if let Some(failure) = self.take_connection() {
            return Some(Some(failure));
        }
        let State::Open(socket) = &mut self.state else { return None };
        let notice = match socket.read() {
            Ok(Message::Binary(frame)) => {
                let other = || Notice::Closed(words::text(Key::RoomStrange).to_owned());
                if let Some(signal) = self.mesh.as_mut().and_then(|mesh| mesh.take(&frame)) {
                    // As with messages below.
                    let _ = socket.send(Message::binary(signal));
                }
                (!relay::is_of_channels(&frame)).then(|| relay::notice(&frame).unwrap_or_else(other))
            }
            Ok(Message::Ping(_) | Message::Pong(_)) => None,
            Err(Error::Io(error)) if error.kind() == ErrorKind::WouldBlock => {
                // What could not be sent before; that it fails is read next time.
                let _ = socket.flush();
                return None;
            }
            _ => Some(relay::cut()),
        };
        Some(notice)
    }
}

impl Transport for Room {
    fn poll(&mut self) -> Vec<Notice> {
        let mut notices = Vec::new();
        for _ in 0..MOST {
            let Some(next) = self.next() else { break };
            if matches!(next, Some(Notice::Closed(_))) {
                (self.state, self.mesh) = (State::Closed, None);
            }
            notices.extend(next);
        }
        if let State::Open(socket) = &mut self.state {
            for signal in self.mesh.iter_mut().flat_map(Mesh::late_signals) {
                // As with messages below.
                let _ = socket.send(Message::binary(signal));
            }
        }
        notices.extend(self.mesh.iter_mut().flat_map(Mesh::poll));
        notices
    }

    fn send(&mut self, to: Member, bytes: &[u8]) {
        if let (State::Open(socket), Some(frame)) = (&mut self.state, relay::frame(to, bytes))
            && !self.mesh.as_mut().is_some_and(|mesh| mesh.send(to, bytes))
        {
            // What does not go now waits, up to a limit; a connection that is cut is read of.
            let _ = socket.send(Message::binary(frame));
        }
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        if let State::Open(socket) = &mut self.state {
            // The server notices without a word too, only later.
            let _ = socket.close(None);
            let _ = socket.flush();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn addresses_are_read() {
        for (text, expected) in [
            ("10.0.0.7", "10.0.0.7:8080"),
            (" localhost:9 ", "localhost:9"),
            ("http://lab.local:80/?room=K7M2QX", "lab.local:80"),
            ("ws://[::1]", "[::1]:8080"),
            ("[::1]:81", "[::1]:81"),
        ] {
            assert_eq!(host(text).as_deref(), Ok(expected), "{text}");
        }
        assert!(["", "https://a", "a b", "a\r\nb", "user@host", "http://"].iter().all(|text| host(text).is_err()));
    }

    #[test]
    fn a_server_that_is_not_there_is_told_of() {
        let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        drop(listener);
        let mut room = open_room(&address, "K7M2QX", "").unwrap();
        let begin = Instant::now();
        let mut notices = Vec::new();
        while notices.is_empty() && begin.elapsed() < TIMEOUT {
            notices = room.poll();
            thread::sleep(Duration::from_millis(1));
        }
        let [Notice::Closed(reason)] = &notices[..] else { panic!("{notices:?}") };
        assert_eq!(*reason, format!("cannot reach {address}: nobody answers there"));
        assert!(room.poll().is_empty());
    }
}
