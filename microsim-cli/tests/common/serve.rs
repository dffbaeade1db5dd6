//! A running server of rooms, and guests in it.
#![allow(dead_code, reason = "each file of tests uses a part")]

use crate::common::heeding_signals;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// Longest time that anything takes here.
pub(crate) const TIMEOUT: Duration = Duration::from_secs(20);

/// A server that ends with the test.
pub(crate) struct Server {
    pub(crate) process: Child,
    /// What it prints first.
    pub(crate) line: String,
    pub(crate) port: u16,
}

impl Server {
    pub(crate) fn start(more: &[&str]) -> Self {
        let all = [&["--quiet", "serve", "--port", "0", "--listen", "127.0.0.1"], more].concat();
        let mut process = heeding_signals(&all).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let port = line.split([':', '/']).find_map(|part| part.parse().ok()).unwrap();
        Self { process, line, port }
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(TIMEOUT)).unwrap();
        stream
    }

    /// A guest in a room, or the status of the answer.
    pub(crate) fn try_enter(&self, code: &str, origin: Option<&str>) -> Result<Guest, u16> {
        let mut request = format!("ws://127.0.0.1:{}/room/{code}", self.port).into_client_request().unwrap();
        if let Some(origin) = origin {
            request.headers_mut().insert("origin", origin.parse().unwrap());
        }
        match tungstenite::client(request, self.connect()) {
            Ok((socket, _)) => Ok(Guest(socket)),
            Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(answer))) => {
                Err(answer.status().as_u16())
            }
            Err(error) => panic!("{error}"),
        }
    }

    pub(crate) fn enter(&self, code: &str) -> Guest {
        self.try_enter(code, None).unwrap()
    }

    pub(crate) fn enter_with_key(&self, code: &str, key: &str) -> Guest {
        self.enter(&format!("{code}?key={key}"))
    }

    /// Guests 0 and 1 of a room, who know of each other.
    pub(crate) fn pair(&self, code: &str) -> (Guest, Guest) {
        let mut one = self.enter(code);
        one.expect(&[0xff, 0, 0]);
        let mut two = self.enter(code);
        two.expect(&[0xff, 0, 1, 0]);
        one.expect(&[0xff, 1, 1]);
        (one, two)
    }

    /// What the server answers to bytes, until it ends the connection.
    pub(crate) fn ask(&self, bytes: &[u8]) -> String {
        let mut stream = self.connect();
        stream.write_all(bytes).unwrap();
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    pub(crate) fn get(&self, path: &str) -> String {
        self.ask(format!("GET {path} HTTP/1.1\r\nhost: here\r\nconnection: close\r\n\r\n").as_bytes())
    }

    pub(crate) fn interrupt(&self) {
        let done = Command::new("kill").args(["-INT", &self.process.id().to_string()]).status().unwrap();
        assert!(done.success());
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

pub(crate) struct Guest(pub(crate) WebSocket<TcpStream>);

impl Guest {
    pub(crate) fn send(&mut self, to: u8, message: &[u8]) {
        self.0.send(Message::binary([&[to], message].concat())).unwrap();
    }

    /// The next frame; none at the end.
    pub(crate) fn next(&mut self) -> Option<Vec<u8>> {
        loop {
            match self.0.read() {
                Ok(Message::Binary(frame)) => return Some(frame.to_vec()),
                Ok(Message::Ping(_) | Message::Pong(_)) => {}
                Ok(Message::Close(_)) => return None,
                Ok(Message::Text(_) | Message::Frame(_)) => panic!("only bytes are sent"),
                Err(tungstenite::Error::Io(error)) if error.kind() == std::io::ErrorKind::WouldBlock => {
                    panic!("nothing came")
                }
                Err(_) => return None,
            }
        }
    }

    pub(crate) fn expect(&mut self, frame: &[u8]) {
        assert_eq!(self.next().as_deref(), Some(frame));
    }

    /// Reads to the end and returns the reason that the server gives.
    pub(crate) fn reason(mut self) -> String {
        let mut last = Vec::new();
        while let Some(frame) = self.next() {
            last = frame;
        }
        assert_eq!(last.get(..2), Some(&[0xff, 3][..]), "a reason comes last");
        String::from_utf8(last[2..].to_vec()).unwrap()
    }
}
