//! Division and fusion as a capability: parameters, state, and the number of nodes that the membrane should have.
//!
//! ```text
//!            asked, nothing against it                    furrow closed
//!   (rest) ------------------------> furrow closes ---------------------> two cells at rest
//!      ^ refused                         |
//!      +---------------------------------+ time limit over, or frozen: abandoned
//! ```

use crate::error::Error;
use crate::id::OrganismId;
use crate::spec_field::FieldValue::{Count, Number};
use crate::spec_field::{FieldVisitor, check, field};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Largest number of circles of membrane while a furrow closes: the neck needs more than two circles.
const LOBES_AT_CLOSING: f32 = 3.0;
/// Time in which the membrane of two fused cells shortens from two circles to one, s.
const ROUNDING_TIME: f32 = 2.0;

/// How an amoeboid cell divides and fuses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DivisionParams {
    /// Speed at which each side of the furrow moves towards the other, units/s, 0.1 to 20.
    pub furrow_speed: f32,
    /// Longest link that may close a ring when two links are swapped, in rest lengths, 1 to 1.25. Two cells fuse when their
    /// membranes are that near.
    pub closing_length: f32,
    /// Time after which a furrow that has not closed is abandoned, s, 0.1 to 600.
    pub time_limit: f32,
    /// Fewest particles of cytoplasm that a lobe must hold, 7 to 1 000 000. A division begins where both halves have a tenth more.
    pub least_particles: u32,
    /// Fewest membrane nodes of a lobe, 8 to 4096.
    pub least_nodes: u32,
}

impl Default for DivisionParams {
    fn default() -> Self {
        Self { furrow_speed: 3.0, closing_length: 1.25, time_limit: 30.0, least_particles: 20, least_nodes: 10 }
    }
}

impl DivisionParams {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        check(*self, Self::fields)
    }

    pub(crate) fn fields(&mut self, visit: &mut FieldVisitor<'_>) {
        let words = "Speed of each side of the furrow, micrometres/s.";
        visit(field("furrow_speed", words), Number(&mut self.furrow_speed, [0.1, 20.0]));
        let words = "Longest link that may close a ring, in rest lengths.";
        visit(field("closing_length", words), Number(&mut self.closing_length, [1.0, 1.25]));
        let words = "Time after which a furrow that has not closed is abandoned, s.";
        visit(field("time_limit", words), Number(&mut self.time_limit, [0.1, 600.0]));
        let words = "Fewest particles of cytoplasm of each half.";
        visit(field("least_particles", words), Count(&mut self.least_particles, [7, 1_000_000]));
        let words = "Fewest membrane nodes of each half.";
        visit(field("least_nodes", words), Count(&mut self.least_nodes, [8, 4096]));
    }
}

/// What a cell was told to do in the next step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Order {
    /// Divide along this axis, or along its longest one.
    Divide { axis: Option<Vec2> },
    /// Fuse with another cell.
    Fuse { with: OrganismId },
}

/// A furrow that is closing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Furrow {
    /// The membrane nodes at its bottom, on both sides.
    pub nodes: [u32; 2],
    /// Their distance when it began, units.
    pub width: f32,
    /// Time since it began, s.
    pub elapsed: f32,
}

/// The capability to divide and to fuse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Divider {
    pub params: DivisionParams,
    pub order: Option<Order>,
    pub furrow: Option<Furrow>,
    /// Length of the membrane in circles around its content: 1 at rest, more while a furrow closes and after a fusion.
    pub lobes: f32,
    /// Membrane nodes over the square root of the content in particles of cytoplasm, recorded at the first division, fusion or
    /// cup. With it both cells of a division get the nodes that they need, and their fusion restores the first number.
    pub nodes_per_root: Option<f32>,
    /// Number of nodes that the membrane should have; it changes by one per step.
    pub wanted_nodes: Option<u32>,
}

impl Divider {
    pub(crate) fn new(params: DivisionParams) -> Self {
        Self { params, order: None, furrow: None, lobes: 1.0, nodes_per_root: None, wanted_nodes: None }
    }

    /// Whether it is as that of a body without a membrane always is, but for an order to divide.
    pub(crate) fn is_of_body(&self) -> bool {
        let orders = [None, Some(Order::Divide { axis: None })];
        orders.into_iter().any(|order| *self == Self { order, ..Self::new(DivisionParams::default()) })
    }

    /// Moves the length of the membrane towards what the furrow needs, or back to one circle.
    pub(crate) fn relax(&mut self, dt: f32) {
        let (target, rate) = match self.furrow {
            Some(furrow) => (LOBES_AT_CLOSING, 2.0 * self.params.furrow_speed / furrow.width),
            None => (1.0, 1.0 / ROUNDING_TIME),
        };
        let way = target - self.lobes;
        let most = rate * dt;
        self.lobes = if way.abs() <= most { target } else { self.lobes + most.copysign(way) };
    }

    /// Ends a division: each lobe has half of the membrane.
    pub(crate) fn end(&mut self) {
        self.furrow = None;
        self.lobes = if self.lobes > 2.0 { 0.5 * self.lobes } else { 1.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_out_of_their_range_are_refused() {
        assert!(DivisionParams::default().validate().is_ok());
        assert!(DivisionParams { furrow_speed: 0.0, ..DivisionParams::default() }.validate().is_err());
        assert!(DivisionParams { least_nodes: 7, ..DivisionParams::default() }.validate().is_err());
    }

    #[test]
    fn a_membrane_of_two_circles_becomes_one_at_its_rate() {
        let mut divider = Divider { lobes: 2.0, ..Divider::new(DivisionParams::default()) };
        divider.relax(0.5);
        assert_eq!(divider.lobes, 2.0 - 0.5 / ROUNDING_TIME);
        (0..4).for_each(|_| divider.relax(0.5));
        assert_eq!(divider.lobes, 1.0);
        divider.furrow = Some(Furrow { nodes: [0, 1], width: 6.0, elapsed: 0.0 });
        divider.relax(0.5);
        assert_eq!(divider.lobes, 1.0 + 2.0 * divider.params.furrow_speed / 6.0 * 0.5);
    }
}
