//! Structure that stepping relies on: indices are valid, every particle has one owner, parameters are in their ranges. A world
//! that passes may be unphysical, but cannot make a step panic; worlds from files have to pass.

use super::{Check, Subject, Violation};
use crate::capability::Locomotion;
use crate::capability::division::Divider;
use crate::error::Error;
use crate::id::TemplateId;
use crate::joint::JointEnd;
use crate::kind::Kind;
use crate::organism::ring_surgery::LEAST_NODES;
use crate::organism::{MOST_WANTED_NODES, Organism, Phagosome, Storage};
use crate::particle::{CollisionGroups, NO_OWNER};
use crate::solver::block::Block;
use crate::solver::constraint::TORN;
use crate::solver::lanes::LANES;
use crate::world::scale::SCALES;
use crate::world::{Guard, MOST_COUNTED, World};
use glam::Vec2;

/// Owner of an empty lane, as opposed to a free index.
const EMPTY_LANE: u32 = NO_OWNER - 1;

/// Checks the structure of a world whose columns have equal lengths.
pub(in crate::world) fn check(world: &World) -> Check {
    let Guard { wrong_side, net_fired } = world.guard;
    let is_counter = |count: u64| count <= MOST_COUNTED;
    let none = Subject::default();
    none.must([world.step_index, wrong_side, net_fired].into_iter().all(is_counter), || {
        "a counter is too large".to_owned()
    })?;
    check_slots(world)?;
    let mut owned = vec![NO_OWNER; world.particles.len()];
    check_blocks(world, &mut owned)?;
    for (id, organism) in world.organisms.iter() {
        let cell = Subject::organism(id, organism.kind);
        check_organism(world, organism, cell)?;
        claim(world, id.index, organism, cell, &mut owned)?;
    }
    check_fluids(world)?;
    check_joints(world)?;
    check_fields(world)?;
    check_supplies(world)?;
    check_particles(world, &owned)
}

/// Force fields have numbers in their ranges.
fn check_fields(world: &World) -> Check {
    let none = Subject::default();
    none.must(world.fields.is_sound(), || "the free slots of force fields are not the empty ones".to_owned())?;
    for ((k, _), field) in world.fields.iter() {
        field.validate().map_err(|error| none.violation(format!("fields[{k}]: {error}")))?;
    }
    Ok(())
}

/// Emitters and drains have numbers in their ranges, and emit what the world knows.
fn check_supplies(world: &World) -> Check {
    let none = Subject::default();
    let is_sound = world.emitters.is_sound() && world.drains.is_sound();
    none.must(is_sound, || "the free slots of emitters or drains are not the empty ones".to_owned())?;
    for ((k, _), record) in world.emitters.iter() {
        let checked = world.check_emitter(&record.emitter);
        checked.map_err(|error| none.violation(format!("emitters[{k}]: {error}")))?;
        none.must_range(&format!("debt of emitter {k}"), record.owed, 0.0, 1.0)?;
        none.must(record.rng.is_sound(), || format!("the increment of emitter {k}'s random numbers is even"))?;
    }
    for ((k, _), drain) in world.drains.iter() {
        drain.validate().map_err(|error| none.violation(format!("drains[{k}]: {error}")))?;
    }
    Ok(())
}

/// Joints have numbers in their ranges and particles that exist. The next step removes those that have lost an end.
fn check_joints(world: &World) -> Check {
    let none = Subject::default();
    none.must(world.joints.is_sound(), || "the free slots of joints are not the empty ones".to_owned())?;
    for ((k, _), joint) in world.joints.iter() {
        let checked =
            joint.spec.check(&world.config).and_then(|()| world.check_joint_period(&joint.spec, joint.length));
        checked.map_err(|error| none.violation(format!("joints[{k}]: {error}")))?;
        none.must_range(&format!("length of joint {k}"), joint.length, 0.0, f32::MAX)?;
        none.must_range(&format!("force of joint {k}"), joint.force, 0.0, f32::INFINITY)?;
        let is_node = [joint.spec.a, joint.spec.b].map(|end| matches!(end, JointEnd::Node { .. }));
        let is_found = joint.particles.map(|particle| particle.is_some());
        let exist = joint.particles.iter().flatten().all(|&i| (i as usize) < world.particles.len());
        let is_lost = is_found == [false; 2];
        none.must((is_lost || is_node == is_found) && exist, || {
            format!("joint {k} holds a particle that it cannot hold")
        })?;
    }
    Ok(())
}

/// The free slots of organisms are exactly the empty ones.
fn check_slots(world: &World) -> Check {
    Subject::default()
        .must(world.organisms.is_sound(), || "the free slots of organisms are not the empty ones".to_owned())
}

/// Blocks fit their template and do not overlap. Records the owners of their lanes in `owned`.
fn check_blocks(world: &World, owned: &mut [u32]) -> Check {
    let none = Subject::default();
    let (blocks, known) = (world.blocks.len(), world.sleep.len());
    none.must(blocks == known, || format!("{blocks} blocks, but sleep counters of {known}"))?;
    let mut end = 0;
    for (k, block) in world.blocks.iter().enumerate() {
        let template = world.templates.get(block.template as usize);
        let slots = template.map_or(0, |template| template.nodes().len());
        let (first, after) = (block.base as usize, block.base as usize + slots * LANES);
        let fits = slots > 0 && slots == block.slots as usize && first >= end && after <= owned.len();
        none.must(fits, || {
            format!("block {k} lies at {first}, where {} slots of template {} do not", block.slots, block.template)
        })?;
        let rows = template.map_or(0, |template| template.rest_state().len());
        none.must(rows == block.length_state.len(), || {
            format!("block {k} has not the channels and links of its template")
        })?;
        for (lane, &owner) in block.owner.iter().enumerate() {
            check_lane(world, k, block, lane)?;
            let owner = if owner == NO_OWNER { EMPTY_LANE } else { owner };
            (0..block.slots).for_each(|slot| owned[block.particle(slot, lane) as usize] = owner);
        }
        end = after;
    }
    Ok(())
}

/// A lane has numbers in their ranges and an owner that lies in it, or none.
fn check_lane(world: &World, k: usize, block: &Block, lane: usize) -> Check {
    let (organisms, none, owner) = (&world.organisms, Subject::default(), block.owner[lane]);
    let [least, most] = SCALES;
    none.must_range(&format!("scale of lane {lane} of block {k}"), block.scale[lane], least, most)?;
    let Some(template) = world.templates.get(block.template as usize) else { return Ok(()) };
    for contraction in &block.length_state[..template.channels().len()] {
        none.must_range(&format!("contraction in lane {lane} of block {k}"), contraction[lane], 0.099, 10.1)?;
    }
    for (link, scaled) in template.yielding_links() {
        let plastic = scaled.link.map_or(0.0, |row| block.length_state[row as usize][lane]);
        let [least, most] = link.bounds();
        none.must(plastic == TORN || (least..=most).contains(&plastic), || {
            format!("plastic strain {plastic} in lane {lane} of block {k}")
        })?;
    }
    let holder = organisms.id_at(owner).and_then(|id| organisms.get(id));
    let place = holder.and_then(|organism| match organism.body {
        Storage::Lane { block, first } => Some((block as usize, first)),
        Storage::Loose { .. } => None,
    });
    let is_home = owner == NO_OWNER || place == Some((k, block.particle(0, lane)));
    none.must(is_home, || format!("lane {lane} of block {k} is owned by {owner}, which does not know"))
}

/// Fields of an organism.
fn check_organism(world: &World, organism: &Organism, cell: Subject) -> Check {
    let (nodes, membrane) = (organism.outline.len(), organism.body.membrane());
    let in_outline = |k: u32| (k as usize) < nodes;
    let can_move = match organism.locomotion {
        Locomotion::None | Locomotion::Tow { .. } | Locomotion::Propel { .. } => true,
        Locomotion::FrontPull { front } => in_outline(front),
        Locomotion::Crawl { front_centre } => membrane.is_some() && front_centre.is_none_or(in_outline),
        Locomotion::Protrude(ref pseudopods) => {
            membrane.is_some() && pseudopods.is_sound(nodes) && pseudopods.front_centre.is_none_or(in_outline)
        }
    };
    cell.must(can_move, || format!("it cannot move so with {nodes} nodes: {:?}", organism.locomotion))?;
    let divides = world.divides(organism);
    let needs_membrane =
        organism.engulfer.is_some() || organism.divider.is_some() && !divides || !organism.phagosomes.is_empty();
    cell.must(membrane.is_some() || !needs_membrane, || "it lacks a membrane".to_owned())?;
    let is_ring = |inner: &Phagosome| inner.ring.len() >= LEAST_NODES;
    let are_rings = (membrane.is_none() || nodes >= LEAST_NODES) && organism.phagosomes.iter().all(is_ring);
    cell.must(are_rings, || "a ring of too few nodes".to_owned())?;
    cell.must_range("gravity scale", organism.gravity_scale, -100.0, 100.0)?;
    check_kind(world, organism, cell)?;
    cell.must(!divides || organism.divider.as_ref().is_some_and(Divider::is_of_body), || {
        "it does not divide as its template says".to_owned()
    })?;
    let may_have_fluid = matches!(organism.body, Storage::Loose { .. }) || organism.fluid.is_none();
    cell.must(may_have_fluid, || "a body in lanes has fluid".to_owned())?;
    let fluids = world.fluids.len();
    let is_known = organism.fluid.is_none_or(|fluid| (fluid as usize) < fluids);
    cell.must(is_known, || format!("it is of fluid {:?} of {fluids}", organism.fluid))?;
    let wanted = organism.divider.as_ref().and_then(|divider| divider.wanted_nodes);
    cell.must(wanted.is_none_or(|nodes| nodes <= MOST_WANTED_NODES), || format!("it wants {wanted:?} nodes"))?;
    check_parameters(world, organism, nodes > 0).map_err(|error| cell.violation(error.to_string()))
}

/// A body of a template of the embedder's own has that template.
fn check_kind(world: &World, organism: &Organism, cell: Subject) -> Check {
    let Kind::Custom(TemplateId(template)) = organism.kind else { return Ok(()) };
    let block = if let Storage::Lane { block, .. } = organism.body { world.blocks.get(block as usize) } else { None };
    let all = &world.templates;
    let is_own = block.is_some_and(|block| {
        block.template == template || all.get(block.template as usize) == all.get(template as usize)
    });
    cell.must(is_own, || format!("it has not template {template}"))
}

/// Parameters that the public API would refuse.
fn check_parameters(world: &World, organism: &Organism, has_outline: bool) -> Result<(), Error> {
    let Organism { controller, exchanges, engulfer, divider, .. } = organism;
    world.config.check_damping("linear_damping", organism.linear_damping)?;
    world.config.check_damping("angular_damping", organism.angular_damping)?;
    controller.validate().map_err(|error| error.within("controller"))?;
    world.check_controller(controller, &organism.locomotion, organism.speed, has_outline)?;
    world.check_periodic_organism(organism)?;
    for exchange in exchanges {
        let is_known = world.check_chemical(exchange.chemical, "chemical").and_then(|()| exchange.validate());
        is_known.map_err(|error| error.within("exchanges"))?;
    }
    let pseudopods = organism.locomotion.pseudopods().map_or(Ok(()), |pseudopods| pseudopods.params.validate());
    pseudopods.map_err(|error| error.within("pseudopods"))?;
    let engulfer = engulfer.as_ref().map_or(Ok(()), |engulfer| engulfer.params.validate());
    engulfer.map_err(|error| error.within("engulfer"))?;
    let divider = divider.as_ref().map_or(Ok(()), |divider| divider.params.validate());
    divider.map_err(|error| error.within("divider"))
}

/// Records the particles of an organism in `owned`, where they must be free, and checks its indices.
fn claim(world: &World, index: u32, organism: &Organism, cell: Subject, owned: &mut [u32]) -> Check {
    let loose = check_storage(world, index, organism, cell)?;
    for &i in loose.iter().chain(&organism.fluid_particles) {
        let place = owned.get_mut(i as usize).filter(|place| **place == NO_OWNER);
        *place.ok_or_else(|| in_cell(cell, i, "it does not exist or has another owner"))? = index;
    }
    // Rings are projected on several threads at the same time: none may have a node of another one.
    let mut known = Vec::new();
    let mut are_own = |ring: &[u32]| {
        known.extend_from_slice(ring);
        known.sort_unstable();
        known.is_sorted_by(|a, b| a < b) && ring.iter().all(|&i| owned.get(i as usize) == Some(&index))
    };
    let is_own = are_own(&organism.outline_particles().collect::<Vec<_>>());
    cell.must(is_own, || "its outline is not of its own particles".to_owned())?;
    let are_own = organism.phagosomes.iter().all(|inner| are_own(&inner.ring));
    cell.must(are_own, || "a phagosome is not of its own particles".to_owned())?;
    let gates = organism.engulfer.iter().flat_map(|engulfer| engulfer.meals.iter().flat_map(|meal| &meal.gate));
    let furrow = organism.furrow().map(|furrow| furrow.nodes);
    let unknown = gates.chain(furrow.iter().flatten()).find(|&&i| i as usize >= owned.len());
    unknown.map_or(Ok(()), |&i| Err(in_cell(cell, i, "a gate or furrow has it, and it does not exist")))
}

/// An organism is in its block or in none. Returns the particles of its body that are in none.
fn check_storage<'a>(world: &World, index: u32, organism: &'a Organism, cell: Subject) -> Result<&'a [u32], Violation> {
    match &organism.body {
        Storage::Lane { block, first } => {
            let block = world.blocks.get(*block as usize).filter(|block| block.slots == organism.slots);
            let is_home = |block: &Block| {
                let lane = block.owner.iter().position(|&owner| owner == index);
                lane.is_some_and(|lane| block.particle(0, lane) == *first)
            };
            cell.must(block.is_some_and(is_home), || "it is not in its block".to_owned())?;
            let in_slots = organism.outline.iter().all(|&slot| slot < organism.slots);
            cell.must(in_slots, || "its outline names a slot that does not exist".to_owned())?;
            Ok(&[])
        }
        Storage::Loose { particles, .. } => {
            cell.must(organism.slots == 0, || "it has slots and is in no block".to_owned())?;
            Ok(particles)
        }
    }
}

fn in_cell(cell: Subject, particle: u32, what: &str) -> Violation {
    Subject { particle: Some(particle), ..cell }.violation(what)
}

fn check_fluids(world: &World) -> Check {
    let p = &world.particles;
    let mut is_known = vec![false; p.len()];
    for (k, fluid) in world.fluids.iter().enumerate() {
        let in_range = fluid.params.validate();
        in_range.map_err(|error| Subject::default().violation(format!("fluid {k}: {error}")))?;
        for &i in &fluid.particles {
            let is_in_it = p.fluid.get(i as usize) == Some(&(k as u32 + 1)) && p.is_live(i as usize);
            let is_new = is_in_it && !std::mem::replace(&mut is_known[i as usize], true);
            let disc = Subject::particle(world, i as usize);
            disc.must(is_new, || format!("fluid {k} has it, but it is not marked so, or it has it twice"))?;
        }
    }
    Ok(())
}

/// Every index has its owner or none; free indices are not in use and are listed once.
fn check_particles(world: &World, owned: &[u32]) -> Check {
    let p = &world.particles;
    for (i, &owner) in owned.iter().enumerate() {
        let disc = Subject::particle(world, i);
        let owner = if owner == EMPTY_LANE { NO_OWNER } else { owner };
        let is_dead = p.inv_mass[i] == 0.0
            && p.groups[i] == CollisionGroups::NONE
            && p.next_in_ring[i] == NO_OWNER
            && p.fluid[i] == 0
            && p.velocity(i) == Vec2::ZERO;
        disc.must(is_dead || owner != NO_OWNER, || {
            "it has no owner, but mass, speed, a fluid, a ring or collisions".to_owned()
        })?;
        disc.must(p.owner[i] == owner, || format!("its owner is {}, but {owner} has it", p.owner[i]))?;
        let next = p.next_in_ring[i];
        disc.must(next == NO_OWNER || (next as usize) < owned.len(), || format!("{next} follows it in its ring"))?;
        let (fluid, fluids) = (p.fluid[i] as usize, world.fluids.len());
        disc.must(fluid <= fluids, || format!("it belongs to fluid {fluid} of {fluids}"))?;
    }
    let mut is_known = vec![false; p.len()];
    for &i in p.free_indices() {
        let is_free = owned.get(i as usize) == Some(&NO_OWNER);
        let is_new = is_free && !std::mem::replace(&mut is_known[i as usize], true);
        Subject::default().must(is_new, || format!("index {i} is free, but also in use, or free twice"))?;
    }
    Ok(())
}
