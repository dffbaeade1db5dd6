//! What members of a room say to each other, as bytes.

use super::plan::{Plan, Way, round_of};
use super::transport::Member;
use microsim_core::Intent;
use serde::{Deserialize, Serialize};

/// Changes with every change of a message.
const PROTOCOL: u16 = 4;
/// Longest name, letters.
const LONGEST_NAME: usize = 24;
/// Steps of the run whose digest tells whether two programs compute the same worlds.
const PROBE_STEPS: u32 = 30;

/// What members say to each other.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Message {
    Hello(Hello),
    Start(Start),
    /// A packet of the match of this number.
    Packet(u32, Vec<u8>),
    /// A match that is on, for one who is ready and has no cell in it.
    Invite(Start),
}

/// Who somebody is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Hello {
    pub program: Program,
    pub name: String,
    pub is_ready: bool,
    pub is_playing: bool,
    /// What it would have played, if it is the first.
    pub plan: Plan,
    /// The seed of the next match; none: any.
    pub seed: Option<u64>,
    /// The number of its last match.
    pub number: u32,
}

/// What must be equal for a match.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Program {
    pub protocol: u16,
    pub version: String,
    /// Of a short run.
    pub digest: u64,
}

/// A match, as the first member calls it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Start {
    pub number: u32,
    pub plan: Plan,
    pub seed: u64,
    /// Who plays, in the order of their cells.
    pub seats: Vec<Member>,
}

impl Program {
    /// This program.
    pub(super) fn own() -> Self {
        let digest = round_of(Way::Versus, 2, 1).map_or(0, |mut round| {
            let right = Intent::toward(round.world().config().size).unwrap_or(Intent::REST);
            (0..PROBE_STEPS).for_each(|_| round.step_all(&[right, right]));
            round.world().digest()
        });
        Self { protocol: PROTOCOL, version: env!("CARGO_PKG_VERSION").to_owned(), digest }
    }
}

pub(super) fn write(message: &Message) -> Vec<u8> {
    // Into memory this cannot fail.
    postcard::to_stdvec(message).unwrap_or_default()
}

/// A name as it may be shown: short, and without what controls or reorders letters.
pub(super) fn clean(name: &str) -> String {
    clean_text(name, LONGEST_NAME)
}

pub(super) fn clean_text(text: &str, most: usize) -> String {
    let is_plain = |c: &char| matches!(c, '"' | '\'' | '\\') || c.escape_debug().len() == 1;
    text.chars().filter(is_plain).take(most).collect::<String>().trim().to_owned()
}
