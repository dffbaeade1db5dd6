//! The names of all public items, so that none comes, goes or changes unnoticed.
//!
//! `UPDATE_GOLDEN=1 cargo test -p microsim-core --test public_api` writes them; a name that is gone is a breaking change and has a
//! line in the changelog. That what is `pub` can be reached from outside is held by the lint `unreachable_pub`.

#[allow(dead_code, reason = "the tests of layers use all of it")]
#[path = "common/sources.rs"]
mod sources;

use sources::{Source, sources};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const ITEMS: &[&str] = &["fn", "struct", "enum", "trait", "const", "type", "mod"];

#[test]
fn public_items_are_those_that_are_listed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let items: BTreeSet<String> = sources(&folder.join("src")).iter().flat_map(public_items).collect();
    let now: String = items.iter().map(|item| format!("{item}\n")).collect();
    let file = folder.join("tests/golden/public_api.txt");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, &now).unwrap();
    }
    let listed = fs::read_to_string(&file).unwrap_or_default();
    let listed: BTreeSet<String> = listed.lines().map(str::to_owned).collect();
    let (new, gone): (Vec<_>, Vec<_>) = (items.difference(&listed).collect(), listed.difference(&items).collect());
    assert!(
        new.is_empty() && gone.is_empty(),
        "new: {new:#?}, gone: {gone:#?}: if that is meant, see the head of this file"
    );
    assert!(items.contains("world/joint: fn add_joint") && items.contains("joint: pub break_force"));
}

/// The items and fields of a file that are `pub` without a limit, each with its module.
fn public_items(source: &Source) -> Vec<String> {
    let module = if source.module() == "lib" { "lib".to_owned() } else { source.own_path().join("/") };
    let text = |at: usize| source.tokens.get(at).map_or("", |token| token.text.as_str());
    let item = |at: usize| match text(at + 1) {
        "(" | "use" => None,
        "const" | "unsafe" if text(at + 2) == "fn" => Some(format!("{module}: fn {}", text(at + 3))),
        kind if ITEMS.contains(&kind) => Some(format!("{module}: {kind} {}", text(at + 2))),
        field => Some(format!("{module}: pub {field}")),
    };
    (0..source.tokens.len()).filter(|&at| text(at) == "pub").filter_map(item).collect()
}
