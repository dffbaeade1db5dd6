//! Names: which can be used.

/// What names of prototypes, controllers, organisms and parameters look like.
pub(crate) const NAME: &str = "1 to 64 letters, digits, _ or -";

/// Whether this is a name: nothing that needs quoting in a dotted path.
pub(crate) fn is_name(text: &str) -> bool {
    let is_part = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    (1..=64).contains(&text.len()) && text.bytes().all(is_part)
}
