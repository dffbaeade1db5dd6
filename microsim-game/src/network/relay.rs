//! Frames to and from the server of rooms. The page docs/network.md has the format.

use super::transport::{LONGEST_MESSAGE, Member, Notice};
use crate::words::{self, Key};

/// First byte of what the server itself says.
pub(crate) const NOTICE: u8 = 0xff;
const WELCOME: u8 = 0;
pub(crate) const JOINED: u8 = 1;
pub(crate) const LEFT: u8 = 2;
const REFUSED: u8 = 3;
pub(crate) const HELPERS: u8 = 4;
pub(crate) const BACK: u8 = 5;
/// First byte of what members tell each other to open channels; no message of the game begins with it.
pub(crate) const SIGNAL: u8 = 0xff;
/// Most members of a room.
pub(crate) const MEMBERS: u8 = 4;
/// Longest reason that is shown, characters.
const LONGEST_REASON: usize = 200;
/// Why a connection ends of which the server says nothing.
#[must_use]
pub fn cut() -> Notice {
    Notice::Closed(words::text(Key::RoomCut).to_owned())
}

/// A message as the server takes it; none if it is too long or would be taken for a signal.
#[must_use]
pub fn frame(to: Member, message: &[u8]) -> Option<Vec<u8>> {
    let is_sound = message.len() <= LONGEST_MESSAGE && message.first() != Some(&SIGNAL);
    is_sound.then(|| [&[to], message].concat())
}

/// Whether a frame is for the channels between members, and not for the game.
#[must_use]
pub fn is_of_channels(frame: &[u8]) -> bool {
    matches!(frame, [NOTICE, HELPERS, ..]) || matches!(frame, [from, SIGNAL, ..] if *from < MEMBERS)
}

/// What any other frame of the server says; none if it is not of the server's.
#[must_use]
pub fn notice(frame: &[u8]) -> Option<Notice> {
    let known = |member: Member| (member < MEMBERS).then_some(member);
    match frame {
        [NOTICE, WELCOME, member, others @ ..] if others.len() < usize::from(MEMBERS) => {
            let others = others.iter().map(|other| known(*other).filter(|other| other != member));
            Some(Notice::Welcome { member: known(*member)?, others: others.collect::<Option<_>>()? })
        }
        [NOTICE, JOINED, member] => known(*member).map(Notice::Joined),
        [NOTICE, LEFT, member] => known(*member).map(Notice::Left),
        [NOTICE, BACK, member] => known(*member).map(Notice::Back),
        [NOTICE, REFUSED] => Some(cut()),
        [NOTICE, REFUSED, reason @ ..] => {
            let reason = String::from_utf8_lossy(reason);
            Some(Notice::Closed(reason.chars().filter(|c| !c.is_control()).take(LONGEST_REASON).collect()))
        }
        [from, bytes @ ..] if bytes.len() <= LONGEST_MESSAGE => {
            known(*from).map(|from| Notice::Message { from, bytes: bytes.to_vec() })
        }
        _ => None,
    }
}

/// The code of a room as servers take it.
///
/// # Errors
/// When it is none.
pub fn check_code(code: &str) -> Result<String, String> {
    let is_code = (4..=12).contains(&code.len()) && code.bytes().all(|byte| byte.is_ascii_alphanumeric());
    is_code.then(|| code.to_ascii_uppercase()).ok_or_else(|| words::text(Key::RoomCode).to_owned())
}

/// The end of a room's address, for who has this key.
#[must_use]
pub fn way(code: &str, key: &str) -> String {
    if key.is_empty() { code.to_owned() } else { format!("{code}?key={key}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notices_are_understood() {
        assert_eq!(notice(&[0xff, 0, 2, 0, 1]), Some(Notice::Welcome { member: 2, others: vec![0, 1] }));
        assert_eq!(notice(&[0xff, 1, 3]), Some(Notice::Joined(3)));
        assert_eq!(notice(&[0xff, 2, 0]), Some(Notice::Left(0)));
        assert_eq!(notice(&[0xff, 5, 1]), Some(Notice::Back(1)));
        assert_eq!(notice(b"\xff\x03full\x1b[2J"), Some(Notice::Closed("full[2J".into())));
        assert_eq!(notice(&[0xff, 3]), Some(cut()));
        assert_eq!(notice(&[1, 7, 8]), Some(Notice::Message { from: 1, bytes: vec![7, 8] }));
        assert_eq!(notice(&frame(3, b"eat").unwrap()), Some(Notice::Message { from: 3, bytes: b"eat".to_vec() }));
    }

    #[test]
    fn frames_for_channels_are_told_from_others() {
        let of_channels: [&[u8]; 3] = [&[0xff, 4], b"\xff\x04[]", &[3, 0xff, 0, 1]];
        assert!(of_channels.iter().all(|frame| is_of_channels(frame)));
        let others: [&[u8]; 6] = [&[], &[0xff], &[0xff, 3, 4], &[0xff, 0xff], &[4, 0xff], &[1, 0, 0xff]];
        assert!(!others.iter().any(|frame| is_of_channels(frame)));
    }

    #[test]
    fn other_frames_are_none() {
        let long = vec![0; LONGEST_MESSAGE + 2];
        let wrong: [&[u8]; 10] = [
            &[],
            &[4],
            &[0xfe, 0],
            &[0xff],
            &[0xff, 9],
            &[0xff, 0],
            &[0xff, 0, 4],
            &[0xff, 0, 0, 0],
            &[0xff, 1, 4],
            &long,
        ];
        assert!(wrong.iter().all(|frame| notice(frame).is_none()));
        assert!(frame(0, &long).is_none() && frame(0, &[SIGNAL]).is_none());
    }

    /// Whatever a server sends, nobody has a number that is not there.
    #[test]
    fn no_bytes_make_a_member_who_cannot_be() {
        let mut state = 1u64;
        let mut byte = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 56) as u8
        };
        for _ in 0..200_000 {
            let head = [NOTICE, byte()][usize::from(byte() % 2)];
            let kind = if byte() % 4 == 0 { byte() } else { byte() % 5 };
            let rest = (0..byte() % 8).map(|_| if byte() % 4 == 0 { byte() } else { byte() % 5 });
            let frame: Vec<u8> = [head, kind].into_iter().chain(rest.collect::<Vec<_>>()).collect();
            match notice(&frame) {
                Some(Notice::Welcome { member, others }) => {
                    assert!(
                        member < 4 && others.len() < 4 && others.iter().all(|other| *other < 4 && *other != member)
                    );
                }
                Some(
                    Notice::Joined(member)
                    | Notice::Back(member)
                    | Notice::Left(member)
                    | Notice::Message { from: member, .. },
                ) => {
                    assert!(member < 4);
                }
                Some(Notice::Closed(reason)) => assert!(!reason.contains(char::is_control)),
                None => {}
            }
        }
    }

    #[test]
    fn codes_are_checked() {
        assert_eq!(check_code("k7m2qx").as_deref(), Ok("K7M2QX"));
        assert!(["", "abc", "abcdefghijklm", "ab/cd", "abéc"].iter().all(|code| check_code(code).is_err()));
    }
}
