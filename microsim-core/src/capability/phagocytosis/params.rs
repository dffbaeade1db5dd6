//! Parameters of phagocytosis: conditions, speeds, and times of digestion.

use crate::error::Error;
use crate::spec_field::FieldValue::{Count, Number, Triple, Word};
use crate::spec_field::{FieldVisitor, check, field};
use serde::{Deserialize, Serialize};

/// How prey gets through the membrane. Default: the cup. It never opens the outline, relaxes without a void behind the prey,
/// and leaves a phagosome; it takes two to four times as long as the gate, and room for the fold: cells with fewer than 36
/// membrane nodes use a gate whatever is asked, for prey with a radius below a node's or above 0.45 of the cell's (soft prey: when
/// it has shrunk) all do, and for all prey in substeps longer than 1/360 s. A cup that has not closed in three quarters of the time
/// limit becomes a gate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum IngestionWay {
    /// The membrane next to the prey ignores it until it is inside, as in the thesis.
    Gate,
    /// The membrane folds around the prey and the lips of the fold meet, as in real cells. The arc around the prey is cut off
    /// and encloses it inside the cell: the phagosome.
    Cup,
    /// A gate that lets other amoeboid cells in, too, whole and alive, as it lets in any soft prey: those that neither divide nor
    /// hold prey themselves, and are small enough.
    WideGate,
}

/// Parameters of phagocytosis that the thesis leaves open.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhagocytosisParams {
    /// How prey gets through the membrane.
    pub way: IngestionWay,
    /// Time for which all conditions must hold before ingestion starts, s, 0 to 10. Any failure restarts it.
    pub hold_time: f32,
    /// Largest angle between the way to the goal and the way to the prey, as a cosine, -1 to 1.
    pub heading_cosine: f32,
    /// Contacts of soft prey with the front that are needed at once, 1 to 100.
    pub soft_prey_contacts: u32,
    /// Area of the engulfer's cytoplasm over the prey's area when spawned (a cell's: at rest), at least, for prey of every kind, 1
    /// to 1000: a cell does not go round what is larger than itself.
    pub size_ratio: f32,
    /// Time after which prey that is wholly outside is released, s, 0.1 to 60. Prey that is partly inside then is drawn to
    /// the side where its centre is, and after as much time again put there, but for cells. Soft prey has shrunk to its scale after a fixed
    /// share of this time.
    pub time_limit: f32,
    /// Speed at which prey is drawn to the centroid, units/s, 0.1 to 100.
    pub pull_speed: f32,
    /// Acceleration with which it is drawn, units/s2, 1 to 100 000: times its mass, the force.
    pub pull_acceleration: f32,
    /// Speed of each lip of a cup, units/s, 0.1 to 20.
    pub lip_speed: f32,
    /// Longest link that may close the ring behind prey in a cup, in rest lengths, 1 to 1.25.
    pub closing_length: f32,
    /// Size to which soft prey shrinks while it goes in, relative to its own, 0.05 to 1.
    pub soft_prey_scale: f32,
    /// Time of digestion of simple prey, of bacteria and of soft prey, s, 0.05 to 60.
    pub digestion_time: [f32; 3],
    /// Share of its speed that an engulfer keeps while it digests, 0 to 1.
    pub digestion_speed: f32,
    /// Area gained over area digested, 0 to 4.
    pub growth_yield: f32,
}

impl Default for PhagocytosisParams {
    fn default() -> Self {
        Self {
            way: IngestionWay::Cup,
            hold_time: 0.35,
            heading_cosine: 0.6,
            soft_prey_contacts: 2,
            size_ratio: 2.0,
            time_limit: 3.0,
            pull_speed: 6.0,
            pull_acceleration: 4000.0,
            lip_speed: 6.0,
            closing_length: 1.2,
            soft_prey_scale: 0.5,
            digestion_time: [0.6, 1.2, 2.0],
            digestion_speed: 0.35,
            growth_yield: 1.0,
        }
    }
}

impl PhagocytosisParams {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        check(*self, Self::fields)
    }

    pub(crate) fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        const WAYS: [IngestionWay; 3] = [IngestionWay::Gate, IngestionWay::Cup, IngestionWay::WideGate];
        let words = "How prey gets through the membrane: a cup folds around it, a gate lets it through, a wide one other cells, too.";
        let mut way = self.way as usize;
        visit(field("way", words), Word(&mut way, &["gate", "cup", "wide_gate"]));
        self.way = WAYS[way];
        let words = "Time for which all conditions must hold before ingestion starts, s.";
        visit(field("hold_time", words), Number(&mut self.hold_time, [0.0, 10.0]));
        let words = "Largest angle between the ways to the goal and to the prey, as a cosine.";
        visit(field("heading_cosine", words), Number(&mut self.heading_cosine, [-1.0, 1.0]));
        let words = "Contacts of soft prey with the front that are needed at once.";
        visit(field("soft_prey_contacts", words), Count(&mut self.soft_prey_contacts, [1, 100]));
        let words = "Least area of its cytoplasm over the area of its prey.";
        visit(field("size_ratio", words), Number(&mut self.size_ratio, [1.0, 1000.0]));
        let words = "Time after which prey that is still outside is let go, s.";
        visit(field("time_limit", words), Number(&mut self.time_limit, [0.1, 60.0]));
        let words = "Speed at which prey is drawn in, micrometres/s.";
        visit(field("pull_speed", words), Number(&mut self.pull_speed, [0.1, 100.0]));
        let words = "Acceleration with which it is drawn in, micrometres/s2.";
        visit(field("pull_acceleration", words), Number(&mut self.pull_acceleration, [1.0, 1e5]));
        let words = "Speed of each lip of a cup, micrometres/s.";
        visit(field("lip_speed", words), Number(&mut self.lip_speed, [0.1, 20.0]));
        let words = "Longest link that may close the ring behind prey in a cup, in rest lengths.";
        visit(field("closing_length", words), Number(&mut self.closing_length, [1.0, 1.25]));
        let words = "Size to which soft prey shrinks while it goes in, relative to its own.";
        visit(field("soft_prey_scale", words), Number(&mut self.soft_prey_scale, [0.05, 1.0]));
        let words = "Time of digestion of simple prey, of bacteria and of soft prey, s.";
        visit(field("digestion_time", words), Triple(&mut self.digestion_time, [0.05, 60.0]));
        let words = "Share of its speed that it keeps while it digests.";
        visit(field("digestion_speed", words), Number(&mut self.digestion_speed, [0.0, 1.0]));
        visit(field("growth_yield", "Area gained over area digested."), Number(&mut self.growth_yield, [0.0, 4.0]));
    }
}
