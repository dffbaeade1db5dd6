//! Each kind of damage to meals in every phase is found, and named.

use crate::capability::phagocytosis::{Engulfer, Meal, MealPhase, Prey, PreyClass};
use crate::organism::{Organism, Storage};
use crate::{
    AgarSpec, AmoeboidCellSpec, IngestionWay, Inputs, Intent, OrganismId, OrganismSpec, PhagocytosisParams, Placement,
    RigidCellSpec, World, WorldConfig, glam::Vec2,
};
use serde::Deserialize;
use serde::de::{IntoDeserializer, value};

const CELL: OrganismId = OrganismId { index: 0, generation: 0 };
const PREY: OrganismId = OrganismId { index: 1, generation: 0 };
const OTHER: OrganismId = OrganismId { index: 2, generation: 0 };

/// Where a cell that heads for the right wall meets prey, and where it does not.
const AHEAD: Vec2 = Vec2::new(142.0, 45.0);
const AWAY: Vec2 = Vec2::new(40.0, 45.0);

/// A cell with two prey, at the moment when its meals are as wanted.
fn dinner(way: IngestionWay, prey: &OrganismSpec, at: [Vec2; 2], is_wanted: fn(&[Meal]) -> bool) -> World {
    let mut world = World::new(WorldConfig::default()).unwrap();
    let phagocytosis = PhagocytosisParams { way, ..PhagocytosisParams::default() };
    let spec = AmoeboidCellSpec { phagocytosis, ..AmoeboidCellSpec::default() };
    let cell = world.spawn(&spec.into(), Placement::at(128.0, 45.0)).unwrap();
    let [first, second] = at.map(|at| world.spawn(prey, Placement::at(at.x, at.y)).unwrap());
    assert_eq!([cell, first, second], [CELL, PREY, OTHER]);
    let mut inputs = Inputs::new();
    inputs.set(CELL, Intent::toward(Vec2::new(170.0, 45.0)).unwrap());
    let is_there = (0..900).any(|_| {
        world.step(&inputs);
        is_wanted(&engulfer(&mut world).meals)
    });
    assert!(is_there, "{:?}", engulfer(&mut world).meals);
    assert_eq!(world.validate(), Ok(()));
    world
}

/// Agar is touched; another is free.
fn touching() -> World {
    let is_touched = |meals: &[Meal]| meals.iter().any(|meal| matches!(meal.phase, MealPhase::Touching(_)));
    dinner(IngestionWay::Cup, &AgarSpec::default().into(), [AHEAD, AWAY], is_touched)
}

/// Agar passes a gate; another is free.
fn at_the_gate() -> World {
    let has_gate = |meals: &[Meal]| meals.iter().any(|meal| !meal.gate.is_empty());
    dinner(IngestionWay::Gate, &AgarSpec::default().into(), [AHEAD, AWAY], has_gate)
}

/// A cup closes around soft prey; another is free.
fn in_a_cup() -> World {
    let soft = RigidCellSpec { radii: Vec2::new(5.0, 3.2), ..RigidCellSpec::default() };
    let ahead = AHEAD + Vec2::new(4.0, 0.0);
    dinner(IngestionWay::Cup, &soft.into(), [ahead, AWAY], |meals| meals.iter().any(Meal::is_in_cup))
}

/// Two pieces of agar are inside, in a phagosome each.
fn two_inside() -> World {
    let small = AgarSpec { radius: 0.8, ..AgarSpec::default() };
    let at = [-4.0, 4.0].map(|y| AHEAD + Vec2::new(0.0, y));
    let are_inside = |meals: &[Meal]| meals.iter().filter(|meal| meal.phase.is_inside()).count() == 2;
    dinner(IngestionWay::Cup, &small.into(), at, are_inside)
}

/// A cell is in a wide gate, half of it inside; another is free.
fn cell_at_the_gate() -> World {
    let prey = AmoeboidCellSpec { radii: Vec2::splat(5.0), ..AmoeboidCellSpec::default() };
    let is_half_in =
        |meals: &[Meal]| meals.iter().any(|meal| matches!(meal.phase, MealPhase::Ingesting(time) if time > 0.7));
    dinner(IngestionWay::WideGate, &prey.into(), [AHEAD + Vec2::new(4.0, 0.0), AWAY], is_half_in)
}

fn organism(world: &mut World, id: OrganismId) -> &mut Organism {
    world.organisms.get_mut(id).unwrap()
}

fn engulfer(world: &mut World) -> &mut Engulfer {
    organism(world, CELL).engulfer.as_mut().unwrap()
}

fn meal(world: &mut World) -> &mut Meal {
    &mut engulfer(world).meals[0]
}

fn hold(world: &mut World, id: OrganismId, holder: Option<OrganismId>) {
    organism(world, id).prey.as_mut().unwrap().held_by = holder;
}

/// Moves the first prey, which is one disc.
fn take_away(world: &mut World) {
    let disc = organism(world, PREY).particles().next().unwrap();
    world.particles.x[disc as usize] -= 40.0;
}

/// Damages a sound world and expects these words in what validation says.
fn finds(world: &World, damage: impl Fn(&mut World), words: &str) {
    let mut world = world.clone();
    damage(&mut world);
    let violation = world.validate().expect_err(words).to_string();
    assert!(violation.contains(words), "`{violation}` instead of `{words}`");
}

#[test]
fn damage_to_what_an_engulfer_remembers_is_found() {
    let world = touching();
    finds(&world, |w| engulfer(w).held_area = f32::NAN, "amoeboid_cell 0 (generation 0): area held is NaN");
    finds(&world, |w| engulfer(w).fold_length = -1.0, "length of folds is -1");
    finds(&world, |w| engulfer(w).pending_growth = f32::INFINITY, "area digested is inf");
    finds(&world, |w| meal(w).prey = CELL, "it is its own prey");
    finds(
        &world,
        |w| {
            let again = meal(w).clone();
            engulfer(w).meals.push(again);
        },
        "prey 1 is named twice",
    );
    finds(&world, |w| meal(w).phase = MealPhase::Touching(f32::NAN), "time of touching 1 is NaN");
    finds(&world, |w| meal(w).class = PreyClass::Bacterium, "prey 1 is of another class");
    finds(&world, |w| organism(w, PREY).prey = None, "its prey 1 cannot be taken in");
}

#[test]
fn a_frozen_cell_that_holds_prey_is_found() {
    let freeze = |w: &mut World| {
        let meals = engulfer(w).meals.clone();
        let node = organism(w, CELL).outline[0] as usize;
        w.particles.x[node] = f32::NAN;
        w.step(&Inputs::new());
        assert_eq!(w.validate(), Ok(()));
        engulfer(w).meals = meals;
    };
    finds(&touching(), freeze, "it is in quarantine and holds prey");
}

#[test]
fn prey_that_nobody_holds_as_it_says_is_found() {
    let world = touching();
    let words = "agar 1 (generation 0): it is held by 0, which does not hold it";
    finds(&world, |w| hold(w, PREY, Some(CELL)), words);
    finds(&world, |w| hold(w, OTHER, Some(CELL)), "it is held by 0, which does not hold it");
    finds(&world, |w| hold(w, OTHER, Some(PREY)), "it is held by 1, which does not hold it");
    let gone = OrganismId { index: 9, generation: 0 };
    finds(&world, |w| hold(w, OTHER, Some(gone)), "it is held by 9, which does not hold it");
}

#[test]
fn damage_to_gates_is_found() {
    let world = at_the_gate();
    finds(&world, |w| hold(w, PREY, None), "prey 1 is held by None");
    finds(&world, |w| hold(w, PREY, Some(OTHER)), "prey 1 is held by Some");
    finds(&world, |w| meal(w).phase = MealPhase::Ingested, "a gate for prey 1 that does not pass one");
    finds(&world, |w| meal(w).way = IngestionWay::Cup, "a gate for prey 1 that does not pass one");
    finds(
        &world,
        |w| {
            let disc = organism(w, OTHER).particles().next().unwrap();
            meal(w).gate.push(disc);
        },
        "the gate for prey 1 has nodes of another",
    );
    finds(&world, |w| _ = meal(w).gate.pop(), "gates open for");
    finds(
        &world,
        |w| {
            let nodes = meal(w).gate.clone();
            w.exemptions.close_gate(&nodes, PREY.index);
        },
        "gates open for [], asked for",
    );
}

#[test]
fn damage_to_cells_that_cells_hold_is_found() {
    let world = cell_at_the_gate();
    finds(&world, |w| organism(w, PREY).prey = None, "its prey 1 cannot be taken in");
    let is_free = Some(Prey { class: PreyClass::Soft, held_by: None });
    finds(&world, |w| organism(w, OTHER).prey = is_free, "it is prey, and nobody holds it");
    let eats = |w: &mut World| {
        let (phase, gate) = (MealPhase::Touching(0.0), Vec::new());
        let other = Meal { prey: OTHER, phase, gate, ..meal(w).clone() };
        organism(w, PREY).engulfer.as_mut().unwrap().meals.push(other);
    };
    finds(&world, eats, "it is held and holds prey");
    let sinks = |w: &mut World| {
        let at = w.centroid(PREY).unwrap();
        let disc = organism(w, CELL).fluid_particles[0] as usize;
        let by = at - w.particles.position(disc);
        (w.particles.x[disc], w.particles.y[disc]) = (w.particles.x[disc] + by.x, w.particles.y[disc] + by.y);
    };
    let words = "it has leaked into a cell that its own holds";
    // It may be outside its own membrane there.
    let mut inside = world.clone();
    sinks(&mut inside);
    let found = inside.validate().unwrap_err().to_string();
    assert!(found.contains(words) || found.contains("it has leaked out of its membrane"), "{found}");
    assert_eq!((world.census().leaks, inside.census().leaks), (0, 1));
    let is_taken_for_inside = |w: &mut World| {
        let gate = std::mem::take(&mut meal(w).gate);
        w.exemptions.close_gate(&gate, PREY.index);
        meal(w).phase = MealPhase::Ingested;
        // The first node, which stands for its place, is the innermost one.
        let nodes = organism(w, PREY).outline.clone();
        let x = |node: &u32| w.particles.position(*node as usize).x;
        let innermost = nodes.iter().copied().min_by(|a, b| x(a).total_cmp(&x(b))).unwrap();
        if let Storage::Loose { particles, .. } = &mut organism(w, PREY).body {
            let place = particles.iter().position(|&node| node == innermost).unwrap();
            particles.rotate_left(place);
        }
    };
    finds(&world, is_taken_for_inside, "particles of a cell that it holds are outside");
}

#[test]
fn damage_to_soft_prey_on_its_way_in_is_found() {
    let world = in_a_cup();
    finds(&world, |w| meal(w).phase = MealPhase::Ingesting(-1.0), "time of taking in 1 is -1");
    let take_both = |w: &mut World| {
        let second = Meal { prey: OTHER, ..meal(w).clone() };
        engulfer(w).meals.push(second);
        hold(w, OTHER, Some(CELL));
    };
    finds(&world, take_both, "2 soft prey in the one place for it");
}

#[test]
fn damage_to_prey_inside_and_to_phagosomes_is_found() {
    let world = two_inside();
    finds(&world, |w| meal(w).phase = MealPhase::Digesting(1.5), "is 1.5, must be 0 to 1");
    finds(&world, take_away, "its prey 1 is no longer inside");
    finds(&world, |w| organism(w, CELL).phagosomes[0].area = f32::NAN, "area of a phagosome is NaN");
    let in_none = "a phagosome for prey";
    finds(&world, |w| organism(w, CELL).phagosomes[0].prey = CELL, in_none);
    finds(
        &world,
        |w| {
            let cell = organism(w, CELL);
            cell.phagosomes[1].prey = cell.phagosomes[0].prey;
        },
        in_none,
    );
    let share_a_node = |w: &mut World| {
        let cell = organism(w, CELL);
        cell.phagosomes[1].ring[0] = cell.phagosomes[0].ring[0];
    };
    finds(&world, share_a_node, "a phagosome is not of its own particles");
    let let_out = |w: &mut World| {
        meal(w).phase = MealPhase::Touching(0.0);
        let prey = meal(w).prey;
        hold(w, prey, None);
    };
    finds(&world, let_out, in_none);
}

#[test]
fn prey_that_is_gone_does_not_have_to_be_inside() {
    let mut world = two_inside();
    finds(&world, |w| w.exemptions.set(CELL.index, PREY.index, true), "its prey 1 is exempt from its membrane");
    world.remove(PREY).unwrap();
    assert_eq!(world.validate(), Ok(()));
    assert!(engulfer(&mut world).meals.iter().any(|meal| meal.prey == PREY), "the next step forgets it");
}

/// A table as a file may have it: the tables' own methods keep them in order.
fn read<T: Deserialize<'static>>(columns: impl IntoDeserializer<'static, value::Error>) -> T {
    T::deserialize(columns.into_deserializer()).unwrap()
}

#[test]
fn damage_to_exempt_and_touching_pairs_is_found() {
    let world = touching();
    let exempt = |pairs: &[[u32; 2]], words: &str| {
        let pairs: Vec<Vec<u32>> = pairs.iter().map(|pair| pair.to_vec()).collect();
        finds(&world, |w| w.exemptions = read(vec![pairs.clone(), Vec::new()]), words);
    };
    exempt(&[[1, 2], [0, 1]], "exempt pairs are not in order");
    exempt(&[[0, 1], [0, 1]], "exempt pairs are not in order");
    exempt(&[[1, 0]], "1 and 0 are exempt and do not both live");
    exempt(&[[0, 9]], "0 and 9 are exempt and do not both live");
    // Each organism is an index and a generation.
    let touch = |pairs: &[[[u32; 2]; 2]], words: &str| {
        let pairs: Vec<Vec<Vec<u32>>> = pairs.iter().map(|pair| pair.map(|id| id.to_vec()).to_vec()).collect();
        finds(&world, |w| w.touching = read(vec![pairs.clone()]), words);
    };
    touch(&[[[1, 0], [2, 0]], [[0, 0], [1, 0]]], "touching pairs are not in order");
    touch(&[[[0, 0], [1, 0]], [[0, 0], [1, 0]]], "touching pairs are not in order");
    touch(&[[[1, 0], [0, 0]]], "touch, which are not two organisms");
    touch(&[[[1, 0], [1, 0]]], "touch, which are not two organisms");
    touch(&[[[0, 0], [9, 0]]], "touch, which are not two organisms");
    touch(&[[[0, 0], [1, 1]]], "touch, which are not two organisms");
}
