//! What readers of one file share: where values stand, what is wrong with them, and which fields were asked for.

use super::document::Document;
use super::entry::{Entry, Note};
use super::unknown_name::unknown;
use super::value::join;
use crate::error::Error;
use crate::scenario::diagnostic::{Diagnostic, Diagnostics, Findings, in_words};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// What is wrong with a file so far. Shared by all sections of one file, hence the cell.
#[derive(Debug)]
pub(crate) struct ReadContext<'s> {
    document: &'s Document,
    found: RefCell<Findings>,
    /// Every field that was asked for, if the format is being described.
    pub notes: Option<RefCell<Vec<Note>>>,
    /// Paths of values that were refused by themselves and are read as if they were not there.
    refused: RefCell<BTreeSet<String>>,
}

impl<'s> ReadContext<'s> {
    pub(crate) fn new(document: &'s Document) -> Self {
        Self { document, found: RefCell::default(), notes: None, refused: RefCell::default() }
    }

    /// One that takes notes of what is asked for instead of reading.
    pub(crate) fn describing(document: &'s Document) -> Self {
        Self { notes: Some(RefCell::default()), ..Self::new(document) }
    }

    pub(super) fn note(&self, path: String, entry: impl FnOnce() -> Entry) {
        if let Some(notes) = &self.notes {
            let note = Note { path, entry: entry() };
            let mut notes = notes.borrow_mut();
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
    }

    /// An error unless nothing is wrong.
    pub(crate) fn finish(self) -> Result<(), Diagnostics> {
        self.found.into_inner().check(&self.document.text)
    }

    /// Refuses the value at a path.
    pub(crate) fn refuse(&self, path: &str, message: impl Into<String>, accepted: impl Into<String>) {
        self.add(self.document.diagnostic(path, message, Some(accepted.into())));
    }

    /// Refuses the key at a path.
    pub(crate) fn refuse_key(&self, path: &str, message: impl Into<String>, accepted: impl Into<String>) {
        self.add(self.document.key_diagnostic(path, message.into(), accepted.into()));
    }

    fn add(&self, diagnostic: Diagnostic) {
        self.found.borrow_mut().add_diagnostic(diagnostic);
    }

    /// Refuses the value at a path: a name that is none of those known.
    pub(crate) fn refuse_unknown<'a>(
        &self,
        path: &str,
        what: &str,
        name: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) {
        self.found.borrow_mut().add(&format!("unknown {what}"), path.to_owned(), || {
            let (message, accepted) = unknown(what, name, known);
            self.document.diagnostic(path, message, Some(accepted))
        });
    }

    /// Refuses the key at a path: a name that is none of those known.
    pub(crate) fn refuse_unknown_key<'a>(
        &self,
        path: &str,
        what: &str,
        name: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) {
        self.found.borrow_mut().add(&format!("unknown {what}"), path.to_owned(), || {
            let (message, accepted) = unknown(what, name, known);
            self.document.key_diagnostic(path, message, accepted)
        });
    }

    /// Whether the file has a value at a path.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.document.has(path)
    }

    /// Passes on what the library says of a value in the table at `path`.
    pub(crate) fn check<T>(&self, path: &str, result: Result<T, Error>) -> Option<T> {
        let refuse = |error: Error| self.add(self.diagnostic(path, &error));
        result.map_err(refuse).ok()
    }

    /// Reads something of the table at `path` and has it checked. Where the library refuses a value, that is reported and it
    /// is read once more without that value, so that whatever else is wrong shows too.
    pub(crate) fn check_all<T>(&self, path: &str, mut read: impl FnMut() -> Result<T, Error>) -> Option<T> {
        let mut result = read();
        let is_sound = result.is_ok();
        while let Err(error) = &result {
            let diagnostic = self.diagnostic(path, error);
            let refused = diagnostic.field.clone();
            self.add(diagnostic);
            if !self.document.has(&refused) || self.is_refused(&refused) {
                return None;
            }
            self.refused.borrow_mut().insert(refused);
            result = read();
        }
        result.ok().filter(|_| is_sound)
    }

    /// Whether the value at a path, or an element of it, was refused.
    pub(super) fn is_refused(&self, path: &str) -> bool {
        let (refused, within) = (self.refused.borrow(), format!("{path}."));
        refused.contains(path) || refused.range(within.clone()..).next().is_some_and(|next| next.starts_with(&within))
    }

    /// An error: what the library says of a value in the table at `path`.
    pub(crate) fn refusal(&self, path: &str, error: &Error) -> Diagnostics {
        Diagnostics::only(self.diagnostic(path, error), &self.document.text)
    }

    /// What the library says of a value in the table at `path`, not yet placed.
    fn diagnostic(&self, path: &str, error: &Error) -> Diagnostic {
        let (message, accepted) = in_words(error);
        // The parameters of a fluid are fields of its table.
        let field = error.field().strip_prefix("fluid.").unwrap_or(error.field());
        self.document.diagnostic(&join(path, field), message, accepted)
    }
}
