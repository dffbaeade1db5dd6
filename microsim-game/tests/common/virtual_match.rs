//! A match of bots over a network inside one process: time is that of the network, and all chance has a seed.

use microsim_core::scenario::Scenario;
use microsim_core::{Intent, Rng};
use microsim_game::network::pacing::Pacing;
use microsim_game::network::session::Session;
use microsim_game::network::told::Told;
use microsim_game::rules::bot::{Bot, Policy};
use microsim_game::rules::round::Round;
use microsim_game::rules::two_players;
use std::time::Instant;

/// Frames between two decisions of a bot: about as often as a hand turns.
const DECISION: u32 = 6;

/// How messages travel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Weather {
    /// Time of the way, ms, and by how much it varies.
    pub(crate) latency: f32,
    pub(crate) jitter: f32,
    /// Share of messages that are lost, and that come twice.
    pub(crate) loss: f32,
    pub(crate) doubled: f32,
    /// Share of the time in which everything is lost, in pieces of 200 ms.
    pub(crate) bursts: f32,
    /// From when to when nothing comes from the first player, ms.
    pub(crate) cut: [u32; 2],
}

/// A message under way.
struct Letter {
    due: f32,
    from: usize,
    to: usize,
    bytes: Vec<u8>,
}

/// A match.
pub(crate) struct Match {
    pub(crate) sessions: Vec<Session>,
    /// Time that each frame took to compute, ms, for all players.
    pub(crate) frame_ms: Vec<f64>,
    /// When players leave, ms.
    pub(crate) leaving: Vec<(usize, u32)>,
    pacing: Pacing,
    weather: Weather,
    seconds: f32,
    letters: Vec<Letter>,
    bots: Vec<(Bot, Intent)>,
    rng: Rng,
    pub(crate) now: f32,
}

/// The round of a match at its beginning.
pub(crate) fn round(players: usize, seconds: f32) -> Round {
    let time = ("game.time".to_owned(), seconds.to_string());
    let mut scenario = Scenario::parse(&two_players::text(players), &[time]).expect("the scenario is sound");
    scenario.set_seed(5);
    Round::new(&scenario).expect("it is a game")
}

impl Match {
    pub(crate) fn new(players: usize, seconds: f32, pacing: Pacing, weather: Weather, seed: u64) -> Self {
        let start = round(players, seconds);
        Self {
            sessions: (0..players).map(|own| Session::new(start.clone(), own, pacing)).collect(),
            frame_ms: Vec::new(),
            leaving: Vec::new(),
            pacing,
            weather,
            seconds,
            letters: Vec::new(),
            bots: (0..players).map(|k| (Bot::new(Policy::Greedy, 50 + k as u64), Intent::REST)).collect(),
            rng: Rng::new(seed, 0),
            now: 0.0,
        }
    }

    /// Plays until the round is over for all who are there, or until it takes ten times as long as it should.
    pub(crate) fn play(&mut self) {
        while self.now < 10_000.0 * (self.seconds + 1.0) && !self.is_over() {
            self.tick();
        }
    }

    pub(crate) fn is_there(&self, player: usize) -> bool {
        !self.leaving.iter().any(|&(who, when)| who == player && when as f32 <= self.now)
    }

    pub(crate) fn is_over(&self) -> bool {
        self.sessions.iter().enumerate().all(|(k, session)| !self.is_there(k) || session.is_over())
    }

    /// One frame of all.
    pub(crate) fn tick(&mut self) {
        self.now += 1000.0 * self.pacing.steps as f32 / 60.0;
        for player in (0..self.sessions.len()).filter(|&player| self.is_there(player)).collect::<Vec<_>>() {
            let began = Instant::now();
            let arrived: Vec<Letter> =
                self.letters.extract_if(.., |letter| letter.to == player && letter.due <= self.now).collect();
            let told = self.decide(player);
            let session = &mut self.sessions[player];
            for letter in arrived {
                session.receive(letter.from, &letter.bytes, self.now as u32);
            }
            // A room knows of those who have left a moment later.
            for &(who, _) in self.leaving.iter().filter(|&&(_, when)| when as f32 + 50.0 <= self.now) {
                session.leave(who);
            }
            session.advance(told);
            let packets = session.packets(self.now as u32);
            self.frame_ms.push(1000.0 * began.elapsed().as_secs_f64());
            packets.into_iter().for_each(|(to, bytes)| self.post(player, to, bytes));
        }
    }

    fn decide(&mut self, player: usize) -> Told {
        let (session, (bot, intent)) = (&self.sessions[player], &mut self.bots[player]);
        let world = session.round().world();
        if session.frame() % DECISION == 0
            && let Some(cell) = session.round().players().nth(player)
        {
            *intent = bot.intent(world, cell);
        }
        Told::new(*intent, world.config().size)
    }

    fn post(&mut self, from: usize, to: usize, bytes: Vec<u8>) {
        let weather = self.weather;
        let is_cut = from == 0 && (weather.cut[0]..weather.cut[1]).contains(&(self.now as u32));
        let piece = Rng::new(9, (self.now / 200.0) as u64).unit();
        if is_cut || piece < weather.bursts || self.rng.unit() < weather.loss {
            return;
        }
        let copies = if self.rng.unit() < weather.doubled { 2 } else { 1 };
        for _ in 0..copies {
            let due = self.now + (weather.latency + self.rng.range(-1.0, 1.0) * weather.jitter).max(0.0);
            self.letters.push(Letter { due, from, to, bytes: bytes.clone() });
        }
    }

    /// Checks that all have the world that one process computes from the same inputs. The digest of its end.
    pub(crate) fn check(&self) -> u64 {
        let first = self.sessions.iter().enumerate().find(|(k, _)| self.is_there(*k)).expect("somebody is there").1;
        let mut round = round(self.sessions.len(), self.seconds);
        let cells: Vec<_> = round.players().collect();
        let mut bots: Vec<_> = (0..cells.len()).map(|k| Bot::new(Policy::Greedy, k as u64)).collect();
        let size = round.world().config().size;
        let mut frame = 0;
        while !round.is_over() {
            for _ in 0..self.pacing.steps {
                let intent = |k: usize| match first.told(k) {
                    (_, Some(end)) if frame >= end as usize => bots[k].intent(round.world(), cells[k]),
                    (told, _) => told[frame].intent(size),
                };
                let intents: Vec<Intent> = (0..cells.len()).map(intent).collect();
                round.step_all(&intents);
            }
            frame += 1;
        }
        for session in (0..cells.len()).filter(|&k| self.is_there(k)).map(|k| &self.sessions[k]) {
            assert!(session.is_over() && session.desync().is_none(), "{:?}", session.tally());
            assert_eq!(session.round().world().digest(), round.world().digest());
            assert_eq!((session.round().scores(), session.round().record()), (round.scores(), round.record()));
        }
        round.world().digest()
    }
}
