//! Spawners: organisms of a `[[spawn]]` table that come later (`from`), or again when one is gone (`respawn`).

use super::placing::{self, Placed};
use super::sections::group::{Group, Positions};
use crate::id::OrganismId;
use crate::rng::Rng;
use crate::{CollisionGroups, World};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Streams of random numbers from here on are for spawners; those for placing lie below.
const STREAM: u64 = 3 << 61;

/// One table's organisms, those in the world and those to come.
#[derive(Clone, Debug)]
pub(super) struct Spawner {
    group: Group,
    /// Steps until one that is gone is replaced.
    respawn: Option<u64>,
    pub state: SpawnerState,
}

/// What changes of a spawner.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct SpawnerState {
    rng: Rng,
    alive: Vec<OrganismId>,
    /// Steps from which on one each is to come.
    due: Vec<u64>,
}

impl Spawner {
    /// The spawner of a group of which these are there already; `None` if nothing is to come.
    pub(super) fn new(index: usize, group: &Group, there: &[OrganismId], world: &World) -> Option<Self> {
        let steps = |time: f32| (f64::from(time) / f64::from(world.config().dt)).round() as u64;
        let due = if group.from > 0.0 { vec![steps(group.from); group.positions.count() as usize] } else { Vec::new() };
        let respawn = group.respawn.map(steps);
        (respawn.is_some() || !due.is_empty()).then(|| Self {
            group: group.clone(),
            respawn,
            state: SpawnerState {
                rng: Rng::new(world.config().seed, STREAM + index as u64),
                alive: there.to_vec(),
                due,
            },
        })
    }

    /// Notes who is gone, and puts at most one that is due into the world, if a random place is free.
    pub(super) fn before_step(&mut self, world: &mut World) {
        let now = world.step_index();
        if let Some(respawn) = self.respawn {
            let before = self.state.alive.len();
            let view = world.view();
            self.state.alive.retain(|&id| view.organism(id).is_some_and(|organism| organism.held_by().is_none()));
            self.state.due.extend((self.state.alive.len()..before).map(|_| now + respawn));
        }
        if let Some(next) = self.state.due.iter().position(|&step| step <= now)
            && let Some(id) = self.spawn(world)
        {
            self.state.due.remove(next);
            self.state.alive.push(id);
        }
    }

    fn spawn(&mut self, world: &mut World) -> Option<OrganismId> {
        let (scale, angle) = placing::draw(&self.group, &mut self.state.rng);
        let radius = self.group.prototype.extent(scale);
        let (at, gap) = match self.group.positions {
            Positions::At(at) => (at, 0.0),
            Positions::Random { within: [low, high], gap, .. } => {
                let (low, high) = (low + radius, high - radius);
                (Vec2::new(self.state.rng.range(low.x, high.x), self.state.rng.range(low.y, high.y)), gap)
            }
            Positions::Grid(_) => return None,
        };
        let meets = |id: OrganismId| {
            let tier = world.view().organism(id).and_then(|organism| organism.tier());
            tier.and_then(CollisionGroups::in_tier).is_none_or(|groups| groups.meets(self.group.groups))
        };
        if world.organisms_in_circle(at, radius + gap).any(meets) {
            return None;
        }
        let Placed { spec, placement, .. } = placing::place(&self.group, at, scale, angle);
        world.spawn(&spec, placement).ok()
    }
}
