//! A moment of a match, and what it took to get there.

use super::told::Told;
use crate::rules::bot::{Bot, Policy};
use crate::rules::food_chain::Deed;
use crate::rules::round::Round;
use crate::rules::slide_bot::SlideBot;
use microsim_core::{Intent, OrganismId};

/// What going back cost, and what was sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Frames in which the round went back, and frames that were taken again.
    pub rollbacks: u32,
    /// See above.
    pub repeated: u32,
    /// Most frames that were taken again at once.
    pub deepest: u32,
    /// Frames that were left out: others were too far behind, or slower.
    pub waits: u32,
    /// Bytes of packets.
    pub sent: u64,
    /// See above.
    pub received: u64,
    /// Packets that no player of this version sends.
    pub refused: u32,
}

/// A moment of the match, to go back to.
#[derive(Debug)]
pub(super) struct Moment {
    pub round: Round,
    pub bots: Vec<Substitute>,
}

/// Who steers a cell whose player is not there.
#[derive(Clone, Debug)]
pub(super) enum Substitute {
    Hunter(Bot),
    OnSlide(SlideBot),
}

impl Substitute {
    pub(super) fn intent(&mut self, round: &Round, cell: OrganismId) -> Intent {
        match self {
            Self::Hunter(bot) => bot.intent(round.world(), cell),
            Self::OnSlide(bot) => bot.intent(round),
        }
    }
}

impl Moment {
    /// The beginning, with a substitute for each player.
    pub(super) fn new(round: Round) -> Self {
        let bots = if round.attempt().is_some() {
            SlideBot::all(&round).into_iter().map(Substitute::OnSlide).collect()
        } else {
            (0..round.players().count()).map(|k| Substitute::Hunter(Bot::new(Policy::Greedy, k as u64))).collect()
        };
        Self { round, bots }
    }

    /// A frame of so many steps, with what each player tells its cell; `seen` is shown every step. A bot takes the first change that
    /// it is offered.
    pub(super) fn take(&mut self, told: &[Told], steps: u32, mut seen: impl FnMut(&Round)) {
        for (player, told) in told.iter().enumerate() {
            let deed = if *told == Told::BOT { Some(Deed::Choose(0)) } else { told.deed() };
            if let Some(deed) = deed {
                self.round.act(player, deed);
            }
        }
        for _ in 0..steps {
            if self.round.is_over() {
                return;
            }
            let intents = self.intents(told);
            self.round.step_all(&intents);
            seen(&self.round);
        }
    }

    fn intents(&mut self, told: &[Told]) -> Vec<Intent> {
        let Self { round, bots } = self;
        let intent = |((told, cell), bot): ((&Told, _), &mut Substitute)| match *told {
            Told::BOT => bot.intent(round, cell),
            told => told.intent(round.world().config().size),
        };
        let players = told.iter().zip(round.players()).zip(bots);
        players.map(intent).collect()
    }
}

impl Clone for Moment {
    fn clone(&self) -> Self {
        Self { round: self.round.clone(), bots: self.bots.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        self.round.clone_from(&source.round);
        self.bots.clone_from(&source.bots);
    }
}
