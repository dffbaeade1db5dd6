//! Texts that come with the library, without what only people read: a page downloads them.

/// The text of a file; for WebAssembly without comments, which begin with a mark. Elsewhere they cost nothing, and to
/// leave them out takes a compiler seconds. A macro, because a file's name has to be a literal.
#[cfg(not(target_family = "wasm"))]
macro_rules! bare_text {
    ($file:literal, $mark:literal) => {
        include_str!($file)
    };
}
#[cfg(target_family = "wasm")]
macro_rules! bare_text {
    ($file:literal, $mark:literal) => {{
        use $crate::bare_text::bare;
        const TEXT: &str = include_str!($file);
        const BARE: [u8; bare::length(TEXT, $mark)] = bare::text(TEXT, $mark);
        match str::from_utf8(&BARE) {
            Ok(text) => text,
            Err(_) => unreachable!(),
        }
    }};
}
pub(crate) use bare_text;

/// Texts without comments, indentation and empty lines.
#[cfg(any(test, target_family = "wasm"))]
pub(crate) mod bare {
    /// Length of [`text`](fn@text).
    pub(crate) const fn length(text: &str, mark: &str) -> usize {
        strip(text, mark, &mut [])
    }

    /// The bare text.
    pub(crate) const fn text<const LENGTH: usize>(text: &str, mark: &str) -> [u8; LENGTH] {
        let mut bytes = [0; LENGTH];
        strip(text, mark, &mut bytes);
        bytes
    }

    /// The same where the length is not known before.
    #[cfg(test)]
    pub(crate) fn string(text: &str, mark: &str) -> String {
        let mut bytes = vec![0; length(text, mark)];
        strip(text, mark, &mut bytes);
        String::from_utf8(bytes).unwrap()
    }

    /// Writes as much of a bare text as there is room for, and returns its length.
    const fn strip(text: &str, mark: &str, into: &mut [u8]) -> usize {
        let (text, mark) = (text.as_bytes(), mark.as_bytes());
        let (mut from, mut length, mut last, mut is_quoted) = (0, 0, b'\n', false);
        while from < text.len() {
            let byte = text[from];
            if !is_quoted && begins(text, from, mark) {
                while from + 1 < text.len() && text[from + 1] != b'\n' {
                    from += 1;
                }
            } else if last != b'\n' || !matches!(byte, b' ' | b'\n') {
                if length < into.len() {
                    into[length] = byte;
                }
                (length, last) = (length + 1, byte);
                is_quoted = byte != b'\n' && is_quoted != (byte == b'"');
            }
            from += 1;
        }
        length
    }

    /// Whether a mark is at a place of a text.
    const fn begins(text: &[u8], at: usize, mark: &[u8]) -> bool {
        let mut k = 0;
        while k < mark.len() && at + k < text.len() && text[at + k] == mark[k] {
            k += 1;
        }
        k == mark.len()
    }
}

#[cfg(test)]
mod tests {
    use super::bare;

    #[test]
    fn comments_and_indentation_are_left_out_and_nothing_else() {
        const TEXT: &str = "// head\n#ifdef A\n\n    float a = b / c; // so\n  }\n#endif // A\nx //";
        let text: [u8; bare::length(TEXT, "//")] = bare::text(TEXT, "//");
        assert_eq!(str::from_utf8(&text), Ok("#ifdef A\nfloat a = b / c; \n}\n#endif \nx "));
    }

    #[test]
    fn what_is_quoted_stays() {
        const TEXT: &str = "# head\na = \"b # c\" # d\n";
        let text: [u8; bare::length(TEXT, "#")] = bare::text(TEXT, "#");
        assert_eq!(str::from_utf8(&text), Ok("a = \"b # c\" \n"));
    }
}
