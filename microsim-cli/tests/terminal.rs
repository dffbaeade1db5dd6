//! Names from files control no terminal, forge no line and are no formula in a table.

mod common;

use common::{Folder, read_json, refused, run, stderr, stdout, success};
use std::fs;

/// A name that clears the screen, forges a line and turns the direction of writing.
const NAME: &str = r"x\u001B[2J\nok: forged\u202E\u009B";
const HARMFUL: [char; 3] = ['\u{1b}', '\u{202e}', '\u{9b}'];

fn check(text: &str) {
    assert!(!text.contains(HARMFUL) && !text.contains("\nok: forged"), "{text:?}");
}

#[test]
fn a_name_is_printed_without_what_controls_a_terminal() {
    let folder = Folder::new("terminal");
    let text = format!("schema = 1\nname = \"{NAME}\"\nduration = 0.05\n[world]\nsize = [80.0, 60.0]\n");
    let scenario = folder.file("name.toml", text.as_bytes());
    let replay = folder.path("a.replay");
    for arguments in [
        &["check", &scenario][..],
        &["run", &scenario, "--record", &replay],
        &["run", &scenario, "--dry-run"],
        &["replay", &replay],
        &["inspect", &replay],
        &["bench", &scenario, "--steps", "1"],
    ] {
        let output = run(arguments);
        assert!(output.status.success() && !output.stdout.is_empty(), "{arguments:?}: {}", stderr(&output));
        check(&stdout(&output));
        check(&stderr(&output));
    }
    let broken = text.replace("[world]", "[invariants]\nbodies = [5, 9]\n[world]");
    let output = run(&["run", &folder.file("broken.toml", broken.as_bytes())]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    check(&stderr(&output));
}

#[test]
fn a_refusal_is_printed_without_what_controls_a_terminal() {
    let folder = Folder::new("terminal-refusal");
    let text = format!(
        "schema = 1\n[world]\nsize = [80.0, 60.0]\n[agar.\"{NAME}\"]\nradius = 1.0\n[[spawn]]\nof = \"other\"\n"
    );
    let output = refused(&["check", &folder.file("a.toml", text.as_bytes())], "other");
    check(&stderr(&output));
    check(&stderr(&refused(&["check", "./no\u{1b}[2J\nok: forged.toml"], "u{1b}")));
}

#[test]
fn json_has_no_character_that_controls_a_terminal() {
    let folder = Folder::new("terminal-json");
    let name = "x\u{9b}2J\u{202e}";
    let text = r#"schema = 1
        name = "x\u009B2J\u202E"
        duration = 0.05
        [world]
        size = [80.0, 60.0]
    "#;
    let scenario = folder.file("name.toml", text.as_bytes());
    let [out, replay, store, table] = ["out", "a.replay", "store", "table.jsonl"].map(|name| folder.path(name));
    let is_clean = |text: &str| assert!(text.contains(r"x\u009b2J\u202e") && !text.contains(HARMFUL), "{text:?}");
    let told = |arguments: &[&str]| stdout(&success(arguments));
    is_clean(&told(&["run", &scenario, "--out", &out, "--record", &replay, "--json"]));
    is_clean(&told(&["check", &scenario, "--format", "json"]));
    is_clean(&told(&["replay", &replay, "--json"]));
    let plan = told(&["sweep", "plan", &scenario]);
    is_clean(&plan);
    let plan = folder.file("plan.jsonl", plan.as_bytes());
    success(&["sweep", "run", &plan, "--store", &store]);
    success(&["sweep", "merge", &plan, "--store", &store, "-o", &table]);
    is_clean(&fs::read_to_string(table).unwrap());
    fs::read_dir(store).unwrap().for_each(|file| is_clean(&fs::read_to_string(file.unwrap().path()).unwrap()));
    is_clean(&fs::read_to_string(format!("{out}/run.json")).unwrap());
    assert_eq!(read_json(format!("{out}/run.json"))["scenario"], name);
    let wrong = folder.file("wrong.toml", text.replace("duration", "\"x\\u009B2J\\u202E\"").as_bytes());
    let refused = run(&["check", &wrong, "--format", "json"]);
    assert_eq!(refused.status.code(), Some(2));
    is_clean(&stdout(&refused));
}

#[test]
fn a_line_of_a_scenario_is_shown_without_what_controls_a_terminal() {
    let folder = Folder::new("terminal-source");
    let text = "schema = 1\n[world]\nsize = \"a\u{9b}2J\u{1b}[2J\u{202e}\u{200b}\"\n";
    let scenario = folder.file("a.toml", text.as_bytes());
    for colour in ["never", "always"] {
        let said = stderr(&refused(&["check", &scenario, "--color", colour], "size = "));
        assert!(!said.contains(['\u{9b}', '\u{202e}', '\u{200b}']) && !said.contains("\u{1b}[2J"), "{said:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_name_of_a_file_forges_no_line() {
    let folder = Folder::new("forged");
    fs::create_dir(folder.path("d\nok: forged")).unwrap();
    let here = folder.path("d\nok: forged");
    let file = folder.file("d\nok: forged/n.toml", b"no scenario");
    let view = "follow:a\nok: forged";
    for arguments in [
        &["inspect", &file][..],
        &["replay", &file],
        &["resume", &here],
        &["check", &here],
        &["run", "empty", "--out", &file],
        &["run", "empty", "--record", &here],
        &["sweep", "run", &file, "--store", &folder.path("store")],
        &["sweep", "merge", &file, "--store", &here, "-o", &file],
        &["report", &here, "-o", &folder.path("a.html")],
        &["render", "empty", "-o", &file],
        &["render", "empty", "-o", &folder.path("a.png"), "--view", view],
    ] {
        let said = stderr(&refused(arguments, "forged"));
        assert!(!said.lines().any(|line| line.starts_with("ok: forged")), "{arguments:?}: {said}");
    }
    let said = stderr(&success(&["render", "empty", "--size", "16x16", "-o", &format!("{here}/a.png")]));
    assert!(said.contains("forged") && said.lines().count() == 1, "{said}");
}

#[test]
fn an_argument_is_quoted_without_what_controls_a_terminal() {
    // Sequences of one byte (C1) and of two, the clipboard (OSC 52), a forged line, a name that runs backwards.
    let name = "a\u{9d}0;t\u{9c}\u{1b}]52;c;eA==\u{7}\r\nok: forged\u{2067}b\u{200b}";
    for arguments in [
        &[name][..],
        &["list", name],
        &["completions", name],
        &["check", "empty", name],
        &["run", "empty", "--steps", name],
        &["render", "empty", "--at", name, "-o", "a.png"],
        &["run", name],
        &["inspect", name],
        &["man", name],
    ] {
        let output = refused(arguments, "u{9d}");
        let said = stderr(&output);
        assert!(
            !said.contains(|c: char| c != '\n' && c.is_control() || matches!(c, '\u{2067}' | '\u{200b}')),
            "{said:?}"
        );
        assert!(!said.lines().any(|line| line.starts_with("ok: forged")), "{said:?}");
    }
}

#[test]
fn no_cell_of_a_merged_table_is_a_formula() {
    let folder = Folder::new("formula");
    let scenario =
        folder.file("a.toml", b"schema = 1\nname = \"=cmd\"\nduration = 0.05\n[world]\nsize = [80.0, 60.0]\n");
    let plan = success(&["sweep", "plan", &scenario, "--grid", "world.damping=0.5,1"]);
    let (plan, store, table) = (folder.file("p.jsonl", &plan.stdout), folder.path("s"), folder.path("t.csv"));
    success(&["sweep", "run", &plan, "--store", &store]);
    success(&["sweep", "merge", &plan, "--store", &store, "-o", &table]);
    let text = fs::read_to_string(&table).unwrap();
    assert!(text.contains(",'=cmd,") && !text.contains(",=cmd"), "{text}");
}
