//! The list of scenarios to look at: those that come with the program, and files.

use super::context::AppContext;
use super::page::MenuPage;
use super::{Next, Screen};
use crate::input::{Input, Move};
use crate::scene_source::SceneSource;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key, Label};
use microsim_core::glam::Vec2;
use microsim_core::scenario::{self, Builtin};

/// Edge around a picture, drawing units.
const EDGE: f32 = 2.0;
/// Names of built-in scenarios for people.
const TITLES: &[(&str, Key)] = &[
    ("absorb-agar", Key::SceneAbsorbAgar),
    ("absorb-rigid", Key::SceneAbsorbRigid),
    ("crawl", Key::SceneCrawl),
    ("crowd", Key::SceneCrowd),
    ("dam-break", Key::SceneDamBreak),
    ("demo", Key::SceneDemo),
    ("divide", Key::SceneDivide),
    ("empty", Key::SceneEmpty),
    ("game", Key::SceneGame),
    ("grow", Key::SceneGrow),
    ("hunt", Key::SceneHunt),
    ("leak-stress", Key::SceneLeakStress),
    ("platelets", Key::ScenePlatelets),
    ("pond", Key::ScenePond),
    ("ram-stress", Key::SceneRamStress),
    ("squeeze", Key::SceneSqueeze),
];

#[derive(Debug)]
pub(super) struct Pick {
    page: MenuPage,
    sources: Vec<(SceneSource, &'static str)>,
}

impl Pick {
    /// The files that the player has named or dropped, and the built-in scenarios.
    pub(super) fn new(context: &AppContext) -> Self {
        let files = context.files.iter().map(|file| (file.clone(), words::text(Key::PickFile)));
        let builtins =
            scenario::builtins().iter().map(|found| (SceneSource::Builtin(found.name.to_owned()), about(found)));
        let sources: Vec<_> = files.chain(builtins).collect();
        let items = sources.iter().map(|(source, _)| MenuItem::new(title(source))).collect();
        let mut page = MenuPage::new(Key::TitleSimulation, items).tall();
        let picked = sources.iter().position(|(source, _)| Some(source) == context.picked.as_ref());
        page.menu.set_focus(picked.unwrap_or_default());
        Self { page, sources }
    }
}

/// What a built-in scenario shows.
fn about(found: &Builtin) -> &'static str {
    words::of_scene(found.name, "about").unwrap_or(found.summary)
}

/// What a scenario is called for people; a file by its name.
fn title(source: &SceneSource) -> Label {
    match source {
        SceneSource::Builtin(name) => builtin_title(name),
        SceneSource::File(_) => source.to_string().into(),
    }
}

/// What a built-in scenario is called for people.
pub(super) fn builtin_title(name: &str) -> Label {
    let known = TITLES.iter().find(|(known, _)| *known == name);
    known.map_or_else(|| name.to_owned().into(), |(_, title)| (*title).into())
}

/// A text with a capital at its beginning, as the list of the command line has none in English.
fn sentence(text: &str) -> String {
    let (first, rest) = text.split_at_checked(1).unwrap_or(("", text));
    first.to_ascii_uppercase() + rest
}

impl Screen for Pick {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        let seen = self.page.menu.shown(&self.page.layout(&context.pen));
        context.album.add_one(seen.map(|(item, _)| &self.sources[item].0), &mut context.scenery);
        let Some(MenuChoice::Pick(item)) = self.page.update(input, &context.pen) else { return Next::Stay };
        context.picked = Some(self.sources[item].0.clone());
        context.open(&self.sources[item].0).map_or(Next::Stay, Next::Show)
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        let summary = self.sources.get(self.page.menu.focus()).map_or("", |(_, summary)| *summary);
        self.page.draw_note(&mut context.pen, &sentence(summary));
        context.pen.flush();
        let layout = self.page.layout(&context.pen);
        for (item, low) in self.page.menu.shown(&layout) {
            let corner = low + Vec2::new(layout.item.x - EDGE, EDGE);
            context.album.show(&self.sources[item].0, corner, layout.item.y - 2.0 * EDGE - 2.0);
        }
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "scenarios".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_scenario_has_a_name_for_people() {
        for found in scenario::builtins() {
            let name = title(&SceneSource::Builtin(found.name.to_owned()));
            assert!(matches!(name, Label::Key(_)) && name.text().starts_with(char::is_uppercase), "{name:?}");
        }
        assert_eq!(TITLES.len(), scenario::builtins().len());
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            for found in scenario::builtins() {
                let told = sentence(about(found));
                assert!(told.starts_with(|first: char| first.is_uppercase() || first.is_numeric()), "{told}");
            }
        }
        assert_eq!(title(&SceneSource::File("a/crawl.toml".into())), "crawl.toml".into());
    }
}
