//! Tables: particles, free indices, blocks, fluids, obstacles.

use super::{Check, Subject};
use crate::config::{Side, Sides};
use crate::particle::{CollisionGroups, Particles};
use crate::solver::block::Block;
use crate::template::Role;
use crate::world::World;
use crate::world::obstacle::WALLS;
use glam::Vec2;

/// Largest distance of the centre of a colliding disc beyond a wall, as a share of its radius.
const BEYOND_WALLS: f32 = 0.5;

pub(super) fn check(world: &World) -> Check {
    (0..world.particles.len()).try_for_each(|i| check_entry(world, i))?;
    check_places(world)?;
    (0..world.fluids.len()).try_for_each(|k| check_fluid(world, k))?;
    let obstacles = world.obstacle_table.check(&world.obstacles[WALLS..]);
    obstacles.map_err(|flaw| Subject::default().violation(flaw))
}

pub(super) fn check_columns(p: &Particles) -> Check {
    let floats = [&p.origin_x, &p.origin_y, &p.x, &p.y, &p.prev_x, &p.prev_y, &p.vx, &p.vy, &p.inv_mass, &p.radius];
    let words: [&Vec<u32>; 3] = [&p.next_in_ring, &p.owner, &p.fluid];
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
        return Ok(());
    }
    disc.must((p.role[i] as usize) < Role::ALL.len(), || format!("role {} is unknown", p.role[i]))?;
    check_within_walls(world, i, disc)
}

/// Discs that collide with walls have their centres within them, except in a world without protection, where discs move
/// farther in a step than the search margin; all particles are where they may be.
fn check_within_walls(world: &World, i: usize, disc: Subject) -> Check {
    let (p, size) = (&world.particles, world.config.size);
    let is_held = world.config.protects_membranes && p.inv_mass[i] > 0.0 && p.groups[i].meets(CollisionGroups::ALL);
    let Sides { bottom, top, left, right } = world.config.sides;
    let [farthest_low, farthest_high] = world.config.particle_bounds();
    let (near_low, near_high) =
        (Vec2::splat(-BEYOND_WALLS * p.radius[i]), size + Vec2::splat(BEYOND_WALLS * p.radius[i]));
    let or = |side: Side, near: f32, far: f32| if is_held && side == Side::Wall { near } else { far };
    let low = Vec2::new(or(left, near_low.x, farthest_low.x), or(bottom, near_low.y, farthest_low.y));
    let high = Vec2::new(or(right, near_high.x, farthest_high.x), or(top, near_high.y, farthest_high.y));
    let at = p.position(i);
    let is_inside = at.cmpge(low).all() && at.cmple(high).all();
    disc.must(is_inside, || format!("it is at {at}, outside the room of {size}"))
}

/// Every unused index is in a block or free.
fn check_places(world: &World) -> Check {
    let p = &world.particles;
    let mut is_kept: Vec<bool> = (0..p.len()).map(|i| p.is_live(i)).collect();
    for block in world.blocks.iter().map(Block::range) {
        is_kept[block.base..block.base + block.len()].fill(true);
    }
    p.free_indices().iter().for_each(|&i| is_kept[i as usize] = true);
    let lost = is_kept.iter().position(|is_kept| !is_kept);
    lost.map_or(Ok(()), |i| Err(Subject::default().violation(format!("index {i} is neither in use nor free"))))
}

/// The particles of a fluid have owners with this fluid; an enclosed fluid has one owner.
fn check_fluid(world: &World, k: usize) -> Check {
    let (p, fluid) = (&world.particles, &world.fluids[k]);
    for &i in &fluid.particles {
        let disc = Subject::particle(world, i as usize);
        let owner = disc.organism.and_then(|(id, _)| world.organisms.get(id));
        let is_owners = owner.is_some_and(|owner| owner.fluid == Some(k as u32));
        disc.must(is_owners, || format!("fluid {k} has a particle whose owner has another fluid"))?;
    }
    let owners = |i: &u32| p.owner[*i as usize];
    let mixes = fluid.is_enclosed && fluid.particles.windows(2).any(|pair| owners(&pair[0]) != owners(&pair[1]));
    Subject::default().must(!mixes, || format!("fluid {k} is enclosed and has several owners"))
}
