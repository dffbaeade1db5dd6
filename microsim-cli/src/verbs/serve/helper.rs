//! Servers of others that help members to find paths to each other (STUN, RFC 8489; TURN, RFC 8656), as members are told of them.

use hyper::body::Bytes;

/// Longest address of one, characters.
const LONGEST: usize = 255;

/// One of them, with the names that browsers have for its parts.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub(super) struct Helper {
    urls: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    username: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    credential: Option<String>,
}

/// `HOST` or `HOST:PORT` of one that tells members under which address others see them.
pub(super) fn stun(text: &str) -> Result<Helper, String> {
    Ok(Helper { urls: format!("stun:{}", host(text)?), username: None, credential: None })
}

/// `NAME:PASSWORD@HOST` or `NAME:PASSWORD@HOST:PORT` of one that carries what finds no path.
pub(super) fn turn(text: &str) -> Result<Helper, String> {
    let (user, at) = text.rsplit_once('@').ok_or("no NAME:PASSWORD@ before the host")?;
    let (name, password) = user.split_once(':').ok_or("no password after the name")?;
    let (username, credential) = (Some(name.to_owned()), Some(password.to_owned()));
    Ok(Helper { urls: format!("turn:{}", host(at)?), username, credential })
}

fn host(text: &str) -> Result<&str, String> {
    let (name, port) = match text.rsplit_once(':') {
        Some((name, port)) if !port.contains(']') => (name, port.parse::<u16>().ok()),
        _ => (text, Some(0)),
    };
    let is_letter = |c: char| c.is_ascii_alphanumeric() || ".-".contains(c);
    let is_name = !name.is_empty() && name.len() <= LONGEST && name.chars().all(is_letter);
    let numbers = name.strip_prefix('[').and_then(|name| name.strip_suffix(']'));
    let is_address = numbers.is_some_and(|numbers| numbers.parse::<std::net::Ipv6Addr>().is_ok());
    if port.is_some() && (is_name || is_address) { Ok(text) } else { Err("no HOST or HOST:PORT".to_owned()) }
}

/// What members are told; none without any.
pub(super) fn told(helpers: &[Helper]) -> Option<Bytes> {
    let text = serde_json::to_vec(helpers).expect("strings have a JSON");
    (!helpers.is_empty()).then(|| text.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn helpers_are_read_and_told() {
        assert_eq!(told(&[]), None);
        let helpers = [stun("stun.example").unwrap(), turn("lab:a:b@c@[2001:db8::1]:3478").unwrap()];
        let text = String::from_utf8(told(&helpers).unwrap().to_vec()).unwrap();
        assert_eq!(
            text,
            r#"[{"urls":"stun:stun.example"},{"urls":"turn:[2001:db8::1]:3478","username":"lab","credential":"a:b@c"}]"#
        );
    }

    #[test]
    fn odd_addresses_are_refused() {
        for text in ["", ":1", "a b", "a:b", "a:99999", "stun:a:1", "::1", "[::1", "[x]", "a/b", "a?b", "a\"b", "é"] {
            assert!(stun(text).is_err(), "{text:?}");
        }
        assert!(stun(&"a".repeat(256)).is_err());
        for text in ["turn.example", "name@turn.example", "name:password@", "name:password@a/b"] {
            assert!(turn(text).is_err(), "{text:?}");
        }
    }
}
