//! The examples of the documentation are run, in order, and print what they say there.
//!
//! `UPDATE_TRANSCRIPTS=1 cargo test -p microsim-cli --test transcripts` writes what they print now into the pages.

mod common;

use common::Folder;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Most lines of a screen.
const SCREEN: usize = 40;

fn pages() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/cli")
}

/// What a command line prints, both streams, and its exit code if that is not 0.
fn transcript(line: &str, folder: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_microsim"));
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap_or_default());
    let script = format!("exec 2>&1\n{line}\n");
    let mut shell = Command::new("sh");
    let output =
        shell.args(["-c", &script]).current_dir(folder).env("PATH", path).env("NO_COLOR", "1").output().unwrap();
    let mut text = String::from_utf8(output.stdout).unwrap();
    if let Some(code) = output.status.code().filter(|code| *code != 0) {
        text += &format!("[exit code {code}]\n");
    }
    text
}

/// Runs the examples of a page: in each ```console block the lines after a `$ ` are what that command prints. Returns the page
/// with what they print now where that is not what it says.
fn run(page: &str, folder: &Path) -> String {
    let mut written = String::new();
    let mut lines = page.lines().peekable();
    let mut is_console = false;
    while let Some(line) = lines.next() {
        written += &format!("{line}\n");
        if line.starts_with("```") {
            is_console = !is_console && line == "```console";
        }
        let Some(command) = line.strip_prefix("$ ").filter(|_| is_console) else { continue };
        let mut command = command.to_owned();
        while command.ends_with('\\') {
            let next = lines.next().unwrap();
            written += &format!("{next}\n");
            command = format!("{}{}", command.trim_end_matches('\\'), next);
        }
        let mut expected = String::new();
        while let Some(line) = lines.next_if(|line| !line.starts_with("$ ") && !line.starts_with("```")) {
            expected += &format!("{line}\n");
        }
        let actual = transcript(&command, folder);
        written += if is_as(&actual, &expected) { &expected } else { &actual };
    }
    written
}

/// Whether a text is what was expected, in which `[..]` stands for anything in a line and `...` for any lines.
fn is_as(actual: &str, expected: &str) -> bool {
    let (actual, expected) = (snapbox::Data::text(actual), snapbox::Data::text(expected));
    snapbox::Assert::new().try_eq(None, actual, expected).is_ok()
}

fn check(name: &str) {
    let folder = Folder::new(&format!("transcripts-{name}"));
    let path = pages().join(name);
    let page = fs::read_to_string(&path).unwrap();
    let written = run(&page, folder.root());
    if std::env::var_os("UPDATE_TRANSCRIPTS").is_some() {
        fs::write(&path, written).unwrap();
        return;
    }
    assert!(page.contains("\n$ microsim "), "{name} has examples");
    snapbox::assert_data_eq!(written, snapbox::Data::text(page).raw());
}

#[test]
fn the_guide_is_true() {
    check("guide.md");
}

#[test]
fn the_reference_is_true_and_every_help_fits_a_screen() {
    check("reference.md");
    let page = fs::read_to_string(pages().join("reference.md")).unwrap();
    for block in page.split("```console\n").skip(1) {
        let (block, _) = block.split_once("```").unwrap();
        let lines: Vec<&str> = block.lines().skip(1).collect();
        let widest = lines.iter().map(|line| line.chars().count()).max().unwrap();
        assert!(lines.len() <= SCREEN && widest <= 150, "{} lines of up to {widest}: {block}", lines.len());
    }
}

/// The examples at the end of a help: command lines on lines of their own, or after a colon.
fn examples(help: &str) -> Vec<String> {
    let (_, end) = help.split_once("Options:").unwrap();
    let commands = end.lines().map(|line| line.rsplit_once(": ").map_or(line, |(_, command)| command).trim());
    commands
        .filter(|command| command.starts_with("microsim ") || command.starts_with("sed "))
        .map(str::to_owned)
        .collect()
}

/// All verbs, and none for the program: each has a manual page.
fn verbs(folder: &Folder) -> Vec<String> {
    common::success(&["man", "--out", &folder.path("man")]);
    let names = fs::read_dir(folder.path("man")).unwrap().map(|page| page.unwrap().file_name().into_string().unwrap());
    names.map(|name| name.trim_start_matches("microsim").trim_end_matches(".1").replace('-', " ")).collect()
}

/// What the examples need, and what stands for programs that are not here: those that hand out the tasks of a sweep run one.
const SETUP: &str = r#"export HOME=$PWD SLURM_ARRAY_TASK_ID=1
mkdir -p .config/fish/completions .local/share/bash-completion/completions docs
microsim sweep plan empty --steps 1 --seeds 0..9 > plan.jsonl 2> /dev/null
microsim sweep run plan.jsonl --store results 2> /dev/null
for player in ada ben; do # what a match that came apart leaves
    [ $player = ada ] && seed=1 || seed=2
    mkdir -p $player
    microsim run empty --steps 3 --seed $seed --record $player/desync.replay --snapshots 0.05 --out $player/run > /dev/null 2>&1
    cp $player/run/snapshots/*.snapshot $player/desync.snapshot
done
command -v man > /dev/null || man() { cat; }
sbatch() { sh -c "$3"; }
parallel() { shift 2; "$@"; }
hq() { shift 3; HQ_ENTRY=$(head -n 1 plan.jsonl) "$@"; }
"#;

#[test]
fn every_example_in_a_help_can_be_run() {
    let folder = Folder::new("examples");
    let mut count = 0;
    for verb in verbs(&folder) {
        let help = transcript(&format!("microsim {verb} --help"), folder.root());
        // `fpath` is of another shell.
        for example in examples(&help).iter().filter(|example| !example.contains("fpath")) {
            let quick = example.replace("run hunt ", "run hunt --steps 2 ");
            let text = transcript(&format!("{SETUP}{{ {quick}; }}"), folder.root());
            assert!(!text.contains("[exit code"), "{verb}: {example}: {text}");
            count += 1;
        }
    }
    assert_eq!(count, 8, "as many as there are");
}

fn all_pages() -> Vec<PathBuf> {
    let folders = ["../..", "..", "."].map(|folder| pages().join(folder));
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()).map(|file| file.unwrap().path());
    let mut found: Vec<_> = files.filter(|path| path.extension().is_some_and(|extension| extension == "md")).collect();
    found.sort();
    found
}

/// The lines of the ```sh blocks of a page that start this program, as if it were installed.
fn shell_lines(page: &str) -> Vec<String> {
    let blocks = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap().replace("\\\n", " "));
    let of_program = |line: &str| match line.split_once(" -p microsim-cli ") {
        Some((_, rest)) if line.starts_with("cargo run ") => Some(format!("microsim {}", rest.split_once("-- ")?.1)),
        _ => line.contains("microsim ").then(|| line.to_owned()),
    };
    blocks.flat_map(|block| block.lines().filter_map(of_program).collect::<Vec<_>>()).collect()
}

#[test]
fn every_command_of_a_page_can_be_run() {
    let folder = Folder::new("pages");
    let mut count = 0;
    for path in all_pages() {
        // It would go on for ever; `serve.rs` runs it.
        for line in shell_lines(&fs::read_to_string(&path).unwrap()).iter().filter(|line| !line.contains(" serve ")) {
            let mut quick = line.replace("run demo ", "run demo --steps 2 ");
            for (long, short) in [("--seconds 30 ", ""), ("VERB ...", "list"), ("yeast.toml", "empty --size 16x16")] {
                quick = quick.replace(long, short);
            }
            let text = transcript(&format!("{SETUP}cp run.replay other.replay 2> /dev/null\n{quick}"), folder.root());
            let exit = if line.contains("ben/desync") { "[exit code 1]" } else { "" };
            let is_as_expected =
                text.split_once("[exit code").map_or(exit.is_empty(), |_| text.contains(exit) && !exit.is_empty());
            assert!(is_as_expected, "{}: {line}: {text}", path.display());
            count += 1;
        }
    }
    assert_eq!(count, 13, "as many as there are");
}

#[test]
fn the_committed_schema_is_that_of_the_reader() {
    let path = pages().join("../scenario.schema.json");
    let schema = common::stdout(&common::run(&["schema"]));
    if std::env::var_os("UPDATE_TRANSCRIPTS").is_some() {
        fs::write(&path, schema).unwrap();
        return;
    }
    assert!(fs::read_to_string(&path).unwrap() == schema, "UPDATE_TRANSCRIPTS=1 writes the present one");
}
