//! The port of this window for all channels: its packets go by themselves, or by a server that carries them.

use super::helper::{Helper, Told};
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Instant;
use str0m::Candidate;
use str0m::net::Transmit;

/// Longest packet, bytes: that of an Ethernet.
const LONGEST_PACKET: usize = 1500;
/// Most servers that are asked.
const MOST_HELPERS: usize = 8;

/// What has come, from whom, and to which of our addresses.
pub(super) struct Packet {
    pub source: SocketAddr,
    pub destination: SocketAddr,
    pub bytes: Vec<u8>,
}

pub(super) struct Port {
    socket: UdpSocket,
    address: SocketAddr,
    /// Servers that are looked up.
    looked_up: Option<Receiver<Helper>>,
    helpers: Vec<Helper>,
    /// Where others may find it, as far as that is known.
    pub candidates: Vec<Candidate>,
}

impl Port {
    /// A port at the address from which the server is reached, or from which others would be if it is on this machine; none if the
    /// system gives no socket.
    pub(super) fn new(own: IpAddr) -> Option<Self> {
        let own = if own.is_loopback() { outward().unwrap_or(own) } else { own };
        let socket = UdpSocket::bind((own, 0)).ok()?;
        socket.set_nonblocking(true).ok()?;
        let address = socket.local_addr().ok()?;
        let candidates = vec![Candidate::host(address, "udp").ok()?];
        Some(Self { socket, address, looked_up: None, helpers: Vec::new(), candidates })
    }

    pub(super) fn address(&self) -> SocketAddr {
        self.address
    }

    /// Takes the servers that the room tells of; only the first time.
    pub(super) fn ask(&mut self, told: &[u8]) {
        let Ok(told) = serde_json::from_slice::<Vec<Told>>(told) else { return };
        if self.looked_up.is_some() {
            return;
        }
        let (sender, receiver) = channel();
        let own = self.address;
        let look_up = move || {
            for found in told.into_iter().take(MOST_HELPERS).filter_map(|told| told.find(own)) {
                // Nobody receives it when the room has been left meanwhile.
                if sender.send(found).is_err() {
                    return;
                }
            }
        };
        if thread::Builder::new().name("helpers".to_owned()).spawn(look_up).is_ok() {
            self.looked_up = Some(receiver);
        }
    }

    /// Does what is due, and returns where else others may find it.
    pub(super) fn drive(&mut self, now: Instant) -> Vec<Candidate> {
        self.helpers.extend(self.looked_up.iter().flat_map(Receiver::try_iter));
        let socket = &self.socket;
        let found: Vec<Candidate> = self.helpers.iter_mut().flat_map(|helper| helper.drive(socket, now)).collect();
        self.candidates.extend_from_slice(&found);
        found
    }

    /// The next packet, if one has come; none of it if it was for the port itself.
    pub(super) fn receive(&mut self, now: Instant) -> io::Result<Option<Packet>> {
        let mut packet = [0; LONGEST_PACKET];
        let (length, source) = self.socket.recv_from(&mut packet)?;
        let bytes = &packet[..length];
        let mut helpers = self.helpers.iter_mut().filter(|helper| helper.server() == source).peekable();
        if helpers.peek().is_none() {
            return Ok(Some(Packet { source, destination: self.address, bytes: bytes.to_vec() }));
        }
        Ok(helpers.find_map(|helper| {
            let (source, bytes) = helper.take(bytes, now)?;
            Some(Packet { source, destination: helper.relayed()?, bytes })
        }))
    }

    /// Sends a packet; one that cannot be sent is lost.
    pub(super) fn send(&mut self, packet: &Transmit, now: Instant) {
        match self.helpers.iter_mut().find(|helper| helper.relayed() == Some(packet.source)) {
            Some(helper) => helper.carry(&packet.contents, packet.destination, &self.socket, now),
            None => drop(self.socket.send_to(&packet.contents, packet.destination)),
        }
    }
}

impl Drop for Port {
    fn drop(&mut self) {
        self.helpers.iter_mut().for_each(|helper| helper.leave(&self.socket));
    }
}

/// The address of this machine in its network: the one that it would send from. Nothing is sent; the address to send to is
/// one of those for documentation (RFC 5737).
fn outward() -> Option<IpAddr> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
    socket.connect((Ipv4Addr::new(192, 0, 2, 1), 9)).ok()?;
    Some(socket.local_addr().ok()?.ip())
}

#[cfg(test)]
mod tests {
    use super::super::helper::PAUSE;
    use super::*;
    use std::time::Duration;
    use turn_client_proto::types::stun::attribute::XorMappedAddress;
    use turn_client_proto::types::stun::message::{Message, MessageWriteVec, TransactionId};
    use turn_client_proto::types::stun::prelude::{MessageWrite, MessageWriteExt};

    /// A port, a server that it asks, and the port's first question.
    fn asked() -> (Port, UdpSocket, Vec<u8>) {
        let mut port = Port::new(Ipv4Addr::LOCALHOST.into()).unwrap();
        let server = UdpSocket::bind((port.address.ip(), 0)).unwrap();
        server.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        let noise = r#"{"urls":"stun:["},{"urls":"turn:127.0.0.1"},{"urls":"turns:127.0.0.1"},{"urls":""}"#;
        port.ask(format!(r#"[{noise},{{"urls":"stun:{}"}}]"#, server.local_addr().unwrap()).as_bytes());
        let begin = Instant::now();
        while port.helpers.is_empty() {
            assert!(begin.elapsed() < Duration::from_secs(20));
            assert!(port.drive(Instant::now()).is_empty());
        }
        port.drive(Instant::now());
        let question = question(&server);
        (port, server, question)
    }

    fn question(server: &UdpSocket) -> Vec<u8> {
        let mut bytes = [0; LONGEST_PACKET];
        let length = server.recv(&mut bytes).unwrap();
        bytes[..length].to_vec()
    }

    fn answer(question: &[u8], address: &str) -> Vec<u8> {
        let question = Message::from_bytes(question).unwrap();
        told(Message::builder_success(&question, MessageWriteVec::new()), question.transaction_id(), address)
    }

    fn told(mut answer: impl MessageWrite<Output = Vec<u8>>, question: TransactionId, address: &str) -> Vec<u8> {
        answer.add_attribute(&XorMappedAddress::new(address.parse().unwrap(), question)).unwrap();
        answer.finish()
    }

    /// What is found after one packet.
    fn found(port: &mut Port, from: &UdpSocket, packet: &[u8], now: Instant) -> Vec<String> {
        from.send_to(packet, port.address).unwrap();
        let begin = Instant::now();
        while port.receive(now).is_err() {
            assert!(begin.elapsed() < Duration::from_secs(20));
        }
        port.drive(now).iter().map(Candidate::to_sdp_string).collect()
    }

    #[test]
    fn a_server_tells_the_port_its_address_again_and_again() {
        let (mut port, server, first) = asked();
        let mut now = Instant::now();
        let candidates = found(&mut port, &server, &answer(&first, "203.0.113.7:40000"), now);
        assert!(matches!(&candidates[..], [one] if one.contains(" 203.0.113.7 40000 typ srflx")), "{candidates:?}");
        for (address, count) in [("203.0.113.7:40000", 0), ("203.0.113.7:40001", 1)] {
            now += PAUSE;
            port.drive(now);
            assert_eq!(found(&mut port, &server, &answer(&question(&server), address), now).len(), count);
        }
        assert_eq!(port.candidates.len(), 3, "the own address and two that were told");
    }

    #[test]
    fn an_answer_that_is_none_changes_nothing() {
        let (mut port, server, first) = asked();
        let now = Instant::now();
        let right = answer(&first, "203.0.113.7:40000");
        let mut of_another_question = right.clone();
        of_another_question[19] ^= 1;
        let stranger = UdpSocket::bind((port.address.ip(), 0)).unwrap();
        assert!(found(&mut port, &stranger, &right, now).is_empty(), "of another address");
        for wrong in [&of_another_question[..], &right[..19], &right[..right.len() - 4], &first, b"", &[0xff; 40]] {
            assert!(found(&mut port, &server, wrong, now).is_empty(), "{wrong:?}");
        }
        assert_eq!(found(&mut port, &server, &right, now).len(), 1);
        assert!(found(&mut port, &server, &right, now).is_empty(), "twice");
    }

    #[test]
    fn an_address_that_cannot_be_ours_is_none() {
        let (mut port, server, mut question_) = asked();
        let mut now = Instant::now();
        for address in ["[2001:db8::1]:40000", "0.0.0.0:40000", "224.0.0.1:40000"] {
            assert!(found(&mut port, &server, &answer(&question_, address), now).is_empty(), "{address}");
            now += PAUSE;
            port.drive(now);
            question_ = question(&server);
        }
        let of = Message::from_bytes(&question_).unwrap();
        let error = Message::builder_error(&of, MessageWriteVec::new());
        let refused = told(error, of.transaction_id(), "203.0.113.7:40000");
        assert!(found(&mut port, &server, &refused, now).is_empty());
    }
}
