//! Where a cell is steered to that is pointed at food: past it, for a cell stands where it is pointed to, and would stop short of food
//! that it pushes ahead.

use super::hint::{Readiness, readiness};
use super::prey_class::{is_small, is_soft};
use microsim_core::glam::Vec2;
use microsim_core::{OrganismView, View};

/// Distance from the centre of a cell within which it slows down at a goal, in its radii, and how far it is steered past food.
const NEAR: f32 = 2.5;
/// Distance of food from the goal, and from the way there, within which it is meant, in radii of the cell: the front of a cell that
/// stands at the goal is one radius from it, and pushes food ahead.
const AT_GOAL: f32 = 2.0;
const ON_WAY: f32 = 0.8;

/// Where to steer a cell that is to go to a goal: on to the food that is meant, until that is taken in.
#[must_use]
pub fn aimed(view: View<'_>, cell: OrganismView<'_>, goal: Vec2) -> Vec2 {
    let (at, radius) = (cell.centroid(), (cell.cytoplasm_area() / std::f32::consts::PI).sqrt());
    if goal.distance(at) > NEAR * radius {
        return goal;
    }
    let from_way = |food: Vec2| {
        let way = goal - at;
        let share = ((food - at).dot(way) / way.length_squared().max(1e-6)).clamp(0.0, 1.0);
        food.distance(at + share * way)
    };
    let food = view.organisms().filter(|food| is_food(cell, *food)).map(OrganismView::centroid);
    let meant = food.filter(|food| from_way(*food) < ON_WAY * radius || food.distance(goal) < AT_GOAL * radius);
    let nearest = meant.min_by(|a, b| a.distance(goal).total_cmp(&b.distance(goal)));
    nearest.map_or(goal, |food| at + NEAR * radius * (food - at).normalize_or_zero())
}

/// Whether it can be taken in now, or goes in.
fn is_food(cell: OrganismView<'_>, food: OrganismView<'_>) -> bool {
    let is_edible = || is_small(food) || is_soft(food) && readiness(cell, food) == Some(Readiness::Ready);
    let goes_in = || cell.meals().any(|(prey, phase)| prey == food.id() && !phase.is_inside());
    food.id() != cell.id() && (food.held_by().is_none() && is_edible() || goes_in())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::brake::Brake;
    use crate::rules::food_chain;
    use crate::rules::round::Round;
    use microsim_core::scenario::{Scenario, builtin};

    fn nearest<'a>(round: &'a Round, cell: OrganismView<'_>) -> Option<OrganismView<'a>> {
        let food = round.world().view().organisms().filter(|food| is_food(cell, *food));
        let distance = |food: &OrganismView<'_>| food.centroid().distance(cell.centroid());
        food.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Plays until something holds; each so many steps the hand points so far past the nearest food, units.
    fn play(text: &str, seed: u64, hand: (u64, f32), is_plain: bool, done: impl Fn(&Round) -> bool) -> Round {
        let (mut scenario, (interval, past)) = (Scenario::parse(text, &[]).unwrap(), hand);
        scenario.set_seed(seed);
        let mut round = Round::new(&scenario).unwrap();
        let (mut brake, mut goal) = (Brake::default(), None);
        while !round.is_over() && !done(&round) {
            let view = round.world().view();
            let Some(cell) = view.organism(round.player()) else { break };
            if round.world().step_index().is_multiple_of(interval) {
                let (food, at) = (nearest(&round, cell).map(OrganismView::centroid), cell.centroid());
                goal = food.map(|food| food + past * (food - at).normalize_or_zero());
            }
            let aim = goal.map(|goal| if is_plain { goal } else { aimed(view, cell, goal) });
            let intent = brake.intent(cell, aim).digesting(true);
            round.step(intent);
        }
        round
    }

    /// Points in the game, and time until the first change in the food chain, s: means of so many rounds.
    fn measure(hand: (u64, f32), is_plain: bool, rounds: u64) -> (f64, f64) {
        let game = builtin("game").unwrap().text;
        let points = |seed| f64::from(play(game, seed, hand, is_plain, |_| false).referee().score());
        let change = |round: &Round| round.offer(0).is_some();
        let time = |seed| play(food_chain::TEXT, seed, hand, is_plain, change).world().time();
        let mean = |sum: f64| sum / rounds as f64;
        (mean((1..=rounds).map(points).sum()), mean((1..=rounds).map(time).sum()))
    }

    #[test]
    #[ignore = "minutes: a measure, MICROSIM_SEEDS rounds of each"]
    fn who_points_at_food_eats_as_much_as_who_points_past_it() {
        let rounds = std::env::var("MICROSIM_SEEDS").ok().and_then(|rounds| rounds.parse().ok()).unwrap_or(20);
        for interval in [15, 45] {
            let [plain, at, past] = [(0.0, true), (0.0, false), (15.0, true)]
                .map(|(past, is_plain)| measure((interval, past), is_plain, rounds));
            println!("every {interval} steps: plain {plain:.1?}, at {at:.1?}, past {past:.1?}");
            let share = at.0 / past.0;
            assert!(share > 0.85, "{share}");
        }
    }

    const ROOM: &str = "schema = 1\nname = \"room\"\n[world]\nsize = [120.0, 60.0]\ndamping = 1.5\nmax_speed = 24.0\n\
                        [amoeboid_cell.cell]\nradii = [7.0, 7.0]\nspeed = 11.0\n[agar.pellet]\nradius = 1.5\n\
                        [[spawn]]\nof = \"cell\"\nplayer = true\nat = [40.0, 30.0]\n[game]\ntime = 60.0\n";

    /// Where a cell ends that is pointed at a place for six seconds, and how much it took in.
    fn pointed(text: &str, goal: Vec2) -> (Vec2, usize) {
        let mut round = Round::new(&Scenario::parse(text, &[]).unwrap()).unwrap();
        let mut brake = Brake::default();
        for _ in 0..360 {
            let cell = round.world().view().organism(round.player()).unwrap();
            let intent = brake.intent(cell, Some(aimed(round.world().view(), cell, goal)));
            round.step(intent);
        }
        let cell = round.world().view().organism(round.player()).unwrap();
        (cell.centroid(), cell.meals().filter(|(_, phase)| phase.is_inside()).count())
    }

    #[test]
    fn a_cell_goes_on_to_food_that_it_pushes_from_where_it_is_pointed_to_and_stands_there_in_open_water() {
        let goal = Vec2::new(60.0, 30.0);
        let (at, _) = pointed(ROOM, goal);
        assert!(at.distance(goal) < 4.0, "it stands at {at}");
        // Food that has gone on to where the front of a cell that stands there does not quite reach.
        let food = format!("{ROOM}[[spawn]]\nof = \"pellet\"\nat = [65.5, 30.0]\n");
        let (at, inside) = pointed(&food, goal);
        assert_eq!(inside, 1, "the cell is at {at}");
        let behind = format!("{ROOM}[[spawn]]\nof = \"pellet\"\nat = [90.0, 30.0]\n");
        assert!(pointed(&behind, goal).0.distance(goal) < 4.0, "what is far is not meant");
    }
}
