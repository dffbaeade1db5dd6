//! Scenario files: the built-in ones run, and whatever is wrong with a file is found, placed and explained.
#![cfg(feature = "scenario")]

use microsim_core::scenario::{Scenario, builtin, builtins};
use microsim_core::{Inputs, Kind};
use proptest::prelude::*;

fn build(name: &str, overrides: &[(&str, &str)]) -> microsim_core::World {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let scenario = Scenario::parse(builtin(name).unwrap().text, &overrides);
    scenario.and_then(|scenario| scenario.build()).unwrap_or_else(|errors| panic!("{name}: {errors}")).world
}

#[test]
fn every_builtin_is_read_built_and_steps() {
    assert!(builtins().len() >= 4);
    for builtin in builtins() {
        let scenario = Scenario::parse(builtin.text, &[]).unwrap_or_else(|errors| panic!("{}: {errors}", builtin.name));
        assert_eq!(scenario.name(), builtin.name);
        assert!(!scenario.description().is_empty() && !builtin.summary.is_empty() && scenario.duration() > 0.0);
        let mut world = scenario.build().unwrap_or_else(|errors| panic!("{}: {errors}", builtin.name)).world;
        (0..5).for_each(|_| world.step(&Inputs::new()));
        let census = world.census();
        assert_eq!((census.leaks, census.quarantined), (0, 0), "{}", builtin.name);
        let again = scenario.build().unwrap().world;
        assert_eq!(again.digest(), scenario.clone().build().unwrap().world.digest(), "{}", builtin.name);
    }
    assert!(builtin("nothing").is_none());
}

#[test]
fn platelets_come_in_any_number() {
    for count in [1u32, 2, 90, 120, 150, 200, 1000] {
        let world = build("platelets", &[("count", &count.to_string())]);
        assert_eq!(world.organisms().count() as u32, count + 1);
        let size = world.config().size;
        assert!(count < 90 || (1.4..2.2).contains(&(size.x / size.y)), "{count}: {size}");
    }
}

#[test]
fn a_crowd_has_as_many_cells_as_asked_for_in_a_room_that_grows_with_it() {
    let area_of_each = |count: u32| {
        let world = build("crowd", &[("count", &count.to_string())]);
        let of_kind = |kind| world.view().organisms().filter(|organism| organism.kind() == kind).count() as u32;
        assert_eq!((of_kind(Kind::AmoeboidCell), of_kind(Kind::Platelet)), (count, count));
        assert_eq!(world.census().particles as u32, count * 135, "104 of a cell, 31 of a platelet");
        world.config().size.element_product() / count as f32
    };
    let [few, more] = [20, 320].map(area_of_each);
    assert!([1, 2, 5, 1000].map(area_of_each).into_iter().all(|area| area > more * 0.9));
    assert!((1.0..2.0).contains(&(few / more)), "only the margin is shared: {few} {more}");
}

#[test]
fn a_crowd_finds_room_with_every_seed() {
    for seed in 1..=20 {
        assert_eq!(build("hunt", &[("seed", &seed.to_string())]).organisms().count(), 112, "seed {seed}");
        assert_eq!(build("crowd", &[("seed", &seed.to_string())]).organisms().count(), 40, "seed {seed}");
    }
}

#[test]
fn the_probe_sweeps_through_the_platelets_and_parks_beside_them() {
    let mut world = build("platelets", &[]);
    let probe = world.organisms().next().unwrap();
    let mut farthest = 0.0;
    for step in 0..15 * 60 {
        world.step(&Inputs::new());
        let at = world.centroid(probe).unwrap();
        farthest = if at.x > farthest { at.x } else { farthest };
        assert!(step < 14 * 60 || at.x < 5.0, "{at} after {step} steps");
    }
    assert!(farthest > 20.0, "{farthest}");
}

#[test]
fn the_demonstration_has_everything() {
    for seed in 0..10 {
        let mut scenario = Scenario::parse(builtin("demo").unwrap().text, &[]).unwrap();
        scenario.set_seed(seed);
        let built = scenario.build().unwrap_or_else(|errors| panic!("seed {seed}: {errors}"));
        assert!(built.player.is_some() && built.world.obstacles().count() >= 2);
        let kinds: Vec<_> = built.world.organisms().filter_map(|id| built.world.kind(id)).collect();
        let count = |name: &str| kinds.iter().filter(|kind| kind.name() == name).count();
        assert_eq!(count("amoeboid_cell"), 2);
        assert!((4..=6).contains(&count("rigid_cell")));
        assert!((80..=100).contains(&count("platelet")) && count("agar") == 60);
    }
}

/// A file that is right: `{}` is replaced by the lines in question, which begin at line 9.
const FILE: &str =
    "schema = 1\n[world]\nsize = [60.0, 40.0]\n[agar.pellet]\nradius = 1.0\n[probe.needle]\nradius = 2.0\n# 8\n{}\n";

/// Short names in [`WRONG`] for what many of its cases begin with.
const BEGINNINGS: [(&str, &str); 3] = [
    ("{pellet}", "[[spawn]]\nof = 'pellet'\n"),
    ("{needle}", "[[spawn]]\nof = 'needle'\nname = 'it'\n[[command]]\nof = 'it'\n"),
    ("{cell}", "[amoeboid_cell.c]\nradii = [5, 5]\n[[spawn]]\nof = 'c'\nname = 'it'\n[[command]]\nof = 'it'\n"),
];

/// Lines from line 9 on; line, field and part of the accepted values that the first diagnostic must name.
const WRONG: &[(&str, usize, &str, &str)] = &[
    // Syntax.
    ("[[spawn]]\nof = pellet", 10, "", "strings in quotes"),
    ("[[spawn]\nof = 'pellet'", 9, "", "TOML"),
    ("\n\n\u{1}\u{2}\u{fffd}", 11, "", "TOML"),
    ("[agar.pellet]\nradius = 2.0", 9, "pellet", "each key once"),
    // Types.
    ("[agar.b]\nradius = 'big'", 10, "agar.b.radius", "a number"),
    ("[agar.b]\nradius = 1979-05-27", 10, "agar.b.radius", "a number"),
    ("{pellet}count = 1.5", 11, "spawn.0.count", "a whole number, 0 to 4294967295"),
    ("{pellet}count = -3", 11, "spawn.0.count", "a whole number, 0 to 4294967295"),
    ("{pellet}count = 99999999999999999999", 11, "spawn.0.count", "a whole number"),
    ("{pellet}at = [1.0]", 11, "spawn.0.at", "[x, y], two numbers"),
    ("{pellet}at = [1.0,\n'a']", 12, "spawn.0.at.1", "a number"),
    ("[[spawn]]\nof = 'needle'\nplayer = 1", 11, "spawn.0.player", "true or false"),
    ("{pellet}angle = 'north'", 11, "spawn.0.angle", "degrees from -36000 to 36000, or \"random\""),
    ("{pellet}scale = [2.0, 1.0]", 11, "spawn.0.scale", "a number 0.01 to 100, or [smallest, largest]"),
    ("[spawn]\nof = 'pellet'", 9, "spawn", "[[spawn]] tables"),
    ("[agar]\nb = 3", 10, "agar.b", "a table"),
    ("[fluid.f]\nsize = [9, 9]\nmode = 'liquid'", 11, "fluid.f.mode", "\"density\" or \"granular\""),
    ("[patrol.p]\nthrough = [[1, 1]]\nin = 'metres'", 11, "patrol.p.in", "\"units\" or \"room\""),
    ("[parameters]\nlist = [1, 2]", 10, "parameters.list", "a number, a string or a boolean"),
    // Missing.
    ("[agar.b]\ndensity = 2.0", 9, "agar.b.radius", "a number"),
    ("[rigid_cell.r]", 9, "rigid_cell.r.radii", "[x, y], two numbers"),
    ("[[spawn]]\ncount = 2", 9, "spawn.0.of", "a string in quotes"),
    ("[wander.w]\nrest = 0.1", 9, "wander.w.interval", "[a, b]"),
    ("[[field]]\nof = 'pellet'\npitch = 3", 9, "field.0.count", "a whole number"),
    ("[[wall]]\nfrom = [1, 1]\nto = [2, 2]", 9, "wall.0.thickness", "a number"),
    // Unknown.
    ("[agar.b]\nradius = 1.0\ndensty = 2.0", 11, "agar.b.densty", "radius, density"),
    ("[bacterium.b]\nradius = 1.0", 9, "bacterium", "agar"),
    ("[[spawn]]\nof = 'pelet'", 10, "spawn.0.of", "needle, pellet"),
    ("[[spawn]]\nof = 'needle'\ncontroller = 'wander'", 11, "spawn.0.controller", "nothing: none is defined"),
    ("{pellet}count = '$many'", 11, "spawn.0.count", "nothing: none is defined"),
    ("[invariants]\nleeks = 0", 10, "invariants.leeks", "leaks, improper_absorptions"),
    ("[[expect]]\nby = 1\nmin = 1\nmeasure = 'ingestd'", 12, "expect.0.measure", "ingested"),
    ("[[spawn]]\nof = 'needle'\nname = 'it'\n[[command]]\nof = 'its'\nrest = true", 13, "command.0.of", "it"),
    ("{needle}follow = 'me'", 14, "command.0.follow", "it"),
    (
        "{needle}rest = true\ngole = [1, 1]",
        15,
        "command.0.gole",
        "at, of, every, until, goal, follow, rest, digest, grow, divide, fuse",
    ),
    // Checks and commands that mean nothing.
    ("[invariants]\nleaks = 'none'", 10, "invariants.leaks", "the most that it may be, or [least, most]"),
    ("[invariants]\nleaks = [3, 1]", 10, "invariants.leaks", "[least, most]"),
    ("[[expect]]\nby = 1\nmeasure = 'leaks'", 9, "expect.0.min", "a number"),
    ("[[expect]]\nby = -1\nmin = 1\nmeasure = 'leaks'", 10, "expect.0.by", "0 to 1000000"),
    ("[[spawn]]\nof = 'needle'\nname = 'it'\n[[command]]\nof = 'it'", 12, "command.0", "at least one of goal, follow"),
    ("{needle}rest = false", 14, "command.0.rest", "true"),
    ("{needle}digest = true", 14, "command.0.digest", "an amoeboid_cell"),
    ("{needle}divide = 'two'", 14, "command.0.divide", "an amoeboid_cell"),
    ("{cell}divide = 'it'", 16, "command.0.divide", "a name for the daughter"),
    ("{cell}fuse = 'two'", 16, "command.0.fuse", "it"),
    ("{pellet}name = 'it'\n[[command]]\nof = 'it'\ngoal = [1, 1]", 14, "command.0.goal", "a probe"),
    // Ranges.
    ("[agar.b]\nradius = -1.0", 10, "agar.b.radius", "0.1 to 20"),
    ("[agar.b]\nradius = nan", 10, "agar.b.radius", "0.1 to 20"),
    ("[agar.b]\nradius = 1e300", 10, "agar.b.radius", "0.1 to 20"),
    ("[rigid_cell.r]\nradii = [7,\n0.01]", 11, "rigid_cell.r.radii.1", "0.5 to 200"),
    ("[platelet.p]\nradius = 2.5\nsatellites = 4", 11, "platelet.p.satellites", "8 to 64"),
    ("[fluid.f]\nsize = [9, 9]\nspacing = 0", 11, "fluid.f.spacing", "0.05 to 100"),
    ("[step]\nsubsteps = 0", 10, "step.substeps", "1 to 64"),
    ("[wander.w]\ninterval = [2.0,\n1.0]", 11, "wander.w.interval.1", "2 to 600"),
    ("[patrol.p]\nthrough = []", 10, "patrol.p.through", "1 to 1000 points"),
    ("[patrol.p]\nin = 'room'\nthrough = [[0.5, 0.5],\n[50, 50]]", 12, "patrol.p.through.1", "fractions of the room"),
    ("[[disc]]\nat = [1, inf]\nradius = 3", 10, "disc.0.at.1", "-20000 to 20000"),
    ("[[block]]\nat = [1, 1]\nsize = [0, 3]", 11, "block.0.size.0", "0.01 to 20000"),
    ("[[polygon]]\npoints = [[0, 0], [9, 9], [9, 0], [0, 9]]", 10, "polygon.0.points", "edges that do not cross"),
    ("[[polygon]]\npoints = [[0, 0], [9, 9]]", 10, "polygon.0.points", "3 to 200 corners"),
    ("{pellet}scale = 90", 11, "spawn.0.scale", "a box of at least 180 by 180"),
    // Too many.
    ("{pellet}count = 1000000000", 11, "spawn.0.count", "at most 500000"),
    ("[[field]]\nof = 'pellet'\ncount = 4000000000\npitch = 2", 11, "field.0.count", "a room of about"),
    ("{pellet}count = 3000", 11, "spawn.0.count", "at most here"),
    // Places.
    ("[[spawn]]\nof = 'needle'\nat = [59, 20]", 11, "spawn.0.at", "within 0 to 60 by 0 to 40"),
    ("[[spawn]]\nof = 'needle'\nat = [nan, 20]", 11, "spawn.0.at.0", "-100000 to 100000"),
    ("{pellet}at = [9, 9]\n[[spawn]]\nof = 'needle'\nat = [10, 10]", 14, "spawn.1.at", "nothing overlaps"),
    ("{pellet}at = [9, 9]\ncount = 3", 12, "spawn.0.count", "either `at`, or"),
    ("{pellet}within = [[9, 9], [5, 70]]", 11, "spawn.0.within", "within 0 to 60 by 0 to 40"),
    ("[[field]]\nof = 'pellet'\ncount = 9\npitch = 1", 12, "field.0.pitch", "2 to 20000"),
    // Names.
    ("[probe.pellet]\nradius = 1", 9, "probe.pellet", "a name that no other prototype has"),
    ("[agar.'a b']\nradius = 1", 9, "agar.a b", "letters, digits, _ or -"),
    ("{pellet}name = 'a'\n{pellet}name = 'a'", 14, "spawn.1.name", "a name that no other organism has"),
    ("{pellet}player = true", 11, "spawn.0.player", "an amoeboid_cell, a rigid_cell, a bacterium or a probe"),
];

#[test]
fn what_is_wrong_is_placed_and_explained() {
    let fails = |text: &str| Scenario::parse(text, &[]).and_then(|scenario| scenario.build()).err();
    assert_eq!(fails(&FILE.replace("{}", "[[spawn]]\nof = 'pellet'")), None, "the file itself is right");
    for &(lines, line, field, accepted) in WRONG {
        let lines = BEGINNINGS.iter().fold(lines.to_owned(), |lines, (name, beginning)| lines.replace(name, beginning));
        let text = FILE.replace("{}", &lines);
        let errors = fails(&text).unwrap_or_else(|| panic!("accepted:\n{lines}"));
        let first = errors.iter().next().unwrap();
        assert_eq!((first.line, first.field.as_str()), (Some(line), field), "{first}\n{lines}");
        let says = first.accepted.as_deref().unwrap_or_default();
        assert!(says.contains(accepted), "{first}\n{lines}");
        let offset: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
        let span = first.span.clone().unwrap();
        assert!(text.get(span.clone()).is_some() && span.start >= offset, "{first}");
    }
}

#[test]
fn an_empty_file_lacks_what_is_required() {
    let errors = Scenario::parse("", &[]).unwrap_err();
    let fields: Vec<_> = errors.iter().map(|error| (error.field.as_str(), error.line)).collect();
    assert_eq!(fields, [("schema", Some(1)), ("world.size", Some(1))]);
    let errors = Scenario::parse("schema = 2\n[world]\nsize = [9, 9]", &[]).unwrap_err();
    assert_eq!(errors.to_string(), "line 1, column 10: schema: version 2 of the format is not known (accepted: 1)");
}

#[test]
fn independent_errors_are_found_in_one_pass_in_the_order_of_the_text() {
    let wrong = "[agar.b]\nradius = -1\n[wander.w]\ninterval = 3\n[[spawn]]\nof = 'b'\n[[spawn]]\nof = 'c'\nsise = 3";
    let errors = Scenario::parse(&FILE.replace("{}", wrong), &[]).unwrap_err();
    let fields: Vec<_> = errors.iter().map(|error| error.field.as_str()).collect();
    assert_eq!(fields, ["agar.b.radius", "wander.w.interval", "spawn.1.of", "spawn.1.sise"]);
    assert_eq!(errors.len(), 4);
    assert_eq!(errors.to_string().lines().count(), 4);
    let near = Scenario::parse(&FILE.replace("{}", "[agar.b]\nradus = 1"), &[]).unwrap_err();
    assert!(near.to_string().contains("unknown field `radus`, did you mean `radius`?"), "{near}");
}

#[test]
fn equal_seeds_give_equal_worlds() {
    let digest = |seed| build("demo", &[("seed", seed)]).digest();
    assert_eq!(digest("7"), digest("7"));
    assert_ne!(digest("7"), digest("8"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_makes_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), key in ".{0,12}", value in ".{0,12}") {
        let _ = Scenario::parse(&String::from_utf8_lossy(&bytes), &[(key, value)]);
    }

    #[test]
    fn no_change_to_a_builtin_makes_it_panic(
        which in 0usize..4,
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0usize..6, "[-0-9.a-z\\[\\]\"$=#\n ]{1,6}"), 1..6),
    ) {
        let mut text: Vec<char> = builtins()[which].text.chars().collect();
        for (place, length, replacement) in edits {
            let start = place.index(text.len());
            let end = (start + length).min(text.len());
            text.splice(start..end, replacement.chars());
        }
        let text: String = text.into_iter().collect();
        // A limit, so that a changed count costs little.
        let limit = [("world.max_particles".to_owned(), "8000".to_owned())];
        if let Err(errors) = Scenario::parse(&text, &limit).and_then(|scenario| scenario.build()) {
            for error in &errors {
                let is_placed = error.span.clone().is_some_and(|span| text.get(span).is_some());
                prop_assert!(is_placed || error.message.contains("as set by"), "{}", error);
            }
        }
    }

    #[test]
    fn any_override_of_a_number_is_taken_or_explained(value in prop::num::f64::ANY, key in 0usize..5) {
        let key = ["count", "world.damping", "field.0.pitch", "platelet.thrombocyte.radius", "duration"][key];
        let overrides = [(key.to_owned(), format!("{value:?}"))];
        if let Err(errors) = Scenario::parse(builtin("platelets").unwrap().text, &overrides) {
            prop_assert!(errors.iter().all(|error| error.accepted.is_some()), "{}", errors);
        }
    }
}

/// A scenario that is right but for what is added.
fn with(added: &str) -> String {
    format!("schema = 1\n{added}\n[world]\nsize = [100.0, 100.0]\n[agar.pellet]\nradius = 1.0\n")
}

#[test]
fn of_many_problems_of_a_kind_twenty_are_listed_and_the_others_counted() {
    let keys: String = (0..50_000).map(|k| format!("key{k} = {k}\n")).collect();
    let names: String = (0..5000).map(|k| format!("[agar.pellet{k}]\nradius = 1.0\n")).collect();
    let typos: String = (0..5000).map(|k| format!("[[spawn]]\nof = \"pelet{k}\"\n")).collect();
    let large: String = (0..5000).map(|k| format!("[agar.a{k}]\nradius = 5{k}000\n")).collect();
    let unset: String = (0..5000).map(|k| format!("[[spawn]]\nof = \"$p{k}\"\n")).collect();
    let broken: String = (0..5000).map(|k| format!("a{k} = = 1\n")).collect();
    for (text, count, kind, first_line) in [
        (with(&keys), 50_000, "unknown field", 2),
        (with("") + &names + &typos, 5_000, "unknown prototype", 10_008),
        (with("") + &large, 5_000, "… is out of range", 8),
        (with("") + &unset, 5_000, "unknown parameter", 8),
        (with("") + &broken, 5_000, "", 7),
    ] {
        let found = Scenario::parse(&text, &[]).unwrap_err();
        assert_eq!(found.left_out().iter().map(|more| more.count).sum::<usize>() + found.len(), count, "{kind}");
        assert!(found.len() <= 60 && found.to_string().len() < 100_000, "{kind}: {}", found.to_string().len());
        assert!(kind.is_empty() || found.left_out()[0].kind == kind, "{:?}", found.left_out());
        assert_eq!(found.iter().next().unwrap().line, Some(first_line), "{kind}");
    }
}
