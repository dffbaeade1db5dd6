//! What the server sends to members. The page docs/network.md has the format.

use hyper::body::Bytes;

/// First byte of what the server itself says, where a message has its sender.
const NOTICE: u8 = 0xff;
/// Kinds of notices: the second byte.
const WELCOME: u8 = 0;
const JOINED: u8 = 1;
const LEFT: u8 = 2;
const REFUSED: u8 = 3;
const HELPERS: u8 = 4;
const BACK: u8 = 5;

/// The room is entered, as this member.
pub(super) fn welcome(member: u8, others: impl Iterator<Item = u8>) -> Bytes {
    [NOTICE, WELCOME, member].into_iter().chain(others).collect()
}

pub(super) fn joined(member: u8) -> Bytes {
    vec![NOTICE, JOINED, member].into()
}

pub(super) fn left(member: u8) -> Bytes {
    vec![NOTICE, LEFT, member].into()
}

/// Servers that help to find paths to other members.
pub(super) fn helpers(told: &[u8]) -> Bytes {
    [&[NOTICE, HELPERS], told].concat().into()
}

/// Who was cut is there again.
pub(super) fn back(member: u8) -> Bytes {
    vec![NOTICE, BACK, member].into()
}

/// The last that is said, with a reason for people.
pub(super) fn refused(reason: &str) -> Bytes {
    [&[NOTICE, REFUSED], reason.as_bytes()].concat().into()
}
