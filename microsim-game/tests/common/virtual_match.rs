//! A match of bots over a network inside one process: time is that of the network, and all chance has a seed.

use microsim_core::scenario::Scenario;
use microsim_core::{Intent, Rng};
use microsim_game::network::rollback_pacing::Pacing;
use microsim_game::network::session::Session;
use microsim_game::network::told::Told;
use microsim_game::network::transport::Member;
use microsim_game::platform;
use microsim_game::rules::bot::{Bot, Policy};
use microsim_game::rules::food_chain::Deed;
use microsim_game::rules::round::Round;
use microsim_game::rules::two_players;
use std::ops::Range;
use std::time::Duration;

/// Frames between two decisions of a bot: about as often as a hand turns.
const DECISION: u32 = 6;

/// Time after which a room knows that somebody has left, ms.
const NOTICE: f32 = 50.0;

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
}

/// A time in which nothing comes from one member to another; the way back is its own.
#[derive(Clone, Debug)]
pub(crate) struct Cut {
    pub(crate) from: usize,
    pub(crate) to: usize,
    /// From when to when, ms.
    pub(crate) time: Range<u32>,
}

/// A message under way.
struct Letter {
    sent: f32,
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
    /// The most calls in a row in which a member took no frame, while the round was on.
    pub(crate) longest_wait: Vec<u32>,
    pub(crate) cuts: Vec<Cut>,
    /// Frames that a member's machine makes of one of the match, at a time in ms.
    pub(crate) speed: fn(usize, f32) -> f32,
    /// Time that a frame costs each member, ms.
    pub(crate) cost: [f32; 4],
    /// What a member does besides steering, in a frame that it has taken.
    pub(crate) deed: fn(usize, u32) -> Option<Deed>,
    /// When players leave, ms.
    pub(crate) leaving: Vec<(usize, u32)>,
    /// When members come, or come back, ms: they watch until a bot's cell is theirs.
    pub(crate) coming: Vec<(usize, u32)>,
    pub(crate) players: usize,
    pacing: Pacing,
    weather: Weather,
    seconds: f32,
    /// The round at its beginning.
    start: Round,
    letters: Vec<Letter>,
    bots: Vec<(Bot, Intent)>,
    rng: Rng,
    seed: u64,
    /// By member: frames that its machine owes, and calls in a row without a frame.
    owed: [f32; 4],
    waits: [u32; 4],
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
        Self::of(round(players, seconds), seconds, pacing, weather, seed)
    }

    /// A match of a round at its beginning, which takes about so long.
    pub(crate) fn of(start: Round, seconds: f32, pacing: Pacing, weather: Weather, seed: u64) -> Self {
        let players = start.players().count();
        Self {
            sessions: (0..players).map(|own| Session::new(start.clone(), own, pacing)).collect(),
            frame_ms: Vec::new(),
            longest_wait: vec![0; 4],
            cuts: Vec::new(),
            speed: |_, _| 1.0,
            cost: [0.0; 4],
            deed: |_, _| None,
            leaving: Vec::new(),
            coming: Vec::new(),
            players,
            pacing,
            weather,
            seconds,
            start,
            letters: Vec::new(),
            bots: (0..4).map(|k| (Bot::new(Policy::Greedy, 50 + k as u64), Intent::REST)).collect(),
            rng: Rng::new(seed, 0),
            seed,
            owed: [0.0; 4],
            waits: [0; 4],
            now: 0.0,
        }
    }

    /// Plays until the round is over for all who are there, or until it takes ten times as long as it should.
    pub(crate) fn play(&mut self) {
        while self.now < 10_000.0 * (self.seconds + 1.0) && !self.is_over() {
            self.tick();
        }
    }

    pub(crate) fn is_there(&self, member: usize) -> bool {
        let last = |times: &[(usize, u32)]| {
            let past = times.iter().filter(|&&(who, when)| who == member && when as f32 <= self.now);
            past.map(|&(_, when)| when + 1).max().unwrap_or(0)
        };
        let (left, came) = (last(&self.leaving), last(&self.coming));
        left < came || left == 0 && member < self.players
    }

    /// A member begins to watch.
    fn come(&mut self, member: usize) {
        let mut session = Session::watch(self.start.clone(), member as Member, self.pacing);
        let away = (0..self.players).filter(|&player| player == member || !self.is_there(player));
        away.for_each(|player| session.leave(player));
        if member < self.sessions.len() { self.sessions[member] = session } else { self.sessions.push(session) }
    }

    /// The seat of a member, as a session knows it.
    fn seat_of(&self, session: &Session, member: usize) -> Option<usize> {
        let mut present = session.present();
        present.find(|&player| session.successor(player).map_or(player, usize::from) == member)
    }

    pub(crate) fn is_over(&self) -> bool {
        self.sessions.iter().enumerate().all(|(k, session)| !self.is_there(k) || session.is_over())
    }

    /// The time of one frame.
    pub(crate) fn tick(&mut self) {
        let before = self.now;
        self.now += 1000.0 * self.pacing.steps as f32 / 60.0;
        let is_due = |when: u32| before < when as f32 && when as f32 <= self.now;
        let came: Vec<usize> =
            self.coming.iter().filter(|(_, when)| is_due(*when)).map(|(member, _)| *member).collect();
        came.into_iter().for_each(|member| self.come(member));
        for member in (0..self.sessions.len()).filter(|&member| self.is_there(member)).collect::<Vec<_>>() {
            self.owed[member] += (self.speed)(member, self.now);
            while self.owed[member] >= 1.0 {
                self.owed[member] -= 1.0;
                self.call(member);
            }
        }
    }

    /// A member's machine makes a frame.
    fn call(&mut self, member: usize) {
        let began = platform::now();
        self.deliver(member);
        self.notice_those_who_left(member);
        let told = self.decide(member);
        let session = &mut self.sessions[member];
        // As many as a window takes in a frame.
        (0..20).take_while(|_| session.is_behind() && session.catch_up()).for_each(drop);
        let before = session.tally().repeated;
        let is_taken = session.advance(told);
        let frames = session.tally().repeated - before + u32::from(is_taken);
        session.note_time(Duration::from_secs_f32(self.cost[member] * frames as f32 / 1000.0));
        let is_taken = is_taken || session.round().is_over();
        self.waits[member] = if is_taken { 0 } else { self.waits[member] + 1 };
        self.longest_wait[member] = self.longest_wait[member].max(self.waits[member]);
        let (packets, guests) = (session.packets(self.now as u32), session.guest_packets(self.now as u32));
        self.frame_ms.push(1000.0 * (platform::now() - began).as_secs_f64());
        for (seat, bytes) in packets {
            let to = self.sessions[member].successor(seat).map_or(seat, usize::from);
            self.post(member, to, bytes);
        }
        guests.into_iter().for_each(|(to, bytes)| self.post(member, to.into(), bytes));
    }

    /// A member receives the letters that have arrived by now.
    fn deliver(&mut self, member: usize) {
        let arrived: Vec<Letter> =
            self.letters.extract_if(.., |letter| letter.to == member && letter.due <= self.now).collect();
        for letter in arrived {
            if self.is_stale(&letter) {
                continue;
            }
            match self.seat_of(&self.sessions[member], letter.from) {
                Some(seat) => self.sessions[member].receive(seat, &letter.bytes, self.now as u32),
                None => self.sessions[member].receive_guest(letter.from as Member, &letter.bytes, self.now as u32),
            }
        }
    }

    /// Whether it is of a connection that has ended: a room drops what comes of those who have left, and nothing waits for who comes.
    fn is_stale(&self, letter: &Letter) -> bool {
        let has_left = |&(who, when): &(usize, u32)| who == letter.from && letter.sent <= when as f32;
        let has_come = |&(who, when): &(usize, u32)| who == letter.to && letter.sent < when as f32;
        let is_known = |&(_, when): &(usize, u32)| when as f32 + NOTICE <= self.now;
        self.leaving.iter().filter(|left| is_known(left)).any(has_left)
            || self.coming.iter().any(|came| has_come(came) && came.1 as f32 <= self.now)
    }

    /// A room knows of those who have left a moment later, and gives their cells away.
    fn notice_those_who_left(&mut self, member: usize) {
        let is_known = |&(who, when): &(usize, u32)| when as f32 + NOTICE <= self.now && !self.is_there(who);
        let gone: Vec<usize> = self.leaving.iter().copied().filter(is_known).map(|(who, _)| who).collect();
        for who in gone {
            if let Some(seat) = self.seat_of(&self.sessions[member], who) {
                self.sessions[member].leave(seat);
            }
        }
        let session = &mut self.sessions[member];
        for guest in session.wanting().into_iter().filter(|_| session.leads()).collect::<Vec<_>>() {
            let away = (0..self.players).find(|player| session.present().all(|there| there != *player));
            away.into_iter().for_each(|player| session.seat(player, guest));
        }
    }

    fn decide(&mut self, member: usize) -> Told {
        let (session, (bot, intent)) = (&self.sessions[member], &mut self.bots[member]);
        let world = session.round().world();
        if session.frame() % DECISION == 0
            && let Some(cell) = session.own().and_then(|own| session.round().players().nth(own))
        {
            *intent = bot.intent(world, cell);
        }
        Told::new(*intent, world.config().size).doing((self.deed)(member, session.frame()))
    }

    fn post(&mut self, from: usize, to: usize, bytes: Vec<u8>) {
        let weather = self.weather;
        let is_on = |cut: &Cut| (cut.from, cut.to) == (from, to) && cut.time.contains(&(self.now as u32));
        let is_cut = self.cuts.iter().any(is_on);
        let piece = Rng::new(self.seed, 1 + (self.now / 200.0) as u64).unit();
        if is_cut || piece < weather.bursts || self.rng.unit() < weather.loss {
            return;
        }
        let copies = if self.rng.unit() < weather.doubled { 2 } else { 1 };
        for _ in 0..copies {
            let due = self.now + (weather.latency + self.rng.range(-1.0, 1.0) * weather.jitter).max(0.0);
            self.letters.push(Letter { sent: self.now, due, from, to, bytes: bytes.clone() });
        }
    }

    /// Checks that all have the world that one process computes from the same inputs. The digest of its end.
    pub(crate) fn check(&self) -> u64 {
        let there: Vec<&Session> =
            (0..self.sessions.len()).filter(|&k| self.is_there(k)).map(|k| &self.sessions[k]).collect();
        for session in &there {
            assert!(session.is_over() && session.desync().is_none(), "{:?}", session.tally());
        }
        let first = there.first().expect("somebody is there");
        let mut round = self.start.clone();
        let mut bots: Vec<_> = (0..self.players).map(|k| Bot::new(Policy::Greedy, k as u64)).collect();
        let size = round.world().config().size;
        let mut frame = 0;
        while !round.is_over() {
            let told: Vec<Told> = (0..self.players).map(|k| told(first, k, frame)).collect();
            for (k, told) in told.iter().enumerate() {
                // A bot takes the first change that it is offered.
                let deed = if *told == Told::BOT { Some(Deed::Choose(0)) } else { told.deed() };
                deed.into_iter().for_each(|deed| round.act(k, deed));
            }
            for _ in 0..self.pacing.steps {
                let cells: Vec<_> = round.players().collect();
                let intent = |k: usize| match told[k] {
                    Told::BOT => bots[k].intent(round.world(), cells[k]),
                    told => told.intent(size),
                };
                let intents: Vec<Intent> = (0..cells.len()).map(intent).collect();
                round.step_all(&intents);
            }
            frame += 1;
        }
        for session in there {
            assert_eq!(session.round().world().digest(), round.world().digest());
            assert_eq!((session.round().scores(), session.round().record()), (round.scores(), round.record()));
        }
        round.world().digest()
    }
}

/// What a player has told its cell in a frame.
fn told(session: &Session, player: usize, frame: usize) -> Told {
    match session.told(player) {
        (_, Some(end)) if frame >= end as usize => Told::BOT,
        (told, _) => told[frame],
    }
}
