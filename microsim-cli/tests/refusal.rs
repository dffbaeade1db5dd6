//! Scenarios that are wrong: each is refused with its file, line, field and what would be accepted, and nothing is written.

mod common;

use common::{Folder, run, stderr};

/// A file, its text, the line and the field that are wrong, and words of what would be accepted.
type Bad = (&'static str, &'static [u8], usize, &'static str, &'static str);

const BAD: [Bad; 14] = [
    ("missing-field", b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nat = [10.0, 10.0]\n", 6, "spawn.0.of", "accepted: "),
    ("wrong-type", b"schema = 1\n[step]\nsubsteps = \"many\"\n", 3, "step.substeps", "accepted: a whole number"),
    ("unknown-key", b"schema = 1\n[step]\nsubstep = 8\n", 3, "step.substep", "substeps"),
    ("not-a-number", b"schema = 1\n[world]\nsize = [50.0, 50.0]\ndamping = nan\n", 4, "world.damping", "0 to 100"),
    ("negative-radius", b"schema = 1\n[agar.a]\nradius = -1.0\n[world]\nsize = [50.0, 50.0]\n", 3, "agar.a.radius", "0.1 to 20"),
    ("overlap", b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nof = \"a\"\nat = [10.0, 10.0]\n\
[[spawn]]\nof = \"a\"\nat = [10.5, 10.0]\n", 11, "spawn.1.at", "a place where nothing overlaps"),
    ("outside", b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nof = \"a\"\nat = [60.0, 10.0]\n", 8, "spawn.0.at", "accepted: "),
    ("a-billion", b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nof = \"a\"\ncount = 1000000000\n", 8, "spawn.0.count", "at most"),
    ("empty", b"", 1, "schema", "accepted: "),
    ("garbage", b"\x00\x9f\x92\x96\xff\xfe\x00\x01", 1, "byte 1", "accepted: "),
    ("not-toml", b"schema = 1\nthis is no TOML\n", 2, "", ""),
    ("zeroes", &[0; 4096], 1, "", ""),
    ("infinite", b"schema = 1\n[world]\nsize = [inf, 50.0]\n", 3, "world.size", " to "),
    ("another-schema", b"schema = 2\n[world]\nsize = [50.0, 50.0]\n", 1, "schema", "accepted: 1"),
];

#[test]
fn bad_scenarios_are_refused_with_their_place() {
    let folder = Folder::new("bad");
    let out = folder.path("out");
    for (name, text, line, field, accepted) in BAD {
        let file = folder.file(&format!("{name}.toml"), text);
        for verb in [&["check", &file][..], &["run", &file, "--steps", "1", "--out", &out, "--force"]] {
            let output = run(verb);
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{name}: {said}");
            assert!(output.stdout.is_empty(), "{name}");
            assert!(said.contains(&format!("{file}:{line}")), "{name} line {line}: {said}");
            assert!(said.contains(field), "{name} {field}: {said}");
            assert!(said.contains(accepted), "{name} {accepted}: {said}");
        }
        assert!(!folder.root().join("out").exists(), "{name}");
    }
}

#[test]
fn all_problems_are_shown_at_once() {
    let folder = Folder::new("several");
    let text = b"schema = 1\n[step]\nsubsteps = 0\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 0.0\n";
    let file = folder.file("bad.toml", text);
    let text = stderr(&run(&["check", &file]));
    assert!(text.contains("step.substeps") && text.contains("agar.a.radius"), "{text}");
    assert!(text.contains("2 problems in"), "{text}");
}

#[test]
fn of_five_thousand_typos_twenty_are_shown_and_the_others_counted() {
    let folder = Folder::new("typos");
    let names: String = (0..5000).map(|k| format!("[agar.pellet{k}]\nradius = 1.0\n")).collect();
    let typos: String = (0..5000).map(|k| format!("[[spawn]]\nof = \"pelet{k}\"\n")).collect();
    let file = folder
        .file("typos.toml", &["schema = 1\n[world]\nsize = [50.0, 50.0]\n", &names, &typos].concat().into_bytes());
    let text = stderr(&run(&["check", &file]));
    assert!(text.len() < 50_000, "{} bytes", text.len());
    assert_eq!(text.matches("unknown prototype `").count(), 20);
    assert!(text.contains("\nand 4,980 more: unknown prototype\n") && text.contains("5000 problems in"), "{text}");
    let json: serde_json::Value = serde_json::from_slice(&run(&["check", &file, "--format", "json"]).stdout).unwrap();
    assert_eq!(json["left_out"][0]["count"], 4980);
}
