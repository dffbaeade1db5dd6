use super::*;
use crate::input::Action;
use crate::scenery::{Effort, Sight};
use crate::ui::font::TextSize;
use crate::ui::menu::MenuLayout;
use crate::ui::pen::Pen;
use fluent_bundle::{FluentArgs, FluentBundle, FluentResource};
use microsim_core::glam::Vec2;
use std::collections::BTreeSet;
use std::path::Path;

fn source(language: &Language) -> String {
    std::fs::read_to_string(format!("words/{}.ftl", language.code)).unwrap()
}

/// The variables that a pattern names.
fn variables(pattern: &str) -> BTreeSet<&str> {
    pattern.split(['\x01', '\x03']).skip(1).filter_map(|part| Some(part.split_once('\x02')?.0)).collect()
}

#[test]
fn every_text_is_what_fluent_makes_of_it() {
    for language in &LANGUAGES {
        let resource = FluentResource::try_new(source(language)).unwrap();
        let mut bundle = FluentBundle::new(vec![language.code.parse().unwrap()]);
        bundle.set_use_isolating(false);
        bundle.add_resource(resource).unwrap();
        choose(language, || None);
        for (name, key) in ALL {
            let wanted = bundle.get_message(name).unwrap().value().unwrap();
            for count in [0, 1, 2, 4, 5, 11, 21, 22, 101, 1234] {
                let names = variables(pattern(language, key));
                let mut fluent = FluentArgs::new();
                names.iter().for_each(|name| fluent.set(*name, count));
                let own: Vec<_> = names.iter().map(|name| (*name, Arg::Count(count))).collect();
                let expected = bundle.format_pattern(wanted, Some(&fluent), &mut Vec::new());
                assert_eq!(text_with(key, &own), expected, "{name}, {count}, {}", language.code);
            }
        }
    }
}

#[test]
fn plurals_and_decimals_are_those_of_the_language() {
    let stars = |count: u32| text_with(Key::MenuStars, &[("stars", count.into())]);
    assert_eq!([1, 2].map(stars), ["1 star", "2 stars"]);
    assert_eq!(number(2.5, 1), "2.5");
    choose(Language::named("cs").unwrap(), || None);
    assert_eq!([1, 3, 5].map(stars), ["1 hvězda", "3 hvězdy", "5 hvězd"]);
    assert_eq!(number(2.5, 1), "2,5");
    assert_eq!(czech(1.5), "many");
}

#[test]
fn no_key_is_unused() {
    fn sources(folder: &Path, found: &mut String) {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                sources(&path, found);
            } else if !path.ends_with("words/tests.rs") {
                found.push_str(&std::fs::read_to_string(&path).unwrap_or_default());
            }
        }
    }
    let mut code = String::new();
    sources(Path::new("src"), &mut code);
    let used: BTreeSet<&str> =
        code.split("Key::").skip(1).map(|rest| rest.split(|c: char| !c.is_alphanumeric()).next().unwrap()).collect();
    let unused: Vec<_> = ALL.iter().filter(|(_, key)| !used.contains(format!("{key:?}").as_str())).collect();
    assert!(unused.is_empty(), "{unused:?}");
}

#[test]
fn every_letter_can_be_written() {
    for language in &LANGUAGES {
        choose(language, || None);
        for text in language.texts(|| None).unwrap() {
            let strange =
                text.chars().find(|&letter| letter >= ' ' && !crate::ui::letters::letters().any(|l| l == letter));
            assert_eq!(strange, None, "{text}");
        }
    }
}

#[test]
fn every_slide_is_told_in_every_other_language() {
    for language in &LANGUAGES[1..] {
        choose(language, || None);
        let expected =
            crate::slides::SLIDES.iter().flat_map(|slide| ["title", "task", "fact"].map(|part| (slide.name, part)));
        let known = expected.filter(|(name, part)| of_slide(name, part).is_some()).count();
        assert_eq!(known, 3 * crate::slides::SLIDES.len());
        assert_eq!(language.texts(|| None).unwrap().len(), COUNT + known, "texts of slides that are not there");
    }
}

#[test]
fn the_language_is_that_of_the_locale_or_english() {
    let code = |locale| Language::for_locale(locale).code;
    assert_eq!(["cs_CZ.UTF-8", "cs", "cs-CZ", "CS"].map(code), ["cs"; 4]);
    assert_eq!(["", "C", "POSIX", "de_DE", "en-GB"].map(code), ["en"; 5]);
    assert_eq!(LANGUAGES[1].next(false).code, "en");
}

#[test]
fn a_table_of_another_version_is_refused_and_one_that_comes_late_is_taken() {
    let other = Box::leak(Box::new(Language::new("xx", "X", ".", english)));
    choose(other, || None);
    choose(other, || Some(b"too short".to_vec()));
    assert_eq!(current().code, "en");
    choose(other, || Some(vec![0; COUNT]));
    assert_eq!(current().code, "xx");
}

/// Widths in a small window with the largest text.
fn small_window() -> (Pen, impl Fn(TextSize, &str) -> f32) {
    Pen::measured(Vec2::new(640.0, 360.0), 1.5)
}

#[test]
fn settings_and_keys_fit_their_menu_in_a_small_window() {
    let (pen, measure) = small_window();
    let (layout, line) = (MenuLayout::middle(&pen, 0.3), pen.line(TextSize::Body));
    let room = layout.item.x - 0.8 * layout.item.y.min(1.55 * line);
    let efforts = || Effort::ALL.map(Effort::title).to_vec();
    for language in &LANGUAGES {
        choose(language, || None);
        let switch = || vec![text(Key::MenuOn), text(Key::MenuOff)];
        let mut items = vec![
            (Key::SettingsLanguage, LANGUAGES.iter().map(|language| language.name).collect()),
            (Key::SettingsOptics, Sight::all().map(Sight::title).collect()),
            (Key::SettingsQuality, efforts()),
            (Key::SettingsTextSize, vec!["150 %"]),
            (Key::SettingsPace, vec!["100 %"]),
            (Key::SettingsSound, vec!["100 %"]),
        ];
        let switches = [Key::SettingsMotion, Key::SettingsDigestion, Key::SettingsCrawl, Key::SettingsArrows];
        items.extend(switches.into_iter().chain([Key::SettingsFullScreen]).map(|key| (key, switch())));
        items.extend(Action::ALL.map(|action| (action.label(), vec![text(Key::KeysPress)])));
        for (label, values) in items {
            for value in values {
                let line = format!("> {}  {value} >", text(label));
                assert!(measure(TextSize::Body, &line) <= room, "{}: {line}", language.code);
            }
        }
    }
}

#[test]
fn menus_and_headings_fit_a_small_window() {
    let (pen, measure) = small_window();
    let title = MenuLayout::title(&pen).item.x;
    let middle = MenuLayout::middle(&pen, 0.3).item.x;
    for language in &LANGUAGES {
        choose(language, || None);
        for (name, key) in ALL {
            let room = match name.split_once('-').map_or(name, |(group, _)| group) {
                "title" if !["title", "title-motto", "title-version"].contains(&name) => title,
                "quit" | "pause" | "back" | "settings" => middle,
                _ if ["end-again", "end-watch", "slide-end-next", "chain-today", "chain-other"].contains(&name) => {
                    middle
                }
                _ => continue,
            };
            if name == "settings-unknown-language" {
                continue;
            }
            let width = measure(TextSize::Body, &format!("> {}", text(key))) + 0.8 * pen.line(TextSize::Body);
            assert!(width <= room, "{name}, {}: {width} of {room}", language.code);
        }
        for key in [Key::ChangeHeading, Key::QuitHeading, Key::TitleNetwork, Key::HudBitten, Key::HudReplayDiffers] {
            assert!(measure(TextSize::Body, text(key)) <= 0.96 * pen.screen().x, "{}", text(key));
        }
    }
}
