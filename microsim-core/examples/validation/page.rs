//! The page in Markdown.

use super::experiments::plot::number;
use super::experiments::{Experiment, Outcome, Row};
use std::fmt::Write;

pub(crate) const INTRODUCTION: &str = "\
# Validation

The core against published results. Each row is run on the committed code, at the default step of 1/60 s and 8 substeps where
nothing else is said; short forms are in `microsim-core/tests/validation.rs`. The page and its plots are written by

```sh
cargo run --release -p microsim-core --features scenario --example validation -- docs/validation > docs/validation.md
```

and a section by the same command with the experiment's name behind the folder, for example `docs/validation pendulum`. *Accepted*
is what counts as agreement; where a result is missed, the section says why. *Order* is by which power of the substep the error
falls; [convergence](#convergence-in-the-step-and-in-substeps) has all of them.
";

pub(crate) const REFINEMENT: &str = "\
## Refinement

`refinement`. What shorter steps and more substeps change: speed after a second of free fall against `g t`; way in 20 s, units, and
area against `radii` of a cell that nobody drives; the same of one that is driven for 4 s; when prey is taken in in the scenarios
`absorb-agar` and `absorb-rigid` with seeds 1 and 2, and what breaks there, if anything does. Substeps shorter than 0.2 ms or
longer than 17 ms are refused, with amoeboid cells those longer than 6 ms, in which loads stretch links by more than the accepted 25 %. In substeps longer than 1/360 s prey goes in through a gate,
because cups release it there: with them 3, 5, 5 and 1 of the seeds 101 to 160 of `absorb-rigid`, and 4, 1 and 0 of the
seeds 101 to 140 of `absorb-agar`, released their prey at least once at 2, 3, 4 and 5 (agar: 2, 4 and 5) substeps of 1/60 s, and none at 6 and 8. By the gate none does.

";

/// How many rows of each experiment agree.
pub(crate) fn summary(sections: &[(&Experiment, Outcome)]) -> String {
    let mut text = "| experiment | rows | agree |\n|---|---|---|\n".to_owned();
    for (Experiment { name, title, .. }, Outcome { rows, .. }) in sections {
        let anchor = title.to_lowercase().replace(' ', "-").replace(|c: char| !c.is_alphanumeric() && c != '-', "");
        let agree = rows.iter().filter(|row| row.agrees()).count();
        let _ = writeln!(text, "| [{title}](#{anchor}), `{name}` | {} | {agree} |", rows.len());
    }
    text + "| [Refinement](#refinement), `refinement` | | |\n"
}

/// A section: what is done, its rows, and how its error goes with the substep.
pub(crate) fn section(experiment: &Experiment, outcome: &Outcome, order: &str) -> String {
    let Experiment { name, title, source, words, .. } = experiment;
    let mut text = format!("## {title}\n\n`{name}`. {words}\n\nSource: {source}.\n\n");
    text += "| what | published | ours | accepted | |\n|---|---|---|---|---|\n";
    for row in &outcome.rows {
        let Row { what, published, ours, accepted: [least, most] } = row;
        let verdict = if row.agrees() { "agrees" } else { "**missed**" };
        let (ours, least, most) = (number(*ours), number(*least), number(*most));
        let _ = writeln!(text, "| {what} | {published} | {ours} | {least} to {most} | {verdict} |");
    }
    if !outcome.cause.is_empty() && !outcome.rows.iter().all(Row::agrees) {
        let _ = writeln!(text, "\nMissed: {}", outcome.cause);
    }
    let _ = writeln!(text, "\nOrder {order}.");
    if outcome.plot.is_some() {
        let _ = writeln!(text, "\n![{title}](validation/{name}.svg)");
    }
    text
}
