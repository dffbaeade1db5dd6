//! What the tests of the program share.
#![allow(dead_code, reason = "each test program uses a part of it")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The program, with these arguments and without the caller's colour settings.
pub(crate) fn microsim(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_microsim"));
    command.args(arguments).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    command
}

/// The program with the default action of signals: where this test runs, they may be ignored, as by `nohup`.
#[cfg(unix)]
pub(crate) fn heeding_signals(arguments: &[&str]) -> Command {
    let mut command = Command::new("env");
    command.args(["--default-signal=INT,TERM,HUP", env!("CARGO_BIN_EXE_microsim")]).args(arguments);
    command
}

pub(crate) fn run(arguments: &[&str]) -> Output {
    microsim(arguments).output().unwrap()
}

/// The output of a program that must succeed.
pub(crate) fn success(arguments: &[&str]) -> Output {
    let output = run(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
    output
}

/// The output of a program that must exit with 2 and these words on stderr.
pub(crate) fn refused(arguments: &[&str], words: &str) -> Output {
    let output = run(arguments);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    assert!(said.contains(words), "{arguments:?}: {said}");
    output
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The one JSON object that the program prints.
pub(crate) fn json(arguments: &[&str]) -> serde_json::Value {
    serde_json::from_slice(&success(arguments).stdout).unwrap()
}

/// A small scenario with several kinds of organisms that move.
const CROWD: &str = r#"
        schema = 1
        name = "crowd-of-the-test"
        duration = 1.0
        [world]
        size = [80.0, 60.0]
        [amoeboid_cell.cell]
        radii = [11.0, 11.0]
        [rigid_cell.swimmer]
        radii = [7.0, 4.0]
        [agar.food]
        radius = 1.0
        [platelet.stone]
        radius = 2.5
        [wander.idle]
        interval = [0.1, 0.3]
        [[spawn]]
        of = "cell"
        at = [25.0, 30.0]
        controller = "idle"
        [[spawn]]
        of = "swimmer"
        at = [46.0, 30.0]
        controller = "idle"
        [[spawn]]
        of = "food"
        at = [60.0, 10.0]
        [[spawn]]
        of = "stone"
        at = [70.0, 50.0]
    "#;

pub(crate) fn crowd() -> String {
    CROWD.to_owned()
}

/// A folder of its own that is removed at the end.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&root);
        fs::create_dir_all(&root).unwrap();
        Self(root)
    }

    pub(crate) fn root(&self) -> &Path {
        &self.0
    }

    pub(crate) fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_owned()
    }

    /// Writes the scenario of [`crowd`] and returns its path.
    pub(crate) fn crowd(&self) -> String {
        self.file("crowd.toml", crowd().as_bytes())
    }

    /// Writes a file and returns its path.
    pub(crate) fn file(&self, name: &str, content: &[u8]) -> String {
        fs::write(self.0.join(name), content).unwrap();
        self.path(name)
    }
}

/// The JSON object in a file.
pub(crate) fn read_json(path: impl AsRef<Path>) -> serde_json::Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
