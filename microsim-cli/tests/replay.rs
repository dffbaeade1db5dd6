//! `run --record`, `run --save`, `replay` and `diff`, as a user meets them.

mod common;

use common::{Folder, crowd, json, refused, run, stderr, stdout, success};
use microsim_core::replay::Recorder;
use microsim_core::scenario::Scenario;
use microsim_core::{Inputs, World};
use std::fs;
use std::num::NonZeroU32;

/// A run of the crowd: its record and its checkpoint.
fn keep(folder: &Folder, name: &str, more: &[&str]) -> (String, String) {
    let scenario = folder.crowd();
    let (record, saved) = (folder.path(&format!("{name}.replay")), folder.path(&format!("{name}.run")));
    let mut arguments =
        vec!["run", &scenario, "--steps", "30", "--record", &record, "--save", &saved, "--digest-every", "10"];
    arguments.extend(more);
    success(&arguments);
    (record, saved)
}

#[test]
fn a_record_is_played_and_found_right() {
    let folder = Folder::new("replay-right");
    let (record, saved) = keep(&folder, "a", &[]);
    let report = json(&["replay", &record, "--json"]);
    assert_eq!((report["steps"].as_u64(), report["is_complete"].as_bool()), (Some(30), Some(true)));
    assert_eq!(report["scenario"], "crowd-of-the-test");
    let output = run(&["replay", &record]);
    assert!(stdout(&output).starts_with("30 steps (0.50 s) of crowd-of-the-test with seed 0 are as recorded\n"));
    let output = run(&["diff", &record, &saved]);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(0), "no difference in the world\n"));
}

#[test]
fn different_runs_are_reported_by_their_first_different_field() {
    let folder = Folder::new("replay-other");
    let (one, one_saved) = keep(&folder, "one", &[]);
    let (other, other_saved) = keep(&folder, "other", &["--set", "spawn.2.at=[60.0, 10.5]"]);
    for (a, b, step) in [(&one, &other, 0), (&one_saved, &other_saved, 30), (&one, &other_saved, 30)] {
        let output = run(&["diff", a, b]);
        let found = stdout(&output);
        assert_eq!(output.status.code(), Some(1), "{found}");
        assert!(found.starts_with(&format!("step {step}: particle ")), "{found}");
        assert!(found.contains(", agar) ") && found.contains(" against "), "{found}");
    }
}

/// A record of a crowd whose world was replaced after 12 steps by one without an organism, which a replay cannot repeat.
fn wrong(folder: &Folder, name: &str) -> String {
    let scenario = Scenario::parse(&crowd(), &[]).unwrap();
    let mut built = scenario.build().unwrap();
    let (mut recorder, mut bytes) = Recorder::new(scenario.origin(), NonZeroU32::new(10).unwrap());
    for step in 0..30 {
        built.step(&Inputs::new());
        if step == 12 {
            let first = built.world.organisms().next().unwrap();
            built.world.remove(first).unwrap();
            built.world = World::from_snapshot(&built.world.to_snapshot().unwrap()).unwrap();
        }
        bytes.extend(recorder.step(&Inputs::new(), &built.world));
    }
    bytes.extend(recorder.finish(&built.world));
    folder.file(name, &bytes)
}

#[test]
fn a_replay_that_differs_from_its_record_is_reported() {
    let folder = Folder::new("replay-wrong");
    let record = wrong(&folder, "wrong.replay");
    let output = run(&["replay", &record]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains(" after step 20, recorded: "), "{}", stderr(&output));
}

#[test]
fn equal_runs_that_are_not_the_recorded_ones_are_not_called_equal() {
    let folder = Folder::new("diff-wrong");
    let (right, saved) = keep(&folder, "right", &[]);
    let [one, other] = ["one.replay", "other.replay"].map(|name| wrong(&folder, name));
    let as_played = "no difference, as played now\n";
    let in_the_world = "no difference in the world, as played now\n";
    let cases = [
        ([&one, &other], as_played, vec![&one, &other]),
        ([&one, &right], as_played, vec![&one]),
        ([&right, &other], as_played, vec![&other]),
        ([&one, &saved], in_the_world, vec![&one]),
    ];
    for ([a, b], found, deviating) in cases {
        let output = run(&["diff", a, b]);
        assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(1), found), "{a} {b}");
        let told = stderr(&output);
        assert_eq!(told.lines().count(), deviating.len(), "{told}");
        for (line, path) in told.lines().zip(deviating) {
            assert!(line.starts_with(&format!("{path}: digest ")), "{told}");
            assert!(line.contains(" after step 20, recorded: "), "{told}");
        }
    }
    let output = run(&["diff", &right, &right]);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(0), "no difference\n"));
}

/// A checkpoint of the end of a run of the crowd and one more swimmer; `more` is appended to the scenario.
fn saved_with(folder: &Folder, name: &str, more: &str) -> String {
    let text = crowd() + "[[spawn]]\nof = \"swimmer\"\nat = [12.0, 8.0]\n" + more;
    let scenario = folder.file(&format!("{name}.toml"), text.as_bytes());
    let saved = folder.path(&format!("{name}.run"));
    success(&["run", &scenario, "--steps", "30", "--save", &saved]);
    saved
}

#[test]
fn checkpoints_of_equal_worlds_may_differ_in_what_goes_with_them() {
    let folder = Folder::new("diff-checkpoints");
    let named = "name = \"diver\"\n";
    let plain = saved_with(&folder, "plain", "");
    let cases = [
        ("player", "", "player = true\n"),
        ("names", "", named),
        ("script", named, "[[command]]\nof = \"diver\"\nat = 9.0\nrest = true\n"),
        ("script", "", "[[spawn]]\nof = \"food\"\nfrom = 9.0\n"),
        ("checks", "", "[invariants]\norganisms = 5\n"),
    ];
    for (index, (part, both, one)) in cases.into_iter().enumerate() {
        let without = saved_with(&folder, &format!("{index}-without"), both);
        let with = saved_with(&folder, &format!("{index}-with"), &format!("{both}{one}"));
        let output = run(&["diff", &without, &with]);
        let expected = format!("step 30: not the same {part}\n");
        assert_eq!((output.status.code(), stdout(&output)), (Some(1), expected), "{one}");
    }
    let commented = saved_with(&folder, "commented", "# nothing");
    let output = run(&["diff", &plain, &commented]);
    let expected = "no difference in world, player, names, script and checks\n";
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(0), expected));
}

#[test]
fn a_damaged_record_is_played_as_far_as_it_goes_and_refused() {
    let folder = Folder::new("replay-damaged");
    let (record, _) = keep(&folder, "a", &[]);
    let mut bytes = fs::read(&record).unwrap();
    let at = bytes.len() - 15;
    bytes[at] ^= 1;
    let damaged = folder.file("damaged.replay", &bytes);
    let output = refused(&["replay", &damaged], "damaged at byte");
    assert!(stdout(&output).starts_with("20 steps "), "{}", stdout(&output));
    // The difference is the answer, and the damage may be why.
    for (one, other, which) in [(&record, &damaged, "second"), (&damaged, &record, "first")] {
        let output = run(&["diff", one, other]);
        let found = format!("step 20: the {which} replay ends\n");
        assert_eq!((output.status.code(), stdout(&output)), (Some(1), found));
        assert!(stderr(&output).contains("damaged at byte"), "{}", stderr(&output));
    }

    let mut bytes = fs::read(&record).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    let damaged = folder.file("damaged-end.replay", &bytes);
    let output = run(&["diff", &record, &damaged]);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), "no difference\n"));
    assert!(stderr(&output).contains("damaged at byte"), "{}", stderr(&output));
}

#[test]
fn files_that_would_take_the_place_of_something_are_refused() {
    let folder = Folder::new("replay-places");
    let (one, out) = (folder.path("one"), folder.path("out"));
    let inside = format!("{out}/run.json");
    let mut cases = vec![
        (vec!["--record", &one, "--save", &one], "--record and --save are both"),
        (vec!["--out", &out, "--record", &inside], "is in the folder of --out"),
        (vec!["--out", &out, "--save", &inside], "is in the folder of --out"),
        // Resuming would leave them out.
        (vec!["--out", &out, "--checkpoint-every", "5", "--save", &one], "do not go with output.checkpoint_every"),
        (vec!["--out", &out, "--set", "output.checkpoint_every=5", "--record", &one], "do not go with"),
    ];
    let socket = folder.path("socket");
    #[cfg(unix)]
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    #[cfg(unix)]
    cases.extend([(vec!["--save", &socket], "not a regular file"), (vec!["--record", &socket], "not a regular file")]);
    let links = [("/dev/stdout", folder.path("to a device")), ("file", folder.path("to a file"))];
    #[cfg(unix)]
    for (target, link) in &links {
        std::os::unix::fs::symlink(target, link).unwrap();
        cases.extend([(vec!["--save", link], "not a regular file"), (vec!["--record", link], "not a regular file")]);
    }
    for (options, problem) in cases {
        refused(&[&["run", "empty", "--steps", "2"], &options[..]].concat(), problem);
    }
    assert!(!std::path::Path::new(&one).exists());
    // What cannot be written is known before anything is replaced.
    #[cfg(target_os = "linux")]
    for option in ["--record", "--save"] {
        refused(&["run", "empty", "--steps", "2", "--out", &out, option, "/proc/end"], "cannot write");
        assert!(!std::path::Path::new(&out).exists(), "{option}");
    }
}

#[test]
fn a_record_that_is_cut_off_is_played_as_far_as_it_goes() {
    let folder = Folder::new("replay-cut");
    let (record, saved) = keep(&folder, "a", &[]);
    let bytes = fs::read(&record).unwrap();
    let cut = folder.file("cut.replay", &bytes[..bytes.len() - 15]);
    let output = success(&["replay", &cut]);
    assert!(stdout(&output).starts_with("20 steps "), "{}", stdout(&output));
    assert!(stderr(&output).contains("cut off"), "{}", stderr(&output));
    let output = run(&["diff", &record, &cut]);
    assert_eq!(output.status.code(), Some(1), "it is shorter");
    let with_end = run(&["diff", &cut, &saved]);
    assert_eq!((with_end.status.code(), stdout(&with_end).as_str()), (Some(1), "step 20: the replay ends\n"));
    assert!(stderr(&output).contains("cut.replay: cut off"), "{}", stderr(&output));
}

#[test]
fn files_of_other_kinds_are_refused() {
    let folder = Folder::new("replay-none");
    let (record, saved) = keep(&folder, "a", &[]);
    let text = folder.file("text", b"no such thing");
    let mut newer = fs::read(&saved).unwrap();
    newer[8] += 1;
    let newer = folder.file("newer.run", &newer);
    let cases = [
        (vec!["replay", &text], "not a replay"),
        (vec!["replay", &saved], "not a replay"),
        (vec!["replay", "nowhere"], "cannot read nowhere"),
        (vec!["diff", &record, &text], "not a file of microsim"),
        (vec!["diff", &newer, &saved], "version"),
        (vec!["run", "empty", "--steps", "1", "--record", "nowhere/else/x/"], "nowhere/else/x"),
    ];
    for (arguments, message) in cases {
        refused(&arguments, message);
    }
    let _ = fs::remove_dir_all("nowhere");
}

#[test]
fn every_reader_of_a_damaged_record_says_so_and_fails() {
    let folder = Folder::new("replay-damaged-readers");
    let record = folder.path("a.replay");
    success(&["run", &folder.crowd(), "--steps", "30", "--record", &record, "--digest-every", "5"]);
    let mut bytes = std::fs::read(&record).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    let damaged = folder.file("damaged.replay", &bytes);
    refused(&["inspect", &damaged], "damaged at byte");
    refused(&["render", &damaged, "--size", "16x16", "-o", &folder.path("a.png")], "damaged at byte");
}
