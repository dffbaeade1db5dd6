//! What waits to be sent to a member.

use super::limits::{LONGEST_QUEUE, MESSAGE_OVERHEAD};
use super::rooms::Outbox;
use hyper::body::Bytes;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};

/// The end that frames are put in. Its length is limited by bytes, which a channel cannot.
#[derive(Debug)]
pub(super) struct Sender {
    frames: UnboundedSender<Bytes>,
    waiting: Arc<AtomicUsize>,
}

/// The end that frames are taken from.
#[derive(Debug)]
pub(super) struct Receiver {
    frames: UnboundedReceiver<Bytes>,
    waiting: Arc<AtomicUsize>,
}

pub(super) fn queue() -> (Sender, Receiver) {
    let (sender, receiver) = unbounded_channel();
    let waiting = Arc::<AtomicUsize>::default();
    (Sender { frames: sender, waiting: Arc::clone(&waiting) }, Receiver { frames: receiver, waiting })
}

impl Outbox for Sender {
    fn offer(&self, frame: Bytes) -> bool {
        let weight = frame.len() + MESSAGE_OVERHEAD;
        self.waiting.fetch_add(weight, Ordering::Relaxed) + weight <= LONGEST_QUEUE && self.frames.send(frame).is_ok()
    }
}

impl Receiver {
    /// The next frame; none when the member has been dropped.
    pub(super) async fn next(&mut self) -> Option<Bytes> {
        let frame = self.frames.recv().await;
        frame.inspect(|frame| self.subtract(frame))
    }

    /// A frame that is there already.
    pub(super) fn ready(&mut self) -> Option<Bytes> {
        let frame = self.frames.try_recv().ok();
        frame.inspect(|frame| self.subtract(frame))
    }

    fn subtract(&self, frame: &Bytes) {
        self.waiting.fetch_sub(frame.len() + MESSAGE_OVERHEAD, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_queue_is_limited_by_bytes() {
        let (sender, mut receiver) = queue();
        let frame = Bytes::from(vec![0; LONGEST_QUEUE / 8 - MESSAGE_OVERHEAD]);
        assert_eq!((0..9).filter(|_| sender.offer(frame.clone())).count(), 8);
        let (sender, mut other) = queue();
        (0..8).for_each(|_| assert!(sender.offer(frame.clone())));
        assert!(other.ready().is_some() && sender.offer(frame));
        assert_eq!(std::iter::from_fn(|| receiver.ready()).count(), 8);
    }
}
