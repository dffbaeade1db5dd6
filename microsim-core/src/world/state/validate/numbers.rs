//! Numbers: every one is finite and within its range, so that no step makes anything else of them. Worlds from files have to
//! pass.

use super::{Check, Subject};
use crate::capability::phagocytosis::{Engulfer, Meal, MealPhase};
use crate::config::WorldConfig;
use crate::organism::{self, MAX_SPEED, MOST, Organism};
use crate::particle::{CollisionGroups, GRID};
use crate::rng::Rng;
use crate::solver::fluid::Fluid;
use crate::solver::membrane::Membrane;
use crate::world::World;
use crate::world::scale::{LARGEST, SCALES};
use glam::Vec2;

/// Largest coordinate, units: quarantine freezes organisms farther from the room than the room's size.
const FARTHEST: f32 = 3.0 * WorldConfig::MAX_SIZE;
/// Largest speed over the speed limit: impacts may exceed the limit until the next substep.
const TIMES_SPEED_LIMIT: f32 = 10.0;
/// Inverse of the largest mass: of larger ones moments overflow.
const LEAST_INV_MASS: f32 = 1e-20;
/// Largest length of a link, radius of a node and rim of a membrane, units.
const LONGEST: f32 = 1e5;
/// Largest length of a membrane, in circles around its content.
const MOST_LOBES: f32 = 3.0;

/// Checks the numbers of a world whose structure is sound.
pub(in crate::world) fn check(world: &World) -> Check {
    (0..world.particles.len()).try_for_each(|i| check_particle(world, i))?;
    world.fluids.iter().try_for_each(|fluid| check_fluid(world, fluid))?;
    for (id, organism) in world.organisms.iter() {
        let cell = Subject::organism(id, organism.kind);
        check_frozen(world, organism, cell)?;
        check_organism(organism, cell)?;
    }
    for (k, chemical) in world.chemicals.iter().enumerate() {
        let flaw = chemical.check(&world.config);
        flaw.map_err(|flaw| Subject::default().violation(format!("chemical {k}: {flaw}")))?;
    }
    Ok(())
}

fn check_particle(world: &World, i: usize) -> Check {
    let (p, disc) = (&world.particles, Subject::particle(world, i));
    for (name, column) in [("origin x", &p.origin_x), ("origin y", &p.origin_y)] {
        disc.must_range(name, column[i], -FARTHEST, FARTHEST)?;
        disc.must((column[i] / GRID).fract() == 0.0, || {
            format!("{name} is {}, must be a multiple of {GRID}", column[i])
        })?;
    }
    for (name, column) in [("x", &p.x), ("y", &p.y), ("previous x", &p.prev_x), ("previous y", &p.prev_y)] {
        disc.must_range(name, column[i], -FARTHEST, FARTHEST)?;
    }
    // A step moves the origin there, also of what is frozen or dead.
    let (at, farthest) = (p.position(i), FARTHEST - 1.0);
    disc.must_range("its place x", at.x, -farthest, farthest)?;
    disc.must_range("its place y", at.y, -farthest, farthest)?;
    let fastest = TIMES_SPEED_LIMIT * world.config.speed_limit();
    disc.must_range("velocity x", p.vx[i], -fastest, fastest)?;
    disc.must_range("velocity y", p.vy[i], -fastest, fastest)?;
    let least = if p.inv_mass[i] == 0.0 { 0.0 } else { LEAST_INV_MASS };
    disc.must_range("inverse mass", p.inv_mass[i], least, f32::MAX)?;
    disc.must_range("radius", p.radius[i], 0.0, LARGEST)?;
    disc.must_range("friction", p.material[i].friction, 0.0, 10.0)?;
    disc.must_range("restitution", p.material[i].restitution, 0.0, 1.0)
}

/// The particles of a fluid have its radius.
fn check_fluid(world: &World, fluid: &Fluid) -> Check {
    let radius = 0.5 * fluid.params.spacing;
    fluid
        .particles
        .iter()
        .map(|&i| i as usize)
        .try_for_each(|i| Subject::particle(world, i).must_range("radius", world.particles.radius[i], radius, radius))
}

/// Frozen particles are at rest.
fn check_frozen(world: &World, organism: &Organism, cell: Subject) -> Check {
    let p = &world.particles;
    for i in organism.particles() {
        let (disc, i) = (Subject { particle: Some(i), ..cell }, i as usize);
        let is_frozen = p.inv_mass[i] == 0.0 && p.velocity(i) == Vec2::ZERO && p.groups[i] == CollisionGroups::NONE;
        disc.must(is_frozen || !organism.is_quarantined, || "it is in quarantine and not frozen".to_owned())?;
    }
    Ok(())
}

fn check_organism(organism: &Organism, cell: Subject) -> Check {
    check_state(organism, cell)?;
    check_divider(organism, cell)?;
    if organism.is_quarantined {
        return Ok(());
    }
    organism.membranes().try_for_each(|(membrane, _)| check_membrane(membrane, cell))?;
    organism.phagosomes.iter().try_for_each(|inner| cell.must_range("area of a phagosome", inner.area, 0.0, MOST))?;
    organism.engulfer.as_ref().map_or(Ok(()), |engulfer| check_engulfer(engulfer, cell))
}

fn check_state(organism: &Organism, cell: Subject) -> Check {
    let [least, most] = SCALES;
    cell.must_range("speed", organism.speed, 0.0, MAX_SPEED)?;
    // Only of a template of the embedder's own the outline may turn the other way.
    let is_cell = organism.divider.is_some() && organism.body.membrane().is_some();
    let is_sized = organism.prey.is_some() || is_cell;
    cell.must_range("spawn area", organism.spawn_area, if is_sized { 0.0 } else { -MOST }, MOST)?;
    cell.must_range("spawn scale", organism.spawn_scale, least, most)?;
    cell.must_range("home x", organism.home.x, -organism::FARTHEST, organism::FARTHEST)?;
    cell.must_range("home y", organism.home.y, -organism::FARTHEST, organism::FARTHEST)?;
    cell.must_range("full scale", organism.full_scale, 0.1, 10.0)?;
    let crawls = organism.locomotion.pseudopods().map(|pseudopods| &pseudopods.rng);
    let are_sound = crawls.into_iter().chain([&organism.rng]).all(Rng::is_sound);
    cell.must(are_sound, || "the increment of its random numbers is even".to_owned())?;
    let goal = organism.goal;
    cell.must(goal.is_none_or(Vec2::is_finite), || format!("goal {goal:?}"))
}

fn check_divider(organism: &Organism, cell: Subject) -> Check {
    let Some(divider) = &organism.divider else { return Ok(()) };
    cell.must_range("lobes", divider.lobes, 1.0, MOST_LOBES)?;
    divider.nodes_per_root.map_or(Ok(()), |nodes| cell.must_range("nodes per root", nodes, 0.0, MOST))?;
    let Some(furrow) = divider.furrow else { return Ok(()) };
    cell.must_range("width of its furrow", furrow.width, 0.0, MOST)?;
    cell.must_range("age of its furrow", furrow.elapsed, 0.0, MOST)
}

fn check_membrane(membrane: &Membrane, cell: Subject) -> Check {
    let names = ["rest length", "node radius", "rim", "activity", "rest perimeter"];
    let mut named = names.into_iter().zip(membrane.state()).zip([LONGEST, LONGEST, LONGEST, 1.0, MOST]);
    named.try_for_each(|((name, value), most)| cell.must_range(&format!("{name} of its membrane"), value, 0.0, most))
}

fn check_engulfer(engulfer: &Engulfer, cell: Subject) -> Check {
    for (name, value) in [
        ("area held", engulfer.held_area),
        ("length of folds", engulfer.fold_length),
        ("area digested", engulfer.pending_growth),
    ] {
        cell.must_range(name, value, 0.0, MOST)?;
    }
    engulfer.meals.iter().try_for_each(|meal| check_meal(meal, cell))
}

fn check_meal(meal: &Meal, cell: Subject) -> Check {
    let prey = meal.prey.index;
    match meal.phase {
        MealPhase::Touching(time) => cell.must_range(&format!("time of touching {prey}"), time, 0.0, MOST),
        MealPhase::Ingesting(time) => cell.must_range(&format!("time of taking in {prey}"), time, 0.0, MOST),
        MealPhase::Ingested => Ok(()),
        MealPhase::Digesting(part) => cell.must_range(&format!("digested part of {prey}"), part, 0.0, 1.0),
    }
}
