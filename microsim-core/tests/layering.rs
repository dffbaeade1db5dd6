//! Who may use whom inside the core (docs/architecture.md), and what the core may not do at all.

#[path = "common/sources.rs"]
mod sources;

use sources::{Source, circles, circles_of_modules, sources};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Every module, and the prefixes of the paths that it may use besides its own.
const LAYERS: &[(&str, &str)] = &[
    ("arena bare_text error float_environment fnv geometry instruction_set look rng shared value_walk", ""),
    ("parallel", "float_environment"),
    ("chemical", "config error instruction_set"),
    ("config spec_field", "error"),
    ("particle", "shared"),
    ("actuation", "error"),
    ("id", "arena"),
    ("kind", "id"),
    ("inputs", "actuation error float_environment id"),
    ("joint", "config error id"),
    ("force_field", "error float_environment"),
    ("collider", "id"),
    ("event", "collider id kind"),
    ("collision", "geometry instruction_set parallel particle shared"),
    ("solver", "collision config error geometry instruction_set parallel particle spec_field"),
    ("template", "error float_environment geometry particle rng solver"),
    ("capability", "chemical collision::obstacle config error geometry id rng spec_field"),
    (
        "organism",
        "arena capability collision error float_environment geometry id kind look particle rng shared solver spec_field \
        template",
    ),
    ("supply", "error force_field id kind organism"),
    (
        "behavior",
        "actuation capability chemical event geometry id inputs organism particle solver::contraction solver::drive \
        solver::force",
    ),
    (
        "world",
        "arena behavior capability chemical collider collision config error event float_environment fnv force_field \
        geometry id inputs instruction_set joint kind look organism parallel particle rng shared solver supply template value_walk",
    ),
    // The step takes the world apart and hands each phase what it needs.
    ("step", "behavior capability float_environment inputs organism parallel particle solver world"),
    ("snapshot", "collision float_environment fnv id scenario world"),
    ("replay", "actuation fnv id inputs scenario world"),
    ("microscope", "bare_text collision::obstacle error geometry kind look organism::look template world"),
];

/// Modules that see the crate as an embedder does: only what `lib.rs` makes public.
const OUTSIDERS: &[&str] = &["drawing", "scenario"];

/// What they may use besides, because it knows nothing of the core.
const TOOLS: &[&str] = &["bare_text"];

/// Where the code is not yet what the table says. Each entry has to be in use; delete it with the last use.
const EXCEPTIONS: &[(&str, &str, &str)] = &[];

/// What no source of the core contains: the core does no input or output, reads no clock, prints nothing and has no
/// threads and no global state.
const FORBIDDEN: &str = "println!, eprintln!, print!, eprint!, dbg!, std::env, std::fs, std::io, \
    std::net, std::process, std::thread, std::time, thread_local!, OnceLock, LazyLock, static mut";

/// The dependencies that every user of the core gets.
const DEPENDENCIES: &[&str] = &["glam", "libm", "parry2d", "serde"];

#[test]
fn modules_use_only_what_lies_below_them() {
    let sources = of_the_core();
    let public = sources.iter().find(|source| source.module() == "lib").unwrap().exports();
    let mut wrong = Vec::new();
    let mut needed = BTreeSet::new();
    for source in sources.iter().filter(|source| source.module() != "lib") {
        for used in source.uses() {
            let (module, line, used) = (source.module(), used.line, used.path);
            let exception = EXCEPTIONS.iter().position(|(m, prefix, _)| *m == module && is_within(&used, prefix));
            needed.extend(exception);
            if exception.is_none() && !may_use(module, &used, &public) {
                let place = source.path.display();
                wrong.push(format!("src/{place}:{line}: `{module}` may not use `crate::{}`", used.join("::")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}\nthe rules are in tests/layering.rs, LAYERS", wrong.join("\n"));
    for (k, (module, prefix, _)) in EXCEPTIONS.iter().enumerate() {
        assert!(needed.contains(&k), "`{module}` no longer uses `{prefix}`: delete the entry from EXCEPTIONS");
    }
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    let found = circles(&of_the_core());
    assert!(found.is_empty(), "circles: {found:#?}");
}

#[test]
fn every_module_has_its_place_in_the_table() {
    let known: BTreeSet<&str> =
        LAYERS.iter().flat_map(|(modules, _)| modules.split(' ')).chain(OUTSIDERS.iter().copied()).collect();
    let sources = of_the_core();
    let found: BTreeSet<&str> = sources.iter().map(Source::module).filter(|module| *module != "lib").collect();
    assert_eq!(found, known, "left: modules in src, right: modules in tests/layering.rs");
}

#[test]
fn the_core_does_no_input_or_output_and_keeps_no_global_state() {
    let mut wrong = Vec::new();
    for source in of_the_core() {
        for what in FORBIDDEN.split(", ") {
            let lines = source.lines_with(what).into_iter();
            wrong.extend(lines.map(|line| format!("src/{}:{line}: `{what}`", source.path.display())));
        }
    }
    assert!(wrong.is_empty(), "not for the core:\n{}", wrong.join("\n"));
}

#[test]
fn the_core_depends_on_vectors_shapes_portable_mathematics_and_serde_only() {
    // A published package has its manifest rewritten, and the original beside it.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let original = fs::read_to_string(folder.join("Cargo.toml.orig"));
    let manifest = original.or_else(|_| fs::read_to_string(folder.join("Cargo.toml"))).unwrap();
    let (mut section, mut found) = (String::new(), BTreeSet::new());
    for line in manifest.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if line.starts_with('[') {
            section = line.to_owned();
            let has_hidden = section.contains("dependencies.") || section.contains("target.");
            assert!(!has_hidden, "Cargo.toml: list dependencies in plain tables, not in {section}");
        } else if section == "[dependencies]" && !line.replace(' ', "").contains("optional=true") {
            found.insert(line.split(['.', '=', ' ']).next().unwrap());
        }
    }
    assert_eq!(found, DEPENDENCIES.iter().copied().collect(), "non-optional [dependencies] of microsim-core");
}

#[test]
fn the_scan_sees_code_and_nothing_else() {
    let text = "use crate::{a::{B, c::d}, e as f};\n// crate::f\nlet s = \"{ crate::g\";\nlet c = '\"';\nsuper::super::h();\n\
                #[cfg(test)]\nmod tests { use crate::i; }\nfn k<'a>(x: &'a crate::l::M) { vec![crate::n::o()] }\nmod p;\np::q();\n";
    let source = Source::new(PathBuf::from("x/y.rs"), text);
    let paths: Vec<_> = source.uses().into_iter().map(|used| (used.line, used.path.join("::"))).collect();
    let expected = [(1, "a::B"), (1, "a::c::d"), (1, "e"), (5, "h"), (8, "l::M"), (8, "n::o"), (10, "x::y::p::q")];
    assert_eq!(paths, expected.map(|(line, path)| (line, path.to_owned())));
}

#[test]
fn circles_are_found_but_for_those_of_a_parent_and_its_children() {
    let file = |path: &str, text: &str| Source::new(PathBuf::from(path), text);
    let house = |parent: &str, other: &str| {
        let sources = [
            file("a/mod.rs", &format!("mod one; mod two; pub use one::One; fn shared() {{}} {parent}")),
            file("a/one.rs", "use super::shared;"),
            file("a/two.rs", "use super::One; use crate::b::B;"),
            file("b.rs", other),
        ];
        circles(&sources).into_iter().collect::<Vec<_>>()
    };
    assert_eq!(house("use two::Two;", ""), Vec::<String>::new());
    assert_eq!(house("", "use crate::a::One;"), Vec::<String>::new());
    assert_eq!(house("use two::Two;", "use crate::a::shared;"), ["a <-> a/one <-> a/two <-> b", "a <-> a/two <-> b"]);
    assert_eq!(house("use crate::b::B;", "use crate::a::One;"), ["a <-> a/one <-> b"]);
}

#[test]
fn circles_of_folders_are_found_where_no_files_form_one() {
    let file = |path: &str, text: &str| Source::new(PathBuf::from(path), text);
    let down = file("a/one.rs", "use crate::b::two::Two;");
    let back = file("b/three.rs", "use crate::a::four::Four;");
    let rest = [file("a/four.rs", ""), file("b/two.rs", "")];
    let all: Vec<_> = rest.into_iter().chain([down, back]).collect();
    assert_eq!(circles(&all), BTreeSet::new());
    assert_eq!(circles_of_modules(&all).into_iter().collect::<Vec<_>>(), ["a <-> b"]);
    assert_eq!(circles_of_modules(&all[..3]), BTreeSet::new());
}

fn of_the_core() -> Vec<Source> {
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"))
}

fn may_use(module: &str, used: &[String], public: &BTreeSet<String>) -> bool {
    if used.first().is_none_or(|first| first == module) {
        return true;
    }
    if OUTSIDERS.contains(&module) {
        // The item: the first name in capitals, or a function at the end.
        let item = used.iter().find(|name| name.starts_with(char::is_uppercase)).or(used.last());
        return TOOLS.contains(&used[0].as_str())
            || public.contains(&used[0])
            || item.is_some_and(|item| public.contains(item));
    }
    let rule = LAYERS.iter().find(|(modules, _)| modules.split(' ').any(|name| name == module));
    rule.is_none_or(|(_, allowed)| allowed.split_whitespace().any(|prefix| is_within(used, prefix)))
}

fn is_within(path: &[String], prefix: &str) -> bool {
    let prefix: Vec<&str> = prefix.split("::").collect();
    path.len() >= prefix.len() && path.iter().zip(prefix).all(|(a, b)| a == b)
}

/// Functions that change a world and are recorded under another name, or that change no result.
const RECORDED_OTHERWISE: &[&str] = &[
    "divide",
    "divide_along",
    "fuse",
    "set_obstacle_pose",
    "set_obstacle_shape",
    "set_obstacle_enabled",
    "set_instruction_set",
    "record_changes",
];

#[test]
fn a_replay_repeats_every_change_from_outside() {
    let sources = of_the_core();
    let change = sources.iter().find(|source| source.path == Path::new("world/change.rs")).unwrap();
    let mut seen = 0;
    for source in sources.iter().filter(|source| source.module() == "world") {
        for window in source.tokens.windows(7) {
            let text: Vec<&str> = window.iter().map(|token| token.text.as_str()).collect();
            let ["pub", "fn", name, "(", "&", "mut", "self"] = text[..] else { continue };
            let is_repeated = !change.lines_with(&format!("world.{name}")).is_empty();
            assert!(is_repeated || RECORDED_OTHERWISE.contains(&name), "`World::{name}` is not in world/change.rs");
            seen += 1;
        }
    }
    assert!(seen > 30, "{seen}");
}
