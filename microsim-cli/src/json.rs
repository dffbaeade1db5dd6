//! Values as JSON, for files and terminals: the only place that writes it.

use crate::sanitize;
use serde::Serialize;
use std::io;

/// A value on one line.
pub(crate) fn line(value: &impl Serialize) -> io::Result<String> {
    Ok(sanitize::json(&serde_json::to_string(value)?) + "\n")
}

/// A value on several lines, for people.
pub(crate) fn pretty(value: &impl Serialize) -> io::Result<String> {
    Ok(sanitize::json(&serde_json::to_string_pretty(value)?) + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_is_the_same_without_what_controls_a_terminal() {
        let value = ["x\u{9b}2J\u{202e}\u{7f}\u{e0041}\n", "µ"];
        for text in [line(&value).unwrap(), pretty(&value).unwrap()] {
            assert!(text.contains(r#""x\u009b2J\u202e\u007f\udb40\udc41\n""#) && text.contains('µ'), "{text:?}");
            assert_eq!(serde_json::from_str::<[String; 2]>(&text).unwrap(), value);
        }
    }
}
