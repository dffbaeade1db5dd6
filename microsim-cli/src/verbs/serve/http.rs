//! Connections: the page's files by HTTP, and the way into rooms by WebSocket, with or without TLS, all at one port.

use super::code::Code;
use super::limits::{HANDSHAKE, LONGEST_KEY, LONGEST_LOAD, MEMBERS, VISITORS};
use super::member::{self, Hall};
use super::page::Page;
use http_body_util::Full;
use hyper::body::{Bytes, Incoming};
use hyper::header::{self, HeaderMap, HeaderName};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Method, Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time;
use tokio_rustls::TlsAcceptor;
use tokio_tungstenite::tungstenite::handshake::server::create_response_with_body;

/// Longest head of a request, bytes; the least that hyper accepts.
const LONGEST_HEAD: usize = 8 * 1024;
/// First byte of a client that speaks TLS: RFC 8446, section 5.1, a handshake.
const TLS: u8 = 22;
/// Pause when the system has no connection left.
const PAUSE: Duration = Duration::from_millis(100);

type Answer = Response<Full<Bytes>>;
/// Counts a connection as long as any part of it is there.
type Permit = Arc<OwnedSemaphorePermit>;

/// What connections share.
pub(super) struct Server {
    hall: Hall,
    page: Page,
    tls: Option<TlsAcceptor>,
    connections: Arc<Semaphore>,
    most: u32,
}

impl Server {
    pub(super) fn new(hall: Hall, page: Page, tls: Option<TlsAcceptor>, rooms: u32) -> Self {
        let most = rooms * MEMBERS as u32 + VISITORS as u32;
        let connections = Arc::new(Semaphore::new(most as usize));
        Self { hall, page, tls, connections, most }
    }

    /// Takes connections for ever.
    pub(super) async fn listen(self: &Arc<Self>, listener: &TcpListener) {
        loop {
            let Ok((stream, _)) = listener.accept().await else {
                time::sleep(PAUSE).await;
                continue;
            };
            // With too many connections a new one is dropped.
            if let Ok(permit) = Arc::clone(&self.connections).try_acquire_owned() {
                tokio::spawn(Arc::clone(self).accept(stream, Arc::new(permit)));
            }
        }
    }

    /// Tells all members that the server stops, and waits until they are gone.
    pub(super) async fn stop(&self) {
        self.hall.stop();
        // Pages that are not gone by then are cut.
        let _ = time::timeout(2 * super::limits::FAREWELL, self.connections.acquire_many(self.most)).await;
    }

    async fn accept(self: Arc<Self>, stream: TcpStream, permit: Permit) {
        // Without it small messages wait for others.
        let _ = stream.set_nodelay(true);
        let Some(tls) = self.tls.clone() else { return self.speak(stream, permit).await };
        let mut first = [0];
        match time::timeout(HANDSHAKE, stream.peek(&mut first)).await {
            Ok(Ok(1)) if first == [TLS] => {
                if let Ok(Ok(stream)) = time::timeout(HANDSHAKE, tls.accept(stream)).await {
                    self.speak(stream, permit).await;
                }
            }
            Ok(Ok(1)) => self.speak(stream, permit).await,
            _ => {}
        }
    }

    async fn speak<S: AsyncRead + AsyncWrite + Unpin + Send + 'static>(self: Arc<Self>, stream: S, permit: Permit) {
        let service = service_fn(|request| {
            let answer = self.answer(request, &permit);
            async { Ok::<_, Infallible>(answer) }
        });
        let mut http = http1::Builder::new();
        http.timer(TokioTimer::new()).header_read_timeout(HANDSHAKE).max_buf_size(LONGEST_HEAD);
        // What goes wrong is the client's to find out.
        let served = http.serve_connection(TokioIo::new(stream), service).with_upgrades();
        let _ = time::timeout(LONGEST_LOAD, served).await;
    }

    fn answer(self: &Arc<Self>, request: Request<Incoming>, permit: &Permit) -> Answer {
        match request.uri().path().strip_prefix("/room/").map(Code::read) {
            Some(Some(code)) => {
                let key = key(request.uri().query()).to_owned();
                self.open(request, code, key, Arc::clone(permit))
            }
            Some(None) => plain(StatusCode::NOT_FOUND, "no code of a room"),
            None => self.file(&request),
        }
    }

    /// Lets a client into a room.
    fn open(self: &Arc<Self>, mut request: Request<Incoming>, code: Code, key: String, permit: Permit) -> Answer {
        if !is_from_here(request.headers()) {
            return plain(StatusCode::FORBIDDEN, "a page of another server");
        }
        let Ok(answer) = create_response_with_body(&request, Full::default) else {
            return plain(StatusCode::BAD_REQUEST, "rooms are for WebSockets");
        };
        let server = Arc::clone(self);
        tokio::spawn(async move {
            if let Ok(stream) = hyper::upgrade::on(&mut request).await {
                member::attend(TokioIo::new(stream), code, key, &server.hall).await;
            }
            drop(permit);
        });
        answer
    }

    fn file(&self, request: &Request<Incoming>) -> Answer {
        if !matches!(*request.method(), Method::GET | Method::HEAD) {
            return plain(StatusCode::METHOD_NOT_ALLOWED, "files are only read");
        }
        let Some(file) = self.page.find(request.uri().path()) else {
            return plain(StatusCode::NOT_FOUND, "no such file");
        };
        with_headers(file.bytes.clone(), &[(header::CONTENT_TYPE, file.kind), (header::CACHE_CONTROL, "no-cache")])
    }
}

/// Whether a browser's page is from this server; what is no browser does not say.
fn is_from_here(headers: &HeaderMap) -> bool {
    let Some(origin) = headers.get(header::ORIGIN) else { return true };
    let host = headers.get(header::HOST).map(|host| host.as_bytes());
    let origin = origin.as_bytes();
    host.is_some_and(|host| [&b"http://"[..], b"https://"].iter().any(|way| origin.strip_prefix(*way) == Some(host)))
}

/// The key of a member in the question of an address; empty if it has none that can be one.
fn key(question: Option<&str>) -> &str {
    let key = question.and_then(|question| question.strip_prefix("key=")).unwrap_or_default();
    let is_key = key.len() <= LONGEST_KEY && key.bytes().all(|byte| byte.is_ascii_alphanumeric());
    if is_key { key } else { "" }
}

fn plain(status: StatusCode, text: &'static str) -> Answer {
    let mut answer = with_headers(Bytes::from_static(text.as_bytes()), &[(header::CONTENT_TYPE, "text/plain")]);
    *answer.status_mut() = status;
    answer
}

fn with_headers(bytes: Bytes, named: &[(HeaderName, &'static str)]) -> Answer {
    let mut answer = Response::new(Full::new(bytes));
    let all = named.iter().chain(&[(header::X_CONTENT_TYPE_OPTIONS, "nosniff")]);
    all.for_each(|(name, value)| drop(answer.headers_mut().insert(name, header::HeaderValue::from_static(value))));
    answer
}
