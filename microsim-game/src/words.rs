//! What the player reads, in the language that is chosen. The texts are in `words/*.ftl`, in the syntax of Project Fluent; the build
//! makes tables of them.

pub mod articles;

use std::cell::Cell;
use std::io::{self, ErrorKind};
use std::path::Path;
use std::sync::OnceLock;

include!(concat!(env!("OUT_DIR"), "/words.rs"));

/// A language of the texts.
#[derive(Debug)]
pub struct Language {
    /// Its tag, and the name of its file.
    pub code: &'static str,
    /// What it calls itself.
    pub name: &'static str,
    /// What stands before decimals.
    decimal: &'static str,
    /// The category of plural of a number (Unicode CLDR).
    category: fn(f64) -> &'static str,
    table: OnceLock<Vec<&'static str>>,
    articles: OnceLock<Vec<articles::Article>>,
}

impl PartialEq for Language {
    fn eq(&self, other: &Self) -> bool {
        self.code == other.code
    }
}

/// All of them. Another one is a file in `words` and a line here.
pub static LANGUAGES: [Language; 2] =
    [Language::new("en", "English", ".", english), Language::new("cs", "Čeština", ",", czech)];

fn english(number: f64) -> &'static str {
    if number == 1.0 { "one" } else { "other" }
}

fn czech(number: f64) -> &'static str {
    match number {
        1.0 => "one",
        2.0 | 3.0 | 4.0 => "few",
        _ if number.fract() != 0.0 => "many",
        _ => "other",
    }
}

impl Language {
    const fn new(
        code: &'static str,
        name: &'static str,
        decimal: &'static str,
        category: fn(f64) -> &'static str,
    ) -> Self {
        Self { code, name, decimal, category, table: OnceLock::new(), articles: OnceLock::new() }
    }

    /// The one of this tag.
    #[must_use]
    pub fn named(code: &str) -> Option<&'static Self> {
        LANGUAGES.iter().find(|language| language.code == code)
    }

    /// The one for a locale such as `cs_CZ.UTF-8` or `cs-CZ`, or the first.
    #[must_use]
    pub fn for_locale(locale: &str) -> &'static Self {
        let code = locale.split(['_', '-', '.', '@']).next().unwrap_or_default().to_lowercase();
        Self::named(&code).unwrap_or(&LANGUAGES[0])
    }

    /// The next one, or the one before.
    #[must_use]
    pub fn next(&self, is_back: bool) -> &'static Self {
        let at = LANGUAGES.iter().position(|language| language == self).unwrap_or(0);
        &LANGUAGES[(at + if is_back { LANGUAGES.len() - 1 } else { 1 }) % LANGUAGES.len()]
    }

    /// Its texts; those that are not in the program are taken from `fetch`. `None` if they are not there yet, or of another version.
    fn texts(&self, fetch: impl FnOnce() -> Option<Vec<u8>>) -> Option<&[&'static str]> {
        if self.table.get().is_none() {
            let texts = match builtin(self.code) {
                Some(texts) => texts,
                // Only what is taken is kept for good.
                None => String::from_utf8(fetch()?).ok().filter(|texts| texts.split('\0').count() >= COUNT)?.leak(),
            };
            let _ = self.table.set(texts.split('\0').collect());
        }
        self.table.get().map(Vec::as_slice)
    }
}

thread_local! {
    /// The language of the texts, or the first. Of a thread, so that tests of other languages do not disturb each other.
    static CURRENT: Cell<Option<&'static Language>> = const { Cell::new(None) };
}

/// Chooses the language of all texts from now on, and returns whether it is another one. `fetch` has those that are not in the
/// program; until they come nothing changes.
pub fn choose(language: &'static Language, fetch: impl FnOnce() -> Option<Vec<u8>>) -> bool {
    let changes = current() != language && language.texts(fetch).is_some();
    if changes {
        CURRENT.set(Some(language));
    }
    changes
}

/// The language of the texts.
#[must_use]
pub fn current() -> &'static Language {
    CURRENT.get().unwrap_or(&LANGUAGES[0])
}

fn pattern(language: &'static Language, key: Key) -> &'static str {
    let texts = language.texts(|| None).unwrap_or_default();
    texts.get(key as usize).copied().unwrap_or_default()
}

/// A text that follows the language, or one that has none, such as a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Label {
    /// One of the texts.
    Key(Key),
    /// As it is.
    Own(String),
}

impl Label {
    /// What it says.
    #[must_use]
    pub fn text(&self) -> &str {
        match self {
            Self::Key(key) => text(*key),
            Self::Own(own) => own,
        }
    }
}

impl From<Key> for Label {
    fn from(key: Key) -> Self {
        Self::Key(key)
    }
}

impl From<&str> for Label {
    fn from(own: &str) -> Self {
        Self::Own(own.to_owned())
    }
}

impl From<String> for Label {
    fn from(own: String) -> Self {
        Self::Own(own)
    }
}

/// A value in a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arg<'a> {
    /// Words, and numbers that are written already.
    Text(&'a str),
    /// A count, by which a plural is chosen.
    Count(u32),
}

impl<'a> From<&'a str> for Arg<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text)
    }
}

impl<'a> From<&'a String> for Arg<'a> {
    fn from(text: &'a String) -> Self {
        Self::Text(text)
    }
}

impl From<u32> for Arg<'_> {
    fn from(count: u32) -> Self {
        Self::Count(count)
    }
}

/// A text without variables.
#[must_use]
pub fn text(key: Key) -> &'static str {
    pattern(current(), key)
}

/// A text with these variables.
#[must_use]
pub fn text_with(key: Key, args: &[(&str, Arg<'_>)]) -> String {
    fill(pattern(current(), key), args, current())
}

/// What is wrong with a file.
#[must_use]
pub fn of_file(key: Key, path: &Path, error: &io::Error) -> String {
    text_with(key, &[("file", (&path.display().to_string()).into()), ("error", of_error(error.kind()).into())])
}

/// Why something cannot be read, written or reached: the system's own words are for developers.
#[must_use]
pub fn of_error(kind: ErrorKind) -> &'static str {
    text(match kind {
        ErrorKind::NotFound => Key::ErrorMissing,
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => Key::ErrorForbidden,
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => Key::ErrorFull,
        ErrorKind::InvalidInput | ErrorKind::IsADirectory | ErrorKind::NotADirectory => Key::ErrorNoFile,
        ErrorKind::FileTooLarge => Key::ErrorTooLong,
        ErrorKind::InvalidData => Key::FileNotText,
        ErrorKind::AddrNotAvailable
        | ErrorKind::BrokenPipe
        | ErrorKind::ConnectionAborted
        | ErrorKind::ConnectionRefused
        | ErrorKind::ConnectionReset
        | ErrorKind::HostUnreachable
        | ErrorKind::NetworkDown
        | ErrorKind::NetworkUnreachable
        | ErrorKind::TimedOut => Key::ErrorSilent,
        _ => Key::ErrorOther,
    })
}

/// A number with so many decimals.
#[must_use]
pub fn number(value: f32, decimals: usize) -> String {
    format!("{value:.decimals$}").replace('.', current().decimal)
}

/// A time that something took, s, in tenths, rounded up: one that is shown as within a limit is.
#[must_use]
pub fn time_taken(time: f32) -> String {
    number((10.0 * time).ceil() / 10.0, 1)
}

/// A number with as many decimals as it has.
#[must_use]
pub fn shortest(value: f32) -> String {
    value.to_string().replace('.', current().decimal)
}

/// What another language than English says of a slide, its title, task or fact, or about a simulation.
#[must_use]
pub fn of_scene(scene: &str, part: &str) -> Option<&'static str> {
    let texts = current().texts(|| None)?.get(COUNT..)?;
    let of = |text: &&'static str| {
        let (name, told) = text.split_once('\x02')?;
        (name.strip_prefix(scene)?.strip_prefix('-')? == part).then_some(told)
    };
    texts.iter().find_map(of)
}

/// A pattern of a table (see `words/compile.rs`) with these variables.
fn fill(pattern: &str, args: &[(&str, Arg<'_>)], language: &Language) -> String {
    let (mut text, mut rest) = (String::new(), pattern);
    while let Some((before, after)) = rest.split_once(['\x01', '\x03']) {
        text.push_str(before);
        let is_choice = rest.as_bytes()[before.len()] == 3;
        let (name, after) = after.split_once('\x02').unwrap_or((after, ""));
        let arg = args.iter().find(|(known, _)| *known == name).map_or(Arg::Text(name), |(_, arg)| *arg);
        rest = after;
        if is_choice {
            let (variants, after) = after.split_once('\x05').unwrap_or((after, ""));
            text += &fill(variant(variants, arg, language), args, language);
            rest = after;
        } else {
            match arg {
                Arg::Text(value) => text.push_str(value),
                Arg::Count(count) => text += &count.to_string(),
            }
        }
    }
    text + rest
}

/// The variant for a value.
fn variant<'a>(variants: &'a str, arg: Arg<'_>, language: &Language) -> &'a str {
    let fits = |name: &str| match arg {
        Arg::Text(value) => name == value,
        Arg::Count(count) => name == (language.category)(count.into()) || name == count.to_string(),
    };
    let mut all = variants.split('\x04').filter_map(|variant| variant.split_once('\x02'));
    all.find(|(name, _)| name.is_empty() || fits(name)).map_or("", |(_, text)| text)
}

#[cfg(test)]
mod layout_tests;
#[cfg(test)]
mod tests;
