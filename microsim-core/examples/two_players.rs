//! Two players in one process who predict each other and roll back: `cargo run --release -p microsim-core --example two_players`.
//!
//! Each has a world and a session of `ggrs`; between them is a network that is late and loses messages. Clones of the world are the
//! states that are saved.
#![allow(clippy::disallowed_types, clippy::disallowed_methods, reason = "measures time and waits, outside the world")]

use ggrs::{
    Config, GgrsRequest, Message, NonBlockingSocket, P2PSession, PlayerType, PredictRepeatLast, SessionBuilder,
    SessionState,
};
use microsim_core::Rng;
use microsim_core::prelude::*;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

/// Polls for which a message is under way.
const LATENCY: u64 = 4;
/// One message in so many is lost.
const LOSS: u32 = 10;
const STEPS: i32 = 600;

/// Where a player wants to go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Told(Option<[f32; 2]>);

#[derive(Debug)]
struct Game;

impl Config for Game {
    type InputPredictor = PredictRepeatLast;
    type Input = Told;
    type State = World;
    type Address = usize;
}

/// Messages under way: when each arrives, from whom, to whom.
struct Network {
    now: u64,
    rng: Rng,
    messages: Vec<(u64, usize, usize, Message)>,
}

/// A player's end of the network.
struct Socket(usize, Rc<RefCell<Network>>);

impl NonBlockingSocket<usize> for Socket {
    fn send_to(&mut self, message: &Message, to: &usize) {
        let mut network = self.1.borrow_mut();
        if !network.rng.next_u32().is_multiple_of(LOSS) {
            let arrival = network.now + LATENCY;
            network.messages.push((arrival, self.0, *to, message.clone()));
        }
    }

    fn receive_all_messages(&mut self) -> Vec<(usize, Message)> {
        let mut network = self.1.borrow_mut();
        let now = network.now;
        let (here, others) = std::mem::take(&mut network.messages)
            .into_iter()
            .partition(|(arrival, _, to, _)| *to == self.0 && *arrival <= now);
        network.messages = others;
        let here: Vec<(u64, usize, usize, Message)> = here;
        here.into_iter().map(|(_, from, _, message)| (from, message)).collect()
    }
}

/// One player: a world, the cells of both, and a session.
struct Player {
    number: usize,
    world: World,
    cells: [OrganismId; 2],
    session: P2PSession<Game>,
    rng: Rng,
    told: Told,
    rollbacks: u32,
}

impl Player {
    fn new(number: usize, network: &Rc<RefCell<Network>>) -> Result<Self, Box<dyn std::error::Error>> {
        let mut world = World::new(WorldConfig::default())?;
        let cell = OrganismSpec::from(AmoeboidCellSpec::default());
        let cells = [world.spawn(&cell, Placement::at(40.0, 45.0))?, world.spawn(&cell, Placement::at(120.0, 45.0))?];
        let session = SessionBuilder::new()
            .with_num_players(2)?
            .add_player(PlayerType::Local, number)?
            .add_player(PlayerType::Remote(1 - number), 1 - number)?
            .start_p2p_session(Socket(number, Rc::clone(network)))?;
        let (rng, told) = (Rng::new(5, number as u64), Told::default());
        Ok(Self { number, world, cells, session, rng, told, rollbacks: 0 })
    }

    /// Decides, and takes a step; goes back first if the other one did something else than was predicted.
    fn advance(&mut self) -> Result<(), Box<dyn std::error::Error>> {
        self.session.poll_remote_clients();
        if self.session.current_state() != SessionState::Running || self.session.current_frame() >= STEPS {
            return Ok(());
        }
        // The last predictions are to be right: nobody goes back behind the end.
        if self.session.current_frame() < STEPS - 60 && self.rng.next_u32().is_multiple_of(15) {
            self.told = Told(Some([self.rng.range(20.0, 140.0), self.rng.range(20.0, 70.0)]));
        }
        self.session.add_local_input(self.number, self.told)?;
        // Too far ahead of the other one: wait.
        let Ok(requests) = self.session.advance_frame() else { return Ok(()) };
        requests.into_iter().try_for_each(|request| self.fulfil(request))
    }

    /// Does what the session asks for: saves the world, restores it, or takes a step.
    fn fulfil(&mut self, request: GgrsRequest<Game>) -> Result<(), Box<dyn std::error::Error>> {
        match request {
            GgrsRequest::SaveGameState { cell, frame } => {
                cell.save(frame, Some(self.world.clone()), Some(self.world.digest().into()));
            }
            GgrsRequest::LoadGameState { cell, .. } => {
                self.world = cell.load().ok_or("a state that was saved is gone")?;
                self.rollbacks += 1;
            }
            GgrsRequest::AdvanceFrame { inputs: given } => {
                let mut inputs = Inputs::new();
                for (&id, (Told(goal), _)) in self.cells.iter().zip(given) {
                    let intent = goal.map_or(Ok(Intent::REST), |goal| Intent::toward(Vec2::from(goal)))?;
                    inputs.set(id, intent);
                }
                self.world.step(&inputs);
            }
        }
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let network = Rc::new(RefCell::new(Network { now: 0, rng: Rng::new(1, 1), messages: Vec::new() }));
    let mut players = [Player::new(0, &network)?, Player::new(1, &network)?];
    let begin = Instant::now();
    let is_over = |players: &[Player]| players.iter().all(|player| player.session.confirmed_frame() >= STEPS - 1);
    while !is_over(&players) {
        network.borrow_mut().now += 1;
        for player in &mut players {
            player.advance()?;
        }
        // Sessions resend by the clock.
        std::thread::sleep(Duration::from_millis(2));
        if begin.elapsed() > Duration::from_secs(120) {
            return Err("the players did not come to an end".into());
        }
    }
    let [one, other] = &players;
    println!("{} and {} rollbacks in {STEPS} steps", one.rollbacks, other.rollbacks);
    println!("digests {:016x} and {:016x}", one.world.digest(), other.world.digest());
    assert_eq!(one.world.digest(), other.world.digest());
    Ok(())
}
