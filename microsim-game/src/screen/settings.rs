//! Settings.

use super::context::AppContext;
use super::page::MenuPage;
use super::{Next, Overlay, Screen};
use crate::input::{Input, Move};
use crate::sound::Cue;
use crate::ui::menu::{Menu, MenuChoice, MenuItem};
use crate::words::{self, Key};

#[derive(Debug)]
pub(super) struct SettingsMenu {
    page: MenuPage,
}

const LANGUAGE: usize = 0;
const SIGHT: usize = 1;
const EFFORT: usize = 2;
const TEXT: usize = 3;
const MOTION: usize = 4;
const DIGESTION: usize = 5;
const CRAWL: usize = 6;
const PACE: usize = 7;
const SOUND: usize = 8;
const CAPTIONS: usize = 9;
const ARROWS: usize = 10;
const FULL_SCREEN: usize = 11;
const KEYS: usize = 12;
const NAME: usize = 13;

impl SettingsMenu {
    pub(super) fn new(context: &AppContext) -> Self {
        Self { page: MenuPage::new(Key::Settings, items(context)) }
    }
}

fn items(context: &AppContext) -> Vec<MenuItem> {
    let settings = &context.settings;
    vec![
        MenuItem::with(Key::SettingsLanguage, context.language().name),
        MenuItem::with(Key::SettingsOptics, optics(context.sight().title(), is_drawn(context))),
        MenuItem::with(Key::SettingsQuality, context.effort().title()),
        MenuItem::with(Key::SettingsTextSize, percent(settings.text_factor())),
        MenuItem::switch(Key::SettingsMotion, settings.reduced_motion),
        MenuItem::switch(Key::SettingsDigestion, settings.hold_to_digest),
        MenuItem::switch(Key::SettingsCrawl, settings.click_to_crawl),
        MenuItem::with(Key::SettingsPace, percent(settings.pace())),
        MenuItem::with(Key::SettingsSound, percent(settings.loudness())),
        MenuItem::switch(Key::SettingsCaptions, settings.captions),
        MenuItem::switch(Key::SettingsArrows, settings.classic_arrows),
        MenuItem::switch(Key::SettingsFullScreen, settings.full_screen),
        MenuItem::new(Key::SettingsKeys),
        MenuItem::with(Key::SettingsName, settings.name.clone()),
        MenuItem::new(Key::Back),
    ]
}

/// Whether the drawn view stands in for the optics.
fn is_drawn(context: &AppContext) -> bool {
    context.scenery.stands_in(context.effort(), context.sight())
}

/// The name of the optics, with a mark if the drawn view stands in for them.
fn optics(name: &str, is_drawn: bool) -> String {
    format!("{name}{}", if is_drawn { " *" } else { "" })
}

/// What a setting does, if its name does not say it.
fn about(item: usize) -> Option<Key> {
    match item {
        EFFORT => Some(Key::SettingsQualityAbout),
        MOTION => Some(Key::SettingsMotionAbout),
        DIGESTION => Some(Key::SettingsDigestionAbout),
        CRAWL => Some(Key::SettingsCrawlAbout),
        PACE => Some(Key::SettingsPaceAbout),
        CAPTIONS => Some(Key::SettingsCaptionsAbout),
        ARROWS => Some(Key::SettingsArrowsAbout),
        _ => None,
    }
}

fn percent(share: f32) -> String {
    words::text_with(Key::Percent, &[("number", (&words::number(100.0 * share, 0)).into())])
}

/// Changes the setting that was chosen, or says which screen comes next.
fn change(choice: MenuChoice, context: &mut AppContext) -> Option<Next> {
    let settings = &mut context.settings;
    match choice {
        MenuChoice::Pick(LANGUAGE) => context.change_language(false),
        MenuChoice::Less(LANGUAGE) => context.change_language(true),
        MenuChoice::Pick(SIGHT) => context.change_sight(false),
        MenuChoice::Less(SIGHT) => context.change_sight(true),
        MenuChoice::Pick(EFFORT) => context.change_effort(false),
        MenuChoice::Less(EFFORT) => context.change_effort(true),
        MenuChoice::Pick(TEXT) => settings.change_text_size(1),
        MenuChoice::Less(TEXT) => settings.change_text_size(-1),
        MenuChoice::Pick(MOTION) | MenuChoice::Less(MOTION) => settings.reduced_motion ^= true,
        MenuChoice::Pick(DIGESTION) | MenuChoice::Less(DIGESTION) => settings.hold_to_digest ^= true,
        MenuChoice::Pick(CRAWL) | MenuChoice::Less(CRAWL) => settings.click_to_crawl ^= true,
        MenuChoice::Pick(PACE) => settings.change_pace(false),
        MenuChoice::Less(PACE) => settings.change_pace(true),
        MenuChoice::Pick(SOUND) => settings.change_sound(true),
        MenuChoice::Less(SOUND) => settings.change_sound(false),
        MenuChoice::Pick(CAPTIONS) | MenuChoice::Less(CAPTIONS) => settings.captions ^= true,
        MenuChoice::Pick(ARROWS) | MenuChoice::Less(ARROWS) => settings.classic_arrows ^= true,
        MenuChoice::Pick(FULL_SCREEN) | MenuChoice::Less(FULL_SCREEN) => settings.full_screen ^= true,
        MenuChoice::Pick(NAME) => return Some(Next::Open(Overlay::Name)),
        MenuChoice::Pick(KEYS) => return Some(Next::Open(Overlay::Keys)),
        _ => return Some(Next::Back),
    }
    None
}

impl Screen for SettingsMenu {
    fn update(&mut self, input: &Input, context: &mut AppContext) -> Next {
        // Keys change some of them too.
        self.page.menu.items = items(context);
        if input.step == Some(Move::Back) {
            return Next::Back;
        }
        let Some(choice) = self.page.update(input, &context.pen) else { return Next::Stay };
        if let Some(next) = change(choice, context) {
            return next;
        }
        self.page.menu.items = items(context);
        if let MenuChoice::Pick(SOUND | CAPTIONS) | MenuChoice::Less(SOUND | CAPTIONS) = choice {
            context.play(&[Cue::Digest]);
        }
        context.save_settings();
        Next::Stay
    }

    fn draw(&mut self, context: &mut AppContext) {
        self.page.draw(&mut context.pen);
        let of_optics = Some(Key::SettingsDrawnAbout).filter(|_| is_drawn(context));
        let about = about(self.page.menu.focus()).or(of_optics).map_or("", words::text);
        self.page.draw_note(&mut context.pen, about);
    }

    fn menu(&self) -> Option<&Menu> {
        Some(&self.page.menu)
    }

    fn name(&self) -> String {
        "settings".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::is_seen_whole;
    use super::*;

    #[test]
    fn what_settings_do_is_seen_whole_in_a_small_window() {
        for language in &words::LANGUAGES {
            words::choose(language, || None);
            let told: Vec<&str> = (LANGUAGE..=KEYS).filter_map(about).map(words::text).collect();
            assert_eq!(told.len(), 7);
            let told = told.into_iter().chain([words::text(Key::SettingsDrawnAbout)]);
            for about in told {
                assert!(is_seen_whole(about), "{}: {about}", language.code);
            }
        }
    }
}
