//! The table of organisms: who is there, who has a membrane, who holds whom.

use super::living::{Organism, Phagosome};
use crate::arena::Arena;
use crate::capability::phagocytosis::MealPhase;
use crate::collision::ring::{Containment, Ring};
use crate::id::OrganismId;
use crate::shared::Shared;
use serde::{Deserialize, Serialize};

/// Organisms, in the order of their index.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Organisms {
    arena: Arena<Shared<Organism>>,
    /// Indices of the organisms that have a membrane, ascending: few among many, and asked for in every substep. Nobody else
    /// takes others in or divides.
    #[serde(skip)]
    with_membrane: Vec<u32>,
    /// Whether gravity was ever scaled for an organism: else nobody has to be asked in a step.
    #[serde(skip)]
    scales_gravity: bool,
    /// Whether an organism ever had a damping of its own.
    #[serde(skip)]
    is_damped: bool,
}

impl Clone for Organisms {
    fn clone(&self) -> Self {
        let mut clone = Self::default();
        clone.clone_from(self);
        clone
    }

    fn clone_from(&mut self, source: &Self) {
        let Self { arena, with_membrane, scales_gravity, is_damped } = source;
        self.arena.clone_from(arena);
        self.with_membrane.clone_from(with_membrane);
        self.scales_gravity = *scales_gravity;
        self.is_damped = *is_damped;
    }
}

impl Organisms {
    /// The handle that the next organism gets.
    pub(crate) fn next_id(&self) -> OrganismId {
        OrganismId::of(self.arena.next_handle())
    }

    /// Puts an organism under [`Organisms::next_id`].
    pub(crate) fn insert(&mut self, organism: Organism) -> OrganismId {
        let id = self.next_id();
        if organism.body.membrane().is_some()
            && let Err(at) = self.with_membrane.binary_search(&id.index)
        {
            self.with_membrane.insert(at, id.index);
        }
        self.is_damped |= organism.is_damped();
        OrganismId::of(self.arena.insert(Shared::new(organism)))
    }

    /// Makes what is not read with a table: who has a membrane, whether gravity is scaled and somebody damped.
    #[cfg(feature = "snapshot")]
    pub(crate) fn complete(&mut self) {
        let has_membrane = |organism: &Organism| organism.body.membrane().is_some();
        self.with_membrane = self.iter().filter(|(_, it)| has_membrane(it)).map(|(id, _)| id.index).collect();
        let scales_gravity = self.iter().any(|(_, organism)| organism.gravity_scale != 1.0);
        self.scales_gravity = scales_gravity;
        let is_damped = self.iter().any(|(_, organism)| organism.is_damped());
        self.is_damped = is_damped;
    }

    pub(crate) fn remove(&mut self, id: OrganismId) -> Option<Organism> {
        let organism = self.arena.remove(id.handle())?;
        self.with_membrane.retain(|&index| index != id.index);
        Some(organism.into_inner())
    }

    pub(crate) fn get(&self, id: OrganismId) -> Option<&Organism> {
        self.arena.get(id.handle()).map(|organism| &**organism)
    }

    pub(crate) fn get_mut(&mut self, id: OrganismId) -> Option<&mut Organism> {
        self.arena.get_mut(id.handle()).map(|organism| &mut **organism)
    }

    /// The handle of the organism that lives at an index.
    pub(crate) fn id_at(&self, index: u32) -> Option<OrganismId> {
        self.arena.handle_at(index).map(OrganismId::of)
    }

    /// All organisms, by index.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (OrganismId, &Organism)> {
        self.arena.iter().map(|(handle, organism)| (OrganismId::of(handle), &**organism))
    }

    /// Those that are `wanted`, by index, to be changed; the others stay shared with clones.
    pub(crate) fn iter_mut(
        &mut self,
        wanted: impl Fn(&Organism) -> bool,
    ) -> impl Iterator<Item = (OrganismId, &mut Organism)> {
        let all = self.arena.iter_mut().filter(move |(_, organism)| wanted(organism));
        all.map(|(handle, organism)| (OrganismId::of(handle), &mut **organism))
    }

    /// Those that have a membrane, by index.
    pub(crate) fn with_membrane(&self) -> impl Iterator<Item = (OrganismId, &Organism)> {
        self.with_membrane.iter().filter_map(|&index| {
            let handle = self.arena.handle_at(index)?;
            self.arena.at(index).map(|organism| (OrganismId::of(handle), &**organism))
        })
    }

    /// The same, to be changed.
    pub(crate) fn for_each_with_membrane(&mut self, mut change: impl FnMut(&mut Organism)) {
        for &index in &self.with_membrane {
            if let Some(organism) = self.arena.at_mut(index) {
                change(organism);
            }
        }
    }

    /// The fluids of those with a membrane, and how much farther apart their particles are than at rest.
    pub(crate) fn fluid_scales(&self) -> impl Iterator<Item = (u32, f32)> {
        self.with_membrane().filter_map(|(_, cell)| Some((cell.fluid?, cell.spread_length())))
    }

    /// Those on which gravity acts otherwise.
    pub(crate) fn with_gravity_scale(&self) -> impl Iterator<Item = &Organism> {
        let all = self.scales_gravity.then(|| self.iter().map(|(_, organism)| organism));
        all.into_iter().flatten().filter(|organism| organism.gravity_scale != 1.0 && !organism.is_quarantined)
    }

    /// Those with a damping of their own.
    pub(crate) fn with_damping(&self) -> impl Iterator<Item = &Organism> {
        let all = self.is_damped.then(|| self.iter().map(|(_, organism)| organism));
        all.into_iter().flatten().filter(|organism| organism.is_damped() && !organism.is_quarantined)
    }

    /// Sets the damping of the motion of an organism, and of its rotation.
    pub(crate) fn set_damping(&mut self, id: OrganismId, [linear, angular]: [f32; 2]) {
        if let Some(organism) = self.get_mut(id) {
            (organism.linear_damping, organism.angular_damping) = (linear, angular);
            self.is_damped |= linear > 0.0 || angular > 0.0;
        }
    }

    pub(crate) fn set_gravity_scale(&mut self, id: OrganismId, scale: f32) {
        if let Some(organism) = self.get_mut(id) {
            organism.gravity_scale = scale;
            self.scales_gravity |= scale != 1.0;
        }
    }

    /// The membranes of all organisms that move, and those of their phagosomes.
    pub(crate) fn rings(&self) -> impl Iterator<Item = Ring<'_>> {
        let moving = self.with_membrane().filter(|(_, organism)| !organism.is_quarantined);
        moving.flat_map(|(id, organism)| {
            let ring = move |nodes, holds| Ring { owner: id.index, nodes, holds };
            let own = organism.body.membrane().map(|_| ring(organism.outline.as_slice(), None));
            let is_full = |inner: &&Phagosome| self.get(inner.prey).is_some();
            let full = organism.phagosomes.iter().filter(is_full);
            let inner = full.map(move |inner| ring(&inner.ring, Some(inner.prey.index)));
            own.into_iter().chain(inner)
        })
    }

    /// Which membrane holds each organism.
    pub(crate) fn containments(&self) -> Vec<Containment> {
        let mut containments = vec![Containment::Free; self.arena.slot_count()];
        for (id, organism) in self.with_membrane() {
            let meals = organism.meals().iter();
            // Another organism may live in the place of prey that was removed.
            for meal in meals.filter(|meal| self.get(meal.prey).is_some()) {
                match meal.phase {
                    MealPhase::Touching(_) => {}
                    // Through a gate; a cup closes around prey that stays outside of the membrane.
                    MealPhase::Ingesting(_) if meal.is_in_cup() => {}
                    MealPhase::Ingesting(_) => containments[meal.prey.index as usize] = Containment::Passing(id.index),
                    MealPhase::Ingested | MealPhase::Digesting(_) => {
                        containments[meal.prey.index as usize] = Containment::Inside(id.index);
                    }
                }
            }
        }
        containments
    }

    pub(crate) fn len(&self) -> usize {
        self.arena.iter().count()
    }

    /// Number of slots, empty ones included.
    pub(crate) fn slot_count(&self) -> u32 {
        self.arena.slot_count() as u32
    }

    /// Generation of a slot: of who lives there, or will.
    pub(crate) fn generation(&self, index: u32) -> Option<u32> {
        self.arena.generation(index)
    }

    /// Whether the free slots are exactly the empty ones.
    pub(crate) fn is_sound(&self) -> bool {
        self.arena.is_sound()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lives_in_the_place_of_removed_prey_is_free() {
        use crate::{AgarSpec, AmoeboidCellSpec, Event, Inputs, Intent, Placement, World, WorldConfig};
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(128.0, 45.0)).unwrap();
        let prey = world.spawn(&AgarSpec::default().into(), Placement::at(142.0, 45.0)).unwrap();
        let mut inputs = Inputs::new();
        inputs.set(cell, Intent::toward(glam::Vec2::new(160.0, 45.0)).unwrap());
        let is_in = |world: &World| world.events().iter().any(|event| matches!(event, Event::Ingested { .. }));
        assert!((0..600).any(|_| (world.step(&inputs), is_in(&world)).1));
        world.remove(prey).unwrap();
        let other = world.spawn(&AgarSpec::default().into(), Placement::at(20.0, 45.0)).unwrap();
        assert_eq!(other.index, prey.index);
        assert_eq!(world.organisms.containments()[other.index as usize], Containment::Free);
        assert_eq!(world.organisms.rings().count(), 1, "the phagosome of what is gone holds nothing");
    }
}
