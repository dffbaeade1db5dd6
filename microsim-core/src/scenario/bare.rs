//! Scenarios as a page downloads them: without comments, which only people read.

/// The text of a scenario's file, bare in WebAssembly. A macro, because a file's name has to be a literal.
macro_rules! scenario_text {
    ($file:literal) => {{
        const TEXT: &str = include_str!($file);
        const BARE: [u8; $crate::scenario::bare::bare_length(TEXT)] = $crate::scenario::bare::bare(TEXT);
        match str::from_utf8(&BARE) {
            Ok(text) if cfg!(target_arch = "wasm32") => text,
            _ => TEXT,
        }
    }};
}
pub(super) use scenario_text;

/// Length of [`bare`].
pub(super) const fn bare_length(text: &str) -> usize {
    strip(text, &mut [])
}

/// A text without comments and the spaces before them. Its lines stay where they are, for diagnostics.
pub(super) const fn bare<const LENGTH: usize>(text: &str) -> [u8; LENGTH] {
    let mut bytes = [0; LENGTH];
    strip(text, &mut bytes);
    bytes
}

/// Writes as much of a bare text as there is room for, and returns its length. Strings end in their line.
const fn strip(text: &str, into: &mut [u8]) -> usize {
    let text = text.as_bytes();
    let (mut from, mut length, mut spaces) = (0, 0, 0);
    // What ends the string that it is in, or 0.
    let mut end = 0;
    while from < text.len() {
        let byte = text[from];
        if end == 0 && byte == b'#' {
            length -= spaces;
            while from + 1 < text.len() && text[from + 1] != b'\n' {
                from += 1;
            }
        } else {
            if byte == b'\n' || byte == end && !(byte == b'"' && text[from - 1] == b'\\') {
                end = 0;
            } else if end == 0 && matches!(byte, b'"' | b'\'') {
                end = byte;
            }
            if length < into.len() {
                into[length] = byte;
            }
            (length, spaces) = (length + 1, if byte == b' ' { spaces + 1 } else { 0 });
        }
        from += 1;
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::builtins;

    fn bared(text: &str) -> String {
        let mut bytes = vec![0; bare_length(text)];
        strip(text, &mut bytes);
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn comments_are_left_out_and_nothing_else() {
        let text = "# head\na = \"#1 \\\" # \" # one\n\n  b = '#2' # it's two\nc = \"it's\" # three\nd = 4#";
        assert_eq!(bared(text), "\na = \"#1 \\\" # \"\n\n  b = '#2'\nc = \"it's\"\nd = 4");
        const TEXT: &str = "a = 1 # b\n";
        const BARE: [u8; bare_length(TEXT)] = bare(TEXT);
        assert_eq!(&BARE, b"a = 1\n");
    }

    #[test]
    fn built_in_scenarios_say_the_same_without_comments() {
        for found in builtins() {
            let (text, bare) = (found.text, bared(found.text));
            let tables = [text, &bare].map(|text| text.parse::<toml::Table>().unwrap());
            assert_eq!(tables[0], tables[1], "{}", found.name);
            assert_eq!(text.lines().count(), bare.lines().count(), "{}", found.name);
            assert!(bare.len() < text.len() || !text.contains('#'), "{}", found.name);
        }
    }
}
