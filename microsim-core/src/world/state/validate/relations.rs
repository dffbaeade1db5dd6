//! Relations of organisms: meals, holders, gates, exempt pairs, touching pairs.

use super::{Check, Subject};
use crate::capability::phagocytosis::{Engulfer, Meal, MealPhase, PreyClass};
use crate::geometry::polygon::contains_point;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::world::World;

pub(super) fn check(world: &World) -> Check {
    for (id, organism) in world.organisms.iter() {
        let cell = Subject::organism(id, organism.kind);
        if let Some(engulfer) = &organism.engulfer {
            check_engulfer(world, id, organism, engulfer, cell)?;
        }
        check_held(world, id, organism, cell)?;
        check_phagosomes(organism, cell)?;
    }
    check_gates(world)?;
    check_pairs(world)
}

/// Whether prey is alive and not frozen. The next step removes the meals of other prey.
fn is_alive(world: &World, prey: OrganismId) -> bool {
    world.organisms.get(prey).is_some_and(|prey| !prey.is_quarantined)
}

fn check_engulfer(world: &World, id: OrganismId, organism: &Organism, engulfer: &Engulfer, cell: Subject) -> Check {
    let meals = &engulfer.meals;
    cell.must(meals.is_empty() || !organism.is_quarantined, || "it is in quarantine and holds prey".to_owned())?;
    for (k, meal) in meals.iter().enumerate() {
        let prey = meal.prey.index;
        cell.must(meal.prey != id, || "it is its own prey".to_owned())?;
        cell.must(meals[..k].iter().all(|other| other.prey != meal.prey), || format!("prey {prey} is named twice"))?;
        check_gate(meal, cell)?;
        if is_alive(world, meal.prey) {
            check_meal(world, id, organism, meal, cell)?;
        }
    }
    let is_taken = |meal: &&Meal| meal.class == PreyClass::Soft && !matches!(meal.phase, MealPhase::Touching(_));
    let soft = meals.iter().filter(is_taken).count();
    cell.must(soft <= 1, || format!("{soft} soft prey in the one place for it"))
}

fn check_gate(meal: &Meal, cell: Subject) -> Check {
    let prey = meal.prey.index;
    cell.must(meal.is_in_gate() || meal.gate.is_empty(), || format!("a gate for prey {prey} that does not pass one"))
}

/// Prey names its holder, and lies inside if its meal is.
fn check_meal(world: &World, id: OrganismId, organism: &Organism, meal: &Meal, cell: Subject) -> Check {
    let Some(prey) = world.organisms.get(meal.prey) else { return Ok(()) };
    let index = meal.prey.index;
    if prey.is_cell() && matches!(meal.phase, MealPhase::Touching(_)) {
        return Ok(());
    }
    let Some(state) = prey.prey else {
        return Err(cell.violation(format!("its prey {index} cannot be taken in")));
    };
    cell.must(state.class == meal.class, || format!("prey {index} is of another class"))?;
    if matches!(meal.phase, MealPhase::Touching(_)) {
        return Ok(());
    }
    cell.must(state.held_by == Some(id), || format!("prey {index} is held by {:?}", state.held_by))?;
    let mut gate = meal.gate.iter();
    let is_own = gate.all(|&node| world.particles.owner.get(node as usize) == Some(&id.index));
    cell.must(is_own, || format!("the gate for prey {index} has nodes of another"))?;
    cell.must(!world.exemptions.contains(id.index, index), || format!("its prey {index} is exempt from its membrane"))?;
    if meal.phase.is_inside() && world.config.protects_membranes {
        let is_inside = contains_point(&world.outline_of(organism), world.centre_of(prey));
        cell.must(is_inside, || format!("its prey {index} is no longer inside"))?;
    }
    if meal.phase.is_inside() && prey.is_cell() && world.config.protects_membranes {
        check_held_cell(world, organism, prey, cell)?;
    }
    Ok(())
}

/// A cell that another one holds lies wholly inside it.
fn check_held_cell(world: &World, holder: &Organism, held: &Organism, cell: Subject) -> Check {
    let outline = world.outline_of(holder);
    let is_out = |&i: &u32| !contains_point(&outline, world.particles.position(i as usize));
    let out = held.particles().filter(is_out).count();
    cell.must(out == 0, || format!("{out} particles of a cell that it holds are outside"))
}

/// Held prey is a meal of its holder.
fn check_held(world: &World, id: OrganismId, organism: &Organism, cell: Subject) -> Check {
    let Some(holder) = organism.prey.and_then(|prey| prey.held_by) else {
        return cell
            .must(organism.prey.is_none() || !organism.is_cell(), || "it is prey, and nobody holds it".to_owned());
    };
    cell.must(!organism.is_cell() || organism.meals().is_empty(), || "it is held and holds prey".to_owned())?;
    cell.must(organism.furrow().is_none(), || "it is held and divides".to_owned())?;
    let engulfer = world.organisms.get(holder).and_then(|holder| holder.engulfer.as_ref());
    let meal = engulfer.and_then(|engulfer| engulfer.meals.iter().find(|meal| meal.prey == id));
    let is_held = meal.is_some_and(|meal| !matches!(meal.phase, MealPhase::Touching(_)));
    cell.must(is_held, || format!("it is held by {}, which does not hold it", holder.index))
}

/// Each phagosome holds one prey that is inside.
fn check_phagosomes(organism: &Organism, cell: Subject) -> Check {
    if organism.is_quarantined {
        return Ok(());
    }
    for (k, inner) in organism.phagosomes.iter().enumerate() {
        let mut inside = organism.meals().iter().filter(|meal| meal.prey == inner.prey && meal.phase.is_inside());
        let is_only = organism.phagosomes[..k].iter().all(|other| other.prey != inner.prey);
        let prey = inner.prey.index;
        cell.must(inside.next().is_some() && is_only, || format!("a phagosome for prey {prey} that is not in it"))?;
    }
    Ok(())
}

/// Gates are open for the prey that passes them only.
fn check_gates(world: &World) -> Check {
    let meals = world.organisms.iter().flat_map(|(_, organism)| organism.meals());
    let meals = meals.filter(|meal| world.organisms.get(meal.prey).is_some());
    let mut gates: Vec<(u32, u32)> =
        meals.flat_map(|meal| meal.gate.iter().map(|&node| (node, meal.prey.index))).collect();
    gates.sort_unstable();
    let open = world.exemptions.gates();
    Subject::default().must(gates == open, || format!("gates open for {open:?}, asked for {gates:?}"))
}

/// Exempt organisms are alive; touching pairs are listed once, by handles that exist or existed.
fn check_pairs(world: &World) -> Check {
    let none = Subject::default();
    let pairs = world.exemptions.pairs();
    none.must(pairs.is_sorted_by(|a, b| a < b), || "exempt pairs are not in order".to_owned())?;
    let lives = |index: u32| world.organisms.id_at(index).is_some();
    let dead = pairs.iter().find(|&&(a, b)| a >= b || !lives(a) || !lives(b));
    dead.map_or(Ok(()), |(a, b)| Err(none.violation(format!("{a} and {b} are exempt and do not both live"))))?;
    let touching = world.touching.pairs();
    none.must(touching.is_sorted_by(|a, b| a < b), || "touching pairs are not in order".to_owned())?;
    let was_given = |id: OrganismId| world.organisms.generation(id.index).is_some_and(|now| id.generation <= now);
    let wrong = touching.iter().find(|(a, b)| a.index >= b.index || !was_given(*a) || !was_given(*b));
    wrong.map_or(Ok(()), |pair| Err(none.violation(format!("{pair:?} touch, which are not two organisms"))))
}

#[cfg(test)]
mod tests;
