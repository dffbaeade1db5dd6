//! Ingestion through a gate: membrane nodes that ignore the prey until all of it is on one side.

use crate::capability::phagocytosis::{Meal, PhagocytosisParams};
use crate::geometry::{polygon::contains_point, segment::nearest_on_segment};
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::solver::contact::shift;
use crate::world::World;
use glam::Vec2;

/// Overlap with the membrane up to which prey counts as inside, as a share of a node's radius.
const OVERLAP: f32 = 0.25;
/// Share of the distance at which prey counts as inside at which a cell counts as outside: so far from the membrane its own does not
/// slip to the other side when the gate closes.
const OUTSIDE: f32 = 0.5;
/// Time after which prey that is still between both sides is moved to one of them, in time limits, and the share of its distance from
/// the membrane that it needs there: pressed into a fold it would tear the membrane's sides through each other.
const PLACED_AFTER: f32 = 2.0;
const ROOM: f32 = 0.75;

impl World {
    /// Widens the gate to the nodes near the prey and returns the prey's side. At the time limit prey whose centre is outside
    /// is expelled; from twice the time limit on all of the prey is moved to that side as soon as there is room for it. Until then, and
    /// if it is a cell, whose content would not stay in its membrane, it is drawn in or driven out, as its centre says at each multiple
    /// of the time limit.
    pub(super) fn advance_gate(
        &mut self,
        id: OrganismId,
        meal: &mut Meal,
        params: &PhagocytosisParams,
        elapsed: f32,
    ) -> PreySide {
        self.widen_gate(id, meal);
        let Some(organism) = self.organisms.get(id) else { return PreySide::Outside };
        let outline = self.outline_of(organism);
        let clearance = organism.body.membrane().map_or(0.0, |membrane| membrane.node_radius) * (1.0 - OVERLAP);
        let side = self.side_of_prey(meal.prey, &outline, clearance);
        if side != PreySide::Between || elapsed < params.time_limit {
            return side;
        }
        let is_cell = self.organisms.get(meal.prey).is_some_and(Organism::is_cell);
        if is_time(elapsed, self.config.dt, params.time_limit) {
            let of_disc = || self.organisms.get(meal.prey).map(|prey| self.centre_of(prey));
            let centre = if is_cell { self.centroid(meal.prey) } else { of_disc() };
            meal.is_expelled = centre.is_some_and(|centre| !contains_point(&outline, centre));
        }
        if is_cell || elapsed < PLACED_AFTER * params.time_limit {
            return side;
        }
        if !self.place_prey(meal.prey, !meal.is_expelled, &outline, clearance) {
            return side;
        }
        if meal.is_expelled { PreySide::Outside } else { PreySide::Inside }
    }

    /// Moves all discs of prey to one side of an outline, each to the nearest point there, if all have room; returns whether they have.
    fn place_prey(&mut self, prey: OrganismId, inside: bool, outline: &[Vec2], clearance: f32) -> bool {
        let discs: Vec<usize> = self.discs_of(prey).collect();
        let ways = discs.iter().map(|&i| {
            let (at, distance) = (self.particles.position(i), self.particles.radius[i] + clearance);
            way_to_side(outline, at, distance, inside)
        });
        let Some(ways) = ways.collect::<Option<Vec<Vec2>>>() else { return false };
        for (i, by) in discs.into_iter().zip(ways).filter(|(_, by)| *by != Vec2::ZERO) {
            shift(&mut self.particles, i, by);
            self.particles.prev_x[i] += by.x;
            self.particles.prev_y[i] += by.y;
        }
        true
    }

    /// Adds the nodes near the prey to the gate: prey may slide along the membrane.
    fn widen_gate(&mut self, id: OrganismId, meal: &mut Meal) {
        let (Some(engulfer), Some(prey)) = (self.organisms.get(id), self.organisms.get(meal.prey)) else { return };
        let p = &self.particles;
        let margin = 2.0 * self.config.max_displacement();
        let discs: Vec<usize> = prey.particles().map(|i| i as usize).filter(|&i| p.inv_mass[i] > 0.0).collect();
        let is_near =
            |node: usize| discs.iter().any(|&i| p.between(node, i).length() < p.radius[node] + p.radius[i] + margin);
        let nodes = engulfer.outline_particles().filter(|node| !meal.gate.contains(node) && is_near(*node as usize));
        let nodes: Vec<u32> = nodes.collect();
        self.exemptions.open_gate(&nodes, meal.prey.index);
        meal.gate.extend(nodes);
    }

    /// Adds new nodes to the gates of an engulfer that cells pass. Without, they would be in a gate only a step later, and be
    /// driven out of the cell that has the gate's other nodes in it.
    pub(in crate::world) fn widen_gates_for_cells(&mut self, id: OrganismId) {
        let is_cell = |meal: &Meal| self.organisms.get(meal.prey).is_some_and(Organism::is_cell);
        let is_passed = |meal: &Meal| meal.is_in_gate() && is_cell(meal);
        if !self.organisms.get(id).is_some_and(|organism| organism.meals().iter().any(is_passed)) {
            return;
        }
        let Some(mut engulfer) = self.organisms.get_mut(id).and_then(|organism| organism.engulfer.take()) else {
            return;
        };
        engulfer.meals.iter_mut().filter(|meal| meal.is_in_gate()).for_each(|meal| self.widen_gate(id, meal));
        if let Some(organism) = self.organisms.get_mut(id) {
            organism.engulfer = Some(engulfer);
        }
    }

    /// Side of an outline on which all discs of prey lie. The inner surface is `clearance` inside the outline.
    fn side_of_prey(&self, prey: OrganismId, outline: &[Vec2], clearance: f32) -> PreySide {
        let Some(prey) = self.organisms.get(prey) else { return PreySide::Outside };
        let (mut inside, mut outside) = (true, !prey.is_cell() || self.is_clear_of(prey, outline));
        for i in surface_of(prey).filter(|&i| self.particles.inv_mass[i] > 0.0) {
            let position = self.particles.position(i);
            let is_within = contains_point(outline, position);
            let distance = || (nearest_edge(outline, position).0 - position).length();
            let needed = self.particles.radius[i] + clearance;
            inside &= is_within && distance() >= needed;
            let has_room = || way_to_side(outline, position, needed, false).is_some();
            outside &= !is_within && if prey.is_cell() { distance() >= OUTSIDE * needed } else { has_room() };
        }
        match (inside, outside) {
            (true, _) => PreySide::Inside,
            (_, true) => PreySide::Outside,
            _ => PreySide::Between,
        }
    }

    /// Whether no corner of an outline lies within a cell: nodes of a gate may be there while all nodes of the cell are outside.
    fn is_clear_of(&self, cell: &Organism, outline: &[Vec2]) -> bool {
        let ring = self.outline_of(cell);
        !outline.iter().any(|&node| contains_point(&ring, node))
    }
}

/// Discs by which prey touches others: of a cell those of its membrane, which holds all others.
fn surface_of(prey: &Organism) -> impl Iterator<Item = usize> + '_ {
    let ring = prey.is_cell().then(|| prey.outline_particles());
    let discs = (!prey.is_cell()).then(|| prey.particles());
    ring.into_iter().flatten().chain(discs.into_iter().flatten()).map(|i| i as usize)
}

/// Whether a time that has just grown by `dt` has passed a multiple of the time limit.
fn is_time(elapsed: f32, dt: f32, limit: f32) -> bool {
    (elapsed / limit) as u32 != ((elapsed - dt) / limit) as u32
}

/// Side of a membrane on which prey lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PreySide {
    Inside,
    Outside,
    Between,
}

/// The nearest point of a counter-clockwise polygon's edges, and the direction out of it there.
fn nearest_edge(outline: &[Vec2], point: Vec2) -> (Vec2, Vec2) {
    let mut best = (f32::INFINITY, point, Vec2::X);
    for k in 0..outline.len() {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        let at = nearest_on_segment(a, b, point);
        let distance = (at - point).length();
        if distance < best.0 {
            best = (distance, at, -(b - a).perp().normalize_or_zero());
        }
    }
    (best.1, best.2)
}

/// The way from a point to the nearest one on one side of an outline, so far from its edges; `None` where another edge leaves no room.
fn way_to_side(outline: &[Vec2], at: Vec2, distance: f32, inside: bool) -> Option<Vec2> {
    let is_there =
        |at, distance| contains_point(outline, at) == inside && (nearest_edge(outline, at).0 - at).length() >= distance;
    if is_there(at, distance) {
        return Some(Vec2::ZERO);
    }
    let (edge, outwards) = nearest_edge(outline, at);
    let place = edge + outwards * if inside { -distance } else { distance };
    is_there(place, ROOM * distance).then_some(place - at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capability::phagocytosis::{IngestionWay, MealPhase, PreyClass};
    use crate::{AgarSpec, AmoeboidCellSpec, Placement, RigidCellSpec, WorldConfig};

    /// A square with a fold from above, 1 wide, that leaves 1.2 below it.
    const FOLDED: [Vec2; 8] = [
        Vec2::new(0.0, 0.0),
        Vec2::new(10.0, 0.0),
        Vec2::new(10.0, 10.0),
        Vec2::new(5.5, 10.0),
        Vec2::new(5.5, 1.2),
        Vec2::new(4.5, 1.2),
        Vec2::new(4.5, 10.0),
        Vec2::new(0.0, 10.0),
    ];

    #[test]
    fn prey_whose_centre_is_outside_at_the_time_limit_is_expelled() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(60.0, 45.0)).unwrap();
        let prey = world.spawn(&RigidCellSpec::default().into(), Placement::at(120.0, 45.0)).unwrap();
        let edge = world.view().organism(cell).unwrap().bounds().1.x;
        let params = PhagocytosisParams::default();
        let mut is_expelled = |off: f32, elapsed: f32| {
            let by = Vec2::new(edge + off - world.centroid(prey).unwrap().x, 0.0);
            world.discs_of(prey).collect::<Vec<_>>().into_iter().for_each(|i| shift(&mut world.particles, i, by));
            let (class, phase, way) = (PreyClass::Soft, MealPhase::Ingesting(elapsed), IngestionWay::Gate);
            let mut meal = Meal { prey, class, phase, way, gate: Vec::new(), is_expelled: false };
            let side = world.advance_gate(cell, &mut meal, &params, elapsed);
            assert_eq!(side, PreySide::Between);
            meal.is_expelled
        };
        let (limit, dt) = (params.time_limit, 1.0 / 60.0);
        assert!(!is_expelled(2.0, limit - 0.5 * dt) && is_expelled(2.0, limit + 0.5 * dt));
        assert!(!is_expelled(-3.0, limit + 0.5 * dt), "its centre is inside");
        assert!(!is_expelled(2.0, limit + 1.5 * dt), "it was decided before");
    }

    #[test]
    fn the_nearest_edge_is_told_with_the_way_out() {
        let square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(|(x, y)| Vec2::new(x, y));
        for (point, edge, out) in [
            (Vec2::new(9.0, 5.0), Vec2::new(10.0, 5.0), Vec2::X),
            (Vec2::new(12.0, 5.0), Vec2::new(10.0, 5.0), Vec2::X),
            (Vec2::new(4.0, 0.5), Vec2::new(4.0, 0.0), Vec2::NEG_Y),
            (Vec2::new(1.0, 7.0), Vec2::new(0.0, 7.0), Vec2::NEG_X),
        ] {
            assert_eq!(nearest_edge(&square, point), (edge, out), "{point}");
        }
    }

    #[test]
    fn prey_in_a_fold_that_is_narrower_is_on_neither_side() {
        let mut world = World::new(WorldConfig::default()).unwrap();
        let spec = AgarSpec { radius: 0.9, ..AgarSpec::default() };
        let prey = world.spawn(&spec.into(), Placement::at(120.0, 45.0)).unwrap();
        let mut side = |x: f32, y: f32| {
            let by = Vec2::new(x, y) - world.centroid(prey).unwrap();
            world.discs_of(prey).collect::<Vec<_>>().into_iter().for_each(|i| shift(&mut world.particles, i, by));
            world.side_of_prey(prey, &FOLDED, 0.3)
        };
        assert_eq!(side(5.0, 6.0), PreySide::Between, "in the fold");
        assert_eq!([side(5.0, 10.5), side(10.2, 5.0)], [PreySide::Outside; 2], "at its mouth, and beside the cell");
        assert_eq!([side(9.5, 5.0), side(2.0, 5.0)], [PreySide::Between, PreySide::Inside]);
    }

    #[test]
    fn nothing_is_moved_into_a_fold_that_leaves_no_room() {
        let way = |x: f32, y: f32, inside| way_to_side(&FOLDED, Vec2::new(x, y), 1.0, inside);
        assert_eq!(way(4.5, 6.0, false), None, "the other side of the fold is too near");
        assert_eq!(way(4.5, 6.0, true), Some(Vec2::new(-1.0, 0.0)));
        assert_eq!(way(0.2, 5.0, false), Some(Vec2::new(-1.2, 0.0)));
        assert_eq!(way(5.0, 1.0, true), None, "between the fold and the lower edge");
        assert_eq!([way(2.0, 5.0, true), way(-2.0, 5.0, false)], [Some(Vec2::ZERO); 2], "it is there");
    }
}
