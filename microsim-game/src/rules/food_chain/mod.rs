//! The food chain: an endless round of one to four players, each with a line of cells. Hunger uses up cytoplasm, larger amoebae
//! [bite](bites), and as the cell grows the body [changes](change). What comes when is data, `games/food-chain.toml`.
//!
//! What the rules do to the world they do between two steps, so a replay has it; when it is played again they only look on.

pub mod bites;
pub mod change;
pub mod feats;
mod line;

use super::prey_class;
use super::referee::KindScore;
use super::seating::seat;
use super::threat::Other;
use bites::{Bites, can_bite, cytoplasm};
use change::{Change, changes, line_of, mark};
use feats::Feats;
pub use line::Fate;
use line::Line;
use microsim_core::{Event, Kind, OrganismId, OrganismView, View, World};

/// Name of its scenario.
pub const NAME: &str = "food-chain";
/// Its scenario.
pub const TEXT: &str = include_str!("../../../games/food-chain.toml");

/// Where the cells of the players end in it, and those of more players: the second begins in the right room, two in the middle one.
const OTHERS: &str = "# --- What else is there";
const CELL: &str = "of = \"hunter\"\nsecretes = { scent = 60.0 }";
const MORE: [(usize, [f32; 2]); 3] = [(2, [160.0, 50.0]), (3, [96.0, 26.0]), (4, [96.0, 74.0])];

/// Fewest particles of cytoplasm with which a cell lives, `division.least_particles` of its file.
const LEAST: u32 = 12;
/// What a cell of the first size uses up, particles/s; a larger one as much as the power 3/4 of its size says (Kleiber 1932).
const HUNGER: f32 = 4.2;
/// Time in which hunger grows by that of the beginning, s.
const RAMP: f32 = 220.0;
/// Share of it for a sister, which rests.
const RESTING: f32 = 0.3;
/// Size from which a cell can be changed first; then at each doubling of its first size.
const FIRST_CHANGE: f32 = 1.3;
/// What each [`Change::Thrift`] leaves of it.
const THRIFT: f32 = 0.9;

/// The scenario for so many players, 1 to 4.
#[must_use]
pub fn text(players: usize) -> String {
    seat(TEXT, OTHERS, players, CELL, &MORE)
}

/// The state of a food chain.
#[derive(Clone, Debug)]
pub struct FoodChain {
    /// Cytoplasm at the beginning, particles.
    first: u32,
    /// What hunger will take next, by cell, particles.
    owed: Vec<(OrganismId, f32)>,
    bites: Bites,
    /// Of each player.
    lines: Vec<Line>,
}

/// How a food chain ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Life {
    /// How long the first player's line lived, s.
    pub time: f32,
    /// How it ended; unknown in a replay.
    pub fate: Option<Fate>,
    /// What it has done; in a replay not all of it is known.
    pub feats: Feats,
    /// Seed of the round: what its player shares.
    pub seed: u64,
}

/// What a player does besides crawling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deed {
    /// Takes one of the changes that are offered, by its place.
    Choose(usize),
    /// Divides the cell.
    Divide,
    /// Crawls faster for a moment.
    Lunge,
}

impl FoodChain {
    /// A food chain at its beginning, with the cells of its players.
    #[must_use]
    pub fn new(world: &World, players: &[OrganismId]) -> Self {
        let first = players.first().and_then(|&cell| world.view().organism(cell));
        let lines = (0..players.len()).map(|player| Line::new(world.config().seed, player)).collect();
        let (first, owed, bites) = (first.map_or(1, cytoplasm).max(1), Vec::new(), Bites::default());
        Self { first, owed, bites, lines }
    }

    /// What the rules do before a step: bites and hunger. A cell that has nothing left to lose is gone. `players` are the cells that
    /// are played.
    pub fn before_step(&mut self, world: &mut World, players: &[OrganismId]) {
        if world.step_index() == 0 {
            for (player, cell) in players.iter().enumerate() {
                let _ = mark(world, *cell, player);
            }
        }
        for [by, of] in self.bites.advance(world) {
            self.bite(world, by, of);
        }
        let own = world.view().organisms().filter(|cell| line_of(*cell).is_some());
        let own: Vec<OrganismId> = own.map(|cell| cell.id()).collect();
        self.owed.retain(|(id, _)| own.contains(id));
        for id in own {
            self.starve(world, id, players.contains(&id));
        }
    }

    fn bite(&mut self, world: &mut World, by: OrganismId, of: OrganismId) {
        let bitten = world.view().organism(of).and_then(line_of);
        if let Some(line) = bitten.and_then(|line| self.lines.get_mut(line)) {
            line.biter = Some(by);
        }
        self.take(world, of, Fate::Eaten);
        // Refused while it divides, or has no room.
        if let Some(line) = world.view().organism(by).and_then(line_of) {
            let _ = world.grow(by, 0, 1);
            if let Some(line) = self.lines.get_mut(line) {
                line.feats.bites += 1;
            }
        }
    }

    /// Takes a particle from a cell; one that has no more than it lives on is gone. A cell that divides loses nothing.
    fn take(&mut self, world: &mut World, from: OrganismId, fate: Fate) {
        let Some(cell) = world.view().organism(from).filter(|cell| cell.dividing_for().is_none()) else { return };
        let line = line_of(cell);
        if cytoplasm(cell) <= LEAST || world.shrink(from, 1).is_err() {
            let _ = world.remove(from);
            if let Some(line) = line.and_then(|line| self.lines.get_mut(line)) {
                line.fate = Some(fate);
            }
        }
    }

    fn starve(&mut self, world: &mut World, id: OrganismId, is_played: bool) {
        let Some(cell) = world.view().organism(id) else { return };
        let resting = if is_played { 1.0 } else { RESTING };
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

    /// Size from which a cell can be changed once more.
    #[must_use]
    pub fn next_size(cell: OrganismView<'_>) -> f32 {
        FIRST_CHANGE.max((1_u64 << changes(cell).min(63)) as f32)
    }

    /// Time until a cell has nothing left to live on, at its present hunger, s.
    #[must_use]
    pub fn reserve(&self, cell: OrganismView<'_>, time: f32) -> f32 {
        let owed = self.owed.iter().find(|(id, _)| *id == cell.id()).map_or(0.0, |(_, owed)| *owed);
        let left = cytoplasm(cell).saturating_sub(LEAST) as f32 - owed;
        if left > 0.0 { left / self.hunger(cell, time) } else { 0.0 }
    }

    /// Looks after a step which cell a player has now: the same one, or a sister if that is gone.
    pub fn after_step(&mut self, world: &World, player: usize, cell: OrganismId) -> OrganismId {
        let view = world.view();
        let heir = view.organism(cell).or_else(|| view.organisms().find(|other| line_of(*other) == Some(player)));
        let has_grown = heir.is_some_and(|heir| self.size(heir) >= Self::next_size(heir));
        let is_own = |cell| view.organism(cell).and_then(line_of) == Some(player);
        let divided = |event: &&Event| matches!(event, Event::Divided { parent, .. } if is_own(*parent));
        let divisions = world.events().iter().filter(divided).count() as u32;
        let line = &mut self.lines[player];
        line.feats.divisions += divisions;
        if has_grown {
            line.offer_changes();
        }
        if heir.is_none() {
            line.end.get_or_insert(world.time() as f32);
        }
        heir.map_or(cell, |heir| heir.id())
    }

    /// The changes of which a player may choose one now.
    #[must_use]
    pub fn offer(&self, player: usize) -> Option<[Change; 3]> {
        self.lines.get(player)?.offer
    }

    /// Makes a change of a player's cell, and takes back what is offered.
    pub(super) fn change(&mut self, change: Change, world: &mut World, player: usize, cell: OrganismId) {
        if change.make(world, cell).is_ok() {
            self.lines[player].offer = None;
            self.lines[player].feats.changes += 1;
        }
    }

    /// Whether a cell is bitten now.
    #[must_use]
    pub fn is_bitten(&self, cell: OrganismId) -> bool {
        self.bites.is_bitten(cell)
    }

    /// How it stands for the first player, who has digested this.
    #[must_use]
    pub fn life(&self, world: &World, kinds: &[(Kind, KindScore)]) -> Option<Life> {
        let (time, line) = (self.lives(world.time() as f32).next()?, self.lines.first()?);
        let [small, cells] = prey_class::counts(kinds);
        let feats = Feats { time: time as u32, small, cells, ..line.feats };
        Some(Life { time, fate: line.fate, feats, seed: world.config().seed })
    }

    /// How the last cell of a line that is gone came to its end; `None` before, and in a replay.
    #[must_use]
    pub fn fate(&self, player: usize) -> Option<Fate> {
        self.lines.get(player)?.fate
    }

    /// Who ate the last cell of a line that is gone.
    #[must_use]
    pub fn eater(&self, player: usize) -> Option<OrganismId> {
        let line = self.lines.get(player)?;
        line.biter.filter(|_| line.fate == Some(Fate::Eaten))
    }

    /// How long each line has lived by this time, s.
    pub fn lives(&self, time: f32) -> impl Iterator<Item = f32> + '_ {
        self.lines.iter().map(move |line| line.end.unwrap_or(time))
    }

    /// Whether no cell of a player's line is left.
    #[must_use]
    pub fn is_gone(&self, player: usize) -> bool {
        self.lines.get(player).is_none_or(|line| line.end.is_some())
    }

    /// Whether no cell of any line is left.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.lines.iter().all(|line| line.end.is_some())
    }
}

/// The amoebae of no line or another one, the nearest first: those that can bite a cell, those that it can bite, and those that do neither.
#[must_use]
pub fn others(view: View<'_>, player: OrganismId) -> [Vec<Other>; 3] {
    let mut found = [const { Vec::new() }; 3];
    let Some(cell) = view.organism(player) else { return found };
    let is_other = |other: &OrganismView<'_>| other.kind() == Kind::AmoeboidCell && line_of(*other) != line_of(cell);
    for other in view.organisms().filter(is_other) {
        let sort = match (can_bite(other, cell), can_bite(cell, other)) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        found[sort].push(Other::seen(other, cell));
    }
    found.iter_mut().for_each(|others| others.sort_by(|a, b| a.distance.total_cmp(&b.distance)));
    found
}

#[cfg(test)]
mod tests;
