//! Bots that play the food chain, to tune it and to test its rules.

use super::food_chain::bites::cytoplasm;
use super::food_chain::change::Change;
use super::food_chain::threats_and_victims;
use super::hint::{Readiness, readiness};
use super::path::PathMap;
use super::round::Round;
use super::threat::Other;
use microsim_core::glam::Vec2;
use microsim_core::{Intent, OrganismView, PreyClass, Rng};

/// How a bot plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skill {
    /// Does nothing.
    Idle,
    /// Goes anywhere, and changes by chance.
    Random,
    /// Goes for the nearest food, and changes by chance.
    Forager,
    /// Goes for the best food that no threat is near, flees, and takes the change that did best when it played on with each.
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
const RANDOM_INTERVAL: u64 = 120;
/// How long a trial of a change plays on, s, and how many trials there are of each.
const TRIAL: f64 = 20.0;
const TRIALS: u64 = 2;

/// One bot.
#[derive(Clone, Debug)]
pub struct ChainBot {
    skill: Skill,
    rng: Rng,
    map: PathMap,
    intent: Intent,
    /// Steps by which it decides sooner.
    phase: u64,
}

impl ChainBot {
    /// A bot for a round; its chance depends on the round's seed.
    #[must_use]
    pub fn new(skill: Skill, round: &Round) -> Self {
        let world = round.world();
        let (rng, map) = (Rng::new(world.config().seed, 7 << 60), PathMap::new(world));
        Self { skill, rng, map, intent: Intent::REST, phase: 0 }
    }

    /// Plays a step. Returns the change that it has chosen before, if there was one to choose.
    pub fn step(&mut self, round: &mut Round) -> Option<Change> {
        let chosen = round.offer(0).map(|offer| self.choice(round, offer));
        if let Some(change) = chosen {
            round.choose(0, change);
        }
        self.act(round);
        chosen
    }

    fn act(&mut self, round: &mut Round) {
        self.decide(round);
        round.step(self.intent);
    }

    fn choice(&mut self, round: &Round, offer: [Change; 3]) -> Change {
        if self.skill == Skill::Survivor {
            let worths = offer.map(|change| self.worth(round, change));
            let best = (1..offer.len()).fold(0, |best, k| if worths[k] > worths[best] { k } else { best });
            return offer[best];
        }
        self.any(offer)
    }

    fn any(&mut self, offer: [Change; 3]) -> Change {
        offer[self.rng.next_u32() as usize % offer.len()]
    }

    /// What a change is worth: how long the cell then lives, s, and what it has in the end; sums of the trials.
    fn worth(&self, round: &Round, change: Change) -> (f64, u32) {
        let trial = |k| {
            let mut bot = Self { phase: k * INTERVAL / TRIALS, ..self.clone() };
            bot.play_on(round, change)
        };
        (0..TRIALS).map(trial).fold((0.0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    }

    /// Plays a copy of a round on for some time; later changes are by chance.
    fn play_on(&mut self, round: &Round, change: Change) -> (f64, u32) {
        let (mut round, begin) = (round.clone(), round.world().time());
        round.change(0, change);
        while !round.is_over() && round.world().time() < begin + TRIAL {
            if let Some(offer) = round.offer(0) {
                round.choose(0, self.any(offer));
            }
            self.act(&mut round);
        }
        let cell = round.world().view().organism(round.player());
        (round.world().time() - begin, cell.map_or(0, cytoplasm))
    }

    fn decide(&mut self, round: &Round) {
        let interval = if self.skill == Skill::Random { RANDOM_INTERVAL } else { INTERVAL };
        if !(round.world().step_index() + self.phase).is_multiple_of(interval) {
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
                let worth = match prey.prey_class()? {
                    PreyClass::Bacterium if is_greedy => 1.2,
                    PreyClass::Simple | PreyClass::Bacterium => 3.0,
                    PreyClass::Soft if is_greedy && readiness(cell, prey) == Some(Readiness::Ready) => 9.0,
                    PreyClass::Soft => return None,
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
            let offer = round.offer(0);
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
        assert_eq!((again.player(), again.offer(0), again.name()), (round.player(), None, NAME));
    }

    #[test]
    fn a_sister_is_a_second_life() {
        let mut round = room(7.0, "");
        let first = round.player();
        round.divide(0);
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
    fn a_division_does_not_still_hunger() {
        let own = |round: &Round| round.world().view().organisms().map(cytoplasm).sum::<u32>();
        let rest = |a: &mut Round, b: &mut Round| [a, b].into_iter().for_each(|round| round.step(Intent::REST));
        let (mut resting, mut dividing) = (room(7.0, ""), room(7.0, ""));
        dividing.divide(0);
        while dividing.world().organisms().count() == 1 && dividing.world().time() < 20.0 {
            rest(&mut resting, &mut dividing);
        }
        rest(&mut resting, &mut dividing);
        let time = resting.world().time();
        assert!(time > 0.7 && time < 20.0, "it takes some time to divide: {time}");
        assert!(own(&dividing).abs_diff(own(&resting)) <= 2, "{} and {}", own(&dividing), own(&resting));
    }

    #[test]
    fn the_larger_bites_and_the_smaller_is_gone_in_the_end() {
        let mut round = room(
            5.0,
            "[amoeboid_cell.large]\nradii = [9.5, 9.5]\nspeed = 8.0\n[patrol.there]\nthrough = [[20.0, 30.0], [8.0, 30.0]]\n\
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

    /// What is found with each seed, on all cores.
    fn each_seed<T: Send>(find: impl Fn(u64) -> T + Sync) -> Vec<T> {
        let seeds: Vec<u64> = seeds().collect();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let part = &|seeds: &[u64]| seeds.iter().map(|&seed| find(seed)).collect::<Vec<_>>();
        std::thread::scope(|scope| {
            let parts = seeds.chunks(seeds.len().div_ceil(threads));
            let parts: Vec<_> = parts.map(|seeds| scope.spawn(move || part(seeds))).collect();
            parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
        })
    }

    /// How long lives are, s, the shortest first, and how many end eaten.
    fn lives(skill: Skill) -> Vec<f32> {
        let lives = each_seed(|seed| {
            let life = play(skill, seed, LONGEST).0.result().life.unwrap();
            println!("{skill:?}, seed {seed}: {:.0} s, {:?}", life.time, life.fate);
            life
        });
        let mut times: Vec<f32> = lives.iter().map(|life| life.time).collect();
        times.sort_by(f32::total_cmp);
        let eaten = lives.iter().filter(|life| life.fate == Some(Fate::Eaten)).count();
        println!("{skill:?}: {times:.0?}, {eaten} eaten");
        times
    }

    #[test]
    #[ignore = "for release builds"]
    fn whoever_does_nothing_starves_within_half_a_minute() {
        assert!(lives(Skill::Idle).iter().all(|time| *time <= 30.0));
    }

    #[test]
    #[ignore = "for release builds"]
    fn lives_are_in_the_order_of_skill() {
        let medians = Skill::ALL.map(lives).map(|times| times[times.len() / 2]);
        assert!(medians.is_sorted(), "{medians:?}");
    }

    /// What each change is worth at each doubling of a survivor's round; it goes on with one that is offered, by chance.
    fn worths(seed: u64) -> Vec<[(f64, u32); 6]> {
        let mut round = round(seed);
        let mut bot = ChainBot::new(Skill::Survivor, &round);
        let mut found = Vec::new();
        while !round.is_over() && round.world().time() < LONGEST {
            if let Some(offer) = round.offer(0) {
                let worths = Change::ALL.map(|change| bot.worth(&round, change));
                println!("seed {seed}, {:.0} s: {worths:.0?}", round.world().time());
                found.push(worths);
                round.choose(0, bot.any(offer));
            }
            bot.act(&mut round);
        }
        found
    }

    /// Of all offers with it, the share in which a change is worth more than the two others.
    fn share_best(worths: &[[(f64, u32); 6]], change: usize) -> f64 {
        let others: Vec<usize> = (0..6).filter(|other| *other != change).collect();
        let pairs: Vec<[usize; 2]> =
            others.iter().flat_map(|&a| others.iter().map(move |&b| [a, b])).filter(|[a, b]| a < b).collect();
        let is_best = |worths: &[(f64, u32); 6], pair: &[usize; 2]| pair.iter().all(|&k| worths[change] > worths[k]);
        let best = worths.iter().map(|worths| pairs.iter().filter(|pair| is_best(worths, pair)).count()).sum::<usize>();
        best as f64 / (worths.len() * pairs.len()) as f64
    }

    #[test]
    #[ignore = "for release builds"]
    fn each_change_is_the_best_of_three_now_and_then() {
        let worths: Vec<_> = each_seed(worths).into_iter().flatten().collect();
        let shares: [f64; 6] = std::array::from_fn(|change| share_best(&worths, change));
        println!("{} doublings, {:?}: {shares:.2?}", worths.len(), Change::ALL);
        assert!(shares.iter().all(|share| (0.2..=0.5).contains(share)), "{shares:.2?}");
    }
}
