//! No files and no folders of the program use each other in a circle.

#[path = "../../microsim-core/tests/common/sources.rs"]
#[allow(dead_code, reason = "the core's tests use all of it")]
mod sources;

use std::path::Path;

#[test]
fn no_files_and_no_folders_use_each_other_in_a_circle() {
    let sources = sources::sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
    let found = sources::circles(&sources);
    assert!(found.is_empty(), "circles: {found:#?}");
    let found = sources::circles_of_modules(&sources);
    assert!(found.is_empty(), "circles of modules: {found:#?}");
}

/// Else the tests that let each of them fail once would miss some.
#[test]
fn all_calls_that_change_files_are_in_one_file() {
    let calls: [&[&str]; 7] = [
        &["fs", "::", "write"],
        &["fs", "::", "rename"],
        &["fs", "::", "remove"],
        &["fs", "::", "create"],
        &["fs", "::", "copy"],
        &["File", "::", "create"],
        &["OpenOptions"],
    ];
    // The first is for tests.
    assert_eq!(files_that_call(&calls), ["hostile.rs", "output/files.rs"]);
}

/// Else names could control a terminal.
#[test]
fn all_json_is_written_in_one_file() {
    let calls: [&[&str]; 2] = [&["serde_json", "::", "to_"], &["serde_json", "::", "Serializer"]];
    // The first is for tests, the last for programs.
    assert_eq!(files_that_call(&calls), ["hostile.rs", "json.rs", "verbs/serve/helper.rs"]);
}

/// Files in which any of these words, the last of which may go on, follow each other.
fn files_that_call(calls: &[&[&str]]) -> Vec<String> {
    let mut found = std::collections::BTreeSet::new();
    for source in sources::sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")) {
        let words: Vec<&str> = source.tokens.iter().map(|token| token.text.as_str()).collect();
        let is_at = |at: usize, call: &[&str]| {
            call.iter().enumerate().all(|(k, word)| {
                words.get(at + k).is_some_and(|found| found == word || k + 1 == call.len() && found.starts_with(word))
            })
        };
        if (0..words.len()).any(|at| calls.iter().any(|call| is_at(at, call))) {
            found.insert(source.path.display().to_string());
        }
    }
    found.into_iter().collect()
}
