//! What is written fits a small window with the largest text, in all languages.

use super::*;
use crate::guide::ENTRIES;
use crate::hud::food_chain;
use crate::input::Action;
use crate::network::plan::Way;
use crate::rules::two_players::TwoPlayers;
use crate::scenery::{Effort, Sight};
use crate::ui::font::TextSize;
use crate::ui::menu::MenuLayout;
use crate::ui::pen::{Pen, wrap};
use microsim_core::glam::Vec2;

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
        let switches = [
            Key::SettingsMotion,
            Key::SettingsDigestion,
            Key::SettingsCrawl,
            Key::SettingsCaptions,
            Key::SettingsArrows,
        ];
        items
            .extend(switches.into_iter().chain([Key::SettingsFullScreen, Key::KeysLetters]).map(|key| (key, switch())));
        items.extend(Action::ALL.map(|action| (action.label(), vec![text(Key::KeysPress)])));
        for (label, values) in items {
            for value in values {
                // A mark where the drawn view stands in.
                let mark = if label == Key::SettingsOptics { " *" } else { "" };
                let line = format!("> {}  {value}{mark} >", text(label));
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
                "title" if !["title", "title-goal", "title-motto", "title-new", "title-version"].contains(&name) => {
                    title
                }
                "quit" | "pause" | "back" | "settings" => middle,
                _ if ["end-again", "end-watch", "slide-end-next", "chain-today", "chain-other", "chain-same"]
                    .contains(&name) =>
                {
                    middle
                }
                _ => continue,
            };
            // Messages and notes are broken into lines.
            if name == "settings-unknown-language" || name.ends_with("-about") {
                continue;
            }
            let width = measure(TextSize::Body, &format!("> {}", text(key))) + 0.8 * pen.line(TextSize::Body);
            assert!(width <= room, "{name}, {}: {width} of {room}", language.code);
        }
        // Beside the title's own menu, to the right edge.
        for note in [longest(Key::TitleGoal), text(Key::TitleNew).to_owned()] {
            assert!(measure(TextSize::Body, &note) <= 0.94 * pen.screen().x, "{note}");
        }
        for key in [Key::ChangeHeading, Key::QuitHeading, Key::TitleNetwork, Key::HudBitten, Key::HudReplayDiffers] {
            assert!(measure(TextSize::Body, text(key)) <= 0.96 * pen.screen().x, "{}", text(key));
        }
    }
}

/// A text with the longest values that its variables have; `count` is for the others.
fn longest(key: Key) -> String {
    let player = text_with(Key::MatchPlayer, &[("number", 4.into()), ("colour", text(Key::ColourOrange).into())]);
    let value = |name: &str| match name {
        "player" => player.clone(),
        "what" if [Key::TitleGoal, Key::ChainNext].contains(&key) => text(Key::FeatBites).to_owned(),
        "what" if format!("{key:?}").starts_with("Hint") => text(Key::HintMouse).to_owned(),
        "what" if key == Key::LessonLunge => longest(Key::HintLungeKey),
        "what" => text(Key::SpawnRigidCell).to_owned(),
        "code" => "ABCDEF012345".to_owned(),
        "file" | "record" | "world" | "aside" => "a-simulation-of-mine.toml".to_owned(),
        "host" => "microsim.example.org:8080".to_owned(),
        "error" | "problem" => "Connection refused (os error 111)".to_owned(),
        "task" => "Stráv čtyři koky, dvě tyčinky a nálevníka a pak se vrať domů ke značce.".to_owned(),
        "quality" => text(Key::QualityDrawn).to_owned(),
        "key" | "out" | "in" | "optics" | "picture" => "PageDown".to_owned(),
        _ => "1234".to_owned(),
    };
    let names: Vec<&str> = pattern(current(), key).split(['\x01', '\x03']).skip(1).collect();
    let named: Vec<(&str, String)> =
        names.iter().filter_map(|part| Some(part.split_once('\x02')?.0)).map(|name| (name, value(name))).collect();
    let args: Vec<(&str, Arg<'_>)> = named.iter().map(|(name, value)| (*name, value.into())).collect();
    text_with(key, &args)
}

/// All messages of these groups.
fn of_groups(groups: &'static [&str]) -> impl Iterator<Item = (&'static str, Key)> {
    ALL.into_iter().filter(|(name, _)| groups.iter().any(|group| name.starts_with(group)))
}

#[test]
fn advice_takes_at_most_a_third_of_a_small_window() {
    let (pen, measure) = small_window();
    let (room, line) = (0.9 * pen.screen().x, 1.12 * pen.line(TextSize::Body));
    for language in &LANGUAGES {
        choose(language, || None);
        let advice = of_groups(&[
            "hint-",
            "lesson-",
            "match-you-are",
            "match-watch",
            "match-waiting",
            "match-cut",
            "match-leave",
        ]);
        for (name, key) in advice {
            let lines = wrap(&longest(key), |line| measure(TextSize::Body, line) <= room);
            let widest = lines.iter().map(|line| measure(TextSize::Body, line)).fold(0.0, f32::max);
            let height = line * lines.len() as f32;
            assert!(widest <= room && height <= 0.34 * pen.screen().y, "{name}, {}: {widest}, {height}", language.code);
        }
    }
}

#[test]
fn messages_are_seen_whole_in_a_small_window() {
    let (pen, measure) = small_window();
    let (screen, line) = (pen.screen(), pen.line(TextSize::Small));
    for language in &LANGUAGES {
        choose(language, || None);
        let told = of_groups(&[
            "sandbox-",
            "room-",
            "match-",
            "photo-",
            "file",
            "last-game-",
            "settings-un",
            "quality-",
            "keys-refused",
            "join-",
        ]);
        for (name, key) in told.filter(|(name, _)| *name != "sandbox-legend") {
            let lines = wrap(&longest(key), |line| measure(TextSize::Small, line) <= 0.94 * screen.x);
            let widest = lines.iter().map(|line| measure(TextSize::Small, line)).fold(0.0, f32::max);
            let below = 0.78 * screen.y + line * (lines.len() as f32 + 0.2);
            assert!(widest <= 0.94 * screen.x && below <= screen.y, "{name}, {}: {lines:?}", language.code);
        }
    }
}

#[test]
fn status_lines_fit_beside_the_clock() {
    let (pen, measure) = small_window();
    let clock = measure(TextSize::Large, "0:00") + 1.4 * pen.line(TextSize::Large);
    for language in &LANGUAGES {
        choose(language, || None);
        let joined = |parts: Vec<(Option<usize>, String)>| {
            parts.into_iter().map(|(_, text)| text).collect::<Vec<_>>().join("WW")
        };
        let scores = [1234, 3456, 1234, 1234];
        // Only in a room there are more than two.
        let most = |way| if way == TwoPlayers::Bot { 2 } else { 4 };
        let of_players = |way: &TwoPlayers| [2, most(*way)].map(|players| joined(way.summary(&scores[..players])));
        let mut lines: Vec<String> = TwoPlayers::ALL.iter().flat_map(of_players).collect();
        lines.push(food_chain::summary(9999.0, [12.5, 64.0], 12));
        lines.extend([Key::HudScore, Key::HudPlaces, Key::HudDigested].map(longest));
        for line in lines {
            let width = measure(TextSize::Small, &line);
            assert!(width + clock <= pen.screen().x, "{}: {line}", language.code);
        }
    }
}

#[test]
fn ends_leave_room_for_their_menu_in_a_small_window() {
    let (pen, measure) = small_window();
    let (screen, line) = (pen.screen(), |size| pen.line(size));
    let lines = |size, text: &str, share: f32| {
        wrap(text, |line| measure(size, line) <= share * screen.x).len() as f32 * line(size)
    };
    for language in &LANGUAGES {
        choose(language, || None);
        // Both cells of a slide, as in `screen/two_players_end.rs`.
        for key in [Key::TwoWins, Key::TwoDraw, Key::TwoDrawBest, Key::TwoTogetherEnd, Key::TwoYouWin, Key::TwoBotWins]
        {
            let heading = lines(TextSize::Large, &(longest(key) + text(Key::EndDoubt)), 0.94);
            assert!(0.12 * screen.y + heading + line(TextSize::Body) <= 0.62 * screen.y, "{key:?}, {}", language.code);
        }
        // Of a match in the food chain, as in `screen/food_chain_end.rs`.
        for key in [Key::ChainWins, Key::ChainDraw, Key::ChainDrawBest] {
            let heading = lines(TextSize::Large, &(longest(key) + text(Key::EndDoubt)), 0.92);
            assert!(0.1 * screen.y + heading <= 0.62 * screen.y, "{key:?}, {}", language.code);
        }
        // The points, and what was missed.
        let heading = measure(TextSize::Large, &(longest(Key::EndPoints) + text(Key::EndDoubt)));
        assert!(heading <= screen.x, "{heading}, {}", language.code);
    }
}

#[test]
fn the_legend_and_the_plots_of_a_simulation_fit_a_small_window() {
    let (pen, measure) = small_window();
    let line = pen.line(TextSize::Small);
    for language in &LANGUAGES {
        choose(language, || None);
        let legend = text(Key::SandboxLegend);
        let widest = legend.lines().map(|entry| measure(TextSize::Small, entry)).fold(0.0, f32::max);
        let height = line * (1.6 + 1.2 * legend.lines().count() as f32);
        assert!(
            widest + 1.3 * line <= 0.5 * pen.screen().x && height <= pen.screen().y,
            "{}: {widest} {height}",
            language.code
        );
        let top = measure(TextSize::Small, &longest(Key::SandboxTop).replace("1234", "1234,5"));
        for key in [Key::SandboxStep, Key::SandboxArea] {
            let heading = measure(TextSize::Small, &longest(key).replace("1234", "1234,5"));
            assert!(heading + top + line <= 13.0 * line, "{key:?}, {}", language.code);
        }
    }
}

#[test]
fn the_panel_of_a_simulation_fits_a_small_window() {
    let (pen, measure) = small_window();
    let layout = MenuLayout::side(&pen, 1.7 * pen.line(TextSize::Small));
    let room = layout.item.x - 0.8 * layout.item.y;
    for language in &LANGUAGES {
        choose(language, || None);
        let plain = of_groups(&["tool-", "panel-"]).map(|(_, key)| key);
        let plain = plain.chain([Key::PauseGoOn, Key::ActionPause, Key::ActionStep, Key::PauseRestart]);
        let mut items: Vec<String> = plain.map(|key| format!("> * {}", text(key))).collect();
        let spawns = of_groups(&["spawn-"]).map(|(_, key)| key).chain([Key::KindAgar]);
        items.extend(spawns.map(|key| format!("> * {}  {} >", text(Key::ToolSpawn), text(key))));
        let fields = of_groups(&["field-"]).map(|(_, key)| key);
        items.extend(fields.map(|key| format!("> * {}  {} >", text(Key::ToolField), text(key))));
        items.push(format!("> {}  0,25 x >", text(Key::PanelSpeed)));
        items.extend(
            [Key::ActionDebugView, Key::ActionPlots].map(|key| format!("> {}  {} >", text(key), text(Key::MenuOff))),
        );
        for item in items {
            let width = measure(TextSize::Small, &item);
            assert!(width <= room, "{}: {item}, {width} of {room}", language.code);
        }
    }
}

#[test]
fn the_lobby_fits_a_small_window() {
    let (pen, measure) = small_window();
    let layout = MenuLayout::middle(&pen, 0.3);
    let room = layout.item.x - 0.8 * layout.item.y.min(1.55 * pen.line(TextSize::Body));
    for language in &LANGUAGES {
        choose(language, || None);
        let mut items = vec![
            format!("> {}  {} >", text(Key::RoomReady), text(Key::MenuOff)),
            format!("> {}", text(Key::RoomLeave)),
        ];
        let seeds = [text(Key::RoomAnySeed), "18446744073709551615"];
        items.extend(seeds.map(|seed| format!("> {}  {seed} >", text(Key::RoomSeed))));
        // On both sides of the arrow that steps back.
        let values = [(Key::RoomRate, "60/s"), (Key::RoomSeed, text(Key::RoomAnySeed)), (Key::RoomSeed, "999999")];
        for (label, value) in values {
            let halves = [format!("> {}", text(label)), format!("{value} >")];
            let widths = halves.map(|half| measure(TextSize::Body, &half) + 0.5 * (layout.item.x - room));
            assert!(widths[0] <= 0.52 * layout.item.x && widths[1] <= 0.4 * layout.item.x, "{value}: {widths:?}");
        }
        items.extend(Way::ALL.map(|way| format!("> {}, 60/s, {} 999999", way.label(), text(Key::RoomSeed))));
        items.extend(Way::ALL.map(|way| format!("> {}  {} >", text(Key::RoomPlay), way.label())));
        let notes = [Key::RoomComing, Key::RoomOtherVersion, Key::RoomPlays, Key::RoomIsReady, Key::RoomNotReady];
        for note in notes {
            let name = text_with(Key::RoomOwnName, &[("name", "Bartholomew Featherstone".into())]);
            let said = [("colour", text(Key::ColourOrange)), ("note", text(note)), ("name", &name), ("number", "4")];
            let seat = format!("> {}", text_with(Key::RoomSeat, &said.map(|(variable, text)| (variable, text.into()))));
            let width = measure(TextSize::Small, &seat);
            assert!(width <= room, "{}: {seat}, {width} of {room}", language.code);
        }
        for item in items {
            let width = measure(TextSize::Body, &item);
            assert!(width <= room, "{}: {item}, {width} of {room}", language.code);
        }
        for line in [Key::ScoresLeave, Key::ScoresNext, Key::MatchNet].map(longest) {
            let width = measure(TextSize::Small, &line);
            assert!(width <= pen.screen().x, "{}: {line}, {width}", language.code);
        }
    }
}

#[test]
fn articles_of_the_field_guide_leave_room_for_their_menu() {
    let (pen, measure) = small_window();
    let (screen, line) = (pen.screen(), pen.line(TextSize::Small));
    // As in `screen/article.rs`, where a picture is shown only in what is left.
    let room = MenuLayout::middle(&pen, 0.86).corner.y - 0.4 * line - 0.22 * screen.y;
    for language in &LANGUAGES {
        choose(language, || None);
        for entry in ENTRIES {
            let article = articles::article(entry.name, |_| None).unwrap();
            let lines = |text: &str, width: f32| wrap(text, |line| measure(TextSize::Small, line) <= width).len();
            let widths = [34.0 * line, 34.0 * pen.line(TextSize::Body)].map(|width| width.min(0.92 * screen.x));
            let count = lines(article.text, widths[0]) + lines(article.source, widths[1]);
            assert!(count as f32 * line <= room, "{}, {}: {count} lines", language.code, entry.name);
            assert!(measure(TextSize::Small, article.title) <= 0.96 * screen.x, "{}", article.title);
        }
    }
}
