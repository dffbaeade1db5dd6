//! Census: counts of what is in the world and of what must not happen.

use crate::capability::phagocytosis::MealPhase;
use crate::geometry::polygon::contains_point;
use crate::id::OrganismId;
use crate::organism::{Organism, Storage};
use crate::solver::constraint::Constraint;
use crate::template::Role;
use crate::world::World;
use glam::Vec2;

/// Counts of what is in the world, and of what must not happen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Organisms.
    pub organisms: usize,
    /// Dynamic discs that are not fluid: the "dynamic bodies" of the thesis' Table 4.1.
    pub bodies: usize,
    /// All live particles: discs, fluid and static points.
    pub particles: usize,
    /// Constraints, without contacts, fluid density and links that tore.
    pub constraints: usize,
    /// Cytoplasm particles outside their own membrane (ray cast, thesis, 3.1.3), or inside that of a cell that theirs holds.
    pub leaks: usize,
    /// Prey whose centre is inside an engulfer that has not taken it in (thesis, 4.2.2), or outside one that has.
    pub improper_absorptions: usize,
    /// How often a disc was found on the wrong side of the link of a membrane nearest to it, since the world was made.
    pub wrong_side: u64,
    /// How often a ray found a disc on the wrong side of a whole membrane, or links of a membrane crossed, since the world was
    /// made. Both are repaired in the same step.
    pub net_fired: u64,
    /// Prey that lies partly within an engulfer that is not taking it in.
    pub partial_absorptions: usize,
    /// Organisms that are frozen.
    pub quarantined: usize,
}

impl World {
    /// Counts what is in the world. Costs about as much as a substep.
    #[must_use]
    pub fn census(&self) -> Census {
        let of_body = |organism: &Organism| match organism.body.membrane() {
            Some(_) => organism.outline.len(),
            None => self.whole_constraints_of(organism).count(),
        };
        let constraints = self.organisms.iter().map(|(_, organism)| of_body(organism)).sum();
        Census {
            organisms: self.organisms.len(),
            bodies: self.bodies(),
            particles: self.particles.live_count(),
            constraints,
            leaks: self.leaks(),
            improper_absorptions: self.improper_absorptions(),
            wrong_side: self.guard.wrong_side,
            net_fired: self.guard.net_fired,
            partial_absorptions: self.partial_absorptions(),
            quarantined: self.quarantined(),
        }
    }

    /// The constraints that hold a templated organism together.
    pub(in crate::world) fn constraints_of(&self, organism: &Organism) -> &[Constraint] {
        match organism.body {
            Storage::Lane { block, .. } => self.templates[self.blocks[block as usize].template as usize].constraints(),
            Storage::Loose { .. } => &[],
        }
    }

    /// The same without links that tore.
    pub(in crate::world) fn whole_constraints_of<'a>(
        &'a self,
        organism: &'a Organism,
    ) -> impl Iterator<Item = &'a Constraint> {
        let is_whole = move |constraint: &Constraint, k| {
            !matches!(constraint, Constraint::YieldingDistance(_)) || self.length_factor(organism, k) > 0.0
        };
        let constraints = self.constraints_of(organism).iter().zip(0..);
        constraints.filter(move |&(constraint, k)| is_whole(constraint, k)).map(|(constraint, _)| constraint)
    }

    pub(in crate::world) fn bodies(&self) -> usize {
        let p = &self.particles;
        p.live().filter(|&i| p.inv_mass[i] > 0.0 && p.fluid[i] == 0).count()
    }

    pub(in crate::world) fn quarantined(&self) -> usize {
        self.organisms.iter().filter(|(_, organism)| organism.is_quarantined).count()
    }

    pub(in crate::world) fn leaks(&self) -> usize {
        self.organisms.iter().map(|(_, organism)| self.leaks_of(organism)).sum()
    }

    fn leaks_of(&self, organism: &Organism) -> usize {
        if organism.outline.is_empty() || organism.fluid_particles.is_empty() {
            return 0;
        }
        let outline = self.outline_of(organism);
        let held = self.held_cells(organism);
        let is_lost = |&&i: &&u32| {
            let at = self.particles.position(i as usize);
            !contains_point(&outline, at) || held.iter().any(|inner| contains_point(inner, at))
        };
        organism.fluid_particles.iter().filter(is_lost).count()
    }

    /// Outlines of the cells that a cell has taken in or takes in.
    pub(in crate::world) fn held_cells(&self, organism: &Organism) -> Vec<Vec<Vec2>> {
        let held = organism.meals().iter().filter(|meal| !matches!(meal.phase, MealPhase::Touching(_)));
        let cells = held.filter_map(|meal| self.organisms.get(meal.prey)).filter(|prey| prey.is_cell());
        cells.map(|cell| self.outline_of(cell)).collect()
    }

    /// Prey whose centre is inside an engulfer that does not hold it, or outside one that does.
    pub(in crate::world) fn improper_absorptions(&self) -> usize {
        self.count_prey(|phase, outline, prey| {
            let is_inside = contains_point(outline, self.centre_of(prey));
            match phase {
                Some(MealPhase::Ingesting(_)) => false,
                Some(MealPhase::Ingested | MealPhase::Digesting(_)) => !is_inside,
                Some(MealPhase::Touching(_)) | None => is_inside,
            }
        })
    }

    /// Prey with particles on both sides of a membrane that is not taking it in.
    pub(in crate::world) fn partial_absorptions(&self) -> usize {
        self.count_prey(|phase, outline, prey| {
            let mut sides = prey.particles().map(|i| contains_point(outline, self.particles.position(i as usize)));
            let first = sides.next();
            !matches!(phase, Some(MealPhase::Ingesting(_))) && sides.any(|side| Some(side) != first)
        })
    }

    /// Number of prey for which a condition holds with some engulfer, given the phase of the meal and the engulfer's outline.
    fn count_prey(&self, is_so: impl Fn(Option<MealPhase>, &[Vec2], &Organism) -> bool) -> usize {
        let engulfers =
            self.organisms.iter().filter_map(|(id, o)| Some((id, o.engulfer.as_ref()?, self.outline_of(o))));
        let engulfers: Vec<_> = engulfers.collect();
        let prey = self.organisms.iter().filter(|(_, o)| o.prey.is_some() && !o.is_quarantined);
        let counts = |(id, prey): &(OrganismId, &Organism)| {
            engulfers.iter().filter(|(other, ..)| other != id).any(|(_, engulfer, outline)| {
                let phase = engulfer.meals.iter().find(|meal| meal.prey == *id).map(|meal| meal.phase);
                is_so(phase, outline, prey)
            })
        };
        prey.filter(counts).count()
    }

    /// Position of the nucleus, or of the first particle.
    pub(in crate::world) fn centre_of(&self, organism: &Organism) -> Vec2 {
        let is_nucleus = |&i: &usize| self.particles.role[i] == Role::Nucleus as u8;
        let mut particles = organism.particles().map(|i| i as usize);
        let first = organism.first_node().map_or(0, |i| i as usize);
        self.particles.position(particles.find(is_nucleus).unwrap_or(first))
    }

    pub(in crate::world) fn outline_of(&self, organism: &Organism) -> Vec<Vec2> {
        organism.outline_positions(&self.particles)
    }
}
