//! Bots that play the food chain, to tune it and to test its rules.

use super::food_chain::bites::cytoplasm;
use super::food_chain::change::Change;
use super::food_chain::{Other, threats_and_victims};
use super::hint::{Readiness, readiness};
use super::path::PathMap;
use super::round::Round;
use microsim_core::glam::Vec2;
use microsim_core::{Intent, Kind, OrganismView, Rng};

/// How a bot plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skill {
    /// Does nothing.
    Idle,
    /// Goes anywhere, and changes by chance.
    Random,
    /// Goes for the nearest food, and changes by chance.
    Forager,
    /// Goes for the best food that no threat is near, flees, and changes by what that is worth.
    Survivor,
}

impl Skill {
    /// All of them, from the worst to the best.
    pub const ALL: [Self; 4] = [Self::Idle, Self::Random, Self::Forager, Self::Survivor];
}

/// Steps between two decisions.
const INTERVAL: u64 = 10;
/// Distance from the rim of a threat within which a survivor flees, and takes no food, units.
const DANGER: f32 = 13.0;
/// Time between two goals of the random bot, steps.
const PATIENCE: u64 = 120;

/// One bot.
#[derive(Clone, Debug)]
pub struct ChainBot {
    skill: Skill,
    rng: Rng,
    map: PathMap,
    intent: Intent,
}

impl ChainBot {
    /// A bot for a round; its chance depends on the round's seed.
    #[must_use]
    pub fn new(skill: Skill, round: &Round) -> Self {
        let world = round.world();
        Self { skill, rng: Rng::new(world.config().seed, 7 << 60), map: PathMap::new(world), intent: Intent::REST }
    }

    /// Plays a step. Returns the change that it has chosen before, if there was one to choose.
    pub fn step(&mut self, round: &mut Round) -> Option<Change> {
        let chosen = round.offer().map(|offer| self.choice(round, offer));
        if let Some(change) = chosen {
            round.choose(change);
        }
        self.decide(round);
        round.step(self.intent);
        chosen
    }

    fn choice(&mut self, round: &Round, offer: [Change; 3]) -> Change {
        let by_chance = offer[self.rng.next_u32() as usize % offer.len()];
        let by_worth = offer.into_iter().max_by(|a, b| worth(round, *a).total_cmp(&worth(round, *b)));
        if self.skill == Skill::Survivor { by_worth.unwrap_or(by_chance) } else { by_chance }
    }

    fn decide(&mut self, round: &Round) {
        let interval = if self.skill == Skill::Random { PATIENCE } else { INTERVAL };
        if !round.world().step_index().is_multiple_of(interval) {
            return;
        }
        let Some(cell) = round.world().view().organism(round.player()) else { return };
        let goal = match self.skill {
            Skill::Idle => None,
            Skill::Random => {
                let size = round.world().config().size;
                Some(Vec2::new(self.rng.range(0.0, size.x), self.rng.range(0.0, size.y)))
            }
            Skill::Forager => self.food(round, cell, &[]),
            Skill::Survivor => self.survive(round, cell),
        };
        let next =
            goal.map(|goal| if self.skill == Skill::Random { goal } else { self.map.next(cell.centroid(), goal) });
        self.intent = next.and_then(|next| Intent::toward(next).ok()).unwrap_or(Intent::REST).digesting(true);
    }

    fn survive(&self, round: &Round, cell: OrganismView<'_>) -> Option<Vec2> {
        let [threats, _] = threats_and_victims(round.world().view(), round.player());
        let at = cell.centroid();
        if threats.first().is_some_and(|threat| is_near(threat, at)) {
            self.refuge(round, at, &threats)
        } else {
            self.food(round, cell, &threats)
        }
    }

    /// The place of a coarse grid that is farthest from threats, on a way that leads to none.
    fn refuge(&self, round: &Round, at: Vec2, threats: &[Other]) -> Option<Vec2> {
        let size = round.world().config().size;
        let places = (0..8).flat_map(|x| (0..4).map(move |y| Vec2::new(x as f32 + 0.5, y as f32 + 0.5)));
        let places = places.map(|place| place / Vec2::new(8.0, 4.0) * size);
        let safety = |place: Vec2| {
            let way = (self.map.next(at, place) - at).normalize_or_zero();
            let ahead =
                |threat: &Other| way.dot((threat.at - at).normalize_or_zero()) * 40.0 / (1.0 + 0.1 * threat.distance);
            let risk = threats.iter().filter(|threat| threat.distance < 60.0).map(ahead).fold(-40.0, f32::max);
            threats.iter().map(|threat| threat.at.distance(place)).fold(60.0, f32::min)
                - risk
                - 0.1 * at.distance(place)
        };
        places.max_by(|a, b| safety(*a).total_cmp(&safety(*b)))
    }

    /// Where there is most to be had for the way.
    fn food(&self, round: &Round, cell: OrganismView<'_>, threats: &[Other]) -> Option<Vec2> {
        let (view, at) = (round.world().view(), cell.centroid());
        let is_greedy = self.skill == Skill::Survivor;
        let free = view.organisms().filter(|prey| prey.held_by().is_none());
        let mut found: Vec<(Vec2, f32)> = free
            .filter_map(|prey| {
                let worth = match prey.kind() {
                    Kind::Agar => 3.0,
                    Kind::Coccus => {
                        if is_greedy {
                            1.2
                        } else {
                            3.0
                        }
                    }
                    Kind::RigidCell if is_greedy && readiness(cell, prey) == Some(Readiness::Ready) => 9.0,
                    _ => return None,
                };
                Some((prey.centroid(), worth))
            })
            .collect();
        if is_greedy {
            let [_, victims] = threats_and_victims(view, round.player());
            found.extend(victims.iter().map(|victim| (victim.at, 15.0)));
        }
        let is_safe = |place: Vec2| !threats.iter().any(|threat| is_near(threat, place));
        let best = found.into_iter().filter(|(place, _)| is_safe(*place));
        let for_the_way = |&(place, worth): &(Vec2, f32)| worth / (4.0 + place.distance(at));
        best.max_by(|a, b| for_the_way(a).total_cmp(&for_the_way(b))).map(|(place, _)| place)
    }
}

fn is_near(threat: &Other, place: Vec2) -> bool {
    threat.at.distance(place) - threat.half_extent < DANGER
}

/// What a change would have been worth since the last one, particles of cytoplasm.
fn worth(round: &Round, change: Change) -> f32 {
    let (Some(chain), Some(cell)) = (round.chain(), round.world().view().organism(round.player())) else { return 0.0 };
    let ledger = chain.ledger();
    let share = |steps: u32| steps as f32 / ledger.steps.max(1) as f32;
    let gained = 0.5 * cytoplasm(cell) as f32 + ledger.hunger + ledger.bitten;
    match change {
        Change::Speed => 0.15 * gained * (1.0 - share(ledger.touching)),
        Change::StickyFront => 0.8 * gained * share(ledger.touching),
        Change::Stomach => gained * (0.1 + 0.15 * share(ledger.digesting)),
        Change::Thrift => 0.25 * ledger.hunger,
        Change::Coat => 0.5 * ledger.bitten,
        Change::WideMouth => 10.0 * ledger.too_large,
    }
}

#[cfg(test)]
mod tests {
    use super::super::food_chain::{Fate, NAME, TEXT, bites, change};
    use super::*;
    use microsim_core::replay::Replay;
    use microsim_core::scenario::Scenario;

    /// Longest round, s.
    const LONGEST: f64 = 300.0;

    fn round(seed: u64) -> Round {
        let mut scenario = Scenario::parse(TEXT, &[]).unwrap();
        scenario.set_seed(seed);
        Round::new(&scenario).unwrap()
    }

    /// A cell of this radius in a room, with what a text adds.
    fn room(radius: f32, more: &str) -> Round {
        let text = format!(
            "schema = 1\nname = \"food-chain\"\n[game]\n[world]\nsize = [90.0, 60.0]\n\
             [amoeboid_cell.cell]\nradii = [{radius}, {radius}]\n[amoeboid_cell.cell.division]\nleast_particles = 12\n\
             [[spawn]]\nof = \"cell\"\nplayer = true\nat = [20.0, 30.0]\n{more}"
        );
        Round::new(&Scenario::parse(&text, &[]).unwrap()).unwrap()
    }

    /// Plays a round to its end, or for some time, s, without a leak. Returns all offers, with what was chosen.
    fn play(skill: Skill, seed: u64, longest: f64) -> (Round, Vec<([Change; 3], Change)>) {
        let mut round = round(seed);
        let mut bot = ChainBot::new(skill, &round);
        let mut choices = Vec::new();
        while !round.is_over() && round.world().time() < longest {
            let offer = round.offer();
            choices.extend(offer.zip(bot.step(&mut round)));
            if round.world().step_index().is_multiple_of(60) {
                assert_eq!(round.world().census().leaks, 0, "{skill:?}, seed {seed}, {} s", round.world().time());
            }
        }
        (round, choices)
    }

    fn seeds() -> std::ops::RangeInclusive<u64> {
        1..=std::env::var("MICROSIM_SEEDS").map_or(5, |count| count.parse().unwrap())
    }

    #[test]
    fn who_does_nothing_starves_within_half_a_minute() {
        let (round, _) = play(Skill::Idle, 1, 31.0);
        let life = round.result().life.unwrap();
        assert!(round.is_over() && life.time > 10.0 && life.time <= 30.0, "{life:?}");
    }

    #[test]
    fn who_eats_lives_longer_and_changes_and_it_is_played_again_to_the_bit() {
        let (round, choices) = play(Skill::Survivor, 1, 30.0);
        let cell = round.world().view().organism(round.player()).expect("it lives");
        assert!(!choices.is_empty() && change::changes(cell) == choices.len() as u32, "{choices:?}");
        let mut again = Round::again(&Replay::read(&round.record().unwrap()).unwrap()).unwrap();
        while !again.is_over() {
            again.step(Intent::REST);
        }
        assert_eq!((again.mismatch(), again.world().digest()), (None, round.world().digest()));
        assert_eq!((again.player(), again.offer(), again.name()), (round.player(), None, NAME));
    }

    #[test]
    fn a_sister_is_a_second_life() {
        let mut round = room(7.0, "");
        let first = round.player();
        round.divide();
        while !round.is_over() && round.player() == first && round.world().time() < 60.0 {
            round.step(Intent::REST);
        }
        assert!(round.player() != first && !round.is_over(), "the sister is played when the first is gone");
        assert!(round.world().view().organism(first).is_none());
        while !round.is_over() && round.world().time() < 60.0 {
            round.step(Intent::REST);
            assert_eq!(round.world().census().leaks, 0);
        }
        assert_eq!(round.result().life.unwrap().fate, Some(Fate::Starved));
    }

    #[test]
    fn the_larger_bites_and_the_smaller_is_gone_in_the_end() {
        let mut round = room(
            5.0,
            "[amoeboid_cell.large]\nradii = [9.5, 9.5]\nspeed = 8.0\n[patrol.there]\nthrough = [[20.0, 30.0]]\n\
             [[spawn]]\nof = \"large\"\nat = [35.5, 30.0]\ncontroller = \"there\"\n",
        );
        let mut bitten = false;
        while !round.is_over() && round.world().time() < 20.0 {
            round.step(Intent::REST);
            bitten |= round.chain().unwrap().is_bitten(round.player());
            assert_eq!(round.world().census().leaks, 0);
        }
        let life = round.result().life.unwrap();
        assert!(bitten && round.is_over() && life.time < 12.0, "{life:?}");
        assert_eq!(life.fate, Some(Fate::Eaten));
        let large = round.world().view().organisms().next().unwrap();
        assert!(bites::cytoplasm(large) > 80, "who bites keeps what it has");
    }

    /// How long lives are with each seed, s, and all offers with what was chosen.
    fn lives(skill: Skill) -> (Vec<f64>, Vec<([Change; 3], Change)>) {
        let seeds: Vec<u64> = seeds().collect();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let played: Vec<_> = std::thread::scope(|scope| {
            let part = |seeds: &[u64]| seeds.iter().map(|&seed| play(skill, seed, LONGEST)).collect::<Vec<_>>();
            let parts = seeds.chunks(seeds.len().div_ceil(threads));
            let parts: Vec<_> = parts.map(|seeds| scope.spawn(move || part(seeds))).collect();
            parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
        });
        let (rounds, choices): (Vec<_>, Vec<_>) = played.into_iter().unzip();
        (rounds.iter().map(|round| round.world().time()).collect(), choices.into_iter().flatten().collect())
    }

    #[test]
    #[ignore = "for release builds"]
    fn lives_are_in_the_order_of_skill_and_each_change_is_the_best_one_now_and_then() {
        let mut medians = Vec::new();
        for skill in Skill::ALL {
            let (mut times, choices) = lives(skill);
            times.sort_by(f64::total_cmp);
            println!("{skill:?}: {times:.0?}");
            assert!(skill != Skill::Idle || times.iter().all(|time| *time <= 30.0));
            medians.push(times[times.len() / 2]);
            if skill == Skill::Survivor {
                assert!(medians.is_sorted(), "{medians:?}");
                shares_are_fair(&choices);
            }
        }
    }

    /// Of the times that it is offered each change is chosen by worth in 20 to 50 %.
    fn shares_are_fair(choices: &[([Change; 3], Change)]) {
        let share = |change: Change| {
            let offered = choices.iter().filter(|(offer, _)| offer.contains(&change)).count();
            let chosen = choices.iter().filter(|(_, chosen)| *chosen == change).count();
            let share = chosen as f64 / offered.max(1) as f64;
            println!("{change:?}: {chosen} of {offered}, {:.0} %", 100.0 * share);
            share
        };
        let shares = Change::ALL.map(share);
        assert!(shares.iter().all(|share| (0.2..=0.5).contains(share)), "{shares:.2?}");
    }
}
