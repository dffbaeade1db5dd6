//! Inputs: commands to organisms for one step, and what acts on them; the same for mouse, bot and replay.

use crate::actuation::Actuation;
use crate::error::{Error, in_range};
use crate::float_environment::with_default_float_environment;
use crate::id::OrganismId;
use glam::Vec2;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// The command to one organism for one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Intent {
    #[serde(deserialize_with = "read_goal")]
    goal: Option<Vec2>,
    digests: bool,
}

impl Intent {
    /// To stay where it is.
    pub const REST: Self = Self { goal: None, digests: false };

    /// To move towards a point. The speed does not depend on how far away it is.
    ///
    /// # Errors
    /// When a coordinate is not finite or beyond ±1 000 000.
    pub fn toward(goal: Vec2) -> Result<Self, Error> {
        in_range("goal.x", goal.x, -1e6, 1e6)?;
        in_range("goal.y", goal.y, -1e6, 1e6)?;
        // Turns -0 into +0: equal intents have equal bits.
        let goal = with_default_float_environment(|| goal + Vec2::ZERO);
        Ok(Self { goal: Some(goal), digests: false })
    }

    /// The same, and to digest what is inside (or not to).
    #[must_use]
    pub fn digesting(mut self, digests: bool) -> Self {
        self.digests = digests;
        self
    }

    /// Whether to digest what is inside.
    #[must_use]
    pub fn digests(&self) -> bool {
        self.digests
    }

    /// Where to move, if anywhere.
    #[must_use]
    pub fn goal(&self) -> Option<Vec2> {
        self.goal
    }
}

/// A goal that [`Intent::toward`] accepts.
fn read_goal<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec2>, D::Error> {
    let goal = Option::<Vec2>::deserialize(from)?;
    let intent = goal.map_or(Ok(Intent::REST), Intent::toward).map_err(D::Error::custom)?;
    Ok(intent.goal)
}

/// What organisms are told in one step, and what acts on them. An organism without an intent follows its own controller.
///
/// It holds from step to step until it is changed: an impulse acts in each step that is given it. What names something that is
/// gone by the time of the step has no effect; [`crate::World::check_inputs`] finds it.
///
/// ```
/// # use microsim_core::{Actuation, AgarSpec, Inputs, Placement, World, WorldConfig, glam::Vec2};
/// # let mut world = World::new(WorldConfig::default())?;
/// let ball = world.spawn(&AgarSpec::default().into(), Placement::at(30.0, 30.0))?;
/// let mut inputs = Inputs::new();
/// inputs.actuate(ball, Actuation::force(Vec2::new(50.0, 0.0)))?;
/// (0..30).for_each(|_| world.step(&inputs));
/// inputs.actuate(ball, Actuation::default())?;
/// assert!(world.centroid(ball).unwrap().x > 30.5);
/// # Ok::<(), microsim_core::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Record")]
pub struct Inputs {
    intents: Vec<(OrganismId, Intent)>,
    /// On an organism, or on one of its nodes.
    actuations: Vec<((OrganismId, Option<u32>), Actuation)>,
    /// By organism and channel.
    activations: Vec<((OrganismId, u32), f32)>,
}

/// Inputs as they are read, not yet checked.
#[derive(Deserialize)]
struct Record {
    intents: Vec<(OrganismId, Intent)>,
    actuations: Vec<((OrganismId, Option<u32>), Actuation)>,
    activations: Vec<((OrganismId, u32), f32)>,
}

impl Inputs {
    /// Nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Commands `organism`, in place of what it was commanded before. A handle that is stale by the time of the step has
    /// no effect.
    pub fn set(&mut self, organism: OrganismId, intent: Intent) {
        put(&mut self.intents, organism, Some(intent));
    }

    /// The command given to `organism`, if any.
    #[must_use]
    pub fn get(&self, organism: OrganismId) -> Option<Intent> {
        find(&self.intents, organism)
    }

    /// All commands, by organism.
    pub fn iter(&self) -> impl Iterator<Item = (OrganismId, Intent)> + '_ {
        self.intents.iter().copied()
    }

    /// Removes the command given to `organism`, if there is one.
    pub fn remove(&mut self, organism: OrganismId) {
        put(&mut self.intents, organism, None);
    }

    /// Lets something act on an organism as a whole, in place of what acted on it before; the default is nothing.
    ///
    /// # Errors
    /// Names the field that is out of its range.
    pub fn actuate(&mut self, organism: OrganismId, actuation: Actuation) -> Result<(), Error> {
        self.act_on(organism, None, actuation)
    }

    /// Lets something act on a node: a slot of a template, or a position in [`crate::OrganismView::particles`].
    ///
    /// # Errors
    /// Names the field that is out of its range, and a torque: a node is a point.
    pub fn actuate_node(&mut self, organism: OrganismId, node: u32, actuation: Actuation) -> Result<(), Error> {
        self.act_on(organism, Some(node), actuation)
    }

    /// Lets something act on an organism or one of its nodes.
    pub(crate) fn act_on(
        &mut self,
        organism: OrganismId,
        node: Option<u32>,
        actuation: Actuation,
    ) -> Result<(), Error> {
        actuation.validate()?;
        if node.is_some() && actuation.torque != 0.0 {
            return Err(Error::unsupported("torque", "0 for a node, which is a point"));
        }
        let acts = (actuation != Actuation::default()).then_some(actuation);
        put(&mut self.actuations, (organism, node), acts);
        Ok(())
    }

    /// What acts on an organism, or on one of its nodes.
    #[must_use]
    pub fn actuation(&self, organism: OrganismId, node: Option<u32>) -> Actuation {
        find(&self.actuations, (organism, node)).unwrap_or_default()
    }

    /// All that acts, by organism: on the whole of it, then by node.
    pub fn actuations(&self) -> impl Iterator<Item = (OrganismId, Option<u32>, Actuation)> + '_ {
        self.actuations.iter().map(|&((organism, node), actuation)| (organism, node, actuation))
    }

    /// Activates a channel of an organism: its muscles contract by this share, 0 (at rest) to 1, see
    /// [`crate::TemplateBuilder::channel`].
    ///
    /// # Errors
    /// When the activation is not within 0 to 1.
    pub fn activate(&mut self, organism: OrganismId, channel: u32, activation: f32) -> Result<(), Error> {
        in_range("activation", activation, 0.0, 1.0)?;
        put(&mut self.activations, (organism, channel), (activation > 0.0).then_some(activation));
        Ok(())
    }

    /// Activation of a channel of an organism.
    #[must_use]
    pub fn activation(&self, organism: OrganismId, channel: u32) -> f32 {
        find(&self.activations, (organism, channel)).unwrap_or_default()
    }

    /// All activations that are not 0, by organism and channel.
    pub fn activations(&self) -> impl Iterator<Item = (OrganismId, u32, f32)> + '_ {
        self.activations.iter().map(|&((organism, channel), activation)| (organism, channel, activation))
    }

    /// Takes over all that other inputs say, in place of what these say of the same.
    pub fn replace_with(&mut self, other: &Self) {
        let Self { intents, actuations, activations } = other;
        intents.iter().for_each(|&(key, value)| put(&mut self.intents, key, Some(value)));
        actuations.iter().for_each(|&(key, value)| put(&mut self.actuations, key, Some(value)));
        activations.iter().for_each(|&(key, value)| put(&mut self.activations, key, Some(value)));
    }

    /// Removes everything.
    pub fn clear(&mut self) {
        let Self { intents, actuations, activations } = self;
        intents.clear();
        actuations.clear();
        activations.clear();
    }
}

/// Puts a value into a sorted list, or takes it out.
fn put<K: Ord + Copy, V>(list: &mut Vec<(K, V)>, key: K, value: Option<V>) {
    match (list.binary_search_by_key(&key, |&(key, _)| key), value) {
        (Ok(at), Some(value)) => list[at].1 = value,
        (Ok(at), None) => drop(list.remove(at)),
        (Err(at), Some(value)) => list.insert(at, (key, value)),
        (Err(_), None) => {}
    }
}

/// A value of a sorted list.
fn find<K: Ord + Copy, V: Copy>(list: &[(K, V)], key: K) -> Option<V> {
    let at = list.binary_search_by_key(&key, |&(key, _)| key).ok()?;
    Some(list[at].1)
}

impl From<Vec<(OrganismId, Intent)>> for Inputs {
    fn from(intents: Vec<(OrganismId, Intent)>) -> Self {
        let mut inputs = Self::new();
        for (organism, intent) in intents {
            inputs.set(organism, intent);
        }
        inputs
    }
}

impl TryFrom<Record> for Inputs {
    type Error = Error;

    fn try_from(Record { intents, actuations, activations }: Record) -> Result<Self, Error> {
        let mut inputs = Self::from(intents);
        actuations.into_iter().try_for_each(|((organism, node), it)| inputs.act_on(organism, node, it))?;
        activations.into_iter().try_for_each(|((organism, channel), it)| inputs.activate(organism, channel, it))?;
        Ok(inputs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_commands_replace_earlier_ones() {
        let id = |index| OrganismId { index, generation: 0 };
        let mut inputs = Inputs::new();
        inputs.set(id(4), Intent::REST);
        inputs.set(id(1), Intent::toward(Vec2::ONE).unwrap());
        inputs.set(id(4), Intent::toward(Vec2::X).unwrap());
        assert_eq!(inputs.get(id(4)).unwrap().goal(), Some(Vec2::X));
        assert_eq!(inputs.get(id(2)), None);
        inputs.clear();
        assert_eq!(inputs.get(id(4)), None);
    }

    #[test]
    fn what_does_not_act_is_not_kept_and_what_is_out_of_range_changes_nothing() {
        let id = OrganismId { index: 3, generation: 0 };
        let mut inputs = Inputs::new();
        inputs.actuate(id, Actuation::torque(2.0)).unwrap();
        inputs.actuate_node(id, 4, Actuation::force(Vec2::X)).unwrap();
        inputs.activate(id, 1, 0.5).unwrap();
        let before = inputs.clone();
        assert_eq!(inputs.actuate_node(id, 4, Actuation::torque(1.0)).unwrap_err().field(), "torque");
        assert_eq!(inputs.actuate(id, Actuation::force(Vec2::NAN)).unwrap_err().field(), "force.x");
        assert_eq!(inputs.activate(id, 1, 1.5).unwrap_err().field(), "activation");
        assert_eq!(inputs, before);
        assert_eq!((inputs.actuation(id, Some(4)).force, inputs.activation(id, 1)), (Vec2::X, 0.5));
        inputs.actuate(id, Actuation::default()).unwrap();
        inputs.actuate_node(id, 4, Actuation::default()).unwrap();
        inputs.activate(id, 1, 0.0).unwrap();
        assert_eq!(inputs, Inputs::new());
    }

    #[test]
    fn goals_must_be_finite() {
        assert_eq!(Intent::toward(Vec2::new(0.0, f32::NAN)).unwrap_err().field(), "goal.y");
        assert_eq!(Intent::toward(Vec2::new(1e9, 0.0)).unwrap_err().field(), "goal.x");
        assert_eq!(Intent::toward(-Vec2::ZERO).unwrap().goal().unwrap().x.to_bits(), 0);
    }
}
