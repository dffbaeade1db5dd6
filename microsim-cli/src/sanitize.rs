//! Text from outside, made harmless for a terminal, a page or a table: the only place that does so.

use std::borrow::Cow;

/// A name or a value as part of a line: nothing in it ends the line, moves the cursor, or turns the direction of writing.
pub(crate) fn line(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c.is_control() || is_invisible(c))
}

/// Several lines of a page or a file.
pub(crate) fn lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| !matches!(c, '\n' | '\t') && c.is_control() || is_invisible(c))
}

/// Several lines with colours, in which nothing else has an escape character.
pub(crate) fn coloured(text: &str) -> Cow<'_, str> {
    escaped(text, |c| !matches!(c, '\n' | '\u{1b}') && c.is_control() || is_invisible(c))
}

/// JSON that means the same: only its strings have such characters.
pub(crate) fn json(text: &str) -> String {
    let is_harmful = |c: char| c != '\n' && c.is_control() || is_invisible(c);
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        if is_harmful(c) {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| safe += &format!("\\u{unit:04x}"));
        } else {
            safe.push(c);
        }
    }
    safe
}

/// A cell of a table: text that a spreadsheet would take for a formula begins with an apostrophe.
pub(crate) fn cell(text: &str) -> Cow<'_, str> {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']) && text.parse::<f64>().is_err();
    if is_formula { Cow::Owned(format!("'{}", line(text))) } else { line(text) }
}

fn escaped(text: &str, is_harmful: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_harmful) {
        return Cow::Borrowed(text);
    }
    let show = |c: char| if is_harmful(c) { c.escape_unicode().to_string() } else { c.to_string() };
    Cow::Owned(text.chars().map(show).collect())
}

/// Ends of lines (UAX 14), marks of direction (UAX 9, section 2), and what has no width: one name could pass for another.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::{cell, coloured, line, lines};

    #[test]
    fn nothing_controls_a_terminal() {
        assert_eq!(line("a\u{1b}[2Jb\nok\u{202e}\u{9b}"), "a\\u{1b}[2Jb\\u{a}ok\\u{202e}\\u{9b}");
        assert_eq!(coloured("\u{1b}[1ma\n\rµ\u{2028}"), "\u{1b}[1ma\n\\u{d}µ\\u{2028}");
        assert_eq!(lines("a\n\tb\r\u{1b}\u{202e}"), "a\n\tb\\u{d}\\u{1b}\\u{202e}");
        let harmful = "\u{7f}\u{85}\u{90}\u{9d}\u{ad}\u{61c}\u{200b}\u{200d}\u{200f}\u{2029}\u{2060}\u{2069}\u{feff}\u{fffa}\u{e0041}";
        assert!(harmful.chars().all(|c| line(&c.to_string()) == c.escape_unicode().to_string()));
        assert!(["naïve", "日本", "µm², Ω"].iter().all(|text| line(text) == *text));
    }

    #[test]
    fn no_cell_is_a_formula() {
        for text in ["=1+1", "+x", "-x", "@x"] {
            assert_eq!(cell(text), format!("'{text}"));
        }
        assert!(["-1.5", "+2", "a=b", ""].iter().all(|text| cell(text) == *text));
    }
}
