//! Single organisms: particles, membranes, cytoplasm and state.

use super::{Check, Subject, Violation};
use crate::geometry::polygon::{contains_point, is_simple, signed_area};
use crate::organism::{Organism, Storage};
use crate::particle::NO_OWNER;
use crate::solver::membrane::links;
use crate::world::World;
use glam::Vec2;

pub(super) fn check(world: &World) -> Check {
    for (id, organism) in world.organisms.iter() {
        let cell = Subject::organism(id, organism.kind);
        check_outline(world, organism, cell)?;
        check_rings(world, organism, cell)?;
        check_fluid(world, organism, cell)?;
        check_furrow(organism, cell)?;
    }
    check_links(world)
}

/// The outline is the template's, or that of its own membrane.
fn check_outline(world: &World, organism: &Organism, cell: Subject) -> Check {
    let Storage::Lane { block, .. } = organism.body else { return Ok(()) };
    let template = world.blocks.get(block as usize).and_then(|block| world.templates.get(block.template as usize));
    let is_equal = template.is_some_and(|template| template.outline() == organism.outline);
    cell.must(is_equal, || "its outline is not that of its template".to_owned())
}

/// Membranes are closed, simple and counter-clockwise, and all loose nodes are in exactly one.
fn check_rings(world: &World, organism: &Organism, cell: Subject) -> Check {
    let Storage::Loose { particles, .. } = &organism.body else { return Ok(()) };
    let mut nodes = particles.clone();
    let mut linked: Vec<u32> = organism.membranes().flat_map(|(_, ring)| ring).copied().collect();
    nodes.sort_unstable();
    linked.sort_unstable();
    cell.must(nodes == linked, || format!("{} nodes, of which its rings have {}", nodes.len(), linked.len()))?;
    organism.membranes().try_for_each(|(_, ring)| check_ring(world, organism, cell, ring))
}

fn check_ring(world: &World, organism: &Organism, cell: Subject, ring: &[u32]) -> Check {
    let p = &world.particles;
    let loose = links(ring).find(|&(a, b)| p.next_in_ring[a as usize] != b);
    if let Some((a, b)) = loose {
        let node = Subject { particle: Some(a), ..cell };
        return Err(node.violation(format!("{b} follows it in its ring, but it is linked to another")));
    }
    if organism.is_quarantined || !world.config.protects_membranes {
        return Ok(());
    }
    let outline: Vec<Vec2> = ring.iter().map(|&i| p.position(i as usize)).collect();
    let area = signed_area(&outline);
    cell.must(area > 0.0, || format!("a ring of {} nodes encloses an area of {area}", ring.len()))?;
    cell.must(is_simple(&outline), || format!("a ring of {} nodes crosses itself", ring.len()))
}

/// Nodes that are linked to a following node are in a ring.
fn check_links(world: &World) -> Check {
    let p = &world.particles;
    let rings = world.organisms.iter().flat_map(|(_, organism)| organism.membranes());
    let nodes: usize = rings.map(|(_, ring)| ring.len()).sum();
    let linked = p.next_in_ring.iter().filter(|&&next| next != NO_OWNER).count();
    Subject::default().must(linked == nodes, || format!("{linked} nodes are linked, {nodes} are in rings"))
}

/// Its cytoplasm is in its fluid and inside its membrane.
fn check_fluid(world: &World, organism: &Organism, cell: Subject) -> Check {
    let p = &world.particles;
    if organism.is_quarantined {
        return cell.must(organism.fluid.is_none(), || "it is in quarantine and still part of a fluid".to_owned());
    }
    let own = &organism.fluid_particles;
    let Some(fluid) = organism.fluid else {
        return cell.must(own.is_empty(), || format!("{} particles of no fluid", own.len()));
    };
    let list = world.fluids.get(fluid as usize).map(|fluid| &fluid.particles);
    let index = cell.organism.map(|(id, _)| id.index);
    let listed = list.map(|list| list.iter().filter(|&&i| p.owner.get(i as usize).copied() == index).count());
    cell.must(listed == Some(own.len()), || format!("fluid {fluid} has {listed:?} of its {} particles", own.len()))?;
    if let Some(&i) = own.iter().find(|&&i| p.fluid[i as usize] != fluid + 1) {
        return Err(Subject { particle: Some(i), ..cell }.violation(format!("it is not marked as fluid {fluid}")));
    }
    if organism.body.membrane().is_none() || !world.config.protects_membranes {
        return Ok(());
    }
    let (outline, held) = (world.outline_of(organism), world.held_cells(organism));
    let leak = own.iter().find(|&&i| !contains_point(&outline, p.position(i as usize)));
    leak.map_or(Ok(()), |&i| Err(in_cell(i, cell, "it has leaked out of its membrane")))?;
    let is_in_prey = |i: u32| held.iter().any(|inner| contains_point(inner, p.position(i as usize)));
    let lost = own.iter().find(|&&i| is_in_prey(i));
    lost.map_or(Ok(()), |&i| Err(in_cell(i, cell, "it has leaked into a cell that its own holds")))
}

fn in_cell(particle: u32, cell: Subject, what: &str) -> Violation {
    Subject { particle: Some(particle), ..cell }.violation(what)
}

/// A furrow is between two nodes of the membrane.
fn check_furrow(organism: &Organism, cell: Subject) -> Check {
    let Some(furrow) = organism.furrow() else { return Ok(()) };
    let [a, b] = furrow.nodes;
    let is_there = a != b && organism.outline.contains(&a) && organism.outline.contains(&b);
    cell.must(is_there, || format!("its furrow is between {a} and {b}, which are not two of its nodes"))
}
