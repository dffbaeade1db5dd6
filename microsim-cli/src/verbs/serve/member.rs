//! One member: what he sends goes to the room, what the room has for him is sent.

use super::code::Code;
use super::frame;
use super::limits::{Allowance, FAREWELL, LONGEST_MESSAGE, PING, RETURN, SEND_TIMEOUT, SILENCE};
use super::queue::{Receiver, Sender, queue};
use super::rooms::{Place, Refusal, Rooms};
use futures_util::{SinkExt, StreamExt};
use hyper::body::Bytes;
use std::sync::{Mutex, MutexGuard, PoisonError};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::sync::watch;
use tokio::time::{self, Instant};
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::protocol::frame::coding::CloseCode;
use tokio_tungstenite::tungstenite::protocol::{Role, WebSocketConfig};
use tokio_tungstenite::tungstenite::{Error, Message};

/// Bytes that are read at once; there is one such buffer for each member.
const READ_BUFFER: usize = 4 * 1024;

/// Said by a member who goes of its own accord: its place is free at once.
const GOODBYE: &str = "goodbye";

/// All rooms, and whether the server stops.
#[derive(Debug)]
pub(super) struct Hall {
    rooms: Mutex<Rooms<Sender>>,
    stops: watch::Sender<bool>,
}

impl Hall {
    /// `helpers` is what members are told of them.
    pub(super) fn new(most: usize, helpers: Option<Bytes>) -> Self {
        Self {
            rooms: Mutex::new(Rooms::new(most, helpers.as_deref().map(frame::helpers))),
            stops: watch::Sender::new(false),
        }
    }

    /// Tells all members that the server stops.
    pub(super) fn stop(&self) {
        self.stops.send_replace(true);
    }

    fn rooms(&self) -> MutexGuard<'_, Rooms<Sender>> {
        self.rooms.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Lets a connection into a room, until one of them has enough.
pub(super) async fn attend<S: AsyncRead + AsyncWrite + Unpin>(stream: S, code: Code, key: String, hall: &Hall) {
    // A frame is a message and its receiver.
    let config = WebSocketConfig::default()
        .read_buffer_size(READ_BUFFER)
        .max_message_size(Some(LONGEST_MESSAGE + 1))
        .max_frame_size(Some(LONGEST_MESSAGE + 1));
    let mut socket = WebSocketStream::from_raw_socket(stream, Role::Server, Some(config)).await;
    let (outbox, inbox) = queue();
    let joined = hall.rooms().join(code, key, Instant::now().into_std(), outbox);
    let reason = match joined {
        Ok(place) => {
            let reason = converse(&mut socket, inbox, &place, hall).await;
            let until = (reason != Some(GOODBYE)).then(|| (Instant::now() + RETURN).into_std());
            hall.rooms().leave(&place, until);
            reason.filter(|reason| *reason != GOODBYE)
        }
        Err(refusal) => Some(refusal.reason()),
    };
    // Whoever is not there any more is not told.
    let _ = time::timeout(FAREWELL, dismiss(socket, reason)).await;
}

/// Says why, and reads what is on the way: else the system takes back what was said.
async fn dismiss<S: AsyncRead + AsyncWrite + Unpin>(
    mut socket: WebSocketStream<S>,
    reason: Option<&str>,
) -> Result<(), Error> {
    if let Some(reason) = reason {
        socket.send(Message::Binary(frame::refused(reason))).await?;
    }
    let closed = socket.close(None).await;
    let mut stream = socket.into_inner();
    stream.shutdown().await?;
    let mut rest = vec![0; READ_BUFFER];
    while stream.read(&mut rest).await? > 0 {}
    closed
}

/// Passes messages on, both ways, and returns why that ends; none when the connection is cut.
async fn converse<S: AsyncRead + AsyncWrite + Unpin>(
    socket: &mut WebSocketStream<S>,
    mut inbox: Receiver,
    place: &Place,
    hall: &Hall,
) -> Option<&'static str> {
    let begin = Instant::now();
    let (mut heard, mut ready) = (begin, begin);
    let (mut allowance, mut pings) = (Allowance::new(), time::interval_at(begin + PING, PING));
    let mut stops = hall.stops.subscribe();
    loop {
        let may_read = ready <= Instant::now();
        let frame = tokio::select! {
            _ = stops.wait_for(|stops| *stops) => return Some("the server stops"),
            () = time::sleep_until(heard + SILENCE) => return Some("nothing was heard for too long"),
            () = time::sleep_until(ready), if !may_read => continue,
            received = socket.next(), if may_read => {
                heard = Instant::now();
                match read(received) {
                    Ok(message) => {
                        ready = heard + allowance.take(message.len(), heard - begin);
                        match pass_on(&message, place, hall) {
                            Ok(()) => continue,
                            Err(reason) => return Some(reason),
                        }
                    }
                    Err(reason) => return reason,
                }
            }
            frame = inbox.next() => frame.map(Message::Binary),
            _ = pings.tick() => Some(Message::Ping(Bytes::new())),
        };
        let Some(frame) = frame else { return Some(Refusal::TooSlow.reason()) };
        match time::timeout(SEND_TIMEOUT, send(socket, frame, &mut inbox)).await {
            Ok(Ok(())) => {}
            Ok(Err(_)) => return None,
            Err(_) => return Some(Refusal::TooSlow.reason()),
        }
    }
}

/// What a member sends. The error says why he is dropped; none when the connection is cut.
fn read(received: Option<Result<Message, Error>>) -> Result<Message, Option<&'static str>> {
    match received {
        Some(Ok(Message::Text(_))) => Err(Some("text in place of bytes")),
        Some(Err(Error::Capacity(_))) => Err(Some("a message that is too long")),
        Some(Err(Error::Protocol(_) | Error::Utf8(_))) => Err(Some("no WebSocket frame")),
        Some(Ok(Message::Close(ref frame))) if frame.as_ref().is_none_or(|frame| frame.code == CloseCode::Normal) => {
            Err(Some(GOODBYE))
        }
        // A page that is loaded again is away, and one that was hidden for long gives up its connection but not its place.
        None | Some(Err(_) | Ok(Message::Close(_))) => Err(None),
        Some(Ok(message)) => Ok(message),
    }
}

fn pass_on(message: &Message, place: &Place, hall: &Hall) -> Result<(), &'static str> {
    match message {
        Message::Binary(frame) => hall.rooms().relay(place, frame).map_err(Refusal::reason),
        // Signs of life.
        _ => Ok(()),
    }
}

/// Sends a frame, and with it all that waits.
async fn send<S: AsyncRead + AsyncWrite + Unpin>(
    socket: &mut WebSocketStream<S>,
    frame: Message,
    inbox: &mut Receiver,
) -> Result<(), Error> {
    socket.feed(frame).await?;
    while let Some(frame) = inbox.ready() {
        socket.feed(Message::Binary(frame)).await?;
    }
    socket.flush().await
}
