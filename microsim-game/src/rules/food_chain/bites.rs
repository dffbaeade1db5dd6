//! Bites: an amoeba gnaws at a smaller one that it touches. Real ones do: *Entamoeba histolytica* kills by taking in pieces of
//! living cells (trogocytosis; Ralston and others 2014, Nature 508, 526).

use super::change::{Change, line_of};
use microsim_core::glam::Vec2;
use microsim_core::{Kind, OrganismId, OrganismView, Role, World};

/// Area of who bites over that of who is bitten, at least.
const LEAST_RATIO: f32 = 1.5;
/// How many times as large each thick coat makes a cell count among amoebae.
const COAT: f32 = 2.0;
/// What each thick coat leaves of the rate of bites.
const COAT_RATE: f32 = 0.4;
/// What each wide mouth leaves of that ratio, which never falls below 1.
const MOUTH: f32 = 2.0 / 3.0;
/// Gap between two outlines' nodes that counts as touching, units; nodes have radii from 0.5 to 0.8.
const GAP: f32 = 1.8;
/// Time for which they have to touch first, s.
const HOLD: f32 = 0.4;
/// Cytoplasm that a bite takes, particles/s.
const RATE: f32 = 8.0;
/// Time for which a bite counts after it, s: cells lose touch for a moment when one is pushed away.
const RECENT: f64 = 1.0;

/// An amoeba that touches a smaller one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bite {
    /// Who bites.
    pub by: OrganismId,
    /// Who is bitten.
    pub of: OrganismId,
    /// For how long they have touched, s.
    pub held: f32,
    /// What is to be taken, particles.
    owed: f32,
}

/// Amoebae that touch smaller ones.
#[derive(Clone, Debug, Default)]
pub struct Bites {
    touching: Vec<Bite>,
    /// Who was bitten in the last [`RECENT`], and when, s.
    recent: Vec<(OrganismId, f64)>,
}

impl Bites {
    /// Looks after a step who touches whom. Returns who loses a particle of cytoplasm now: by whom, and who.
    pub fn advance(&mut self, world: &World) -> Vec<[OrganismId; 2]> {
        let (dt, now) = (world.config().dt, world.time());
        self.recent.retain(|(_, at)| now - at < RECENT);
        let before = std::mem::take(&mut self.touching);
        let mut taken = Vec::new();
        for [by, of] in pairs(world) {
            let known = before.iter().find(|bite| (bite.by, bite.of) == (by.id(), of.id()));
            let mut bite = known.copied().unwrap_or(Bite { by: by.id(), of: of.id(), held: 0.0, owed: 0.0 });
            bite.held += dt;
            if bite.held > HOLD {
                bite.owed += RATE * COAT_RATE.powi(Change::Coat.count(of) as i32) * dt;
            }
            while bite.owed >= 1.0 {
                bite.owed -= 1.0;
                taken.push([bite.by, bite.of]);
            }
            self.touching.push(bite);
        }
        self.recent.extend(taken.iter().map(|[_, of]| (*of, now)));
        taken
    }

    /// Whether somebody is bitten now.
    #[must_use]
    pub fn is_bitten(&self, cell: OrganismId) -> bool {
        self.touching.iter().any(|bite| bite.of == cell && bite.held > HOLD)
    }

    /// Whether somebody bit it just now.
    #[must_use]
    pub fn was_bitten(&self, cell: OrganismId) -> bool {
        self.recent.iter().any(|(of, _)| *of == cell)
    }
}

/// Particles of cytoplasm of a cell.
#[must_use]
pub fn cytoplasm(cell: OrganismView<'_>) -> u32 {
    let is_cytoplasm = |role| matches!(role, Role::Cytoplasm | Role::GrownCytoplasm);
    cell.particles().filter(|particle| is_cytoplasm(particle.role)).count() as u32
}

/// Whether one amoeba is large enough to bite another.
#[must_use]
pub fn can_bite(by: OrganismView<'_>, of: OrganismView<'_>) -> bool {
    let ratio = LEAST_RATIO * MOUTH.powi(Change::WideMouth.count(by) as i32);
    apparent_area(by) >= ratio.max(1.0) * apparent_area(of)
}

/// Area that a cell counts for among amoebae.
fn apparent_area(cell: OrganismView<'_>) -> f32 {
    cell.cytoplasm_area() * COAT.powi(Change::Coat.count(cell) as i32)
}

/// All amoebae that touch a smaller one that is no sister.
fn pairs(world: &World) -> Vec<[OrganismView<'_>; 2]> {
    let amoebae: Vec<_> = world.view().organisms().filter(|cell| cell.kind() == Kind::AmoeboidCell).collect();
    let mut pairs = Vec::new();
    for by in &amoebae {
        let others = amoebae.iter().filter(|of| line_of(**of) != line_of(*by));
        pairs.extend(others.filter(|of| touch(*by, **of) && can_bite(*by, **of)).map(|of| [*by, *of]));
    }
    pairs
}

fn touch(a: OrganismView<'_>, b: OrganismView<'_>) -> bool {
    let ((low_a, high_a), (low_b, high_b)) = (a.bounds(), b.bounds());
    if (low_a - high_b).max(low_b - high_a).max_element() > GAP {
        return false;
    }
    let near_b = |at: &Vec2| at.cmpgt(low_b - GAP).all() && at.cmplt(high_b + GAP).all();
    let outline: Vec<Vec2> = b.outline().collect();
    a.outline().filter(near_b).any(|at| outline.iter().any(|to| at.distance_squared(*to) < GAP * GAP))
}

#[cfg(test)]
mod tests {
    use super::super::change::mark;
    use super::*;
    use microsim_core::{AmoeboidCellSpec, Inputs, Intent, Placement, WorldConfig};

    /// A world with the player's cell, and another whose radius is so much larger.
    fn meeting(larger: f32, changes: &[Change]) -> (World, [OrganismId; 2]) {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cells = [(1.0, 40.0), (larger, 120.0)].map(|(share, x)| {
            let spec = AmoeboidCellSpec { radii: share * AmoeboidCellSpec::default().radii, ..Default::default() };
            world.spawn(&spec.into(), Placement::at(x, 45.0)).unwrap()
        });
        mark(&mut world, cells[0], 0).unwrap();
        changes.iter().for_each(|change| change.make(&mut world, cells[0]).unwrap());
        (world, cells)
    }

    /// Whether the other bites the player's cell, and that the other.
    fn bites(larger: f32, changes: &[Change]) -> [bool; 2] {
        let (world, cells) = meeting(larger, changes);
        let [own, other] = cells.map(|cell| world.view().organism(cell).unwrap());
        [can_bite(other, own), can_bite(own, other)]
    }

    #[test]
    fn a_coat_makes_a_cell_count_for_more_and_a_mouth_takes_amoebae_as_large() {
        assert_eq!(bites(1.35, &[]), [true, false]);
        assert_eq!(bites(1.35, &[Change::Coat]), [false, false]);
        assert_eq!(bites(0.9, &[]), [false, false]);
        assert_eq!(bites(0.9, &[Change::WideMouth]), [false, true]);
        assert_eq!(bites(0.9, &[Change::Coat]), [false, true]);
        assert_eq!(bites(1.1, &[Change::WideMouth; 4]), [false, false], "never one that is larger");
    }

    /// A large and a small cell that touch.
    fn touching() -> (World, [OrganismId; 2]) {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let mut spawn = |radius: f32, x: f32| {
            let spec = AmoeboidCellSpec { radii: Vec2::splat(radius), ..Default::default() };
            world.spawn(&spec.into(), Placement::at(x, 45.0)).ok()
        };
        let large = spawn(9.0, 60.0).unwrap();
        let small = (0..30).find_map(|k| spawn(5.0, 73.0 + 0.1 * k as f32)).unwrap();
        (world, [large, small])
    }

    #[test]
    fn a_bite_counts_for_a_second_though_touch_is_lost() {
        let (mut world, [large, small]) = touching();
        mark(&mut world, small, 0).unwrap();
        let (mut bites, mut hunt) = (Bites::default(), Inputs::new());
        while !bites.was_bitten(small) && world.time() < 10.0 {
            bites.advance(&world);
            hunt.set(large, Intent::toward(world.centroid(small).unwrap()).unwrap());
            world.step(&hunt);
        }
        assert!(bites.is_bitten(small) && bites.was_bitten(small));
        world.remove(large).unwrap();
        let end = world.time();
        for (after, was_bitten) in [(0.8, true), (1.2, false)] {
            while world.time() < end + after {
                bites.advance(&world);
                world.step(&Inputs::new());
            }
            assert_eq!((bites.is_bitten(small), bites.was_bitten(small)), (false, was_bitten), "after {after} s");
        }
    }

    #[test]
    fn sisters_do_not_bite_each_other_when_one_has_changed() {
        let (mut world, [large, small]) = touching();
        assert_eq!(pairs(&world).len(), 0, "neither is the player's");
        mark(&mut world, small, 0).unwrap();
        assert_eq!(pairs(&world).len(), 1);
        mark(&mut world, large, 1).unwrap();
        assert_eq!(pairs(&world).len(), 1, "cells of two players");
        mark(&mut world, large, 0).unwrap();
        Change::Speed.make(&mut world, large).unwrap();
        assert!(pairs(&world).is_empty());
    }
}
