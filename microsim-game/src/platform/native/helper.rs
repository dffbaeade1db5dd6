//! A server that tells this window its address (STUN, RFC 8489), and may carry packets for it (TURN, RFC 8656). What comes from it may be
//! anything.

use serde::Deserialize;
use std::net::{IpAddr, SocketAddr, ToSocketAddrs, UdpSocket};
use std::time::{Duration, Instant};
use str0m::Candidate;
use turn_client_proto::api::{Transmit, TurnConfig, TurnEvent, TurnRecvRet};
use turn_client_proto::prelude::TurnClientApi;
use turn_client_proto::stun::Instant as Moment;
use turn_client_proto::stun::agent::StunAgent;
use turn_client_proto::types::stun::attribute::XorMappedAddress;
use turn_client_proto::types::stun::message::{BINDING, Message, MessageClass, MessageWriteVec};
use turn_client_proto::types::stun::prelude::MessageWrite;
use turn_client_proto::types::{AddressFamily, TransportType, TurnCredentials};
use turn_client_proto::udp::TurnClientUdp;

/// Port unless another is named (RFC 8489).
const PORT: u16 = 3478;
/// Time between two questions: routers keep a path that long (RFC 8445).
pub(super) const PAUSE: Duration = Duration::from_secs(15);
/// How a question is sent again: first and longest pause, times, and the wait after the last one. All is less than [`PAUSE`].
const AGAIN: (Duration, Duration, u32, Duration) =
    (Duration::from_millis(500), Duration::from_secs(4), 4, Duration::from_secs(8));
/// Most addresses of a server in its answers.
const MOST_ADDRESSES: usize = 4;
/// Most addresses that a relay is asked to let in.
const MOST_PEERS: usize = 64;

/// A server as the room tells of it.
#[derive(Deserialize)]
pub(super) struct Told {
    urls: String,
    username: Option<String>,
    credential: Option<String>,
}

impl Told {
    /// Looks the server up, which may take long; none if it is of no use for a port with this address.
    pub(super) fn find(self, own: SocketAddr) -> Option<Helper> {
        let (kind, host) = self.urls.split_once(':')?;
        let credentials = match kind {
            "stun" => None,
            "turn" => Some(TurnCredentials::new(&self.username?, &self.credential?)),
            _ => return None,
        };
        let has_port = host.rsplit_once(':').is_some_and(|(_, port)| !port.contains(']'));
        let host = if has_port { host.to_owned() } else { format!("{host}:{PORT}") };
        let server = host.to_socket_addrs().ok()?.find(|server| server.is_ipv4() == own.is_ipv4())?;
        Some(Helper::new(own, server, credentials))
    }
}

pub(super) struct Helper {
    own: SocketAddr,
    server: SocketAddr,
    begin: Instant,
    /// When it is asked next.
    next: Instant,
    questions: StunAgent,
    /// Addresses that it has told.
    addresses: Vec<SocketAddr>,
    relay: Option<TurnClientUdp>,
    relayed: Option<SocketAddr>,
    /// Whom the relay was asked to let in.
    peers: Vec<IpAddr>,
    found: Vec<Candidate>,
}

impl Helper {
    fn new(own: SocketAddr, server: SocketAddr, credentials: Option<TurnCredentials>) -> Self {
        let questions = StunAgent::builder(TransportType::Udp, own).remote_addr(server);
        let questions = questions.request_retransmits(AGAIN.0, AGAIN.1, AGAIN.2, AGAIN.3).build();
        let relay = credentials.map(|credentials| {
            let mut config = TurnConfig::new(credentials);
            config.set_address_family(if own.is_ipv4() { AddressFamily::IPV4 } else { AddressFamily::IPV6 });
            TurnClientUdp::allocate(own, server, config)
        });
        let (now, addresses, peers, found) = (Instant::now(), Vec::new(), Vec::new(), Vec::new());
        Self { own, server, begin: now, next: now, questions, addresses, relay, relayed: None, peers, found }
    }

    pub(super) fn server(&self) -> SocketAddr {
        self.server
    }

    /// The address at which it takes packets for this window, if it does.
    pub(super) fn relayed(&self) -> Option<SocketAddr> {
        self.relayed
    }

    fn moment(&self, now: Instant) -> Moment {
        Moment::ZERO + now.duration_since(self.begin)
    }

    /// Does what is due, and returns what was found since the last call.
    pub(super) fn drive(&mut self, socket: &UdpSocket, now: Instant) -> std::vec::Drain<'_, Candidate> {
        self.ask(socket, now);
        let (moment, own) = (self.moment(now), self.own);
        if let Some(relay) = &mut self.relay {
            relay.poll(moment);
            while let Some(packet) = relay.poll_transmit(moment) {
                // As with all packets: what cannot be sent is lost.
                let _ = socket.send_to(&packet.data, packet.to);
            }
            while let Some(event) = relay.poll_event() {
                if let TurnEvent::AllocationCreated(_, address) = event {
                    self.relayed = Some(address);
                    self.found.extend(Candidate::relayed(address, own, "udp"));
                }
            }
        }
        self.found.drain(..)
    }

    fn ask(&mut self, socket: &UdpSocket, now: Instant) {
        let moment = self.moment(now);
        self.questions.poll(moment);
        if now >= self.next {
            self.next = now + PAUSE;
            let question = Message::builder_request(BINDING, MessageWriteVec::new()).finish();
            if let Ok(packet) = self.questions.send_request(question, self.server, moment) {
                let _ = socket.send_to(&packet.data, packet.to);
            }
        }
        while let Some(packet) = self.questions.poll_transmit(moment) {
            let _ = socket.send_to(packet.data, packet.to);
        }
    }

    /// Takes a packet of the server, and returns what a member has sent by it, and from where.
    pub(super) fn take(&mut self, packet: &[u8], now: Instant) -> Option<(SocketAddr, Vec<u8>)> {
        let moment = self.moment(now);
        if let Ok(message) = Message::from_bytes(packet)
            && message.is_response()
            && self.questions.handle_stun_message_with_time(&message, self.server, moment)
        {
            self.note(&message);
            return None;
        }
        let packet = Transmit::new(packet, TransportType::Udp, self.server, self.own);
        match self.relay.as_mut()?.recv(packet, moment) {
            TurnRecvRet::PeerData(data) => Some((data.peer, data.data().to_vec())),
            _ => None,
        }
    }

    /// Takes note of an address that the server tells.
    fn note(&mut self, answer: &Message<'_>) {
        let Ok(told) = answer.attribute::<XorMappedAddress>() else { return };
        let address = told.addr(answer.transaction_id());
        let is_new = address != self.own && !self.addresses.contains(&address);
        if answer.has_class(MessageClass::Success) && is_new && self.addresses.len() < MOST_ADDRESSES {
            self.addresses.push(address);
            self.found.extend(Candidate::server_reflexive(address, self.own, "udp"));
        }
    }

    /// Sends a packet to a member by the relay; it is lost until the relay lets that member in.
    pub(super) fn carry(&mut self, packet: &[u8], to: SocketAddr, socket: &UdpSocket, now: Instant) {
        let moment = self.moment(now);
        let Some(relay) = &mut self.relay else { return };
        if let Ok(Some(packet)) = relay.send_to(TransportType::Udp, to, packet, moment) {
            let packet = packet.build();
            let _ = socket.send_to(&packet.data, packet.to);
        } else if !self.peers.contains(&to.ip()) && self.peers.len() < MOST_PEERS {
            self.peers.push(to.ip());
            // Asked once: an answer that says no is not argued with.
            let _ = relay.create_permission(TransportType::Udp, to.ip(), moment);
        }
    }

    /// Tells a relay that it is no longer needed.
    pub(super) fn leave(&mut self, socket: &UdpSocket) {
        let moment = self.moment(Instant::now() + PAUSE);
        let Some(relay) = &mut self.relay else { return };
        if relay.delete(moment).is_ok()
            && let Some(packet) = relay.poll_transmit(moment)
        {
            let _ = socket.send_to(&packet.data, packet.to);
        }
    }
}
