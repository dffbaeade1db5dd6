//! `render`: stills, sheets and movies, and what is refused.

mod common;

use common::{Folder, microsim, run, stderr, success};
use std::fs::File;

const SMALL: [&str; 4] = ["--size", "64x36", "--view", "25,30,30"];

/// Renders the test's scenario with further options into a file; returns the file.
fn render(folder: &Folder, name: &str, options: &[&str]) -> String {
    let (scenario, output) = (folder.crowd(), folder.path(name));
    let arguments = [&["render", &scenario, "-o", &output][..], &SMALL, options].concat();
    let result = success(&arguments);
    assert!(result.stdout.is_empty() && stderr(&result).contains("wrote"));
    output
}

/// Width, height and number of frames of a PNG.
fn measures(path: &str) -> (u32, u32, u32) {
    let decoder = png::Decoder::new(std::io::BufReader::new(File::open(path).unwrap()));
    let reader = decoder.read_info().unwrap();
    let info = reader.info();
    (info.width, info.height, info.animation_control.map_or(1, |control| control.num_frames))
}

#[test]
fn stills_do_not_depend_on_threads_and_change_with_time_and_optics() {
    let folder = Folder::new("stills");
    let picture = |name: &str, options: &[&str]| std::fs::read(render(&folder, name, options)).unwrap();
    let first = picture("a.png", &["--at", "0.2", "--threads", "1"]);
    assert_eq!(measures(&folder.path("a.png")), (64, 36, 1));
    assert_eq!(first, picture("b.png", &["--at", "0.2", "--threads", "3"]));
    assert_ne!(first, picture("c.png", &["--at", "0.4"]));
    assert_ne!(first, picture("d.png", &["--at", "0.2", "--optics", "stained"]));
    assert_ne!(first, picture("e.png", &["--at", "0.2", "--film", "digital"]));
}

#[test]
fn commands_of_the_scenario_are_carried_out() {
    let folder = Folder::new("commands");
    let scenario = "schema = 1\n[world]\nsize = [50.0, 60.0]\n[amoeboid_cell.c]\nradii = [8, 8]\n\
                    [[spawn]]\nof = 'c'\nname = 'cell'\nat = [25, 30]\n";
    let picture = |name: &str, more: &str| {
        let (file, output) = (folder.file(name, format!("{scenario}{more}").as_bytes()), folder.path("a.png"));
        success(&[&["render", &file, "-o", &output, "--at", "1"][..], &SMALL].concat());
        std::fs::read(output).unwrap()
    };
    let told = "[[command]]\nof = 'cell'\ngoal = [1000, 30]\n";
    assert_ne!(picture("told.toml", told), picture("untold.toml", ""));
}

#[test]
fn several_moments_or_optics_make_a_sheet() {
    let folder = Folder::new("sheets");
    assert_eq!(measures(&render(&folder, "modes.png", &["--at", "0", "--optics", "all"])), (128, 144, 1));
    let options = ["--from", "0", "--to", "0.5", "--fps", "10", "--columns", "3"];
    assert_eq!(measures(&render(&folder, "moments.png", &options)), (192, 72, 1));
}

#[test]
fn movies_have_all_their_frames() {
    let folder = Folder::new("movies");
    let options = ["--from", "0.1", "--to", "0.4", "--fps", "10"];
    assert_eq!(measures(&render(&folder, "a.apng", &options)), (64, 36, 4));
    for optics in ["dic", "stained"] {
        let path = render(&folder, "a.gif", &[&options[..], &["--optics", optics]].concat());
        let mut decoder = gif::DecodeOptions::new().read_info(File::open(path).unwrap()).unwrap();
        let mut delays = 0;
        let mut frames = 0;
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            delays += frame.delay;
            frames += 1;
        }
        assert_eq!((frames, delays), (4, 40), "hundredths of a second");
    }
}

#[cfg(unix)]
#[test]
fn an_mp4_is_made_by_ffmpeg_or_refused_without_it() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("mp4");
    let (scenario, output) = (folder.crowd(), folder.path("a.mp4"));
    let options = ["--from", "0", "--to", "0.2", "--fps", "10"];
    let arguments = [&["render", &scenario, "-o", &output][..], &SMALL, &options].concat();
    let without = microsim(&arguments).env("PATH", folder.root()).output().unwrap();
    assert_eq!(without.status.code(), Some(2));
    assert!(stderr(&without).contains("ffmpeg") && stderr(&without).contains(".gif"), "{}", stderr(&without));
    assert!(!std::path::Path::new(&output).exists());
    // A stand-in that writes the raw frames into the file that it is told to write.
    let stand_in = folder.file("ffmpeg", b"#!/bin/sh\nfor last; do :; done\nexec /bin/cat > \"$last\"\n");
    std::fs::set_permissions(&stand_in, std::fs::Permissions::from_mode(0o755)).unwrap();
    let with = microsim(&arguments).env("PATH", folder.root()).output().unwrap();
    assert!(with.status.success(), "{}", stderr(&with));
    assert_eq!(std::fs::metadata(&output).unwrap().len(), 3 * 64 * 36 * 3);
    std::fs::write(&stand_in, b"#!/bin/sh\nexit 3\n").unwrap();
    let failing = microsim(&arguments).env("PATH", folder.root()).output().unwrap();
    assert!(failing.status.code() == Some(2) && stderr(&failing).contains("ffmpeg failed"), "{}", stderr(&failing));
}

#[test]
fn a_view_follows_an_organism_by_name_or_index() {
    let folder = Folder::new("follow");
    let output = folder.path("a.png");
    for target in ["follow:hunter", "follow:player,20", "follow:0"] {
        success(&["render", "hunt", "--at", "0", "--size", "48x27", "--view", target, "-o", &output]);
    }
}

#[test]
fn what_cannot_be_rendered_is_refused_and_nothing_is_written() {
    let folder = Folder::new("refused");
    let (still, movie) = (folder.path("a.png"), folder.path("a.gif"));
    let cases: [(&[&str], &str, &str); 9] = [
        (&["--size", "0x10"], &still, "pixels[0]"),
        (&["--size", "16384x16384"], &still, "at most 67108864"),
        (&["--size", "big"], &still, "1280x720"),
        (&["--view", "1,2,0"], &still, "width"),
        (&["--view", "follow:nobody"], &still, "hunter"),
        (&["--optics", "x-ray"], &still, "phase-contrast"),
        (&["--from", "3", "--to", "1"], &movie, "--to at or after --from"),
        (&["--optics", "all", "--from", "0", "--to", "0.1"], &movie, "one kind of optics"),
        (&["--at", "0"], &folder.path("a.mov"), ".mp4"),
    ];
    for (options, output, words) in cases {
        let result = run(&[&["render", "hunt", "-o", output][..], options].concat());
        let text = stderr(&result);
        assert_eq!(result.status.code(), Some(2), "{options:?}: {text}");
        assert!(text.contains(words), "{options:?}: {text}");
    }
    assert_eq!(std::fs::read_dir(folder.root()).unwrap().count(), 0);
}

#[test]
fn a_replay_is_rendered_as_the_run_that_it_records() {
    let folder = Folder::new("render-replay");
    let scenario = folder.crowd();
    let record = folder.path("crowd.replay");
    success(&["run", &scenario, "--steps", "30", "--record", &record]);
    let shoot = |from: &str, name: &str, more: &[&str]| {
        let path = folder.path(name);
        let output = run(&[&["render", from, "--size", "64x36", "-o", &path], more].concat());
        (output.status.code(), stderr(&output), std::fs::read(&path).unwrap_or_default())
    };
    let (of_scenario, of_replay) =
        (shoot(&scenario, "scenario.png", &["--at", "0.5"]), shoot(&record, "replay.png", &[]));
    assert!(of_scenario.0 == Some(0) && of_scenario.2 == of_replay.2, "{} {}", of_scenario.1, of_replay.1);
    let (code, text, _) = shoot(&record, "late.png", &["--at", "9"]);
    assert!(code != Some(0) && text.contains("the record ends at 0.50 s"), "{text}");
    let (code, text, _) = shoot(&record, "other.png", &["--seed", "3"]);
    assert!(code == Some(2) && text.contains("accepted"), "{text}");
}
