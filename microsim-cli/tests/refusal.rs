//! Scenarios that are wrong: each is refused with its file, line, field and what would be accepted, and nothing is written.

mod common;

use common::{Folder, run, stderr};

/// A file, the line and the field that are wrong, and words of what would be accepted.
struct Bad {
    name: &'static str,
    text: &'static [u8],
    line: usize,
    field: &'static str,
    accepted: &'static str,
}

const BAD: [Bad; 14] = [
    Bad {
        name: "missing-field",
        text: b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nat = [10.0, 10.0]\n",
        line: 6,
        field: "spawn.0.of",
        accepted: "accepted: ",
    },
    Bad {
        name: "wrong-type",
        text: b"schema = 1\n[step]\nsubsteps = \"many\"\n",
        line: 3,
        field: "step.substeps",
        accepted: "accepted: a whole number",
    },
    Bad {
        name: "unknown-key",
        text: b"schema = 1\n[step]\nsubstep = 8\n",
        line: 3,
        field: "step.substep",
        accepted: "substeps",
    },
    Bad {
        name: "not-a-number",
        text: b"schema = 1\n[world]\nsize = [50.0, 50.0]\ndamping = nan\n",
        line: 4,
        field: "world.damping",
        accepted: "0 to 100",
    },
    Bad {
        name: "negative-radius",
        text: b"schema = 1\n[agar.a]\nradius = -1.0\n[world]\nsize = [50.0, 50.0]\n",
        line: 3,
        field: "agar.a.radius",
        accepted: "0.1 to 20",
    },
    Bad {
        name: "overlap",
        text: b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nof = \"a\"\nat = [10.0, 10.0]\n\
[[spawn]]\nof = \"a\"\nat = [10.5, 10.0]\n",
        line: 11,
        field: "spawn.1.at",
        accepted: "a place where nothing overlaps",
    },
    Bad {
        name: "outside",
        text: b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nof = \"a\"\nat = [60.0, 10.0]\n",
        line: 8,
        field: "spawn.0.at",
        accepted: "accepted: ",
    },
    Bad {
        name: "a-billion",
        text: b"schema = 1\n[world]\nsize = [50.0, 50.0]\n[agar.a]\nradius = 1.0\n[[spawn]]\nof = \"a\"\ncount = 1000000000\n",
        line: 8,
        field: "spawn.0.count",
        accepted: "at most",
    },
    Bad { name: "empty", text: b"", line: 1, field: "schema", accepted: "accepted: " },
    Bad {
        name: "garbage",
        text: b"\x00\x9f\x92\x96\xff\xfe\x00\x01",
        line: 1,
        field: "byte 1",
        accepted: "accepted: ",
    },
    Bad { name: "not-toml", text: b"schema = 1\nthis is no TOML\n", line: 2, field: "", accepted: "" },
    Bad { name: "zeroes", text: &[0; 4096], line: 1, field: "", accepted: "" },
    Bad {
        name: "infinite",
        text: b"schema = 1\n[world]\nsize = [inf, 50.0]\n",
        line: 3,
        field: "world.size",
        accepted: " to ",
    },
    Bad {
        name: "another-schema",
        text: b"schema = 2\n[world]\nsize = [50.0, 50.0]\n",
        line: 1,
        field: "schema",
        accepted: "accepted: 1",
    },
];

#[test]
fn bad_scenarios_are_refused_with_their_place() {
    let folder = Folder::new("bad");
    let out = folder.path("out");
    for bad in BAD {
        let file = folder.file(&format!("{}.toml", bad.name), bad.text);
        for verb in [&["check", &file][..], &["run", &file, "--steps", "1", "--out", &out, "--force"]] {
            let output = run(verb);
            let text = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{}: {text}", bad.name);
            assert!(output.stdout.is_empty(), "{}", bad.name);
            assert!(text.contains(&format!("{file}:{}", bad.line)), "{} line {}: {text}", bad.name, bad.line);
            assert!(text.contains(bad.field), "{} {}: {text}", bad.name, bad.field);
            assert!(text.contains(bad.accepted), "{} {}: {text}", bad.name, bad.accepted);
        }
        assert!(!folder.root().join("out").exists(), "{}", bad.name);
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
