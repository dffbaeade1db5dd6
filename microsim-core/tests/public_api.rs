//! The signatures of all public items, so that none comes, goes or changes unnoticed: functions, types, fields, variants, and what the
//! root of the crate hands on. Implementations of traits are left out.
//!
//! `UPDATE_GOLDEN=1 cargo test -p microsim-core --test public_api` writes them; one that is gone is a breaking change and has a
//! line in the changelog. That what is `pub` can be reached from outside is held by the lint `unreachable_pub`.

#[allow(dead_code, reason = "the tests of layers use all of it")]
#[path = "common/sources.rs"]
mod sources;

use sources::{Source, sources};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[test]
fn public_items_are_those_that_are_listed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let items: BTreeSet<String> = sources(&folder.join("src")).iter().flat_map(public_items).collect();
    let now: String = items.iter().map(|item| format!("{item}\n")).collect();
    let file = folder.join("tests/golden/public_api.txt");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, &now).unwrap();
    }
    let listed = fs::read_to_string(&file).unwrap_or_default();
    let listed: BTreeSet<String> = listed.lines().map(str::to_owned).collect();
    let (new, gone): (Vec<_>, Vec<_>) = (items.difference(&listed).collect(), listed.difference(&items).collect());
    assert!(
        new.is_empty() && gone.is_empty(),
        "new: {new:#?}, gone: {gone:#?}: if that is meant, see the head of this file"
    );
}

#[test]
fn signatures_are_read_whatever_they_are_formatted_like() {
    let text = "
        /// Text.
        #[derive(Clone)]
        pub struct Room<'a, T> { pub size: [f32; 2], #[serde(skip)] pub map: BTreeMap<u8, (T, u8)>, hidden: &'a u8 }
        pub(crate) struct Inner { pub shown: u8 }
        pub struct Id(pub u32);
        pub enum Kind { /// A.
            A = 1, B(u8, u16), C { at: Vec2, }, }
        pub const MOST: usize = 3;
        pub type Pair = (u8, u8);
        pub trait Shape { fn area(&self) -> f32; }
        impl<'a, T> Room<'a, T> where T: Copy {
            pub fn new(
                size: [f32; 2],
            ) -> Result<Self, Error> { if true { Inner { shown: 1 } } }
            pub const fn side(&mut self, f: impl Fn(u8) -> bool + 'a) {}
            fn private() {}
        }
        impl Drop for Inner { fn drop(&mut self) {} }
        pub mod inner;
        pub use a::{b, c as D};";
    let expected = [
        "lib: use D",
        "lib: use b",
        "lib: const MOST: usize",
        "lib: enum Kind",
        "lib: enum Kind: A = 1",
        "lib: enum Kind: B(u8, u16)",
        "lib: enum Kind: C { at: Vec2 }",
        "lib: impl<'a, T> Room<'a, T> where T: Copy: const fn side(&mut self, f: impl Fn(u8) -> bool + 'a)",
        "lib: impl<'a, T> Room<'a, T> where T: Copy: fn new(size: [f32; 2]) -> Result<Self, Error>",
        "lib: mod inner",
        "lib: struct Id(pub u32)",
        "lib: struct Room<'a, T>",
        "lib: struct Room<'a, T>: map: BTreeMap<u8, (T, u8)>",
        "lib: struct Room<'a, T>: size: [f32; 2]",
        "lib: trait Shape",
        "lib: trait Shape: fn area(&self) -> f32",
        "lib: type Pair = (u8, u8)",
    ];
    let found: BTreeSet<String> = public_items(&Source::new("lib.rs".into(), text)).into_iter().collect();
    assert_eq!(found, expected.map(str::to_owned).into());
}

/// What is `pub` without a limit in a file, each with its module and what it is in.
fn public_items(source: &Source) -> Vec<String> {
    let is_root = source.module() == "lib";
    let module = if is_root { "lib".to_owned() } else { source.own_path().join("/") };
    let words = without_attributes(source);
    let mut items: Vec<String> = Vec::new();
    // Heads of the blocks around a word.
    let (mut around, mut start): (Vec<&[&str]>, usize) = (Vec::new(), 0);
    for (at, word) in words.iter().enumerate() {
        match *word {
            "{" => {
                around.push(&words[start..at]);
                start = at + 1;
                if let [&["pub", ref kind @ ("enum" | "trait"), ref rest @ ..]] = around[..] {
                    let parts = parts(&words[start..], if *kind == "enum" { "," } else { ";" });
                    let head = written(rest);
                    items.extend(parts.into_iter().map(|part| format!("{kind} {head}: {}", written(part))));
                }
            }
            "}" => {
                around.pop();
                start = at + 1;
            }
            ";" => start = at + 1,
            "pub" if !matches!(words[at + 1], "(" | "use") => {
                items.extend(signature(&words[at + 1..], around.last().copied().unwrap_or_default()));
            }
            _ => {}
        }
    }
    let handed_on =
        source.exports().into_iter().filter(|_| is_root).filter(|name| !items.contains(&format!("mod {name}")));
    let handed_on: Vec<String> = handed_on.map(|name| format!("use {name}")).collect();
    items.into_iter().chain(handed_on).map(|item| format!("{module}: {item}")).collect()
}

/// The words of a file without attributes and comments.
fn without_attributes(source: &Source) -> Vec<&str> {
    let (mut words, mut depth) = (Vec::new(), 0);
    let text = |at: usize| source.tokens.get(at).map_or("", |token| token.text.as_str());
    for at in 0..source.tokens.len() {
        match text(at) {
            "#" if depth == 0 => {}
            "!" if at > 0 && text(at - 1) == "#" => {}
            "[" if depth > 0
                || at > 0 && (text(at - 1) == "#" || at > 1 && text(at - 2) == "#" && text(at - 1) == "!") =>
            {
                depth += 1;
            }
            "]" if depth > 0 => depth -= 1,
            word if depth == 0 => words.push(word),
            _ => {}
        }
    }
    words
}

/// The signature that stands behind a `pub`, in a block with this head.
fn signature(words: &[&str], head: &[&str]) -> Option<String> {
    let ends: &[&str] = match words[0] {
        "fn" | "unsafe" | "async" | "struct" | "enum" | "trait" | "mod" => &["{", ";"],
        "const" if words[1] == "fn" => &["{", ";"],
        "const" | "static" => &["="],
        "type" => &[";"],
        // A field.
        _ if matches!(head, ["pub", "struct", ..]) => &[",", "}"],
        _ => return None,
    };
    let item = written(&words[..end(words, ends)]);
    let head = head.strip_prefix(&["pub"]).unwrap_or(head);
    let is_inner = !matches!(head, [] | ["mod", ..]);
    Some(if is_inner { format!("{}: {item}", written(head)) } else { item })
}

/// The parts of a block, whose first word is the first of these, between separators.
fn parts<'a>(block: &'a [&'a str], separator: &'a str) -> Vec<&'a [&'a str]> {
    let (mut parts, mut rest) = (Vec::new(), block);
    while !matches!(rest, [] | ["}", ..]) {
        let length = end(rest, &[separator, "}"]);
        parts.push(&rest[..length]);
        rest = &rest[length..];
        rest = rest.strip_prefix(&[separator]).unwrap_or(rest);
    }
    parts
}

/// Where the first of some marks is that is in no brackets.
fn end(words: &[&str], marks: &[&str]) -> usize {
    let mut depth = 0;
    for (at, word) in words.iter().enumerate() {
        if depth == 0 && marks.contains(word) {
            return at;
        }
        let is_arrow = at > 0 && matches!(words[at - 1], "-" | "=");
        match *word {
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            ">" if !is_arrow => depth -= 1,
            _ => {}
        }
    }
    words.len()
}

/// Words as one writes them.
fn written(words: &[&str]) -> String {
    let is_word = |word: &str| word.starts_with(|c: char| c.is_alphanumeric() || c == '_' || c == '"');
    let mut text = String::new();
    let mut before = "";
    for (at, &word) in words.iter().enumerate() {
        let next = words.get(at + 1).copied().unwrap_or_default();
        if word == "," && matches!(next, ")" | "]" | "}" | ">" | "") {
            continue;
        }
        let is_spaced = (is_word(before) || matches!(before, ")" | "]" | ">")) && is_word(word)
            || matches!(before, "," | ":" | ";" | "{" | "+" | "=" | "|")
            || matches!(word, "{" | "}" | "+" | "-" | "=" | "|")
            || is_word(before) && word == "&"
            || text.ends_with("->");
        text.push_str(if is_spaced && !text.is_empty() { " " } else { "" });
        text.push_str(word);
        before = word;
    }
    text
}
