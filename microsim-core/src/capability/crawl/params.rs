//! Parameters of a crawl by pseudopods. They have no unit of length or time: a type of amoeba is the same at every size and speed.

use crate::error::Error;
use crate::spec_field::FieldValue::Number;
use crate::spec_field::{FieldVisitor, check, field};
use serde::{Deserialize, Serialize};

/// How a cell crawls by pseudopods. Times are in those in which it crawls its own radius.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PseudopodParams {
    /// Pseudopods that a quiet cell starts per time, 0.1 to 100.
    pub start_rate: f32,
    /// Time for which a pseudopod grows, 0.02 to 100.
    pub life: f32,
    /// Share of the membrane that a pseudopod starts with, 0.02 to 0.6.
    pub width: f32,
    /// Share of the membrane that is active at most, 0.05 to 1.
    pub coverage: f32,
    /// Share of pseudopods that start beside the last one rather than anywhere, 0 to 1.
    pub split_share: f32,
    /// Mean angle between a pseudopod and the one that splits off it, degrees, 0 to 180.
    pub split_angle: f32,
    /// Standard deviation of that angle, degrees, 0 to 90.
    pub split_spread: f32,
    /// Share of pseudopods that split off on the other side than the one before, where the goal favours neither, 0 to 1.
    pub alternation: f32,
    /// How far the goal lowers the threshold of nodes that face it, 0 to 0.5; that at rest is 0.2.
    pub goal_bias: f32,
    /// Speed of a tip, in the cell's, 0.2 to 5.
    pub tip_speed: f32,
    /// Share of the membrane's bending stiffness that is left while it crawls, 0.01 to 1.
    pub stiffness: f32,
    /// Length that the membrane gains while it crawls, in perimeters at rest, 0 to 1.
    pub slack: f32,
    /// How far the cell spreads, and becomes thinner, with the activity of its membrane: its area varies by this share between none and
    /// as much as can be, 0 to 1.
    pub spreading: f32,
}

impl Default for PseudopodParams {
    fn default() -> Self {
        Self::NEUTROPHIL
    }
}

impl PseudopodParams {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        check(*self, Self::fields)
    }

    pub(crate) fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        let words = "Pseudopods that a quiet cell starts in the time in which it crawls its radius.";
        visit(field("start_rate", words), Number(&mut self.start_rate, [0.1, 100.0]));
        let words = "Time for which a pseudopod grows, in those in which the cell crawls its radius.";
        visit(field("life", words), Number(&mut self.life, [0.02, 100.0]));
        let words = "Share of the membrane that a pseudopod starts with.";
        visit(field("width", words), Number(&mut self.width, [0.02, 0.6]));
        let words = "Share of the membrane that is active at most.";
        visit(field("coverage", words), Number(&mut self.coverage, [0.05, 1.0]));
        let words = "Share of pseudopods that start beside the last one rather than anywhere.";
        visit(field("split_share", words), Number(&mut self.split_share, [0.0, 1.0]));
        let words = "Mean angle between a pseudopod and the one that splits off it, degrees.";
        visit(field("split_angle", words), Number(&mut self.split_angle, [0.0, 180.0]));
        let words = "Standard deviation of that angle, degrees.";
        visit(field("split_spread", words), Number(&mut self.split_spread, [0.0, 90.0]));
        let words = "Share of pseudopods that split off on the other side than the one before.";
        visit(field("alternation", words), Number(&mut self.alternation, [0.0, 1.0]));
        let words = "How far the goal lowers the threshold of the membrane that faces it.";
        visit(field("goal_bias", words), Number(&mut self.goal_bias, [0.0, 0.5]));
        let words = "Speed of a tip, in the cell's.";
        visit(field("tip_speed", words), Number(&mut self.tip_speed, [0.2, 5.0]));
        let words = "Share of the membrane's bending stiffness that is left while it crawls.";
        visit(field("stiffness", words), Number(&mut self.stiffness, [0.01, 1.0]));
        let words = "Length that the membrane gains while it crawls, in perimeters at rest.";
        visit(field("slack", words), Number(&mut self.slack, [0.0, 1.0]));
        let words = "Share by which the cell's area varies with the activity of its membrane.";
        visit(field("spreading", words), Number(&mut self.spreading, [0.0, 1.0]));
    }
}
