//! What steers the cells of those who play in this window: mouse, arrow keys, and the brake when they let go.

use crate::camera::Camera;
use crate::hud::marks;
use crate::input::Input;
use crate::rules::aim::aimed;
use crate::rules::brake::Brake;
use crate::rules::hint::{Hints, PreyTarget};
use crate::rules::lesson::FirstDeed;
use crate::rules::round::Round;
use crate::rules::two_players::TwoPlayers;
use crate::ui::pen::Pen;
use crate::words::{self, Key};
use microsim_core::glam::Vec2;
use microsim_core::{Intent, OrganismId, OrganismView, View};
use std::ops::Range;

/// Distance of the goal to which arrow keys steer, units: speed does not depend on it.
const STEERED: f32 = 30.0;

/// When it is said how to change the optics, s.
const OPTICS_TIME: Range<f64> = 40.0..46.0;

/// The hands of up to two players.
#[derive(Debug, Default)]
pub(super) struct Hands {
    /// Whether the mouse steers.
    pub is_crawling: bool,
    brakes: [Brake; 2],
}

impl Hands {
    /// Notes whether the mouse steers: while its button is down, or from one click to the next.
    pub(super) fn note(&mut self, input: &Input, is_toggled: bool) {
        if !is_toggled {
            self.is_crawling = input.is_held;
        } else if input.is_clicked {
            self.is_crawling ^= true;
        }
    }

    /// Where the players steer to. One has mouse and arrow keys; of two the first has the mouse, the second the keys.
    pub(super) fn goals(
        &self,
        input: &Input,
        camera: &Camera,
        round: &Round,
        two: Option<TwoPlayers>,
    ) -> [Option<Vec2>; 2] {
        match two {
            None | Some(TwoPlayers::Bot) => [self.goal(input, camera, round, 0), None],
            Some(_) => [self.by_mouse(input, camera, round, 0), by_keys(input, round, 1)],
        }
    }

    /// Where one player steers to that has mouse and arrow keys.
    pub(super) fn goal(&self, input: &Input, camera: &Camera, round: &Round, player: usize) -> Option<Vec2> {
        by_keys(input, round, player).or(self.by_mouse(input, camera, round, player))
    }

    fn by_mouse(&self, input: &Input, camera: &Camera, round: &Round, player: usize) -> Option<Vec2> {
        let (goal, view) = (self.is_crawling.then(|| camera.to_room(input.cursor))?, round.world().view());
        let cell = round.players().nth(player).and_then(|cell| view.organism(cell));
        Some(cell.map_or(goal, |cell| aimed(view, cell, goal)))
    }

    /// What the cell of a player does in a step.
    pub(super) fn intent(&mut self, hand: usize, round: &Round, player: usize, goal: Option<Vec2>) -> Intent {
        let cell = round.players().nth(player).and_then(|cell| round.world().view().organism(cell));
        let Some((cell, brake)) = cell.zip(self.brakes.get_mut(hand)) else { return Intent::REST };
        // Who lets go goes on as far as a lunge goes.
        let ahead = || round.lunge_of(player).is_on().then(|| cell.centroid() + STEERED * brake.heading());
        brake.intent(cell, goal.or_else(ahead))
    }

    /// What all who play do in a step. Only the first one may have to hold a key to digest.
    pub(super) fn intents(&mut self, round: &Round, goals: [Option<Vec2>; 2], digests: bool) -> Vec<Intent> {
        let steered = (0..round.players().count()).zip(goals);
        steered.map(|(k, goal)| self.intent(k, round, k, goal).digesting(k > 0 || digests)).collect()
    }
}

fn by_keys(input: &Input, round: &Round, player: usize) -> Option<Vec2> {
    let cell = round.world().view().organism(round.players().nth(player)?)?;
    let way = STEERED * Vec2::new(input.steer.x, -input.steer.y);
    (way != Vec2::ZERO).then(|| cell.centroid() + way)
}

/// What the player holds to crawl.
pub(super) fn held_to_crawl(has_buttons: bool) -> &'static str {
    if has_buttons { words::text(Key::HintFinger) } else { words::text(Key::HintMouse) }
}

/// How to do what a newcomer has to do first.
pub(super) fn first_advice(deed: FirstDeed, has_buttons: bool) -> String {
    match deed {
        FirstDeed::Crawl => words::text_with(Key::HintCrawl, &[("what", held_to_crawl(has_buttons).into())]),
        FirstDeed::Eat => words::text(Key::HintEat).to_owned(),
    }
}

/// How to change the optics, when a round has gone on for a while.
pub(super) fn optics_advice(time: f64, key: &str) -> Option<String> {
    OPTICS_TIME.contains(&time).then(|| words::text_with(Key::LessonOptics, &[("key", key.into())]))
}

/// Targets of one who plays, the nearest first, but for those to which another one is nearer: each is marked once.
pub(super) fn targets_of(round: &Round, view: View<'_>, player: OrganismId, hints: &Hints) -> Vec<PreyTarget> {
    let distance = |id, at| view.organism(id).map(|cell| cell.centroid().distance(at));
    let is_own = |target: &&PreyTarget| {
        let others = round.players().filter(|other| *other != player);
        others
            .filter_map(|other| distance(other, target.at))
            .all(|other| distance(player, target.at).is_some_and(|own| own <= other))
    };
    let mut targets: Vec<PreyTarget> = hints.targets.iter().filter(is_own).copied().collect();
    if let Some(at) = view.organism(player).map(OrganismView::centroid) {
        targets.sort_by(|a, b| a.at.distance_squared(at).total_cmp(&b.at.distance_squared(at)));
    }
    targets
}

/// Marks what a player holds and could take in.
pub(super) fn draw_prey(
    pen: &mut Pen,
    style: &marks::Style<'_>,
    taken: &mut marks::MarkLayout,
    round: &Round,
    view: View<'_>,
    player: OrganismId,
) {
    let hints = Hints::of(view, player);
    marks::draw_held(pen, style, taken, &hints.held);
    marks::draw_targets(pen, style, taken, &targets_of(round, view, player, &hints));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::gamepad::{Gamepad, Hand};
    use crate::rules::two_players::TEXT;
    use microsim_core::scenario::Scenario;

    #[test]
    fn a_gamepad_steers_the_second_of_two_cells_and_the_only_one() {
        let round = Round::new(&Scenario::parse(TEXT, &[]).unwrap()).unwrap();
        let camera = Camera::whole(round.world().config().size, Vec2::new(640.0, 360.0));
        let mut input = Input::default();
        Hand::default().add(&[Gamepad { stick: Vec2::X, down: Vec::new() }], true, &mut input);
        let at: Vec<Vec2> = round.players().filter_map(|cell| round.world().centroid(cell)).collect();
        let goals = |two| Hands::default().goals(&input, &camera, &round, two);
        let right = |at: Vec2| Some(at + Vec2::new(STEERED, 0.0));
        let near = |a: Option<Vec2>, b: Option<Vec2>| a.zip(b).is_some_and(|(a, b)| a.distance(b) < 0.1);
        let [first, second] = goals(Some(TwoPlayers::Versus));
        assert!(first.is_none() && near(second, right(at[1])), "{first:?} {second:?}");
        let [first, second] = goals(None);
        assert!(near(first, right(at[0])) && second.is_none(), "{first:?} {second:?}");
    }

    #[test]
    fn the_mouse_on_food_steers_past_it_and_arrow_keys_go_where_they_point() {
        let text = "schema = 1\nname = \"room\"\n[world]\nsize = [160.0, 90.0]\n[amoeboid_cell.cell]\nradii = [7.0, 7.0]\n\
                    [agar.pellet]\nradius = 1.5\n[[spawn]]\nof = \"cell\"\nplayer = true\nat = [40.0, 45.0]\n\
                    [[spawn]]\nof = \"pellet\"\nat = [49.0, 45.0]\n[game]\ntime = 60.0\n";
        let round = Round::new(&Scenario::parse(text, &[]).unwrap()).unwrap();
        let camera = Camera::whole(round.world().config().size, Vec2::new(640.0, 360.0));
        let hands = Hands { is_crawling: true, ..Hands::default() };
        let goal = |at: Vec2| {
            let input = Input { cursor: camera.to_screen(at), ..Input::default() };
            hands.goal(&input, &camera, &round, 0).unwrap()
        };
        let past = goal(Vec2::new(49.0, 45.0)).x;
        assert!(past > 50.0, "past the food: {past}");
        assert!(goal(Vec2::new(30.0, 45.0)).distance(Vec2::new(30.0, 45.0)) < 0.5, "into open water");
        let input = Input { steer: -Vec2::X, ..Input::default() };
        assert!((hands.goal(&input, &camera, &round, 0).unwrap().x - 10.0).abs() < 0.5);
    }
}
