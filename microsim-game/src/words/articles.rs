//! The articles of the field guide, in the language that is chosen.

use super::{Language, builtin_guide, current};

/// An article of the field guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Article {
    /// Its name, the same in all languages.
    pub name: &'static str,
    /// What it is about.
    pub title: &'static str,
    /// What it says.
    pub text: &'static str,
    /// Where that is from.
    pub source: &'static str,
}

impl Language {
    /// Its articles; those that are not in the program are taken from `fetch`.
    fn articles(&self, fetch: impl FnOnce(&str) -> Option<Vec<u8>>) -> Option<&[Article]> {
        if self.articles.get().is_none() {
            let texts = match builtin_guide(self.code) {
                Some(texts) => texts,
                None => String::from_utf8(fetch(&format!("guide-{}", self.code))?).ok()?.leak(),
            };
            let _ = self.articles.set(texts.split('\0').filter_map(read).collect());
        }
        self.articles.get().map(Vec::as_slice)
    }
}

fn read(text: &'static str) -> Option<Article> {
    let mut parts = text.split('\x02');
    Some(Article { name: parts.next()?, title: parts.next()?, text: parts.next()?, source: parts.next()? })
}

/// An article, once the texts are there: on a page `fetch` has them.
pub fn article(name: &str, fetch: impl FnOnce(&str) -> Option<Vec<u8>>) -> Option<&'static Article> {
    current().articles(fetch)?.iter().find(|article| article.name == name)
}
