//! Channels from this window to the other members of a room, without the server between (WebRTC): docs/network.md has the signals.
//! What comes from another member may be anything.

use super::port::Port;
use super::way::{Signal, Way};
use crate::network::relay::{BACK, HELPERS, JOINED, LEFT, MEMBERS, NOTICE, SIGNAL};
use crate::network::transport::{Member, Notice};
use std::fmt;
use std::net::IpAddr;
use std::time::{Duration, Instant};

/// Most offers of a member; one may have been for who had this number before.
const MOST_OFFERS: u8 = 3;
/// Shortest time between two offers to a number, however often somebody comes with it.
const PAUSE: Duration = Duration::from_secs(2);
/// Longest signal, bytes.
const LONGEST_SIGNAL: usize = 8192;
/// Most packets that are taken at once.
const MOST_PACKETS: usize = 2000;

/// The channels of one room.
pub(super) struct Mesh {
    port: Port,
    ways: [Option<Way>; MEMBERS as usize],
    /// How many offers have come, by member.
    offers: [u8; MEMBERS as usize],
    /// Who has come and is to be offered a way, and from when on, by member.
    has_come: [bool; MEMBERS as usize],
    next: [Instant; MEMBERS as usize],
    attempts: u8,
}

impl Mesh {
    /// Channels that begin at a port of this address; none if there is none.
    pub(super) fn new(own: IpAddr) -> Option<Self> {
        let port = Port::new(own)?;
        let (ways, offers, has_come) = (Default::default(), Default::default(), Default::default());
        Some(Self { port, ways, offers, has_come, next: [Instant::now(); MEMBERS as usize], attempts: 0 })
    }

    /// Takes what the server has sent, and returns a frame that is to be sent to it.
    pub(super) fn take(&mut self, frame: &[u8]) -> Option<Vec<u8>> {
        let (member, signal) = match *frame {
            [NOTICE, HELPERS, ref told @ ..] => {
                self.port.ask(told);
                return None;
            }
            [NOTICE, kind @ (JOINED | LEFT | BACK), member] if member < MEMBERS => {
                self.ways[usize::from(member)] = None;
                // Who is there already offers a way to who comes.
                self.has_come[usize::from(member)] = kind != LEFT;
                (member, self.offer(member))
            }
            [member, SIGNAL, ref signal @ ..] if member < MEMBERS && signal.len() <= LONGEST_SIGNAL => {
                (member, self.hear(member, &Signal::read(signal)?))
            }
            _ => return None,
        };
        Some(signal_to(member, &signal?))
    }

    /// Offers that had to wait, and what was found since they were made, as frames that are to be sent.
    pub(super) fn late_signals(&mut self) -> Vec<Vec<u8>> {
        let mut frames = Vec::new();
        for found in self.port.drive(Instant::now()) {
            let told =
                (0..).zip(&mut self.ways).filter_map(|(member, way)| Some((member, way.as_mut()?.tell(&found)?)));
            frames.extend(told.map(|(member, signal)| signal_to(member, &signal)));
        }
        frames.extend((0..MEMBERS).filter_map(|member| Some(signal_to(member, &self.offer(member)?))));
        frames
    }

    /// Offers a way to a member who has come, if it is time.
    fn offer(&mut self, member: Member) -> Option<Signal> {
        let (place, now) = (usize::from(member), Instant::now());
        if !self.has_come[place] || now < self.next[place] {
            return None;
        }
        (self.has_come[place], self.offers[place], self.next[place]) = (false, 0, now + PAUSE);
        self.attempts = self.attempts.wrapping_add(1);
        let (way, offer) = Way::offer(self.attempts, &self.port.candidates)?;
        self.ways[place] = Some(way);
        Some(offer)
    }

    fn hear(&mut self, member: Member, signal: &Signal) -> Option<Signal> {
        let place = usize::from(member);
        if !signal.is_offer() {
            let way = self.ways[place].as_mut().filter(|way| way.attempt() == signal.attempt)?;
            way.take(signal);
            return None;
        }
        self.offers[place] = self.offers[place].saturating_add(1);
        if self.offers[place] > MOST_OFFERS {
            return None;
        }
        (self.ways[place], self.has_come[place]) = (None, false);
        let (way, answer) = Way::answer(signal, &self.port.candidates)?;
        self.ways[place] = Some(way);
        Some(answer)
    }

    /// What has come by channels.
    pub(super) fn poll(&mut self) -> Vec<Notice> {
        let now = Instant::now();
        for _ in 0..MOST_PACKETS {
            let Ok(packet) = self.port.receive(now) else { break };
            if let Some(packet) = packet {
                self.ways.iter_mut().flatten().any(|way| way.receive(&packet, &mut self.port, now));
            }
        }
        let mut notices = Vec::new();
        for (from, place) in (0..).zip(&mut self.ways) {
            let Some(way) = place else { continue };
            way.drive(&mut self.port, now);
            notices.extend(way.messages().map(|bytes| Notice::Message { from, bytes }));
            if way.is_lost() {
                *place = None;
            }
        }
        notices
    }

    /// Sends a message by a channel, and returns whether it need not go by the server as well.
    pub(super) fn send(&mut self, to: Member, message: &[u8]) -> bool {
        let way = self.ways.get_mut(usize::from(to)).and_then(Option::as_mut);
        way.is_some_and(|way| way.send(message, &mut self.port, Instant::now()))
    }
}

impl fmt::Debug for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mesh").field("address", &self.port.address()).finish_non_exhaustive()
    }
}

fn signal_to(member: Member, signal: &Signal) -> Vec<u8> {
    [&[member, SIGNAL][..], &signal.write()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::Ipv4Addr;
    use std::process::{Child, Command};
    use std::thread;
    use std::time::Duration;
    use str0m::CandidateKind;

    const TIMEOUT: Duration = Duration::from_secs(20);

    fn pair() -> (Mesh, Mesh) {
        let own = Ipv4Addr::LOCALHOST.into();
        (Mesh::new(own).unwrap(), Mesh::new(own).unwrap())
    }

    /// Carries a frame of a member to another one, as the server does.
    fn carried(from: Member, frame: &[u8]) -> Vec<u8> {
        [&[from], &frame[1..]].concat()
    }

    /// Members 0 and 1, whose channel is open.
    fn meshed() -> (Mesh, Mesh) {
        let (one, two) = pair();
        opened(one, two)
    }

    fn opened(mut one: Mesh, mut two: Mesh) -> (Mesh, Mesh) {
        let offer = one.take(&[NOTICE, JOINED, 1]).unwrap();
        let answer = two.take(&carried(0, &offer)).unwrap();
        assert_eq!(one.take(&carried(1, &answer)), None);
        let begin = Instant::now();
        while !(one.send(1, b"?") && two.send(0, b"?")) {
            assert!(begin.elapsed() < TIMEOUT, "no channel opens");
            turn(&mut one);
            turn(&mut two);
            thread::sleep(Duration::from_millis(1));
        }
        (one, two)
    }

    /// What a room does in a frame; nothing is told that comes late.
    fn turn(mesh: &mut Mesh) -> Vec<Notice> {
        mesh.late_signals();
        mesh.poll()
    }

    fn next(mesh: &mut Mesh, other: &mut Mesh) -> Notice {
        let begin = Instant::now();
        loop {
            turn(other);
            let notices = turn(mesh);
            let found =
                notices.into_iter().find(|notice| !matches!(notice, Notice::Message { bytes, .. } if bytes == b"?"));
            if let Some(notice) = found {
                return notice;
            }
            assert!(begin.elapsed() < TIMEOUT, "nothing comes");
            thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn members_speak_by_a_channel_until_one_leaves() {
        let (mut one, mut two) = meshed();
        assert!(one.send(1, b"eat"));
        assert_eq!(next(&mut two, &mut one), Notice::Message { from: 0, bytes: b"eat".to_vec() });
        assert!(two.send(0, &[7; 1100]));
        assert_eq!(next(&mut one, &mut two), Notice::Message { from: 1, bytes: vec![7; 1100] });
        assert!(!two.send(0, &[7; 1101]), "long ones go by the server");
        assert_eq!(one.take(&[NOTICE, LEFT, 1]), None);
        assert!(!one.send(1, b"eat"));
    }

    #[test]
    fn who_comes_again_and_again_is_offered_a_way_when_it_is_time() {
        let (mut one, _) = pair();
        assert!(one.take(&[NOTICE, JOINED, 1]).is_some());
        one.offers[1] = MOST_OFFERS;
        for kind in [LEFT, JOINED, BACK] {
            assert_eq!(one.take(&[NOTICE, kind, 1]), None);
        }
        assert!(one.late_signals().is_empty() && one.offers[1] == MOST_OFFERS);
        one.next[1] = Instant::now();
        assert_eq!((one.late_signals().len(), one.offers[1]), (1, 0));
        assert!(one.late_signals().is_empty());
    }

    #[test]
    fn who_floods_a_channel_loses_it() {
        let (mut one, mut two) = meshed();
        let begin = Instant::now();
        let mut come = 0;
        while one.ways[1].is_some() {
            assert!(begin.elapsed() < TIMEOUT, "{come} have come");
            for _ in 0..100 {
                two.send(0, b"!");
            }
            come += one.poll().len();
            two.poll();
        }
        assert!(!one.send(1, b"eat"));
    }

    #[test]
    fn signals_that_are_none_change_nothing() {
        let (mut one, mut two) = meshed();
        let mut state = 1u64;
        let mut byte = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 56) as u8
        };
        let offer = two.take(&[NOTICE, JOINED, 2]).unwrap();
        for _ in 0..2000 {
            // A damaged offer, or noise, of a member without a way.
            let mut frame = carried(3, &offer);
            let place = 2 + usize::from(byte()) % (frame.len() - 2);
            frame[place] = byte();
            frame.truncate(2 + usize::from(byte()) * 4);
            let _ = one.take(&frame);
            one.offers[3] = 0;
        }
        one.poll();
        assert!(one.send(1, b"eat") && one.take(&[3, SIGNAL]).is_none() && one.take(&[9, SIGNAL, 0, 0]).is_none());
        assert_eq!(next(&mut two, &mut one), Notice::Message { from: 0, bytes: b"eat".to_vec() });
        (0..9).for_each(|_| drop(one.take(&carried(3, &offer))));
        assert_eq!(one.offers[3], 9);
        assert!(one.take(&carried(3, &offer)).is_none(), "no more than three are answered");
    }

    /// A program that ends with its test.
    struct Program(Child);

    impl Drop for Program {
        fn drop(&mut self) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }

    /// Both members are told to speak by the relay only.
    #[test]
    #[ignore = "needs coturn"]
    fn a_relay_carries_what_finds_no_path() {
        let (mut one, mut two) = pair();
        let address = one.port.address();
        let program = ["-n", "--lt-cred-mech", "--user=lab:secret", "--realm=lab", "--no-cli", "--log-file=/dev/null"];
        let mut turnserver = Command::new("turnserver");
        turnserver.args(program).args([format!("--listening-ip={}", address.ip()), "--listening-port=3479".to_owned()]);
        let _turnserver = Program(turnserver.spawn().unwrap());
        let told = format!(r#"[{{"urls":"turn:{}:3479","username":"lab","credential":"secret"}}]"#, address.ip());
        let begin = Instant::now();
        for mesh in [&mut one, &mut two] {
            mesh.take(&[&[NOTICE, HELPERS], told.as_bytes()].concat());
            while !mesh.port.candidates.iter().any(|known| known.kind() == CandidateKind::Relayed) {
                assert!(begin.elapsed() < TIMEOUT, "{:?}", mesh.port.candidates);
                turn(mesh);
                thread::sleep(Duration::from_millis(1));
            }
            mesh.port.candidates.retain(|known| known.kind() == CandidateKind::Relayed);
        }
        let (mut one, mut two) = opened(one, two);
        assert!(one.send(1, &[7; 1100]));
        assert_eq!(next(&mut two, &mut one), Notice::Message { from: 0, bytes: vec![7; 1100] });
    }
}
