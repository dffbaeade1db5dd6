//! Which layouts count as the one that is known: new variants at the end of some enums need no new version of the format.

/// The enums that may get new variants at their end without a new version: what was written before reads as before.
const CONSTRAINT: &str = "1.templates[].constraints[]";
const ORGANISM: &str = "1.emitters.slots[].value?.emitter.recipe.Organism";

/// The layout without the variants of an `open` enum that were added to the end since `golden` was written.
fn without_added(open: &str, layout: &str, golden: &str) -> String {
    let kinds = |text: &str| -> Vec<String> {
        text.lines().filter_map(|line| line.strip_prefix(open)?.strip_prefix(' ')).map(str::to_owned).collect()
    };
    let (known, all) = (kinds(golden), kinds(layout));
    let added = all.strip_prefix(&known[..]).unwrap_or_default();
    let is_added = |line: &str| {
        let rest = line.strip_prefix(open).and_then(|rest| rest.strip_prefix([' ', '.']));
        rest.is_some_and(|rest| added.iter().any(|kind| rest.split(['.', ' ']).next() == Some(kind)))
    };
    layout.lines().filter(|line| !is_added(line)).map(|line| format!("{line}\n")).collect()
}

/// Lines without the version, by the value that they are part of: with another variant before them, enums are come to in another order.
fn by_owner(layout: &str) -> Vec<&str> {
    let mut lines: Vec<&str> = layout.lines().skip(1).collect();
    lines.sort_by_key(|line| {
        let way = line.rsplit_once(' ').map_or(*line, |(way, _)| way);
        way.rsplit_once('.').map_or(way, |(owner, _)| owner)
    });
    lines
}

/// Whether a layout is the known one, but for such variants.
pub(super) fn is_known(layout: &str, golden: &str) -> bool {
    let open = [CONSTRAINT, ORGANISM].iter();
    let known = open.fold(layout.to_owned(), |layout, open| without_added(open, &layout, golden));
    by_owner(&known) == by_owner(golden)
}

#[test]
fn only_a_constraint_at_the_end_leaves_the_layout_as_it_is() {
    let golden =
        format!("version 1\n1.templates[].constraints list\n{CONSTRAINT} Rope\n{CONSTRAINT}.Rope.a u32\nnext u8\n");
    let bend = format!("{CONSTRAINT} Bend\n{CONSTRAINT}.Bend.a u32\n");
    let compared = |layout: &str| is_known(layout, &golden);
    assert!(compared(&golden) && compared(&golden.replace("next", &format!("{bend}next"))));
    assert!(!compared(&golden.replace(&format!("{CONSTRAINT} Rope"), &format!("{bend}{CONSTRAINT} Rope"))));
    assert!(!compared(&golden.replace(".a u32", ".a u64")));
    assert!(!compared(&golden.replace("next u8", "next Bend")));
}

#[test]
fn an_organism_at_the_end_leaves_the_layout_as_it_is() {
    let cell = format!("{ORGANISM} Cell\n{ORGANISM}.Cell.way Gate\n");
    let (way, next) = (format!("{ORGANISM}.Cell.way Cup\n"), "next u8\n");
    let golden = format!("version 1\n{ORGANISM} Agar\n{cell}{way}{next}");
    // A walk comes to the second way with the next visit of the cell.
    let yeast = format!("{ORGANISM} Yeast\n{ORGANISM}.Yeast.radius f32\n");
    assert!(is_known(&golden, &golden));
    assert!(is_known(&format!("version 1\n{ORGANISM} Agar\n{cell}{yeast}{way}{next}"), &golden));
    assert!(!is_known(&format!("version 1\n{ORGANISM} Agar\n{yeast}{cell}{way}{next}"), &golden));
    assert!(!is_known(&golden.replace("Cup", "Gate"), &golden) && !is_known(&golden.replace("u8", "u16"), &golden));
}
