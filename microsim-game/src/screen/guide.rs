//! The field guide: what the player has found so far, and what is left to be found.

use super::context::AppContext;
use super::page::MenuPage;
use super::{Next, Overlay, Screen, pick};
use crate::guide::{ENTRIES, Entry};
use crate::input::{Action, Input, Move};
use crate::scenery::Sight;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key};

#[derive(Debug)]
pub(super) struct Guide {
    page: MenuPage,
}

impl Guide {
    /// All entries; the present way of looking is found by now.
    pub(super) fn new(context: &mut AppContext) -> Self {
        context.find(context.sight().name());
        Self { page: MenuPage::new(heading(context), items(context)) }
    }
}

fn heading(context: &AppContext) -> String {
    let count = |count: usize| words::Arg::Count(count as u32);
    words::text_with(Key::GuideHeading, &[("found", count(context.found.count())), ("all", count(ENTRIES.len()))])
}

/// Titles of the entries, once they are there; those that are not found yet have a question mark.
fn items(context: &AppContext) -> Vec<MenuItem> {
    let item = |name| {
        let title = context.article(name).map_or("", |article| article.title);
        MenuItem::new(if context.found.has(name) { title.to_owned() } else { format!("? {title}") })
    };
    ENTRIES.iter().map(|entry| item(entry.name)).collect()
}

/// How an entry that is not found yet is found; `key` is what is written on the key for the next way of looking.
fn how(entry: &Entry, key: &str) -> String {
    let ask = || {
        let scene = pick::builtin_title(entry.scene.0);
        words::text_with(Key::GuideAsk, &[("scene", scene.text().into())])
    };
    match entry.name {
        "agar" | "coccus" | "bacillus" | "rigid-cell" => words::text(Key::GuideEat).to_owned(),
        "phagocytosis" | "phagosome" => words::text(Key::GuideTake).to_owned(),
        "division" => words::text(Key::GuideDivide).to_owned(),
        "custom" => words::text(Key::GuideOwn).to_owned(),
        name if Sight::all().any(|sight| sight.name() == name) => {
            words::text_with(Key::GuideLook, &[("key", key.into())])
        }
        _ => ask(),
    }
}

impl Screen for Guide {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        self.page.menu.items = items(context);
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        match self.page.update(input, &context.pen) {
            Some(MenuChoice::Pick(item)) if context.found.has(ENTRIES[item].name) => {
                Next::Open(Overlay::Article(&ENTRIES[item]))
            }
            _ => Next::Stay,
        }
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        let entry = &ENTRIES[self.page.menu.focus()];
        let is_found = context.found.has(entry.name);
        let how = || how(entry, &context.settings.keys.label(Action::Optics));
        let note = if is_found { words::text(Key::GuideRead).to_owned() } else { how() };
        self.page.draw_note(&mut context.pen, &note);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "guide".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::is_seen_whole;
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_entry_says_how_it_is_found_and_where_to_ask() {
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            let told: Vec<String> = ENTRIES.iter().map(|entry| how(entry, "PageDown")).collect();
            assert!(told.iter().all(|note| is_seen_whole(note)), "{told:?}");
            let different: BTreeSet<&String> = told.iter().collect();
            assert!(different.len() >= 10, "{different:?}");
            let wall = ENTRIES.iter().position(|entry| entry.name == "wall").unwrap();
            assert!(told[wall].contains(words::text(Key::SceneSqueeze)), "{}", told[wall]);
        }
    }
}
