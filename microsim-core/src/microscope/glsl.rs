//! Formulas for a graphics card: GLSL 100 beside the code of the same name, and the numbers that both share.

use std::fmt::Write as _;

/// The text of a file, without what only people read: a page downloads it. A macro, because a file's name has to be a literal.
macro_rules! glsl_text {
    ($file:literal) => {{
        const TEXT: &str = include_str!($file);
        const BARE: [u8; $crate::microscope::glsl::bare_length(TEXT)] = $crate::microscope::glsl::bare(TEXT);
        match str::from_utf8(&BARE) {
            Ok(text) => text,
            Err(_) => unreachable!(),
        }
    }};
}
pub(super) use glsl_text;

/// Length of [`bare`].
pub(super) const fn bare_length(text: &str) -> usize {
    strip(text, &mut [])
}

/// A text without comments, indentation and empty lines.
pub(super) const fn bare<const LENGTH: usize>(text: &str) -> [u8; LENGTH] {
    let mut bytes = [0; LENGTH];
    strip(text, &mut bytes);
    bytes
}

/// Writes as much of a bare text as there is room for, and returns its length.
const fn strip(text: &str, into: &mut [u8]) -> usize {
    let text = text.as_bytes();
    let (mut from, mut length, mut last) = (0, 0, b'\n');
    while from < text.len() {
        let byte = text[from];
        if byte == b'/' && from + 1 < text.len() && text[from + 1] == b'/' {
            while from + 1 < text.len() && text[from + 1] != b'\n' {
                from += 1;
            }
        } else if last != b'\n' || !matches!(byte, b' ' | b'\n') {
            if length < into.len() {
                into[length] = byte;
            }
            (length, last) = (length + 1, byte);
        }
        from += 1;
    }
    length
}

/// A piece of GLSL 100.
#[derive(Debug)]
pub(super) struct Glsl {
    pub source: &'static str,
    /// What the code calls by the same names: numbers and vectors of up to four.
    pub constants: &'static [(&'static str, &'static [f32])],
}

impl Glsl {
    /// Writes the constants and the source.
    pub(super) fn write(&self, text: &mut String) {
        for (name, numbers) in self.constants {
            let kind = ["float", "vec2", "vec3", "vec4"][numbers.len() - 1];
            let list: Vec<String> = numbers.iter().map(|number| format!("{number:?}")).collect();
            _ = writeln!(text, "const {kind} {name} = {kind}({});", list.join(", "));
        }
        text.push_str(self.source);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_indentation_are_left_out_and_nothing_else() {
        const TEXT: &str = "// head\n#ifdef A\n\n    float a = b / c; // so\n  }\n#endif // A\nx //";
        let bare: [u8; bare_length(TEXT)] = bare(TEXT);
        assert_eq!(str::from_utf8(&bare), Ok("#ifdef A\nfloat a = b / c; \n}\n#endif \nx "));
    }
}
