use super::*;
use crate::slides;
use fluent_bundle::{FluentArgs, FluentBundle, FluentResource};
use microsim_core::scenario::builtins;
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
fn errors_are_told_in_words_and_not_in_those_of_the_system() {
    let told = |error: io::Error| of_file(Key::FileUnwritable, Path::new("a.png"), &error);
    assert_eq!(told(ErrorKind::StorageFull.into()), "cannot write a.png: there is no room left");
    assert_eq!(told(io::Error::other("code 5")), "cannot write a.png: the system refuses it");
    assert_eq!(told(std::fs::read("nowhere").unwrap_err()), "cannot write a.png: it is not there");
    choose(Language::named("cs").unwrap(), || None);
    assert_eq!(told(ErrorKind::StorageFull.into()), "Nelze zapsat a.png: není už místo");
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
fn every_slide_and_simulation_is_told_in_every_other_language() {
    let of_slides = slides::all().flat_map(|slide| ["title", "task", "fact"].map(|part| (slide.name, part)));
    let of_simulations = builtins().iter().map(|found| (found.name, "about"));
    let expected: Vec<_> = of_slides.chain(of_simulations).collect();
    for language in &LANGUAGES[1..] {
        choose(language, || None);
        let missing: Vec<_> = expected.iter().filter(|(name, part)| of_scene(name, part).is_none()).collect();
        assert!(missing.is_empty(), "{}: {missing:?}", language.code);
        let others = language.texts(|| None).unwrap()[COUNT..].iter().filter(|text| !text.starts_with("page-\x02"));
        assert_eq!(others.count(), expected.len(), "{}: texts of scenes that are not there", language.code);
    }
}

/// The English texts of the page that are in the catalogue.
fn of_page() -> BTreeSet<String> {
    let catalogue = source(&LANGUAGES[0]);
    let told = catalogue.lines().filter(|line| line.starts_with("page-"));
    told.map(|line| line.split_once(" = ").unwrap().1.to_owned()).collect()
}

/// What stands between two marks.
fn between<'a>(text: &'a str, before: &str, after: &str) -> BTreeSet<&'a str> {
    text.split(before).skip(1).filter_map(|rest| Some(rest.split(after).next()?.trim())).collect()
}

#[test]
fn all_that_the_page_says_is_in_the_catalogue_and_nothing_else() {
    let page = include_str!("../../web/index.html");
    let scripts = [include_str!("../../web/start.js"), include_str!("../../web/host.js")].concat();
    let without_scripts = page.split("<noscript>").map(|part| part.split("</noscript>").last().unwrap());
    let seen = without_scripts.collect::<String>();
    let mut said = between(&seen, ">", "<");
    said.extend(between(&seen, "aria-label=\"", "\""));
    let answers = between(&scripts, "say(", ")");
    said.extend(answers.iter().flat_map(|answer| answer.split('"').skip(1).step_by(2)));
    let name = crate::ui::font::TITLE;
    said.retain(|text| text.contains(char::is_alphabetic) && !text.contains('&') && *text != name);
    let known = of_page();
    assert_eq!(said, known.iter().map(String::as_str).collect());
    for language in &LANGUAGES[1..] {
        let texts = language.texts(|| None).unwrap();
        let told = texts.iter().filter_map(|text| Some(text.strip_prefix("page-\x02")?.split_once('\x02')?.0));
        assert_eq!(told.collect::<BTreeSet<_>>(), said, "{}", language.code);
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

#[test]
fn a_time_that_is_shown_as_within_a_limit_is() {
    assert_eq!([15.0, 15.02, 14.99].map(time_taken), ["15.0", "15.1", "15.0"]);
}
