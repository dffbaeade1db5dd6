//! Sound that arrives at a real server; `.ci/sound` starts one.
#![cfg(target_os = "linux")]

#[path = "common/cues.rs"]
mod cues;

use cues::CUES;
use microsim_game::sound::{Cue, Mixer, RATE};
use std::fs::File;
use std::path::Path;
use std::process::Command;

/// The samples of a cue, from the first that is heard to the last.
fn samples_of(cue: Cue) -> Vec<f32> {
    let (mut mixer, mut samples) = (Mixer::default(), vec![0.0; 2 * RATE as usize]);
    mixer.play(cue, 1.0);
    mixer.fill(&mut samples);
    trimmed(&samples).to_vec()
}

fn is_heard(sample: &f32) -> bool {
    sample.abs() > 1e-3
}

fn trimmed(samples: &[f32]) -> &[f32] {
    let (first, last) = (samples.iter().position(is_heard), samples.iter().rposition(is_heard));
    first.zip(last).map_or(&[], |(first, last)| &samples[first..=last])
}

/// What the server plays while this program plays the cues, or the command that a variable names: the example for Windows, under Wine.
fn recorded() -> Vec<f32> {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("heard.raw");
    let arguments =
        ["--device=microsim.monitor", "--format=float32le", "--rate=48000", "--channels=1", "--latency-msec=20"];
    let mut recorder = Command::new("parec").args(arguments).stdout(File::create(&file).unwrap()).spawn().unwrap();
    match std::env::var("MICROSIM_CUES") {
        Ok(command) => assert!(Command::new("sh").args(["-c", &command]).status().unwrap().success()),
        Err(_) => cues::play(),
    }
    recorder.kill().unwrap();
    recorder.wait().unwrap();
    let bytes = std::fs::read(file).unwrap();
    bytes.as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect()
}

/// Says how what was heard differs from what was mixed.
fn compare(heard: &[f32]) -> Result<(), String> {
    let mut rest = heard;
    for cue in CUES {
        let mixed = samples_of(cue);
        let first = rest.iter().position(is_heard).ok_or_else(|| format!("{cue:?} is not heard"))?;
        let worst = mixed.iter().zip(&rest[first..]).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        // The server's samples have 16 bits.
        if worst > 1e-3 {
            return Err(format!("{cue:?}: a sample differs by {worst}"));
        }
        println!("{cue:?}: none of {} samples differs by more than {worst:.1e}", mixed.len());
        rest = rest.get(first + mixed.len() + RATE as usize / 10..).unwrap_or_default();
    }
    if rest.iter().any(is_heard) { Err("more is heard".to_owned()) } else { Ok(()) }
}

#[test]
#[ignore = "needs a server of sound, see .ci/sound"]
fn what_the_server_plays_is_what_was_mixed() {
    // A machine that is busy with something else may be late once.
    let problems: Vec<String> = (0..3).map_while(|_| compare(&recorded()).err()).collect();
    assert!(problems.len() < 3, "{problems:#?}");
}
