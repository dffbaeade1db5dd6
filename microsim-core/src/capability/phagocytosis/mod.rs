//! Phagocytosis (thesis, 3.1.3): how an engulfer takes prey in, as an explicit state machine over capabilities.
//!
//! ```text
//!             conditions hold            hold time over             all of it inside
//!   (free) ------------------> Touching ---------------> Ingesting ------------------> Ingested <--> Digesting --> consumed
//!      ^                          |                        |                                 command
//!      +--- a condition fails ----+<----- all of it outside, time limit over
//! ```
//!
//! While `Ingesting`, the membrane folds around the prey and closes behind it (a cup), or the nodes of the front ignore this
//! prey (a gate). Everything else collides, and the membrane never opens for cytoplasm. The prey is drawn to the engulfer's
//! centroid, and soft prey shrinks. In the end all of the prey is inside, or all of it is outside.
//!
//! This room holds [parameters](params), state and conditions. Forces are in [`crate::behavior::phagocytosis`], transitions in
//! [`crate::world`]'s room of the same name.

pub(crate) mod params;

use crate::id::OrganismId;
pub use params::{IngestionWay, PhagocytosisParams};
use serde::{Deserialize, Serialize};

/// How prey is taken in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PreyClass {
    /// One disc: any number at a time, always digestible.
    Simple,
    /// A bacterium: taken in like simple prey, harder to digest.
    Bacterium,
    /// A soft body, or an amoeboid cell: one at a time, of the right size, with the engulfer at rest.
    Soft,
}

/// Where an engulfer and its prey stand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum MealPhase {
    /// Time for which all conditions have held, s.
    Touching(f32),
    /// Time since ingestion began, s.
    Ingesting(f32),
    /// Inside.
    Ingested,
    /// Inside, and digested by this share, 0 to 1. The share stays when the command ends.
    Digesting(f32),
}

impl MealPhase {
    /// Whether ingestion of the prey is complete.
    #[must_use]
    pub fn is_inside(self) -> bool {
        matches!(self, Self::Ingested | Self::Digesting(_))
    }
}

/// One prey of an engulfer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Meal {
    pub prey: OrganismId,
    pub class: PreyClass,
    pub phase: MealPhase,
    /// How it gets in; fixed when ingestion begins.
    pub way: IngestionWay,
    /// Membrane nodes that ignore the prey.
    pub gate: Vec<u32>,
    /// Whether its centre was outside at the time limit: it is driven out.
    pub is_expelled: bool,
}

/// The capability to ingest prey.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Engulfer {
    pub params: PhagocytosisParams,
    /// In the order in which they were first touched.
    pub meals: Vec<Meal>,
    /// Whether it is told to digest in this step.
    pub digests: bool,
    /// Area of the prey inside it or passing its gate, square units.
    pub held_area: f32,
    /// Length of membrane that the cups around prey need now, units.
    pub fold_length: f32,
    /// Digested area that has not become cytoplasm yet, square units.
    pub pending_growth: f32,
}

/// The capability to be ingested. A cell with a membrane has it while it is held: what others make of it before is up to them
/// ([`IngestionWay::WideGate`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Prey {
    pub class: PreyClass,
    /// Who holds it, from the beginning of its ingestion on.
    pub held_by: Option<OrganismId>,
}

/// Prey that touches the front of an engulfer in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Encounter {
    pub prey: OrganismId,
    pub class: PreyClass,
    /// Contacts of the prey with the engulfer's front.
    pub contacts: u32,
    /// Cosine between the way to the goal and the way to the prey; `None` if the engulfer does not move.
    pub heading: Option<f32>,
    /// Area of the engulfer's cytoplasm over the area of the prey when it was spawned.
    pub size_ratio: f32,
}

impl Meal {
    /// Whether it is going in, and by a cup.
    pub(crate) fn is_in_cup(&self) -> bool {
        self.way == IngestionWay::Cup && matches!(self.phase, MealPhase::Ingesting(_))
    }

    /// Whether it is going in, and through a gate.
    pub(crate) fn is_in_gate(&self) -> bool {
        self.way != IngestionWay::Cup && matches!(self.phase, MealPhase::Ingesting(_))
    }
}

impl Engulfer {
    pub(crate) fn new(params: PhagocytosisParams) -> Self {
        Self { params, meals: Vec::new(), digests: false, held_area: 0.0, fold_length: 0.0, pending_growth: 0.0 }
    }

    /// Whether it must not move: soft prey is going in.
    pub(crate) fn is_locked(&self) -> bool {
        let goes_in = |meal: &Meal| meal.class == PreyClass::Soft && matches!(meal.phase, MealPhase::Ingesting(_));
        self.meals.iter().any(goes_in)
    }

    /// Whether it digests something in this step.
    pub(crate) fn is_digesting(&self) -> bool {
        self.digests && self.meals.iter().any(|meal| meal.phase.is_inside())
    }

    /// Whether the one place for soft prey is taken.
    pub(crate) fn slot_is_taken(&self) -> bool {
        let takes = |meal: &Meal| meal.class == PreyClass::Soft && !matches!(meal.phase, MealPhase::Touching(_));
        self.meals.iter().any(takes)
    }

    /// Whether every condition of ingestion holds for an encounter.
    fn conditions_hold(&self, encounter: &Encounter) -> bool {
        let heads_for_it = encounter.heading.is_some_and(|cosine| cosine >= self.params.heading_cosine);
        let is_absorbable = match encounter.class {
            PreyClass::Simple | PreyClass::Bacterium => encounter.contacts > 0,
            PreyClass::Soft => encounter.contacts >= self.params.soft_prey_contacts && !self.slot_is_taken(),
        };
        let is_small = encounter.size_ratio >= self.params.size_ratio;
        heads_for_it && is_absorbable && is_small && !self.is_locked()
    }

    /// Advances meals in phase `Touching` by `dt`: adds new ones, removes those whose conditions fail, and starts the ingestion
    /// of those that have touched for the hold time. Returns the positions of these in `meals`.
    pub(crate) fn advance_touching(&mut self, encounters: &[Encounter], dt: f32) -> Vec<usize> {
        let holds: Vec<bool> = encounters.iter().map(|encounter| self.conditions_hold(encounter)).collect();
        let holds_for = |prey| encounters.iter().zip(&holds).any(|(e, &holds)| e.prey == prey && holds);
        self.meals.retain(|meal| !matches!(meal.phase, MealPhase::Touching(_)) || holds_for(meal.prey));
        for (encounter, _) in encounters.iter().zip(&holds).filter(|(_, holds)| **holds) {
            if self.meals.iter().all(|meal| meal.prey != encounter.prey) {
                let Encounter { prey, class, .. } = *encounter;
                self.meals.push(Meal {
                    prey,
                    class,
                    phase: MealPhase::Touching(0.0),
                    way: self.params.way,
                    gate: Vec::new(),
                    is_expelled: false,
                });
            }
        }
        let mut begun = Vec::new();
        for k in 0..self.meals.len() {
            let MealPhase::Touching(held) = self.meals[k].phase else { continue };
            let is_free = self.meals[k].class != PreyClass::Soft || !self.slot_is_taken();
            if held + dt >= self.params.hold_time && is_free {
                self.meals[k].phase = MealPhase::Ingesting(0.0);
                begun.push(k);
            } else {
                self.meals[k].phase = MealPhase::Touching(held + dt);
            }
        }
        begun
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 0.1;

    fn id(index: u32) -> OrganismId {
        OrganismId { index, generation: 0 }
    }

    fn encounter(index: u32, class: PreyClass) -> Encounter {
        Encounter { prey: id(index), class, contacts: 3, heading: Some(1.0), size_ratio: 5.0 }
    }

    fn steps_until_ingestion(encounter: Encounter) -> Option<usize> {
        let mut engulfer = Engulfer::new(PhagocytosisParams::default());
        (0..100).find(|_| !engulfer.advance_touching(&[encounter], DT).is_empty())
    }

    #[test]
    fn t29_conditions_must_hold_for_the_set_time() {
        assert_eq!(steps_until_ingestion(encounter(1, PreyClass::Simple)), Some(3));
        let none = |change: &dyn Fn(&mut Encounter), class| {
            let mut changed = encounter(1, class);
            change(&mut changed);
            assert_eq!(steps_until_ingestion(changed), None, "{changed:?}");
        };
        none(&|e| e.contacts = 0, PreyClass::Simple);
        none(&|e| e.heading = None, PreyClass::Simple);
        none(&|e| e.heading = Some(0.3), PreyClass::Simple);
    }

    #[test]
    fn t30_any_failure_restarts_the_hold_time() {
        let mut engulfer = Engulfer::new(PhagocytosisParams::default());
        let good = encounter(1, PreyClass::Simple);
        let bad = Encounter { heading: Some(0.0), ..good };
        for round in 0..10 {
            for _ in 0..3 {
                assert!(engulfer.advance_touching(&[good], DT).is_empty(), "round {round}");
            }
            assert!(engulfer.advance_touching(&[bad], DT).is_empty() && engulfer.meals.is_empty());
        }
    }

    #[test]
    fn t37_t38_t42_soft_prey_needs_contacts_and_all_prey_is_small() {
        let few = |class| Encounter { contacts: 1, ..encounter(1, class) };
        assert!(steps_until_ingestion(few(PreyClass::Simple)).is_some());
        assert_eq!(steps_until_ingestion(few(PreyClass::Soft)), None);
        for class in [PreyClass::Simple, PreyClass::Bacterium, PreyClass::Soft] {
            let too_large = Encounter { size_ratio: 1.99, ..encounter(1, class) };
            assert_eq!(steps_until_ingestion(too_large), None, "{class:?}");
        }
        assert!(steps_until_ingestion(encounter(1, PreyClass::Soft)).is_some());
    }

    #[test]
    fn t32_t43_several_agar_at_once_but_one_soft_prey() {
        let mut engulfer = Engulfer::new(PhagocytosisParams::default());
        let agar: Vec<Encounter> = (0..5).map(|k| encounter(k, PreyClass::Simple)).collect();
        let begun = (0..5).map(|_| engulfer.advance_touching(&agar, DT).len()).sum::<usize>();
        assert_eq!(begun, 5, "each has its own timer");
        let soft = [encounter(10, PreyClass::Soft), encounter(11, PreyClass::Soft)];
        let begun = (0..20).map(|_| engulfer.advance_touching(&soft, DT).len()).sum::<usize>();
        assert_eq!(begun, 1, "one at a time, even if both are ready in the same step");
        let held = engulfer.meals.iter().position(|meal| meal.class == PreyClass::Soft).unwrap();
        engulfer.meals[held].phase = MealPhase::Ingested;
        assert_eq!(
            (0..20).map(|_| engulfer.advance_touching(&soft[1..], DT).len()).sum::<usize>(),
            0,
            "until consumed"
        );
    }

    #[test]
    fn t39_the_engulfer_is_locked_while_soft_prey_goes_in() {
        let mut engulfer = Engulfer::new(PhagocytosisParams { hold_time: 0.0, ..PhagocytosisParams::default() });
        engulfer.advance_touching(&[encounter(1, PreyClass::Simple)], DT);
        assert!(!engulfer.is_locked());
        engulfer.advance_touching(&[encounter(1, PreyClass::Simple), encounter(2, PreyClass::Soft)], DT);
        assert!(engulfer.is_locked());
        engulfer.meals.last_mut().unwrap().phase = MealPhase::Ingested;
        assert!(!engulfer.is_locked());
    }
}
