//! One channel to another member of a room.

use super::port::{Packet, Port};
use std::time::{Duration, Instant};
use str0m::change::{SdpAnswer, SdpOffer, SdpPendingOffer};
use str0m::channel::{ChannelConfig, ChannelId, Reliability};
use str0m::net::{Protocol, Receive};
use str0m::{Candidate, Event, Input, Output, Rtc};

const OFFER: u8 = 0;
const ANSWER: u8 = 1;
const CANDIDATE: u8 = 2;
/// Longest message of a channel, bytes: it fits in one packet. Longer ones go by the server.
const LONGEST_MESSAGE: usize = 1100;
/// Most messages of a channel in a second; a match of two has 60.
const MOST_MESSAGES: u32 = 500;
/// Most signals of an attempt; an offer has one part.
const MOST_SIGNALS: u32 = 64;
/// Bytes that wait to be sent; what is more goes by the server.
const MOST_UNSENT: usize = 1 << 16;
/// Time without a message after which those to that member go both ways.
const SILENCE: Duration = Duration::from_millis(1500);
/// Most that is done at once.
const MOST_OUTPUTS: usize = 1000;

/// What members tell each other through the server to open a channel.
#[derive(Debug)]
pub(super) struct Signal {
    kind: u8,
    pub attempt: u8,
    text: String,
}

impl Signal {
    /// The signal after its first byte; none if it is none.
    pub(super) fn read(bytes: &[u8]) -> Option<Self> {
        let [kind @ OFFER..=CANDIDATE, attempt, text @ ..] = bytes else { return None };
        Some(Self { kind: *kind, attempt: *attempt, text: str::from_utf8(text).ok()?.to_owned() })
    }

    pub(super) fn write(&self) -> Vec<u8> {
        [&[self.kind, self.attempt], self.text.as_bytes()].concat()
    }

    pub(super) fn is_offer(&self) -> bool {
        self.kind == OFFER
    }

    /// Whether it describes one data channel, and no picture or sound.
    fn is_plain(&self) -> bool {
        let parts: Vec<&str> = self.text.lines().filter(|line| line.starts_with("m=")).collect();
        matches!(parts[..], [part] if part.starts_with("m=application "))
    }
}

pub(super) struct Way {
    rtc: Rtc,
    channel: ChannelId,
    attempt: u8,
    pending: Option<SdpPendingOffer>,
    signals: u32,
    is_connected: bool,
    is_open: bool,
    is_lost: bool,
    heard: Instant,
    /// Since when messages are counted, and how many have come.
    count: (Instant, u32),
    messages: Vec<Vec<u8>>,
}

impl Way {
    pub(super) fn offer(attempt: u8, known: &[Candidate]) -> Option<(Self, Signal)> {
        let mut rtc = new_rtc(known);
        let mut changes = rtc.sdp_api();
        let channel = changes.add_channel_with_config(config());
        let (offer, pending) = changes.apply()?;
        let signal = Signal { kind: OFFER, attempt, text: offer.to_sdp_string() };
        Some((Self::new(rtc, channel, attempt, Some(pending)), signal))
    }

    /// A way that somebody has offered; none if what he says is of no use.
    pub(super) fn answer(offer: &Signal, known: &[Candidate]) -> Option<(Self, Signal)> {
        let description = SdpOffer::from_sdp_string(&offer.text).ok().filter(|_| offer.is_plain())?;
        let mut rtc = new_rtc(known);
        let answer = rtc.sdp_api().accept_offer(description).ok()?;
        let channel = rtc.direct_api().create_data_channel(config());
        let signal = Signal { kind: ANSWER, attempt: offer.attempt, text: answer.to_sdp_string() };
        Some((Self::new(rtc, channel, offer.attempt, None), signal))
    }

    fn new(rtc: Rtc, channel: ChannelId, attempt: u8, pending: Option<SdpPendingOffer>) -> Self {
        let (is_connected, is_open, is_lost, now) = (false, false, false, Instant::now());
        let (signals, heard, count, messages) = (0, now, (now, 0), Vec::new());
        Self { rtc, channel, attempt, pending, signals, is_connected, is_open, is_lost, heard, count, messages }
    }

    pub(super) fn attempt(&self) -> u8 {
        self.attempt
    }

    pub(super) fn is_lost(&self) -> bool {
        self.is_lost
    }

    /// Takes an answer or a candidate.
    pub(super) fn take(&mut self, signal: &Signal) {
        self.signals += 1;
        self.is_lost |= self.signals > MOST_SIGNALS;
        if signal.kind == CANDIDATE {
            // Browsers name hidden addresses, which are found when they call.
            if let Ok(candidate) = Candidate::from_sdp_string(&signal.text) {
                self.rtc.add_remote_candidate(candidate);
            }
        } else if let Some(pending) = self.pending.take() {
            let answer = SdpAnswer::from_sdp_string(&signal.text).ok().filter(|_| signal.is_plain());
            let accepted = answer.map(|answer| self.rtc.sdp_api().accept_answer(pending, answer));
            self.is_lost |= !matches!(accepted, Some(Ok(())));
        }
    }

    /// Tells the other member where else this one may be found.
    pub(super) fn tell(&mut self, found: &Candidate) -> Option<Signal> {
        let text = self.rtc.add_local_candidate(found.clone())?.to_sdp_string();
        Some(Signal { kind: CANDIDATE, attempt: self.attempt, text })
    }

    /// Takes a packet, and returns whether it was for this way.
    pub(super) fn receive(&mut self, packet: &Packet, port: &mut Port, now: Instant) -> bool {
        let &Packet { source, destination, ref bytes } = packet;
        let Ok(contents) = bytes[..].try_into() else { return false };
        let input = Input::Receive(now, Receive { proto: Protocol::Udp, source, destination, contents });
        if !self.rtc.accepts(&input) {
            return false;
        }
        self.is_lost |= self.rtc.handle_input(input).is_err();
        self.drive(port, now);
        true
    }

    /// Does all that is due.
    pub(super) fn drive(&mut self, port: &mut Port, now: Instant) {
        for _ in 0..MOST_OUTPUTS {
            if self.is_lost {
                return;
            }
            match self.rtc.poll_output() {
                Ok(Output::Timeout(at)) if at > now => break,
                Ok(Output::Timeout(_)) => self.is_lost |= self.rtc.handle_input(Input::Timeout(now)).is_err(),
                Ok(Output::Transmit(packet)) => port.send(&packet, now),
                Ok(Output::Event(event)) => self.is_lost |= !self.note(event, now),
                Err(_) => self.is_lost = true,
            }
        }
        self.is_lost |= !self.rtc.is_alive();
    }

    /// Takes note of what has happened, and returns whether the way can stay.
    fn note(&mut self, event: Event, now: Instant) -> bool {
        match event {
            Event::IceConnectionStateChange(state) => self.is_connected = state.is_connected(),
            Event::ChannelOpen(channel, _) if channel == self.channel => (self.is_open, self.heard) = (true, now),
            Event::ChannelData(data) if data.id == self.channel && data.binary => {
                if now.duration_since(self.count.0) >= Duration::from_secs(1) {
                    self.count = (now, 0);
                }
                self.count.1 += 1;
                if !(1..=LONGEST_MESSAGE).contains(&data.data.len()) || self.count.1 > MOST_MESSAGES {
                    return false;
                }
                self.heard = now;
                self.messages.push(data.data);
            }
            Event::ChannelOpen(..) | Event::ChannelData(_) | Event::ChannelClose(_) | Event::MediaAdded(_) => {
                return false;
            }
            _ => {}
        }
        true
    }

    /// What has come since the last call.
    pub(super) fn messages(&mut self) -> std::vec::Drain<'_, Vec<u8>> {
        self.messages.drain(..)
    }

    /// Sends a message, and returns whether it need not go by the server as well.
    pub(super) fn send(&mut self, message: &[u8], port: &mut Port, now: Instant) -> bool {
        if !self.is_connected || !self.is_open || self.is_lost || message.len() > LONGEST_MESSAGE {
            return false;
        }
        let Some(mut channel) = self.rtc.channel(self.channel) else { return false };
        if channel.buffered_amount() > MOST_UNSENT || !matches!(channel.write(true, message), Ok(true)) {
            return false;
        }
        self.drive(port, now);
        now.duration_since(self.heard) < SILENCE
    }
}

fn new_rtc(known: &[Candidate]) -> Rtc {
    let mut rtc = Rtc::new(Instant::now());
    for candidate in known {
        rtc.add_local_candidate(candidate.clone());
    }
    rtc
}

/// Number 0 on both sides, unordered, never sent again.
fn config() -> ChannelConfig {
    let reliability = Reliability::MaxRetransmits { retransmits: 0 };
    ChannelConfig { ordered: false, reliability, negotiated: Some(0), ..ChannelConfig::default() }
}
