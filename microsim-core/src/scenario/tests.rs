//! What parts of a scenario do together; whole files are tested in `tests/scenario.rs`.

use super::*;
use crate::World;
use glam::Vec2;

const ROOM: &str = "schema = 1\n[world]\nsize = [60.0, 40.0]\n[agar.a]\nradius = 1.0\n";

fn parse(text: &str) -> Scenario {
    Scenario::parse(text, &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

fn with(extra: &str) -> Scenario {
    parse(&format!("{ROOM}{extra}"))
}

/// Centres and radii of all organisms, each of one disc.
fn discs(world: &World) -> Vec<(Vec2, f32)> {
    let discs = world.view().organisms().flat_map(|organism| organism.particles());
    discs.map(|particle| (particle.position, particle.radius)).collect()
}

#[test]
fn random_places_are_apart_and_in_their_box_and_off_the_obstacles() {
    let extra = "[[spawn]]\nof = 'a'\ncount = 60\nwithin = [[10, 5], [50, 35]]\nscale = [0.5, 1.5]\ngap = 0.5\n\
                 [[disc]]\nat = [30, 20]\nradius = 6\n[[spawn]]\nof = 'a'\nat = [20, 20]\nscale = 4.0\n";
    let scenario = with(extra);
    for seed in 0..20 {
        let mut scenario = scenario.clone();
        scenario.set_seed(seed);
        let discs = discs(&scenario.build().unwrap().world);
        assert_eq!(discs.len(), 61);
        for (k, &(a, radius)) in discs.iter().enumerate().take(60) {
            assert!(a.x - radius >= 10.0 && a.x + radius <= 50.0 && a.y - radius >= 5.0 && a.y + radius <= 35.0);
            assert!((a - Vec2::new(30.0, 20.0)).length() >= 6.0 + radius + 0.49);
            let is_apart = |&(b, other): &(Vec2, f32)| (a - b).length() >= radius + other + 0.49;
            assert!(discs[..k].iter().chain(&discs[60..]).all(is_apart), "seed {seed}");
        }
    }
}

#[test]
fn places_follow_from_the_seed() {
    let scenario = with("[[spawn]]\nof = 'a'\ncount = 10\nangle = 'random'\n");
    let digest = |seed| {
        let mut scenario = scenario.clone();
        scenario.set_seed(seed);
        scenario.build().unwrap().world.digest()
    };
    assert_eq!(digest(3), digest(3));
    assert_ne!(digest(3), digest(4));
    assert_eq!(parse("schema = 1\nseed = 9223372036854775807\n[world]\nsize = [9, 9]").seed(), i64::MAX as u64);
}

/// How many organisms there are in a scenario with two parameters.
fn count_with(overrides: &[(&str, &str)]) -> Result<usize, Diagnostics> {
    let text = format!("{ROOM}[[spawn]]\nof = '$kind'\ncount = '$n'\n[parameters]\nkind = 'a'\nn = 3\n");
    let owned: Vec<_> = overrides.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect();
    Scenario::parse(&text, &owned).map(|scenario| scenario.build().unwrap().world.organisms().count())
}

#[test]
fn parameters_and_overrides_are_typed_like_the_file() {
    assert_eq!(count_with(&[]), Ok(3));
    assert_eq!(count_with(&[("n", "5")]), Ok(5));
    assert_eq!(count_with(&[("parameters.n", "0x10")]), Ok(16));
    assert_eq!(count_with(&[("n", "5"), ("spawn.0.count", "7")]), Ok(7), "a path reaches what a parameter had set");
    assert_eq!(count_with(&[("kind", "a"), ("world.damping", "1"), ("step.dt", "0.01"), ("seed", "4")]), Ok(3));
}

#[test]
fn a_bad_override_is_named_as_it_was_set() {
    for (key, value, field, message) in [
        ("n", "many", "spawn.0.count", "is the string \"many\", as set by `n=many`"),
        ("n", "2.5", "spawn.0.count", "is 2.5, as set by `n=2.5`"),
        ("agar.a.radius", "-2", "agar.a.radius", "-2 is out of range, as set by `agar.a.radius=-2`"),
        ("m", "1", "m", "unknown parameter `m`, as set by `m=1`"),
        ("agar.b.radius", "1", "agar.b.radius", "unknown part `b`, as set by `agar.b.radius=1`"),
        ("spawn.4.of", "a", "spawn.4.of", "there is no entry `4`, as set by `spawn.4.of=a`"),
        ("seed.x", "1", "seed.x", "unknown part `seed`, as set by `seed.x=1`"),
        (
            "world.dampin",
            "1",
            "world.dampin",
            "unknown field `dampin`, did you mean `damping`?, as set by `world.dampin=1`",
        ),
        ("n", "[1", "n", "unclosed array, expected `]`, as set by `n=[1`"),
    ] {
        let errors = count_with(&[(key, value)]).unwrap_err();
        let error = errors.iter().next().unwrap();
        assert_eq!((error.field.as_str(), error.message.as_str()), (field, message));
        assert_eq!((error.line, error.span.clone()), (None, None), "{key}={value} is not in the text");
        assert!(error.accepted.is_some());
    }
}

#[test]
fn each_line_has_one_syntax_error_and_a_long_text_one_in_all() {
    let count = |lines| Scenario::parse(&"=\n".repeat(lines), &[]).unwrap_err();
    let lines: Vec<_> = count(3).iter().map(|error| error.line).collect();
    assert_eq!(lines, [1, 2, 3].map(Some), "keys that are there twice are found later");
    assert_eq!(count(60_000).iter().map(|error| error.line).collect::<Vec<_>>(), [Some(1)]);
    let sound = ROOM.to_owned() + &"# long\n".repeat(30_000);
    assert!(Scenario::parse(&sound, &[]).is_ok());
}

#[test]
fn values_from_parameters_stand_where_the_parameter_does() {
    let text = "schema = 1\n[parameters]\nr = -1\n[world]\nsize = [9, 9]\n[agar.a]\nradius = '$r'\n";
    let errors = Scenario::parse(text, &[]).unwrap_err();
    let error = errors.iter().next().unwrap();
    assert_eq!((error.field.as_str(), error.line, error.column), ("agar.a.radius", Some(3), Some(5)));
    assert_eq!(text.get(error.span.clone().unwrap()), Some("-1"));
}

#[test]
fn named_organisms_and_the_player_are_found() {
    let extra = "[probe.p]\nradius = 2\n[[spawn]]\nof = 'a'\nname = 'bait'\nat = [5, 5]\n\
                 [[spawn]]\nof = 'p'\nplayer = true\ncount = 2\n[[spawn]]\nof = 'p'\nplayer = true\n";
    let built = with(extra).build().unwrap();
    let ids: Vec<_> = built.world.organisms().collect();
    assert_eq!(built.player, Some(ids[1]));
    assert_eq!(built.named, [("bait".to_owned(), ids[0])]);
}

#[test]
fn scaled_cells_and_fluids_have_more_particles_not_larger_ones() {
    let text = "schema = 1\n[world]\nsize = [99, 99]\n[amoeboid_cell.c]\nradii = [8, 8]\n\
                [[spawn]]\nof = 'c'\nat = [20, 20]\n[[spawn]]\nof = 'c'\nat = [60, 60]\nscale = 2\n";
    let world = parse(text).build().unwrap().world;
    let counts: Vec<_> = world.view().organisms().map(|cell| cell.particles().count()).collect();
    assert!(counts[1] > 3 * counts[0], "{counts:?}");
    let radius = world.view().organisms().flat_map(|cell| cell.particles()).map(|p| p.radius);
    assert!(radius.into_iter().all(|radius| radius < 0.79));
}

#[test]
fn obstacles_of_every_kind_stop_what_moves() {
    let extra = "[[wall]]\nfrom = [10, 0]\nto = [10, 40]\nthickness = 2\nfriction = 0.5\n\
                 [[block]]\nat = [30, 20]\nsize = [4, 38]\nangle = 3\n\
                 [[polygon]]\npoints = [[44, 40], [50, 20], [44, 0], [56, 0], [53, 20], [56, 40]]\n\
                 [[disc]]\nat = [20, 20]\nradius = 3\n";
    let world = with(extra).build().unwrap().world;
    assert_eq!(world.obstacles().count(), 4);
    for (x, inside) in [(10.5, true), (20.0, true), (30.0, true), (51.5, true), (46.0, false), (25.0, false)] {
        let text = format!("{extra}[[spawn]]\nof = 'a'\nat = [{x}, 20.0]\n");
        assert_eq!(with(&text).build().is_err(), inside, "x = {x}");
    }
}

#[test]
fn controllers_reach_their_organisms() {
    let extra = "[probe.p]\nradius = 1\nspeed = 10\n[patrol.right]\nin = 'room'\nthrough = [[0.75, 0.5]]\n\
                 [[spawn]]\nof = 'p'\nat = [10, 20]\ncontroller = 'right'\n";
    let mut built = with(extra).build().unwrap();
    for _ in 0..400 {
        built.world.step(&crate::Inputs::new());
    }
    let probe = built.world.organisms().next().unwrap();
    let end = built.world.centroid(probe).unwrap();
    assert!((end - Vec2::new(45.0, 20.0)).length() < 0.5, "{end}");
}

const DISH: &str = r#"
    schema = 1
    name = "dish"
    [world]
    size = [80.0, 50.0]
    [amoeboid_cell.cell]
    radii = [8.0, 8.0]
    [agar.pellet]
    radius = 1.0
    [[spawn]]
    of = "cell"
    player = true
    at = [20.0, 25.0]
"#;

/// Numbers of organisms after each of so many seconds.
fn counts(text: &str, seconds: u32) -> Vec<usize> {
    let mut built = Scenario::parse(text, &[]).unwrap().build().unwrap();
    let mut second = |_| {
        for _ in 0..60 {
            let inputs = built.script.before_step(&mut built.world).clone();
            built.world.step(&inputs);
        }
        built.world.organisms().count()
    };
    (0..seconds).map(&mut second).collect()
}

#[test]
fn organisms_come_when_it_is_their_time() {
    let late = format!("{DISH}[[spawn]]\nof = \"pellet\"\ncount = 4\ngap = 0.5\nfrom = 2.0");
    assert_eq!(counts(&late, 4), [1, 1, 5, 5]);
}

#[test]
fn what_is_gone_comes_again_elsewhere_and_the_same_for_the_same_seed() {
    let again = format!("{DISH}[[spawn]]\nof = \"pellet\"\ncount = 4\ngap = 0.5\nrespawn = 1.0");
    let run = |seed: u64| {
        let mut scenario = Scenario::parse(&again, &[]).unwrap();
        scenario.set_seed(seed);
        let mut built = scenario.build().unwrap();
        let first = built.world.organisms().nth(1).unwrap();
        let place = built.world.centroid(first).unwrap();
        built.world.remove(first).unwrap();
        let mut least = usize::MAX;
        for _ in 0..120 {
            let inputs = built.script.before_step(&mut built.world).clone();
            built.world.step(&inputs);
            least = least.min(built.world.organisms().count());
        }
        assert_eq!((least, built.world.organisms().count()), (4, 5));
        assert!(built.world.organisms().all(|id| (built.world.centroid(id).unwrap() - place).length() > 0.5));
        built.world.digest()
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}

#[test]
fn a_game_names_its_points_and_needs_a_player() {
    let game = format!("{DISH}[game]\ntime = 30.0\n[game.points.agar]\neach = 2.4\nper_area = 0.5");
    let scenario = Scenario::parse(&game, &[]).unwrap();
    let rules = scenario.game().unwrap();
    assert_eq!((rules.time, rules.points(crate::Kind::Agar, 3.0), rules.points(crate::Kind::Probe, 3.0)), (30.0, 4, 0));
    let refused = |text: &str| Scenario::parse(text, &[]).unwrap_err().to_string();
    let nobody = refused(&game.replace("player = true", ""));
    assert!(nobody.contains("nobody plays"), "{nobody}");
    let unknown = refused(&game.replace("points.agar", "points.agr"));
    assert!(unknown.contains("agr"), "{unknown}");
    let endless = refused(&game.replace("time = 30.0", "time = 0.0"));
    assert!(endless.contains("game.time"), "{endless}");
    let known = refused(&game.replace("player = true", "player = true\nrespawn = 1.0"));
    assert!(known.contains("respawn"), "{known}");
}

fn slide() -> String {
    format!(
        "{DISH}[coccus.prey]\nradius = 0.6\n[[spawn]]\nof = \"prey\"\ncount = 3\n[slide]\ntitle = \"T\"\ntask = \"Go.\"\nfact = \"Cells crawl.\"\nsource = \"A, 1900, B\"\ntime = 60.0\n\
         stars = [20.0, 40.0]\n[[slide.goal]]\nreach = [[1.0, 2.0], [3.0, 4.0]]\n[[slide.goal]]\n\
         digested = \"coccus\"\ncount = 3\n"
    )
}

#[test]
fn a_slide_has_goals_and_a_time_for_each_star() {
    let scenario = Scenario::parse(&slide(), &[]).unwrap();
    let rules = scenario.slide().unwrap();
    let reach = Goal::Reach { low: Vec2::new(1.0, 2.0), high: Vec2::new(3.0, 4.0) };
    assert_eq!(rules.goals, [reach, Goal::Digest { kind: crate::Kind::Coccus, count: 3 }]);
    assert_eq!(rules.stars, [20.0, 40.0]);
}

/// The slide with another goal, for two cells.
fn slide_for_two() -> String {
    let second = "name = \"player-2\"\nat = [40.0, 40.0]\n[coccus.prey]";
    let slide = slide().replacen("[coccus.prey]", &format!("[[spawn]]\nof = \"cell\"\n{second}"), 1);
    format!("{slide}[[slide.goal]]\ntogether = [[[1.0, 2.0], [3.0, 4.0]], [[5.0, 2.0], [7.0, 4.0]]]\n")
}

#[test]
fn a_slide_may_need_two_players_in_two_places_at_once() {
    let scenario = Scenario::parse(&slide_for_two(), &[]).unwrap();
    let place = |x| [Vec2::new(x, 2.0), Vec2::new(x + 2.0, 4.0)];
    assert_eq!(scenario.slide().unwrap().goals[2], Goal::Together { places: [place(1.0), place(5.0)] });
    let bad = [
        ("[5.0, 2.0]", "[2.0, 2.0]", "slide.goal.2.together.1: overlaps the other box"),
        ("[5.0, 2.0]", "[8.0, 2.0]", "slide.goal.2.together.1: not a box in the room"),
        ("player-2", "another", "slide.goal.2.together: one plays alone"),
        ("together", "count = 2\ntogether", "slide.goal.2.count: does not go with `together`"),
        ("together", "digested = \"coccus\"\ntogether", "slide.goal.2.digested: does not go with `together`"),
    ];
    for (from, to, expected) in bad {
        let problem = Scenario::parse(&slide_for_two().replacen(from, to, 1), &[]).unwrap_err().to_string();
        assert!(problem.contains(expected), "{from} -> {to}: {problem}");
    }
}

/// What is changed in the slide, to what, and words of the refusal.
const BAD_SLIDES: [(&str, &str, &str); 16] = [
    ("player = true", "", "slide: nobody plays"),
    ("time = 60.0", "time = 0.5", "slide.time: 0.5 is out of range (accepted: 1 to 3600)"),
    ("time = 60.0", "", "missing field `time`"),
    ("[20.0, 40.0]", "[50.0, 40.0]", "slide.stars"),
    ("[20.0, 40.0]", "[50.0, 70.0]", "slide.stars"),
    ("[1.0, 2.0]", "[5.0, 2.0]", "slide.goal.0.reach: not a box in the room"),
    ("\"coccus\"", "\"cocus\"", "slide.goal.1.digested"),
    ("count = 3\n[slide]", "count = 2\n[slide]", "slide.goal.1.digested: 3 wanted, 2 spawned"),
    ("\"coccus\"", "\"bacillus\"", "slide.goal.1.digested: 3 wanted, 0 spawned"),
    ("\"coccus\"\ncount = 3", "\"coccus\"\ncount = 0", "slide.goal.1.count: 0 is out of range (accepted: 1 to 1000)"),
    ("\"coccus\"\ncount = 3", "\"coccus\"\nreach = [[1.0, 2.0], [3.0, 4.0]]", "does not go with `reach`"),
    ("digested = \"coccus\"", "", "slide.goal.1: nothing to do"),
    ("4.0]]", "4.0]]\ncount = 2", "slide.goal.0.count: does not go with `reach`"),
    ("title", "titel", "titel"),
    ("\"Go.\"", "\"\"", "slide.task: 0 characters"),
    ("[slide]", "[game]\n[slide]", "does not go with [game]"),
];

#[test]
fn a_bad_slide_is_refused() {
    let slide = slide();
    for (from, to, expected) in BAD_SLIDES {
        let problem = Scenario::parse(&slide.replacen(from, to, 1), &[]).unwrap_err().to_string();
        assert!(problem.contains(expected), "{from} -> {to}: {problem}");
    }
    let long = slide.replace("Cells crawl.", &"word ".repeat(41));
    assert!(Scenario::parse(&long, &[]).unwrap_err().to_string().contains("slide.fact: 41 words"));
    let idle = slide.split("[[slide.goal]]").next().unwrap_or_default();
    assert!(Scenario::parse(idle, &[]).unwrap_err().to_string().contains("slide.goal: nothing to do"));
}

#[test]
fn tiers_share_a_place_and_what_holds_fluid_has_none() {
    let crowd = "[[spawn]]\nof = 'a'\ntier = 0\ncount = 200\n[[spawn]]\nof = 'a'\ntier = 1\ncount = 200\n";
    let world = with(crowd).build().unwrap().world;
    let discs = discs(&world);
    let overlap = |(k, &(a, _)): (usize, &(Vec2, f32))| discs[k + 1..].iter().any(|&(b, _)| (a - b).length() < 1.0);
    assert_eq!(discs.len(), 400);
    assert!(discs.iter().enumerate().filter(|&pair| overlap(pair)).count() > 20);
    let refused = |extra: &str| Scenario::parse(&format!("{ROOM}{extra}"), &[]).unwrap_err().to_string();
    let message = refused("[amoeboid_cell.b]\nradii = [5, 5]\n[[spawn]]\nof = 'b'\nat = [20, 20]\ntier = 1\n");
    assert!(message.contains("what holds fluid meets everything"), "{message}");
    assert!(refused("[[spawn]]\nof = 'a'\nat = [20, 20]\ntier = 32\n").contains("32 is out of range"));
}

#[test]
fn who_is_damped_besides_the_medium_is_told_so_and_not_more_than_substeps_carry() {
    let room = with("[[spawn]]\nof = 'a'\nat = [20, 20]\nlinear_damping = 2.5\nangular_damping = 1\nfrom = 0.1\n");
    let mut built = room.build().unwrap();
    (0..10).for_each(|_| built.step(&crate::Inputs::new()));
    let damped = |organism: crate::OrganismView<'_>| (organism.linear_damping(), organism.angular_damping());
    assert_eq!(built.world.view().organisms().map(damped).last(), Some((2.5, 1.0)));
    let refused = Scenario::parse(&format!("{ROOM}[[spawn]]\nof = 'a'\nat = [20, 20]\nangular_damping = 25\n"), &[]);
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("angular_damping") && message.contains("24.0 with 8 substeps"), "{message}");
}

#[test]
fn a_medium_kicks_as_stokes_and_einstein_say() {
    use crate::FieldKind;
    let mobility = |extra: &str| {
        let world = with(extra).build().unwrap().world;
        world.fields().next().map(|(_, field)| match field.kind {
            FieldKind::Thermal { mobility } => mobility,
            _ => panic!("not thermal"),
        })
    };
    assert_eq!(mobility(""), None);
    assert_eq!(mobility("[medium]\ntime_lapse = 0.0\n"), None);
    // In water of 20 degrees.
    let water = mobility("[medium]\nviscosity = 1.002\n").unwrap();
    assert!((water - 0.2143).abs() < 0.0005, "{water}");
    let plasma = mobility("[medium]\ntemperature = 37.0\nviscosity = 1.2\ntime_lapse = 8.0\n").unwrap();
    assert!((plasma - 8.0 * 0.1893).abs() < 0.002, "{plasma}");
}
