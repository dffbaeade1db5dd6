//! What strangers may ask of the server.

use std::time::Duration;

/// Players in a room.
pub(super) const MEMBERS: usize = 4;
/// Rooms at the same time, unless told otherwise.
pub(super) const ROOMS: u32 = 1000;
/// Longest message of a member, bytes.
pub(super) const LONGEST_MESSAGE: usize = 64 * 1024;
/// Messages of a member per second, in the long run.
pub(super) const MESSAGE_RATE: u32 = 1000;
/// Bytes of a member per second, in the long run.
pub(super) const BYTE_RATE: u32 = 256 * 1024;
/// Seconds whose messages and bytes a member may send at once.
const BURST: u32 = 4;
/// Bytes that wait for a member who reads slowly; with more he is dropped.
pub(super) const LONGEST_QUEUE: usize = 1024 * 1024;
/// What a waiting message takes besides its bytes.
pub(super) const MESSAGE_OVERHEAD: usize = 64;
/// Fewest and most characters in the code of a room.
pub(super) const CODE_LENGTH: std::ops::RangeInclusive<usize> = 4..=12;
/// Connections besides those of members: pages that are loaded, handshakes.
pub(super) const VISITORS: usize = 256;
/// Longest handshake, and longest pause between two requests.
pub(super) const HANDSHAKE: Duration = Duration::from_secs(5);
/// Longest time of a connection that does not go into a room.
pub(super) const LONGEST_LOAD: Duration = Duration::from_secs(120);
/// Longest time without a sign of life of a member.
pub(super) const SILENCE: Duration = Duration::from_secs(60);
/// Time between two questions whether a member is there.
pub(super) const PING: Duration = Duration::from_secs(20);
/// Longest time in which a member takes what is sent to him.
pub(super) const SEND_TIMEOUT: Duration = Duration::from_secs(10);
/// Time for which the place of a member is kept whose connection was cut.
pub(super) const RETURN: Duration = Duration::from_secs(30);
/// Most characters of the key by which a member gets it back.
pub(super) const LONGEST_KEY: usize = 64;
/// Longest farewell: what a member has sent already is read, or he would not read why he is dropped.
pub(super) const FAREWELL: Duration = Duration::from_secs(1);

/// The limits, for `--help`.
pub(super) fn help() -> String {
    format!(
        "Limits: {MEMBERS} members a room; messages of at most {} KiB; {MESSAGE_RATE} messages and {} KiB a second of each member, {BURST} \
        seconds' worth at once: who\nsends more is read later; {} KiB waiting for a member; {} s for a handshake, {} s without a sign of \
        life; codes of {} to {} letters and digits.",
        LONGEST_MESSAGE / 1024,
        BYTE_RATE / 1024,
        LONGEST_QUEUE / 1024,
        HANDSHAKE.as_secs(),
        SILENCE.as_secs(),
        CODE_LENGTH.start(),
        CODE_LENGTH.end(),
    )
}

/// How much a member may still send: one bucket for messages and one for bytes, filled with time.
#[derive(Debug)]
pub(super) struct Allowance {
    messages: Bucket,
    bytes: Bucket,
}

impl Allowance {
    pub(super) fn new() -> Self {
        Self { messages: Bucket::new(MESSAGE_RATE), bytes: Bucket::new(BYTE_RATE) }
    }

    /// Takes a message that is read at `now`, and says how long to wait before the next one is read.
    pub(super) fn take(&mut self, length: usize, now: Duration) -> Duration {
        self.messages.take(1.0, now).max(self.bytes.take(length as f64, now))
    }
}

#[derive(Debug)]
struct Bucket {
    /// Per second.
    rate: f64,
    /// What is in it; less than nothing when too much was taken.
    level: f64,
    /// When that was so.
    at: Duration,
}

impl Bucket {
    fn new(rate: u32) -> Self {
        Self { rate: rate.into(), level: f64::from(rate * BURST), at: Duration::ZERO }
    }

    fn take(&mut self, amount: f64, now: Duration) -> Duration {
        let gained = self.rate * now.saturating_sub(self.at).as_secs_f64();
        self.level = (self.level + gained).min(self.rate * f64::from(BURST)) - amount;
        self.at = now;
        Duration::from_secs_f64((-self.level / self.rate).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_burst_is_free_and_what_follows_has_its_pace() {
        let (mut allowance, mut now) = (Allowance::new(), Duration::ZERO);
        for _ in 0..MESSAGE_RATE * BURST {
            assert_eq!(allowance.take(60, now), Duration::ZERO);
        }
        for _ in 0..100 {
            let wait = allowance.take(60, now);
            assert!((wait.as_secs_f64() - 1.0 / f64::from(MESSAGE_RATE)).abs() < 1e-6, "{wait:?}");
            now += wait;
        }
        now += Duration::from_secs(3600);
        assert_eq!(allowance.take(60, now), Duration::ZERO);
    }

    #[test]
    fn long_messages_count_by_their_bytes() {
        let mut allowance = Allowance::new();
        let count = BURST * BYTE_RATE / LONGEST_MESSAGE as u32;
        assert!((0..count).all(|_| allowance.take(LONGEST_MESSAGE, Duration::ZERO) == Duration::ZERO));
        assert_eq!(allowance.take(LONGEST_MESSAGE, Duration::ZERO), Duration::from_millis(250));
    }
}
