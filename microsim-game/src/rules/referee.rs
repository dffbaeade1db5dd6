//! Score and time of a round.

use microsim_core::glam::Vec2;
use microsim_core::scenario::Game;
use microsim_core::{Event, Kind, OrganismId, World};

/// Seconds at the end of a round that are counted aloud.
const LAST_SECONDS: u32 = 10;

/// Points for one thing that was digested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gain {
    /// What it was.
    pub kind: Kind,
    /// The points.
    pub points: u32,
    /// Where it was last.
    pub at: Vec2,
}

/// What was digested of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct KindScore {
    /// How many.
    pub count: u32,
    /// Points for all of them.
    pub points: u32,
}

/// Watches a world and keeps the score of one player.
#[derive(Clone, Debug)]
pub struct Referee {
    game: Game,
    player: OrganismId,
    steps: u64,
    steps_left: u64,
    /// What the player holds: its handle is stale when it is digested.
    held: Vec<MealRecord>,
    gains: Vec<Gain>,
    kinds: Vec<(Kind, KindScore)>,
}

#[derive(Clone, Copy, Debug)]
struct MealRecord {
    prey: OrganismId,
    area: f32,
    at: Vec2,
}

impl Referee {
    /// Watches `player` from now on.
    #[must_use]
    pub fn new(game: Game, player: OrganismId, world: &World) -> Self {
        let steps = (f64::from(game.time) / f64::from(world.config().dt)).round() as u64;
        let kinds = game.points.iter().map(|(kind, _)| (*kind, KindScore::default())).collect();
        let (held, gains) = (Vec::new(), Vec::new());
        Self { game, player, steps, steps_left: steps, held, gains, kinds }
    }

    /// Watches another player from now on.
    pub fn follow(&mut self, player: OrganismId) {
        self.player = player;
    }

    /// Looks at the world after a step. When time is up, nothing counts any more.
    pub fn after_step(&mut self, world: &World) {
        self.gains.clear();
        if self.is_over() {
            return;
        }
        self.steps_left -= 1;
        for event in world.events() {
            if let Event::Consumed { engulfer, prey, kind } = *event
                && engulfer == self.player
            {
                self.count(prey, kind);
            }
        }
        self.note_held(world);
    }

    fn count(&mut self, prey: OrganismId, kind: Kind) {
        let Some(held) = self.held.iter().find(|held| held.prey == prey) else { return };
        let points = self.game.points(kind, held.area);
        self.gains.push(Gain { kind, points, at: held.at });
        if let Some((_, entry)) = self.kinds.iter_mut().find(|(of, _)| *of == kind) {
            entry.count += 1;
            entry.points += points;
        }
    }

    fn note_held(&mut self, world: &World) {
        let view = world.view();
        let meals = view.organism(self.player).into_iter().flat_map(|player| player.meals());
        let held = meals.filter_map(|(prey, _)| {
            Some(MealRecord { prey, area: view.organism(prey)?.spawn_area(), at: world.centroid(prey)? })
        });
        self.held = held.collect();
    }

    /// Points so far.
    #[must_use]
    pub fn score(&self) -> u32 {
        self.kinds.iter().map(|(_, entry)| entry.points).sum()
    }

    /// What the last step earned.
    #[must_use]
    pub fn gains(&self) -> &[Gain] {
        &self.gains
    }

    /// What was digested so far, by kind.
    #[must_use]
    pub fn kinds(&self) -> &[(Kind, KindScore)] {
        &self.kinds
    }

    /// How many of a kind were digested so far.
    #[must_use]
    pub fn digested(&self, kind: Kind) -> u32 {
        self.kinds.iter().find(|(of, _)| *of == kind).map_or(0, |(_, entry)| entry.count)
    }

    /// Time left, s.
    #[must_use]
    pub fn time_left(&self) -> f32 {
        self.game.time * (self.steps_left as f32 / self.steps as f32)
    }

    /// How many seconds are left, if one of the last ten begins with this step, or 0 if it was the last step.
    #[must_use]
    pub fn begins_second(&self) -> Option<u32> {
        let second = self.steps as f32 / self.game.time;
        let left = |steps: u64| (steps as f32 / second).ceil() as u32;
        let now = left(self.steps_left);
        (now < LAST_SECONDS && now != left(self.steps_left + 1)).then_some(now)
    }

    /// Whether time is up.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.steps_left == 0
    }

    /// The rules.
    #[must_use]
    pub fn game(&self) -> &Game {
        &self.game
    }
}
