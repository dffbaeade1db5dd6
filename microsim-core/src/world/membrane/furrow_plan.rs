//! The plan of a furrow: where it begins, or why the cell cannot divide.

use crate::capability::division::Furrow;
use crate::capability::phagocytosis::PreyClass;
use crate::event::Refusal;
use crate::geometry::polygon::centroid;
use crate::geometry::ring::direction_or;
use crate::id::OrganismId;
use crate::organism::Organism;
use crate::solver::membrane::Membrane;
use crate::world::World;
use glam::Vec2;
use std::ops::Range;

/// Share of nodes that a division may add: two circles need 1.41 times the nodes of one.
const SLACK: f32 = 0.6;

impl World {
    /// The furrow across `axis`, or across the longest axis, or the reason why the cell cannot divide.
    pub(super) fn plan_furrow(&self, organism: &Organism, axis: Option<Vec2>) -> Result<Furrow, Refusal> {
        Self::refusal_of_free(organism).map_or(Ok(()), Err)?;
        let outline = self.outline_of(organism);
        let centre = centroid(&outline).ok_or(Refusal::TooSmall)?;
        let slack = (SLACK * outline.len() as f32) as u64;
        if self.particles.live_count() as u64 + slack > u64::from(self.config.max_particles) {
            return Err(Refusal::WorldFull);
        }
        self.lay_furrow(organism, axis.unwrap_or_else(|| long_axis(&outline, centre)))
    }

    /// The furrow across `axis` through the centroid, or the reason why it cannot be there.
    fn lay_furrow(&self, organism: &Organism, axis: Vec2) -> Result<Furrow, Refusal> {
        let Some(params) = organism.divider.as_ref().map(|divider| divider.params) else {
            return Err(Refusal::TooSmall);
        };
        let outline = self.outline_of(organism);
        let centre = centroid(&outline).ok_or(Refusal::TooSmall)?;
        let ahead = |at: Vec2| (at - centre).dot(axis) > 0.0;
        let fluid = organism.fluid_particles.iter().map(|&i| self.particles.position(i as usize));
        // What rounds up first is divided evenly then.
        let is_even = organism.body.membrane().is_some_and(Membrane::is_active);
        let smaller = |count: usize, all: usize| if is_even { all / 2 } else { count.min(all - count) };
        // Some particles change sides until the furrow is closed.
        let is_small = |count: usize, all: usize, least: u32| smaller(count, all) * 9 < least as usize * 10;
        if is_small(fluid.filter(|&at| ahead(at)).count(), organism.fluid_particles.len(), params.least_particles)
            || is_small(outline.iter().filter(|&&at| ahead(at)).count(), outline.len(), params.least_nodes)
        {
            return Err(Refusal::TooSmall);
        }
        if self.soft_prey_reaches(organism, centre, axis) {
            return Err(Refusal::PreyInFurrow);
        }
        let nodes = bottom_nodes(organism, &outline, centre, axis).ok_or(Refusal::TooSmall)?;
        let width = self.particles.between(nodes[0] as usize, nodes[1] as usize).length();
        Ok(Furrow { nodes, width, elapsed: 0.0 })
    }

    /// Lays the furrow of a cell that rounds up across the middle that it has now, along the same axis, if it can be there.
    pub(super) fn centre_furrow(&mut self, id: OrganismId) {
        let Some((organism, furrow)) = self.organisms.get(id).and_then(|cell| Some((cell, cell.furrow()?))) else {
            return;
        };
        let [a, b] = furrow.nodes.map(|node| node as usize);
        let axis = direction_or(self.particles.between(a, b).perp(), Vec2::X);
        let Ok(furrow) = self.lay_furrow(organism, axis) else { return };
        if let Some(divider) = self.divider_mut(id) {
            divider.furrow = Some(furrow);
        }
    }

    /// Whether soft prey inside a cell lies on the line across `axis` through a point, or closer than the membrane of the
    /// furrow needs.
    fn soft_prey_reaches(&self, organism: &Organism, point: Vec2, axis: Vec2) -> bool {
        let room = organism.body.membrane().map_or(0.0, |membrane| membrane.rest_length);
        let soft = organism.meals().iter().filter(|meal| meal.class == PreyClass::Soft && meal.phase.is_inside());
        soft.filter_map(|meal| self.organisms.get(meal.prey)).any(|prey| {
            let side = |i: usize, radius: f32| (self.particles.position(i) - point).dot(axis) + radius;
            let discs = || prey.particles().map(|i| (i as usize, self.particles.radius[i as usize] + room));
            discs().any(|(i, radius)| side(i, radius) > 0.0) && discs().any(|(i, radius)| side(i, -radius) < 0.0)
        })
    }
}

/// Direction in which an outline is longest: that of the larger eigenvalue of its second moments.
fn long_axis(outline: &[Vec2], centre: Vec2) -> Vec2 {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for &at in outline {
        let arm = at - centre;
        (xx, xy, yy) = (xx + arm.x * arm.x, xy + arm.x * arm.y, yy + arm.y * arm.y);
    }
    let half = 0.5 * (xx - yy);
    let root = (half * half + xy * xy).sqrt();
    // Of the two forms of the eigenvector, the one that does not cancel.
    let axis = if half >= 0.0 { Vec2::new(half + root, xy) } else { Vec2::new(xy, root - half) };
    direction_or(axis, Vec2::X)
}

/// The node of the outline that is nearest to the line across the axis, and the nearest one in the opposite half of the ring.
/// The sides of the axis would not do: after a fusion the centre may lie beside the neck.
fn bottom_nodes(organism: &Organism, outline: &[Vec2], centre: Vec2, axis: Vec2) -> Option<[u32; 2]> {
    let count = outline.len();
    let nearest = |places: Range<usize>| {
        let distance = |k: usize| (outline[k % count] - centre).dot(axis).abs();
        places.min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
    };
    let first = nearest(0..count)?;
    let second = nearest(first + count.div_ceil(4)..first + count - count / 4)?;
    Some([first, second].map(|k| organism.outline[k % count]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ring::{ellipse, rotate, unit_vector};
    use crate::{AmoeboidCellSpec, Placement, WorldConfig};

    #[test]
    fn the_long_axis_is_that_along_which_an_outline_is_stretched() {
        for k in 0..12 {
            let axis = unit_vector(0.26 * k as f32);
            let centre = Vec2::new(40.0, -7.0);
            let outline: Vec<Vec2> =
                ellipse(Vec2::new(3.0, 2.0), 40).into_iter().map(|arm| centre + rotate(arm, axis)).collect();
            let found = long_axis(&outline, centre);
            assert!(found.perp_dot(axis).abs() < 1e-3 && (found.length() - 1.0).abs() < 1e-3, "{found} for {axis}");
        }
    }

    #[test]
    fn a_cell_divides_if_the_world_has_room_for_its_nodes() {
        let plan = |spare: usize| {
            let mut world = World::new(WorldConfig::default()).unwrap();
            let cell = world.spawn(&AmoeboidCellSpec::default().into(), Placement::at(80.0, 45.0)).unwrap();
            let organism = world.organisms.get(cell).unwrap().clone();
            let slack = (SLACK * organism.outline.len() as f32) as usize;
            world.config.max_particles = (world.particles.live_count() + slack + spare - 1) as u32;
            world.plan_furrow(&organism, None).map(|_| ())
        };
        assert_eq!([plan(0), plan(1)], [Err(Refusal::WorldFull), Ok(())]);
    }
}
