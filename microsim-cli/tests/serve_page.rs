//! What `microsim serve` serves besides rooms: the page, also by TLS, and its help in the documentation.

#![cfg(unix)]

mod common;
#[path = "common/serve.rs"]
mod serve;

use common::{Folder, refused, stdout};
use serve::Server;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::sync::Arc;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::CertificateDer;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::{ClientConfig, ClientConnection, RootCertStore, StreamOwned};
use tungstenite::Message;

#[test]
fn the_page_is_served_and_nothing_else() {
    let folder = Folder::new("serve-page");
    folder.file("secret.txt", b"secret");
    std::fs::create_dir_all(folder.root().join("page/more")).unwrap();
    folder.file("page/index.html", b"<p>page</p>");
    folder.file("page/game.wasm", b"\0asm");
    folder.file("page/more/a.js", b"1");
    let server = Server::start(&["--page", &folder.path("page")]);
    let index = server.get("/?room=K7M2QX");
    assert!(index.starts_with("HTTP/1.1 200") && index.ends_with("<p>page</p>"), "{index}");
    assert!(index.contains("content-type: text/html") && index.contains("nosniff"), "{index}");
    assert!(server.get("/game.wasm").contains("content-type: application/wasm"));
    assert!(server.get("/more/a.js").ends_with("\r\n\r\n1"));
    for path in ["/../secret.txt", "/%2e%2e/secret.txt", "//secret.txt", "/more", "/game.wasm/", "/index.html%00"] {
        assert!(server.get(path).starts_with("HTTP/1.1 404"), "{path}");
    }
    assert!(server.ask(b"POST / HTTP/1.1\r\nhost: here\r\nconnection: close\r\n\r\n").starts_with("HTTP/1.1 405"));
    std::os::unix::fs::symlink(folder.root().join("secret.txt"), folder.root().join("page/link.txt")).unwrap();
    refused(&["serve", "--port", "0", "--page", &folder.path("page")], "is not a regular file");
}

/// A certificate that is its own issuer, and its key, made now.
fn certificate(folder: &Folder) -> [String; 2] {
    let [certificate, key] = ["certificate.pem", "key.pem"].map(|name| folder.path(name));
    let more = ["subjectAltName=DNS:localhost", "basicConstraints=critical,CA:FALSE"];
    let mut command = Command::new("openssl");
    command.args(["req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2"]);
    command.args([
        "-subj",
        "/CN=localhost",
        "-addext",
        more[0],
        "-addext",
        more[1],
        "-keyout",
        &key,
        "-out",
        &certificate,
    ]);
    let made = command.stderr(Stdio::null()).status().expect("openssl is there");
    assert!(made.success());
    [certificate, key]
}

fn secured(server: &Server, trusted: &[CertificateDer<'static>]) -> StreamOwned<ClientConnection, TcpStream> {
    let mut roots = RootCertStore::empty();
    trusted.iter().for_each(|certificate| roots.add(certificate.clone()).unwrap());
    let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
        .with_safe_default_protocol_versions()
        .unwrap()
        .with_root_certificates(roots)
        .with_no_client_auth();
    let connection = ClientConnection::new(Arc::new(config), "localhost".try_into().unwrap()).unwrap();
    StreamOwned::new(connection, server.connect())
}

#[test]
fn a_page_and_a_room_are_served_by_tls_with_a_certificate() {
    let folder = Folder::new("serve-tls");
    std::fs::create_dir_all(folder.root().join("page")).unwrap();
    folder.file("page/index.html", b"<p>page</p>");
    let [certificate, key] = certificate(&folder);
    let server = Server::start(&["--page", &folder.path("page"), "--certificate", &certificate, "--key", &key]);
    assert!(server.line.starts_with("https://"), "{}", server.line);
    let own = [CertificateDer::from_pem_file(&certificate).unwrap()];
    let mut stream = secured(&server, &own);
    stream.write_all(b"GET / HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n").unwrap();
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    let answer = String::from_utf8_lossy(&answer);
    assert!(answer.starts_with("HTTP/1.1 200") && answer.ends_with("<p>page</p>"), "{answer}");
    let (mut socket, _) = tungstenite::client("wss://localhost/room/ROOM", secured(&server, &own)).unwrap();
    assert_eq!(socket.read().unwrap(), Message::binary([0xff, 0, 0].to_vec()));
    assert!(server.get("/").ends_with("<p>page</p>"), "the same port speaks http");
    assert!(secured(&server, &[]).write_all(b"GET").is_err(), "nobody else trusts it");
    let all = ["serve", "--port", "0", "--certificate", &key, "--key", &certificate];
    refused(&all, "certificate.pem");
}

#[test]
fn the_page_of_the_documentation_has_the_help() {
    let help = stdout(&common::success(&["serve", "--help"]));
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/network.md")).unwrap();
    assert!(page.contains(&help), "{help}");
}
