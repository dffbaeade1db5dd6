//! Codes of rooms: what friends tell each other.

use super::limits::CODE_LENGTH;
use std::fmt;

/// Letters and digits of new codes: none looks like another, and without vowels they spell no word.
const ALPHABET: &[u8; 20] = b"23456789CFGHJMPQRVWX";
/// Characters of a new code: 64 million codes.
const LENGTH: usize = 6;

/// The code of a room. Small letters are large ones.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Code(String);

impl Code {
    /// A code that nobody can guess.
    pub(super) fn random() -> Result<Self, getrandom::Error> {
        let mut number = getrandom::u64()?;
        let mut letter = || {
            let letter = ALPHABET[(number % ALPHABET.len() as u64) as usize];
            number /= ALPHABET.len() as u64;
            char::from(letter)
        };
        Ok(Self((0..LENGTH).map(|_| letter()).collect()))
    }

    /// What somebody has typed; none if it is no code.
    pub(super) fn read(text: &str) -> Option<Self> {
        let is_code = CODE_LENGTH.contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_alphanumeric());
        is_code.then(|| Self(text.to_ascii_uppercase()))
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_random_and_can_be_read() {
        let codes: Vec<Code> = (0..100).map(|_| Code::random().unwrap()).collect();
        assert!(codes.iter().all(|code| Code::read(&code.to_string()).as_ref() == Some(code)));
        assert!(codes.windows(2).all(|pair| pair[0] != pair[1]));
        assert!(ALPHABET.iter().all(|letter| !b"0O1IL".contains(letter)));
    }

    #[test]
    fn odd_codes_are_none() {
        assert_eq!(Code::read("abc2"), Code::read("ABC2"));
        for text in ["", "ABC", "ABCDEFGHJKLMN", "AB C", "AB/C", "ABÉC", "AB%43", "..AB", "AB\0C"] {
            assert_eq!(Code::read(text), None, "{text:?}");
        }
    }
}
