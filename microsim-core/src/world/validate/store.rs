//! The tables below organisms: particles, free indices, blocks, fluids, obstacles.

use super::{Check, Subject};
use crate::config::WorldConfig;
use crate::organism::Body;
use crate::particle::{CollisionGroups, NO_OWNER, Particles};
use crate::solver::block::Block;
use crate::solver::lanes::LANES;
use crate::template::Role;
use crate::world::{WALLS, World};
use glam::Vec2;

/// Largest coordinate of anything, units: quarantine takes what is farther from its room than the room's size.
const FARTHEST: f32 = 3.0 * WorldConfig::MAX_SIZE;
/// Largest radius: of a template's node times the scale of its placement.
const LARGEST: f32 = 1e5;
/// Impacts may leave a particle faster than the speed limit, until the next substep, but not more times than this.
const TIMES_SPEED_LIMIT: f32 = 10.0;
/// How far the centre of a disc that collides with walls may be beyond them, as a share of its radius.
const BEYOND_WALLS: f32 = 0.5;

pub(super) fn check(world: &World) -> Check {
    check_columns(&world.particles)?;
    (0..world.particles.len()).try_for_each(|i| check_entry(world, i))?;
    check_places(world)?;
    world.blocks.iter().enumerate().try_for_each(|(k, block)| check_block(world, k, block))?;
    (0..world.fluids.len()).try_for_each(|k| check_fluid(world, k))?;
    check_slots(world)?;
    let (digests, obstacles) = (world.obstacle_digests.len(), world.obstacles.len() - WALLS);
    Subject::default().must(digests == obstacles, || format!("{digests} digests of {obstacles} obstacles"))
}

fn check_columns(p: &Particles) -> Check {
    let floats = [&p.origin_x, &p.origin_y, &p.x, &p.y, &p.prev_x, &p.prev_y, &p.vx, &p.vy, &p.inv_mass, &p.radius];
    let words = [&p.next_in_ring, &p.owner, &p.fluid];
    let others = [p.groups.len(), p.material.len(), p.role.len()];
    let lengths = floats.map(Vec::len).into_iter().chain(words.map(Vec::len)).chain(others);
    let mut wrong = lengths.filter(|&length| length != p.len());
    let none = Subject::default();
    none.must(wrong.next().is_none(), || format!("a column of the particles is not {} long", p.len()))?;
    let live = p.live().count();
    none.must(live == p.live_count(), || format!("{live} particles live, but {} are counted", p.live_count()))
}

fn check_entry(world: &World, i: usize) -> Check {
    let (p, disc) = (&world.particles, Subject::particle(world, i));
    if !p.is_live(i) {
        let is_dead = p.inv_mass[i] == 0.0
            && p.groups[i] == CollisionGroups::NONE
            && p.next_in_ring[i] == NO_OWNER
            && p.fluid[i] == 0
            && p.velocity(i) == Vec2::ZERO;
        return disc.must(is_dead, || "nobody owns it, but it has mass, speed, a fluid, a ring or collides".to_owned());
    }
    disc.must(disc.organism.is_some(), || format!("its owner {} does not live", p.owner[i]))?;
    check_numbers(world, i, disc)?;
    disc.must((p.role[i] as usize) < Role::ALL.len(), || format!("role {} is unknown", p.role[i]))?;
    let fluid = p.fluid[i] as usize;
    disc.must(fluid <= world.fluids.len(), || format!("it belongs to fluid {fluid} of {}", world.fluids.len()))?;
    check_within_walls(world, i, disc)
}

fn check_numbers(world: &World, i: usize, disc: Subject) -> Check {
    let p = &world.particles;
    for (name, column) in [("origin x", &p.origin_x), ("origin y", &p.origin_y)] {
        disc.must_range(name, column[i], -FARTHEST, FARTHEST)?;
        disc.must(column[i].fract() == 0.0, || format!("{name} is {}, must be whole", column[i]))?;
    }
    for (name, column) in [("x", &p.x), ("y", &p.y), ("previous x", &p.prev_x), ("previous y", &p.prev_y)] {
        disc.must_range(name, column[i], -FARTHEST, FARTHEST)?;
    }
    let fastest = TIMES_SPEED_LIMIT * world.config.speed_limit();
    disc.must_range("velocity x", p.vx[i], -fastest, fastest)?;
    disc.must_range("velocity y", p.vy[i], -fastest, fastest)?;
    disc.must_range("inverse mass", p.inv_mass[i], 0.0, f32::MAX)?;
    disc.must_range("radius", p.radius[i], 0.0, LARGEST)?;
    disc.must_range("friction", p.material[i].friction, 0.0, 10.0)?;
    disc.must_range("restitution", p.material[i].restitution, 0.0, 1.0)
}

/// What collides with walls has its centre within them, unless the world is one without protection, in which discs move
/// farther in a step than pairs are searched for; everything is at most a room's size away.
fn check_within_walls(world: &World, i: usize, disc: Subject) -> Check {
    let (p, size) = (&world.particles, world.config.size);
    let is_held = world.config.protects_membranes && p.inv_mass[i] > 0.0 && p.groups[i].meets(CollisionGroups::ALL);
    let beyond = if is_held { Vec2::splat(BEYOND_WALLS * p.radius[i]) } else { size };
    let at = p.position(i);
    let is_inside = at.cmpge(-beyond).all() && at.cmple(size + beyond).all();
    disc.must(is_inside, || format!("it is at {at}, outside the room of {size}"))
}

/// Every index is a lane of exactly one block, or live on its own, or free exactly once.
fn check_places(world: &World) -> Check {
    let (p, none) = (&world.particles, Subject::default());
    let mut is_taken = vec![false; p.len()];
    let mut end = 0;
    for (k, block) in world.blocks.iter().enumerate() {
        let range = block.base as usize..block.base as usize + block.slots as usize * LANES;
        let is_placed = range.start >= end && range.end <= p.len();
        none.must(is_placed, || format!("block {k} lies at {range:?}, over another one or outside the store"))?;
        end = range.end;
        is_taken[range].fill(true);
    }
    for &i in p.free_indices() {
        let is_free = is_taken.get(i as usize) == Some(&false) && !p.is_live(i as usize);
        none.must(is_free, || format!("index {i} is free, but also in use, or free twice"))?;
        is_taken[i as usize] = true;
    }
    let lost = (0..p.len()).find(|&i| !is_taken[i] && !p.is_live(i));
    lost.map_or(Ok(()), |i| Err(none.violation(format!("index {i} is neither in use nor free"))))
}

fn check_block(world: &World, k: usize, block: &Block) -> Check {
    let none = Subject::default();
    let template = world.templates.get(block.template as usize);
    let is_of_template = template.is_some_and(|template| template.nodes().len() == block.slots as usize);
    none.must(is_of_template, || format!("block {k} has {} slots and template {}", block.slots, block.template))?;
    for (lane, &owner) in block.owner.iter().enumerate() {
        let first = block.particle(0, lane);
        if owner != NO_OWNER {
            let id = world.organisms.id_at(owner);
            let body = id.and_then(|id| world.organisms.get(id)).map(|organism| &organism.body);
            let is_known = matches!(body, Some(Body::Lane { block: at, first: f }) if *at as usize == k && *f == first);
            none.must(is_known, || format!("lane {lane} of block {k} is owned by {owner}, which does not know"))?;
            none.must_range(&format!("scale of lane {lane} of block {k}"), block.scale[lane], 1e-6, 1e6)?;
        }
        for slot in 0..block.slots {
            let i = block.particle(slot, lane) as usize;
            Subject::particle(world, i).must(world.particles.owner[i] == owner, || {
                format!("it is in lane {lane} of block {k}, which is owned by {owner}")
            })?;
        }
    }
    Ok(())
}

/// Particles of a fluid know it, and their organism does.
fn check_fluid(world: &World, k: usize) -> Check {
    let (p, fluid) = (&world.particles, &world.fluids[k]);
    let none = Subject::default();
    fluid.params.validate().map_err(|error| none.violation(format!("fluid {k}: {error}")))?;
    let mut sorted = fluid.particles.clone();
    sorted.sort_unstable();
    sorted.dedup();
    none.must(sorted.len() == fluid.particles.len(), || format!("fluid {k} has a particle twice"))?;
    for &i in &fluid.particles {
        let i = i as usize;
        let disc = Subject::particle(world, i);
        let is_marked = i < p.len() && p.is_live(i) && p.fluid[i] as usize == k + 1;
        disc.must(is_marked, || format!("fluid {k} has it, but it is not marked so"))?;
        let owner = disc.organism.and_then(|(id, _)| world.organisms.get(id));
        disc.must(owner.is_some_and(|owner| owner.fluid == Some(k as u32)), || {
            format!("fluid {k} is not its owner's")
        })?;
    }
    let owners = |i: &u32| p.owner[*i as usize];
    let mixes = fluid.is_enclosed && fluid.particles.windows(2).any(|pair| owners(&pair[0]) != owners(&pair[1]));
    none.must(!mixes, || format!("fluid {k} is enclosed and has several owners"))
}

/// Every slot of the table of organisms lives or is free exactly once.
fn check_slots(world: &World) -> Check {
    let (organisms, none) = (&world.organisms, Subject::default());
    let mut free = organisms.free_slots().to_vec();
    free.sort_unstable();
    let empty = (0..organisms.slot_count()).filter(|&index| organisms.id_at(index).is_none());
    none.must(empty.eq(free), || "the empty places of organisms are not those that are free".to_owned())
}
