//! The field guide: what the player has found so far, and what is left to be found.

use super::context::AppContext;
use super::page::MenuPage;
use super::{Next, Overlay, Screen};
use crate::guide::ENTRIES;
use crate::input::{Input, Move};
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
        let is_found = context.found.has(ENTRIES[self.page.menu.focus()].name);
        let note = if is_found { Key::GuideRead } else { Key::GuideHidden };
        self.page.draw_note(&mut context.pen, words::text(note));
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "guide".to_owned()
    }
}
