//! The food chain: an endless round. Hunger uses up cytoplasm, larger amoebae [bite](bites), and at each doubling the body
//! [changes](change). What comes when is data, `games/food-chain.toml`.
//!
//! What the rules do to the world they do between two steps, so a replay has it; when it is played again they only look on.

pub mod bites;
pub mod change;

use bites::{Bites, can_bite, cytoplasm};
use change::{Change, changes, is_own, mark_own};
use microsim_core::glam::Vec2;
use microsim_core::{Kind, OrganismId, OrganismView, Rng, View, World};

/// Name of its scenario.
pub const NAME: &str = "food-chain";
/// Its scenario.
pub const TEXT: &str = include_str!("../../../games/food-chain.toml");

/// Fewest particles of cytoplasm with which a cell lives, `division.least_particles` of its file.
const LEAST: u32 = 12;
/// What a cell of the first size uses up, particles/s; a larger one as much as the power 3/4 of its size says (Kleiber 1932).
const HUNGER: f32 = 4.2;
/// Time in which hunger grows by that of the beginning, s.
const RAMP: f32 = 90.0;
/// Share of it for a sister, which rests.
const RESTING: f32 = 0.3;
/// What each [`Change::Thrift`] leaves of it.
const THRIFT: f32 = 0.9;
/// Streams of random numbers from here on are for offers.
const STREAM: u64 = 5 << 60;

/// The state of a food chain.
#[derive(Clone, Debug)]
pub struct FoodChain {
    /// Cytoplasm at the beginning, particles.
    first: u32,
    /// What hunger will take next, by cell, particles.
    owed: Vec<(OrganismId, f32)>,
    bites: Bites,
    offer: Option<[Change; 3]>,
    rng: Rng,
    fate: Option<Fate>,
    is_over: bool,
}

/// How the last cell of the player's line came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It had nothing left to live on.
    Starved,
    /// A larger amoeba ate it.
    Eaten,
}

impl FoodChain {
    /// A food chain at its beginning.
    #[must_use]
    pub fn new(world: &World, player: OrganismId) -> Self {
        let first = world.view().organism(player).map_or(1, cytoplasm).max(1);
        let rng = Rng::new(world.config().seed, STREAM);
        let (owed, bites) = (Vec::new(), Bites::default());
        Self { first, owed, bites, offer: None, rng, fate: None, is_over: false }
    }

    /// What the rules do before a step: bites and hunger. A cell that has nothing left to lose is gone.
    pub fn before_step(&mut self, world: &mut World, player: OrganismId) {
        if world.step_index() == 0 {
            let _ = mark_own(world, player);
        }
        for [by, of] in self.bites.advance(world) {
            self.bite(world, by, of);
        }
        let own: Vec<OrganismId> =
            world.view().organisms().filter(|cell| is_own(*cell)).map(|cell| cell.id()).collect();
        self.owed.retain(|(id, _)| own.contains(id));
        for id in own {
            self.starve(world, id, player);
        }
    }

    fn bite(&mut self, world: &mut World, by: OrganismId, of: OrganismId) {
        self.take(world, of, Fate::Eaten);
        // Refused while it divides, or has no room.
        if world.view().organism(by).is_some_and(is_own) {
            let _ = world.grow(by, 0, 1);
        }
    }

    /// Takes a particle from a cell; one that has no more than it lives on is gone. A cell that divides loses nothing.
    fn take(&mut self, world: &mut World, from: OrganismId, fate: Fate) {
        let Some(cell) = world.view().organism(from).filter(|cell| cell.dividing_for().is_none()) else { return };
        let is_own = is_own(cell);
        if cytoplasm(cell) <= LEAST || world.shrink(from, 1).is_err() {
            let _ = world.remove(from);
            self.fate = if is_own { Some(fate) } else { self.fate };
        }
    }

    fn starve(&mut self, world: &mut World, id: OrganismId, player: OrganismId) {
        let Some(cell) = world.view().organism(id) else { return };
        let resting = if id == player { 1.0 } else { RESTING };
        let used = resting * self.hunger(cell, world.time() as f32) * world.config().dt;
        let place = self.owed.iter().position(|(known, _)| *known == id).unwrap_or_else(|| {
            self.owed.push((id, 0.0));
            self.owed.len() - 1
        });
        self.owed[place].1 += used;
        // What hunger asks for while a furrow closes is taken after it.
        let is_dividing = cell.dividing_for().is_some();
        while !is_dividing && self.owed[place].1 >= 1.0 {
            self.owed[place].1 -= 1.0;
            // Hunger may take the last particle of a cell that is being eaten.
            self.take(world, id, if self.bites.was_bitten(id) { Fate::Eaten } else { Fate::Starved });
        }
    }

    /// What a cell uses up at a time, particles/s.
    #[must_use]
    pub fn hunger(&self, cell: OrganismView<'_>, time: f32) -> f32 {
        let size = self.size(cell);
        let thrift = THRIFT.powi(Change::Thrift.count(cell) as i32);
        HUNGER * (size * size.sqrt()).sqrt() * (1.0 + time / RAMP) * thrift
    }

    /// Size of a cell, 1 at the beginning.
    #[must_use]
    pub fn size(&self, cell: OrganismView<'_>) -> f32 {
        cytoplasm(cell) as f32 / self.first as f32
    }

    /// Time until a cell has nothing left to live on, at its present hunger, s.
    #[must_use]
    pub fn reserve(&self, cell: OrganismView<'_>, time: f32) -> f32 {
        let owed = self.owed.iter().find(|(id, _)| *id == cell.id()).map_or(0.0, |(_, owed)| *owed);
        let left = cytoplasm(cell).saturating_sub(LEAST) as f32 - owed;
        if left > 0.0 { left / self.hunger(cell, time) } else { 0.0 }
    }

    /// Looks after a step who is played now: the same cell, or a sister if that is gone.
    pub fn after_step(&mut self, world: &World, player: OrganismId) -> OrganismId {
        let view = world.view();
        let heir = view.organism(player).or_else(|| view.organisms().find(|cell| is_own(*cell)));
        self.is_over = heir.is_none();
        let Some(cell) = heir else { return player };
        if self.offer.is_none() && self.size(cell) >= 2.0_f32.powi(1 + changes(cell) as i32) {
            self.offer = Some(self.draw());
        }
        cell.id()
    }

    /// Three changes by chance.
    fn draw(&mut self) -> [Change; 3] {
        let mut left = Change::ALL.to_vec();
        [(); 3].map(|()| left.swap_remove(self.rng.next_u32() as usize % left.len()))
    }

    /// The changes of which one may be chosen now.
    #[must_use]
    pub fn offer(&self) -> Option<[Change; 3]> {
        self.offer
    }

    /// Makes one of the changes that are offered.
    pub fn choose(&mut self, change: Change, world: &mut World, player: OrganismId) {
        if self.offer.is_some_and(|offer| offer.contains(&change)) {
            self.change(change, world, player);
        }
    }

    /// Makes a change, whatever is offered.
    pub(super) fn change(&mut self, change: Change, world: &mut World, player: OrganismId) {
        if change.make(world, player).is_ok() {
            self.offer = None;
        }
    }

    /// Whether a cell is bitten now.
    #[must_use]
    pub fn is_bitten(&self, cell: OrganismId) -> bool {
        self.bites.is_bitten(cell)
    }

    /// How the last cell that is gone came to its end; `None` before, and in a replay.
    #[must_use]
    pub fn fate(&self) -> Option<Fate> {
        self.fate
    }

    /// Whether no cell of the player's line is left.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.is_over
    }
}

/// Another amoeba, as the player's cell meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Other {
    /// Its middle.
    pub at: Vec2,
    /// Half its length, units.
    pub half_extent: f32,
    /// How far its middle is from the cell's, units.
    pub distance: f32,
}

/// The amoebae that can bite a cell, and those that it can bite, the nearest first.
#[must_use]
pub fn threats_and_victims(view: View<'_>, player: OrganismId) -> [Vec<Other>; 2] {
    let Some(cell) = view.organism(player) else { return [Vec::new(), Vec::new()] };
    let amoebae = || view.organisms().filter(|other| other.kind() == Kind::AmoeboidCell && !is_own(*other));
    let mut found = [
        amoebae().filter(|other| can_bite(*other, cell)).map(|other| seen(other, cell)).collect::<Vec<_>>(),
        amoebae().filter(|other| can_bite(cell, *other)).map(|other| seen(other, cell)).collect(),
    ];
    found.iter_mut().for_each(|others| others.sort_by(|a, b| a.distance.total_cmp(&b.distance)));
    found
}

fn seen(other: OrganismView<'_>, cell: OrganismView<'_>) -> Other {
    let ((low, high), at) = (other.bounds(), other.centroid());
    Other { at, half_extent: 0.5 * (high - low).max_element(), distance: (at - cell.centroid()).length() }
}
