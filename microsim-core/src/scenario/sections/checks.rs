//! Checks: the tables `[invariants]` and `[[expect]]`.

use crate::event::Event;
use crate::float_environment::with_default_float_environment;
use crate::scenario::reader::{Fields, Read, ReadContext, SpannedValue, ValueType, mismatch};
use crate::{Measure, World};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;
use toml::de::DeValue;

/// What must hold while a scenario runs. Show it the world after every step.
///
/// Only what the file names is measured. Events are counted from the first step that is shown.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Checks {
    invariants: Vec<Bound>,
    expectations: Vec<Expectation>,
}

/// Something that does not hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// The measure, or the kind of events that are counted.
    pub measure: &'static str,
    /// Its value.
    pub value: f64,
    /// Least and greatest value that are accepted.
    pub accepted: [f64; 2],
    /// The step after which it was seen.
    pub step: u64,
    /// Simulated time then, s.
    pub time: f64,
}

/// A quantity and the range that it must keep to.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Bound {
    quantity: Quantity,
    range: [f64; 2],
}

/// Something that must have come to pass at some time.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Expectation {
    bound: Bound,
    by: f64,
    has_come: bool,
}

/// What a file can name.
#[derive(Clone, Debug, Serialize)]
#[serde(into = "(String, u64)")]
enum Quantity {
    Measure(Measure),
    /// Events of a kind so far.
    Events {
        name: &'static str,
        count: u64,
    },
}

impl Checks {
    /// Looks at the world after a step. Returns what this step has broken: invariants in the order of the measures, then
    /// expectations whose time has come.
    pub fn after_step(&mut self, world: &World) -> Vec<Violation> {
        with_default_float_environment(|| {
            let mut broken: Vec<_> = self.invariants.iter_mut().filter_map(|bound| bound.broken(world)).collect();
            broken.extend(self.expectations.iter_mut().filter_map(|expectation| expectation.broken(world)));
            broken
        })
    }
}

impl Bound {
    fn broken(&mut self, world: &World) -> Option<Violation> {
        let value = self.quantity.value(world);
        let [low, high] = self.range;
        let (step, time) = (world.step_index(), world.time());
        let violation = Violation { measure: self.quantity.name(), value, accepted: self.range, step, time };
        (!(low..=high).contains(&value)).then_some(violation)
    }
}

impl Expectation {
    /// Broken in the step that ends its time, unless it was once fulfilled.
    fn broken(&mut self, world: &World) -> Option<Violation> {
        if self.has_come {
            return None;
        }
        let missing = self.bound.broken(world);
        let is_late = world.time() >= self.by - 0.5 * f64::from(world.config().dt);
        self.has_come = missing.is_none() || is_late;
        missing.filter(|_| is_late)
    }
}

impl Quantity {
    fn named(name: &str) -> Option<Self> {
        let measure = Measure::named(name).map(Self::Measure);
        let event = || Event::NAMES.into_iter().find(|event| *event == name);
        measure.or_else(|| event().map(|name| Self::Events { name, count: 0 }))
    }

    /// Names of all quantities.
    fn names() -> impl Iterator<Item = &'static str> {
        let measures = Measure::ALL.iter().map(|measure| measure.name());
        measures.chain(Event::NAMES.into_iter().filter(|name| Measure::named(name).is_none()))
    }

    fn name(&self) -> &'static str {
        match self {
            Self::Measure(measure) => measure.name(),
            Self::Events { name, .. } => name,
        }
    }

    /// Its value after one more step.
    fn value(&mut self, world: &World) -> f64 {
        match self {
            Self::Measure(measure) => measure.of(world),
            Self::Events { name, count } => {
                *count =
                    count.saturating_add(world.events().iter().filter(|event| event.name() == *name).count() as u64);
                *count as f64
            }
        }
    }
}

/// Its name, and how many events there were so far.
impl From<Quantity> for (String, u64) {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Measure(measure) => (measure.name().to_owned(), 0),
            Quantity::Events { name, count } => (name.to_owned(), count),
        }
    }
}

impl<'de> Deserialize<'de> for Quantity {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let (name, so_far) = <(String, u64)>::deserialize(from)?;
        let mut quantity = Self::named(&name).ok_or_else(|| D::Error::custom("a measure or a kind of events"))?;
        if let Self::Events { count, .. } = &mut quantity {
            *count = so_far;
        }
        Ok(quantity)
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {} after step {} ({:.2} s), ", self.measure, digits(self.value), self.step, self.time)?;
        match self.accepted.map(|limit| limit.is_finite().then(|| digits(limit))) {
            [None, Some(high)] => write!(f, "accepted: at most {high}"),
            [Some(low), None] => write!(f, "accepted: at least {low}"),
            [low, high] => write!(f, "accepted: {} to {}", low.unwrap_or_default(), high.unwrap_or_default()),
        }
    }
}

/// Measures and limits are `f32` where they are not counts: the shortest digits that mean them.
fn digits(value: f64) -> String {
    if value.fract() == 0.0 { value.to_string() } else { (value as f32).to_string() }
}

/// Whether something that can be bounded goes by this name.
pub(crate) fn is_quantity(name: &str) -> bool {
    Quantity::named(name).is_some()
}

/// Reads the `[invariants]` and `[[expect]]` tables.
pub(crate) fn read(root: &mut Fields<'_>) -> Checks {
    let mut fields = root.table("invariants");
    let mut invariants = Vec::new();
    for name in Quantity::names() {
        if let (Some(Range(range)), Some(quantity)) = (fields.get(name), Quantity::named(name)) {
            invariants.push(Bound { quantity, range });
        }
    }
    fields.finish();
    let mut expectations = Vec::new();
    for mut fields in root.list("expect") {
        expectations.extend(read_expectation(&mut fields));
        fields.finish();
    }
    Checks { invariants, expectations }
}

fn read_expectation(fields: &mut Fields<'_>) -> Option<Expectation> {
    let by = fields.required::<f32>("by");
    let measure = fields.required::<String>("measure");
    let min = fields.required::<f32>("min");
    let (by, measure, min) = (by?, measure?, min?);
    let Some(quantity) = Quantity::named(&measure) else {
        fields.refuse_unknown("measure", "measure", &measure, Quantity::names());
        return None;
    };
    let is_sound = fields.is_within("by", by, [0.0, 1e6]) & fields.is_within("min", min, [-1e9, 1e9]);
    let bound = Bound { quantity, range: [min.into(), f64::INFINITY] };
    is_sound.then_some(Expectation { bound, by: by.into(), has_come: false })
}

/// One number: at most that; two: least and most.
struct Range([f64; 2]);

impl Read for Range {
    fn accepted() -> String {
        "a number, the most that it may be, or [least, most]".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::Either(vec![ValueType::Number, ValueType::array(ValueType::Number, 2)])
    }

    fn written(&self) -> String {
        self.0.map(|limit| limit as f32).written()
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let range = match value.get_ref() {
            DeValue::Array(_) => <[f32; 2]>::read(value, path, context)?.map(f64::from),
            DeValue::Integer(_) | DeValue::Float(_) => [f64::NEG_INFINITY, f32::read(value, path, context)?.into()],
            _ => return mismatch(value, path, context),
        };
        if range[0] <= range[1] { Some(Self(range)) } else { mismatch(value, path, context) }
    }
}
