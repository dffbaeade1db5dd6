//! `serve`: the page and rooms to play in together, at one port.

mod code;
mod frame;
mod helper;
mod http;
mod limits;
mod member;
mod page;
mod queue;
mod rooms;
mod tls;

use crate::console::{Console, print};
use crate::failure::Failure;
use crate::interrupt;
use code::Code;
use helper::Helper;
use http::Server;
use member::Hall;
use page::Page;
use qrcode::QrCode;
use qrcode::render::unicode::Dense1x2;
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpListener;

/// Time between two looks whether Ctrl-C was pressed.
const LOOK: Duration = Duration::from_millis(50);

#[derive(Debug, clap::Args)]
#[command(after_help = limits::help())]
pub(crate) struct ServeArgs {
    /// Port to listen at; 0: any that is free
    #[arg(long, value_name = "PORT", default_value_t = 8080)]
    port: u16,
    /// Address to listen at; 0.0.0.0: all of this machine
    #[arg(long, value_name = "ADDRESS", default_value_t = Ipv4Addr::UNSPECIFIED.into())]
    listen: IpAddr,
    /// Folder of the page, as `microsim-game/web/build` makes it; without it there are rooms only
    #[arg(long, value_name = "DIR")]
    page: Option<PathBuf>,
    /// Most rooms at the same time
    #[arg(long, value_name = "N", default_value_t = limits::ROOMS, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    rooms: u32,
    /// STUN server, HOST or HOST:PORT, that members are told of: it tells them their own address. Repeatable
    #[arg(long, value_name = "SERVER", value_parser = helper::stun)]
    stun: Vec<Helper>,
    /// TURN server, NAME:PASSWORD@HOST:PORT, that members are told of, password too: it carries what finds no path. Repeatable
    #[arg(long, value_name = "SERVER", value_parser = helper::turn)]
    turn: Vec<Helper>,
    /// Certificates in PEM, for https and wss at the same port
    #[arg(long, value_name = "FILE", requires = "key")]
    certificate: Option<PathBuf>,
    /// Key of the certificate, in PEM
    #[arg(long, value_name = "FILE", requires = "certificate")]
    key: Option<PathBuf>,
}

pub(crate) fn serve(args: &ServeArgs, console: &Console) -> Result<(), Failure> {
    interrupt::listen();
    let folder = args.page.as_deref();
    let page = folder.map(|folder| Page::read(folder).map_err(|error| Failure::file("serve", folder, &error)));
    let secured = args.certificate.as_deref().zip(args.key.as_deref());
    let tls = secured.map(|(certificate, key)| tls::acceptor(certificate, key)).transpose()?;
    let scheme = if tls.is_some() { "https" } else { "http" };
    let hall = Hall::new(args.rooms as usize, helper::told(&[&args.stun[..], &args.turn].concat()));
    let server = Arc::new(Server::new(hall, page.transpose()?.unwrap_or_default(), tls, args.rooms));
    let failed = |error: io::Error| {
        Failure::Message(format!("cannot listen at {}: {error}", SocketAddr::new(args.listen, args.port)))
    };
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().map_err(failed)?;
    runtime.block_on(async {
        let listener = TcpListener::bind((args.listen, args.port)).await.map_err(failed)?;
        announce(scheme, listener.local_addr().map_err(failed)?, console)?;
        tokio::select! {
            () = server.listen(&listener) => {}
            () = interruption() => {}
        }
        drop(listener);
        server.stop().await;
        Err(Failure::Interrupted)
    })
}

async fn interruption() {
    while !interrupt::is_asked() {
        tokio::time::sleep(LOOK).await;
    }
}

/// Prints the address of a new room, for people and for cameras.
fn announce(scheme: &str, at: SocketAddr, console: &Console) -> Result<(), Failure> {
    let code = Code::random().map_err(|error| Failure::Message(format!("no random number: {error}")))?;
    let host = if at.ip().is_unspecified() { own_address().unwrap_or(Ipv4Addr::LOCALHOST.into()) } else { at.ip() };
    let address = format!("{scheme}://{}/?room={code}", SocketAddr::new(host, at.port()));
    print(format!("{address}\n"))?;
    if let Ok(picture) = QrCode::new(&address) {
        // Terminals are dark: what is drawn is what is light in the code.
        let picture = picture.render().dark_color(Dense1x2::Light).light_color(Dense1x2::Dark).build();
        picture.lines().for_each(|line| console.note(line));
    }
    console.note(&format!("On this machine: {scheme}://localhost:{}/?room={code}. Ctrl-C ends.", at.port()));
    Ok(())
}

/// The address of this machine in its network: the one that it would send from. Nothing is sent; the address to send to is
/// one of those for documentation (RFC 5737).
fn own_address() -> io::Result<IpAddr> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0))?;
    socket.connect((Ipv4Addr::new(192, 0, 2, 1), 9))?;
    Ok(socket.local_addr()?.ip())
}
