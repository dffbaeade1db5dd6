//! Random sequences of calls of the public API, spelt by bytes: for property tests and for fuzzing.
//!
//! Whatever the bytes are, no call panics, the world is valid after each, a call that is refused has changed nothing, and
//! what was stepped from a clone or read from a snapshot can be had again.
#![allow(dead_code, reason = "each user needs its part")]

mod check;
mod choices;
mod environment;
mod look;
mod obstacle;
mod organism;

use choices::Choices;
use microsim_core::glam::Vec2;
use microsim_core::{
    ChemicalId, DrainId, EmitterId, Error, FieldId, Inputs, InstructionSet, JointId, ObstacleId, OrganismId,
    TemplateId, World,
};

/// Most handles of organisms that are kept, so that not all are stale.
const HANDLES: usize = 200;
type Outcome = Result<(), Error>;

/// How long a sequence may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub calls: usize,
    pub steps: u32,
    /// Whether the world is also checked after each step, not only after each call.
    pub checks_steps: bool,
}

impl Limits {
    pub(crate) const SHORT: Self = Self { calls: 60, steps: 120, checks_steps: false };
    pub(crate) const LONG: Self = Self { calls: 2500, steps: 800, checks_steps: true };
}

/// What a sequence did.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub calls: u32,
    pub refusals: u32,
    pub steps: u32,
    /// Most organisms at a time.
    pub organisms: usize,
}

/// A world, everything that was ever in it, and what is told to it.
struct Sequence<'a> {
    choices: Choices<'a>,
    world: World,
    saved: World,
    /// Digest of `saved` when it was saved.
    digest_saved: u64,
    handles: Vec<OrganismId>,
    obstacles: Vec<ObstacleId>,
    templates: Vec<TemplateId>,
    chemicals: Vec<ChemicalId>,
    joints: Vec<JointId>,
    fields: Vec<FieldId>,
    emitters: Vec<EmitterId>,
    drains: Vec<DrainId>,
    inputs: Inputs,
    tally: Tally,
    limits: Limits,
    /// What was wrong after a step.
    violation: Option<String>,
}

/// Carries out what the bytes spell.
///
/// # Errors
/// What is wrong with the world, and after which call.
pub(crate) fn run(bytes: &[u8], limits: Limits) -> Result<Tally, String> {
    let mut choices = Choices(bytes);
    let Ok(world) = World::new(choices.config()) else { return Ok(Tally::default()) };
    let mut sequence = Sequence::new(choices, world, limits);
    for _ in 0..limits.calls {
        if sequence.choices.0.is_empty() {
            break;
        }
        sequence.checked_call()?;
    }
    let _ = (sequence.save_or_restore(), sequence.write_and_read());
    Ok(sequence.tally)
}

impl<'a> Sequence<'a> {
    fn new(choices: Choices<'a>, world: World, limits: Limits) -> Self {
        Self {
            choices,
            saved: world.clone(),
            digest_saved: world.digest(),
            world,
            handles: Vec::new(),
            obstacles: Vec::new(),
            templates: Vec::new(),
            chemicals: Vec::new(),
            joints: Vec::new(),
            fields: Vec::new(),
            emitters: Vec::new(),
            drains: Vec::new(),
            inputs: Inputs::new(),
            tally: Tally::default(),
            limits,
            violation: None,
        }
    }

    /// One call; what is wrong after it.
    fn checked_call(&mut self) -> Result<(), String> {
        let before = self.world.digest();
        let (name, outcome) = self.call();
        let Tally { calls, .. } = self.tally;
        self.tally.calls += 1;
        let violation = self.violation.take().or_else(|| self.world.validate().err().map(|flaw| flaw.to_string()));
        violation.map_or(Ok(()), |violation| Err(format!("after call {calls}, {name}: {violation}")))?;
        if outcome.is_err() {
            self.tally.refusals += 1;
            if before != self.world.digest() {
                return Err(format!("call {calls}, {name}, was refused and has changed the world: {outcome:?}"));
            }
        }
        if self.saved.digest() != self.digest_saved {
            return Err(format!("call {calls}, {name}, has changed a clone"));
        }
        self.tally.organisms = self.tally.organisms.max(self.world.organisms().count());
        if self.handles.len() > HANDLES {
            let (world, mut stale) = (&self.world, 0);
            self.handles.retain(|&id| world.kind(id).is_some() || (stale += 1, stale < 20).1);
        }
        Ok(())
    }

    /// One call, and its name.
    fn call(&mut self) -> (&'static str, Outcome) {
        match self.choices.below(36) {
            0..=6 => ("spawn", self.spawn()),
            7..=12 => ("step", self.step()),
            13..=15 => ("input", self.with_handle(Self::input)),
            16 => ("divide", self.with_handle(Self::divide)),
            17 => ("fuse", self.with_two_handles(|sequence, a, b| sequence.world.fuse(a, b))),
            18 => ("grow", self.with_handle(Self::grow)),
            19 => ("remove", self.with_handle(|sequence, id| sequence.world.remove(id))),
            20 => ("set_exempt", self.with_two_handles(Self::set_exempt)),
            21 => self.obstacle_call(),
            22 => ("spawn_template", self.spawn_template()),
            23 => ("clone", self.save_or_restore()),
            24 => ("queries", self.ask()),
            25 => ("push", self.with_handle(Self::push)),
            26 => ("set_exchange", self.with_handle(Self::set_exchange)),
            27..=28 => ("actuate", self.with_handle(Self::actuate)),
            29..=30 => ("joint", self.with_two_handles(Self::change_joint)),
            31 => ("field", self.change_field()),
            32 => ("setting", self.with_handle(Self::change_setting)),
            33 => ("emitter", self.change_emitter()),
            34 => ("drain", self.change_drain()),
            _ => match self.choices.below(14) {
                which @ 0..=3 => ("set_instruction_set", self.set_instruction_set(which % 2 == 1)),
                4..=5 => ("snapshot", self.write_and_read()),
                8..=9 => ("set_size", self.set_size()),
                10..=11 => ("damping", self.with_handle(Self::damp)),
                12..=13 => ("view", self.look()),
                _ => ("set_controller", self.with_handle(Self::set_controller)),
            },
        }
    }

    fn handle(&mut self) -> Option<OrganismId> {
        let count = self.handles.len();
        (count > 0).then(|| self.handles[self.choices.below(count)])
    }

    /// A call for one of the handles, if there is any.
    fn with_handle(&mut self, call: fn(&mut Self, OrganismId) -> Outcome) -> Outcome {
        self.handle().map_or(Ok(()), |id| call(self, id))
    }

    fn with_two_handles(&mut self, call: fn(&mut Self, OrganismId, OrganismId) -> Outcome) -> Outcome {
        self.handle().zip(self.handle()).map_or(Ok(()), |(a, b)| call(self, a, b))
    }

    fn place(&mut self) -> Vec2 {
        self.choices.place(self.world.config().size)
    }

    fn step(&mut self) -> Outcome {
        for _ in 0..1 + self.choices.below(12) {
            if self.tally.steps < self.limits.steps {
                self.world.step(&self.inputs);
                self.tally.steps += 1;
                if self.limits.checks_steps && self.violation.is_none() {
                    self.violation = self.world.validate().err().map(|flaw| flaw.to_string());
                }
            }
        }
        Ok(())
    }

    fn vector(&mut self, most: f32) -> Vec2 {
        Vec2::new(self.choices.number(-most, most), self.choices.number(-most, most))
    }

    fn set_instruction_set(&mut self, best: bool) -> Outcome {
        let set = if best { InstructionSet::Best } else { InstructionSet::Baseline };
        self.world.set_instruction_set(set);
        Ok(())
    }
}
