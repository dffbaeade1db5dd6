//! Games: the table `[game]`, what a front-end needs to make a game of a scenario.

use crate::kind::Kind;
use crate::scenario::reader::Fields;
use crate::scenario::sections::group::{self, Group};

/// Time that a game lasts if the file does not say, s (thesis, 3.3.2).
const TIME: f32 = 90.0;
/// What can be taken in, and so can earn points.
pub(super) const PREY: [(&str, Kind); 4] =
    [("agar", Kind::Agar), ("coccus", Kind::Coccus), ("bacillus", Kind::Bacillus), ("rigid_cell", Kind::RigidCell)];

/// Rules of a game: the player scores by digesting what it has taken in.
#[derive(Clone, Debug, PartialEq)]
pub struct Game {
    /// Time that it lasts, s.
    pub time: f32,
    /// What digestion earns, by kind. What is not here earns nothing.
    pub points: Vec<(Kind, Points)>,
}

/// What the digestion of one organism earns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Points {
    /// For each.
    pub each: f32,
    /// For each square unit of its area when spawned.
    pub per_area: f32,
}

impl Game {
    /// Points for digesting an organism of a kind that had this area when it was spawned, rounded.
    #[must_use]
    pub fn points(&self, kind: Kind, area: f32) -> u32 {
        let known = self.points.iter().find(|(of, _)| *of == kind);
        known.map_or(0, |(_, points)| (points.each + points.per_area * area + 0.5) as u32)
    }
}

/// Reads the table, if the file has it.
pub(crate) fn read(root: &mut Fields<'_>, groups: &[Group]) -> Option<Game> {
    let is_game = root.has("game");
    let mut fields = root.table("game");
    let time = fields.number("time", TIME, [1.0, 3600.0]);
    let mut points = Vec::new();
    for (name, mut fields) in fields.named("points") {
        let each = fields.number("each", 0.0, [0.0, 1e6]);
        let per_area = fields.number("per_area", 0.0, [0.0, 1e6]);
        let (path, context) = (fields.path.clone(), fields.context);
        fields.finish();
        match PREY.iter().find(|(known, _)| *known == name) {
            Some(&(_, kind)) => points.push((kind, Points { each, per_area })),
            None if context.notes.is_some() => {}
            None => context.refuse_unknown_key(&path, "prey", &name, PREY.map(|(known, _)| known)),
        }
    }
    fields.finish();
    if is_game {
        group::require_player(root, "game", groups);
    }
    is_game.then_some(Game { time, points })
}
