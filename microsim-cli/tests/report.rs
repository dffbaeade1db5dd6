//! Reports: complete in themselves, and sound in a browser where there is one.

mod common;

use common::{Folder, stderr, success};
use std::fs;
use std::process::{Command, Stdio};

/// A page is one sound file that asks for nothing.
fn check(html: &str) {
    assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
    for tag in ["section", "figure", "svg", "table", "div", "details", "p"] {
        let opened = html.matches(&format!("<{tag}>")).count() + html.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, html.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    assert!(
        !html.contains("<script") && !html.contains("http://") && !html.contains("https://") && !html.contains("url(")
    );
    assert!(html.matches("src=\"").count() == html.matches("src=\"data:image/png;base64,").count());
    // Pictures are letters of any kind.
    let drawn: String = html.split('"').filter(|part| !part.starts_with("data:")).collect();
    assert!(!drawn.contains("NaN"));
}

/// Opens a page in a browser: nothing on its console, and nothing asked for but the page itself.
fn open(folder: &Folder, page: &str) {
    let log = folder.path("net.json");
    let output = Command::new("chromium")
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--enable-logging=stderr",
            "--disable-background-networking",
        ])
        .args(["--disable-component-update", "--no-first-run", "--window-size=1300,2000"])
        // The browser asks for the time by itself.
        .arg("--disable-features=NetworkTimeServiceQuerying")
        .arg(format!("--log-net-log={log}"))
        .arg(format!("--user-data-dir={}", folder.path("profile")))
        .arg(format!("--screenshot={}", folder.path("page.png")))
        .arg(format!("file://{page}"))
        .stdout(Stdio::null())
        .output();
    let Ok(output) = output else {
        eprintln!("skipped: chromium is not there");
        return;
    };
    let said = stderr(&output);
    assert!(!said.contains("CONSOLE"), "{said}");
    assert!(fs::metadata(folder.root().join("page.png")).unwrap().len() > 10_000, "{said}");
    let log = common::read_json(log);
    // What the browser asks for by itself has no page that it is asked for by.
    let asked = log["events"].as_array().unwrap().iter().map(|event| &event["params"]);
    let asked = asked.filter(|params| params["initiator"].as_str().is_some_and(|page| page != "not an origin"));
    let asked = asked.filter_map(|params| params["url"].as_str());
    let others: Vec<&str> = asked.filter(|url| !["file:", "data:"].iter().any(|own| url.starts_with(own))).collect();
    assert!(others.is_empty(), "{others:?}");
}

#[test]
fn the_report_of_a_run_is_complete_in_itself() {
    let folder = Folder::new("report-run");
    let (out, page) = (folder.path("out"), folder.path("page.html"));
    success(&["run", "hunt", "--seconds", "1", "--out", &out, "--trajectories", "csv"]);
    success(&["report", &out, "-o", &page]);
    let html = fs::read_to_string(&page).unwrap();
    check(&html);
    for part in
        ["Pictures", "Organisms", "Measures", "Events", "Speed of the simulation", "Result", "Parameters", "Files"]
    {
        assert!(html.contains(&format!("<h2>{part}</h2>")), "{part}");
    }
    open(&folder, &page);
}

#[test]
fn the_report_of_a_sweep_has_a_heat_map_for_all_that_differs() {
    let folder = Folder::new("report-sweep");
    let grid = ["--grid", "count=3,5,8", "--grid", "probe.needle.speed=5..20/4", "--seeds", "0,1", "--steps", "20"];
    let plan = success(&[&["sweep", "plan", "platelets"], &grid[..]].concat());
    let plan = folder.file("plan.jsonl", &plan.stdout);
    let (store, merged, page) = (folder.path("store"), folder.path("merged.jsonl"), folder.path("page.html"));
    success(&["sweep", "run", &plan, "--store", &store]);
    success(&["sweep", "merge", &plan, "--store", &store, "-o", &merged]);
    success(&["report", &merged, "-o", &page]);
    let html = fs::read_to_string(&page).unwrap();
    check(&html);
    assert!(html.contains("bodies at the end") && html.contains("count 8, probe.needle.speed 20: "), "{}", html.len());
    open(&folder, &page);
}
